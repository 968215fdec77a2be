//! `check`: every warning once, and none for valid files.

use super::{LAYOUT, SCENARIO, inspect_text};
use planar_capture::capture::{Silent, StudyError, study};
use planar_capture::check::{CheckReport, inspect};
use planar_capture::registry::{SHIPPED, generated, generic};
use planar_capture::scenario::Scenario;
use planar_proof::file;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// Replaced text, its replacement, the line of the warning, and texts of the warning.
type Edit = (&'static str, &'static str, usize, &'static [&'static str]);

/// Each gives one warning and no more.
const LAYOUT_EDITS: &[Edit] = &[
    // inertia and COM of links
    (
        "inertia = 3.0",
        "inertia = 13.4",
        27,
        &["`arm[1].link[0].inertia` is 13.4", "10 kg m²", "it is 3.4 about the COM"],
    ),
    (
        "inertia = 3.0",
        "inertia = 30",
        27,
        &["more than 10 kg m²", "x · (length − x)", "rod has mass · length² / 12 = 3.333"],
    ),
    (
        "inertia = 1.0\ncom = [0.5, 0.1]",
        "inertia = 3.6\ncom = [0.5, 0.1]",
        15,
        &["more than 2.6 kg m²", "if this one is about the joint, it is 1 about the COM"],
    ),
    // about the joint it would be 36.1 kg m² more, which leaves less than nothing about the COM
    ("inertia = 3.0", "inertia = 3.0\ncom = [1.9, 0.0]", 27, &["more than 1.9 kg m²", "a uniform rod has"]),
    ("inertia = 3.0", "inertia = 3.0\ncom = [2.0, 0.0]", 27, &["more than 0 kg m²", "com = [1, 0] is mid-link"]),
    ("com = [0.5, 0.1]", "com = [0.05, 0.1]", 15, &["`arm[0].link[1].inertia` is 1.0", "0.575 kg m²", "+ y²"]),
    (
        "com = [0.5, 0.1]",
        "com = [1.5, 0.1]",
        16,
        &["`arm[0].link[1].com` is [1.5, 0.1]", "outside the link", "1 m", "[0.5, 0]"],
    ),
    ("com = [0.5, 0.1]", "com = [-0.1, 0]", 16, &["`arm[0].link[1].com` is [-0.1, 0]", "outside the link"]),
    ("com = [0.5, 0.1]", "com = [0.5, 1.1]", 16, &["`arm[0].link[1].com` is [0.5, 1.1]", "outside the link"]),
    (
        "inertia = 3.0",
        "inertia = 3e-4",
        27,
        &["`arm[1].link[0].inertia` is 3e-4", "0.005477 m", "2 m", "point mass", "3.333"],
    ),
    ("inertia = 0.5", "inertia = 0.5\ncom = [0.1, 0.0]", 35, &["`arm[2].link[0].com` is [0.1, 0.0]", "axle", "[0, 0]"]),
    ("inertia = 0.5", "inertia = 0.5\ncom = [0.0, 0.1]", 35, &["`arm[2].link[0].com` is [0.0, 0.1]", "axle"]),
    // the base
    ("mass = 500.0\ninertia = 80.0", "mass = 30\ninertia = 8", 3, &["`base.mass` is 30", "arms together", "39 kg"]),
    ("inertia = 80.0", "inertia = 8e7", 4, &["`base.inertia` is 8e7", "400 m", "kg m²", "83.33"]),
    (
        "inertia = 80.0",
        "inertia = 7e5",
        4,
        &["`base.inertia` is 7e5", "37.42 m", "12.47 times what the arms reach", "3 m"],
    ),
    (
        "inertia = 80.0",
        "inertia = 80.0\noutline = { disc = 0.39 }",
        4,
        &["`base.inertia` is 80.0", "0.4 m", "more than the largest distance of its outline from the COM, 0.39 m"],
    ),
    (
        "length = 2.0\nmass = 10.0\ninertia = 3.0",
        "length = 120.0\nmass = 10.0\ninertia = 3000.0",
        25,
        &["`arm[1].link[0].length` is 120", "120 times", "1 m", "0.12 m"],
    ),
    ("inertia = 80.0", "inertia = 8e-5", 4, &["`base.inertia` is 8e-5", "0.0004 m"]),
    // units of one body
    (
        "mass = 4.0",
        "mass = 4e-6",
        33,
        &["`arm[2].link[0].mass` is 4e-6", "1.25e8 times smaller", "`base.mass`, 500 kg"],
    ),
    ("inertia = 0.5", "inertia = 5e-9", 34, &["`arm[2].link[0].inertia` is 5e-9", "`base.inertia`, 80 kg m²"]),
    // outlines in mm
    (
        "inertia = 80.0",
        "inertia = 80.0\noutline = { box = [1000, 800] }",
        5,
        &["`base.outline` is", "up to 640.3 m from the base COM", "213.4 times what the arms reach", "3 m", "0.6403 m"],
    ),
    (
        "inertia = 3.0",
        "inertia = 3.0\noutline = { capsule = 50.0 }",
        28,
        &["`arm[1].link[0].outline` is", "m from its joint"],
    ),
    // mounts and lengths
    (
        "[-0.5, 0.0]",
        "[-50, 0.0]",
        23,
        &["`arm[1].mount` is [-50, 0.0]", "50 m from the base COM", "125 times", "0.4 m"],
    ),
    ("[-0.5, 0.0]", "[0.0, -50]", 23, &["`arm[1].mount` is [0.0, -50]", "50 m from the base COM"]),
    ("[-0.5, 0.0]", "[0.5, 0.0]", 23, &["`arm[1].mount` is [0.5, 0.0]", "`arm[0]` is mounted there too"]),
    ("length = 1.0", "length = 0.0\ncom = [0, 0]", 9, &["`arm[0].link[0].length` is 0.0", "two joints", "one place"]),
];

const WHEELS: &str = "name = \"wheels\"\n[base]\nmass = 50.0\ninertia = 8.0\n[[arm]]\nname = \"wheel\"\nmount = [0, 0]\n\
                      [[arm.link]]\nlength = 0\nmass = 4.0\ninertia = 0.5\n";

