//! The generated paper robot against states computed by Pinocchio (`tests/reference/pinocchio_dual_arm_3r.json`).

mod support;

use planar_capture::dynamics::{Conserved, EquationsOfMotion, ForwardDynamics, Impact, Kinematics, ReducedDynamics};
use planar_capture::generated::dual_arm_3r::Model;
use planar_capture::state::{Forces, State};
use planar_capture::target::Target;
use serde_json::Value;
use support::{assert_close, json, numbers, tolerance};

/// Fails unless the numbers agree relative to the largest that is expected.
fn check(what: &str, found: &[f64], expected: &Value) {
    let wanted = numbers(expected);
    let size = wanted.iter().fold(0.0, |most: f64, w| most.max(w.abs()));
    assert_close(what, found, &wanted, tolerance::PINOCCHIO * size);
}

fn three(value: &Value) -> [f64; 3] {
    numbers(value).try_into().unwrap_or([0.0; 3])
}

fn targets(state: &Value) -> Option<Vec<Option<Target<f64>>>> {
    let list = state.get("targets")?.as_array()?;
    let target = |t: &Value| Target {
        mass: t["mass"].as_f64().expect("mass"),
        inertia: t["inertia"].as_f64().expect("inertia"),
        contact: numbers(&t["contact"]).try_into().expect("contact"),
        twist: three(&t["twist"]),
    };
    Some(list.iter().map(|t| (!t.is_null()).then(|| target(t))).collect())
}

#[test]
fn every_quantity_of_every_state() {
    let reference = json("tests/reference/pinocchio_dual_arm_3r.json");
    let model = Model::<f64>::default();
    let mut with_targets = 0;
    for value in reference["states"].as_array().expect("states") {
        let (angles, rates) = (numbers(&value["joint_angles"]), numbers(&value["joint_rates"]));
        let base_pose = three(&value["base_pose"]);
        let state =
            State { base_pose, joint_angles: &angles, base_twist: three(&value["base_twist"]), joint_rates: &rates };
        let expect = &value["expect"];
        kinematics(&model, &state, expect);
        dynamics(&model, &state, value, expect);
        if let Some(targets) = targets(value) {
            impacts(&model, &state, &targets, expect);
            with_targets += 1;
        }
    }
    assert!(with_targets > 10, "the states have targets");
}

fn kinematics(model: &Model<f64>, state: &State<'_, f64>, expect: &Value) {
    let mut poses = [[0.0; 3]; 2];
    Kinematics::end_effector_poses(model, &state.base_pose, state.joint_angles, &mut poses).expect("poses");
    for (pose, wanted) in poses.iter_mut().zip(expect["end_effector_poses"].as_array().expect("poses")) {
        // the reference wraps the yaw, the contract does not
        let turns = ((pose[0] - three(wanted)[0]) / std::f64::consts::TAU).round();
        pose[0] -= turns * std::f64::consts::TAU;
    }
    check("end_effector_poses", poses.as_flattened(), &expect["end_effector_poses"]);
    let mut jacobian = [0.0; 54];
    Kinematics::end_effector_jacobian(model, &state.base_pose, state.joint_angles, &mut jacobian).expect("jacobian");
    check("end_effector_jacobian", &jacobian, &expect["end_effector_jacobian"]);
}

fn dynamics(model: &Model<f64>, state: &State<'_, f64>, value: &Value, expect: &Value) {
    let (mut mass, mut bias) = ([0.0; 81], [0.0; 9]);
    EquationsOfMotion::mass_matrix(model, &state.base_pose, state.joint_angles, &mut mass).expect("M");
    EquationsOfMotion::bias(model, state, &mut bias).expect("bias");
    check("mass_matrix", &mass, &expect["mass_matrix"]);
    check("bias", &bias, &expect["bias"]);
    let (mut inertia, mut bias, mut jacobian) = ([0.0; 36], [0.0; 6], [0.0; 36]);
    ReducedDynamics::reduced_dynamics(model, state, &mut inertia, &mut bias, &mut jacobian).expect("reduced");
    check("generalized_inertia", &inertia, &expect["generalized_inertia"]);
    check("generalized_bias", &bias, &expect["generalized_bias"]);
    check("generalized_jacobian", &jacobian, &expect["generalized_jacobian"]);

    let torques = value.get("joint_torques").map_or(vec![0.0; 6], numbers);
    let wrenches = value.get("end_effector_wrenches").map(|w| [three(&w[0]), three(&w[1])]);
    let forces = Forces {
        joint_torques: &torques,
        base_wrench: value.get("base_wrench").map(three),
        end_effector_wrenches: wrenches.as_ref().map(<[_; 2]>::as_slice),
    };
    let mut joints = [0.0; 6];
    let base = ForwardDynamics::forward_dynamics(model, state, &forces, &mut joints).expect("accelerations");
    check("base_acceleration", &base, &expect["base_acceleration"]);
    check("joint_accelerations", &joints, &expect["joint_accelerations"]);

    let momentum = Conserved::momentum(model, state).expect("momentum");
    check("linear_momentum", &momentum.linear_momentum, &expect["linear_momentum"]);
    check("angular_momentum", &[momentum.angular_momentum], &expect["angular_momentum"]);
    check("kinetic_energy", &[momentum.kinetic_energy], &expect["kinetic_energy"]);
}

fn impacts(model: &Model<f64>, state: &State<'_, f64>, targets: &[Option<Target<f64>>], expect: &Value) {
    let (mut g, mut h, mut rates) = ([0.0; 36], [0.0; 6], [0.0; 6]);
    Impact::reduced_impact(model, state, targets, &mut g, &mut h, &mut rates).expect("reduced impact");
    check("G", &g, &expect["impact"]["G"]);
    check("H", &h, &expect["impact"]["H"]);
    check("joint_rates_after (reduced)", &rates, &expect["impact"]["joint_rates_after"]);
    let mut twists = [[0.0; 3]; 2];
    let mut impulses = [[0.0; 3]; 2];
    let mut after =
        planar_capture::impact::After { joint_rates: &mut rates, target_twists: &mut twists, impulses: &mut impulses };
    let base = planar_capture::impact::exact(model, state, targets, &mut after).expect("exact impact");
    let expect = &expect["capture"];
    check("base_twist_after", &base, &expect["base_twist_after"]);
    check("joint_rates_after", &rates, &expect["joint_rates_after"]);
    let captured = |values: [[f64; 3]; 2]| -> Vec<f64> {
        targets.iter().zip(values).filter(|(t, _)| t.is_some()).flat_map(|(_, v)| v).collect()
    };
    check("target_twists_after", &captured(twists), &expect["target_twists_after"]);
    check("impulses", &captured(impulses), &expect["impulses"]);
}
