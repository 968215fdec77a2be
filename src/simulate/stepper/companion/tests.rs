//! The estimated path error is what Richardson's extrapolation gives of two simulations, for every integrator.

use super::{FREE_ORDER, MOST_DIFFERENCE, share_of};
use crate::control::{Control, ProportionalDerivative, SampledControl, ZeroTorque};
use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::owned::{CloneModel, RobotState};
use crate::registry;
use crate::simulate::event::NoEvents;
use crate::simulate::stepper::{Formulation, Integration, Integrator};
use crate::simulate::system::{Body, System};
use crate::simulate::{Phase, Sample, Timing, simulate};
use crate::state::State;
use crate::trajectory::ConstantSetpoint;
use planar_proof::{assert_close, layout, tolerance};

/// A constant torque, held for a step; refuses all times but multiples of `refuses`, s.
#[derive(Default)]
struct Constant {
    refuses: Option<f64>,
    is_held: bool,
    /// When a limit within it begins to act, s.
    limited_after: Option<f64>,
    is_limited: bool,
}

impl Control<f64> for Constant {
    fn joint_torques(
        &mut self,
        time: f64,
        _: &AnyModel<f64>,
        _: &State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        self.is_limited = self.limited_after.is_some_and(|start| time > start);
        torques.fill(0.02);
        match self.refuses {
            Some(step) if (time / step).fract() != 0.0 => Err(Error::StateVector { found: 0 }),
            _ => Ok(()),
        }
    }

    fn held_steps(&self) -> Option<u32> {
        self.is_held.then_some(1)
    }

