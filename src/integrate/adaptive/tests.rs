//! Steps against those of the crate that the tables are from, solutions that are known, and fast feedback.

use super::{Adaptive, Motion};
use crate::error::Error;
use differential_equations::interpolate::Interpolation;
use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};

/// Integrates to the end with steps of its own, and returns x there.
fn solve(solver: &mut Adaptive, start: &[f64], end: f64, mut motion: impl Motion) -> Result<Vec<f64>, Error> {
    let mut x = start.to_vec();
    solver.start(0.0, end, start, &mut motion)?;
    let mut time = 0.0;
    while time < end {
        time = solver.advance([time, end], &mut x, &mut motion)?;
    }
    Ok(x)
}

/// Two bodies about each other on an ellipse of eccentricity 0.6: [x, y, vx, vy].
#[allow(clippy::unnecessary_wraps, reason = "a motion")]
fn orbit(_: f64, x: &[f64], rate: &mut [f64]) -> Result<(), Error> {
    let cubed = libm::pow(x[0] * x[0] + x[1] * x[1], 1.5);
    rate.copy_from_slice(&[x[2], x[3], -x[0] / cubed, -x[1] / cubed]);
    Ok(())
}

const PERIAPSIS: [f64; 4] = [0.4, 0.0, 0.0, 2.0];

/// ẋ = λ (cos t − x) − sin t, whose solution from 1 is cos t: feedback that follows a motion (Prothero & Robinson 1974).
fn feedback(gain: f64) -> impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), Error> {
    move |time, x, rate| {
        rate[0] = gain * (libm::cos(time) - x[0]) - libm::sin(time);
        Ok(())
    }
}

/// The same as problems of the crate.
struct Orbit;

impl ODE<f64, [f64; 4]> for Orbit {
    fn diff(&self, time: f64, x: &[f64; 4], rate: &mut [f64; 4]) {
        orbit(time, x, rate).expect("an orbit");
    }
}

struct Feedback(f64);

impl ODE<f64, [f64; 1]> for Feedback {
    fn diff(&self, time: f64, x: &[f64; 1], rate: &mut [f64; 1]) {
        feedback(self.0)(time, x, rate).expect("feedback");
    }
}

/// There is no step before it to continue; it ends, as the time that is asked for is as far as it is long.
#[test]
fn the_first_step_with_feedback_is_that_of_the_crate() {
    let mut ours = Adaptive::with_feedback(1e-9);
    ours.start(0.0, 5.0, &PERIAPSIS, &mut orbit).expect("a start");
    let mut x = [0.0; 4];
    ours.advance([0.0, 5.0], &mut x, &mut orbit).expect("a step");
    let [_, reached] = ours.span;
    let mut theirs = ExplicitRungeKutta::dop853().rtol(1e-6).atol(1e-6).h0(reached);
    theirs.init(&Orbit, 0.0, 5.0, &PERIAPSIS).expect("a start");
    theirs.step(&Orbit).expect("a step");
    assert!((reached - theirs.t()).abs() < 1e-15 && reached > 1e-4, "{reached} {}", theirs.t());
    // its interpolant is another one, of lower order
    let largest = ours.x().iter().zip(theirs.y()).fold(0.0, |most: f64, (x, expected)| most.max((x - expected).abs()));
    assert!(largest < 1e-14, "{largest:e}");
}

/// There is no step before it to continue.
#[test]
fn the_first_step_is_that_of_the_crate() {
    let mut theirs = ExplicitRungeKutta::rkv989e().rtol(1e-9).atol(1e-9);
    theirs.init(&Orbit, 0.0, 5.0, &PERIAPSIS).expect("a start");
    theirs.step(&Orbit).expect("a step");
    let end = theirs.t();
    let mut ours = Adaptive::new(1e-9);
    ours.start(0.0, 5.0, &PERIAPSIS, &mut orbit).expect("a start");
    let mut x = [0.0; 4];
    // so early that the step does not end there
    ours.advance([0.0, 1e-3], &mut x, &mut orbit).expect("a step");
    let [_, reached] = ours.span;
    assert!((reached - end).abs() < 1e-12 * end, "{reached} {end}");
    for part in [0.1, 0.5, 0.9, 1.0] {
        ours.interpolate(part * end, &mut x, &mut orbit).expect("within");
        let expected = theirs.interpolate(part * end).expect("within");
        let largest = x.iter().zip(expected).fold(0.0, |most: f64, (x, expected)| most.max((x - expected).abs()));
        // the first steps differ by the rounding of their length
        assert!(largest < 5e-12, "{part}: {largest:e}");
    }
}