/// As above.
const SCENARIO_EDITS: &[Edit] = &[
    // torques
    (
        "duration = 20.0\ntrajectory",
        "duration = 20.0\ntracking = \"computed_torque\"\ntorque_limits = [0.01, 9, 9, 9, 9]\ntrajectory",
        8,
        &["`approach.torque_limits` is [0.01, 9, 9, 9, 9]", "N m of joint 1 of left", "the arm cannot follow"],
    ),
    // angles
    (
        "joint_angles = [0.7",
        "joint_angles = [6.5",
        4,
        &["`initial.joint_angles[0]` is 6.5", "joint 1 of left", "0.2168"],
    ),
    (
        "angles = [-0.5, -1.4",
        "angles = [-0.5, -9",
        8,
        &["`approach.final_joint_angles[1]` is -9", "joint 2 of left", "-2.717"],
    ),
    (
        "1.0, 0.0, 0.0]\n[approach]\nduration = 20.0\ntrajectory = \"quartic\"\nfinal_joint_angles = [-0.5, -1.4, -0.1, 0.0",
        "1.0, 3.5, 0.0]\n[approach]\nduration = 20.0\ntrajectory = \"quartic\"\nfinal_joint_angles = [-0.5, -1.4, -0.1, -3.5",
        8,
        &["`approach.final_joint_angles[3]` is -3.5", "joint 1 of right", "by -7 rad", "2.783 is the same pose"],
    ),
    (
        "\"quartic\"\nfinal_joint_angles = [-0.5, -1.4, -0.1, 0.0, 0.0]\nfinal_joint_rates = [0.01, 0.0, 0.0, 0.0, 0.0]",
        "\"cycloidal\"\nfinal_joint_angles = [0.7, -1.6, 1.0, 0.0, 0.0]",
        8,
        &["`approach.final_joint_angles` is [0.7", "there already"],
    ),
    (
        "-0.5, -1.4, -0.1, 0.0",
        "-0.5, 0.001, 0, 0.0",
        8,
        &["close to a singular pose of left", "singular value", "bent arms"],
    ),
    // rates, times and gains
    ("duration = 20.0", "duration = 0.2", 6, &["`approach.duration` is 0.2", "up to 11.25 rad/s", "0.3581 s or more"]),
    (
        "duration = 20.0\ntrajectory = \"quartic\"\nfinal_joint_angles = [-0.5, -1.4, -0.1, 0.0, 0.0]\nfinal_joint_rates = [0.01",
        "trajectory_duration = 0.2\nduration = 20.0\ntrajectory = \"quartic\"\nfinal_joint_angles = [-0.5, -1.4, -0.1, 0.0, 0.0]\nfinal_joint_rates = [0.0",
        6,
        &["`approach.trajectory_duration` is 0.2", "up to 11.25 rad/s", "0.3581 s or more"],
    ),
    (
        "rates = [0.01",
        "rates = [10",
        9,
        &["`approach.final_joint_rates[0]` is 10", "joint 1 of left", "10°/s are 0.1745 rad/s"],
    ),
    (
        "joint_rates = [0.01, 0.0, 0.0, 0.0, 0.0]",
        "end_effector_twists = [[0, 1, 0], [0, 0, 0], [0, 0, 0]]",
        9,
        &["final_end_effector_twists` is [[0, 1, 0]", "9 numbers", "5 joints", "final_joint_rates"],
    ),
    (
        "duration = 20.0",
        "duration = 20.0\nstep = 0.5\nintegrator = \"rk4\"",
        7,
        &["`approach.step` is 0.5", "fastest joint motion", "or less"],
    ),
    // torques are held for longer than the step, which is too long already
    (
        "duration = 20.0",
        "duration = 20.0\nstep = 0.5\nsample_time = 1.0\nintegrator = \"rk4\"",
        7,
        &["`approach.step` is 0.5", "fastest joint motion"],
    ),
    (
        "duration = 20.0",
        "duration = 20.0\nderivative_gain = 5e4\nintegrator = \"rk4\"",
        5,
        &["`approach.step` is left at its default: a step of 0.005 s", "gains"],
    ),
    (
        "duration = 20.0",
        "duration = 20.0\nproportional_gain = 0",
        7,
        &["proportional_gain` is 0", "nothing pulls", "49"],
    ),
    // control afterwards
    (
        "duration = 50.0",
        "duration = 50.0\ncontrol = \"hold\"\nproportional_gain = 1e6\nintegrator = \"rk4\"",
        24,
        &["`post_impact.step` is left at its default: a step of 0.005 s", "fastest joint motion", "or less"],
    ),
    (
        "duration = 50.0",
        "duration = 50.0\nstep = 0.4\ncontrol = \"damping\"\nintegrator = \"rk4\"",
        26,
        &["`post_impact.step` is 0.4", "fastest joint motion"],
    ),
    (
        "duration = 50.0",
        "duration = 50.0\nsample_time = 2\ncontrol = \"stabilise\"",
        26,
        &["`post_impact.sample_time` is 2", "torques are held for 2 s", "within 2 s", "0.4 s or less"],
    ),
    // targets
    ("mass = 10.0\ninertia = 1.0", "mass = 600\ninertia = 60", 13, &["`target[0].mass` is 600", "the robot", "539 kg"]),
    (
        "inertia = 1.0",
        "inertia = 2.6",
        14,
        &["`target[0].inertia` is 2.6", "2.5 kg m²", "mass · radius²", "sphere", "1"],
    ),
    (
        "[0.0, 0.5]",
        "[0.0, 0.4]",
        15,
        &["`target[0].contact` is [0.0, 0.4]", "0.4 m from the COM", "radius is 0.5 m", "rim"],
    ),
    ("[0.2, 0.0", "[11.5, 0.0", 17, &["`target[0].twist[0]` is 11.5", "1.83 times a second", "0.2007 rad/s"]),
    ("{ ball = [0.0", "{ ball = [11.5", 23, &["`case[1].target_twists` is { ball = [11.5", "1.83 times a second"]),
    ("[1.5, -2.0]", "[3.0, -2.5]", 18, &["`target[0].position` is [3.0, -2.5]", "no pose", "further out than"]),
    // names
    ("\"study\"", "\"-study\"", 1, &["`name` is \"-study\"", "option"]),
    ("\"spin\"", "\"-spin\"", 20, &["`case[0].name` is \"-spin\"", "option"]),
    // pairs that are not compared anyway
    ("ignore = [", "ignore = [[\"base\", \"arms/left/link1\"],", 27, &["`clearance.ignore[0]` is", "common joint"]),
    ("ignore = [", "ignore = [[\"arms/left/link3\", \"base\"],", 28, &["`clearance.ignore[2]` is", "there before"]),
    ("\"left\"", "\"wheel\"", 12, &["`target[0].arm` is \"wheel\"", "reaction wheel", "left, right"]),
];

