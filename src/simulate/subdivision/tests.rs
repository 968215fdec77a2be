//! Subdivisions of motions whose cubic interpolants have known errors: as many intervals as these need.
#![allow(clippy::float_cmp, reason = "times that are copied or halved, and numbers of states")]

use super::*;
use crate::owned::CloneModel;
use crate::registry;
use crate::simulate::system::Body;
use planar_proof::layout;

/// Of the bodies, m.
const REACH: f64 = 3.0;
/// Base pose, two joint angles and the pose of a body; then their rates and the work.
const SIZE: usize = 8;
/// m per unit of these.
const METRES: [f64; SIZE] = [REACH, 1.0, 1.0, REACH, REACH, REACH, 1.0, 1.0];

/// Largest error of a state that the parts before show, m or m/s; it is a share of the tolerance.
const CONTINUED: f64 = 2e-8;

/// A position and its rate at a time.
type Motion<'a> = dyn Fn(f64) -> [f64; 2] + 'a;

/// The state of a system of which one coordinate moves.
fn state(moved: usize, motion: &Motion<'_>, time: f64) -> Vec<f64> {
    let mut x = vec![0.0; 2 * SIZE + 3];
    [x[moved], x[SIZE + moved]] = motion(time);
    x
}

/// Divides parts of a step; the times of the knots of the last one, and how many states each needed.
fn divide(divisions: u32, moved: usize, motion: &Motion<'_>, times: &[f64]) -> (Vec<f64>, Vec<u32>) {
    divide_bounded(&|_| f64::INFINITY, divisions, moved, motion, times)
}

/// The same with bounds of the fourth derivative in the parts from these times on.
fn divide_bounded(
    bound: &dyn Fn(f64) -> f64,
    divisions: u32,
    moved: usize,
    motion: &Motion<'_>,
    times: &[f64],
) -> (Vec<f64>, Vec<u32>) {
    let model: Box<dyn CloneModel> = registry::generic(&layout("single_arm_2r"));
    let bodies = [Body { mass: 1.0, inertia: 1.0, pose: [0.0; 3], twist: [0.0; 3] }];
    let system = System { bodies: &bodies, reach: REACH, ..System::alone(&*model) };
    let start = state(moved, motion, times[0]);
    let mut subdivision = Subdivision::new(&system, divisions, (times[0], &start));
    let counts = times.windows(2).map(|part| {
        let (mut count, span @ [from, to]) = (0, [part[0], part[1]]);
        let mut state_at = |time: f64, into: &mut Vec<f64>| {
            count += 1;
            *into = state(moved, motion, time);
            Ok(())
        };
        subdivision.divide(span, &state(moved, motion, to), bound(from), &mut state_at).expect("states");
        count
    });
    let counts = counts.collect();
    let mut knots = vec![times[times.len() - 2]];
    for (interval, (time, end)) in subdivision.intervals().zip(subdivision.ends()) {
        let interval = interval.expect("states");
        assert_eq!(interval.span, [knots[knots.len() - 1], time], "without gaps");
        let expected = state(moved, motion, time);
        let error = end.iter().zip(&expected).fold(0.0, |most: f64, (x, y)| most.max((x - y).abs()));
        assert!(error <= CONTINUED && interval.end == [&end[..SIZE], &end[SIZE..2 * SIZE]], "{time}: {error:e}");
        knots.push(time);
    }
    (knots, counts)
}

/// A quartic c t⁴ is off by c h⁴/16 in the middle of h, wherever that is; so many intervals that this is 10⁻⁸ m.
#[test]
fn intervals_are_as_long_as_quartics_allow() {
    for (moved, metres) in METRES.iter().enumerate() {
        for exponent in 0..8 {
            let count = 2.0_f64.powi(exponent);
            // a tenth more would need one bisection more
            for (part, intervals) in [(0.9, count), (1.1, 2.0 * count)] {
                let c = part * 16e-8 * (count / 0.5).powi(4) / metres;
                let motion = |t: f64| [c * (t - 2.125).powi(4), 4.0 * c * (t - 2.125).powi(3)];
                let (knots, states) = divide(10, moved, &motion, &[2.0, 2.5]);
                let expected: Vec<f64> = std::iter::successors(Some(0.0), |i| (*i < intervals).then_some(i + 1.0))
                    .map(|i| 2.0 + 0.5 * i / intervals)
                    .collect();
                assert_eq!(knots, expected, "{moved} {count} {part}");
                assert_eq!(f64::from(states[0]), 2.0 * intervals - 1.0, "a state in the middle of every interval");
            }
        }
    }
}

/// A quintic c (t − m)⁵ about the middle is right there; its slope is off by c h⁴/16, over h/8.
#[test]
fn errors_that_are_odd_about_the_middle_are_seen() {
    for (part, intervals) in [(0.9, 1), (1.1, 2)] {
        let c = part * 8.0 * 16e-8 / 0.5_f64.powi(5);
        let motion = |t: f64| [c * (t - 2.25).powi(5), 5.0 * c * (t - 2.25).powi(4)];
        let (knots, _) = divide(10, 1, &motion, &[2.0, 2.5]);
        assert_eq!(knots.len() - 1, intervals, "{part} {knots:?}");
    }
}

/// Far positions are rounded: 64 units in the last place are no error, more are one.
#[test]
fn rounding_is_no_error() {
    let far = 1e9;
    for moved in [2, 4] {
        for (part, intervals) in [(0.5, 1), (1.5, 2)] {
            let c = part * 16.0 * 64.0 * f64::EPSILON * far;
            let motion = |t: f64| [far + c * t.powi(4), 4.0 * c * t.powi(3)];
            let (knots, _) = divide(10, moved, &motion, &[0.0, 1.0]);
            assert_eq!(knots.len() - 1, intervals, "{moved} {part} {knots:?}");
        }
    }
}

