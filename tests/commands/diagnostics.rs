//! Invalid layouts and scenarios, and the message for each: file, line, key, value and correction.

use std::collections::HashSet;
use std::error::Error;
use std::fs;
use std::path::Path;

use crate::said;
use planar_capture::diagnostic::{Report, nearest};
use planar_capture::layout::Layout;
use planar_capture::scenario::{FinalRates, Known, Scenario, Tracking};
use planar_capture::simulate::stepper::Integrator;
use planar_capture::trajectory::TrajectoryKind;
use planar_proof::file;

type Outcome = Result<(), Box<dyn Error + Send + Sync>>;

const LAYOUT: &str = r#"name = "one_arm"
[base]
mass = 500.0
inertia = 83.61
[[arm]]
name = "left"
mount = [0.5, 0.0]
[[arm.link]]
length = 1.0
mass = 10.0
inertia = 1.05
[[arm.link]]
length = 1
mass = 10
inertia = 1.05
"#;

const SCENARIO: &str = r#"name = "demo"
layout = "one_arm"
[initial]
joint_angles = [0.1, 0.2]
[approach]
duration = 20.0
trajectory = "quartic"
final_joint_angles = [0.5, 0.6]
final_end_effector_twists = [[0, -0.1, 0]]
[[target]]
name = "ball"
arm = "left"
mass = 10.0
inertia = 1.0
contact = [0.0, 0.5]
radius = 0.5
twist = [0.2, 0.0, 0.0]
[[case]]
name = "spin"
[[case]]
name = "still"
target_twists = { ball = [0, 0, 0] }
[post_impact]
duration = 50.0
"#;

fn shipped() -> [(&'static str, &'static str); 2] {
    [("one_arm", LAYOUT), ("broken", "name = \"broken\"\n[base]\nmass = 1\ninertia = 0\n[[arm]]\n")]
}

/// A light body loses nothing: only those that are heavy beside all others are refused.
#[test]
fn light_bodies_are_accepted() {
    for (from, to) in [
        ("mass = 10.0", "mass = 1e-30"),
        ("mass = 500.0", "mass = 1e-30"),
        ("inertia = 83.61", "inertia = 1e-30"),
        ("inertia = 1.05", "inertia = 1e-30"),
        ("mass = 500.0", "mass = 1.9e10"),
        ("mass = 10.0", "mass = 5e7"),
        ("inertia = 83.61", "inertia = 1e12"),
    ] {
        let text = LAYOUT.replacen(from, to, 1);
        assert_ne!(text, LAYOUT, "{from}");
        let layout = Layout::parse(&text, "one_arm.toml");
        assert!(layout.is_ok(), "{to}: {}", layout.expect_err("refused"));
    }
}

/// Three light links between heavy bodies fold at next to no inertia beside that which they carry. Two of them are a
/// triangle, which does not, and at the end of an arm they carry nothing.
#[test]
fn light_links_between_heavy_bodies_are_refused() {
    let links = |masses: [f64; 4]| {
        let link = |mass: f64| format!("[[arm.link]]\nlength = 1.0\nmass = {mass:?}\ninertia = {:?}\n", 0.1 * mass);
        let (base, _) = LAYOUT.split_once("[[arm.link]]").expect("links");
        Layout::parse(&(base.to_owned() + &masses.map(link).concat()), "one.toml")
    };
    for masses in [[1e-5, 1e-5, 10.0, 10.0], [10.0, 1e-5, 1e-5, 10.0], [10.0, 1e-5, 1e-5, 1e-5], [1.0, 1.0, 1.0, 10.0]]
    {
        let found = links(masses);
        assert!(found.is_ok(), "{masses:?}: {}", found.expect_err("refused"));
    }
    let refused = links([1e-5, 1e-5, 1e-5, 10.0]).expect_err("accepted").to_string();
    for wanted in [
        "one.toml:10:",
        "`arm[0].link[0].mass` is 1e-5",
        "do not resolve how joint 1 of left moves with the joints beyond it free",
        "expected at least 1e-5",
    ] {
        assert!(refused.contains(wanted), "{refused}");
    }
}

/// A base on which arms fold has next to no inertia of its own beside theirs.
#[test]
fn a_base_that_is_too_light_for_its_arm_is_refused() {
    let with_base = |base: f64| {
        let link = "[[arm.link]]\nlength = 1.0\nmass = 1e4\ninertia = 1e3\n".repeat(3);
        let text = format!(
            "name = \"one\"\n[base]\nmass = {base:?}\ninertia = {base:?}\n[[arm]]\nname = \"left\"\nmount = [0.5, 0.0]\n{link}"
        );
        Layout::parse(&text, "one.toml")
    };
    let refused = with_base(1e-3).expect_err("accepted").to_string();
    for wanted in ["one.toml:3:", "`base.mass` is 0.001", "how the base moves with all joints free", "1.7e-7"] {
        assert!(refused.contains(wanted), "no {wanted} in {refused}");
    }
    let found = with_base(1.0);
    assert!(found.is_ok(), "{}", found.expect_err("refused"));
}

fn scenario(text: &str) -> Result<Scenario, Report> {
    Scenario::parse(text, "demo.toml", Path::new(""), &shipped())
}

/// Of joints there may be some without a limit of their rate, as of their angles.
#[test]
fn a_joint_may_have_no_limit_of_its_rate() {
    for (rates, expected) in [("[1, []]", [Some(1.0), None]), ("[[], 0.5]", [None, Some(0.5)]), ("2", [Some(2.0); 2])] {
        let text = SCENARIO.replacen("[approach]", &format!("[limits]\njoint_rates = {rates}\n[approach]"), 1);
        let scenario = scenario(&text).unwrap_or_else(|report| panic!("{report}"));
        assert_eq!(scenario.joint_limits.iter().map(|joint| joint.rate).collect::<Vec<_>>(), expected, "{rates}");
    }
}

/// One edit of a valid file: replaced text, its replacement, the line reported, and texts of the message.
type Edit = (&'static str, &'static str, usize, &'static [&'static str]);

fn check<T>(base: &str, file: &str, edits: &[Edit], parse: impl Fn(&str) -> Result<T, Report>) {
    for (from, to, line, wanted) in edits {
        assert!(base.contains(from), "`{from}` is not in the valid file");
        let text = base.replacen(from, to, 1);
        let Err(report) = parse(&text) else {
            unreachable!("`{to}` instead of `{from}` was accepted");
        };
        let shown = report.to_string();
        assert_eq!(report.count(), 1, "`{from}` -> `{to}`:\n{shown}");
        let place = format!("{file}:{line}:");
        for wanted in wanted.iter().copied().chain([place.as_str()]) {
            assert!(shown.contains(wanted), "`{from}` -> `{to}`: no `{wanted}` in\n{shown}");
        }
    }
}

