//! `planar-capture eval`: its numbers against Pinocchio's, and its errors for invalid states.

use crate::command;
use assert_cmd::Command;
use planar_capture::eval::States;
use planar_proof::linear_time::assert_linear_time;
use planar_proof::{said, tolerance};
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;

fn eval(layout: &str, states: &str, dynamics: &str) -> (i32, Vec<Value>, String) {
    let mut command = Command::from_std(command());
    let output = command.args(["eval", layout, "-", "--dynamics", dynamics]).write_stdin(states).output();
    let (code, out, err) = said(output.expect("it runs"));
    let array = match code {
        _ if out.is_empty() => "[]".to_owned(),
        0 => out,
        // the results of the states before an invalid one are no whole array
        _ => out + "]",
    };
    let results = serde_json::from_str(&array).expect("a JSON array");
    (code, results, err)
}

/// The reference's states without the expected results, and these.
fn reference() -> (Vec<Value>, Vec<Value>) {
    let mut reference = planar_proof::json("tests/reference/pinocchio_dual_arm_3r.json");
    let states = reference["states"].as_array_mut().expect("an array").iter_mut();
    states
        .map(|state| {
            let state = state.as_object_mut().expect("an object");
            let expected = state.shift_remove("expect").expect("what is expected");
            (Value::Object(state.clone()), expected)
        })
        .unzip()
}

/// Largest error over the largest entry; the shape must be the same, and so must `null`s.
fn error(found: &Value, expected: &Value, yaws: bool) -> f64 {
    fn walk(found: &Value, expected: &Value, yaw: bool, worst: &mut [f64; 2]) {
        if let (Value::Array(found), Value::Array(expected)) = (found, expected) {
            assert_eq!(found.len(), expected.len());
            for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
                walk(found, expected, yaw && i == 0, worst);
            }
        } else if let (Some(found), Some(expected)) = (found.as_f64(), expected.as_f64()) {
            let turns = if yaw { ((found - expected) / TAU).round() } else { 0.0 };
            worst[0] = worst[0].max((found - expected - turns * TAU).abs());
            worst[1] = worst[1].max(expected.abs());
        } else {
            assert!(found.is_null() && expected.is_null(), "{found} is not {expected}");
        }
    }
    let mut worst = [0.0; 2];
    if yaws {
        for (found, expected) in found.as_array().expect("poses").iter().zip(expected.as_array().expect("poses")) {
            walk(found, expected, true, &mut worst);
        }
    } else {
        walk(found, expected, false, &mut worst);
    }
    if worst[0] == 0.0 { 0.0 } else { worst[0] / worst[1] }
}

/// Every quantity by name, those of the impact as `impact.G`.
fn quantities(result: &Value) -> Map<String, Value> {
    let mut all = Map::new();
    for (key, value) in result.as_object().expect("an object") {
        match value {
            Value::Object(block) => all.extend(block.iter().map(|(k, v)| (format!("{key}.{k}"), v.clone()))),
            value => drop(all.insert(key.clone(), value.clone())),
        }
    }
    all
}

#[test]
fn both_implementations_agree_with_pinocchio() {
    let (states, expected) = reference();
    assert_eq!(states.len(), 16);
    let with_targets = expected.iter().filter(|e| e.get("capture").is_some()).count();
    assert_eq!(with_targets, 14);
    for dynamics in ["generated", "generic"] {
        let (code, results, problems) = eval("dual_arm_3r", &Value::from(states.clone()).to_string(), dynamics);
        assert_eq!((code, problems.as_str(), results.len()), (0, "", states.len()));
        for (index, (result, expected)) in results.iter().zip(&expected).enumerate() {
            let (found, expected) = (quantities(result), quantities(expected));
            assert!(found.keys().eq(expected.keys()), "the keys, in the order of the contract: {:?}", found.keys());
            for ((name, found), expected) in found.iter().zip(expected.values()) {
                let error = error(found, expected, name == "end_effector_poses");
                assert!(error <= tolerance::PINOCCHIO, "{dynamics}, state {index}: {name} is off by {error:e}");
            }
        }
    }
}