    fn is_limited(&self) -> bool {
        self.is_limited
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
    let timing = Timing { duration, step, sample: step, integration, kink: None };
    simulate(&system, law, from, &timing, &mut NoEvents, &mut || ()).expect("a phase")
}

fn positions(sample: &Sample) -> Vec<f64> {
    [&sample.state.base_pose[..], &sample.state.joint_angles].concat()
}

/// The largest difference of the positions at each of some samples and the same of others.
fn largest<'a>(some: impl Iterator<Item = &'a Sample>, others: impl Iterator<Item = &'a Sample>) -> f64 {
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

/// Steps of two or four times the length, and for each of the last ones, which these do not follow, one of them against two of half
/// its length.
#[test]
fn fixed_steps_are_compared_with_longer_ones() {
    for (integrator, growth) in FIXED {
        let (stride, growth_of_stride) =
            if integrator == Integrator::RungeKutta4 { (4.0, growth * growth) } else { (2.0, growth) };
        for steps in [1.0, 3.0, 4.0, 5.0, 10.0] {
            let found = run(integrator, &mut ZeroTorque, &initial(), [steps * STEP, STEP]);
            let followed = stride * f64::floor(steps / stride);
            let (mut expected, mut state) = (0.0, initial());
            if followed > 0.0 {
                let longer = run(integrator, &mut ZeroTorque, &initial(), [followed * STEP, stride * STEP]);
                let every = if stride > 2.0 { 4 } else { 2 };
                let difference = largest(found.samples.iter().step_by(every), longer.samples.iter());
                expected = difference / (growth_of_stride - 1.0);
                state = longer.end().state.clone();
            }
            if followed < steps {
                let [one, two] = [STEP, 0.5 * STEP].map(|step| run(integrator, &mut ZeroTorque, &state, [STEP, step]));
                let difference = largest([one.end()].into_iter(), [two.end()].into_iter());
                let share = (steps - followed) * growth / (growth - 1.0);
                expected += share * difference;
                if followed == 0.0 {
                    // with their signs
                    let pairs = positions(one.end()).into_iter().zip(positions(two.end()));
                    let errors: Vec<f64> = pairs.map(|(one, two)| share * (one - two)).collect();
                    assert_close("at the end", &found.end_error[0], &errors, tolerance::SAME_STEPS);
                }
            }
            check(&format!("{integrator:?}, {steps} steps"), found.path_error, expected);
        }
    }
}

/// Of a motion without feedback, from fine steps to those with which the path is lost.
#[test]
fn the_estimate_without_feedback_is_of_the_size_of_the_error() {
    let duration = 64.0 * STEP;
    let exact = run(Integrator::Adaptive { tolerance: 1e-13 }, &mut ZeroTorque, &initial(), [duration, STEP]);
    let mut seen = [0; 2];
    for steps in [1024.0, 768.0, 512.0, 384.0, 256.0, 128.0, 64.0, 63.0, 62.0, 61.0, 32.0] {
        let found = run(Integrator::RungeKutta4, &mut ZeroTorque, &initial(), [duration, duration / steps]);
        let error = largest([found.end()].into_iter(), [exact.end()].into_iter());
        let name = format!("{steps} steps: error {error:e}, estimate {:e}", found.path_error);
        assert!(error > 1e-11 && found.path_error >= 0.3 * error.min(1e-2), "{name}");
        assert!(found.path_error <= 100.0 * error || error > 1e-2, "{name}");
        seen[usize::from(error > 1e-4)] += 1;
    }
    assert!(seen[0] > 3 && seen[1] > 3, "{seen:?}");
}

/// Torques that are held: steps of half the length.
#[test]
fn held_torques_are_compared_with_half_steps() {
    for (integrator, growth) in FIXED {
        let mut law = Constant { is_held: true, ..Constant::default() };
        let [found, half] = [STEP, 0.5 * STEP].map(|step| run(integrator, &mut law, &initial(), [5.0 * STEP, step]));
        let expected = largest(found.samples.iter(), half.samples.iter().step_by(2)) * growth / (growth - 1.0);
        check(&format!("{integrator:?}"), found.path_error, expected);
    }
}

/// A limit that acts within the law: the order is one, whatever the steps are of, but for torques that are held.
#[test]
fn steps_under_limits_have_the_order_one() {
    for (integrator, growth) in FIXED {
        let law = |is_held| Constant { is_held, limited_after: Some(f64::NEG_INFINITY), ..Constant::default() };
        let [found, double] =
            [STEP, 2.0 * STEP].map(|step| run(integrator, &mut law(false), &initial(), [4.0 * STEP, step]));
        let expected = largest(found.samples.iter().step_by(2), double.samples.iter());
        check(&format!("{integrator:?}"), found.path_error, expected);
        let [found, half] =
            [STEP, 0.5 * STEP].map(|step| run(integrator, &mut law(true), &initial(), [4.0 * STEP, step]));
        let expected = largest(found.samples.iter(), half.samples.iter().step_by(2)) * growth / (growth - 1.0);
        check(&format!("{integrator:?}, held"), found.path_error, expected);
    }
}

/// Adaptive steps: a tenth of the difference from those of a tolerance a hundred times as large.
#[test]
fn adaptive_steps_are_compared_with_looser_ones() {
    let both = |timing: [f64; 2]| {
        [1e-7, 1e-5].map(|tolerance| run(Integrator::Adaptive { tolerance }, &mut ZeroTorque, &initial(), timing))
    };
    let [found, looser] = both([20.0 * STEP, 20.0 * STEP]);
    check("adaptive", found.path_error, 0.1 * largest(found.samples.iter(), looser.samples.iter()));
    // with their signs, of the robot alone
    let at_end = [&found, &looser].map(|phase| {
        let state = &phase.end().state;
        [[&state.base_pose[..], &state.joint_angles].concat(), [&state.base_twist[..], &state.joint_rates].concat()]
    });
    for (i, errors) in found.end_error.iter().enumerate() {
        let expected: Vec<f64> =
            at_end[1][i].iter().zip(&at_end[0][i]).map(|(looser, found)| 0.1 * (looser - found)).collect();
        assert_close("at the end", errors, &expected, tolerance::SAME_STEPS);
        assert!(expected.iter().any(|error| error.abs() > 1e-8), "{expected:?}");
    }
}

/// Over many steps of a phase they are compared after some, which shows the error as well, and in any case where it ends.
#[test]
fn adaptive_steps_are_compared_at_the_end_of_a_phase() {
    let mut last = [const { Vec::new() }; 2];
    for steps in [19.0, 20.0, 21.0, 22.0, 23.0] {
        let [found, exact] = [1e-7, 1e-13].map(|tolerance| {
            run(Integrator::Adaptive { tolerance }, &mut ZeroTorque, &initial(), [steps * STEP, STEP])
        });
        let error = largest(found.samples.iter(), exact.samples.iter());
        assert!((0.5..30.0).contains(&(found.path_error / error)), "{steps}: {} {error}", found.path_error);
        let [of_end, exact] = [&found, &exact].map(Phase::end);
        let at_end = largest([of_end].into_iter(), [exact].into_iter());
        let estimated = found.end_error[0].iter().fold(0.0, |most: f64, error| most.max(error.abs()));
        assert!((0.2..30.0).contains(&(estimated / at_end)), "{steps}: {estimated} {at_end}");
        assert_ne!(found.end_error, last, "{steps}");
        last = found.end_error;
    }
}

/// A second solution that cannot be continued leaves an error that no phase passes with, and the phase itself alone.
#[test]
fn a_lost_companion_is_an_objection() {
    for (is_held, steps) in [(true, 4.0), (true, 5.0), (false, 1.0), (false, 5.0)] {
        // its only stage is at the start of a step
        let run = |refuses| {
            run(
                Integrator::SemiImplicitEuler,
                &mut Constant { refuses, is_held, ..Constant::default() },
                &initial(),
                [steps * STEP, STEP],
            )
        };
        let (lost, kept) = (run(Some(STEP)), run(None));
        assert_eq!(lost.path_error.to_bits(), f64::to_bits(1.0), "{is_held} {steps}");
        assert!(kept.path_error < 0.5 && kept.samples == lost.samples, "{is_held} {steps}: {}", kept.path_error);
    }
}

/// A sampled loop that is not stable: what it makes of the errors of steps is seen, and found by four times as many steps.
#[test]
fn a_sampled_law_answers_to_the_errors_of_steps() {
    let sampled = |steps_per_sample: u32| {
        let step = 0.4 / f64::from(steps_per_sample);
        let law = ProportionalDerivative {
            trajectory: ConstantSetpoint { angles: &[0.4, -0.9] },
            proportional_gain: &[0.0; 2],
            derivative_gain: &[2.0, 0.9],
        };
        let mut held = [0.0; 2];
        let mut law = SampledControl::new(law, steps_per_sample, &mut held);
        run(Integrator::RungeKutta4, &mut law, &initial(), [20.0, step])
    };
    let (coarse, fine) = (sampled(2), sampled(8));
    let every_fourth = fine.samples.iter().step_by(4);
    let error = largest(coarse.samples.iter(), every_fourth);
    let found = coarse.path_error / error;
    assert!(error > 1e-3 && (0.3..3.0).contains(&found), "{error} rad, of which the estimate is {found}");
}

/// What the motion makes of an error at its start is in the estimate, and an error at the end is handed on.
#[test]
fn an_error_at_the_start_is_followed() {
    let (model, start) = (model(), initial());
    let timing =
        Timing { duration: 10.0, step: STEP / 64.0, sample: STEP, integration: Integration::default(), kink: None };
    let small = [1e-7, 0.0, 0.0, 3e-8, -1e-7];
    let from = |state: &RobotState, start_error: [&[f64]; 2]| {
        let system = System { start_error, ..System::alone(&*model) };
        simulate(&system, &mut ZeroTorque, state, &timing, &mut NoEvents, &mut || ()).expect("a phase")
    };
    let mut beside = start.clone();
    beside.joint_rates[1] += small[4];
    beside.joint_rates[0] += small[3];
    beside.base_pose[0] += small[0];
    let errors = [&small[..1], &[0.0, 0.0, 0.0, small[3], small[4]]];
    let (given, alone, other) = (from(&start, errors), from(&start, [&[]; 2]), from(&beside, [&[]; 2]));
    let grown = largest(other.samples.iter(), alone.samples.iter());
    assert!(alone.path_error < 0.01 * grown && grown > 3e-7, "{} {grown}", alone.path_error);
    assert!((given.path_error / grown - 1.0).abs() < 0.05, "{} {grown}", given.path_error);
    let [end, other_end] = [&alone, &other].map(|phase| phase.end().state.joint_angles[1]);
    assert!((given.end_error[0][4].abs() / (end - other_end).abs() - 1.0).abs() < 0.05, "{:?}", given.end_error);
}

/// In a slow motion the second solution takes steps of eight or sixteen times the length, and is put further from the first.
#[test]
fn slow_motions_are_followed_by_longer_steps() {
    let (model, mut start) = (model(), initial());
    start.base_twist.iter_mut().chain(&mut start.joint_rates).for_each(|rate| *rate *= 0.25);
    let timing =
        Timing { duration: 10.0, step: STEP / 64.0, sample: STEP, integration: Integration::default(), kink: None };
    let from = |state: &RobotState, start_error: [&[f64]; 2]| {
        let system = System { start_error, ..System::alone(&*model) };
        simulate(&system, &mut ZeroTorque, state, &timing, &mut NoEvents, &mut || ()).expect("a phase")
    };
    for size in [1e-9, 1e-7] {
        let mut beside = start.clone();
        beside.joint_rates[1] += size;
        let (given, alone) = (from(&start, [&[], &[0.0, 0.0, 0.0, 0.0, size]]), from(&start, [&[]; 2]));
        let grown = largest(from(&beside, [&[]; 2]).samples.iter(), alone.samples.iter());
        assert!(alone.path_error < 1e-3 * grown && grown > size, "{size}: {} {grown}", alone.path_error);
        assert!((given.path_error / grown - 1.0).abs() < 0.01, "{size}: {} {grown}", given.path_error);
    }
}

/// In a fast motion they are of four times the length, also where the difference would allow longer ones.
#[test]
fn fast_motions_are_followed_by_steps_of_four_times_the_length() {
    let step = STEP / 8.0;
    let at = |step| run(Integrator::RungeKutta4, &mut ZeroTorque, &initial(), [16.0 * STEP, step]);
    let (found, longer) = (at(step), at(4.0 * step));
    let expected = largest(found.samples.iter().step_by(4), longer.samples.iter()) / 255.0;
    assert!(expected < MOST_DIFFERENCE * share_of(8.0, FREE_ORDER).abs(), "{expected}");
    check("a fast motion", found.path_error, expected);
}

/// A second phase that starts with a large error ends with what the motion makes of it, with its sign.
#[test]
fn errors_of_two_phases_have_their_signs() {
    let (model, start) = (model(), initial());
    let timing =
        Timing { duration: 2.0, step: STEP / 64.0, sample: 2.0, integration: Integration::default(), kink: None };
    let from = |state: &RobotState, start_error: [&[f64]; 2]| {
        let system = System { start_error, ..System::alone(&*model) };
        simulate(&system, &mut ZeroTorque, state, &timing, &mut NoEvents, &mut || ()).expect("a phase")
    };
    let error = [1e-6, 0.0, 0.0, 3e-7, -1e-6];
    let mut exact = start.clone();
    exact.base_pose[0] -= error[0];
    exact.joint_rates[0] -= error[3];
    exact.joint_rates[1] -= error[4];
    let found = from(&start, [&error[..1], &[0.0, 0.0, 0.0, error[3], error[4]]]);
    let exact = from(&exact, [&[]; 2]);
    let pairs = positions(found.end()).into_iter().zip(positions(exact.end()));
    let errors: Vec<f64> = pairs.map(|(found, exact)| found - exact).collect();
    let most = errors.iter().fold(0.0, |most: f64, error| most.max(error.abs()));
    assert!(most > 1e-6, "{errors:?}");
    for (estimated, error) in found.end_error[0].iter().zip(&errors) {
        assert!((estimated - error).abs() < 0.05 * most, "{:?} {errors:?}", found.end_error[0]);
    }
}

/// Where a limit begins to act the error so far stays as it is, and the order is one from there on.
#[test]
fn a_limit_that_acts_later_keeps_the_error() {
    for (integrator, growth) in [FIXED[0], FIXED[2]] {
        let half = 4.0 * STEP;
        let (mut free, mut law) = (Constant::default(), Constant { limited_after: Some(half), ..Constant::default() });
        let found = run(integrator, &mut law, &initial(), [2.0 * half, STEP]);
        let [first, double] =
            [STEP, 2.0 * STEP].map(|step| run(integrator, &mut free, &initial(), [half, step]).end().state.clone());
        let beside = |first: &[f64], double: &[f64]| -> Vec<f64> {
            first.iter().zip(double).map(|(first, double)| first - (first - double) / (growth - 1.0)).collect()
        };
        let second = RobotState {
            base_pose: beside(&first.base_pose, &double.base_pose).try_into().expect("three"),
            base_twist: beside(&first.base_twist, &double.base_twist).try_into().expect("three"),
            joint_angles: beside(&first.joint_angles, &double.joint_angles),
            joint_rates: beside(&first.joint_rates, &double.joint_rates),
        };
        let first = run(integrator, &mut free, &first, [half, STEP]);
        let second = run(integrator, &mut free, &second, [half, 2.0 * STEP]);
        let expected = largest(first.samples.iter().step_by(2), second.samples.iter());
        check(&format!("{integrator:?}"), found.path_error, expected);
    }
}