#[test]
fn the_error_is_the_tolerance() {
    let period = std::f64::consts::TAU;
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        let mut solver = Adaptive::new(tolerance);
        let x = solve(&mut solver, &PERIAPSIS, period, orbit).expect("an orbit");
        let largest = x.iter().zip(PERIAPSIS).fold(0.0, |most: f64, (x, start)| most.max((x - start).abs()));
        // an error along the orbit grows with the speed at the periapsis and the number of steps
        assert!(largest < 100.0 * tolerance, "{tolerance:e}: {largest:e}");
        assert!(largest > 1e-4 * tolerance, "{tolerance:e}: {largest:e}, by steps that are too short");
    }
}

/// Between the ends of steps x is as exact as there.
#[test]
fn the_interpolant_is_as_exact_as_the_steps() {
    let mut motion = feedback(2.0);
    let (mut solver, mut x) = (Adaptive::new(1e-10), [1.0]);
    solver.start(0.0, 20.0, &x, &mut motion).expect("a start");
    let (mut time, mut count) = (0.0, 0);
    while time < 20.0 {
        let next = solver.advance([time, 20.0], &mut x, &mut motion).expect("a step");
        for part in [0.01, 0.3, 0.7, 0.99] {
            let within = time + part * (next - time);
            solver.interpolate(within, &mut x, &mut motion).expect("within");
            assert!((x[0] - libm::cos(within)).abs() < 1e-9, "{within}: {:e}", x[0] - libm::cos(within));
            count += 1;
        }
        time = next;
    }
    assert!(count > 40, "{count}");
}

/// Of cos t and a motion by the square of time the fourth derivatives are cos t and 0; it is known where an interpolant is.
#[test]
fn the_fourth_derivative_is_bounded() {
    let mut motion = |time: f64, x: &[f64], rate: &mut [f64]| {
        rate.copy_from_slice(&[2.0 * (libm::cos(time) - x[0]) - libm::sin(time), 3.0 * time]);
        Ok(())
    };
    let (mut solver, mut x) = (Adaptive::new(1e-10), [1.0, 0.0]);
    solver.start(0.0, 20.0, &x, &mut motion).expect("a start");
    let (mut time, mut count) = (0.0, 0);
    while time < 20.0 {
        let next = solver.advance([time, 20.0], &mut x, &mut motion).expect("a step");
        assert!(solver.fourth_derivative().is_infinite(), "none within the step was asked for");
        solver.interpolate(f64::midpoint(time, next), &mut x, &mut motion).expect("within");
        let cosines = (0..=64).map(|i| libm::cos(time + f64::from(i) / 64.0 * (next - time)).abs());
        let largest = cosines.fold(0.0, f64::max);
        let ratio = solver.fourth_derivative() / largest;
        assert!((1.0 - 1e-6..1.6).contains(&ratio), "{time} to {next}: {ratio}");
        (time, count) = (next, count + 1);
    }
    assert!(count > 10, "{count}");
}

/// At times that are farther apart than steps these end, so that no interpolant is needed; between nearer ones they go on.
#[test]
fn steps_end_at_requested_times() {
    for (gain, spacing, of_interpolant) in [(20.0, 0.5, 0), (20.0, 0.05, 9), (1.0, 3.0, 0), (1.0, 0.25, 9)] {
        let mut evaluations = 0;
        let mut motion = |time: f64, x: &[f64], rate: &mut [f64]| {
            evaluations += 1;
            feedback(gain)(time, x, rate)
        };
        let (mut solver, mut x, mut time) = (Adaptive::new(1e-10), [1.0], 0.0);
        solver.start(0.0, 30.0, &x, &mut motion).expect("a start");
        let mut next = spacing;
        while time < 30.0 {
            time = solver.advance([time, next], &mut x, &mut motion).expect("a step");
            assert!((x[0] - libm::cos(time)).abs() < 1e-9, "{time}: {:e}", x[0] - libm::cos(time));
            next = if time >= next { (next + spacing).min(30.0) } else { next };
        }
        // two for the first step; a rejected one takes one less
        let most = 2 + (16 + of_interpolant) * solver.attempts();
        let least = (15 + of_interpolant / 2) * solver.attempts();
        assert!(
            (least..=most).contains(&evaluations),
            "{gain} {spacing}: {evaluations} of {} steps",
            solver.attempts()
        );
    }
}