#[track_caller]
fn one_warning(text: &str, line: usize, expected: &[&str]) {
    let CheckReport { warnings, .. } = inspect_text(text);
    let shown = warnings.to_string();
    assert_eq!(warnings.count(), 1, "one warning is wanted in\n{text}\nnot\n{shown}");
    let place = format!("it.toml:{line}:");
    for expected in expected.iter().chain(&[place.as_str(), "warning: `", "help: "]) {
        assert!(shown.contains(expected), "no `{expected}` in\n{shown}");
    }
}

#[track_caller]
fn assert_warnings(valid: &str, edits: &[Edit]) {
    assert_eq!(inspect_text(valid).warnings.to_string(), "");
    for (from, to, line, expected) in edits {
        assert!(valid.contains(from), "`{from}` is not in the valid file");
        one_warning(&valid.replacen(from, to, 1), *line, expected);
    }
}

#[test]
fn layouts_with_warnings() {
    assert_warnings(LAYOUT, LAYOUT_EDITS);
    one_warning(WHEELS, 9, &["`arm[0].link[0].length` is 0", "wheels alone"]);
}

#[test]
fn scenarios_with_warnings() {
    assert_warnings(SCENARIO, SCENARIO_EDITS);
    let paper = fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
    for turn in ["7", "-7"] {
        let twists = format!("end_effector_twists = [[0, -100, 0], [{turn}, 0, 0]]");
        let fast = paper.replace("end_effector_twists = [[0.0, -0.1, 0.0], [0.0, 0.1, 0.0]]", &twists);
        let shown = inspect(&fast, "it.toml", Path::new(""), SHIPPED).expect("a scenario").warnings;
        assert_eq!(shown.count(), 2, "{shown}");
        let of_turn = format!("twists[1]` is [{turn}, 0, 0]: faster than arm2");
        for expected in ["twists[0]` is [0, -100, 0]: faster than arm1", &of_turn] {
            assert!(shown.to_string().contains(expected), "{shown}");
        }
    }
}

/// End effector goals out of reach, under every tracking law.
#[test]
fn end_effector_poses_out_of_reach() {
    let end = "final_joint_angles = [-0.5, -1.4, -0.1, 0.0, 0.0]\nfinal_joint_rates = [0.01, 0.0, 0.0, 0.0, 0.0]";
    let steer = |x: &str| {
        let goals = format!("tracking = \"resolved_motion_rate\"\nfinal_end_effector_poses = [[{x}, -1.0], [], []]");
        SCENARIO.replace("\"quartic\"", "\"quintic\"").replace(end, &goals)
    };
    assert_eq!(inspect_text(&steer("1.8")).warnings.to_string(), "");
    let expected =
        ["`approach.final_end_effector_poses[0]` is [4.8, -1.0]", "out of reach, 4.827 m", "no pose of left"];
    one_warning(&steer("4.8"), 9, &expected);
    // a joint trajectory to it is refused
    let designed = SCENARIO.replace("trajectory", "final_end_effector_poses = [[4.8, -1.0], [], []]\ntrajectory");
    let CheckReport { warnings, refusal, .. } = inspect_text(&designed);
    let refusal = refusal.expect("a refusal").to_string();
    assert!(refusal.contains("is out of reach: 4.8") && refusal.contains("it.toml:7:"), "{refusal}");
    assert_eq!(warnings.to_string(), "");
    let adaptive = steer("1.8").replace("tracking", "rate_gain = 300\ntracking");
    assert_eq!(inspect_text(&adaptive).warnings.to_string(), "", "its steps are as short as the motion needs");
    let fast = adaptive.replace("tracking", "integrator = \"rk4\"\ntracking");
    one_warning(&fast, 5, &["`approach.step` is left at its default", "within 0.003333 s"]);
    one_warning(&fast.replace("rate_gain", "pose_gain"), 5, &["`approach.step` is left", "within 0.003333 s"]);
}

/// Of two arms the one that has the far goal is named.
#[test]
fn the_arm_whose_goal_is_out_of_reach_is_named() {
    let text = "name = \"it\"\nlayout = \"dual_arm_3r\"\n[initial]\njoint_angles = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047]\n\
                [approach]\nduration = 20.0\ntracking = \"resolved_motion_rate\"\nfinal_end_effector_poses = [[], [-9.0, 0.0]]\n";
    let shown = inspect(text, "it.toml", Path::new(""), SHIPPED).expect("a scenario").warnings.to_string();
    assert!(shown.contains("`approach.final_end_effector_poses[1]`") && shown.contains("no pose of arm2"), "{shown}");
}

/// The bound on the modes after the impact: a captured target increases the inertia against joint rates.
#[test]
fn a_merged_robot_is_no_stiffer() {
    use planar_capture::state::State;
    use planar_capture::target::Target;
    let layout = planar_proof::layout("dual_arm_3r");
    let mut model = planar_capture::registry::generated(&layout).expect("generated code");
    let angles = [-0.5, -1.4, 0.1, 2.6, -1.4, 0.2];
    let target = Target { mass: 10.0, inertia: 1.0, contact: [0.3, 0.4], twist: [0.0; 3] };
    let inertia = |model: &dyn planar_capture::dynamics::Model<f64>| {
        let state = State { base_pose: [0.0; 3], joint_angles: &angles, base_twist: [0.0; 3], joint_rates: &[0.0; 6] };
        let (mut inertia, mut bias, mut jacobian) = ([0.0; 36], [0.0; 6], [0.0; 36]);
        model.reduced_dynamics(&state, &mut inertia, &mut bias, &mut jacobian).expect("an inertia");
        nalgebra::SMatrix::<f64, 6, 6>::from_row_slice(&inertia)
    };
    let before = inertia(&*model);
    model.merge(&[0.0; 3], &angles, &[Some(target), None]).expect("merged");
    let more = (inertia(&*model) - before).symmetric_eigenvalues();
    assert!(more.min() > -1e-12 && more.max() > 1.0, "{more}");
}

/// Ends beyond the joints' limits; a start there is refused.
#[test]
fn ends_beyond_limits() {
    let with = |limits: &str| SCENARIO.replace("[approach]", &format!("[limits]\n{limits}\n[approach]"));
    assert_eq!(inspect_text(&with("joint_angles = [-3, 3]\njoint_rates = 1")).warnings.to_string(), "");
    // the end is slow, the way to it is not
    let expected = ["`approach`", "along the planned path joint", "limit of -0.01 rad/s", "exit code 1"];
    one_warning(&with("joint_rates = 0.01"), 7, &expected);
    let expected =
        ["`approach.final_joint_angles[2]` is -0.1", "beyond the limit of joint 3 of left, 0 rad", "exit code 1"];
    one_warning(&with("joint_angles = [[], [], [0, 2], [], []]"), 10, &expected);
    let expected = ["`approach.final_joint_rates[0]` is 0.01", "joint 1 of left, 0.009 rad/s"];
    one_warning(&with("joint_rates = 0.009"), 11, &expected);
}

