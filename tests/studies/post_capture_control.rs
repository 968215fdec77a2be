//! Post-capture control: hold, damping and stabilisation, by joints, base torque and wheel, and the residual motion.

use crate::{run, scenario, summary};
use planar_capture::capture::CaptureResult;
use planar_capture::capture::post_capture::wheels;
use planar_capture::capture::residual_motion::ResidualMotion;
use planar_capture::control::Control;
use planar_capture::laws::{PostCaptureLaw, PostCaptureTask};
use planar_capture::owned::RobotState;
use planar_capture::registry;
use planar_capture::scenario::{Actuation, PostCaptureControl, Scenario};
use planar_capture::simulate::actuators::drive;
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::stepper::Integration;
use planar_capture::simulate::system::System;
use planar_capture::simulate::{Phase, Timing};
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::{assert_close, layout, tolerance};
use proptest::prelude::*;

/// The paper's study with this post-capture control.
fn study_with(control: PostCaptureControl) -> (Scenario, Vec<CaptureResult>) {
    let mut scenario = scenario("raina_shah_2017");
    scenario.post_impact.as_mut().expect("a capture").control = control;
    let study = run(&scenario);
    assert_eq!(study.audit_failures(), Vec::<String>::new());
    (scenario, study.cases.into_iter().map(|case| case.capture.expect("a capture")).collect())
}

fn stabilise(base_torque_limit: Option<f64>) -> PostCaptureControl {
    PostCaptureControl::Stabilise { derivative_gain: vec![0.5; 6], base_gain: 0.5, base_torque_limit }
}

fn ends(captured: &CaptureResult) -> (&RobotState, &RobotState, &ResidualMotion) {
    let samples = &captured.post_impact.samples;
    (
        &samples.first().expect("a start").state,
        &samples.last().expect("an end").state,
        captured.residual_motion.as_ref().expect("a residual motion"),
    )
}

#[test]
fn hold_keeps_the_angles_of_the_capture() {
    let gains = PostCaptureControl::Hold { proportional_gain: vec![49.0; 6], derivative_gain: vec![14.0; 6] };
    for captured in study_with(gains).1 {
        let (start, end, residual) = ends(&captured);
        assert_close("angles", &end.joint_angles, &start.joint_angles, tolerance::HELD);
        assert!(residual.largest_joint_rate < tolerance::HELD, "{residual:?}");
    }
}

/// After a rebound the angles of the first impact are held, not those of a later one.
#[test]
fn hold_keeps_the_angles_of_the_first_impact() {
    let mut scenario = scenario("elastic_rebound");
    let joints = scenario.layout.joints();
    let post_impact = scenario.post_impact.as_mut().expect("impacts");
    post_impact.control =
        PostCaptureControl::Hold { proportional_gain: vec![49.0; joints], derivative_gain: vec![14.0; joints] };
    post_impact.duration = 40.0;
    let study = run(&scenario);
    let mut rebounds = 0;
    for captured in study.cases.iter().filter_map(|case| case.capture.as_ref()) {
        let samples = &captured.post_impact.samples;
        let (first, last) = (&samples[0].state.joint_angles, &samples[samples.len() - 1].state.joint_angles);
        let difference = |angles: &[f64]| {
            first.iter().zip(angles).fold(0.0, |most: f64, (first, angle)| most.max((first - angle).abs()))
        };
        let Some(impact) = captured.later_impacts.first() else { continue };
        let at = samples.iter().find(|sample| sample.time >= impact.time).expect("a row at every impact");
        assert!(difference(&at.state.joint_angles) > 2e-3 && difference(last) < 1e-3, "{:e}", difference(last));
        rebounds += 1;
    }
    assert!(rebounds > 1, "{rebounds}");
}

#[test]
fn damping_stops_the_joints_and_leaves_one_body() {
    for captured in study_with(PostCaptureControl::Damping { derivative_gain: vec![7.0; 6] }).1 {
        let (start, end, residual) = ends(&captured);
        let largest = |rates: &[f64]| rates.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
        assert!(
            largest(&end.joint_rates) < 0.2 * largest(&start.joint_rates),
            "{:e} {:e}",
            largest(&end.joint_rates),
            largest(&start.joint_rates)
        );
        assert_close("base rate", &[residual.base_rate], &[residual.rigid_rate], 10.0 * residual.largest_joint_rate);
    }
}