const LAYOUT_EDITS: &[Edit] = &[
    ("mass = 500.0", "mass = -5", 3, &["`base.mass` is -5", "a mass in kg greater than 0"]),
    ("mass = 500.0", "mass = \"5\"", 3, &["`base.mass` is \"5\"", "without quotes"]),
    ("mass = 500.0", "mass = nan", 3, &["`base.mass` is nan", "finite"]),
    ("mass = 500.0", "mass = 1e999", 3, &["`base.mass` is 1e999", "finite"]),
    ("mass = 500.0", "mass = 1e300", 3, &["`base.mass` is 1e300", "magnitude from 1e-100 to 1e100"]),
    (
        "length = 1\n",
        "length = 1e-200\n",
        13,
        &["`arm[0].link[1].length` is 1e-200", "0 or of a magnitude from 1e-100"],
    ),
    (
        "length = 1.0\nmass = 10.0\ninertia = 1.05",
        "length = 1e-5\nmass = 10.0\ninertia = 1e-9",
        10,
        &[
            "`arm[0].link[0].mass` is 10.0",
            "16 digits do not resolve how joint 1 of left moves with the joints beyond it free",
            "of that with them locked, expected at least 1e-5",
        ],
    ),
    (
        "mass = 500.0",
        "mass = 1e15",
        3,
        &["`base.mass` is 1e15", "expected at most 2.000e10 kg, 1e9 times the mass of all arms"],
    ),
    (
        "mass = 10.0",
        "mass = 1e12",
        10,
        &[
            "`arm[0].link[0].mass` is 1e12",
            "expected at most about 5.",
            "e7 kg: inertia + mass · reach² is 6.",
            "1e5 times that of all other",
        ],
    ),
    (
        "mass = 10\ninertia = 1.05",
        "mass = 10\ninertia = 1e12",
        15,
        &["`arm[0].link[1].inertia` is 1e12", "kg m²: inertia + mass · reach² is 1.000e12"],
    ),
    ("mass = 500.0", "mass = true", 3, &["`base.mass` is true", "a mass in kg"]),
    ("mass = 500.0", "mas = 500.0", 3, &["`base.mas` (500.0)", "did you mean `mass`?"]),
    ("mass = 500.0\n", "", 2, &["missing key `base.mass`", "a mass in kg greater than 0"]),
    ("mass = 500.0", "mass = 5\nmoi = 2", 4, &["`base.moi` (2)", "`mass`, `inertia` and `outline`"]),
    ("inertia = 83.61", "inertia = 0", 4, &["`base.inertia` is 0", "kg m²", "greater than 0"]),
    ("\"one_arm\"", "\"One-Arm\"", 1, &["`name` is \"One-Arm\"", "lower-case letters"]),
    ("\"one_arm\"", "\"loop\"", 1, &["`name` is \"loop\"", "Rust keyword", "`loop_robot`"]),
    ("\"one_arm\"", "\"2_arms\"", 1, &["`name` is \"2_arms\"", "a letter first"]),
    ("\"one_arm\"", "\"\"", 1, &["`name` is \"\"", "not blank"]),
    ("\"one_arm\"", "3", 1, &["`name` is 3", "text in quotes"]),
    ("name = \"one_arm\"\n", "", 1, &["missing key `name`", "Rust module"]),
    ("[base]", "[bsae]", 2, &["`bsae` (a table)", "did you mean `base`?"]),
    ("[base]\nmass = 500.0\ninertia = 83.61\n", "base = 5\n", 2, &["`base` is 5", "`[base]`"]),
    ("\"left\"", "\"a\\nb\"", 6, &["`arm[0].name` is \"a\\nb\"", "on one line"]),
    ("[0.5, 0.0]", "[0.5]", 7, &["`arm[0].mount` is [0.5]", "[x, y] in m"]),
    ("[0.5, 0.0]", "0.5", 7, &["`arm[0].mount` is 0.5", "[x, y] in m"]),
    ("[0.5, 0.0]", "[0.5, 'a']", 7, &["`arm[0].mount[1]` is 'a'", "y in m"]),
    ("[0.5, 0.0]", "[0.5, 99999]", 7, &["`arm[0].mount[1]` is 99999", "millimetres = 99.999 m"]),
    ("mount = [0.5, 0.0]\n", "", 5, &["missing key `arm[0].mount`", "[x, y] in m"]),
    ("mount =", "mount_angle = 90\nmount =", 7, &["`arm[0].mount_angle` is 90", "degrees"]),
    ("length = 1.0", "length = -1", 9, &["`arm[0].link[0].length` is -1", "in m of 0 or more"]),
    ("length = 1.0", "length = 25000", 9, &["is 25000", "25000.0 millimetres = 25.0 m"]),
    ("length = 1.0", "length = 1\nmount_angle = 1", 10, &["`arm[0].link[0].mount_angle` (1)", "a key of `arm[0]`"]),
    ("inertia = 1.05\n[", "inertia = 1\ncom = [1,\n 2, 3]\n[", 12, &["com` is [1, 2, 3]", "[x, y]"]),
    ("length = 1\nmass = 10\n", "length = 1\n", 12, &["missing key `arm[0].link[1].mass`"]),
    ("[[arm.link]]\nlength = 1\n", "[[arm.lnik]]\nlength = 1\n", 12, &["`arm[0].lnik`", "`link`"]),
    ("mass = 500.0", "mass = 5\noutline = { box = [1e-90, 1] }", 4, &["`base.outline` is", "expected corners"]),
    ("mass = 500.0", "mass = 5 kg", 3, &["`mass = 5 kg` is not valid TOML", "without units"]),
    ("mass = 500.0", "mass = 1,5", 3, &["`mass = 1,5` is not valid TOML", "decimal point"]),
    ("mass = 500.0", "mass 5", 3, &["`mass 5` is not valid TOML", "write `key = value`"]),
    ("mass = 500.0", "inertia = 1", 4, &["`inertia = 83.61` is not valid TOML", "once"]),
    ("[0.5, 0.0]", "[0.5 0.0]", 7, &["not valid TOML", "separated by commas"]),
];

#[test]
fn broken_layouts() {
    check(LAYOUT, "one.toml", LAYOUT_EDITS, |text| Layout::parse(text, "one.toml"));
}

#[test]
fn arms_are_lists_with_distinct_names() {
    let one_link = "[[arm.link]]\nlength = 1.0\nmass = 10.0\ninertia = 1.05\n";
    let arms = |arms: &str| format!("name = \"a\"\nbase = {{ mass = 1, inertia = 1 }}\n{arms}");
    let arm = format!("[[arm]]\nname = \"left\"\nmount = [0, 0]\n{one_link}");
    let cases = [
        (format!("{arm}{arm}"), "one.toml:11:8", "`arm[1].name` is \"left\": the same as `arm[0].name`"),
        ("arm = []".to_owned(), "one.toml:3:7", "`arm` is [], expected at least one `[[arm]]`"),
        (String::new(), "one.toml:1:1", "missing key `arm`, expected at least one `[[arm]]`"),
        ("[arm]\nname = \"x\"".to_owned(), "one.toml:3:1", "`arm` is a single table"),
        ("[[arm]]\nname='x'\nmount=[0,0]\n[arm.link]".to_owned(), "one.toml:6:1", "write `[[arm.link]]`"),
        ("[[arm]]\nname='x'\nmount=[0,0]".to_owned(), "one.toml:3:1", "at least one `[[arm.link]]`"),
        ("[[arm]]\nname='x'\nmount=[0,0]\nlink=[]".to_owned(), "one.toml:6:6", "`arm[0].link` is []"),
    ];
    for (text, place, message) in cases {
        let shown = Layout::parse(&arms(&text), "one.toml").err().map(|r| (r.count(), r.to_string()));
        let Some((1, shown)) = shown else {
            unreachable!("expected one problem with {text}, found {shown:?}");
        };
        assert!(shown.contains(place) && shown.contains(message), "{place} {message}:\n{shown}");
    }
}

/// The scenario's trajectory, end and end rates.
const STEERED: &str = "\"quartic\"\nfinal_joint_angles = [0.5, 0.6]\nfinal_end_effector_twists = [[0, -0.1, 0]]";

/// End effector paths in place of that, with one more line.
macro_rules! steered {
    ($line:literal) => {
        concat!("\"quintic\"\ntracking = \"resolved_motion_rate\"\nfinal_end_effector_poses = [[1, 1]]\n", $line)
    };
}

