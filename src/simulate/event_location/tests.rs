//! The cost of locating events, and values that only touch zero.

use super::{EventLocator, StateAt};
use crate::error::Error;
use crate::owned::{CloneModel, RobotState};
use crate::registry;
use crate::simulate::event::{EventState, Events};
use crate::simulate::path::PathInterval;
use crate::simulate::system::System;
use planar_proof::layout;
use std::f64::consts::FRAC_PI_4;

/// A value as a function of time.
type Value = fn(f64) -> f64;

/// A value of time alone that counts how often it is evaluated.
struct Counted<'a> {
    value: &'a dyn Fn(f64) -> f64,
    evaluations: u32,
}

impl Events for Counted<'_> {
    fn count(&self) -> usize {
        1
    }

    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        self.evaluations += 1;
        values[0] = (self.value)(now.time);
        Ok(())
    }
}

fn robot() -> (Box<dyn CloneModel>, RobotState) {
    let zeros = vec![0.0; 2];
    let start =
        RobotState { base_pose: [0.0; 3], joint_angles: zeros.clone(), base_twist: [0.0; 3], joint_rates: zeros };
    (registry::generic(&layout("single_arm_2r")), start)
}

/// The event in a step of these times, and the number of evaluations but the three at each end of the step.
fn locate(value: &dyn Fn(f64) -> f64, span: [f64; 2]) -> (Option<f64>, u32) {
    let (model, start) = robot();
    let system = System::alone(&*model);
    let x = system.vector(&start.view()).expect("a vector");
    let rate = vec![0.0; x.len()];
    let mut events = Counted { value, evaluations: 0 };
    let mut locator = EventLocator::new(&system, &mut events);
    let state_at: &mut StateAt<'_> = &mut |_, into| {
        into.clone_from(&x);
        Ok(())
    };
    locator.start(span[0], span[1] - span[0], &x, &rate).expect("values");
    let found = locator.end_step(span, &x, &rate, state_at).expect("values");
    (found.map(|(_, time)| time), events.evaluations - 6)
}

/// The root of a smooth value takes few evaluations, that of any other no more than bisection, and three.
#[test]
fn roots_are_found_as_fast_as_by_bisection_and_faster_where_smooth() {
    let roots: [(Value, f64, bool); 10] = [
        (|t| 0.7 - t, 0.7, true),
        (|t| (2.0 * t).cos(), FRAC_PI_4, true),
        (|t| (-5.0 * t).exp() - 0.1, 10.0_f64.ln() / 5.0, true),
        (|t| (0.3 - t) * (1.0 + t).powi(3), 0.3, true),
        (|t| 1e6 * (0.35 - t) * (2.0 + (9.0 * t).sin()), 0.35, true),
        (|t| if t < 0.300_7 { 1e-9 } else { -1.0 }, 0.300_7, false),
        (|t| if t < 0.300_7 { 1.0 } else { -1e-9 }, 0.300_7, false),
        (|t| if t < 0.977 { 1.0 } else { -1.0 }, 0.977, false),
        (|t| if t < 0.013 { 1.0 } else { -1.0 }, 0.013, false),
        (|t| (0.6 - t).cbrt(), 0.6, false),
    ];
    for (value, expected, is_smooth) in roots {
        for (start, length) in [(0.0, 1.0), (100.0, 0.5), (0.0, 0.002)] {
            let (found, evaluations) = locate(&|time| value((time - start) / length), [start, start + length]);
            let (when, tolerance) = (found.expect("a root"), 1e-13 * f64::max(1.0, start + length));
            let expected = start + length * expected;
            assert!((when - expected).abs() <= 1.2 * tolerance, "{when}, not {expected}: {:e}", when - expected);
            let most = if is_smooth { 12.0 } else { (length / tolerance).log2().ceil() + 3.0 };
            assert!(f64::from(evaluations) <= most, "{expected}: {evaluations} evaluations");
        }
    }
}

