//! The estimated error of a path against its true error, for motions that conserve everything and end elsewhere.

use crate::{run, scenario, summary};
use planar_capture::capture::Study;
use planar_capture::scenario::{FinalRates, Scenario, Tracking};
use planar_capture::simulate::stepper::{Formulation, Integration, Integrator};
use planar_capture::trajectory::TrajectoryKind;

const FULL: Formulation = Formulation::Full;

/// An approach without torques from these rates, rad/s.
pub fn free(rates: [f64; 3], duration: f64, step: f64, integrator: Integrator) -> Scenario {
    let mut scenario = scenario("redysim_single_arm_3r");
    scenario.initial.joint_angles = vec![0.3, -0.9, 0.6];
    scenario.initial.joint_rates = rates.to_vec();
    scenario.approach.duration = duration;
    scenario.approach.step = step;
    scenario.approach.end = FinalRates::JointRates(vec![0.0; 3]);
    scenario.approach.tracking =
        Tracking::ProportionalDerivative { proportional_gain: vec![0.0; 3], derivative_gain: vec![0.0; 3] };
    scenario.approach.integration = Integration { integrator, coordinates: FULL };
    scenario
}

fn positions(study: &Study) -> Vec<f64> {
    let state = &study.approach.end().state;
    [&state.base_pose[..], &state.joint_angles].concat()
}

fn true_error(found: &Study, exact: &Study) -> f64 {
    planar_proof::difference(&positions(found), &positions(exact))
}

/// At least a third of the error, and within a factor of a hundred, from rounding to where the path is lost.
#[test]
fn the_estimate_is_of_the_size_of_the_error() {
    let mut seen = [0; 2];
    for rates in [[0.6, -0.8, 0.5], [2.0, -3.0, 4.0], [8.0, -5.0, 3.0]] {
        let exact = run(&free(rates, 20.0, 0.01, Integrator::Adaptive { tolerance: 1e-13 }));
        for (integrator, step) in [
            (Integrator::RungeKutta4, 0.01),
            (Integrator::RungeKutta4, 0.005),
            (Integrator::RungeKutta4, 0.0025),
            (Integrator::GaussLegendre, 0.02),
            (Integrator::GaussLegendre, 0.005),
            (Integrator::SemiImplicitEuler, 0.001),
            (Integrator::Adaptive { tolerance: 1e-6 }, 0.01),
            (Integrator::Adaptive { tolerance: 1e-10 }, 0.01),
        ] {
            let study = run(&free(rates, 20.0, step, integrator));
            let (error, estimate) = (true_error(&study, &exact), study.approach.path_error);
            let name = format!("{rates:?} rad/s, {integrator:?}, {step} s: error {error:e}, estimate {estimate:e}");
            let is_adaptive = integrator.properties().is_adaptive;
            // rounding is not estimated; neither is the size of the error where both solutions have lost the path
            assert!(estimate >= 0.3 * error.min(1e-2) - 1e-11, "{name}");
            if error < 1e-2 && error > 1e-9 && !is_adaptive {
                assert!(estimate <= 100.0 * error, "{name}");
                seen[0] += 1;
            }
            let over = study.audit_failures().iter().any(|failure| failure.contains("path error"));
            assert_eq!(over, estimate > 1e-4, "{name}");
            seen[1] += usize::from(over);
        }
    }
    assert!(seen[0] > 6 && seen[1] > 3, "{seen:?}");
}

/// Joints at 23 rad/s, where energy and momentum hold to 1e-10: neighbouring paths part, and the path is lost.
#[test]
fn a_path_that_is_lost_is_an_objection() {
    let study = run(&free([23.0, -23.0, 0.0], 20.0, 0.005, Integrator::Adaptive { tolerance: 1e-10 }));
    assert!(study.approach.drift.energy_error < 1e-9, "{:?}", study.approach.drift);
    let failures = study.audit_failures();
    assert!(matches!(failures.as_slice(), [one] if one.contains("approach: path error")), "{failures:?}");
}