#[test]
fn missing_forces_are_zero_and_targets_are_optional() {
    let state =
        json!({"base_pose": [0, 0, 0], "joint_angles": [1, 2, 3], "base_twist": [0, 0, 0], "joint_rates": [0, 0, 0]});
    let mut written = state.clone();
    written["joint_torques"] = json!([0, 0, 0]);
    written["base_wrench"] = json!([0, 0, 0]);
    written["end_effector_wrenches"] = json!([[0, 0, 0]]);
    written["targets"] = json!([null]);
    let (code, results, problems) = eval("single_arm_3r", &json!([state, written]).to_string(), "generated");
    assert_eq!((code, problems.as_str()), (0, ""));
    assert_eq!(results[0], results[1]);
    assert_eq!(results[0]["joint_accelerations"], json!([0.0, 0.0, 0.0]));
    assert!(results[0].get("impact").is_none() && results[0].get("capture").is_none());
}

#[test]
fn numbers_round_trip() {
    let (states, _) = reference();
    let (_, results, _) = eval("dual_arm_3r", &json!([states[0]]).to_string(), "generated");
    let again: Value = serde_json::from_str(&results[0].to_string()).expect("JSON");
    assert_eq!(again, results[0]);
}

#[test]
fn no_states_give_no_results() {
    assert_eq!(eval("dual_arm_3r", " [ ]\n", "generated"), (0, Vec::new(), String::new()));
}

/// What reads the results cannot take those before an invalid state for all: there are none, or their array stays open.
#[test]
fn results_before_an_invalid_state_are_no_json() {
    let (states, _) = reference();
    let said = |states: Value| {
        let mut command = Command::from_std(command());
        command.args(["eval", "dual_arm_3r", "-", "-q"]).write_stdin(states.to_string());
        said(command.output().expect("it runs"))
    };
    let (code, out, err) = said(json!([1, states[0]]));
    assert_eq!((code, out.as_str()), (2, ""), "{err}");
    let (code, out, err) = said(json!([states[0], 1]));
    assert!(code == 2 && out.starts_with("[\n{"), "{err}");
    assert!(serde_json::from_str::<Value>(&out).is_err_and(|error| error.is_eof()), "{out}");
}

#[test]
fn what_computes_is_not_said_where_it_is_to_be_quiet() {
    let said = |quiet: &[&str]| {
        let mut command = Command::from_std(command());
        command.args(["eval", "dual_arm_3r", "-"]).args(quiet).write_stdin("[]");
        said(command.output().expect("it runs"))
    };
    let (code, out, err) = said(&[]);
    assert!(code == 0 && out == "[\n]\n" && err.starts_with("dynamics: "), "{err}");
    assert_eq!(said(&["-q"]), (0, "[\n]\n".to_owned(), String::new()));
}

/// Error for two valid states and one made invalid by `change`: exit code 2 and two results.
fn error_of(change: impl FnOnce(&mut Value)) -> String {
    let (states, _) = reference();
    let mut bad = states[2].clone();
    change(&mut bad);
    let (code, results, problem) = eval("dual_arm_3r", &json!([states[2], states[3], bad]).to_string(), "generated");
    assert_eq!((code, results.len()), (2, 2), "{problem}");
    assert!(problem.starts_with("error: standard input: "), "{problem}");
    assert!(problem.contains("state 2: "), "{problem}");
    problem
}

