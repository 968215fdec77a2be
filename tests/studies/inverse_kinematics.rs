//! Inverse kinematics of the exactly tracked approach: goals are reached, or the reason is reported.

use crate::{Silent, run, scenario};
use planar_capture::capture::approach::inverse_kinematics::{
    InverseKinematics, InverseKinematicsError, inverse_kinematics,
};
use planar_capture::capture::{Study, StudyError, study};
use planar_capture::registry;
use planar_capture::scenario::{EndEffectorGoal, FinalRates, Scenario, Tracking};
use planar_proof::{assert_close, tolerance};

fn with_goals(name: &str, goals: &[EndEffectorGoal]) -> Scenario {
    let mut scenario = scenario(name);
    scenario.approach.tracking = Tracking::InverseDynamics;
    scenario.approach.step = 0.02;
    scenario.approach.final_end_effector_poses = Some(goals.to_vec());
    scenario.approach.final_joint_angles.clone_from(&scenario.initial.joint_angles);
    scenario
}

fn end_effector_poses(study: &Study) -> Vec<[f64; 3]> {
    study.approach.end().end_effector_poses.clone()
}

/// What another approach reached is reached again, with the same angles and rates from a first guess near them (from
/// the initial angles it may be with other elbows).
#[test]
fn the_papers_final_pose_is_found_from_its_end_effectors() {
    let mut original = scenario("raina_shah_2017_exact_tracking");
    original.approach.step = 0.02;
    let study = run(&original);
    let goals: Vec<_> = end_effector_poses(&study).into_iter().map(EndEffectorGoal::Pose).collect();
    let mut scenario = with_goals("raina_shah_2017_exact_tracking", &goals);
    let elsewhere = run(&scenario);
    for (found, expected) in end_effector_poses(&elsewhere).iter().zip(end_effector_poses(&study)) {
        assert_close("end effector", &found[1..], &expected[1..], tolerance::REACHED);
    }
    let guess = [0.3, -0.2, 0.25, -0.3, 0.2, -0.3];
    let near = original.approach.final_joint_angles.iter().zip(guess).map(|(angle, by)| angle + by);
    scenario.approach.final_joint_angles = near.collect();
    let found = run(&scenario);
    for (found, expected) in end_effector_poses(&found).iter().zip(end_effector_poses(&study)) {
        assert_close("end effector", found, &expected, tolerance::REACHED);
    }
    let InverseKinematics { joint_angles, iterations, spare_joints, .. } =
        found.inverse_kinematics.as_ref().expect("a solution");
    assert_close("angles", joint_angles, &original.approach.final_joint_angles, 100.0 * tolerance::REACHED);
    let rates = |study: &Study| study.terminal_rates.as_ref().expect("rates").joint_rates.clone();
    assert_close("rates", &rates(&found), &rates(&study), 100.0 * tolerance::REACHED);
    // of the equations of the rates, whose lengths are not those of the pose's
    let margin = |study: &Study| study.terminal_rates.as_ref().expect("rates").singularity_margin;
    assert_close("margin", &[margin(&found)], &[margin(&study)], 100.0 * tolerance::REACHED);
    assert_eq!(*spare_joints, 0);
    assert!(*iterations < 40, "{iterations} iterations");
    for (twist, expected) in found.approach.end().end_effector_twists.iter().zip([-0.1, 0.1]) {
        assert_close("twist", twist, &[0.0, expected, 0.0], tolerance::REACHED);
    }
}

/// Goals of the linear velocity alone, two numbers for three joints or for two, and an arm without a goal.
#[test]
fn velocities_alone_are_designed() {
    let mut free = scenario("raina_shah_2017_exact_tracking");
    free.approach.step = 0.02;
    free.approach.end = FinalRates::EndEffectorTwists(vec![[None, Some(-0.1), Some(0.02)], [None; 3]]);
    let designed = run(&free);
    let [first, _] = designed.approach.end().end_effector_twists[..] else { panic!("two end effectors") };
    assert_close("velocity", &first[1..], &[-0.1, 0.02], tolerance::REACHED);
    assert!(first[0].abs() > 1e-3, "the least rates rotate the end effector");

    let two_links = r#"
name = "two"
layout = "dual_arm_2r"
[initial]
joint_angles = [0.6, -1.2, 2.5, 1.2]
[approach]
duration = 10.0
trajectory = "quintic"
final_joint_angles = [0.4, -0.8, 2.7, 0.9]
final_end_effector_twists = [[0.03, 0.01], [-0.02, 0.0]]
tracking = "exact"
"#;
    let scenario =
        Scenario::parse(two_links, "two.toml", std::path::Path::new(""), registry::SHIPPED).expect("a scenario");
    let model = registry::generic(&scenario.layout);
    let study = study(&scenario, &|| model.clone_box(), 1.0, &mut Silent).expect("a study");
    for (twist, expected) in study.approach.end().end_effector_twists.iter().zip([[0.03, 0.01], [-0.02, 0.0]]) {
        assert_close("velocity", &twist[1..], &expected, tolerance::REACHED);
    }
}

