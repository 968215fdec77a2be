//! `check`: descriptions of layouts, scenarios and sweeps.

use super::{LAYOUT, SCENARIO, check, inspect_text};
use planar_capture::check::{CheckReport, inspect};
use planar_capture::registry::SHIPPED;
use planar_proof::file;
use std::fs;
use std::path::Path;

/// Words of a text, whose lines are short.
fn in_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn description_of_a_layout() {
    let (_, out, _) = check(&["dual_arm_3r"], Path::new("."));
    for expected in [
        "dual_arm_3r: a layout, sha256 a6de99dfde72\n",
        "degrees of freedom  9: base 3, joints 6\n",
        "mass                560 kg, 89.29 % of it in the base\n",
        "radius of gyration 0.4089 m\n",
        "inertia             265.4 kg m² about",
        "structure           2 arms of 3 + 3 links\n",
        "generated code      generated::dual_arm_3r\n",
        "  arm1      3         30           3                3.5  (0.5, 0)\n",
    ] {
        assert!(out.contains(expected), "no `{expected}` in\n{out}");
    }
    // all bodies in line: Σ I + m x² − M x̄², by hand: links at 1, 2, 3 and 0, 1, 2 m
    let (squares, first): (f64, f64) = (10.0 * (1.0 + 4.0 + 9.0 + 0.0 + 1.0 + 4.0), 10.0 * (6.0 + 3.0));
    let inertia = 83.61 + 6.0 * 1.05 + squares - first * first / 560.0;
    assert_eq!(format!("{inertia:.1}"), "265.4");
    let CheckReport { description, .. } = inspect_text(&LAYOUT.replace("[-0.5, 0.0]", "[-0.5, 0.3]\nmount_angle = 3"));
    assert!(description.contains("(-0.5, 0.3) at 3\n") && description.contains("a mount angle"), "{description}");
    assert!(in_one_line(&description).contains("none of this structure in this build; computed by "), "{description}");
}

#[test]
fn description_of_a_scenario() {
    let (_, out, _) = check(&["raina_shah_2017.toml"], &file("scenarios"));
    for expected in [
        "raina_shah_2017: a scenario\n",
        "robot               dual_arm_3r, 560 kg, sha256 a6de99dfde72\n",
        "generated code      generated::dual_arm_3r\n",
        "start               at rest, base at (0, 0) m, yaw 0 rad\n",
        "approach            20 s in 4000 steps of 0.005 s\n",
        "trajectory          quartic, to end effector twists arm1 [0, -0.1, 0], arm2 [0, 0.1, 0] rad/s, m/s\n",
        "largest turn        joint 2 of arm2, 2.964 rad at up to 0.2779 rad/s\n",
        "tracking            PD, 49 N m/rad, 14 N m s/rad; fastest mode 18.68 1/s, 0.09338 in a step\n",
        "final pose          generalized Jacobian of the given twists of arm1, arm2: smallest/largest",
        "afterwards          50 s in 10000 steps of 0.005 s, of 580 kg together\n",
        "2.512 of at most 3.714\n",
        "case3        target1 [0.2, 0, 0] rigid, target2 [-0.2, 0, 0] rigid\n",
    ] {
        assert!(out.contains(expected), "no `{expected}` in\n{out}");
    }
    let (_, out, _) = check(&["resolved_motion_rate.toml"], &file("scenarios"));
    assert!(out.contains("end effectors       arm1 at (2, -1.5) m, arm2 at (-2, 1.5) m\n"), "{out}");
    // a base of 500 kg and 80 kg m², 39 kg on it, all moving as one with 2 m/s
    let moving = inspect_text(&SCENARIO.replace("[approach]", "base_twist = [0.0, 2.0, 0.0]\n[approach]")).description;
    assert!(in_one_line(&moving).contains("1078, 0] N m s, N s; 1078 J approach"), "{moving}");
}

