//! Control laws: computed torque, torque limits, sampled control.

use crate::scenario;
use planar_capture::capture::approach::ApproachTracking;
use planar_capture::control::{Control, ProportionalDerivative, TorqueLimiter};
use planar_capture::registry;
use planar_capture::scenario::{Actuation, FinalRates, Scenario, Tracking};
use planar_capture::simulate::Phase;
use planar_capture::simulate::event::NoEvents;
use planar_capture::state::State;
use planar_capture::trajectory::ConstantSetpoint;
use planar_capture::trajectory::TrajectoryKind;
use planar_proof::{assert_close, tolerance};

/// ReDySim's approach of one arm, 4 s long so that torques are tens of N m.
fn short(tracking: Tracking) -> Scenario {
    let mut scenario = scenario("redysim_single_arm_3r");
    scenario.approach.duration = 4.0;
    scenario.approach.tracking = tracking;
    scenario
}

fn pd() -> Tracking {
    Tracking::ProportionalDerivative { proportional_gain: vec![49.0; 3], derivative_gain: vec![14.0; 3] }
}

fn computed_torque() -> Tracking {
    Tracking::ComputedTorque { proportional_gain: vec![9.0, 4.0, 1.0], derivative_gain: vec![6.0, 4.0, 2.0] }
}

fn track(scenario: &Scenario, rates: &[f64]) -> Phase {
    let model = registry::generated(&scenario.layout).expect("generated code");
    ApproachTracking::new(scenario, 0.05).track(&*model, rates, &mut NoEvents, &mut || ()).expect("an approach")
}

fn end(phase: &Phase) -> (Vec<f64>, [f64; 3]) {
    let motion = &phase.end().state;
    (motion.joint_angles.clone(), motion.base_pose)
}

/// Started on the trajectory, computed torque is exact tracking.
#[test]
fn computed_torque_on_the_trajectory_is_exact_tracking() {
    let (exact, computed) = (track(&short(Tracking::InverseDynamics), &[]), track(&short(computed_torque()), &[]));
    for (exact, computed) in exact.samples.iter().zip(&computed.samples) {
        assert_close("angles", &exact.state.joint_angles, &computed.state.joint_angles, tolerance::CONTROLLED);
        assert_close("base", &exact.state.base_pose, &computed.state.base_pose, tolerance::CONTROLLED);
    }
}

/// With gains k² and 2k an initial rate error decays as r t exp(−kt), joint by joint, while the base drifts with
/// momentum.
#[test]
fn errors_under_computed_torque_decay_joint_by_joint() {
    let mut scenario = short(computed_torque());
    scenario.initial.joint_rates = vec![0.2, -0.3, 0.1];
    scenario.initial.base_twist = [0.1, 0.3, -0.2];
    let exact = track(&short(Tracking::InverseDynamics), &[]); // where the joints should be
    let phase = track(&scenario, &[]);
    for (sample, desired) in phase.samples.iter().zip(&exact.samples) {
        let errors =
            [(3.0, 0.2), (2.0, -0.3), (1.0, 0.1)].map(|(k, r): (f64, f64)| r * sample.time * (-k * sample.time).exp());
        let expected: Vec<_> = desired.state.joint_angles.iter().zip(errors).map(|(a, e)| a + e).collect();
        assert_close("angles", &sample.state.joint_angles, &expected, tolerance::CONTROLLED);
    }
    assert!(phase.drift.momentum_drift < 1e-9 && phase.drift.energy_error < 1e-6, "{:?}", phase.drift);
}

/// A quintic with initial rates ends at the final angles and rates.
#[test]
fn a_quintic_is_tracked_from_its_first_rates_to_its_last() {
    for tracking in [Tracking::InverseDynamics, computed_torque()] {
        let mut scenario = short(tracking);
        scenario.approach.trajectory = TrajectoryKind::Quintic;
        let last = vec![0.05, -0.1, 0.2];
        scenario.approach.end = FinalRates::JointRates(last.clone());
        scenario.initial.joint_rates = vec![0.2, -0.3, 0.1];
        let phase = track(&scenario, &last);
        let motion = &phase.end().state;
        assert_close("angles", &motion.joint_angles, &scenario.approach.final_joint_angles, tolerance::CONTROLLED);
        assert_close("rates", &motion.joint_rates, &last, tolerance::CONTROLLED);
    }
}

