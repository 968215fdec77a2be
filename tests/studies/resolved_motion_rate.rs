//! Resolved motion rate control by the generalized Jacobian: path errors, their decay, and terminal errors.

use crate::{run, scenario, summary};
use planar_capture::capture::Study;
use planar_capture::control::Control;
use planar_capture::laws::EndEffectorFeedback;
use planar_capture::owned::{CloneModel, RobotState};
use planar_capture::registry;
use planar_capture::scenario::{Actuation, EndEffectorGoal, FinalRates, Scenario, Tracking};
use planar_capture::simulate::Timing;
use planar_capture::simulate::actuators::drive;
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::system::System;
use planar_capture::state::{Forces, State};
use planar_capture::trajectory::quintic;
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::{assert_close, difference, layout, tolerance};
use proptest::prelude::*;

const GAINS: [f64; 2] = [2.0, 10.0];
const POSES: [[f64; 3]; 2] = [[-1.2, 2.0, -1.5], [1.9, -2.0, 1.5]];
const TWISTS: [[f64; 3]; 2] = [[0.0, -0.1, 0.0], [0.0, 0.1, 0.0]];

/// The paper's robot and the shipped scenario's law without a sample time, with other goals.
fn with_goals(goals: &[EndEffectorGoal], twists: &[[f64; 3]]) -> Scenario {
    let mut scenario = scenario("resolved_motion_rate");
    scenario.approach.actuation = Actuation::default();
    scenario.approach.final_end_effector_poses = Some(goals.to_vec());
    scenario.approach.end = FinalRates::EndEffectorTwists(twists.iter().map(|twist| twist.map(Some)).collect());
    (scenario.targets, scenario.post_impact) = (Vec::new(), None);
    scenario.cases.truncate(1);
    scenario
}

fn by_poses() -> Scenario {
    with_goals(&POSES.map(EndEffectorGoal::Pose), &TWISTS)
}

fn generated(scenario: &Scenario) -> Box<dyn CloneModel> {
    registry::generated(&scenario.layout).expect("generated code")
}

#[track_caller]
fn check_end(study: &Study, poses: &[[f64; 3]], twists: &[[f64; 3]], tolerance: f64) {
    assert_eq!(study.audit_failures(), Vec::<String>::new());
    let end = study.approach.end();
    assert_close("poses", end.end_effector_poses.as_flattened(), poses.as_flattened(), tolerance);
    assert_close("twists", end.end_effector_twists.as_flattened(), twists.as_flattened(), tolerance);
    assert!(study.terminal_errors.iter().flatten().all(|miss| miss.reached), "{:?}", study.terminal_errors);
    assert!(study.inverse_kinematics.is_none() && study.terminal_rates.is_none(), "nothing to design");
}

/// Largest difference of end effector poses from quintic paths between the first and the final ones.
fn off_path(study: &Study, poses: &[[f64; 3]], twists: &[[f64; 3]]) -> f64 {
    let first = &study.approach.samples[0];
    let mut most = 0.0_f64;
    for sample in &study.approach.samples {
        let feedback = first.end_effector_poses.iter().zip(&first.end_effector_twists).zip(poses.iter().zip(twists));
        for (((from, start), (to, end)), found) in feedback.zip(&sample.end_effector_poses) {
            for i in 0..3 {
                let tau = sample.time / study.approach.duration;
                let expected = quintic([from[i], to[i]], [start[i], end[i]], study.approach.duration, tau);
                most = most.max((found[i] - expected.angle).abs());
            }
        }
    }
    most
}

#[test]
fn end_effectors_follow_their_paths_to_poses_and_twists() {
    let study = run(&by_poses());
    check_end(&study, &POSES, &TWISTS, tolerance::STEERED);
    let off = off_path(&study, &POSES, &TWISTS);
    assert!(off < tolerance::STEERED, "{off:e}");
    // from rest to rest the lines are straight: one parameter for x and y
    let study = run(&with_goals(&POSES.map(EndEffectorGoal::Pose), &[[0.0; 3]; 2]));
    check_end(&study, &POSES, &[[0.0; 3]; 2], tolerance::STEERED);
    let from = &study.approach.samples[0].end_effector_poses;
    for sample in &study.approach.samples {
        for ((from, to), at) in from.iter().zip(&POSES).zip(&sample.end_effector_poses) {
            let across = (to[1] - from[1]) * (at[2] - from[2]) - (to[2] - from[2]) * (at[1] - from[1]);
            assert!(across.abs() < tolerance::STEERED, "{across:e} at {} s", sample.time);
        }
    }
}

