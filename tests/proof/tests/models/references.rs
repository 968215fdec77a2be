//! Every quantity of layouts of different structure against Pinocchio and MuJoCo: see `tests/README.md`.

use planar_capture::dynamics::Model;
use planar_capture::impact::{RigidImpactOutput, exact};
use planar_capture::layout::Layout;
use planar_capture::owned::CloneModel;
use planar_capture::registry;
use planar_capture::state::{Forces, State};
use planar_capture::target::Target;
use planar_proof::{assert_close, file, json, layout, numbers, tolerance};
use serde_json::{Value, json as object};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

/// Layouts with a file written by `reference/pinocchio_states.py`.
const LAYOUTS: [&str; 4] = ["asymmetric_wheel", "boom_7r", "single_arm_2r", "triple_arm_3r"];

/// Quantities that MuJoCo computes too.
const MUJOCO: [&str; 9] = [
    "angular_momentum",
    "base_acceleration",
    "bias",
    "end_effector_jacobian",
    "end_effector_poses",
    "joint_accelerations",
    "kinetic_energy",
    "linear_momentum",
    "mass_matrix",
];

/// The implementations of a layout's dynamics.
fn implementations(layout: &Layout) -> Vec<(&'static str, Box<dyn CloneModel>)> {
    vec![
        ("generated", registry::generated(layout).unwrap_or_else(|e| panic!("{e}"))),
        ("generic", registry::generic(layout)),
    ]
}

fn reference(name: &str) -> Value {
    json(&format!("tests/reference/states_{name}.json"))
}

#[test]
fn the_files_are_those_of_the_layouts() {
    let listed = std::fs::read_dir(file("tests/reference")).expect("a folder");
    let names = listed.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name"));
    let mut found: Vec<String> = names.filter(|name| name.starts_with("states_")).collect();
    found.sort();
    assert_eq!(found, LAYOUTS.map(|name| format!("states_{name}.json")), "see tests/README.md");
    for name in LAYOUTS {
        let reference = reference(name);
        assert_eq!(reference["layout"], name);
        let (made_for, now) = (&reference["sha256"], layout(name).sha256());
        assert_eq!(*made_for, now, "{name} has changed: make its states again, see tests/README.md");
    }
}

#[test]
fn every_quantity_is_pinocchios_and_mujocos() {
    let mut worst = Worst::default();
    for name in LAYOUTS {
        let reference = reference(name);
        let states = reference["states"].as_array().expect("states");
        assert!(states.len() >= 12, "{name}: {} states", states.len());
        assert!(states.iter().filter(|state| state.get("targets").is_some()).count() >= 8, "{name}: captures");
        for (model_name, model) in implementations(&layout(name)) {
            for state in states {
                let what = format!("{model_name} {name}, {}", state["regime"]);
                let found = evaluate(&*model, state);
                contacts_hold(&what, state);
                worst.compare(&format!("{what}, Pinocchio"), "expect", &found, &state["expect"]);
                let shared = MUJOCO.map(|key| (key.to_owned(), found[key].clone())).into_iter().collect();
                worst.compare(&format!("{what}, MuJoCo"), "mujoco", &Value::Object(shared), &state["mujoco"]);
            }
        }
    }
    println!("{:#?}", worst.0); // cargo test --test references -- --nocapture
}

/// An independent author's Pinocchio model of the paper's robot, with the yaw of the end effectors wrapped to one turn.
#[test]
fn the_papers_robot_is_pinocchios() {
    let reference = json("tests/reference/pinocchio_dual_arm_3r.json");
    let states = reference["states"].as_array().expect("states");
    assert!(states.iter().filter(|state| state.get("targets").is_some()).count() > 10, "the states have targets");
    let mut worst = Worst::default();
    for (model_name, model) in implementations(&layout("dual_arm_3r")) {
        for (i, state) in states.iter().enumerate() {
            let (mut found, expect) = (evaluate(&*model, state), &state["expect"]);
            for arm in 0..model.arms() {
                let yaw = |poses: &Value| poses["end_effector_poses"][arm][0].as_f64().expect("a yaw");
                let turns = ((yaw(&found) - yaw(expect)) / TAU).round();
                found["end_effector_poses"][arm][0] = (yaw(&found) - turns * TAU).into();
            }
            worst.compare(&format!("{model_name} dual_arm_3r, state {i}"), "expect", &found, expect);
        }
    }
}