const SCENARIO_EDITS: &[Edit] = &[
    ("\"demo\"", "\"a demo/1\"", 1, &["`name` is \"a demo/1\"", "ASCII letters"]),
    ("\"one_arm\"", "\"one_arms\"", 2, &["`layout` is \"one_arms\"", "did you mean `one_arm`?", ".toml"]),
    ("\"one_arm\"", "\"nowhere/x.toml\"", 2, &["`layout` is \"nowhere/x.toml\"", "there is no file"]),
    ("layout = \"one_arm\"\n", "", 1, &["missing key `layout`", "shipped layout's name"]),
    ("[0.1, 0.2]", "[0.1]", 4, &["`initial.joint_angles` is [0.1]", "2 numbers", "left: 2", "found 1"]),
    ("[0.1, 0.2]", "[40, -90]", 4, &["`initial.joint_angles[0]` is 40", "0.698", "degrees"]),
    ("[0.1, 0.2]", "[0.1, 0.2]\nbase_pose = [1, 2]", 5, &["`initial.base_pose` is [1, 2]", "[yaw, x, y] in rad, m, m"]),
    (
        "[0.1, 0.2]",
        "[0.1, 0.2]\nbase_pose = [0, 0, -1e14]",
        5,
        &[
            "`initial.base_pose` is [0, 0, -1e14]: 1.000e14 m from the inertial origin",
            "at most 2.500e9 m",
            "reach of 2.500 m",
        ],
    ),
    ("radius = 0.5", "radius = 0.5\nposition = [3e9, 0]", 17, &["`target[0].position` is [3e9, 0]", "nearer origin"]),
    (
        "contact = [0.0, 0.5]",
        "contact = [0.0, 1e8]",
        15,
        &["`target[0].contact` is [0.0, 1e8]", "1.000e8 m from the COM", "at most 2.500e6 m"],
    ),
    ("[0.0, 0.5]", "[-1e8, 0.0]", 15, &["`target[0].contact` is [-1e8, 0.0]", "1.000e8 m from the COM"]),
    (
        "[post_impact]",
        "[clearance]\nignore = [[\"base\", \"arms/left/tip\"]]\n[post_impact]",
        24,
        &["`clearance.ignore[0][1]` is \"arms/left/tip\", expected `base`"],
    ),
    ("[0.1, 0.2]", "[0.1, 0.2]\nbase_twist = 0", 5, &["`initial.base_twist` is 0", "[ω, vx, vy] in rad/s, m/s, m/s"]),
    ("[0.1, 0.2]", "[0.1, 0.2]\nbase_twist = [1e60, 0, 0]", 5, &["`initial.base_twist[0]` is 1e60", "1e-100 to 1e9"]),
    ("[0.1, 0.2]", "[0.1, 0.2]\nbase_twist = [0, 0, -3e8]", 5, &["`initial.base_twist[2]` is -3e8", "2.99792458e8"]),
    ("[0.1, 0.2]", "[0.1, 0.2]\njoint_rates = [0, 2e9]", 5, &["`initial.joint_rates[1]` is 2e9", "1e-100 to 1e9"]),
    ("[0.1, 0.2]", "[0.1, 0.2]\njoint_rate = [0, 0]", 5, &["unknown key `initial.joint_rate`", "`joint_rates`"]),
    ("duration = 20.0", "duration = 0", 6, &["`approach.duration` is 0", "a duration in s greater than 0"]),
    (
        "duration = 20.0",
        "duration = 20.0\nstep = 30",
        7,
        &["`approach.step` is 30", "longer than the duration, 20.0 s"],
    ),
    (
        "duration = 20.0",
        "duration = 20.0\nstep = 1e-9",
        7,
        &["`approach.step` is 1e-9", "2.000e10 steps", "at most 1e8"],
    ),
    ("duration = 20.0", "duration = 1e-3", 6, &["`approach.duration` is 1e-3", "0.005 s"]),
    ("\"quartic\"", "\"quartik\"", 7, &["`approach.trajectory` is \"quartik\"", "did you mean `quartic`?"]),
    (
        "\"quartic\"",
        "\"spline\"",
        7,
        &["\"spline\", expected `quartic`, `quartic_as_printed`, `cycloidal` or `quintic`"],
    ),
    ("\"quartic\"", "4", 7, &["`approach.trajectory` is 4, expected `quartic`"]),
    ("\"quartic\"", "\"cycloidal\"", 9, &["`approach.final_end_effector_twists` is [[0, -0.1, 0]]", "ends at rest"]),
    ("[[0, -0.1, 0]]", "[[0]]", 9, &["`approach.final_end_effector_twists[0]` is [0]", "[ω, vx, vy]"]),
    ("[[0, -0.1, 0]]", "[0, -0.1, 0]", 9, &["is [0, -0.1, 0], expected 1 twists [ω, vx, vy], one per arm (left)"]),
    (
        "final_end_effector_twists = [[0, -0.1, 0]]\n",
        "",
        5,
        &["missing key `approach.final_end_effector_twists`", "final_joint_rates", "zeros to end at rest"],
    ),
    (
        "final_end_effector_twists",
        "final_effector_twists",
        9,
        &["unknown key `approach.final_effector_twists`", "did you mean `final_end_effector_twists`?"],
    ),
    ("[[0, -0.1, 0]]", "[[0, 0, 0]]\nfinal_joint_rates = [0, 0]", 9, &["`final_joint_rates` is there too"]),
    (
        "\"quartic\"",
        "\"quartic\"\ntracking = \"p\"",
        8,
        &["`approach.tracking` is \"p\", expected `pd`, `exact`, `computed_torque` or `resolved_motion_rate`"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\ntracking = \"exact\"\nderivative_gain = 3",
        9,
        &["`approach.derivative_gain` is 3", "no gains"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\nproportional_gain = -1",
        8,
        &["`approach.proportional_gain` is -1", "N m/rad of 0 or more"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\ntracking = \"computed_torque\"\nderivative_gain = -2",
        9,
        &["`approach.derivative_gain` is -2", "computed torque", "1/s of 0 or more"],
    ),
    ("\"quartic\"", "\"quartic\"\ntorque_limits = -2", 8, &["`approach.torque_limits` is -2", "N m of 0 or more"]),
    ("\"quartic\"", "\"quartic\"\ntorque_limits = [1]", 8, &["`approach.torque_limits` is [1]", "2 numbers"]),
    (
        "\"quartic\"",
        "\"quartic\"\ntracking = \"exact\"\ntorque_limits = 9",
        9,
        &["`approach.torque_limits` is 9", "whatever torque it takes", "`computed_torque`"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\ntracking = \"exact\"\nsample_time = 1",
        9,
        &["`approach.sample_time` is 1", "whatever torque it takes"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\nfinal_end_effector_poses = [[0, 1, 1]]",
        8,
        &["`approach.final_end_effector_poses[0]` is [0, 1, 1]", "fewer than three links", "[x, y]"],
    ),
    (
        "20.0",
        "20.0\ntrajectory_duration = 30",
        7,
        &["`approach.trajectory_duration` is 30", "at most its duration, 20 s"],
    ),
    ("20.0", "20.0\ntrajectory_duration = 0", 7, &["`approach.trajectory_duration` is 0", "in s greater than 0"]),
    (
        "20.0",
        "20.0\ntrajectory_duration = 10",
        7,
        &["is 10: the arms may move at its end", "`final_joint_rates` of zeros"],
    ),
    (
        STEERED,
        steered!("trajectory_duration = 10\nfinal_end_effector_twists = [[0, 1, 0]]"),
        10,
        &["`approach.trajectory_duration` is 10", "`final_end_effector_twists` of zeros"],
    ),
    (
        "[approach]",
        "[limits]\njoint_angles = [1, -1]\n[approach]",
        6,
        &["`limits.joint_angles` is [1, -1]", "low < high"],
    ),
    ("[approach]", "[limits]\njoint_angles = [0.2, 0.2]\n[approach]", 6, &["is [0.2, 0.2]", "low < high"]),
    ("[approach]", "[limits]\njoint_angles = 3\n[approach]", 6, &["is 3, expected [low, high] in rad, or a list of 2"]),
    ("[approach]", "[limits]\njoint_angles = [[-1, 1]]\n[approach]", 6, &["2 numbers, one per joint", "found 1"]),
    ("[approach]", "[limits]\njoint_angles = [[-1, 1], [2]]\n[approach]", 6, &["angles[1]` is [2]", "[low, high]"]),
    ("[approach]", "[limits]\njoint_angles = [-90, 90]\n[approach]", 6, &["looks like degrees"]),
    ("[approach]", "[limits]\njoint_rates = 0\n[approach]", 6, &["`limits.joint_rates` is 0", "rad/s greater than 0"]),
    ("[approach]", "[limits]\njoint_rates = [1]\n[approach]", 6, &["`limits.joint_rates` is [1]", "2 numbers"]),
    (
        "[approach]",
        "[limits]\njoint_rates = [1, [2]]\n[approach]",
        6,
        &["`limits.joint_rates[1]` is [2]", "rad/s greater than 0"],
    ),
    (
        "[approach]",
        "[limits]\njoint_rates = []\n[approach]",
        6,
        &["`limits.joint_rates` is []", "2 numbers", "[] for any rate"],
    ),
    ("[approach]", "[limits]\nangles = 1\n[approach]", 6, &["`limits.angles` (1)", "`joint_angles` and `joint_rates`"]),
    (
        "[approach]",
        "joint_rates = [0, 1]\n[limits]\njoint_rates = 0.5\n[approach]",
        5,
        &["`initial.joint_rates[1]` is 1: faster than joint 2 of left may turn, 0.5 rad/s (`limits.joint_rates`)"],
    ),
    (
        "[approach]",
        "joint_rates = [0, -1]\n[limits]\njoint_rates = 0.5\n[approach]",
        5,
        &["`initial.joint_rates[1]` is -1: faster than joint 2 of left may turn, 0.5 rad/s (`limits.joint_rates`)"],
    ),
    (
        "[approach]",
        "[limits]\njoint_angles = [[0.2, 1], []]\n[approach]",
        4,
        &["`initial.joint_angles[0]` is 0.1: outside the limits of joint 1 of left, 0.2 to 1 rad"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\npose_gain = 2",
        8,
        &["`approach.pose_gain` is 2", "only `tracking = \"resolved_motion"],
    ),
    (
        STEERED,
        "\"quartic\"\ntracking = \"resolved_motion_rate\"\nfinal_end_effector_poses = [[1, 1]]",
        7,
        &["`approach.trajectory` is \"quartic\"", "quintic paths"],
    ),
    (
        STEERED,
        "\"quintic\"\ntracking = \"resolved_motion_rate\"",
        5,
        &["missing key `approach.final_end_effector_poses`", "[yaw, x, y] or [x, y] per arm"],
    ),
    (
        STEERED,
        steered!("final_joint_angles = [0.5, 0.6]"),
        10,
        &["final_joint_angles` is [0.5, 0.6]", "follow the end effectors"],
    ),
    (STEERED, steered!("final_joint_rates = [0.5, 0.6]"), 10, &["final_joint_rates` is [0.5, 0.6]", "_twists`"]),
    (STEERED, steered!("derivative_gain = 3"), 10, &["derivative_gain` is 3", "`pose_gain` and `rate_gain`"]),
    (STEERED, steered!("rate_gain = 0"), 10, &["rate_gain` is 0", "1/s greater than 0"]),
    (STEERED, steered!("singularity_threshold = 1.0"), 10, &["singularity_threshold` is 1.0", "less than 1"]),
    (
        STEERED,
        steered!("final_end_effector_twists = [[1, 0, 0]]"),
        10,
        &["twists[0]` is [1, 0, 0]", "expected [vx, vy]"],
    ),
    ("\"quartic\"", "\"quartic\"\nfinal_end_effector_poses = [[1]]", 8, &["poses[0]` is [1]", "[yaw, x, y]"]),
    ("\"quartic\"", "\"quartic\"\nfinal_end_effector_poses = [[]]", 8, &["is [[]]", "no arm has a pose"]),
    ("\"quartic\"", "\"quartic\"\nfinal_end_effector_poses = []", 8, &["is []", "per arm", "found 0"]),
    ("\"quartic\"", "\"quartic\"\nsample_time = 0", 8, &["`approach.sample_time` is 0", "in s greater than 0"]),
    (
        "\"quartic\"",
        "\"quartic\"\nsample_time = 0.012",
        8,
        &["`approach.sample_time` is 0.012", "whole number of steps of 0.005 s", "0.01 s"],
    ),
    ("\"quartic\"", "\"quartic\"\nsample_time = 0.001", 8, &["`approach.sample_time` is 0.001", "0.005 s for example"]),
    (
        "\"quartic\"",
        "\"quartic\"\nsample_time = 30",
        8,
        &["`approach.sample_time` is 30", "at most its duration, 20 s"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\nintegrator = \"rk5\"",
        8,
        &[
            "`approach.integrator` is \"rk5\", expected `rk4`, `semi_implicit_euler`, `gauss_legendre` or `adaptive`",
            "`rk4`?",
        ],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\ncoordinates = \"joints\"",
        8,
        &["`approach.coordinates` is \"joints\"", "`full` or `reduced`"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\ncoordinates = \"reduced\"\nintegrator = \"gauss_legendre\"",
        8,
        &["`approach.coordinates` is \"reduced\"", "keeps the momentum in full coordinates", "another integrator"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\nintegrator = \"rk4\"\ntolerance = 1e-9",
        9,
        &["`approach.tolerance` is 1e-9", "`integrator = \"adaptive\"`"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\nintegrator = \"adaptive\"\ntolerance = 0",
        9,
        &["`approach.tolerance` is 0", "a tolerance", "greater than 0"],
    ),
    (
        "\"quartic\"",
        "\"quartic\"\nintegrator = \"adaptive\"\ntolerance = 1e-16",
        9,
        &["`approach.tolerance` is 1e-16", "expected 1e-14 to 1e-3", "rounding"],
    ),
    (
        "duration = 50.0",
        "duration = 50.0\nintegrator = \"gauss_legendre\"\ntolerance = 1e-9",
        26,
        &["`post_impact.tolerance` is 1e-9", "`integrator = \"adaptive\"`"],
    ),
    ("\"quartic\"", "\"quartic\"\nproportional_gain = [1]", 8, &["`approach.proportional_gain` is [1]", "2 numbers"]),
    (
        "[0.1, 0.2]\n[approach]",
        "[0.1, 0.2]\njoint_rates = [0, 1]\n[approach]\ntracking = \"exact\"",
        5,
        &["`initial.joint_rates` is [0, 1]", "starts from rest", "`tracking = \"pd\"`"],
    ),
    (
        "arm = \"left\"",
        "arm = \"lefty\"",
        12,
        &["`target[0].arm` is \"lefty\"", "did you mean `left`?", "layout `one_arm`"],
    ),
    ("radius = 0.5", "radius = 1e15", 16, &["`target[0].radius` is 1e15", "1e6 times the robot's reach of 2.500 m"]),
    ("mass = 10.0", "mass = 1e-300", 13, &["`target[0].mass` is 1e-300", "magnitude from 1e-100"]),
    ("mass = 10.0", "mass = 1e20", 13, &["`target[0].mass` is 1e20", "1e-15 to 1e12 times that of the robot, 5.200e2"]),
    ("inertia = 1.0", "inertia = 1e-30", 14, &["`target[0].inertia` is 1e-30", "kg m²", "times that of the robot"]),
    ("duration = 20.0", "duration = 1e-90", 6, &["than the duration, 1e-90 s"]),
    ("radius = 0.5", "radius = 0", 16, &["`target[0].radius` is 0", "a radius in m greater than 0"]),
    ("contact = [0.0, 0.5]\n", "", 10, &["missing key `target[0].contact`", "[rx, ry] in m"]),
    ("radius = 0.5", "radius = 0.5\nposition = [1]", 17, &["`target[0].position` is [1]", "[x, y] in m"]),
    ("\"still\"", "\"spin\"", 21, &["`case[1].name` is \"spin\": the same as `case[0].name`"]),
    ("\"still\"", "\"Spin\"", 21, &["`case[1].name` is \"Spin\": the same as `case[0].name`", "upper and lower case"]),
    ("\"still\"", "\".still\"", 21, &["`case[1].name` is \".still\"", "not `.` first"]),
    ("{ ball =", "{ bal =", 22, &["`case[1].target_twists.bal` ([0, 0, 0])", "did you mean `ball`?"]),
    ("{ ball = [0, 0, 0] }", "{ ball = [0, 0] }", 22, &["`case[1].target_twists.ball` is [0, 0]", "[ω, vx, vy]"]),
    ("{ ball = [0, 0, 0] }", "[0, 0, 0]", 22, &["`case[1].target_twists` is [0, 0, 0], expected a table with `ball`"]),
    (
        "{ ball = [0, 0, 0] }",
        "{ ball = [0, 0, 0] }\nset = { \"layout.base.mass\" = -1.0 }",
        23,
        &["`case[1].set.\"layout.base.mass\"` is -1.0", "greater than 0"],
    ),
    (
        "{ ball = [0, 0, 0] }",
        "{ ball = [0, 0, 0] }\nset = { \"approach.duratio\" = 1.0 }",
        23,
        &["did you mean `approach.duration`?"],
    ),
    (
        "{ ball = [0, 0, 0] }",
        "{ ball = [0, 0, 0] }\nset = { approach.duration = 12.0 }",
        23,
        &["`case[1].set.approach` is a table", "in quotes"],
    ),
    (
        "{ ball = [0, 0, 0] }",
        "{ ball = [0, 0, 0] }\nset = { \"case.spin.target_twists.ball[0]\" = 1.0 }",
        23,
        &["what is a case's own stands beside `set`"],
    ),
    ("{ ball = [0, 0, 0] }", "{ ball = [0, 0, 0] }\nset = { name = \"x\" }", 23, &["a `name` cannot vary"]),
    (
        "{ ball = [0, 0, 0] }",
        "{ ball = [0, 0, 0] }\nset = { \"target.ball.mass\" = \"x\" }",
        23,
        &["`case[1].set.\"target.ball.mass\"` is \"x\"", "a mass in kg"],
    ),
    (
        "{ ball = [0, 0, 0] }",
        "{ ball = [0, 0, 0] }\nset = { \"target.bal.mass\" = 1.0 }",
        23,
        &["no `target` of the name `bal`"],
    ),
    (
        "{ ball = [0, 0, 0] }",
        "{ ball = [0, 0, 0] }\nset = { \"target.ball.contact\" = 1.0 }",
        23,
        &["`target.ball.contact[0]`"],
    ),
    (
        "{ ball = [0, 0, 0] }",
        "{ ball = [0, 0, 0] }\nset = { \"approach.duration\" = 0.001 }",
        23,
        &["`case[1].set.\"approach.duration\"` is 0.001", "the step, 0.005 s"],
    ),
    (
        "{ ball = [0, 0, 0] }",
        "{ ball = [0, 0, 0] }\nset = { \"approach.step\" = 0.1, \"approach.duration\" = 0.05 }",
        23,
        &["`case[1].set` is {", "together, `approach.step` is 0.1"],
    ),
    ("{ ball = [0, 0, 0] }", "{ ball = [0, 0, 0] }\nset = {}", 23, &["it sets nothing"]),
    ("{ ball = [0, 0, 0] }", "{ ball = [0, 0, 0] }\nset = [1.0]", 23, &["`case[1].set` is [1.0], expected a table"]),
    ("[post_impact]\nduration = 50.0\n", "", 1, &["missing key `post_impact`", "`duration`, `step`"]),
    ("duration = 50.0", "duration = 50.0\nstep = 0", 25, &["`post_impact.step` is 0", "greater than 0"]),
    ("duration = 50.0", "duration = 50.0\ncontrol = 1", 25, &["`post_impact.control` is 1, expected `none`, `hold`"]),
    ("duration = 50.0", "duration = 50.0\ncontrol = \"stabilize\"", 25, &["did you mean `stabilise`?"]),
    ("duration = 50.0", "duration = 50.0\ntorque_limits = 1", 25, &["`post_impact.torque_limits` is 1", "no torques"]),
    (
        "duration = 50.0",
        "duration = 50.0\ncontrol = \"hold\"\nbase_torque_limit = 1",
        26,
        &["`post_impact.base_torque_limit` is 1", "only `control = \"stabilise\"`"],
    ),
    (
        "duration = 50.0",
        "duration = 50.0\ncontrol = \"damping\"\nproportional_gain = 1",
        26,
        &["`post_impact.proportional_gain` is 1", "derivative_gain alone"],
    ),
    (
        "duration = 50.0",
        "duration = 50.0\ncontrol = \"stabilise\"\nproportional_gain = 1",
        26,
        &["`post_impact.proportional_gain` is 1", "wants no angles"],
    ),
    (
        "duration = 50.0",
        "duration = 50.0\ncontrol = \"stabilise\"\nbase_torque_limit = -1",
        26,
        &["`post_impact.base_torque_limit` is -1", "in N m of 0 or more"],
    ),
    (
        "duration = 50.0",
        "duration = 50.0\ncontrol = \"stabilise\"\nsample_time = 0.012",
        26,
        &["`post_impact.sample_time` is 0.012", "whole number of steps"],
    ),
    ("[post_impact]", "[post_imapct]", 23, &["unknown key `post_imapct` (a table)", "did you mean `post_impact`?"]),
];

#[test]
fn broken_scenarios() {
    check(SCENARIO, "demo.toml", SCENARIO_EDITS, scenario);
}

#[test]
fn an_arm_captures_one_target() {
    let start = SCENARIO.find("[[target]]").unwrap_or(0);
    let end = SCENARIO.find("[[case]]").unwrap_or(0);
    let (target, cases) = (&SCENARIO[start..end], &SCENARIO[end..]);
    let second = target.replace("ball", "box");
    let text = format!("{}{second}{cases}", &SCENARIO[..end]);
    let shown = scenario(&text).err().map(|report| report.to_string()).unwrap_or_default();
    assert!(shown.contains("`target[1].arm` is \"left\": the same as `target[0].arm`"), "{shown}");
    assert!(shown.contains("demo.toml:20:7") && shown.contains("at most one target"), "{shown}");
}

/// Where targets share a name or have none, their keys in the cases are not checked.
#[test]
fn target_names_are_reported_once() {
    let start = SCENARIO.find("[[target]]").unwrap_or(0);
    let end = SCENARIO.find("[[case]]").unwrap_or(0);
    let (target, cases) = (&SCENARIO[start..end], SCENARIO[end..].replace("{ ball =", "{ box ="));
    let second = target.replace("\"left\"", "\"right\"");
    let right = LAYOUT[LAYOUT.find("[[arm]]").unwrap_or(0)..].replace("\"left\"", "\"right\"");
    let layout = format!("{LAYOUT}{right}");
    let head = SCENARIO[..end].replace("0.2]", "0.2, 0, 0]").replace("0.6]", "0.6, 0, 0]");
    let head = head.replace("[[0, -0.1, 0]]", "[[0, -0.1, 0], [0, 0, 0]]");
    let report = |text: &str| {
        let report = Scenario::parse(text, "demo.toml", Path::new(""), &[("one_arm", &layout)]).err();
        report.map(|report| (report.count(), report.to_string())).unwrap_or_default()
    };
    let (count, shown) = report(&format!("{head}{second}{cases}"));
    assert_eq!(count, 1, "{shown}");
    assert!(shown.contains("`target[1].name` is \"ball\": the same as `target[0].name`"), "{shown}");
    let (count, shown) = report(&format!("{}{cases}", head.replace("name = \"ball\"", "nmae = \"ball\"")));
    assert_eq!(count, 1, "{shown}");
    assert!(shown.contains("did you mean `name`?"), "{shown}");
}

#[test]
fn without_targets_there_is_nothing_to_capture() {
    let end = SCENARIO.find("[[target]]").unwrap_or(0);
    let alone = &SCENARIO[..end];
    let text = format!("{alone}[[case]]\nname = \"a\"\n[post_impact]\nduration = 1\n");
    let shown = scenario(&text).err().map(|report| report.to_string()).unwrap_or_default();
    assert!(shown.contains("demo.toml:10:1") && shown.contains("without a `[[target]]`"), "{shown}");
    assert!(shown.contains("demo.toml:12:1") && shown.contains("`post_impact` is a table"), "{shown}");
    let alone = scenario(alone);
    assert!(matches!(&alone, Ok(s) if s.cases.len() == 1 && s.cases[0].name == "demo"), "{alone:?}");
    assert!(matches!(&alone, Ok(s) if s.post_impact.is_none() && s.targets.is_empty()));
}

/// Python and editors read TOML 1.0, where a table in braces is one line; values in it may be several.
#[test]
fn tables_in_braces_are_those_of_toml_1_0() {
    let with = |outline: &str| {
        let text = LAYOUT.replacen("83.61", &format!("83.61\noutline = {outline}"), 1);
        let report = Layout::parse(&text, "one.toml").err();
        report.map(|report| (report.count(), report.to_string()))
    };
    for fine in ["{ disc = 1 }", "{disc=1}", "{ box = [\n1, # m\n2,\n], center = [0,\n0] }"] {
        assert_eq!(with(fine), None, "{fine}");
    }
    for (outline, why) in [
        ("{\n disc = 1 }", "stands on one line"),
        ("{ disc = 1\n}", "stands on one line"),
        ("{ box = [1, 2],\n angle = 0.1 }", "stands on one line"),
        ("{ disc = 1, # m\n}", "stands on one line"),
        ("{ disc = 1, }", "no comma at its end"),
    ] {
        let (count, shown) = with(outline).unwrap_or_else(|| panic!("{outline} is accepted"));
        assert!(count == 1 && shown.contains(why) && shown.contains("one.toml:5:11"), "{outline}:\n{shown}");
        assert!(shown.contains("TOML 1.0") && shown.contains("write it on one line"), "{shown}");
    }
    // beside what else is wrong, and in tables in braces in a list
    let text = SCENARIO.replacen("{ ball = [0, 0, 0] }", "{ ball = [0, 0, 0],\n}\nkinds = { ball = \"rigd\" }", 1);
    let shown = scenario(&text).err().map(|report| (report.count(), report.to_string())).unwrap_or_default();
    assert!(shown.0 == 2 && shown.1.contains("demo.toml:22:17") && shown.1.contains("`rigid`?"), "{}", shown.1);
    let layout = "name = 'a'\nbase = { mass = 1, inertia = 1 }\n\
                  arm = [\n{ name = 'l', mount = [0, 0], link = [{ length = 1,\n mass = 1, inertia.x = 1 }] },\n]";
    let shown = Layout::parse(layout, "one.toml").expect_err("a line in braces").to_string();
    assert!(shown.contains("one.toml:4:39") && shown.contains("stands on one line"), "{shown}");
}

#[test]
fn problems_are_reported_together_in_order() {
    let text = LAYOUT.replacen("500.0", "-1", 1).replacen("83.61", "inf", 1).replacen("\"left\"", "7", 1).replacen(
        "length = 1.0",
        "lenght = 1.0",
        1,
    );
    let report = Layout::parse(&text, "one.toml").err();
    assert_eq!(report.as_ref().map(Report::count), Some(4));
    let shown = report.map(|report| report.to_string()).unwrap_or_default();
    let lines = [3, 4, 6, 9].map(|line| shown.find(&format!("one.toml:{line}:")));
    assert!(lines.iter().all(Option::is_some) && lines.is_sorted(), "{shown}");
}

#[test]
fn long_reports_are_cut_to_a_screen() {
    let lines: Vec<_> = (0..30).map(|i| format!("key{i} = {i}\n")).collect();
    let report = Layout::parse(&lines.concat(), "many.toml").err();
    assert_eq!(report.as_ref().map(Report::count), Some(33));
    let shown = report.map(|report| report.to_string()).unwrap_or_default();
    assert!(shown.ends_with("... and 25 more problems"), "{shown}");
    assert!(shown.lines().count() < 80, "{shown}");
}

#[test]
fn syntax_errors_are_shown_once_per_line() {
    let text = "name = \"a\nmass = [1, 2\ninertia == 3\nb = 1 kg\n";
    let shown = Layout::parse(text, "s.toml").err().map(|r| r.to_string()).unwrap_or_default();
    let places: Vec<_> = shown.lines().filter_map(|line| line.trim().strip_prefix("--> s.toml:")).collect();
    let lines: HashSet<_> = places.iter().filter_map(|place| place.split(':').next()).collect();
    assert!(places.len() > 1 && places.len() == lines.len(), "{shown}");
}

#[test]
fn unreadable_files() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = |name: &str| folder.path().join(name);
    let report = |path: &Path| Layout::read(path).err().map(|r| r.to_string()).unwrap_or_default();
    fs::write(file("dual_arm.toml"), LAYOUT)?;
    fs::write(file("latin.toml"), b"# ok\nname = \"caf\xe9\"\n")?;
    fs::write(file("huge.toml"), vec![b'#'; (16 << 20) + 1])?;
    fs::write(file("empty.toml"), "")?;

    let shown = report(&file("dual_arms.toml"));
    assert!(shown.contains("there is no file `") && shown.contains("dual_arms.toml"), "{shown}");
    assert!(shown.contains("did you mean `") && shown.contains("dual_arm.toml`?"), "{shown}");
    let shown = report(&file("dual_arm"));
    assert!(shown.contains("dual_arm.toml`?"), "{shown}");
    let shown = report(&file("no/such.toml"));
    assert!(shown.contains("there is no folder"), "{shown}");
    let shown = report(folder.path());
    assert!(shown.contains("is a folder") && shown.contains("dual_arm.toml"), "{shown}");
    let shown = report(&file("latin.toml"));
    assert!(shown.contains("latin.toml:2:12: byte 0xe9 is not UTF-8"), "{shown}");
    let shown = report(&file("huge.toml"));
    assert!(shown.contains("larger than 16 MiB"), "{shown}");
    let shown = report(&file("empty.toml"));
    assert!(shown.contains("missing key `name`") && shown.contains("`base`"), "{shown}");
    Ok(())
}

#[test]
fn a_broken_layout_shows_its_own_place_and_the_scenario_is_still_checked() -> Outcome {
    let folder = tempfile::tempdir()?;
    fs::create_dir(folder.path().join("scenarios"))?;
    fs::write(folder.path().join("arm.toml"), LAYOUT.replacen("500.0", "0", 1))?;
    let path = folder.path().join("scenarios/demo.toml");
    let text = SCENARIO.replacen("\"one_arm\"", "\"../arm.toml\"", 1);
    fs::write(&path, text.replacen("radius = 0.5", "radius = -1", 1))?;
    let shown = Scenario::read(&path, Known::default()).err().map(|r| r.to_string()).unwrap_or_default();
    assert!(shown.contains("arm.toml:3:8") && shown.contains("`base.mass` is 0"), "{shown}");
    assert!(shown.contains("demo.toml:16:10") && shown.contains("`target[0].radius`"), "{shown}");

    fs::write(folder.path().join("arm.toml"), LAYOUT)?;
    fs::write(&path, text)?;
    assert_eq!(Scenario::read(&path, Known::default())?.layout, Layout::parse(LAYOUT, "")?);

    let shown = scenario(&SCENARIO.replacen("one_arm", "broken", 1)).err().map(|r| r.to_string());
    let shown = shown.unwrap_or_default();
    assert!(shown.contains("broken.toml (shipped):4:11"), "{shown}");
    Ok(())
}

#[test]
fn colour_only_where_asked_for() {
    let report = Layout::parse("name = 5", "one.toml").err();
    let (plain, styled) = report.map(|r| (r.render(false), r.render(true))).unwrap_or_default();
    assert!(!plain.is_empty() && !plain.contains('\u{1b}') && styled.contains('\u{1b}'));
    let report = Layout::parse("\"a\u{9b}\\u001b[31mb\" = 5", "\u{1b}one.toml").err();
    let shown = report.map(|r| r.to_string()).unwrap_or_default();
    assert!(!shown.is_empty() && !shown.contains('\u{1b}') && !shown.contains('\u{9b}'), "{shown}");
}

#[test]
fn valid_files() -> Outcome {
    let layout = Layout::parse(LAYOUT, "one.toml")?;
    assert_eq!((layout.joints(), layout.arms[0].links[1].com), (2, [0.5, 0.0]));
    let windows = format!("\u{feff}{}", LAYOUT.replace('\n', "\r\n"));
    assert_eq!(Layout::parse(&windows, "one.toml")?, layout);
    let wheel = LAYOUT.replacen("length = 1.0", "length = 0x0\ncom = [0, -0.0]", 1);
    assert_eq!(Layout::parse(&wheel, "one.toml")?.arms[0].links[0].length.to_bits(), 0);

    let demo = scenario(SCENARIO)?;
    assert_eq!(demo.approach.trajectory, TrajectoryKind::Quartic);
    assert_eq!(demo.approach.end, FinalRates::EndEffectorTwists(vec![[0.0, -0.1, 0.0].map(Some)]));
    assert_eq!((demo.approach.duration, demo.approach.step), (20.0, 0.005));
    let gains = (vec![49.0, 49.0], vec![14.0, 14.0]);
    let tracking =
        |(proportional_gain, derivative_gain)| Tracking::ProportionalDerivative { proportional_gain, derivative_gain };
    assert_eq!(demo.approach.tracking, tracking(gains));
    assert_eq!(demo.initial.joint_rates, [0.0, 0.0]);
    let cases: Vec<_> = demo.cases.iter().map(|c| (c.name.as_str(), c.target_twists[0])).collect();
    assert_eq!(cases, [("spin", [0.2, 0.0, 0.0]), ("still", [0.0; 3])]);

    let text = SCENARIO
        .replacen("\"quartic\"", "\"cycloidal\"\nproportional_gain = [1, 2]\nderivative_gain = 0", 1)
        .replacen("final_end_effector_twists = [[0, -0.1, 0]]\n", "", 1)
        .replacen(
            "[[case]]\nname = \"spin\"\n[[case]]\nname = \"still\"\ntarget_twists = { ball = [0, 0, 0] }\n",
            "",
            1,
        );
    let demo = scenario(&text)?;
    assert_eq!(demo.approach.end, FinalRates::Rest);
    assert_eq!(demo.approach.tracking, tracking((vec![1.0, 2.0], vec![0.0, 0.0])));
    assert_eq!((demo.cases.len(), demo.cases[0].name.as_str()), (1, "demo"));
    assert_eq!(demo.cases[0].target_twists, [[0.2, 0.0, 0.0]]);
    Ok(())
}

#[test]
fn the_hash_is_of_the_content() -> Outcome {
    let text = include_str!("../../codegen/layouts/dual_arm_3r.toml");
    let hash = Layout::parse(text, "dual_arm_3r.toml")?.sha256();
    // Computed in Python, from the format's description, with struct and hashlib.
    assert_eq!(hash, "a6de99dfde7250247e3fa7445a3d9dac7f06c957d7e3dcdf03a478002ed876bf");
    let same = [
        text.replace("10.0", "1e1").replace("[0.5, 0.0]", "[0.5, -0.0]"),
        text.replace("length = 1.0", "length = 1 # m\ncom = [0.5, 0]"),
        text.replace("name = \"arm1\"", "name = 'arm1'\nmount_angle = -0.0"),
    ];
    for same in same {
        assert_eq!(Layout::parse(&same, "same.toml")?.sha256(), hash);
    }
    let other = text.replace("83.61", "83.61000000000001");
    assert_ne!(Layout::parse(&other, "other.toml")?.sha256(), hash);
    Ok(())
}

/// Every cut and every one-character edit of the valid files is read or reported, never a panic.
#[test]
fn any_edit_is_read_or_reported() {
    let check = |text: &str| {
        let reports = [Layout::parse(text, "x.toml").err(), scenario(text).err()];
        for report in reports.into_iter().flatten() {
            assert!(report.count() > 0 && !report.render(true).is_empty());
        }
    };
    for text in [LAYOUT, SCENARIO] {
        for at in 0..text.len() {
            check(&text[..at]);
            for edit in ["", "[", "]", "\"", "{", "=", "-", "\n", "é", "\t", "\0", "\r", "\u{202e}"] {
                check(&format!("{}{edit}{}", &text[..at], &text[at + 1..]));
            }
        }
    }
}

#[test]
fn suggestions() {
    assert_eq!(nearest("inertai", ["mass", "inertia"]), Some("inertia"));
    assert_eq!(nearest("Mass", ["mass", "inertia"]), Some("mass"));
    assert_eq!(nearest("colour", ["mass", "inertia"]), None);
}

/// Two arms on one target, in two cases.
const CONTACTS: &str = r#"name = "demo"
layout = "two_arms"
[initial]
joint_angles = [0.1, 0.2, 0.1, 0.2]
[approach]
duration = 20.0
trajectory = "cycloidal"
final_joint_angles = [0.5, 0.6, 0.5, 0.6]
[contact]
detection = "time"
duration = 0.05
[[target]]
name = "panel"
arm = ["left", "right"]
kind = ["rigid", "pin"]
mass = 10.0
inertia = 1.0
contact = [[0.5, 0.2], [-0.5, 0.2]]
polygon = [[-1.0, -0.2], [1.0, -0.2], [1.0, 0.2], [-1.0, 0.2]]
restitution = 0.5
[[case]]
name = "as_it_is"
[[case]]
name = "other"
kinds = { panel = ["pin", "bounce"] }
restitutions = { panel = 0.9 }
[post_impact]
duration = 50.0
"#;

fn two_arms() -> String {
    let right = LAYOUT[LAYOUT.find("[[arm]]").unwrap_or(0)..].replace("\"left\"", "\"right\"");
    LAYOUT.replace("\"one_arm\"", "\"two_arms\"") + &right
}

/// The target's outline.
const OUTLINE: &str = "[[-1.0, -0.2], [1.0, -0.2], [1.0, 0.2], [-1.0, 0.2]]";
const BOTH_ARMS: &str = "[\"left\", \"right\"]";
const POINTS: &str = "[[0.5, 0.2], [-0.5, 0.2]]";

/// One more target before the cases, of this arm.
macro_rules! with_ball {
    ($arm:literal) => {
        concat!(
            "[[target]]\nname = \"ball\"\narm = ",
            $arm,
            "\nmass = 1\ninertia = 1\nradius = 1\ncontact = [1, 0]\n[[case]]"
        )
    };
}

const CONTACT_EDITS: &[Edit] = &[
    ("\"time\"", "\"events\"", 10, &["`contact.detection` is \"events\", expected `time` or `event`", "mean `event`?"]),
    ("\"time\"", "true", 10, &["`contact.detection` is true, expected `time` or `event`"]),
    (
        "duration = 0.05",
        "duration = 0",
        11,
        &["`contact.duration` is 0, expected the duration of a contact in s", "than 0"],
    ),
    ("duration = 0.05", "duraton = 1", 11, &["`contact.duraton` (1)", "did you mean `duration`?"]),
    ("[contact]", "[[contact]]", 9, &["`contact` is a list of tables", "write `[contact]`"]),
    (BOTH_ARMS, "[\"left\", \"rihgt\"]", 14, &["`target[0].arm[1]` is \"rihgt\", expected `left`", "mean `right`?"]),
    (BOTH_ARMS, "[\"left\", \"left\"]", 14, &["`target[0].arm` is [\"left\", \"left\"]", "different arms"]),
    (BOTH_ARMS, "[]", 14, &["`target[0].arm` is []", "expected the names of one arm or more"]),
    (BOTH_ARMS, "2", 14, &["`target[0].arm` is 2, expected `left` or `right`", "arms of the layout `two_arms`"]),
    (BOTH_ARMS, "[1, \"left\"]", 14, &["`target[0].arm[0]` is 1, expected `left` or `right`"]),
    (
        "[[case]]",
        with_ball!("\"right\""),
        23,
        &["`target[1].arm` is \"right\": `right` is in `target[0].arm`", "one target"],
    ),
    ("[[case]]", with_ball!("[\"left\"]"), 23, &["`target[1].arm` is [\"left\"]: `left` is in `target[0].arm`"]),
    (
        "[\"rigid\", \"pin\"]",
        "\"rigd\"",
        15,
        &["`target[0].kind` is \"rigd\", expected `rigid`, `pin`", "mean `rigid`?"],
    ),
    ("[\"rigid\", \"pin\"]", "[\"rigid\"]", 15, &["`target[0].kind` is [\"rigid\"]", "each of the 2 arms", "found 1"]),
    ("[\"rigid\", \"pin\"]", "[\"rigid\", 4]", 15, &["`target[0].kind[1]` is 4, expected `rigid`, `pin`, `bounce` or"]),
    ("[\"rigid\", \"pin\"]", "[\"rigid\", \"weld\"]", 15, &["`target[0].kind[1]` is \"weld\", expected `rigid`"]),
    (
        POINTS,
        "[0.5, 0.2]",
        18,
        &["`target[0].contact` is [0.5, 0.2]", "[rx, ry] in m for each of the 2 arms", "found 1"],
    ),
    (POINTS, "[[0.5, 0.2]]", 18, &["`target[0].contact` is [[0.5, 0.2]]", "each of the 2 arms", "found 1"]),
    (POINTS, "[]", 18, &["`target[0].contact` is []", "[rx, ry] in m for each of the 2 arms", "found 0"]),
    (POINTS, "[[0.5, 0.2], [-0.5]]", 18, &["`target[0].contact[1]` is [-0.5], expected [rx, ry] in m"]),
    (POINTS, "[[0.5, 0.2], 3]", 18, &["`target[0].contact[1]` is 3, expected [rx, ry] in m"]),
    (POINTS, "[3, [0.5, 0.2]]", 18, &["`target[0].contact[0]` is 3, expected [rx, ry] in m"]),
    (POINTS, "0.5", 18, &["`target[0].contact` is 0.5, expected [rx, ry] in m, or a list of those, one per arm"]),
    ("contact = [[0.5, 0.2], [-0.5, 0.2]]\n", "", 12, &["missing key `target[0].contact`", "one per arm"]),
    (
        "polygon =",
        "radius = 1.0\npolygon =",
        20,
        &["`target[0].polygon` is", "`radius` is there too, expected one of the two"],
    ),
    ("polygon =", "poligon =", 19, &["unknown key `target[0].poligon`", "did you mean `polygon`?"]),
    (OUTLINE, "1.0", 19, &["`target[0].polygon` is 1.0, expected a list of corners [x, y] in m", "COM at the origin"]),
    (OUTLINE, "[[-1, 0], [1, 0]]", 19, &["`target[0].polygon` is [[-1, 0], [1, 0]]", "three corners or more, found 2"]),
    (OUTLINE, "[[-1, 0], [1, 0], [0, 0]]", 19, &["encloses nothing", "not all on a line"]),
    (OUTLINE, "[[-1, -1], [1, 1], [1, -1], [-1, 1]]", 19, &["edges 1 and 3", "expected corners in their order"]),
    (OUTLINE, "[[-1, 0], [1, 1], [1]]", 19, &["`target[0].polygon[2]` is [1], expected [x, y] in m"]),
    // no body of a positive density has its COM on an edge
    (OUTLINE, "[[0, -1], [2, -1], [2, 1], [0, 1]]", 19, &["the COM", "is outside, expected corners around [0, 0]"]),
    (OUTLINE, "[[0, 0], [2, 0], [2, 1], [0, 1]]", 19, &["the COM", "is outside, expected corners around [0, 0]"]),
    ("restitution = 0.5", "restitution = 1.5", 20, &["`target[0].restitution` is 1.5", "0 (no rebound) to 1"]),
    ("restitution = 0.5", "restitution = -0.5", 20, &["`target[0].restitution` is -0.5", "0 (no rebound) to 1"]),
    ("restitution = 0.5", "restitution = nan", 20, &["`target[0].restitution` is nan", "finite"]),
    ("restitution = 0.5", "restitution = \"half\"", 20, &["is \"half\", expected a restitution"]),
    ("restitution = 0.5", "yaw = 90", 20, &["`target[0].yaw` is 90", "looks like degrees"]),
    ("restitution = 0.5", "position = [1]", 20, &["`target[0].position` is [1], expected [x, y] in m"]),
    (
        "[\"pin\", \"bounce\"]",
        "[\"pin\"]",
        25,
        &["`case[1].kinds.panel` is [\"pin\"]", "each of the 2 arms", "found 1"],
    ),
    ("[\"pin\", \"bounce\"]", "\"bouncy\"", 25, &["`case[1].kinds.panel` is \"bouncy\"", "did you mean `bounce`?"]),
    ("[\"pin\", \"bounce\"]", "[\"pin\", 1]", 25, &["`case[1].kinds.panel[1]` is 1, expected `rigid`"]),
    (
        "{ panel = [\"pin\", \"bounce\"] }",
        "\"pin\"",
        25,
        &["`case[1].kinds` is \"pin\", expected a table with `panel`"],
    ),
    // its restitution needs a bounce
    ("{ panel = [", "{ pannel = \"pin\", panel = [", 25, &["`case[1].kinds.pannel`", "mean `panel`?"]),
    ("{ panel = 0.9 }", "{ panel = 9 }", 26, &["`case[1].restitutions.panel` is 9, expected a restitution"]),
    ("{ panel = 0.9 }", "0.9", 26, &["`case[1].restitutions` is 0.9, expected a table with `panel`"]),
    ("{ panel = 0.9 }", "{ pane = 0.9 }", 26, &["`case[1].restitutions.pane` (0.9)", "did you mean `panel`?"]),
    ("restitutions", "restitution", 26, &["`case[1].restitution`", "did you mean `restitutions`?"]),
];

/// Where contacts are found by detection.
const DETECTION_EDITS: &[Edit] = &[
    ("position = [3, 0]\n", "", 12, &["missing key `target[0].position`", "[x, y] of its COM at the start in m"]),
    ("[3, 0]", "3", 18, &["`target[0].position` is 3, expected [x, y] in m"]),
    (
        "[3, 0]",
        "[3, 0]\ncontact = [1, 0]",
        19,
        &["`target[0].contact` is [1, 0]", "`contact.detection`", "no such key"],
    ),
];

#[test]
fn broken_contacts() {
    let layout = two_arms();
    let parse = |text: &str| Scenario::parse(text, "demo.toml", Path::new(""), &[("two_arms", &layout)]);
    let valid = parse(CONTACTS).unwrap_or_else(|report| panic!("{report}"));
    assert_eq!(valid.cases[1].restitutions, [0.9]);
    check(CONTACTS, "demo.toml", CONTACT_EDITS, parse);
    let detected =
        CONTACTS.replace("\"time\"", "\"event\"").replace(&format!("contact = {POINTS}"), "position = [3, 0]");
    let valid = parse(&detected).unwrap_or_else(|report| panic!("{report}"));
    assert_eq!(valid.targets[0].position, Some([3.0, 0.0]));
    check(&detected, "demo.toml", DETECTION_EDITS, parse);

    // two problems, as both lists are too long; and a key that neither outline has
    let report = |text: &str| parse(text).err().map(|r| (r.count(), r.to_string())).unwrap_or_default();
    let (count, shown) = report(&CONTACTS.replace(BOTH_ARMS, "\"left\""));
    assert!(count == 2 && shown.matches("for the one arm that touches it, found 2").count() == 2, "{shown}");
    let (count, shown) = report(&CONTACTS.replace(&format!("polygon = {OUTLINE}\n"), ""));
    assert!(count == 1 && shown.contains("missing key `target[0].radius`"), "{shown}");
    assert!(shown.contains("demo.toml:12:1") && shown.contains("the corners of a `polygon`"), "{shown}");

    // restitution where nothing bounces: of the target in no case, or in a case of its own
    let held = CONTACTS.replace("\"pin\", \"bounce\"", "\"pin\", \"rigid\"");
    let (count, shown) = report(&held);
    assert!(count == 1 && shown.contains("`case[1].restitutions.panel` is 0.9: no contact"), "{shown}");
    let (count, shown) = report(&held.replace("restitutions = { panel = 0.9 }\n", ""));
    assert!(count == 1 && shown.contains("demo.toml:20:15") && shown.contains("is 0.5: no contact"), "{shown}");
    // reduced coordinates with a free target
    let reduced = format!("{CONTACTS}coordinates = \"reduced\"\n");
    let (count, shown) = report(&reduced);
    assert!(count == 1 && shown.contains("`post_impact.coordinates` is \"reduced\""), "{shown}");

    // a disc has no outward normal at its COM, for the target's own kind or a case's
    let disc = CONTACTS.replace(&format!("polygon = {OUTLINE}"), "radius = 0.6");
    let at_com = disc.replace(POINTS, "[[0.5, 0.2], [0.0, 0.0]]");
    for (text, line, key) in [
        (at_com.replace("\"rigid\", \"pin\"", "\"rigid\", \"bounce\""), 18, "target[0].contact"),
        (at_com, 25, "case[1].kinds.panel"),
    ] {
        let (count, shown) = report(&text);
        let place = format!("demo.toml:{line}:");
        assert!(count == 1 && shown.contains(&place) && shown.contains(key), "{shown}");
        assert!(shown.contains("no outward normal"), "{shown}");
    }
}

/// Reduced coordinates are those of a robot alone: every target is a part of a link, from one impact on.
#[test]
fn reduced_coordinates_want_targets_that_become_links() {
    let layout = two_arms();
    let head = &CONTACTS[..CONTACTS.find("[contact]").unwrap_or(0)];
    let target = |name: &str, arm: &str, kind: &str| {
        format!("[[target]]\nname = \"{name}\"\narm = {arm}\nkind = {kind}\nmass = 10.0\ninertia = 1.0\nradius = 0.5\n")
    };
    let one = |name: &str, arm: &str, kind: &str| target(name, &format!("\"{arm}\""), &format!("\"{kind}\""));
    let at_time = |text: String| text.replace("radius", "contact = [0.5, 0.0]\nradius");
    let detected = |text: String| {
        "[contact]\ndetection = \"event\"\n".to_owned() + &text.replace("radius", "position = [9.0, 0.0]\nradius")
    };
    let both = || one("a", "left", "rigid") + &one("b", "right", "rigid");
    let of_two_arms = target("a", "[\"left\", \"right\"]", "\"rigid\"")
        .replace("radius", "contact = [[0.5, 0.0], [-0.5, 0.0]]\nradius");
    for (targets, is_fine) in [
        (at_time(one("a", "left", "rigid")), true),
        (detected(one("a", "left", "rigid")), true),
        (at_time(both()), true),
        (detected(both()), false),
        (at_time(one("a", "left", "pin")), false),
        (at_time(one("a", "left", "none")), false),
        (at_time(one("a", "left", "rigid") + &one("b", "right", "pin")), false),
        (of_two_arms, false),
    ] {
        let text = format!("{head}{targets}[post_impact]\nduration = 5.0\ncoordinates = \"reduced\"\n");
        let report = Scenario::parse(&text, "demo.toml", Path::new(""), &[("two_arms", &layout)]).err();
        let shown = report.map(|report| report.to_string()).unwrap_or_default();
        assert_eq!(shown.is_empty(), is_fine, "{targets}{shown}");
        assert!(is_fine || shown.contains("`post_impact.coordinates` is \"reduced\""), "{shown}");
    }
}

/// An arm that may end anywhere has no motion at its end, and in joint space end effectors at rest leave the joints free.
#[test]
fn twists_without_poses_and_before_a_rest_are_refused() {
    let layout = two_arms();
    let head = &CONTACTS[..CONTACTS.find("[contact]").unwrap_or(0)];
    let end = "trajectory = \"cycloidal\"\nfinal_joint_angles = [0.5, 0.6, 0.5, 0.6]";
    assert!(head.contains(end));
    let report = |keys: &str| {
        let text = head.replace(end, keys);
        let report = Scenario::parse(&text, "demo.toml", Path::new(""), &[("two_arms", &layout)]).err();
        report.map(|report| report.to_string()).unwrap_or_default()
    };
    let steered = "tracking = \"resolved_motion_rate\"\nfinal_end_effector_poses = [[1, 1], []]\n";
    assert_eq!(report(&format!("{steered}final_end_effector_twists = [[1, 1], [0, 0]]")), "");
    let shown = report(&format!("{steered}final_end_effector_twists = [[1, 1], [0, 1]]"));
    assert!(
        shown.contains("`approach.final_end_effector_twists[1]` is [0, 1]: this arm has no pose to reach"),
        "{shown}"
    );
    let joints = "trajectory = \"quintic\"\nfinal_joint_angles = [0.5, 0.6, 0.5, 0.6]\ntrajectory_duration = 10\n";
    assert_eq!(report(&format!("{joints}final_joint_rates = [0, 0, 0, 0]")), "");
    let shown = report(&format!("{joints}final_joint_rates = [0, 0.1, 0, 0]"));
    assert!(shown.contains("the arms may move at its end"), "{shown}");
    let shown = report(&format!("{joints}final_end_effector_twists = [[0, 0, 0], [0, 0]]"));
    assert!(
        shown.contains("the arms may move at its end") && shown.contains("`final_joint_rates` of zeros"),
        "{shown}"
    );
}

/// A step may be as long as its phase, and a trajectory too: then it is that of the phase.
#[test]
fn a_phase_may_be_one_step() {
    let text = SCENARIO.replacen("duration = 20.0", "duration = 20.0\nstep = 20.0\ntrajectory_duration = 20.0", 1);
    let approach = scenario(&text).unwrap_or_else(|report| panic!("{report}")).approach;
    assert_eq!((approach.step.to_bits(), approach.trajectory_duration), (20.0_f64.to_bits(), None));
}

/// Where a number has a bound, it is accepted just within and refused just beyond.
#[test]
fn bounds_are_where_they_are_said() {
    const JOINTS: &str = "\"cycloidal\"\nfinal_joint_angles = [0.5, 0.6]\n";
    for (key, [from, to], within, beyond) in [
        ("approach.step", ["20.0\n", "20.0\nstep = V\n"], ["20.0", "2.001e-7"], ["20.001", "1.999e-7"]),
        ("approach.sample_time", [STEERED, "JOINTSsample_time = V"], ["20.0", "0.005"], ["20.005", "0.004"]),
        (
            "approach.trajectory_duration",
            [STEERED, "JOINTStrajectory_duration = V"],
            ["20.0", "1.0"],
            ["20.001", "0.0"],
        ),
        (
            "initial.base_pose",
            ["0.2]\n", "0.2]\nbase_pose = [9, 0, V]\n"],
            ["2.49e9", "-2.49e9"],
            ["2.51e9", "-2.51e9"],
        ),
        ("target[0].position", ["0.5]\nr", "0.5]\nposition = [V, 0]\nr"], ["2.49e9", "-2.49e9"], ["2.51e9", "-2.51e9"]),
        ("target[0].contact", ["[0.0, 0.5]", "[V, 0]"], ["2.49e6", "-2.49e6"], ["2.51e6", "-2.51e6"]),
        ("target[0].radius", ["radius = 0.5", "radius = V"], ["2.49e6", "1e-6"], ["2.51e6", "0.0"]),
        (
            "limits.joint_angles[0]",
            ["[[target]]", "[limits]\njoint_angles = [[0.1, V], []]\n[[target]]"],
            ["0.2", "0.1001"],
            ["0.1", "0.0999"],
        ),
        ("initial.joint_rates", ["0.2]\n", "0.2]\njoint_rates = [0.0, V]\n"], ["0.5", "-0.5"], ["0.501", "-0.501"]),
    ] {
        let limits = if key.contains("rates") { "[limits]\njoint_rates = 0.5\n" } else { "" };
        let (base, to) = (format!("{SCENARIO}{limits}"), to.replace("JOINTS", JOINTS));
        for (values, is_fine) in [(within, true), (beyond, false)] {
            for value in values {
                let text = base.replacen(from, &to.replace('V', value), 1);
                assert_ne!(text, base, "{key}");
                let said = scenario(&text).err().map(|report| report.to_string()).unwrap_or_default();
                assert_eq!(said.is_empty(), is_fine, "{key} {value}: {said}");
                assert!(is_fine || said.contains(&format!("`{key}")), "{key} {value}: {said}");
            }
        }
    }
    // the COM is within the corners, not on their hull
    for (low, is_fine) in [("-0.001", true), ("0.0", false), ("0.001", false)] {
        let polygon = format!("polygon = [[-0.5, {low}], [0.5, {low}], [0.0, 0.8]]");
        let said = scenario(&SCENARIO.replacen("radius = 0.5", &polygon, 1)).err();
        assert_eq!(said.is_none(), is_fine, "{low}");
    }
    // names of cases are those of files
    let said = scenario(&SCENARIO.replacen("\"still\"", "\"SPIN\"", 1)).expect_err("one file").to_string();
    assert!(said.contains("`case[1].name` is \"SPIN\""), "{said}");
}

/// Smooth motion is integrated adaptively; torques that are held or limited give it kinks.
#[test]
fn the_integrator_follows_from_the_torques() {
    let of = |approach: &str, after: &str| {
        let text = SCENARIO.replacen("\"quartic\"", &format!("\"quartic\"\n{approach}"), 1);
        let text = text.replacen("duration = 50.0", &format!("duration = 50.0\n{after}"), 1);
        let scenario = scenario(&text).unwrap_or_else(|e| panic!("{e}"));
        let after = scenario.post_impact.expect("a motion after the impact").integration.integrator;
        [scenario.approach.integration.integrator, after]
    };
    let adaptive = |tolerance: f64| Integrator::Adaptive { tolerance };
    let fixed = Integrator::RungeKutta4;
    assert_eq!(of("", ""), [adaptive(1e-10), adaptive(1e-10)]);
    assert_eq!(of("tolerance = 1e-12", "integrator = \"rk4\""), [adaptive(1e-12), fixed]);
    assert_eq!(of("torque_limits = 3.0", "control = \"hold\"\nsample_time = 0.1"), [fixed, fixed]);
    assert_eq!(of("sample_time = 0.1", "control = \"hold\"\ntorque_limits = 3.0"), [fixed, fixed]);
    assert_eq!(of("", "control = \"stabilise\"\nbase_torque_limit = 1.0"), [adaptive(1e-10), fixed]);
    assert_eq!(of("sample_time = 0.1", "control = \"stabilise\"\nbase_torque_limit = 1.0"), [fixed, fixed]);
    assert_eq!(of("sample_time = 0.1\nintegrator = \"adaptive\"", ""), [adaptive(1e-10), adaptive(1e-10)]);
}

/// A document of another kind than a command reads is named as such, in place of every key that it lacks.
#[test]
fn a_document_of_another_kind_is_named() {
    let [layout, scenario, sweep] = [
        "codegen/layouts/dual_arm_3r.toml",
        "scenarios/spinning_target.toml",
        "scenarios/sweeps/uncertain_capture.toml",
    ]
    .map(|path| file(path).display().to_string());
    for (command, path, out, expected) in [
        ("run", &layout, "never", ["this is a layout", "a scenario that names it"]),
        ("run", &sweep, "never", ["this is a sweep", "the scenario that it names"]),
        ("sweep", &scenario, "never", ["this is a scenario", "a sweep that names it"]),
        ("sweep", &layout, "never", ["this is a layout", "a sweep of a scenario that names it"]),
        ("generate", &scenario, "never.rs", ["this is a scenario", "the layout that it names"]),
        ("generate", &sweep, "never.rs", ["this is a sweep", "the layout that its scenario names"]),
    ] {
        let (code, _, err) = said(&[command, path, "--out", out]);
        assert_eq!(code, 2, "{err}");
        assert!(expected.iter().all(|part| err.contains(part)), "{command} {path}: {err}");
        assert!(err.contains(path) && !err.contains("missing key"), "{err}");
    }
}
