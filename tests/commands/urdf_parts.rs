//! `planar-capture import --subtree LINK --fix JOINT=ANGLE`: the planar part of a robot that moves in space.
//!
//! `urdf_dynamics.py` compares its motion with Pinocchio's, whose model has the same joints locked.

use crate::said;
use planar_capture::urdf::{HeldJoint, ImportOptions, import};
use planar_proof::file;
use std::fs;

fn spatial() -> String {
    fs::read_to_string(file("tests/urdf/spatial.urdf")).expect("a URDF")
}

/// Yaws alike, so that the pitch axes are parallel; rolls and slides at zero.
const HELD: [(&str, f64); 9] = [
    ("neck", 0.0),
    ("left_yaw", 0.3),
    ("left_slide", 0.0),
    ("left_roll", 0.0),
    ("left_wrist_roll", 0.0),
    ("right_yaw", 0.3),
    ("right_slide", 0.0),
    ("right_roll", 0.0),
    ("right_wrist_roll", 0.0),
];

fn options(subtree: Option<&str>, held: &[(&str, f64)]) -> ImportOptions {
    let held = held.iter().map(|&(name, position)| HeldJoint { name: name.to_owned(), position }).collect();
    ImportOptions { subtree: subtree.map(str::to_owned), held, ..ImportOptions::default() }
}

#[test]
fn two_arms_in_space_become_two_in_the_plane() {
    let import = import(&spatial(), &options(Some("torso"), &HELD)).unwrap_or_else(|error| panic!("{error}"));
    let names: Vec<&str> = import.joints.iter().map(|joint| joint.name.as_str()).collect();
    let expected = ["left_pitch", "left_elbow", "left_wrist_pitch", "right_pitch", "right_elbow", "right_wrist_pitch"];
    assert_eq!(names, expected);
    // torso, head, both shoulders and sleds: the carriage is left out, and said to be
    let mass = import.layout.base.mass;
    assert!((mass - (140.0 + 6.0 + 2.0 * (7.0 + 3.0))).abs() < 1e-12, "{mass}");
    let remarks: Vec<String> = import.remarks.iter().map(ToString::to_string).collect();
    assert_eq!(remarks[0], "warning: left out, for only `torso` and what it carries is taken: `carriage` 900.0 kg");
    assert!(remarks.contains(&"note: joint `left_yaw` is fixed at 0.3 rad".to_owned()), "{remarks:#?}");
    assert!(remarks.contains(&"note: joint `left_slide` is fixed at 0.0 m".to_owned()), "{remarks:#?}");
    assert!(import.to_toml("spatial.urdf").contains("# note: joint `left_yaw` is fixed at 0.3 rad\n"));
}

/// Held at an angle, a joint is a fixed one with the rotated origin; a slide with the shifted one.
#[test]
fn a_held_joint_is_a_fixed_one() {
    let text = spatial();
    let mut held = HELD;
    held[1].1 = -0.2;
    held[5].1 = -0.2;
    held[2].1 = 0.25;
    let by_option = import(&text, &options(Some("torso"), &held)).unwrap_or_else(|error| panic!("{error}"));
    let edits = [
        ("<origin xyz=\"0.1 0.35 0.5\" rpy=\"0 0 0\"/>", "<origin xyz=\"0.1 0.35 0.5\" rpy=\"0 0 -0.2\"/>"),
        ("rpy=\"0 0 3.141592653589793\"/>", "rpy=\"0 0 2.941592653589793\"/>"),
    ];
    let edited = edits.iter().fold(text, |text, (from, to)| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text.replace(from, to)
    });
    let slide = edited.find("left_slide").expect("the joint");
    let (before, after) = edited.split_at(slide);
    let edited = before.to_owned() + &after.replacen("xyz=\"0.1 0 0\"", "xyz=\"0.25 0 0.2\"", 1);
    for (_, position) in &mut held {
        *position = 0.0;
    }
    let by_hand = import(&edited, &options(Some("torso"), &held)).unwrap_or_else(|error| panic!("{error}"));
    let numbers = |layout: &planar_capture::layout::Layout| {
        let of_arms = layout.arms.iter().flat_map(|arm| {
            let links =
                arm.links.iter().flat_map(|link| [link.length, link.mass, link.inertia, link.com[0], link.com[1]]);
            arm.mount.into_iter().chain([arm.mount_angle]).chain(links).collect::<Vec<_>>()
        });
        [layout.base.mass, layout.base.inertia].into_iter().chain(of_arms).collect::<Vec<f64>>()
    };
    let (found, expected) = (numbers(&by_option.layout), numbers(&by_hand.layout));
    planar_proof::assert_close("layout", &found, &expected, planar_proof::tolerance::URDF);
}