/// A solid rod, a dumbbell with all its mass at its ends, and every wheel are possible bodies.
#[test]
fn the_bound_on_inertias_is_that_of_bodies() {
    for inertia in ["3.3333333333333335", "10.0"] {
        assert_eq!(inspect_text(&LAYOUT.replace("inertia = 3.0", &format!("inertia = {inertia}"))).warnings.count(), 0);
    }
    assert_eq!(inspect_text(&LAYOUT.replace("inertia = 3.0", "inertia = 10.001")).warnings.count(), 1);
    assert_eq!(inspect_text(&LAYOUT.replace("inertia = 0.5", "inertia = 50.0")).warnings.count(), 0);
}

/// A wheel turns about any axis, also that of an arm's first joint.
#[test]
fn a_wheel_shares_its_mount_with_an_arm() {
    let wheel = LAYOUT.rfind("[[arm]]").expect("a wheel");
    let arms = LAYOUT.find("[[arm]]").expect("arms");
    let wheel_first = [&LAYOUT[..arms], &LAYOUT[wheel..], &LAYOUT[arms..wheel]].concat();
    assert_eq!(inspect_text(&wheel_first).warnings.to_string(), "");
}

/// The reach of a drifting robot is that at the end of the approach.
#[test]
fn reach_is_relative_to_the_drifted_robot() {
    let far = SCENARIO.replace("[1.5, -2.0]", "[21.5, -2.0]");
    one_warning(&far, 18, &["no pose"]);
    let moving = far.replace("[approach]", "base_twist = [0.0, 1.0, 0.0]\n[approach]");
    assert_eq!(inspect_text(&moving).warnings.to_string(), "");
}

#[test]
fn warnings_are_in_the_order_of_the_files() {
    let text = SCENARIO.replace("radius = 0.5", "radius = 5.0").replace("rates = [0.01", "rates = [10");
    let layout = LAYOUT.replace("inertia = 3.0", "inertia = 30.0").replace("mass = 500.0", "mass = 5.0");
    let warnings = inspect(&text, "it.toml", Path::new(""), &[("robot", &layout)]).expect("a scenario").warnings;
    let shown = warnings.to_string();
    let at =
        ["it.toml:9:", "it.toml:15:", "robot.toml (shipped):3:", "robot.toml (shipped):27:"].map(|p| shown.find(p));
    assert!(at.iter().all(Option::is_some) && at.is_sorted() && warnings.count() == 4, "{shown}");
}

/// A target that is to be met, and never comes within reach, in some cases or in all.
#[test]
fn targets_that_are_never_met_are_named() {
    let far = SCENARIO
        .replace("contact = [0.0, 0.5]\n", "")
        .replace("[post_impact]", "[contact]\ndetection = \"event\"\n[post_impact]");
    let shown = |position: &str, twist: &str| {
        let text = far.replace("[1.5, -2.0]", position).replace("[0.2, 0.0, 0.0]", twist);
        inspect_text(&text).warnings.to_string()
    };
    let always = shown("[5.5, 0.1]", "[0.2, 0.0, 0.0]");
    assert!(always.contains("`target[0].position` is [5.5, 0.1]: no end effector can meet `ball`"), "{always}");
    assert_eq!(always.matches("can meet").count(), 1, "{always}");
    assert!(!always.contains(" mm "), "{always}");
    let millimetres = shown("[3600, 100]", "[0.2, 0.0, 0.0]");
    assert!(millimetres.contains("(3600, 100) mm are (3.6, 0.1) m"), "{millimetres}");
    // it comes, and passes, but not where it is at rest
    let coming = shown("[5.5, 0.1]", "[0.0, -0.9, 0.0]");
    assert!(coming.contains("`case[1].target_twists` is"), "{coming}");
    assert_eq!(coming.matches("can meet").count(), 1, "{coming}");
    let away = shown("[5.5, 0.1]", "[0.0, 0.9, 0.0]");
    assert!(away.contains("`target[0].position` is"), "{away}");
    // what comes after the end of the approach comes too late: the motion goes on only where another target was met
    let late = shown("[9.5, 0.1]", "[0.0, -0.1, 0.0]");
    assert!(late.contains("`target[0].position` is"), "{late}");
    assert!(!shown("[3.0, 0.1]", "[0.0, 0.1, 0.0]").contains("can meet"));
}

/// Of two targets the second may be met after the impact of the first, in the time that is left then.
#[test]
fn a_second_target_may_be_met_after_the_first() {
    let text = shipped("elastic_rebound");
    let (text, _) = text.split_once("[[case]]\nname = \"too_late\"").expect("its cases");
    let coming = |twist: &str, duration: f64| {
        let text = text.replace("[-4.2, -0.1]", "[-24.0, -0.1]").replace("[-0.05, 0.1, 0.0]", twist);
        said_of(&format!("{text}[post_impact]\nduration = {duration:?}\n")).contains("can meet `box`")
    };
    assert!(!coming("[0.0, 0.45, 0.0]", 30.0) && coming("[0.0, 0.45, 0.0]", 0.1));
}

/// What goes beyond a limit in the same way in every case is said once.
#[test]
fn a_limit_of_all_cases_is_said_once() {
    let text = shipped("elastic_rebound");
    let (text, _) = text.split_once("[[case]]").expect("its cases");
    let case = |name: &str, twist: &str| {
        format!(
            "[[case]]\nname = \"{name}\"\ntarget_twists = {{ box = {twist} }}\nrestitutions = {{ ball = 1.0, box = 1.0 }}\n"
        )
    };
    let cases = case("a", "[-0.05, -0.2, 0.0]") + &case("b", "[-0.05, -0.3, 0.0]");
    let said = said_of(&format!("{text}[limits]\njoint_rates = 0.05\n{cases}[post_impact]\nduration = 30.0\n"));
    let beyond: Vec<&str> = said.lines().filter(|line| line.contains("along the planned path joint")).collect();
    let mut distinct = beyond.clone();
    distinct.sort_unstable();
    distinct.dedup();
    assert!(!beyond.is_empty() && distinct.len() == beyond.len(), "{said}");
}

/// The text of a shipped scenario.
fn shipped(name: &str) -> String {
    fs::read_to_string(file(&format!("scenarios/{name}.toml"))).expect("a scenario")
}