/// The law takes the momentum into account.
#[test]
fn a_robot_with_momentum_follows_its_paths() {
    let mut scenario = by_poses();
    scenario.approach.duration = 10.0; // later the robot has drifted away from the poses
    scenario.initial.base_twist = [-0.02, 0.01, 0.006];
    scenario.initial.joint_rates = vec![0.02, -0.02, 0.01, 0.0, 0.02, -0.02];
    let study = run(&scenario);
    check_end(&study, &POSES, &TWISTS, tolerance::STEERED);
    let off = off_path(&study, &POSES, &TWISTS);
    assert!(off < tolerance::STEERED, "{off:e}");
}

/// Off the path, every component of the error obeys ë + (K + k) ė + K k e = 0.
#[test]
fn errors_decay_with_the_two_gains() {
    let planned = by_poses();
    let model = generated(&planned);
    let mut start = RobotState::from_view(&planned.initial.view());
    for (angle, by) in start.joint_angles.iter_mut().zip([0.01, -0.02, 0.01, -0.01, 0.01, 0.02]) {
        *angle += by;
    }
    start.joint_rates = vec![0.01, 0.0, -0.02, 0.01, 0.02, 0.0];
    start.base_twist = [0.003, 0.002, -0.004];
    let mut feedback = EndEffectorFeedback::new(&*model, &planned).expect("paths");
    let mut law = feedback.law(GAINS, 0.01);
    let timing = Timing { duration: 4.0, step: 0.0025, sample: 0.1, ..Timing::default() };
    let phase =
        drive(&System::alone(&*model), &mut law, &Actuation::default(), &start, &timing, &mut NoEvents, &mut || ())
            .expect("a phase");
    let on_path = run(&planned).approach.samples;
    let on_path = |time: f64| on_path.iter().find(|s| (s.time - time).abs() < 1e-9).expect("a sample");
    let [k1, k2] = GAINS;
    let (first, begin) = (&phase.samples[0], on_path(0.0));
    for sample in &phase.samples {
        let path = on_path(sample.time);
        for arm in 0..2 {
            for part in 0..3 {
                let e = first.end_effector_poses[arm][part] - begin.end_effector_poses[arm][part];
                let rate = first.end_effector_twists[arm][part] - begin.end_effector_twists[arm][part];
                let (slow, fast) = ((k2 * e + rate) / (k2 - k1), (k1 * e + rate) / (k2 - k1));
                let expected = slow * (-k1 * sample.time).exp() - fast * (-k2 * sample.time).exp();
                let found = sample.end_effector_poses[arm][part] - path.end_effector_poses[arm][part];
                assert_close(&format!("error at {} s", sample.time), &[found], &[expected], tolerance::CONTROLLED);
            }
        }
    }
    assert!(phase.drift.momentum_drift < 1e-9 && phase.drift.energy_error < 1e-6, "{:?}", phase.drift);
}