/// Table 4's places, which Table 3's angles do not reach: positions, a yaw left open, an arm left alone.
#[test]
fn positions_alone_are_reached_with_joints_to_spare() {
    let places = [[2.0, -1.5], [-2.0, 1.5]];
    let goals = places.map(EndEffectorGoal::Position);
    let study = run(&with_goals("raina_shah_2017_exact_tracking", &goals));
    for (end_effector, expected) in end_effector_poses(&study).iter().zip(places) {
        assert_close("end effector", &end_effector[1..], &expected, tolerance::REACHED);
    }
    assert_eq!(study.inverse_kinematics.as_ref().expect("a solution").spare_joints, 2);

    let mut alone = with_goals("raina_shah_2017_exact_tracking", &[goals[0], EndEffectorGoal::Any]);
    alone.approach.end = FinalRates::JointRates(vec![0.01; 6]);
    let study = run(&alone);
    assert_close("end effector", &end_effector_poses(&study)[0][1..], &places[0], tolerance::REACHED);
    assert_eq!(study.inverse_kinematics.expect("a solution").spare_joints, 4);
}

/// Yaw goals are modulo one turn.
#[test]
fn a_yaw_more_than_a_turn_away_is_the_same_pose() {
    let one = run(&with_goals("redysim_single_arm_3r", &[EndEffectorGoal::Pose([-1.0, 1.6, -1.2])]));
    let other =
        run(&with_goals("redysim_single_arm_3r", &[EndEffectorGoal::Pose([-1.0 + std::f64::consts::TAU, 1.6, -1.2])]));
    assert_close("end effector", &end_effector_poses(&one)[0], &[-1.0, 1.6, -1.2], tolerance::REACHED);
    assert_close("end effectors", &end_effector_poses(&one)[0], &end_effector_poses(&other)[0], tolerance::REACHED);
}

fn fails(scenario: &Scenario) -> InverseKinematicsError {
    let model = registry::generated(&scenario.layout).expect("generated code");
    match study(scenario, &|| model.clone_box(), 0.05, &mut Silent) {
        Err(StudyError::InverseKinematics(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn goals_out_of_reach_are_reported() {
    let far = fails(&with_goals("redysim_single_arm_3r", &[EndEffectorGoal::Position([5.0, 0.0])]));
    assert!(matches!(&far, InverseKinematicsError::OutOfReach { distance, limit, .. } if distance > limit), "{far:?}");
    assert!(far.to_string().contains("out of reach"), "{far}");
    // within the bound that needs no search, but not within the arm's own: the base is heavy
    let edge = fails(&with_goals("redysim_single_arm_3r", &[EndEffectorGoal::Position([3.6, 0.0])]));
    let InverseKinematicsError::NotConverged { residual, history, iterations, .. } = &edge else { panic!("{edge:?}") };
    assert!(*residual > 1e-3 && history.len() == *iterations, "{edge:?}");
    assert!(edge.to_string().contains("may be out of reach") && edge.to_string().contains('…'), "{edge}");
}

/// The report is that of the approach: the residual is the error of the end effectors, the Jacobian that of the final
/// pose.
#[test]
fn the_report_is_of_the_approach() {
    let scenario = with_goals("redysim_single_arm_3r", &[EndEffectorGoal::Pose([-1.0, 1.6, -1.2])]);
    let model = registry::generated(&scenario.layout).expect("generated code");
    let goals = scenario.approach.final_end_effector_poses.clone().expect("goals");
    let mut ticks = 0_usize;
    let found = inverse_kinematics(&*model, &scenario, &goals, 1.0, &mut || ticks += 1).expect("a solution");
    assert_eq!(ticks, found.iterations, "every iteration computes the end of one approach");
    assert!(found.residual <= 1e-11 && (0.01..1.0).contains(&found.rates.singularity_margin), "{found:?}");
}

/// The design of end rates follows the base of a robot that moves and turns from the start; a simulation of the dynamics
/// arrives with the wanted twists.
#[test]
fn end_rates_of_a_robot_with_momentum() {
    let mut scenario = scenario("raina_shah_2017_exact_tracking");
    scenario.initial.base_twist = [0.05, 0.03, -0.02];
    scenario.initial.base_pose = [0.4, 3.0, -2.0];
    let study = run(&scenario);
    for (twist, expected) in study.approach.end().end_effector_twists.iter().zip([-0.1, 0.1]) {
        assert_close("twist", twist, &[0.0, expected, 0.0], tolerance::REACHED);
    }
}

/// Poses in reach are found with terminal twists as without: terminal rates that change between the iterations do not end
/// them.
#[test]
fn poses_are_found_with_terminal_twists() {
    for i in 0..4 {
        for j in 0..4 {
            let pose = [-1.0, 1.5 + 0.1 * f64::from(i), -1.25 + 0.15 * f64::from(j)];
            let text = format!(
                "name = \"twist\"\nlayout = \"single_arm_3r\"\n[initial]\njoint_angles = [0.9, -1.8, 0.9]\n[approach]\n\
                 duration = 15.0\ntrajectory = \"quintic\"\nfinal_end_effector_poses = [{pose:?}]\n\
                 final_end_effector_twists = [[0.1, 0.05, -0.05]]\ntracking = \"exact\"\n"
            );
            let scenario = Scenario::parse(&text, "twist.toml", "".as_ref(), registry::SHIPPED).expect("a scenario");
            let end = run(&scenario).approach.end().clone();
            let turns = (end.end_effector_poses[0][0] - pose[0]) / std::f64::consts::TAU;
            assert!((turns - turns.round()).abs() < tolerance::REACHED, "{pose:?}: {turns}");
            assert_close("position", &end.end_effector_poses[0][1..], &pose[1..], tolerance::REACHED);
            assert_close("twist", &end.end_effector_twists[0], &[0.1, 0.05, -0.05], tolerance::REACHED);
        }
    }
}