/// A part that the part before it shows to be smooth needs no state of its own, unless that was much shorter.
#[test]
fn parts_after_smooth_ones() {
    let line = |t: f64| [0.3 * t, 0.3];
    let (knots, states) = divide(10, 1, &line, &[10.0, 10.25, 11.75, 12.0]);
    assert_eq!((knots.len(), states), (2, vec![1, 1, 0]));
    // the part after a kink at 10.5
    let kink = |t: f64| if t <= 10.5 { [0.0, 0.0] } else { [t - 10.5, 1.0] };
    let (_, states) = divide(10, 1, &kink, &[10.0, 10.25, 10.5, 10.52]);
    assert!(states[1] == 0 && states[2] > 0, "{states:?}");
    assert_eq!(divide(0, 1, &kink, &[10.0, 10.25, 11.0]).1, [0, 0]);
}

/// Smooth parts that are too long for cubics need states of their own only until three parts before them show the motion;
/// the states that are found so are the motion's.
#[test]
fn a_motion_is_continued() {
    let sine = |t: f64| [(0.8 * t).sin(), 0.8 * (0.8 * t).cos()];
    let times: Vec<f64> = [0.0, 0.14, 0.28, 0.38, 0.52, 0.66, 0.74, 0.86, 1.0].into();
    for moved in [1, 3, 5] {
        let (knots, states) = divide(10, moved, &sine, &times);
        assert!(states[..2].iter().all(|count| *count >= 3), "{states:?}");
        assert!(states[3..].iter().all(|count| *count == 0), "{states:?}");
        assert!(knots.len() > 4, "{knots:?}");
    }
    // a kink at 0.52, and a phase that starts anew
    let kink = |t: f64| if t <= 0.52 { sine(t) } else { [sine(0.52)[0] + (t - 0.52) * sine(0.52)[1], sine(0.52)[1]] };
    let bent = |t: f64| [kink(t)[0] + 2.0 * (t - 0.52).max(0.0).powi(2), kink(t)[1] + 4.0 * (t - 0.52).max(0.0)];
    let (_, states) = divide(10, 1, &|t| if t <= 0.52 { sine(t) } else { bent(t) }, &times);
    assert!(states[3] == 0 && states[4] > 0, "{states:?}");
}

/// Where a part is short beside the next one, as where a step ends just before a row, its ends show nothing of the motion
/// beyond: their differences are rounded.
#[test]
fn parts_that_are_too_short_to_continue() {
    for k in 0..3000_u32 {
        let short = 1e-12 * 1.009_f64.powf(f64::from(k));
        let (rate, phase) = (0.3, 1.7 * f64::from(k));
        let motion = |t: f64| [f64::sin(rate * t + phase), rate * f64::cos(rate * t + phase)];
        for before in [&[0.0, 0.25][..], &[0.2, 0.25], &[0.1, 0.2, 0.25]] {
            let last = before[before.len() - 1];
            divide(10, 3, &motion, &[before, &[last + short, last + short + 0.005]].concat());
        }
    }
}

/// A quartic c t⁴ has the fourth derivative 24 c, and the interpolant over h is off by c h⁴/16: by 10⁻⁸ m at most it needs no state.
/// The bound is for all entries, of which a unit is up to the reach.
#[test]
fn parts_of_small_fourth_derivatives_need_no_states() {
    for (moved, metres) in METRES.iter().enumerate() {
        // a larger one is compared, and bisected where it is a yaw's or an angle's
        for (part, states) in [(0.99, 0), (1.01, if *metres < REACH { 1 } else { 3 })] {
            let c = part * 16e-8 / 0.5_f64.powi(4) / REACH;
            let motion = |t: f64| [c * (t - 2.0).powi(4), 4.0 * c * (t - 2.0).powi(3)];
            let (knots, found) = divide_bounded(&|_| 24.0 * c, 10, moved, &motion, &[2.0, 2.5]);
            assert_eq!((knots.len(), found[0]), (if states < 3 { 2 } else { 3 }, states), "{moved} {part}");
        }
    }
    // those after them are as if the motion began there
    let sine = |t: f64| [(0.8 * t).sin(), 0.8 * (0.8 * t).cos()];
    let times = [0.0, 0.01, 0.02, 0.16, 0.30];
    let (_, states) = divide_bounded(&|from| if from < 0.015 { 0.5 } else { f64::INFINITY }, 10, 1, &sine, &times);
    assert!(states[..2] == [0, 0] && states[2..].iter().all(|count| *count >= 3), "{states:?}");
}

/// What no cubic follows is bisected so often and no more, and never into intervals without a length.
#[test]
fn bisections_have_an_end() {
    let rough = |t: f64| [(1e9 * t).sin(), 0.0];
    for divisions in [1, 2, 3, 7] {
        let (knots, _) = divide(divisions, 2, &rough, &[2.0, 2.5]);
        assert_eq!(knots.len() - 1, 1 << divisions, "{knots:?}");
    }
    let (knots, _) = divide(10, 2, &|t: f64| [(1e20 * (t - 1.0)).sin(), 0.0], &[1.0, 1.0 + 4.0 * f64::EPSILON]);
    assert!(knots.len() == 5 && knots.is_sorted_by(|a, b| a < b), "{knots:?}");
}