/// Largest relative differences so far, by source and quantity.
#[derive(Default)]
struct Worst(BTreeMap<String, f64>);

impl Worst {
    /// Fails unless both have the same keys, and numbers that agree relative to the largest expected one of each key.
    fn compare(&mut self, what: &str, path: &str, found: &Value, expected: &Value) {
        if let (Some(found), Some(expected)) = (found.as_object(), expected.as_object()) {
            assert!(found.keys().collect::<BTreeSet<_>>() == expected.keys().collect(), "{what}: keys of {path}");
            for (key, expected) in expected {
                self.compare(what, &format!("{path}.{key}"), &found[key], expected);
            }
            return;
        }
        assert_eq!(shape(found), shape(expected), "{what}: {path}");
        let (found, expected) = (numbers(found), numbers(expected));
        let size = expected.iter().fold(0.0, |most: f64, e| most.max(e.abs()));
        let bound = match path.split('.').collect::<Vec<_>>()[..] {
            ["expect", "capture", _] | ["expect", "impact", "joint_rates_after"] => tolerance::OUTSIDE_IMPACT,
            ["mujoco", _] => tolerance::MUJOCO,
            _ => tolerance::PINOCCHIO,
        };
        assert_close(&format!("{what}: {path}"), &found, &expected, bound * size);
        let relative = planar_proof::difference(&found, &expected) / size.max(f64::MIN_POSITIVE);
        let most = self.0.entry(path.to_owned()).or_default();
        *most = most.max(relative);
    }
}

/// Eq. (13), `J_e v = J_t t_t` after the capture, with `J_t` the product's and all else the reference's.
fn contacts_hold(what: &str, state: &Value) {
    let Some(list) = state.get("targets") else { return };
    let (expect, after) = (&state["expect"], &state["expect"]["capture"]);
    let velocity = [numbers(&after["base_twist_after"]), numbers(&after["joint_rates_after"])].concat();
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    for (arm, target) in targets(list).iter().enumerate() {
        let Some(target) = target else { continue };
        let twist = three(&after["target_twists_after"][arm]);
        let contact = target.contact_jacobian().map(|row| dot(&row, &twist));
        let end_effector =
            [0, 1, 2].map(|row| dot(&numbers(&expect["end_effector_jacobian"][3 * arm + row]), &velocity));
        let size = end_effector.iter().fold(0.0, |most: f64, t| most.max(t.abs()));
        assert_close(
            &format!("{what}: contact of arm {arm}"),
            &contact,
            &end_effector,
            tolerance::OUTSIDE_IMPACT * size,
        );
    }
}

/// A JSON value with every number replaced by 0: its nesting, its lengths and its nulls.
fn shape(value: &Value) -> Value {
    match value {
        Value::Array(items) => items.iter().map(shape).collect(),
        Value::Number(_) => 0.into(),
        other => other.clone(),
    }
}

/// Numbers of a state; `length` zeros where the key is absent.
fn vector(state: &Value, key: &str, length: usize) -> Vec<f64> {
    state.get(key).map_or_else(|| vec![0.0; length], numbers)
}

fn three(value: &Value) -> [f64; 3] {
    numbers(value).try_into().expect("three numbers")
}

fn targets(list: &Value) -> Vec<Option<Target<f64>>> {
    let target = |t: &Value| Target {
        mass: t["mass"].as_f64().expect("mass"),
        inertia: t["inertia"].as_f64().expect("inertia"),
        contact: numbers(&t["contact"]).try_into().expect("contact"),
        twist: three(&t["twist"]),
    };
    list.as_array().expect("targets").iter().map(|t| (!t.is_null()).then(|| target(t))).collect()
}

fn matrix(values: &[f64], columns: usize) -> Value {
    values.chunks_exact(columns).collect()
}