/// Where feedback is faster than the motion, continuing the last step saves half of the steps of the method alone and
/// more, at no cost of accuracy.
#[test]
fn fast_feedback_takes_few_steps() {
    for gain in [20.0, 50.0] {
        let mut solver = Adaptive::new(1e-10);
        let x = solve(&mut solver, &[1.0], 20.0, feedback(gain)).expect("feedback");
        assert!((x[0] - libm::cos(20.0)).abs() < 1e-10, "{:e}", x[0] - libm::cos(20.0));
        let mut theirs = ExplicitRungeKutta::rkv989e().rtol(1e-10).atol(1e-10);
        theirs.init(&Feedback(gain), 0.0, 20.0, &[1.0]).expect("a start");
        let mut steps = 0;
        while theirs.t() < 20.0 {
            theirs.step(&Feedback(gain)).expect("a step");
            steps += 1;
        }
        assert!(2 * solver.attempts() < steps, "{} of {steps}", solver.attempts());
    }
}

/// Between times that are as far apart as the steps, the pair for feedback takes fewer evaluations of feedback that is fast, to
/// the same accuracy; between near ones it is the other.
#[test]
fn feedback_takes_fewer_evaluations_by_its_pair() {
    for (gain, spacing, [least, most]) in
        [(20.0, 0.5, [0.4, 0.75]), (50.0, 0.25, [0.4, 0.75]), (20.0, 0.02, [0.98, 1.0])]
    {
        let evaluations = [Adaptive::new(1e-10), Adaptive::with_feedback(1e-10)].map(|mut solver| {
            let mut count = 0.0;
            let mut motion = |time: f64, x: &[f64], rate: &mut [f64]| {
                count += 1.0;
                feedback(gain)(time, x, rate)
            };
            let (mut x, mut time, mut row) = ([1.0], 0.0, 1.0_f64);
            solver.start(0.0, 40.0, &x, &mut motion).expect("a start");
            while time < 40.0 {
                let wanted = (row * spacing).min(40.0);
                time = solver.advance([time, wanted], &mut x, &mut motion).expect("a step");
                assert!((x[0] - libm::cos(time)).abs() < 1e-9, "{gain} {time}: {:e}", x[0] - libm::cos(time));
                row += if time >= wanted { 1.0 } else { 0.0 };
            }
            count
        });
        let ratio = evaluations[1] / evaluations[0];
        assert!((least..=most).contains(&ratio), "{gain} {spacing}: {evaluations:?}");
    }
}

/// What is unstable at the steps that the accuracy allows is limited by its stability, and stays accurate.
#[test]
fn stiff_feedback_is_accurate() {
    for gain in [1e3, 1e4] {
        let mut solver = Adaptive::new(1e-8);
        let x = solve(&mut solver, &[1.0], 2.0, feedback(gain)).expect("feedback");
        assert!((x[0] - libm::cos(2.0)).abs() < 1e-8, "{gain}: {:e}", x[0] - libm::cos(2.0));
        #[allow(clippy::cast_precision_loss, reason = "a small number")]
        let product = gain * 2.0 / solver.attempts() as f64;
        assert!(product > 2.0, "{gain}: steps of {product} time constants");
    }
}

/// A step that cannot be short enough, and an x that overflows, are errors and no results.
#[test]
fn what_cannot_be_integrated_is_an_error() {
    let blow_up = |_: f64, x: &[f64], rate: &mut [f64]| {
        rate[0] = x[0] * x[0];
        Ok(())
    };
    let mut solver = Adaptive::new(1e-9);
    let found = solve(&mut solver, &[1.0], 2.0, blow_up);
    assert!(matches!(found, Err(Error::Tolerance { tolerance: 1e-9, step }) if step < 1e-9), "{found:?}");
    let undefined = |time: f64, _: &[f64], rate: &mut [f64]| {
        rate[0] = (0.5 - time).sqrt();
        Ok(())
    };
    let mut solver = Adaptive::new(1e-9);
    assert!(matches!(solve(&mut solver, &[1.0], 2.0, undefined), Err(Error::Tolerance { .. })));
}