/// Of a computed torque the errors obey ë + Kd ė + Kp e = 0: the larger of Kd and √Kp bounds the rate.
#[test]
fn the_fastest_mode_of_a_computed_torque() {
    for (gains, expected) in [
        ("", "fastest mode 14 1/s"),
        ("proportional_gain = 400.0\nderivative_gain = 14.0\n", "fastest mode 20 1/s"),
        ("proportional_gain = 400.0\nderivative_gain = 30.0\n", "fastest mode 30 1/s"),
    ] {
        let tracked = format!("[approach]\ntracking = \"computed_torque\"\n{gains}");
        let shown = inspect_text(&SCENARIO.replace("[approach]\n", &tracked)).description;
        assert!(in_one_line(&shown).contains(expected), "{expected} in\n{shown}");
    }
}

/// The rate after `fastest mode` in a line of the description.
fn mode(description: &str, line: &str) -> f64 {
    let text = in_one_line(description);
    let (_, rest) = text.split_once(line).unwrap_or_else(|| panic!("no {line} in {text}"));
    let (_, rest) = rest.split_once("fastest mode ").unwrap_or_else(|| panic!("no mode in {rest}"));
    let word = rest.trim_start_matches("at most ").split(' ').next().expect("a word");
    word.parse().unwrap_or_else(|_| panic!("{word} is no number"))
}

/// Under PD control the fastest mode is that of the pose, first or last, in which the robot is easier to move; after the impact
/// that of the last one.
#[test]
fn the_fastest_mode_is_that_of_the_poses() {
    let [folded, bent] = ["[0.7, -2.6, 2.5, 0.0, 0.0]", "[0.7, -0.4, 0.3, 0.0, 0.0]"];
    let of = |from: &str, to: &str| {
        let text = SCENARIO.replace("[0.7, -1.6, 1.0, 0.0, 0.0]", from).replace("[-0.5, -1.4, -0.1, 0.0, 0.0]", to);
        let hold = "duration = 50.0\ncontrol = \"hold\"\nproportional_gain = 49.0\nderivative_gain = 14.0";
        let shown = inspect_text(&text.replace("duration = 50.0", hold)).description;
        ["tracking ", "control afterwards "].map(|line| mode(&shown, line))
    };
    let [[of_folded, _], [of_bent, _]] = [of(folded, folded), of(bent, bent)];
    assert!((of_folded / of_bent - 1.0).abs() > 0.1, "{of_folded} and {of_bent} 1/s");
    let larger = of_folded.max(of_bent);
    for (from, to, after) in [(folded, bent, of_bent), (bent, folded, of_folded)] {
        let found = of(from, to);
        assert!((found[0] - larger).abs() < 1e-9 && (found[1] - after).abs() < 1e-9, "{found:?}: {larger}, {after}");
    }
}

/// The laws are described with their own numbers, each with its unit.
#[test]
fn the_description_has_the_numbers_of_the_laws() {
    let after = |keys: &str| SCENARIO.replace("duration = 50.0", &format!("duration = 50.0\n{keys}"));
    let before = |keys: &str| SCENARIO.replace("[approach]", &format!("[approach]\n{keys}"));
    let end = "final_joint_angles = [-0.5, -1.4, -0.1, 0.0, 0.0]\nfinal_joint_rates = [0.01, 0.0, 0.0, 0.0, 0.0]";
    let goals = "tracking = \"resolved_motion_rate\"\npose_gain = 2.0\nrate_gain = 5.0\n\
                 final_end_effector_poses = [[1.8, -1.0], [], []]";
    let steered = SCENARIO.replace("\"quartic\"", "\"quintic\"").replace(end, goals);
    for (text, expected) in [
        (after("control = \"hold\"\nproportional_gain = 3.0\nderivative_gain = 2.0"), "hold, 3 N m/rad, 2 N m s/rad"),
        (after("control = \"damping\"\nderivative_gain = [1, 2, 3, 4, 5]"), "damping, [1, 2, 3, 4, 5] N m s/rad"),
        (
            after("control = \"stabilise\"\nderivative_gain = 0.5\nbase_gain = 3.0\nbase_torque_limit = 7.0"),
            "joints 0.5 1/s, base 3 1/s; base torque of at most 7 N m; fastest mode at most 3 1/s",
        ),
        (steered, "resolved motion rate, poses 2 1/s, rates 5 1/s"),
        (
            before("sample_time = 0.02\ntorque_limits = [1, 2, 3, 4, 5]"),
            "; at most [1, 2, 3, 4, 5] N m; sampled every 4 steps, and held",
        ),
        (
            before("trajectory_duration = 20.0"),
            "trajectory quartic, to joint rates [0.01, 0, 0, 0, 0] rad/s largest turn",
        ),
    ] {
        let shown = in_one_line(&inspect_text(&text).description);
        assert!(shown.contains(expected), "no `{expected}` in\n{shown}");
    }
}