/// Feedback damps what every step adds: the estimate does not add it up.
#[test]
fn feedback_keeps_the_estimate_small() {
    for (name, bound) in [("raina_shah_2017", 1e-8), ("redysim_single_arm_3r", 1e-9), ("stabilised_capture", 1e-9)] {
        let scenario = scenario(name);
        let study = run(&scenario);
        let error = study.approach.path_error;
        assert!(error > 0.0 && error < bound, "{name}: {error:e}");
        let value = summary(&scenario, &study);
        assert_eq!(value["cases"][0]["approach"]["path_error"].as_f64(), Some(error));
    }
}

/// Torques at their limits have kinks in time, by which steps of any order lose theirs.
#[test]
fn saturated_torques_have_an_error_of_lower_order() {
    let mut seen = 0;
    for limit in [0.1, 0.3, 1.0] {
        let limited = |integrator: Integrator, step: f64| {
            let mut scenario = scenario("redysim_dual_arm_3r");
            scenario.approach.actuation.torque_limits = Some(vec![limit; 6]);
            scenario.approach.tracking =
                Tracking::ComputedTorque { proportional_gain: vec![4.0; 6], derivative_gain: vec![4.0; 6] };
            (scenario.approach.duration, scenario.approach.step) = (10.0, step);
            scenario.approach.integration = Integration { integrator, coordinates: FULL };
            run(&scenario)
        };
        let exact = limited(Integrator::Adaptive { tolerance: 1e-12 }, 0.01);
        assert!(exact.approach.saturation.joints.iter().any(|time| *time > 0.1), "{:?}", exact.approach.saturation);
        for (integrator, step) in [
            (Integrator::RungeKutta4, 0.005),
            (Integrator::RungeKutta4, 0.02),
            (Integrator::GaussLegendre, 0.02),
            (Integrator::SemiImplicitEuler, 0.002),
        ] {
            let study = limited(integrator, step);
            let (error, estimate) = (true_error(&study, &exact), study.approach.path_error);
            let name = format!("{limit} N m, {integrator:?}, {step} s: error {error:e}, estimate {estimate:e}");
            assert!(error > 1e-8 && estimate >= 0.3 * error && estimate <= 100.0 * error, "{name}");
            seen += 1;
        }
    }
    assert_eq!(seen, 12);
}

/// A trajectory that ends within a step is followed to its end by steps that are divided there: a step across the jump of the
/// jerk would lose its order, and the estimate would be too small with it.
#[test]
fn a_trajectory_that_ends_within_a_step_costs_no_order() {
    let mut seen = 0;
    for (kind, share) in [(TrajectoryKind::Quintic, 0.505), (TrajectoryKind::Cycloidal, 0.313)] {
        let ending = |integrator: Integrator, step: f64| {
            let mut scenario = scenario("redysim_single_arm_3r");
            scenario.approach.trajectory = kind;
            scenario.approach.end = FinalRates::JointRates(vec![0.0; 3]);
            scenario.approach.tracking = Tracking::InverseDynamics;
            (scenario.approach.duration, scenario.approach.step) = (10.0, step);
            scenario.approach.trajectory_duration = Some(10.0 * share);
            scenario.approach.integration = Integration { integrator, coordinates: FULL };
            run(&scenario)
        };
        let exact = ending(Integrator::Adaptive { tolerance: 1e-13 }, 0.1);
        for (integrator, step, most) in [
            (Integrator::GaussLegendre, 0.1, 1e-6),
            (Integrator::GaussLegendre, 0.2, 2e-5),
            (Integrator::RungeKutta4, 0.025, 1e-6),
            (Integrator::RungeKutta4, 0.05, 2e-5),
        ] {
            let study = ending(integrator, step);
            let (error, estimate) = (true_error(&study, &exact), study.approach.path_error);
            let name = format!("{kind:?}, {integrator:?}, {step} s: error {error:e}, estimate {estimate:e}");
            assert!(error < most && estimate >= 0.3 * error - 1e-11 && estimate <= 100.0 * error.max(1e-11), "{name}");
            seen += 1;
        }
    }
    assert_eq!(seen, 8);
}