/// An arm that extends to the right while a ball drifts by, and another ball that the other arm is to meet.
fn passing([x, y]: [f64; 2], velocity: [f64; 2], more: &str) -> String {
    format!(
        "name = \"it\"\nlayout = \"dual_arm_3r\"\n[initial]\n\
         joint_angles = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047]\n[approach]\nduration = 20.0\n\
         trajectory = \"cycloidal\"\nfinal_joint_angles = [0.2, -0.9, 0.5, 2.9, 0.9, -0.5]\n{more}\n[contact]\n\
         detection = \"event\"\n[[target]]\nname = \"ball\"\narm = \"arm1\"\nkind = \"bounce\"\nmass = 20.0\n\
         inertia = 0.7\nradius = 0.3\nposition = [{x}, {y}]\ntwist = [0.0, {}, {}]\n[post_impact]\nduration = 0.1\n\
         [clearance]\nignore = [[\"base\", \"targets/ball\"], [\"arms/arm2/link1\", \"targets/ball\"], \
         [\"arms/arm2/link2\", \"targets/ball\"], [\"arms/arm2/link3\", \"targets/ball\"], \
         [\"arms/arm1/link1\", \"targets/ball\"], [\"arms/arm1/link2\", \"targets/ball\"], \
         [\"arms/arm1/link3\", \"targets/ball\"]]\n",
        velocity[0], velocity[1]
    )
}

/// What `check` says of a scenario of a shipped robot.
fn said_of(text: &str) -> String {
    inspect(text, "it.toml", Path::new(""), SHIPPED).unwrap_or_else(|report| panic!("{report}")).warnings.to_string()
}

fn is_off_the_way(text: &str) -> bool {
    said_of(text).contains("not on the way")
}

/// A target in reach that the planned path leads past is named, with how near they come; where the motion of a run is not known
/// beforehand, nothing is said.
#[test]
fn targets_off_the_planned_path_are_named() {
    let past = passing([0.5, 2.6], [0.0, 0.0], "");
    let shown = said_of(&past);
    for part in [
        "it.toml:19:",
        "`target[0].position` is [0.5, 2.6]: `ball` is in reach, but not on the way",
        "arm1 comes no nearer than 3.198 m, at 0 s",
        "a run meets nothing then",
    ] {
        assert!(shown.contains(part), "no `{part}` in\n{shown}");
    }
    assert_eq!(shown.matches("warning: ").count(), 1, "{shown}");
    assert!(is_off_the_way(&passing([0.5, 2.6], [0.0, 0.0], "tracking = \"exact\"")));
    // slack gains, torques that are held, and those that there are not
    for law in ["proportional_gain = 0.01", "derivative_gain = 0.0", "sample_time = 0.1", "torque_limits = 1e-3"] {
        assert!(!is_off_the_way(&passing([0.5, 2.6], [0.0, 0.0], law)), "{law}");
    }
    let moving = past.replace("[approach]", "joint_rates = [0.1, 0.0, 0.0, 0.0, 0.0, 0.0]\n[approach]");
    assert!(!is_off_the_way(&moving));
    // of two targets one is met, and what follows is not known
    let other = past.replacen(
        "[post_impact]",
        "[[target]]\nname = \"other\"\narm = \"arm2\"\nkind = \"bounce\"\nmass = 20.0\n\
        inertia = 0.7\nradius = 0.3\nposition = [-3.6, 0.1]\n[post_impact]",
        1,
    );
    assert!(!is_off_the_way(&other), "{}", said_of(&other));
    // in one of two cases
    let cases = past.replacen(
        "[post_impact]",
        "[[case]]\nname = \"at_rest\"\n[[case]]\nname = \"comes\"\n\
        target_twists = { ball = [0.0, 0.16, -0.16] }\n[post_impact]",
        1,
    );
    let shown = said_of(&cases);
    assert_eq!(shown.matches("not on the way").count(), 1, "{shown}");
    assert!(shown.contains("`case[0].target_twists`"), "{shown}");
}

/// Wherever a target is, and however it drifts: where a run meets it, nothing was said.
#[test]
fn targets_that_are_met_are_not_said_to_be_off_the_way() {
    let (mut met, mut said) = (0, 0);
    for i in 0..24_u8 {
        let (row, column) = (i / 6, f64::from(i % 6));
        let position = [2.3 + 0.25 * column, [-1.4, -0.6, -0.3, 1.2][usize::from(row)]];
        let velocity = [0.02 * (column - 2.0), 0.03 * (1.5 - f64::from(row))];
        for gain in ["proportional_gain = 49.0", "proportional_gain = 5.0"] {
            let text = passing(position, velocity, gain);
            let scenario = Scenario::parse(&text, "it.toml", Path::new(""), SHIPPED).expect("a scenario");
            let model = generated(&scenario.layout).expect("generated code");
            // one that begins in the target has no run
            let Ok(study) = study(&scenario, &|| model.clone_box(), 1.0, &mut Silent) else { continue };
            let (is_met, is_said) = (study.cases[0].capture.is_some(), is_off_the_way(&text));
            assert!(!(is_met && is_said), "{position:?} {velocity:?}: met, {:?}", study.cases[0].closest);
            met += usize::from(is_met);
            said += usize::from(is_said);
        }
    }
    assert!(met >= 4 && said >= 4, "{met} met, {said} said not to be");
}

/// Lengths that are all in mm are said once, not with all that follows from them.
#[test]
fn all_lengths_in_millimetres_are_said_once() {
    let links = LAYOUT.replace("length = 1.0", "length = 1000.0").replace("length = 0.5", "length = 500.0");
    let links = links.replace("length = 2.0", "length = 2000.0").replace("com = [0.5, 0.1]", "com = [500, 100]");
    let all = links.replace("[0.5, 0.0]", "[500, 0]").replace("[-0.5, 0.0]", "[-500, 0]");
    one_warning(&all, 9, &["`arm[0].link[0].length` is 1000.0", "look like mm", "1000 mm are 1 m"]);
    // inertias in kg mm², too
    let inertias = all.replace("inertia = 80.0", "inertia = 80e6").replace("inertia = 1.0", "inertia = 1e6");
    let inertias = inertias.replace("inertia = 0.1", "inertia = 1e5").replace("inertia = 3.0", "inertia = 3e6");
    one_warning(&inertias, 9, &["the arms reach up to 3000 m", "look like mm"]);
    // mounts in m
    let error = inspect(&links, "it.toml", Path::new(""), SHIPPED)
        .map_or_else(|error| error.to_string(), |report| report.warnings.to_string());
    assert!(error.contains("`arm[0].link[0].length` is 1000.0") && error.contains("1000 mm are 1 m"), "{error}");
}