/// A sampled law's torques change at the end of a part: the next one is tried with the length of the steps before.
#[test]
fn a_new_start_remembers_the_length_of_steps() {
    let mut solver = Adaptive::new(1e-9);
    let mut motion = feedback(2.0);
    solve(&mut solver, &[1.0], 10.0, &mut motion).expect("feedback");
    let before = solver.attempts();
    let mut x = [1.0];
    solver.start(0.0, 10.0, &[1.0], &mut motion).expect("a start");
    let reached = solver.advance([0.0, 10.0], &mut x, &mut motion).expect("a step");
    assert!(solver.attempts() - before <= 3 && reached > 0.05, "{reached}");
}

/// Rest until 0.1 s, then a fast decay, which is defined for |x| ≤ 1.5 only: the long steps of the rest leave that, and are rejected
/// like others that are too long. Where no step is short enough, the reason is that of the motion.
#[test]
fn a_step_that_leaves_what_the_motion_is_defined_for_is_rejected() {
    const GAIN: f64 = 1e3;
    let undefined = || Error::NotFinite { quantity: "rate", index: 0, value: f64::NAN };
    let mut solver = Adaptive::new(1e-10);
    let mut left = 0;
    let decay = |time: f64, x: &[f64], rate: &mut [f64]| {
        if x[0].abs() > 1.5 {
            left += 1;
            return Err(undefined());
        }
        rate[0] = if time < 0.1 { 0.0 } else { -GAIN * x[0] };
        Ok(())
    };
    let end = solve(&mut solver, &[1.0], 0.11, decay).expect("a solution");
    assert!(left > 0, "no stage left it: nothing is tested");
    assert!((end[0] - libm::exp(-10.0)).abs() < 1e-8, "{end:?}");

    let broken = |time: f64, _: &[f64], rate: &mut [f64]| {
        rate[0] = 1.0;
        if time > 0.05 { Err(undefined()) } else { Ok(()) }
    };
    let found = solve(&mut solver, &[1.0], 0.11, broken);
    assert!(matches!(found, Err(Error::NotFinite { quantity: "rate", .. })), "{found:?}");
}

/// f may be another one after the end and before the start: it is asked for between them.
#[test]
fn the_motion_is_asked_for_between_start_and_end() {
    for length in [1e-7, 1e-3, 0.3, 1.0, 5.3, 10.0, 20.0] {
        let (start, end) = (3.0, 3.0 + length);
        let (mut earliest, mut latest, mut follow) = (f64::INFINITY, f64::NEG_INFINITY, feedback(2.0));
        let mut motion = |time: f64, x: &[f64], rate: &mut [f64]| {
            (earliest, latest) = (time.min(earliest), time.max(latest));
            follow(time, x, rate)
        };
        let (mut solver, mut x, mut time) = (Adaptive::new(1e-10), [libm::cos(start)], start);
        solver.start(start, end, &x, &mut motion).expect("a start");
        while time < end {
            time = solver.advance([time, end], &mut x, &mut motion).expect("a step");
        }
        assert!(earliest >= start && latest <= end * (1.0 + 2.0 * f64::EPSILON), "{earliest} to {latest}, not {end}");
    }
}

/// Where x or its rate is zero at the start there is a first step, too.
#[test]
fn a_start_at_zero() {
    let from_zero = |time: f64, _: &[f64], rate: &mut [f64]| {
        rate[0] = libm::cos(time);
        Ok(())
    };
    let found = solve(&mut Adaptive::new(1e-10), &[0.0], 2.0, from_zero).expect("a solution");
    assert!((found[0] - libm::sin(2.0)).abs() < 1e-9, "{found:?}");
    let from_rest = |time: f64, _: &[f64], rate: &mut [f64]| {
        rate[0] = libm::sin(time);
        Ok(())
    };
    let found = solve(&mut Adaptive::new(1e-10), &[1.0], 2.0, from_rest).expect("a solution");
    assert!((found[0] - (2.0 - libm::cos(2.0))).abs() < 1e-9, "{found:?}");
}