/// With joint torques alone, the whole ends up rotating as one body at l/I, with constant momentum.
#[test]
fn stabilised_by_joints_alone_the_robot_turns_as_one_body() {
    for captured in study_with(stabilise(None)).1 {
        let (start, end, residual) = ends(&captured);
        let decay = (-0.5 * captured.post_impact.duration).exp();
        let expected: Vec<_> = start.joint_rates.iter().map(|rate| rate * decay).collect();
        assert_close("joint rates", &end.joint_rates, &expected, tolerance::STABILISED);
        assert_close("base rate", &[residual.base_rate], &[residual.rigid_rate], tolerance::STABILISED);
        assert!({
            let end = captured.post_impact.end();
            end.base_torque.is_none() && end.work.base_impulse == 0.0
        });
    }
}

/// A base torque removes the angular momentum about the COM; the linear momentum is constant.
#[test]
fn a_base_torque_takes_the_angular_momentum() {
    let (_, free) = study_with(stabilise(None));
    let (_, cases) = study_with(stabilise(Some(1e3)));
    for (captured, free) in cases.iter().zip(&free) {
        let (start, end, residual) = ends(captured);
        let decay = (-0.5 * captured.post_impact.duration).exp();
        assert_close("base rate", &[end.base_twist[0]], &[start.base_twist[0] * decay], tolerance::STABILISED);
        let [before, rest @ ..] = free.residual_motion.as_ref().expect("a residual motion").momentum;
        assert_close("momentum", &residual.momentum, &[0.0, rest[0], rest[1]], tolerance::STABILISED);
        let end = captured.post_impact.end();
        assert_close("impulse", &[end.work.base_impulse], &[-before], tolerance::STABILISED);
        assert!(captured.post_impact.saturation.base == 0.0);
    }
}

/// A limited base torque saturates first and never exceeds its limit.
#[test]
fn a_weak_base_torque_takes_longer() {
    let limit = 0.005;
    let (scenario, cases) = study_with(stabilise(Some(limit)));
    for captured in &cases {
        let largest = captured.post_impact.samples.iter().filter_map(|sample| sample.base_torque);
        let largest = largest.fold(0.0, |most: f64, torque| most.max(torque.abs()));
        assert!(largest <= limit, "{largest}");
        let time = captured.post_impact.saturation.base;
        let impulse = captured.post_impact.end().work.base_impulse.abs();
        assert!(impulse <= limit * captured.post_impact.duration);
        assert!(time <= captured.post_impact.duration + 1e-6 && (time > 1.0 || impulse < 0.1), "{time} s");
    }
    assert!(cases.iter().any(|captured| captured.post_impact.saturation.base > 1.0));
    let study = run(&scenario);
    let value = summary(&scenario, &study);
    let after = &value["cases"][0]["post_impact"];
    assert_eq!(after["remainder"]["control"], "stabilise");
    assert_eq!(after["remainder"]["base_rate"], after["base_twist"][0]);
    assert_eq!(after["base_saturated"].as_f64(), Some(cases[0].post_impact.saturation.base));
}

#[test]
fn without_control_the_summary_has_no_control_keys() {
    let scenario = scenario("raina_shah_2017");
    let value = summary(&scenario, &run(&scenario));
    let after = value["cases"][0]["post_impact"].as_object().expect("a phase");
    let keys: Vec<_> = after.keys().map(String::as_str).collect();
    let motion = ["duration", "base_pose", "base_twist", "joint_angles", "joint_rates"];
    let contract = [&motion[..], &["momentum_drift", "energy_error", "center_of_mass_drift", "path_error"]].concat();
    assert_eq!(keys, contract);
}

/// The shipped study comes to rest as its header states.
#[test]
fn the_shipped_study_comes_to_rest() {
    for case in run(&scenario("stabilised_capture")).cases {
        let residual = case.capture.expect("a capture").residual_motion.expect("a residual motion");
        assert!(residual.base_rate.abs() < 1e-6 && residual.largest_joint_rate < 1e-9, "{residual:?}");
        assert!(residual.rigid_rate.abs() < 1e-6, "{residual:?}");
    }
}