/// No torque is over its limit, the time at the limit is the time of the samples there, and energy and momentum
/// balance.
#[test]
fn torques_stay_within_their_limits() {
    for tracking in [pd(), computed_torque()] {
        let mut scenario = short(tracking);
        let free = track(&scenario, &[]);
        assert!(free.saturation.joints.is_empty(), "no limits, nothing to report");
        let limits = vec![8.0, 3.0, 0.5];
        scenario.approach.actuation.torque_limits = Some(limits.clone());
        let limited = track(&scenario, &[]);
        let mut at_limit = [0.0; 3];
        for sample in &limited.samples {
            for ((torque, limit), time) in sample.joint_torques.iter().zip(&limits).zip(&mut at_limit) {
                assert!(torque.abs() <= *limit, "{torque} over {limit}");
                *time += if torque.abs() >= *limit { 0.05 } else { 0.0 };
            }
        }
        assert!(limited.saturation.joints.iter().any(|time| *time > 0.1), "{:?}", limited.saturation);
        // samples are 0.05 s apart: one of them too many or too few at each of a few entries and exits
        assert_close("saturated", &limited.saturation.joints, &at_limit, 0.3);
        assert!(limited.drift.momentum_drift < 1e-9 && limited.drift.energy_error < 1e-6, "{:?}", limited.drift);
        scenario.approach.actuation.torque_limits = Some(vec![1e6; 3]);
        assert_eq!(track(&scenario, &[]).samples, free.samples, "limits that are never reached change nothing");
    }
}

/// The limiter at the limit and beyond it.
#[test]
fn a_torque_at_its_limit_is_not_saturated() {
    let model = registry::generated(&scenario("redysim_single_arm_3r").layout).expect("generated code");
    let state =
        State { base_pose: [0.0; 3], joint_angles: &[1.0, -1.0, 0.5], base_twist: [0.0; 3], joint_rates: &[0.0; 3] };
    let law = ProportionalDerivative {
        trajectory: ConstantSetpoint { angles: &[0.0; 3] },
        proportional_gain: &[2.0; 3],
        derivative_gain: &[0.0; 3],
    };
    let mut limited = TorqueLimiter { law, torque_limits: &[2.0, 1.5, 0.0], saturated: &mut [false; 3] };
    let mut torques = [0.0; 3];
    limited.joint_torques(0.0, &*model, &state, &mut torques).expect("torques");
    assert_eq!((torques, Control::<f64>::saturated(&limited)), ([-2.0, 1.5, 0.0], &[false, true, true][..]));
}

/// Sampled torques are those of the law at the sample, and constant until the next.
#[test]
fn torques_are_constant_between_samples() {
    let mut scenario = short(pd());
    scenario.approach.actuation = Actuation { steps_per_sample: Some(20), ..Actuation::default() }; // 0.1 s
    let samples = track(&scenario, &[]).samples; // every 0.05 s
    let mut changes = 0;
    for pair in samples.chunks_exact(2) {
        assert_eq!(pair[0].joint_torques, pair[1].joint_torques, "at {} s", pair[1].time);
    }
    for pair in samples.windows(2).skip(1).step_by(2) {
        changes += usize::from(pair[0].joint_torques != pair[1].joint_torques);
    }
    assert_eq!(changes, 39, "a new torque at every sample after the first, but not at the end");
}

/// Sampling delays by half a sample time, an error of first order.
#[test]
fn sampled_control_converges_to_the_continuous_law() {
    for tracking in [pd(), computed_torque()] {
        let mut scenario = short(tracking);
        scenario.approach.step = 0.001_25;
        let (angles, base) = end(&track(&scenario, &[]));
        let error = |steps: u32| {
            let mut sampled = scenario.clone();
            sampled.approach.actuation.steps_per_sample = Some(steps);
            let (a, b) = end(&track(&sampled, &[]));
            planar_proof::difference(&a, &angles).max(planar_proof::difference(&b, &base))
        };
        let errors = [16, 8, 4, 2, 1].map(error);
        for pair in errors.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!((1.8..2.3).contains(&ratio), "{errors:?}");
        }
        assert!(errors[4] < 3e-3, "{errors:?}");
    }
}