/// Sampled torques give an error of first order in the sample time, 20 ms in the shipped scenario.
#[test]
fn sampled_control_stays_near_the_paths() {
    let errors = [8, 4, 2, 1].map(|steps| {
        let mut scenario = by_poses();
        scenario.approach.actuation.steps_per_sample = Some(steps);
        let study = run(&scenario);
        check_end(&study, &POSES, &TWISTS, tolerance::STEERED_SAMPLED);
        off_path(&study, &POSES, &TWISTS)
    });
    for pair in errors.windows(2) {
        assert!((1.7..2.4).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

#[test]
fn the_shipped_study_meets_its_targets() {
    let scenario = scenario("resolved_motion_rate");
    let study = run(&scenario);
    assert_eq!(study.audit_failures(), Vec::<String>::new());
    let end = study.approach.end();
    for ((pose, twist), (x, v)) in
        end.end_effector_poses.iter().zip(&end.end_effector_twists).zip([([2.0, -1.5], -0.1), ([-2.0, 1.5], 0.1)])
    {
        assert_close("place", &pose[1..], &x, tolerance::STEERED_SAMPLED);
        assert_close("velocity", &twist[1..], &[v, 0.0], tolerance::STEERED_SAMPLED);
    }
    assert!(study.approach.saturation.joints.iter().all(|time| *time == 0.0), "{:?}", study.approach.saturation);
    let value = summary(&scenario, &study);
    let approach = &value["cases"][0]["approach"];
    assert_eq!(approach["singularity_margin"].as_f64(), study.approach.singularity_margin);
    assert!(study.approach.singularity_margin.is_some_and(|margin| (0.05..0.2).contains(&margin)));
    let missed = approach["missed"][0][0].as_f64().expect("a number");
    assert!((missed - (2.0 - end.end_effector_poses[0][1])).abs() < 1e-15, "{missed}");
    assert!(run(&crate::scenario("raina_shah_2017")).approach.singularity_margin.is_none());
}

/// A path that ends before the approach holds its end; so does a quintic of the joints.
#[test]
fn end_effectors_stay_where_their_paths_end() {
    let mut scenario = with_goals(&POSES.map(EndEffectorGoal::Pose), &[[0.0; 3]; 2]);
    scenario.approach.trajectory_duration = Some(14.0);
    scenario.initial.base_twist = [0.002, 0.001, -0.001]; // the robot drifts, the end effectors do not
    let study = run(&scenario);
    check_end(&study, &POSES, &[[0.0; 3]; 2], tolerance::STEERED);
    for sample in study.approach.samples.iter().filter(|sample| sample.time >= 14.0) {
        assert_close("poses", sample.end_effector_poses.as_flattened(), POSES.as_flattened(), tolerance::STEERED);
    }
    let mut joints = crate::scenario("stabilised_capture");
    joints.approach.end = FinalRates::JointRates(vec![0.0; 6]);
    joints.approach.tracking = Tracking::InverseDynamics;
    joints.approach.trajectory_duration = Some(12.0);
    joints.approach.actuation = Actuation::default();
    joints.cases.truncate(1);
    let study = run(&joints);
    for sample in study.approach.samples.iter().filter(|sample| sample.time >= 12.0) {
        assert_close("angles", &sample.state.joint_angles, &joints.approach.final_joint_angles, tolerance::STEERED);
    }
}

/// Saturated torques cause path errors, which decay afterwards.
#[test]
fn errors_under_torque_limits_decay() {
    let mut scenario = by_poses();
    scenario.approach.actuation.torque_limits = Some(vec![0.35; 6]);
    let study = run(&scenario);
    assert!(study.approach.saturation.joints.iter().any(|time| *time > 0.2), "{:?}", study.approach.saturation);
    assert!(off_path(&study, &POSES, &TWISTS) > 1e-4);
    check_end(&study, &POSES, &TWISTS, 1e-3);
}

/// An arm without a goal keeps its angles while the base moves; a yaw goal is reached at the nearest turn.
#[test]
fn an_arm_without_a_goal_keeps_its_angles() {
    let pose = [-1.2, 1.8, -1.4];
    let rotated = EndEffectorGoal::Pose([pose[0] + 2.0 * std::f64::consts::TAU, pose[1], pose[2]]);
    let study = run(&with_goals(&[rotated, EndEffectorGoal::Any], &[[0.0; 3]; 2]));
    let end = study.approach.end();
    assert_close("end effector", &end.end_effector_poses[0], &pose, tolerance::STEERED);
    let angles = &study.approach.samples[0].state.joint_angles;
    assert_close("held", &end.state.joint_angles[3..], &angles[3..], tolerance::STEERED);
    assert!(difference(&end.state.base_pose, &[0.0; 3]) > 0.05 && study.terminal_errors[1].is_none());
}

/// Stretched arms are singular at the start: rates and torques stay bounded, and the goals are reached.
#[test]
fn a_singular_start_stays_bounded() {
    let mut scenario = with_goals(&POSES.map(EndEffectorGoal::Pose), &[[0.0; 3]; 2]);
    scenario.initial.joint_angles = vec![0.0, 1e-3, 0.0, std::f64::consts::PI, 0.0, -1e-3];
    let study = run(&scenario);
    check_end(&study, &POSES, &[[0.0; 3]; 2], tolerance::STEERED);
    assert!(study.approach.singularity_margin.is_some_and(|margin| margin < 1e-3));
    for sample in &study.approach.samples {
        assert!(sample.state.joint_rates.iter().all(|rate| rate.abs() < 1.0), "{:?}", sample.state.joint_rates);
        assert!(sample.joint_torques.iter().all(|torque| torque.abs() < 30.0), "{:?}", sample.joint_torques);
    }
}

/// The arm stretches towards a goal out of reach; the other arm reaches its goal.
#[test]
fn a_goal_out_of_reach_is_reported_with_its_distance() {
    let mut scenario =
        with_goals(&[EndEffectorGoal::Position([3.45, -0.3]), EndEffectorGoal::Position([-2.0, 1.5])], &[[0.0; 3]; 2]);
    scenario.approach.duration = 30.0;
    let study = run(&scenario);
    assert_eq!(study.audit_failures(), Vec::<String>::new());
    let [Some(far), Some(_)] = study.terminal_errors.as_slice() else { panic!("{:?}", study.terminal_errors) };
    assert!(!far.reached && (0.01..0.2).contains(&far.distance), "{far:?}");
    assert!(study.approach.singularity_margin.is_some_and(|margin| margin < 0.04));
    let shown = planar_capture::output::console::table(&scenario, &study);
    assert!(shown.contains("wanted pose NOT REACHED: missed by") && shown.contains("damped below"), "{shown}");
}

/// The law at one state of any robot: `ṫ = ṫ_d + (K + k)(t_d − t) + K k e` in the controlled rows, `θ̈ = −k θ̇` in
/// locked joints. Accelerations of the end effectors are differences of their twists along the motion.
fn check_law(name: &str, goals: &[EndEffectorGoal], s: &RandomState) -> Result<(), TestCaseError> {
    let layout = layout(name);
    let model = registry::generated(&layout).unwrap_or_else(|_| registry::generic(&layout));
    let mut planned = by_poses();
    planned.initial.joint_angles = s.joint_angles.iter().map(|angle| angle + 0.01).collect();
    (planned.initial.base_pose, planned.initial.base_twist) = (s.base_pose, s.base_twist);
    planned.initial.joint_rates.clone_from(&s.joint_rates);
    planned.approach.final_end_effector_poses = Some(goals.to_vec());
    let end: Vec<_> =
        (0..layout.arms.len()).map(|arm| [0.1, -0.2, 0.05 * f64::from(u8::try_from(arm).unwrap_or(0))]).collect();
    planned.approach.end = FinalRates::EndEffectorTwists(end.iter().map(|twist: &[f64; 3]| twist.map(Some)).collect());
    planned.layout = layout.clone();
    let state = State {
        base_pose: s.base_pose,
        joint_angles: &s.joint_angles,
        base_twist: s.base_twist,
        joint_rates: &s.joint_rates,
    };
    let mut feedback = EndEffectorFeedback::new(&*model, &planned).expect("paths");
    let mut law = feedback.law(GAINS, 1e-9);
    let (path, expected, locked) = (law.path, law.controlled, law.locked);
    let (joints, time) = (layout.joints(), 3.0);
    let mut torques = vec![0.0; joints];
    law.joint_torques(time, &*model, &state, &mut torques).expect("torques");
    let margin = law.singularity_margin.expect("rows");
    prop_assume!(margin > 0.02); // the rest is for `a_singular_start_stays_bounded`
    let mut accelerations = vec![0.0; joints];
    let base = model.forward_dynamics(&state, &Forces::torques(&torques), &mut accelerations).expect("accelerations");
    let h = 1e-6;
    let twists_at = |h: f64| {
        let moved = |x: &[f64], v: &[f64], a: &[f64]| -> Vec<f64> {
            x.iter().zip(v).zip(a).map(|((x, v), a)| x + h * v + 0.5 * h * h * a).collect()
        };
        let pose = moved(&s.base_pose, &s.base_twist, &base);
        let angles = moved(&s.joint_angles, &s.joint_rates, &accelerations);
        let state = State {
            base_pose: [pose[0], pose[1], pose[2]],
            joint_angles: &angles,
            base_twist: [0, 1, 2].map(|i: usize| s.base_twist[i] + h * base[i]),
            joint_rates: &moved(&s.joint_rates, &accelerations, &vec![0.0; joints]),
        };
        let mut twists = vec![[0.0; 3]; layout.arms.len()];
        model.end_effector_twists(&state, &mut twists).expect("twists");
        twists
    };
    let (before, now, after) = (twists_at(-h), twists_at(0.0), twists_at(h));
    let mut poses = vec![[0.0; 3]; layout.arms.len()];
    model.end_effector_poses(&s.base_pose, &s.joint_angles, &mut poses).expect("poses");
    for (arm, expected) in expected.iter().enumerate() {
        let desired = path.end_effector(arm, time).expect("a path");
        for part in (0..3).filter(|part| expected[*part]) {
            let error = desired.pose[part] - poses[arm][part];
            let limit = 0.05 * if part == 0 { 1.0 } else { layout.arms[arm].reach() };
            let error = error.clamp(-limit, limit);
            let lag = desired.twist[part] - now[arm][part];
            let expected = desired.acceleration[part] + (GAINS[0] + GAINS[1]) * lag + GAINS[0] * GAINS[1] * error;
            let found = (after[arm][part] - before[arm][part]) / (2.0 * h);
            prop_assert!(
                (found - expected).abs() < tolerance::STEERED_ACCELERATION * (1.0 + expected.abs()) / margin,
                "arm {arm}, part {part}: {found} and {expected}, margin {margin}"
            );
        }
    }
    for ((acceleration, rate), locked) in accelerations.iter().zip(&s.joint_rates).zip(locked) {
        if *locked {
            prop_assert!((acceleration + GAINS[1] * rate).abs() < tolerance::STEERED_ACCELERATION / margin);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn end_effectors_accelerate_by_the_law(s in sample(2, 6)) {
        check_law("dual_arm_3r", &POSES.map(EndEffectorGoal::Pose), &s)?;
        check_law("dual_arm_3r", &[EndEffectorGoal::Any, EndEffectorGoal::Position([1.0, 2.0])], &s)?;
    }

    #[test]
    fn with_a_wheel_and_a_mount_angle_too(s in sample(3, 6)) {
        check_law("asymmetric_wheel", &[EndEffectorGoal::Pose(POSES[0]), EndEffectorGoal::Position([-1.0, 0.5]), EndEffectorGoal::Any], &s)?;
    }

    #[test]
    fn with_three_arms_too(s in sample(3, 9)) {
        check_law("triple_arm_3r", &[EndEffectorGoal::Pose(POSES[0]), EndEffectorGoal::Any, EndEffectorGoal::Pose(POSES[1])], &s)?;
    }
}

/// Without momentum the rates of the law are those of Umetani and Yoshida: the generalized Jacobian maps them to the
/// path's twist and the correction.
#[test]
fn without_momentum_the_rates_are_those_of_the_generalized_jacobian() {
    let scenario = by_poses();
    let model = generated(&scenario);
    let study = run(&scenario);
    for sample in study.approach.samples.iter().step_by(40) {
        let motion = &sample.state;
        let (mut inertia, mut bias, mut jacobian) = (vec![0.0; 36], vec![0.0; 6], vec![0.0; 36]);
        model.reduced_dynamics(&motion.view(), &mut inertia, &mut bias, &mut jacobian).expect("a Jacobian");
        let predicted: Vec<f64> = jacobian
            .chunks_exact(6)
            .map(|row| row.iter().zip(&motion.joint_rates).map(|(entry, rate)| entry * rate).sum())
            .collect();
        assert_close("twists", sample.end_effector_twists.as_flattened(), &predicted, tolerance::STEERED);
        let tau = sample.time / study.approach.duration;
        for arm in 0..2 {
            for part in 0..3 {
                let from = study.approach.samples[0].end_effector_poses[arm][part];
                let path = quintic([from, POSES[arm][part]], [0.0, TWISTS[arm][part]], study.approach.duration, tau);
                assert_close("path's twist", &[predicted[3 * arm + part]], &[path.rate], tolerance::STEERED);
            }
        }
    }
    let Tracking::ResolvedMotionRate { pose_gain, rate_gain, singularity_threshold } = scenario.approach.tracking
    else {
        panic!("{:?}", scenario.approach.tracking)
    };
    assert_eq!(([pose_gain, rate_gain], singularity_threshold), (GAINS, 0.04));
}