/// Four seconds of stabilisation of a shipped layout from any state; joints at 1 1/s, the base at 0.7 1/s.
fn stabilise_layout(name: &str, s: &RandomState, base_torque_limit: Option<f64>) -> (Phase, ResidualMotion, Vec<bool>) {
    let layout = layout(name);
    // the generic implementation where this build has no code: slower, the same to rounding
    let model = registry::generated(&layout).unwrap_or_else(|_| registry::generic(&layout));
    let wheels = wheels(&layout, &[]);
    let control = PostCaptureControl::Stabilise {
        derivative_gain: vec![1.0; layout.joints()],
        base_gain: 0.7,
        base_torque_limit,
    };
    let timing = Timing { duration: 4.0, step: 0.01, sample: 1.0, integration: Integration::default(), kink: None };
    let start = RobotState::from_view(&s.state());
    let (system, scenario) = (System::alone(&*model), scenario("raina_shah_2017"));
    let (model, angles) = (&*model, &s.joint_angles[..]);
    let task = PostCaptureTask { scenario: &scenario, model, wheels: &wheels, angles, since_impact: 0.0, timing };
    let mut run = |law: &mut dyn Control<f64>| {
        drive(&system, law, &Actuation::default(), &start, &timing, &mut NoEvents, &mut || ())
    };
    let phase = control.control(&task, &mut run).expect("a phase");
    let end = phase.end().state.clone();
    let residual =
        ResidualMotion::of(model, &[], PostCaptureControl::name(&control), &end, &wheels).expect("a residual motion");
    (phase, residual, wheels)
}

/// Every second: joint rates but the wheels', and the base rate where it is `controlled`, have decayed as they should.
fn check_decay(phase: &Phase, wheels: &[bool], wheels_too: bool, base: bool) {
    let start = &phase.samples[0].state;
    for sample in &phase.samples {
        let joints = start.joint_rates.iter().zip(&sample.state.joint_rates).zip(wheels);
        for ((from, to), wheel) in joints.filter(|(_, wheel)| wheels_too || !**wheel) {
            assert_close(&format!("joint ({wheel})"), &[*to], &[from * (-sample.time).exp()], tolerance::DECAY);
        }
        if base {
            let expected = start.base_twist[0] * (-0.7 * sample.time).exp();
            assert_close("base", &[sample.state.base_twist[0]], &[expected], tolerance::DECAY);
        }
    }
    assert!(
        phase.drift.momentum_drift < tolerance::DECAY && phase.drift.energy_error < tolerance::DECAY,
        "{:?}",
        phase.drift
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, ..config() })]

    #[test]
    fn joints_of_any_robot_come_to_rest(s in sample(2, 6)) {
        let (phase, _, wheels) = stabilise_layout("dual_arm_3r", &s, None);
        check_decay(&phase, &wheels, true, false);
        let (phase, ..) = stabilise_layout("dual_arm_3r", &s, Some(1e6));
        check_decay(&phase, &wheels, true, true);
    }

    #[test]
    fn a_wheel_takes_what_the_base_loses(s in sample(3, 6)) {
        let (phase, residual, wheels) = stabilise_layout("asymmetric_wheel", &s, None);
        prop_assert_eq!(&wheels, &[false, false, false, false, false, true]);
        check_decay(&phase, &wheels, false, true);
        prop_assert_eq!(residual.wheel_rates.len(), 1);
    }

    #[test]
    fn a_base_torque_takes_the_momentum_of_the_wheel(s in sample(3, 6)) {
        let (phase, residual, wheels) = stabilise_layout("asymmetric_wheel", &s, Some(1e6));
        check_decay(&phase, &wheels, true, true);
        // with a limit, the wheel supplies the rest of the torque
        let (limited, ..) = stabilise_layout("asymmetric_wheel", &s, Some(1e-3));
        check_decay(&limited, &wheels, false, true);
        prop_assert!(limited.saturation.base > 3.9, "{:?}", limited.saturation);
        prop_assert_eq!(residual.wheel_rates.len(), 1);
    }
}
