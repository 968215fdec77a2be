//! The steps to come are counted by the mean of the last ones.
#![allow(clippy::cast_precision_loss, reason = "small whole numbers")]

use super::{AdaptiveSteps, COUNTED, Steps};
use crate::control::ZeroTorque;
use crate::error::Error;
use crate::registry;
use crate::simulate::equation::{Equation, FormulationWorkspace};
use crate::simulate::inertial_frame::InertialFrame;
use crate::simulate::system::System;
use crate::state::State;
use planar_proof::layout;

/// Of feedback that becomes faster, after as many steps as are counted, and before.
#[test]
fn steps_to_come_are_counted_by_the_last_ones() {
    const DURATION: f64 = 1e4;
    let mut steps = AdaptiveSteps::new(1e-9, DURATION, false);
    let (mut x, mut time, mut before) = ([1.0], 0.0, (0, 0.0));
    for gain in [1e5, 4e5] {
        let mut motion = |time: f64, x: &[f64], rate: &mut [f64]| {
            rate[0] = gain * (libm::cos(time) - x[0]) - libm::sin(time);
            Ok(())
        };
        if before.0 == 0 {
            steps.solver.start(time, DURATION, &x, &mut motion).expect("a start");
        }
        while steps.solver.attempts() - before.0 < COUNTED {
            assert_eq!(steps.count(time, 1.0), Ok(()), "too few");
            time = steps.solver.advance([time, DURATION], &mut x, &mut motion).expect("a step");
        }
        let attempts = steps.solver.attempts();
        let step = (time - before.1) / (attempts - before.0) as f64;
        let needed = attempts as f64 + (DURATION - time) / step;
        assert!(step > 1.0 / gain && step < 10.0 / gain, "{step}");
        for (length, most) in [(1.0, 1e6), (1e-3, 1e8), (1e-5, 1e10)] {
            steps.counted = before;
            let expected = if most < 1e9 { Err(Error::Steps { step, needed, most }) } else { Ok(()) };
            assert_eq!(steps.count(time, length), expected, "{gain} {length}");
            assert_eq!(steps.counted, (attempts, time));
        }
        before = (attempts, time);
    }
}

/// How many there may be follows from the length of a step of the phase.
#[test]
fn the_most_steps_are_of_the_steps_of_the_phase() {
    let mut steps = AdaptiveSteps::new(1e-9, 1e6, false);
    let mut motion = |time: f64, x: &[f64], rate: &mut [f64]| {
        rate[0] = 1e6 * (libm::cos(time) - x[0]) - libm::sin(time);
        Ok(())
    };
    let (mut one, mut time) = ([1.0], 0.0);
    steps.solver.start(time, 1.0, &one, &mut motion).expect("a start");
    while steps.solver.attempts() < COUNTED {
        time = steps.solver.advance([time, 1.0], &mut one, &mut motion).expect("a step");
    }
    let model = registry::generic(&layout("single_arm_2r"));
    let system = System::alone(&*model);
    let (joint_angles, joint_rates) = (&[0.4, -0.9][..], &[0.0; 2][..]);
    let at_rest = State { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates };
    let mut x = system.vector(&at_rest).expect("a vector");
    let control = InertialFrame { law: &mut ZeroTorque, origin: [0.0; 2], velocity: [0.0; 2] };
    let mut equation = Equation::new(&system, control, None, FormulationWorkspace::Full);
    let found = steps.advance(&mut equation, [10.0, 10.5], 10.0, &mut x);
    // ten in each of the 2e6 steps of the phase
    assert!(matches!(found, Err(Error::Steps { most: 2e7, .. })), "{found:?}");
}