/// Several lengths in another unit are named, each at its own key.
#[test]
fn all_lengths_in_another_unit_are_named() {
    let text = LAYOUT.replacen("length = 1.0", "length = 120.0", 1).replace("length = 2.0", "length = 150.0");
    let text = text.replacen("inertia = 1.0", "inertia = 3000.0", 1).replace("inertia = 3.0", "inertia = 3000.0");
    let shown = inspect_text(&text).warnings.to_string();
    for key in ["arm[0].link[0]", "arm[1].link[0]"] {
        assert!(shown.contains(&format!("`{key}.length` is")), "{key}: {shown}");
    }
    assert!(shown.contains("120 times as long as the longest link with another length, 1 m"), "{shown}");
}

/// Default outlines fail no run, and `check` names them as `run` does.
#[test]
fn overlaps_of_default_outlines_are_named() {
    let (approach, _) = SCENARIO.split_once("[[target]]").expect("an approach");
    let folded = approach.replace("final_joint_angles = [-0.5, -1.4,", "final_joint_angles = [0.0, 2.9,");
    let of = |layout: &str| {
        let report = inspect(&folded, "it.toml", Path::new(""), &[("robot", layout)]).expect("valid");
        assert!(report.refusal.is_none());
        report.warnings.to_string()
    };
    let inside = "`base` and `arms/left/link3` are inside each other along the planned path";
    let shown = of(LAYOUT);
    assert!(shown.contains(inside) && shown.contains("these outlines are defaults"), "{shown}");
    let given = LAYOUT.replace("inertia = 80.0", "inertia = 80.0\noutline = { box = [1.0, 1.0] }");
    let given = given.replace("inertia = 0.1", "inertia = 0.1\noutline = { capsule = 0.01 }");
    let shown = of(&given);
    assert!(shown.contains(inside) && shown.contains("choose another approach"), "{shown}");
    let away = LAYOUT.replace("length = 0.5", "length = 0.05").replace("inertia = 0.1", "inertia = 1e-3");
    assert!(!of(&away).contains("`base`"), "{}", of(&away));
}

/// What makes `run` exit with 1 for overlaps is a warning of `check`, or `check` says what it has not looked at.
#[test]
fn overlaps_that_fail_a_run_are_warned_of() {
    let read = |name: &str| fs::read_to_string(file(&format!("scenarios/{name}.toml"))).expect("a scenario");
    let shown = |text: &str| inspect(text, "it.toml", &file("scenarios"), SHIPPED).expect("valid").warnings.to_string();
    // the panel that the end effectors pass through before they hold it
    let inside = read("large_target").replace("[[0.7, -0.5], [-0.7, -0.5]]", "[[0.7, 0.3], [-0.7, 0.3]]");
    let inside = inside.replace("[0.0, 2.7]", "[0.0, 1.9]");
    for rule in ["fail", "stop", "report"] {
        let text = inside.replace("on_overlap = \"fail\"", &format!("on_overlap = \"{rule}\""));
        assert!(shown(&text).contains("are inside each other along the planned path"), "{rule}: {}", shown(&text));
    }
    // end effectors that reach the panel half a millimetre within, which a rule that reports tolerates
    let within = read("large_target").replace("[[0.7, -0.5], [-0.7, -0.5]]", "[[0.7, -0.4995], [-0.7, -0.4995]]");
    assert!(shown(&within).contains("along the planned path"), "{}", shown(&within));
    let reported = within.replace("on_overlap = \"fail\"", "on_overlap = \"report\"");
    assert!(!shown(&reported).contains("along the planned path"), "{}", shown(&reported));
    // a path that takes as long to follow as a run
    let long = read("large_target").replace("duration = 20.0", "duration = 1000.0");
    assert!(shown(&long).contains("were not looked for: it takes 200000 steps"), "{}", shown(&long));
    // steps in proportion to the turns
    let fast = read("large_target").replace("twists = [[0.02,", "twists = [[1e3,");
    assert!(shown(&fast).contains("an end effector turns by 20000 rad"), "{}", shown(&fast));
    // cases that differ by what the contact does alone: the one that has none goes on
    let passes = "name = \"it\"\nlayout = \"./bars.toml\"\n[initial]\njoint_angles = [0.0, 0.0]\n[approach]\nduration = 2.0\n\
        trajectory = \"cycloidal\"\nfinal_joint_angles = [0.0, 0.1]\n[clearance]\non_overlap = \"fail\"\n\
        ignore = [[\"arms/a/link2\", \"targets/t\"]]\n[contact]\ndetection = \"event\"\n[[target]]\nname = \"t\"\narm = \"a\"\n\
        mass = 5.0\ninertia = 0.1\nkind = \"pin\"\nradius = 0.2\nposition = [2.9, 0.0]\ntwist = [0.0, -1.0, 0.0]\n\
        [[case]]\nname = \"held\"\n[[case]]\nname = \"missed\"\nkinds = { t = \"none\" }\n[post_impact]\nduration = 5.0\n";
    let bar = "[[arm.link]]\nlength = 1.0\nmass = 5.0\ninertia = 0.4\noutline = { capsule = 0.05 }\n";
    let bars = format!(
        "name = \"bars\"\n[base]\nmass = 100.0\ninertia = 10.0\noutline = {{ disc = 0.4 }}\n[[arm]]\nname = \"a\"\n\
         mount = [0.5, 0.0]\n{bar}{bar}"
    );
    let of_kinds = TempDir::new().expect("a folder");
    fs::write(of_kinds.path().join("bars.toml"), bars).expect("written");
    let of_kinds = |text: &str| inspect(text, "it.toml", of_kinds.path(), SHIPPED).expect("valid").warnings.to_string();
    let inside = "`arms/a/link1` and `targets/t` are inside each other along the planned path";
    assert!(of_kinds(passes).contains(&format!("in case `missed`: {inside}")), "{}", of_kinds(passes));
    // of both cases, which have one approach between them
    let both = of_kinds(&passes.replace("\"held\"", "\"held\"\nkinds = { t = \"none\" }"));
    assert!(both.contains(inside) && !both.contains("in case"), "{both}");
    assert!(!of_kinds(&passes.replace("\"none\"", "\"pin\"")).contains(inside), "{}", of_kinds(passes));
    // a joint trajectory to poses: the design gives the path
    let designed = |offset: &str| {
        let text = read("spinning_target").replace("contact = [-0.6, 0.0]", &format!("contact = [{offset}]"));
        text.replace("layout = \"single_arm_3r\"", "layout = \"./outlined.toml\"")
    };
    let folder = TempDir::new().expect("a folder");
    let layout = fs::read_to_string(file("codegen/layouts/single_arm_3r.toml")).expect("a layout");
    let layout = layout.replace("length = 1.0", "outline = { capsule = 0.01 }\nlength = 1.0");
    fs::write(folder.path().join("outlined.toml"), layout).expect("written");
    let check = |text: &str| inspect(text, "it.toml", folder.path(), SHIPPED).expect("valid").warnings.to_string();
    let text = designed("0.0, 0.6") + "\n[clearance]\non_overlap = \"fail\"\n";
    assert!(check(&text).contains("along the planned path"), "{}", check(&text));
    // the spacing of the audit is no step of the planned path
    let coarse = text.replacen("duration = 20.0", "duration = 20.0\nstep = 20.0", 1);
    assert_eq!(check(&coarse), check(&text));
    // a rod that turns ten thousand times a second
    let fast = designed("0.0, 0.6").replace("twist = [0.3, 0.0, 0.0]", "twist = [62831.85, 0.0, 0.0]");
    let fast = fast.replace("radius = 0.6", "polygon = [[-1.4, -0.05], [1.4, -0.05], [1.4, 0.05], [-1.4, 0.05]]");
    assert!(check(&fast).contains("were looked for only until"), "{}", check(&fast));
}