/// Errors that a law reduces have kinks in time, too.
#[test]
fn limits_within_a_law_have_an_error_of_lower_order() {
    let mut seen = 0;
    for away in [0.3, 0.5] {
        let limited = |integrator: Integrator, step: f64| {
            let mut scenario = scenario("resolved_motion_rate");
            // the arms start with rates that take the end effectors off their paths by more than the limit of errors
            scenario.initial.joint_rates = vec![away, -away, away, -away, away, away];
            scenario.approach.actuation.torque_limits = None;
            scenario.approach.actuation.steps_per_sample = None;
            (scenario.approach.duration, scenario.approach.step) = (10.0, step);
            scenario.approach.integration = Integration { integrator, coordinates: FULL };
            run(&scenario)
        };
        let exact = limited(Integrator::Adaptive { tolerance: 1e-12 }, 0.02);
        for (integrator, step) in
            [(Integrator::RungeKutta4, 0.01), (Integrator::RungeKutta4, 0.02), (Integrator::GaussLegendre, 0.02)]
        {
            let study = limited(integrator, step);
            let (error, estimate) = (true_error(&study, &exact), study.approach.path_error);
            let name = format!("{away} rad/s, {integrator:?}, {step} s: error {error:e}, estimate {estimate:e}");
            assert!(estimate >= 0.3 * error - 1e-11, "{name}");
            seen += 1;
        }
    }
    assert_eq!(seen, 6);
}

/// Torques that are held are those of the path itself; the estimate is there too.
#[test]
fn sampled_torques_have_an_estimate() {
    let mut scenario = scenario("redysim_single_arm_3r");
    scenario.approach.actuation.steps_per_sample = Some(1);
    for (step, least, most) in [(0.005, 1e-14, 1e-6), (0.04, 1e-11, 1e-2)] {
        scenario.approach.step = step;
        let error = run(&scenario).approach.path_error;
        assert!(error > least && error < most, "{error:e} at {step} s");
    }
}

/// The last step of an odd number of steps has its share, and so has a phase of one step.
#[test]
fn the_last_of_an_odd_number_of_steps_is_estimated() {
    let mut seen = 0;
    for (integrator, step) in [
        (Integrator::GaussLegendre, 0.3),
        (Integrator::GaussLegendre, 0.15),
        (Integrator::RungeKutta4, 0.15),
        (Integrator::SemiImplicitEuler, 0.05),
    ] {
        for steps in [1.0, 2.0, 3.0, 5.0] {
            let rates = [0.6, -0.8, 2.0];
            let exact = run(&free(rates, steps * step, 0.01, Integrator::Adaptive { tolerance: 1e-13 }));
            let study = run(&free(rates, steps * step, step, integrator));
            let (error, estimate) = (true_error(&study, &exact), study.approach.path_error);
            let name = format!("{steps} of {step} s, {integrator:?}: error {error:e}, estimate {estimate:e}");
            assert!(error > 1e-13 && estimate >= 0.3 * error && estimate <= 100.0 * error, "{name}");
            seen += 1;
        }
    }
    assert_eq!(seen, 16);
}

/// The motion after an impact at a set time begins with the error that the approach ends with.
#[test]
fn an_impact_hands_on_the_error_of_the_approach() {
    let mut scenario = scenario("raina_shah_2017");
    scenario.approach.step = 0.02;
    scenario.cases.truncate(1);
    let after = scenario.post_impact.as_mut().expect("a phase");
    after.integration.integrator = Integrator::Adaptive { tolerance: 1e-12 };
    let study = run(&scenario);
    let at_end = study.approach.end_error[0].iter().fold(0.0, |most: f64, error| most.max(error.abs()));
    let after = study.cases[0].capture.as_ref().expect("a capture").post_impact.path_error;
    assert!(at_end > 1e-10 && after > 0.9 * at_end, "{after:e} {at_end:e}");
}