#[test]
fn a_bad_state_is_named_with_key_value_and_what_would_be_right() {
    let said = |change: &dyn Fn(&mut Value)| error_of(|state| change(state));
    let holds = |text: String, parts: &[&str]| {
        for part in parts {
            assert!(text.contains(part), "`{part}` is not in: {text}");
        }
    };
    holds(said(&|s| s["joint_angles"] = json!([1, 2])), &["`joint_angles` is [1,2]", "expected 6 numbers", "it has 2"]);
    holds(
        said(&|s| s["joint_angels"] = json!([1])),
        &["unknown key `joint_angels` ([1])", "did you mean `joint_angles`"],
    );
    holds(said(&|s| s["expect"] = json!(1)), &["unknown key `expect`", "`end_effector_wrenches` and `targets`"]);
    holds(said(&|s| s["base_pose"] = json!([0, "x", 0])), &["`base_pose[1]` is \"x\"", "expected a number"]);
    holds(said(&|s| s["base_twist"] = Value::Null), &["`base_twist` is null", "[ω, vx, vy] in rad/s, m/s, m/s"]);
    holds(said(&|s| drop(s.as_object_mut().map(|s| s.remove("joint_rates")))), &["missing key `joint_rates`"]);
    holds(said(&|s| s["base_pose"] = json!(1)), &["`base_pose` is 1", "[yaw, x, y] in rad, m, m"]);
    holds(said(&|s| s["base_wrench"] = json!([1])), &["`base_wrench` is [1]", "expected [n, fx, fy] in N m, N, N"]);
    let wrenches = "expected 2 wrenches [n, fx, fy] in N m, N, N, one per arm";
    holds(said(&|s| s["end_effector_wrenches"] = json!([])), &["`end_effector_wrenches` is []", wrenches]);
    holds(
        said(&|s| s["end_effector_wrenches"] = json!([[0, 0, 0], [1]])),
        &["`end_effector_wrenches[1]` is [1]", "expected [n, fx, fy] in N m, N, N"],
    );
    holds(said(&|s| s["targets"] = json!([null])), &["expected 2 targets, one per arm", "it has 1"]);
    holds(said(&|s| s["targets"][1]["mass"] = json!(0)), &["`targets[1].mass` is 0", "greater than 0"]);
    holds(said(&|s| s["targets"][1]["inertia"] = json!(-1)), &["`targets[1].inertia` is -1", "greater than 0"]);
    holds(said(&|s| s["targets"][0]["contact"] = json!([1])), &["`targets[0].contact` is [1]", "[rx, ry] in m"]);
    holds(
        said(&|s| s["targets"][0]["spin"] = json!(1)),
        &["unknown key `targets[0].spin` (1)", "`contact` and `twist`"],
    );
    holds(
        said(&|s| s["targets"][1]["mass"] = json!(1e14)),
        &["`targets[1].mass` is 1", "expected at most 5.600e8 kg", "1e6 times that of the robot, 5.600e2"],
    );
    holds(said(&|s| s["targets"][1]["inertia"] = json!(1e14)), &["`targets[1].inertia` is 1", "kg m², 1e6 times"]);
    // positions are no angles
    let mut far = reference().0[2].clone();
    far["base_pose"] = json!([0.0, 2e6, -3e6]);
    let (code, results, problem) = eval("dual_arm_3r", &json!([far]).to_string(), "generated");
    assert_eq!((code, results.len()), (0, 1), "{problem}");
    holds(said(&|s| s["base_pose"][0] = json!(-2e6)), &["`base_pose[0]` is -2", "an angle of at most 1e6 rad"]);
    holds(said(&|s| s["joint_angles"][5] = json!(1e50)), &["`joint_angles[5]` is 1", "an angle of at most 1e6 rad"]);
    holds(
        said(&|s| s["joint_rates"] = json!([1e200, 0, 0, 0, 0, 0])),
        &["input: line 1: state 2: ", "= inf is not a finite number"],
    );
}

#[test]
fn text_that_is_no_array_of_states_is_an_error_with_its_line() {
    let (states, _) = reference();
    let good = states[0].to_string();
    let cases = [
        (String::new(), 0, "line 1: expected an array of states"),
        ("{}".to_owned(), 0, "line 1: expected an array of states, `[{…}, …]`, but found `{`"),
        ("[1]".to_owned(), 0, "state 0: the state is 1, expected an object"),
        (format!("[{good},\n]"), 1, "line 2: state 1: expected a state, `{…}`, but found `]`"),
        (format!("[{good}\n{good}]"), 0, "state 0: not JSON: trailing characters"),
        (format!("[{good}"), 0, "state 0: expected the end of this state"),
        ("\u{1f}".to_owned(), 0, "line 1: expected an array of states, `[{…}, …]`, but found byte 0x1f"),
        (format!("[{good}]\n\nx"), 1, "line 3: expected nothing after the array, but found `x`"),
        (
            format!("[\n{}]", good.replace("\"joint_torques\":[", "\"joint_torques\":[1e999,")),
            0,
            "line 2: state 0: `joint_torques[0]` is 1e999, expected a finite number",
        ),
        (
            good.replace("{\"base_pose\"", "[{\"base_pose\":[0,0,0],\"base_pose\"") + "]",
            0,
            "`base_pose` is given twice",
        ),
        (
            "[\n{\"base_pose\": [0, 0, 0],\n\n\"base_pose\": [0, 0, 0]}]".to_owned(),
            0,
            "line 4: state 0: `base_pose` is given",
        ),
        (format!("[{good},{}", "[".repeat(100_000)), 1, "state 1: expected the end of this state"),
    ];
    for (text, count, said) in cases {
        let (code, results, problem) = eval("dual_arm_3r", &text, "generated");
        assert_eq!((code, results.len()), (2, count), "{problem}");
        assert!(problem.contains(said), "`{said}` is not in: {problem}");
    }
}