/// A run refuses it, whatever its phases are.
#[test]
fn targets_that_the_robot_starts_in_are_refused() {
    let text = fs::read_to_string(file("scenarios/elastic_rebound.toml")).expect("a scenario");
    assert!(text.contains("radius = 0.3"), "{text}");
    let refusal = |text: &str| inspect(text, "it.toml", &file("scenarios"), SHIPPED).expect("valid").refusal;
    assert_eq!(refusal(&text).map(|refusal| refusal.to_string()), None);
    let shown = refusal(&text.replace("radius = 0.3", "radius = 30.0")).expect("a refusal").to_string();
    assert!(shown.contains("inside target `") && shown.contains("`target[0].position`"), "{shown}");
    let depth = |depth: f64| {
        let [case, arm, target] = ["it", "arm1", "disc"].map(str::to_owned);
        StudyError::Inside { case, arm, target, depth }.to_string()
    };
    assert!(depth(0.25).contains(" starts 0.2500 m inside") && depth(2.2e-16).contains(" starts 2.2e-16 m inside"));
}

/// Two arms of one link that hold a target rigidly: six constraints of five freedoms. Cases with fewer do not hide it.
#[test]
fn constraints_that_no_motion_satisfies_are_those_of_the_case_with_most() {
    let arm = |name: &str, x: f64| {
        format!(
            "[[arm]]\nname = \"{name}\"\nmount = [{x}, 0.0]\n[[arm.link]]\nlength = 1.0\nmass = 8.0\ninertia = 0.7\n"
        )
    };
    let layout = format!("name = \"two\"\n[base]\nmass = 300.0\ninertia = 50.0\n{}{}", arm("a", 0.5), arm("b", -0.5));
    let scenario = |cases: &str| {
        format!(
            "name = \"it\"\nlayout = \"two\"\n[initial]\njoint_angles = [1.2, 1.9]\n[approach]\nduration = 5.0\n\
             trajectory = \"cycloidal\"\ntracking = \"exact\"\nfinal_joint_angles = [1.3, 1.8]\n[[target]]\nname = \"t\"\n\
             arm = [\"a\", \"b\"]\ncontact = [[0.5, -0.5], [-0.5, -0.5]]\nmass = 10.0\ninertia = 3.0\n\
             polygon = [[-0.6, -0.5], [0.6, -0.5], [0.6, 0.5], [-0.6, 0.5]]\n{cases}[post_impact]\nduration = 1.0\n"
        )
    };
    let (rigid, pins) = ("[[case]]\nname = \"rigid\"\n", "[[case]]\nname = \"pins\"\nkinds = { t = \"pin\" }\n");
    for (cases, warned) in [(&[rigid, pins].concat(), true), (&[pins, rigid].concat(), true), (&pins.to_owned(), false)]
    {
        let shown =
            inspect(&scenario(cases), "it.toml", Path::new(""), &[("two", &*layout)]).expect("a scenario").warnings;
        let is_warned = shown.to_string().contains("6 constraints hold it, but its arms' 2 joints and itself have 5");
        assert_eq!(is_warned, warned, "{cases}: {shown}");
    }
}

/// A contact point is given in inertial axes, in which the target has its yaw.
#[test]
fn contact_points_are_on_the_outline_as_it_is_turned() {
    let (half, across, yaw) = (0.5_f64, 0.1_f64, 0.5_f64);
    let held = |yaw: f64, [x, y]: [f64; 2]| {
        let ([sine, cosine], bar) = ([yaw.sin(), yaw.cos()], "[[-0.5, -0.2], [0.5, -0.2], [0.5, 0.2], [-0.5, 0.2]]");
        let point = [cosine * x - sine * y, sine * x + cosine * y];
        let text = SCENARIO.replace(
            "contact = [0.0, 0.5]\nradius = 0.5",
            &format!("contact = {point:?}\npolygon = {bar}\nyaw = {yaw:?}"),
        );
        text.replace("[1.5, -2.0]", "[1.2, -1.8]")
    };
    for yaw in [0.0, yaw, -yaw] {
        assert_eq!(inspect_text(&held(yaw, [half, across])).warnings.to_string(), "", "{yaw}");
        one_warning(&held(yaw, [half + 0.1, across]), 15, &["`target[0].contact`", "0.1 m outside the outline"]);
        one_warning(&held(yaw, [half - 0.1, across]), 15, &["`target[0].contact`", "0.1 m inside the outline"]);
    }
}

