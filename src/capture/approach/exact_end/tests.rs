//! The end of an exactly tracked approach: by dynamics, whatever the knots and the place are, and where there is none.

use super::*;
use crate::capture::approach::ApproachTracking;
use crate::owned::CloneModel;
use crate::registry;
use crate::scenario::Scenario;
use crate::simulate::event::NoEvents;
use crate::simulate::stepper::{Formulation, Integration, Integrator};
use planar_proof::{assert_close, file, layout, tolerance};

fn model() -> Box<dyn CloneModel> {
    registry::generic(&layout("single_arm_2r"))
}

/// An approach of 4 s whose trajectory ends at 2.3 s, where no halved panel ends.
fn scenario(keys: &str) -> Scenario {
    let text = format!(
        "name = \"it\"\nlayout = \"single_arm_2r\"\n[initial]\njoint_angles = [0.6, -1.2]\n{keys}\n[approach]\nduration = 4.0\n\
         trajectory_duration = 2.3\ntrajectory = \"cycloidal\"\nfinal_joint_angles = [5.6, -7.2]\ntracking = \"exact\"\n"
    );
    Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

const MOVING: &str = "base_pose = [0.3, -1.0, 2.0]\nbase_twist = [0.4, 0.3, -0.2]";

fn numbers(end: &ApproachEnd) -> Vec<f64> {
    let RobotState { base_pose, base_twist, joint_angles, joint_rates } = &end.state;
    let ends = [&end.end_effector_poses, &end.end_effector_twists].map(|of| of.as_flattened());
    [&base_pose[..], base_twist, joint_angles, joint_rates, ends[0], ends[1]].concat()
}

/// The end of the motion under the torques of inverse dynamics, of a robot that moves and turns from the start.
#[test]
fn the_end_is_that_of_the_dynamics() {
    let mut scenario = scenario(MOVING);
    let integrator = Integrator::Adaptive { tolerance: 1e-13 };
    scenario.approach.integration = Integration { integrator, coordinates: Formulation::Full };
    let (model, tracking) = (model(), ApproachTracking::new(&scenario, 4.0));
    let simulated = tracking.track(&*model, &[0.0; 2], &mut NoEvents, &mut || ()).expect("a phase");
    let simulated = of_state(&*model, simulated.end().state.clone(), 4.0).expect("end effectors");
    let found = tracking.exact_end(&*model, &[0.0; 2]).expect("an end");
    assert_eq!(found.time.to_bits(), f64::to_bits(4.0));
    assert_close("end", &numbers(&found), &numbers(&simulated), tolerance::REACHED);
}

/// More knots are shorter panels, whose integrals are the same to rounding.
#[test]
fn knots_without_a_jump_change_nothing() {
    let scenario = scenario(MOVING);
    let (model, tracking) = (model(), ApproachTracking::new(&scenario, 4.0));
    let end = |knots: &[f64]| {
        let end = exact_end(&*model, tracking.trajectory(&[0.0; 2]), &tracking.start(), knots).expect("an end");
        numbers(&end)
    };
    let expected = end(&[2.3, 4.0]);
    for knots in [&[1.0, 2.3, 4.0][..], &[0.7, 1.4, 2.1, 2.3, 3.0, 4.0]] {
        assert_close("end", &end(knots), &expected, tolerance::INTEGRALS);
    }
}

/// A robot at rest that is moved moves so, however far.
#[test]
fn the_end_moves_with_the_robot() {
    let model = model();
    let [near, far] = [0.0, 1e9].map(|x| {
        let scenario = scenario(&format!("base_pose = [0.3, {x}, -1.0]"));
        ApproachTracking::new(&scenario, 4.0).exact_end(&*model, &[0.0; 2]).expect("an end").state
    });
    assert_close("joints", &far.joint_angles, &near.joint_angles, tolerance::INTEGRALS);
    assert_close("x", &[far.base_pose[1] - 1e9], &[near.base_pose[1]], 1e9 * tolerance::ROUNDED_MOTION);
}

/// Whole turns of a joint change nothing but its angle.
#[test]
fn the_end_does_not_count_turns() {
    let model = model();
    let turns = 1e6 * std::f64::consts::TAU;
    let [few, many] = [0.0, turns].map(|more| {
        let mut scenario = scenario(MOVING);
        scenario.initial.joint_angles[1] += more;
        scenario.approach.final_joint_angles[1] += more;
        let mut end = ApproachTracking::new(&scenario, 4.0).exact_end(&*model, &[0.0; 2]).expect("an end");
        end.state.joint_angles[1] -= more;
        numbers(&end)
    });
    // of yaws of end effectors too
    let off = few.iter().zip(&many).map(|(few, many)| (many - few) - turns * f64::round((many - few) / turns));
    assert_close("end", &off.collect::<Vec<_>>(), &vec![0.0; few.len()], turns * tolerance::ROUNDED_MOTION);
}

/// Half a turn in a nanosecond has rates on the way to rest that are rounded by more than the end may change.
#[test]
fn an_end_that_does_not_settle() {
    let mut scenario = scenario("");
    (scenario.approach.duration, scenario.approach.trajectory_duration) = (1e-9, None);
    let error = ApproachTracking::new(&scenario, 4.0).exact_end(&*model(), &[0.0; 2]).expect_err("no end");
    let Error::NotConverged { iterations, change, .. } = error.source else { panic!("{error}") };
    // from one panel to 256
    assert_eq!((iterations, error.time.to_bits()), (8, f64::to_bits(1e-9)));
    assert!(change > TOLERANCE, "{change}");
}
