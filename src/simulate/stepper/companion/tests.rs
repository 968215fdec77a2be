//! The estimated path error is what Richardson's extrapolation gives of two simulations, for every integrator.

use crate::control::{Control, ZeroTorque};
use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::owned::{CloneModel, RobotState};
use crate::registry;
use crate::simulate::event::NoEvents;
use crate::simulate::stepper::{Formulation, Integration, Integrator};
use crate::simulate::system::{Body, System};
use crate::simulate::{Phase, Sample, Timing, simulate};
use crate::state::State;
use planar_proof::{assert_close, layout, tolerance};

/// A constant torque, held for a step; refuses all times but multiples of `refuses`, s.
struct Held {
    refuses: Option<f64>,
    is_held: bool,
}

impl Control<f64> for Held {
    fn joint_torques(
        &mut self,
        time: f64,
        _: &AnyModel<f64>,
        _: &State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        torques.fill(0.02);
        match self.refuses {
            Some(step) if (time / step).fract() != 0.0 => Err(Error::StateVector { found: 0 }),
            _ => Ok(()),
        }
    }

    fn held_steps(&self) -> Option<u32> {
        self.is_held.then_some(1)
    }
}

fn model() -> Box<dyn CloneModel> {
    registry::generic(&layout("single_arm_2r"))
}

fn initial() -> RobotState {
    RobotState {
        base_pose: [0.2, -0.4, 0.7],
        joint_angles: vec![0.4, -0.9],
        base_twist: [0.3, 0.2, -0.1],
        joint_rates: vec![-1.2, 2.5],
    }
}

fn run(integrator: Integrator, law: &mut dyn Control<f64>, from: &RobotState, [duration, step]: [f64; 2]) -> Phase {
    let model = model();
    let bodies = [Body { mass: 1.0, inertia: 1.0, pose: [0.1, 3.0, 4.0], twist: [0.5, -0.3, 0.2] }];
    let system = System { bodies: &bodies, ..System::alone(&*model) };
    let integration = Integration { integrator, coordinates: Formulation::Full };
    let timing = Timing { duration, step, sample: step, integration };
    simulate(&system, law, from, &timing, &mut NoEvents, &mut || ()).expect("a phase")
}

/// The largest difference of the positions at each of some samples and the same of others.
fn largest<'a>(some: impl Iterator<Item = &'a Sample>, others: impl Iterator<Item = &'a Sample>) -> f64 {
    let positions = |sample: &Sample| [&sample.state.base_pose[..], &sample.state.joint_angles].concat();
    let differences = some.zip(others).flat_map(|(a, b)| {
        let pairs: Vec<_> = positions(a).into_iter().zip(positions(b)).collect();
        pairs.into_iter().map(|(a, b)| (a - b).abs())
    });
    differences.fold(0.0, f64::max)
}

const STEP: f64 = 0.125;
const FIXED: [(Integrator, f64); 3] =
    [(Integrator::RungeKutta4, 16.0), (Integrator::SemiImplicitEuler, 2.0), (Integrator::GaussLegendre, 64.0)];

fn check(name: &str, found: f64, expected: f64) {
    assert!(expected > 1e-8, "{name}: {expected}");
    // momenta are kept between the steps of one solution, and rounded between two phases
    assert_close(name, &[found / expected], &[1.0], tolerance::SAME_STEPS / expected);
}

/// Steps of double length, and a last one without a pair against two of half its length.
#[test]
fn fixed_steps_are_compared_with_double_ones() {
    for (integrator, growth) in FIXED {
        for steps in [1.0, 4.0, 5.0] {
            let found = run(integrator, &mut ZeroTorque, &initial(), [steps * STEP, STEP]);
            let pairs = 2.0 * f64::floor(0.5 * steps);
            let (mut expected, mut state) = (0.0, initial());
            if pairs > 0.0 {
                let double = run(integrator, &mut ZeroTorque, &initial(), [pairs * STEP, 2.0 * STEP]);
                expected = largest(found.samples.iter().step_by(2), double.samples.iter()) / (growth - 1.0);
                state = double.end().state.clone();
            }
            if pairs < steps {
                let [one, two] = [STEP, 0.5 * STEP].map(|step| run(integrator, &mut ZeroTorque, &state, [STEP, step]));
                let difference = largest([one.end()].into_iter(), [two.end()].into_iter());
                expected += difference * growth / (growth - 1.0);
            }
            check(&format!("{integrator:?}, {steps} steps"), found.path_error, expected);
        }
    }
}

/// Torques that are held: steps of half the length.
#[test]
fn held_torques_are_compared_with_half_steps() {
    for (integrator, growth) in FIXED {
        let mut law = Held { refuses: None, is_held: true };
        let [found, half] = [STEP, 0.5 * STEP].map(|step| run(integrator, &mut law, &initial(), [5.0 * STEP, step]));
        let expected = largest(found.samples.iter(), half.samples.iter().step_by(2)) * growth / (growth - 1.0);
        check(&format!("{integrator:?}"), found.path_error, expected);
    }
}

/// Adaptive steps: a tenth of the difference from those of a tolerance a hundred times as large.
#[test]
fn adaptive_steps_are_compared_with_looser_ones() {
    let [found, looser] = [1e-7, 1e-5]
        .map(|tolerance| run(Integrator::Adaptive { tolerance }, &mut ZeroTorque, &initial(), [20.0 * STEP, STEP]));
    check("adaptive", found.path_error, 0.1 * largest(found.samples.iter(), looser.samples.iter()));
}

/// A second solution that cannot be continued leaves an error that no phase passes with, and the phase itself alone.
#[test]
fn a_lost_companion_is_an_objection() {
    for (is_held, steps) in [(true, 4.0), (true, 5.0), (false, 1.0), (false, 5.0)] {
        // its only stage is at the start of a step
        let run = |refuses| {
            run(Integrator::SemiImplicitEuler, &mut Held { refuses, is_held }, &initial(), [steps * STEP, STEP])
        };
        let (lost, kept) = (run(Some(STEP)), run(None));
        assert_eq!(lost.path_error.to_bits(), f64::to_bits(1.0), "{is_held} {steps}");
        assert!(kept.path_error < 0.5 && kept.samples == lost.samples, "{is_held} {steps}: {}", kept.path_error);
    }
}