/// Results of a state under the keys of `eval`.
fn evaluate(model: &dyn Model<f64>, value: &Value) -> Value {
    let (arms, joints) = (model.arms(), model.joints());
    let size = 3 + joints;
    let (angles, rates) = (numbers(&value["joint_angles"]), numbers(&value["joint_rates"]));
    let pose = three(&value["base_pose"]);
    let state =
        State { base_pose: pose, joint_angles: &angles, base_twist: three(&value["base_twist"]), joint_rates: &rates };

    let (mut mass, mut bias) = (vec![0.0; size * size], vec![0.0; size]);
    model.mass_matrix(&pose, &angles, &mut mass).expect("mass matrix");
    model.bias(&state, &mut bias).expect("bias");
    let (mut poses, mut end_effectors) = (vec![[0.0; 3]; arms], vec![0.0; 3 * arms * size]);
    model.end_effector_poses(&pose, &angles, &mut poses).expect("poses");
    model.end_effector_jacobian(&pose, &angles, &mut end_effectors).expect("Jacobian");
    let (mut inertia, mut reduced) = (vec![0.0; joints * joints], vec![0.0; joints]);
    let mut jacobian = vec![0.0; 3 * arms * joints];
    model.reduced_dynamics(&state, &mut inertia, &mut reduced, &mut jacobian).expect("reduced dynamics");

    let torques = vector(value, "joint_torques", joints);
    let wrenches = value.get("end_effector_wrenches").map(|w| w.as_array().expect("wrenches").iter().map(three));
    let wrenches: Option<Vec<[f64; 3]>> = wrenches.map(Iterator::collect);
    let forces = Forces {
        joint_torques: &torques,
        base_wrench: value.get("base_wrench").map(three),
        end_effector_wrenches: wrenches.as_deref(),
    };
    let mut accelerations = vec![0.0; joints];
    let base = model.forward_dynamics(&state, &forces, &mut accelerations).expect("accelerations");
    let momentum = model.momentum(&state).expect("momentum");

    let mut found = object!({
        "mass_matrix": matrix(&mass, size),
        "bias": bias,
        "generalized_inertia": matrix(&inertia, joints),
        "generalized_bias": reduced,
        "end_effector_poses": poses,
        "end_effector_jacobian": matrix(&end_effectors, size),
        "generalized_jacobian": matrix(&jacobian, joints),
        "base_acceleration": base,
        "joint_accelerations": accelerations,
        "linear_momentum": momentum.linear_momentum,
        "angular_momentum": momentum.angular_momentum,
        "kinetic_energy": momentum.kinetic_energy,
    });
    if let Some(list) = value.get("targets") {
        let targets = targets(list);
        found["impact"] = reduced_impact(model, &state, &targets);
        found["capture"] = capture(model, &state, &targets);
    }
    found
}

/// The paper's (15) and (16).
fn reduced_impact(model: &dyn Model<f64>, state: &State<'_, f64>, targets: &[Option<Target<f64>>]) -> Value {
    let joints = model.joints();
    let (mut g, mut h, mut after) = (vec![0.0; joints * joints], vec![0.0; joints], vec![0.0; joints]);
    model.reduced_impact(state, targets, &mut g, &mut h, &mut after).expect("reduced impact");
    object!({ "G": matrix(&g, joints), "H": h, "joint_rates_after": after })
}

/// The exact impact.
fn capture(model: &dyn Model<f64>, state: &State<'_, f64>, targets: &[Option<Target<f64>>]) -> Value {
    let (mut rates, mut twists) = (vec![0.0; model.joints()], vec![[0.0; 3]; model.arms()]);
    let mut impulses = twists.clone();
    let mut after = RigidImpactOutput { joint_rates: &mut rates, target_twists: &mut twists, impulses: &mut impulses };
    let base = exact(model, state, targets, &mut after).expect("exact impact");
    let captured = |values: &[[f64; 3]]| -> Vec<Option<[f64; 3]>> {
        targets.iter().zip(values).map(|(target, value)| target.map(|_| *value)).collect()
    };
    object!({
        "base_twist_after": base,
        "joint_rates_after": rates,
        "target_twists_after": captured(&twists),
        "impulses": captured(&impulses),
    })
}