#[test]
fn a_layout_without_generated_code_is_an_error_that_says_what_to_do() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let path = folder.join("one_link.toml");
    let text = "name = \"one_link\"\n[base]\nmass = 5\ninertia = 2\n[[arm]]\nname = \"a\"\nmount = [0, 1]\n\
                [[arm.link]]\nlength = 1\nmass = 1\ninertia = 1\n";
    std::fs::write(&path, text).expect("written");
    let path = path.to_str().expect("UTF-8");
    let state = json!([{"base_pose": [0, 0, 0], "joint_angles": [0], "base_twist": [0, 0, 0], "joint_rates": [1]}]);
    let (code, results, problem) = eval(path, &state.to_string(), "generated");
    assert_eq!((code, results.len()), (2, 0));
    for part in ["one_link", "the generic implementation", "planar-capture new"] {
        assert!(problem.contains(part), "{problem}");
    }
    let (code, results, problem) = eval(path, &state.to_string(), "generic");
    assert_eq!((code, results.len(), problem.as_str()), (0, 1, ""));
    // a 1 kg link turning at 1 rad/s about its end: T = ½ (I + m (l/2)²) ω²
    assert_eq!(results[0]["kinetic_energy"], json!(0.625));
    let (code, _, problem) = eval("dual_arm_3", "[]", "generated");
    assert_eq!(code, 2);
    assert!(problem.contains("did you mean `dual_arm_3r`"), "{problem}");
}

/// A key is the same however its characters are written; a key with a dot is another than that of an inner value.
#[test]
fn repeated_keys_are_found_however_they_are_written() {
    let (states, _) = reference();
    let good = states[0].to_string();
    for (more, said) in [
        ("\"base\\u005fpose\":[0,0,0],", "line 1: state 0: `base_pose` is given twice"),
        ("\"targets.mass\":1,", "unknown key `targets.mass` (1)"),
        ("\"a\":{\"b\":1},\"a.b\":1,", "unknown key `a`"),
    ] {
        let (code, _, problem) =
            eval("dual_arm_3r", &format!("[{}]", good.replacen('{', &format!("{{{more}"), 1)), "generated");
        assert_eq!(code, 2);
        assert!(problem.contains(said), "no `{said}` in {problem}");
    }
}

#[test]
fn the_time_is_linear_in_the_size_of_a_state() {
    let robot = planar_proof::layout("single_arm_2r");
    let read = |text: &str| {
        let problem = States::new(text.as_bytes(), &robot).next_state().expect_err("no state").to_string();
        assert!(problem.len() < 1000, "{problem}");
    };
    let many = |count: usize, one: &dyn Fn(usize) -> String| (0..count).map(one).collect::<Vec<_>>().join(",");
    let is_linear = |what: &str, text: &dyn Fn(usize) -> String| assert_linear_time(what, text, read);
    is_linear("the same key", &|count| format!("[{{{}}}]", many(count, &|_| "\"a\":1".to_owned())));
    is_linear("other keys", &|count| format!("[{{{}}}]", many(count, &|i| format!("\"a{i}\":1"))));
    is_linear("a repeated key at the end", &|count| {
        format!("[{{\"a\":{{{},\"a1\":2}}}}]", many(count, &|i| format!("\"a{i}\":1")))
    });
    is_linear("a long key around many values", &|count| {
        format!("[{{\"{}\":[{}]}}]", "k".repeat(count), many(count, &|_| "1".to_owned()))
    });
    is_linear("a long key", &|count| format!("[{{\"{}\":1}}]", "base_pose".repeat(count)));
    is_linear("lines", &|count| format!("[{{{}\"joint_rates\":[\"x\"]}}]", "\n".repeat(count)));
}

/// The impulse on the robot is the change of its linear momentum, which is rows of its mass matrix times the change of its
/// velocities, whatever the mass of the target.
#[test]
fn impulses_of_rigid_capture_change_the_robots_momentum() {
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().expect("a list").iter().map(|number| number.as_f64().expect("a number")).collect()
    };
    let (states, _) = reference();
    for heavy in [1e3, 1e5, 1e7, 5e8] {
        let mut state = states[2].clone();
        state["targets"][0] =
            json!({"mass": heavy, "inertia": heavy, "contact": [0.1, 0.5], "twist": [0.2, 0.1, -0.3]});
        state["targets"][1] = Value::Null;
        let before = [numbers(&state["base_twist"]), numbers(&state["joint_rates"])].concat();
        for dynamics in ["generated", "generic"] {
            let (code, results, problems) = eval("dual_arm_3r", &json!([state]).to_string(), dynamics);
            assert_eq!((code, problems.as_str()), (0, ""));
            let capture = &results[0]["capture"];
            let after = [numbers(&capture["base_twist_after"]), numbers(&capture["joint_rates_after"])].concat();
            let impulse = numbers(&capture["impulses"][0]);
            let size = impulse.iter().fold(0.0, |most: f64, part| most.max(part.abs()));
            for axis in [1, 2] {
                let row = numbers(&results[0]["mass_matrix"][axis]);
                let change: f64 = row.iter().zip(&after).zip(&before).map(|((m, after), b)| m * (after - b)).sum();
                let error = (impulse[axis] - change).abs() / size;
                assert!(error < 1e-10, "{dynamics}, {heavy:e} kg: off by {error:e}");
            }
        }
    }
}