/// A robot whose joints turn is not at rest, and arms without a task have no final pose.
#[test]
fn the_description_says_what_moves() {
    let turning = SCENARIO.replace("[approach]", "joint_rates = [0.0, 0.0, 0.0, 0.1, 0.0]\n[approach]");
    let shown = inspect_text(&turning).description;
    assert!(!shown.contains("at rest") && shown.contains("momentum [l, px, py]"), "{shown}");
    let (_, out, _) = check(&["redysim_single_arm_3r.toml"], &file("scenarios"));
    assert!(out.contains("start               at rest") && !out.contains("final pose"), "{out}");
    // one kind for all contacts of a target, or each
    let (_, out, _) = check(&["large_target.toml"], &file("scenarios"));
    assert!(in_one_line(&out).contains("rigid and pin") || in_one_line(&out).contains("pin and rigid"), "{out}");
}

#[test]
fn description_of_a_sweep() {
    let (code, out, err) = check(&["uncertain_capture.toml"], &file("scenarios/sweeps"));
    assert_eq!((code, &*err), (0, ""), "its adaptive steps are as short as the motion needs");
    for expected in [
        "uncertain_capture: a sweep\n",
        "scenario            capture, its case case2\n",
        "cases               1000, latin_hypercube, in 1 file\n",
        // 10 ± 1.645, and uniform
        "varies              target.target1.mass [kg]: 10 (8.355 to 11.64 in 90 % of the cases)\n",
        "varies              case.case2.target_twists.target1[0] [rad/s]: 0 (-0.18 to 0.18 in 90 % of the cases)\n",
        "varies              approach.proportional_gain[2]: 40.0, 49.0, 60.0\n",
        "correlated          target.target1.mass with target.target1.inertia: rank correlation 0.6\n",
        "outputs             the default ones, path_errors\n",
        "time series         of case 0, every 0.05 s\n",
    ] {
        assert!(out.contains(expected), "no `{expected}` in\n{out}");
    }
}

/// The number of the paper's robot, from its equations of motion: the damping of the stiffest joint motion.
#[test]
fn the_fastest_mode_decays_as_fast_as_a_simulation() {
    use planar_capture::generated::dual_arm_3r::Model;
    let robot = Model::<f64>::default();
    let angles = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047];
    // power iteration on I⁻¹ Kd, as accelerations under torques that are 14 times the rates
    let mut rates = [1.0, -2.0, 3.0, 0.0, 0.0, 0.0];
    let mut growth = 0.0;
    for _ in 0..2000 {
        let torques = rates.map(|rate| 14.0 * rate);
        let configuration = robot.forward_dynamics_configuration(&[0.0; 3], &angles);
        let next = configuration.forward_dynamics(&[0.0; 3], &[0.0; 6], &torques).joint_accelerations;
        growth = next.iter().map(|rate| rate * rate).sum::<f64>().sqrt();
        rates = next.map(|rate| rate / growth);
    }
    let there = fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
    let start = there.find("final_joint_angles").expect("angles");
    let end = start + there[start..].find('#').expect("a comment");
    let stay = there.replace(&there[start..end], &format!("final_joint_angles = {angles:?} "));
    let shown = inspect(&stay, "it.toml", Path::new(""), SHIPPED).expect("a scenario").description;
    let expected = format!("fastest mode {growth:.2} 1/s");
    assert!(shown.contains(&expected), "{expected} in\n{shown}");
}