#[test]
fn outside_its_limits_a_held_joint_is_a_warning() {
    let mut held = HELD;
    held[2].1 = 0.4;
    let import = import(&spatial(), &options(Some("torso"), &held)).unwrap_or_else(|error| panic!("{error}"));
    let remarks: Vec<String> = import.remarks.iter().map(ToString::to_string).collect();
    let expected = "warning: joint `left_slide` is fixed at 0.4 m, outside its limits [0.0, 0.3] m".to_owned();
    assert!(remarks.contains(&expected), "{remarks:#?}");
}

#[test]
fn a_joint_that_follows_another_can_be_held() {
    let text = spatial().replace(
        "<parent link=\"torso\"/><child link=\"head\"/>",
        "<parent link=\"torso\"/><child link=\"head\"/><mimic joint=\"left_yaw\"/>",
    );
    import(&text, &options(Some("torso"), &HELD)).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn parts_that_are_none_are_refused() {
    let refused = |subtree, held: &[(&str, f64)], expected: &[&str]| {
        let error = import(&spatial(), &options(subtree, held)).expect_err("a refusal").to_string();
        assert!(expected.iter().all(|part| error.contains(part)), "{error}");
    };
    refused(Some("torsi"), &HELD, &["link `torsi`: there is no such link in this file"]);
    refused(Some("torso"), &[("nek", 0.0)], &["joint `nek`: there is no such joint in the subtree of `torso`"]);
    refused(Some("torso"), &[("rail", 0.0)], &["`rail`", "no such joint in the subtree of `torso`"]);
    refused(None, &[("rail", 0.0), ("nek", 0.0)], &["joint `nek`: there is no such joint in this file"]);
    refused(None, &[("neck", 0.0), ("neck", 0.1)], &["joint `neck`: it is fixed twice"]);
    refused(None, &[("left_tool", 0.0)], &["line ", "joint `left_tool`: it is fixed; only revolute"]);
    refused(None, &[("neck", 90.0)], &["joint `neck`: it is fixed at 90.0", "rad between -2π and 2π", "degrees?"]);
    refused(None, &[("neck", f64::NAN)], &["joint `neck`: its position is NaN"]);
    // what is left over says what to do about it; the neck, first of the joints, gives the plane
    refused(
        Some("torso"),
        &HELD[1..],
        &["joint `left_pitch`: its axis", "off the normal", "`--fix JOINT=ANGLE`", "`--subtree LINK`"],
    );
    refused(Some("torso"), &HELD[..2], &["joint `left_slide`: it is prismatic", "`--fix JOINT=POSITION`"]);
}

#[test]
fn the_command_has_both_options() {
    let path = file("tests/urdf/spatial.urdf").display().to_string();
    let held: Vec<String> = HELD.iter().map(|(name, position)| format!("--fix={name}={position}")).collect();
    let mut arguments = vec!["import", path.as_str(), "--subtree", "torso"];
    arguments.extend(held.iter().map(String::as_str));
    let (code, layout, notes) = said(&arguments);
    assert_eq!(code, 0, "{notes}");
    assert!(layout.contains("name = \"torso_robot\"") && notes.contains("`carriage` 900.0 kg"), "{notes}");
    for (wrong, expected) in [("neck", "expected JOINT=ANGLE"), ("neck=left", "`left` is no number, expected rad")] {
        let (code, layout, error) = said(&["import", &path, "--fix", wrong]);
        assert_eq!((code, layout.as_str()), (2, ""));
        assert!(error.contains(expected), "{error}");
    }
}