/// A dip that does not reach zero is none; one that does is found. The search ends at half the digits of the time.
#[test]
fn dips_within_a_step() {
    const SEARCH: u32 = 42;
    for (span, lowest) in [([0.0, 1.0], 0.6), ([0.5, 0.7], 0.6), ([0.55, 0.65], 0.6), ([10.0, 20.0], 13.0)] {
        let (found, evaluations) = locate(&|t: f64| (t - 0.6).powi(2) * (t - 13.0).powi(2) + 1e-12, span);
        assert!(found.is_none() && evaluations <= SEARCH, "{span:?}: {found:?} by {evaluations} evaluations");
        let (found, evaluations) = locate(&|t: f64| (t - 0.6).powi(2) * (t - 13.0).powi(2) - 1e-12, span);
        let (when, expected) = (found.expect("a dip"), lowest - 1e-6 / 12.4);
        assert!((when - expected).abs() < 1e-13 * span[1].max(10.0), "{span:?}: {when}, not {expected}");
        assert!(evaluations <= 2 * SEARCH, "{span:?}: {evaluations} evaluations");
    }
    // below zero for a fifth of a microsecond, late
    let (found, _) = locate(&|t: f64| (t - 100.3).powi(2) - 1e-14, [100.0, 100.5]);
    assert!(found.is_some_and(|when| (when - 100.3).abs() < 1.1e-7), "{found:?}");
    // rates are those at the ends of the step, not the change over it or about it
    for (start, length) in [(0.0, 1.0), (500.0, 1.0), (0.0, 0.001)] {
        for (lowest, beyond) in [(0.6, -1.1), (0.4, 2.1)] {
            let value = |time: f64| {
                let t = (time - start) / length;
                ((t - lowest) * (t - beyond)).powi(2) - 1e-12
            };
            let (found, _) = locate(&value, [start, start + length]);
            let expected = start + lowest * length;
            assert!(found.is_some_and(|when| (when - expected).abs() < 1e-6), "{start} {length}: {found:?}");
        }
    }
}

/// A value whose rate is zero at an end of the step has no dip between: nothing is searched.
#[test]
fn no_search_from_a_minimum() {
    assert_eq!(locate(&|t: f64| 1.0 + t * t, [0.0, 1.0]), (None, 0));
    assert_eq!(locate(&|t: f64| 1.0 + t * t, [-1.0, 0.0]), (None, 0));
    assert_eq!(locate(&|t: f64| 1.0 + t, [0.0, 1.0]), (None, 0));
}

/// Values that fall to zero at these times, with brackets of them.
struct Bracketed(Vec<f64>);

impl Events for Bracketed {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        values.iter_mut().zip(&self.0).for_each(|(value, zero)| *value = zero - now.time);
        Ok(())
    }

    fn are_bounded(&self) -> bool {
        true
    }

    fn crossings(&mut self, step: &PathInterval<'_>) -> Result<Vec<Option<[f64; 2]>>, Error> {
        let [start, end] = step.span;
        Ok(self.0.iter().map(|zero| (*zero <= end).then_some([start, end])).collect())
    }
}

/// The first of several bracketed crossings ends the step, of simultaneous ones that with the lower index.
#[test]
fn the_first_of_several_brackets() {
    let (model, start) = robot();
    let system = System::alone(&*model);
    let x = system.vector(&start.view()).expect("a vector");
    for (times, expected) in [
        (vec![0.7, 0.203_4, 0.5], Some((1, 0.203_4))),
        (vec![0.203_4, 0.7, 2.0], Some((0, 0.203_4))),
        (vec![0.9, 0.25, 0.25], Some((1, 0.25))),
        (vec![2.0, 3.0], None),
    ] {
        let mut events = Bracketed(times);
        let mut locator = EventLocator::new(&system, &mut events);
        let step = PathInterval::between([0.0, 1.0], &x, &x).expect("a step");
        let state_at: &mut StateAt<'_> = &mut |_, into| {
            into.clone_from(&x);
            Ok(())
        };
        let found = locator.end_bounded_step(&step, state_at).expect("values");
        match (found, expected) {
            (Some((event, when)), Some((first, time))) => {
                assert!(event == first && f64::abs(when - time) <= 1e-13, "{event} {when}");
            }
            _ => assert_eq!(found, expected),
        }
    }
}