#[test]
fn a_pivot_that_is_no_number_is_said_in_words() {
    use planar_capture::error::Error;
    let text = |pivot: f64| Error::Singular { what: "G", pivot, limit: 1e-15 }.to_string();
    assert_eq!(
        text(f64::NEG_INFINITY),
        "G is singular: smallest relative pivot is not a finite number, wanted more than 1e-15"
    );
    assert!(text(1e-17).contains("pivot is 1e-17,"));
}

/// Masses and inertias that differ by many orders of magnitude cost no digits: against sixty decimal digits.
#[test]
fn captures_keep_their_digits_whatever_the_ratios_of_inertias() {
    let folder = tempfile::tempdir().expect("a folder");
    let layout = folder.path().join("dual_arm_3r.toml");
    for case in planar_proof::json("tests/reference/captures.json").as_array().expect("an array") {
        let text = toml::to_string(&case["layout"]).expect("TOML");
        std::fs::write(&layout, text).expect("written");
        for dynamics in ["generated", "graph", "generic"] {
            let states = json!([case["state"]]).to_string();
            let (code, results, problems) = eval(layout.to_str().expect("UTF-8"), &states, dynamics);
            assert_eq!((code, problems.as_str()), (0, ""));
            for (name, expected) in case["expect"].as_object().expect("a table") {
                let error = error(&results[0]["capture"][name], expected, false);
                assert!(error < tolerance::CAPTURE, "{dynamics}, {name}: off by {error:e}\n{}", case["state"]);
            }
        }
    }
}

/// A target's moment of inertia is compared with that of the robot, whether this is large by its reach or by its base.
#[test]
fn a_wide_base_may_capture_what_has_as_much_inertia() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let path = folder.path().join("wide.toml");
    // 100 kg with a radius of gyration of 10 m, and 1.5 m of reach
    let text = "name = \"wide\"\n[base]\nmass = 100.0\ninertia = 10000.0\n[[arm]]\nname = \"arm1\"\nmount = [0.5, 0.0]\n\
                [[arm.link]]\nlength = 1.0\nmass = 1.0\ninertia = 0.1\n";
    std::fs::write(&path, text).expect("written");
    let said = |inertia: f64| {
        let target = json!({"mass": 10.0, "inertia": inertia, "contact": [0.0, 0.5], "twist": [0.1, 0.0, 0.0]});
        let state = json!([{
            "base_pose": [0.0, 0.0, 0.0], "joint_angles": [0.3], "base_twist": [0.0, 0.0, 0.0], "joint_rates": [0.0],
            "targets": [target],
        }]);
        eval(path.to_str().expect("UTF-8"), &state.to_string(), "generic")
    };
    let (code, _, problem) = said(0.9 * 101.0 * 100.0 * 1e6);
    assert_eq!(code, 0, "{problem}");
    let (code, _, problem) = said(1.1 * 101.0 * 100.0 * 1e6);
    assert!(code == 2 && problem.contains("`targets[0].inertia` is"), "{problem}");
}

/// A force, or a list of targets, that is `null` is one that is not given.
#[test]
fn what_is_null_is_not_given() {
    let state = reference().0[0].clone();
    let [mut without, mut with] = [state.clone(), state];
    for key in ["joint_torques", "base_wrench", "end_effector_wrenches", "targets"] {
        without.as_object_mut().expect("a state").shift_remove(key);
        with[key] = Value::Null;
    }
    let results = [without, with].map(|state| eval("dual_arm_3r", &json!([state]).to_string(), "generated"));
    assert_eq!(results[1], results[0]);
    assert_eq!((results[0].0, results[0].1.len()), (0, 1), "{}", results[0].2);
}