/// The torques that a planned motion takes are those of exact tracking, each of its own joint and the largest of either sign.
#[test]
fn torques_of_the_planned_motion_are_those_of_exact_tracking() {
    let layout = [("robot", LAYOUT)];
    let ends = ["[0.7, -1.6, 1.0, 0.0, 0.0]", "[-0.5, -1.4, -0.1, 0.0, 0.0]"];
    let there = SCENARIO.to_owned();
    let back = there.replace(ends[0], "START").replace(ends[1], ends[0]).replace("START", ends[1]);
    let mut largest_of_both_signs = [false; 2];
    for text in [there, back] {
        let exact = text.replace("[approach]", "[approach]\ntracking = \"exact\"");
        let exact =
            Scenario::parse(&exact, "it.toml", Path::new(""), &layout).unwrap_or_else(|report| panic!("{report}"));
        let study = study(&exact, &|| generic(&exact.layout), 0.02, &mut Silent).expect("a study");
        let limited = "[approach]\ntracking = \"computed_torque\"\ntorque_limits = 0.01";
        let shown = inspect_text(&text.replace("[approach]", limited)).warnings.to_string();
        for joint in 0..exact.layout.joints() {
            let torques = study.approach.samples.iter().map(|sample| sample.joint_torques[joint]);
            let (least, most) = torques.fold((0.0_f64, 0.0_f64), |(least, most), x| (least.min(x), most.max(x)));
            let peak = most.max(-least);
            let before =
                shown.split_once(&format!(" N m of {}", exact.layout.joint_name(joint))).map(|(before, _)| before);
            assert_eq!(peak > 0.01, before.is_some(), "{peak} N m of joint {joint}\n{shown}");
            if let Some(before) = before {
                let found: f64 = before.rsplit(' ').next().and_then(|text| text.parse().ok()).expect("a torque");
                assert!((found / peak - 1.0).abs() < 0.02, "joint {joint}: {found} N m for {peak} N m");
                largest_of_both_signs[0] |= most > 1.05 * -least;
                largest_of_both_signs[1] |= -least > 1.05 * most;
            }
        }
    }
    assert_eq!(largest_of_both_signs, [true; 2]);
}

/// Two cases that hold a target each: the loop of one of them is not hidden by the other, which has fewer constraints.
#[test]
fn constraints_are_those_of_the_target_itself() {
    let arm = |name: &str, x: f64| {
        format!(
            "[[arm]]\nname = \"{name}\"\nmount = [{x}, 0.0]\n[[arm.link]]\nlength = 1.0\nmass = 8.0\ninertia = 0.7\n"
        )
    };
    let arms = arm("a", 0.5) + &arm("b", -0.5) + &arm("c", 0.0).replace("[0, 0.0]", "[0.0, 0.6]");
    let layout = format!("name = \"three\"\n[base]\nmass = 300.0\ninertia = 50.0\n{arms}");
    let scenario = |kinds: &str| {
        format!(
            "name = \"it\"\nlayout = \"three\"\n[initial]\njoint_angles = [1.2, 1.9, 1.5]\n[approach]\nduration = 5.0\n\
             trajectory = \"cycloidal\"\ntracking = \"exact\"\nfinal_joint_angles = [1.3, 1.8, 1.5]\n[[target]]\nname = \"s\"\n\
             arm = \"c\"\ncontact = [0.0, -0.5]\nmass = 10.0\ninertia = 1.0\nradius = 0.5\n[[target]]\nname = \"t\"\n\
             arm = [\"a\", \"b\"]\nkind = {kinds}\ncontact = [[0.5, -0.5], [-0.5, -0.5]]\nmass = 10.0\ninertia = 3.0\n\
             polygon = [[-0.6, -0.5], [0.6, -0.5], [0.6, 0.5], [-0.6, 0.5]]\n[post_impact]\nduration = 1.0\n"
        )
    };
    // two joints and the target's three freedoms are as many as a rigid contact and a pin take
    for (kinds, warned) in [("[\"rigid\", \"rigid\"]", true), ("[\"rigid\", \"pin\"]", false)] {
        let shown = inspect(&scenario(kinds), "it.toml", Path::new(""), &[("three", &*layout)]);
        let shown = shown.unwrap_or_else(|report| panic!("{report}")).warnings.to_string();
        assert_eq!(shown.contains("constraints hold it"), warned, "{kinds}: {shown}");
    }
}

/// A warning is about a number beyond its bound: the bound itself has none.
#[test]
fn numbers_at_their_bounds_have_no_warnings() {
    for (from, to) in [
        // a COM on the border of the link
        ("com = [0.5, 0.1]", "com = [0.0, 0.5]"),
        ("com = [0.5, 0.1]", "com = [1.0, 0.5]"),
        ("com = [0.5, 0.1]", "com = [0.5, 1.0]"),
        ("com = [0.5, 0.1]", "com = [0.5, -1.0]"),
        // a base as heavy as its arms, 25 + 10 + 4 kg
        ("mass = 500.0", "mass = 39.0"),
        // a millionth of the base's 500 kg, and a billionth of its 80 kg m²
        ("mass = 4.0", "mass = 0.0005"),
        ("inertia = 0.5", "inertia = 8e-8"),
        // ten times the base's radius of gyration, √(80 / 500) m = 0.4 m
        ("[-0.5, 0.0]", "[-4.0, 0.0]"),
        // above the other arm
        ("[-0.5, 0.0]", "[0.5, 0.3]"),
    ] {
        let text = LAYOUT.replace(from, to);
        assert_ne!(text, LAYOUT, "{from}");
        assert_eq!(inspect_text(&text).warnings.to_string(), "", "{to}");
    }
    for (from, to) in [
        // a target as heavy as the robot, 500 + 39 kg
        ("mass = 10.0\ninertia", "mass = 539.0\ninertia"),
        // a ring: 10 kg · (0.5 m)²
        ("inertia = 1.0", "inertia = 2.5"),
        // one turn a second
        ("twist = [0.2,", "twist = [6.283185307179586,"),
        ("twist = [0.2,", "twist = [-6.283185307179586,"),
        // a whole turn, to an end at 0
        ("0.0, 0.0]\n[approach]", "0.0, 6.283185307179586]\n[approach]"),
        ("rates = [0.01", "rates = [6.283185307179586"),
        // 6 rad/s of an arm that reaches 3 m from the base, and less from its mount
        ("final_joint_rates = [0.01, 0.0, 0.0, 0.0, 0.0]", "final_end_effector_twists = [[0.0, 0.0, 18.0], [], []]"),
        // one joint without stiffness among others
        ("[approach]", "[approach]\nproportional_gain = [0.0, 49.0, 49.0, 49.0, 49.0]"),
        // to the angles that it has, with rates
        ("final_joint_angles = [-0.5, -1.4, -0.1, 0.0, 0.0]", "final_joint_angles = [0.7, -1.6, 1.0, 0.0, 0.0]"),
        // a bar of 1 m × 0.4 m that is held at the middle of a long side: its inertia is that of its size
        (
            "contact = [0.0, 0.5]\nradius = 0.5",
            "contact = [0.0, 0.2]\npolygon = [[-0.5, -0.2], [0.5, -0.2], [0.5, 0.2], [-0.5, 0.2]]",
        ),
        // half a time of the fastest mode in a step of 0.005 s
        ("[approach]", "[approach]\ntracking = \"computed_torque\"\nderivative_gain = 100.0\nintegrator = \"rk4\""),
    ] {
        let text = SCENARIO.replace(from, to);
        assert_ne!(text, SCENARIO, "{from}");
        assert_eq!(inspect_text(&text).warnings.to_string(), "", "{to}");
    }
}
