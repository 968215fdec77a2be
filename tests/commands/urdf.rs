//! URDF files: import to layouts, refusals and their messages, and round trips of export and import.
//!
//! `urdf_dynamics.py` compares their motion in other simulators.

use crate::said;
use planar_capture::diagnostic::is_hidden;
use planar_capture::layout::{Arm, Base, Layout, Link};
use planar_capture::outline::Outline;
use planar_capture::registry;
use planar_capture::urdf::{HeldJoint, ImportOptions, ImportedJoint, ImportedLayout, export, import};
use planar_proof::{assert_close, file, sample, tolerance};
use proptest::collection::vec;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fs;
use tempfile::TempDir;

/// A robot on a base of 100 kg and 20 kg m², with these parts.
fn robot(parts: &str) -> String {
    format!("<?xml version=\"1.0\"?>\n<robot name=\"bot\">\n{}{parts}</robot>", link("base", 100.0, "0 0 0", [20.0; 3]))
}

fn link(name: &str, mass: f64, com: &str, [ixx, iyy, izz]: [f64; 3]) -> String {
    format!(
        "<link name=\"{name}\"><inertial><origin xyz=\"{com}\"/><mass value=\"{mass}\"/><inertia ixx=\"{ixx}\" \
         iyy=\"{iyy}\" izz=\"{izz}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n"
    )
}

fn joint(kind: &str, name: &str, [parent, child]: [&str; 2], origin: &str, more: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/><origin {origin}/>\
         {more}</joint>\n"
    )
}

const UP: &str = "<axis xyz=\"0 0 1\"/>";

/// An arm of two links along x, each 1 m, 10 kg, 1 kg m², COM in the middle, with a tip.
fn arm() -> String {
    [
        joint("continuous", "shoulder", ["base", "upper"], "xyz=\"0.5 0 0\"", UP),
        link("upper", 10.0, "0.5 0 0", [1.0; 3]),
        joint("continuous", "elbow", ["upper", "lower"], "xyz=\"1 0 0\"", UP),
        link("lower", 10.0, "0.5 0 0", [1.0; 3]),
        joint("fixed", "end", ["lower", "tip"], "xyz=\"1 0 0\"", ""),
        "<link name=\"tip\"/>\n".to_owned(),
    ]
    .concat()
}

/// The arm with one piece of its text replaced.
fn changed(from: &str, to: &str) -> String {
    let text = robot(&arm());
    assert_eq!(text.matches(from).count(), 1, "`{from}` in\n{text}");
    text.replace(from, to)
}

fn options(end_effectors: &[&str]) -> ImportOptions {
    ImportOptions {
        end_effectors: end_effectors.iter().map(|&name| name.to_owned()).collect(),
        ..ImportOptions::default()
    }
}

fn imported(text: &str) -> ImportedLayout {
    imported_with(text, &[])
}

fn imported_with(text: &str, end_effectors: &[&str]) -> ImportedLayout {
    let options = options(end_effectors);
    let import = import(text, &options).unwrap_or_else(|problem| panic!("{problem}\n{text}"));
    let read = Layout::parse(&import.to_toml("robot.urdf"), "layout.toml").unwrap_or_else(|report| panic!("{report}"));
    assert_eq!(read, import.layout, "the file is the layout");
    import
}

fn remarks(import: &ImportedLayout) -> String {
    import.remarks.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// [length, mass, inertia, com x, com y] of each link of an arm.
#[track_caller]
fn assert_links(import: &ImportedLayout, arm: usize, expected: &[[f64; 5]]) {
    let numbers = |l: &Link| [l.length, l.mass, l.inertia, l.com[0], l.com[1]];
    let found: Vec<[f64; 5]> = import.layout.arms[arm].links.iter().map(numbers).collect();
    assert_close("links", found.as_flattened(), expected.as_flattened(), tolerance::URDF);
}

/// [sign, offset] of each joint.
#[track_caller]
fn assert_angles(import: &ImportedLayout, expected: &[[f64; 2]]) {
    let found: Vec<[f64; 2]> = import.joints.iter().map(|joint| [joint.sign, joint.offset]).collect();
    assert_close("angles", found.as_flattened(), expected.as_flattened(), tolerance::URDF);
}

#[test]
fn an_arm_in_the_plane_is_taken_as_it_is() {
    let import = imported(&robot(&arm()));
    let link = || Link { length: 1.0, mass: 10.0, inertia: 1.0, com: [0.5, 0.0], outline: None };
    let arm = Arm { name: "shoulder".to_owned(), mount: [0.5, 0.0], mount_angle: 0.0, links: vec![link(), link()] };
    let base = Base { mass: 100.0, inertia: 20.0, outline: None };
    assert_eq!(import.layout, Layout { name: "bot".to_owned(), base, arms: vec![arm] });
    assert_angles(&import, &[[1.0, 0.0]; 2]);
    let header = import.to_toml("robot.urdf");
    for line in ["normal [0.0, 0.0, 1.0], x axis [1.0, 0.0, 0.0].", "arm `shoulder`, tip = `tip`"] {
        assert!(header.lines().any(|found| found.starts_with('#') && found.ends_with(line)), "no `{line}` in {header}");
    }
    assert!(import.joints.iter().all(ImportedJoint::is_same_angle));
    assert_eq!((import.end_effectors, import.remarks), (vec![Some("tip".to_owned())], vec![]));
}

/// About y, plane x is x and plane y is −z; the second link points along −z, a quarter of a turn from the first.
#[test]
fn axes_along_y_give_the_plane_of_x_and_z() {
    let along_y = "<axis xyz=\"0 1 0\"/>";
    let parts = [
        joint("revolute", "a", ["base", "one"], "xyz=\"0.5 0.25 0.2\"", along_y),
        link("one", 3.0, "0.3 0 0.1", [0.1, 0.2, 0.3]),
        joint("revolute", "b", ["one", "two"], "xyz=\"0.6 0 0\"", along_y),
        link("two", 2.0, "0.05 0 -0.2", [0.4, 0.5, 0.6]),
        joint("fixed", "c", ["two", "tip"], "xyz=\"0 0.1 -0.4\"", ""),
        "<link name=\"tip\"/>".to_owned(),
    ];
    let import = imported(&robot(&parts.concat()));
    assert_eq!((import.normal, import.x_axis), ([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]));
    assert_close("mount", &import.layout.arms[0].mount, &[0.5, -0.2], tolerance::URDF);
    assert_links(&import, 0, &[[0.6, 3.0, 0.2, 0.3, -0.1], [0.4, 2.0, 0.5, 0.2, -0.05]]);
    assert_angles(&import, &[[1.0, 0.0], [1.0, FRAC_PI_2]]);
}

#[test]
fn a_normal_along_x_takes_y_for_the_planes_x_axis() {
    let parts = [
        joint("continuous", "a", ["base", "one"], "xyz=\"0 0.5 0.25\"", "<axis xyz=\"1 0 0\"/>"),
        link("one", 3.0, "0 0 0.5", [1.0, 2.0, 3.0]),
        joint("fixed", "b", ["one", "tip"], "xyz=\"0 0 1\"", ""),
        "<link name=\"tip\"/>".to_owned(),
    ];
    let import = imported(&robot(&parts.concat()));
    assert_eq!((import.normal, import.x_axis), ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
    assert_close("mount", &import.layout.arms[0].mount, &[0.5, 0.25], tolerance::URDF);
    assert_close("mount angle", &[import.layout.arms[0].mount_angle], &[FRAC_PI_2], tolerance::URDF);
    assert_links(&import, 0, &[[1.0, 3.0, 1.0, 0.5, 0.0]]);
}

/// A normal n that is neither along x nor across it: the plane's x axis is x − n (n · x), normalized.
#[test]
fn an_oblique_normal_projects_the_x_axis() {
    let parts = [
        joint("continuous", "a", ["base", "one"], "xyz=\"0.4 0.5 -0.3\"", "<axis xyz=\"0.6 0 0.8\"/>"),
        link("one", 3.0, "0 0.5 0", [1.0; 3]),
        joint("fixed", "b", ["one", "tip"], "xyz=\"0 1 0\"", ""),
        "<link name=\"tip\"/>".to_owned(),
    ];
    let import = imported(&robot(&parts.concat()));
    assert_close("normal", &import.normal, &[0.6, 0.0, 0.8], tolerance::URDF);
    assert_close("x axis", &import.x_axis, &[0.8, 0.0, -0.6], tolerance::URDF);
    assert_close("mount", &import.layout.arms[0].mount, &[0.5, 0.5], tolerance::URDF);
    assert_close("mount angle", &[import.layout.arms[0].mount_angle], &[FRAC_PI_2], tolerance::URDF);
    assert_links(&import, 0, &[[1.0, 3.0, 1.0, 0.5, 0.0]]);
}

/// Only what rounding leaves of an exact zero becomes one.
#[test]
fn a_small_offset_is_kept() {
    let offset = 1e-5;
    let import = imported(&changed(
        "<link name=\"lower\"><inertial><origin xyz=\"0.5 0 0\"/>",
        &format!("<link name=\"lower\"><inertial><origin xyz=\"0.5 {offset:e} 0\"/>"),
    ));
    assert_close("COM", &import.layout.arms[0].links[1].com, &[0.5, offset], tolerance::URDF);
    let import = imported(&changed(
        "<origin xyz=\"0.5 0 0\"/><axis",
        &format!("<origin xyz=\"0.5 {offset:e} 0\" rpy=\"0 0 {offset:e}\"/><axis"),
    ));
    assert_close("mount", &import.layout.arms[0].mount, &[0.5, offset], tolerance::URDF);
    assert_close("mount angle", &[import.layout.arms[0].mount_angle], &[offset], tolerance::URDF);
}

#[test]
fn an_axis_the_other_way_changes_the_sign_of_its_joint_alone() {
    let from = "<origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/>";
    let import = imported(&changed(from, "<origin xyz=\"1 0 0\"/><axis xyz=\"0 0 -2\"/>"));
    assert_angles(&import, &[[1.0, 0.0], [-1.0, 0.0]]);
    assert_eq!(import.layout, imported(&robot(&arm())).layout);
    assert_eq!(import.joints[1].to_string(), "arm `shoulder`, joint 2 = -`elbow`");
    assert_eq!(import.joints.iter().map(ImportedJoint::is_same_angle).collect::<Vec<_>>(), [true, false]);
}

/// The frame of the lower arm is rotated; the layout has an offset of the joint's zero instead.
#[test]
fn rotated_frames_are_offsets_and_mount_angles() {
    let from = "<child link=\"lower\"/><origin xyz=\"1 0 0\"/>";
    let import = imported(&changed(from, "<child link=\"lower\"/><origin xyz=\"1 0 0\" rpy=\"0 0 0.5\"/>"));
    assert_angles(&import, &[[1.0, 0.0], [1.0, 0.5]]);
    assert_eq!(import.joints[1].to_string(), "arm `shoulder`, joint 2 = `elbow` + 0.5 rad");
    assert!(!import.joints[1].is_same_angle());
    let import =
        imported(&changed("<origin xyz=\"0.5 0 0\"/><axis", "<origin xyz=\"0.5 0 0\" rpy=\"0 0 -2.5\"/><axis"));
    assert_close("mount angle", &[import.layout.arms[0].mount_angle], &[-2.5], tolerance::URDF);
    assert_angles(&import, &[[1.0, 0.0]; 2]);
    let import = imported(&changed(from, "<child link=\"lower\"/><origin xyz=\"1 0 0\" rpy=\"0 0 -0.5\"/>"));
    assert_eq!(import.joints[1].to_string(), "arm `shoulder`, joint 2 = `elbow` - 0.5 rad");
    // the upper link points 2.5 rad away from its frame, the lower frame -2 rad: -4.5 rad are 2 pi - 4.5
    for side in [1.0, -1.0] {
        let (sine, cosine) = (side * 2.5_f64).sin_cos();
        let rpy = -2.0 * side;
        let bent = format!("<child link=\"lower\"/><origin xyz=\"{cosine:?} {sine:?} 0\" rpy=\"0 0 {rpy:?}\"/>");
        let import = imported(&changed(from, &bent));
        assert_close("mount angle", &[import.layout.arms[0].mount_angle], &[2.5 * side], tolerance::URDF);
        assert_angles(&import, &[[1.0, 0.0], [1.0, side * (TAU - 4.5)]]);
        assert_links(&import, 0, &[[1.0, 10.0, 1.0, 0.5 * cosine, -0.5 * sine], [1.0, 10.0, 1.0, 0.5, 0.0]]);
    }
    // backwards: exact zeros where sines of pi would be
    let import = imported(&changed(from, "<child link=\"lower\"/><origin xyz=\"-1 0 0\"/>"));
    assert_eq!(import.layout.arms[0].links[0].com.map(f64::to_bits), [-0.5, 0.0_f64].map(f64::to_bits));
    // half a turn about x turns the axis round, but not the link
    let flipped =
        changed("<origin xyz=\"0.5 0 0\"/><axis", &format!("<origin xyz=\"0.5 0 0\" rpy=\"{PI:?} 0 0\"/><axis"));
    let import = imported(&flipped);
    assert_angles(&import, &[[-1.0, 0.0]; 2]);
    assert_eq!(import.layout, imported(&robot(&arm())).layout, "with exact zeros where sines of π would be");
}

/// 2 kg at 0.5 m and 1 kg at 1 m: COM at 2/3 m. The tool lies on its side: its iyy is about the normal.
/// Of a joint whose frame is turned about x, and whose axis is its y: what comes after it has its place in that frame, (1, 0, −0.2),
/// which is (1, 0.2) in the plane.
#[test]
fn places_are_in_the_frame_of_the_joint_before() {
    let parts = [
        joint(
            "continuous",
            "a",
            ["base", "one"],
            &format!("xyz=\"0.5 0 0\" rpy=\"{FRAC_PI_2} 0 0\""),
            "<axis xyz=\"0 1 0\"/>",
        ),
        link("one", 3.0, "0.5 0 -0.1", [0.1, 0.2, 0.3]),
        joint("continuous", "b", ["one", "two"], &format!("xyz=\"1 0 -0.2\" rpy=\"{} 0 0\"", -FRAC_PI_2), UP),
        link("two", 2.0, "0.25 0 0", [0.4, 0.5, 0.6]),
        joint("fixed", "c", ["two", "tip"], "xyz=\"0.5 0 0\"", ""),
        "<link name=\"tip\"/>".to_owned(),
    ];
    let import = imported(&robot(&parts.concat()));
    assert_close("mount", &import.layout.arms[0].mount, &[0.5, 0.0], tolerance::URDF);
    let lengths: Vec<f64> = import.layout.arms[0].links.iter().map(|link| link.length).collect();
    assert_close("lengths", &lengths, &[1.04_f64.sqrt(), 0.5], tolerance::URDF);
    // the first link's COM is half way to the second joint
    assert_close("com", &import.layout.arms[0].links[0].com, &[0.5 * 1.04_f64.sqrt(), 0.0], tolerance::URDF);
}

#[test]
fn what_is_fixed_is_lumped() {
    let tool = "<link name=\"tool\"><inertial><mass value=\"1\"/><inertia ixx=\"0.06\" iyy=\"0.05\" izz=\"0.07\" \
                ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>";
    let parts = [
        joint("revolute", "a", ["base", "one"], "xyz=\"0 0.3 0\"", UP),
        link("one", 2.0, "0.5 0 0", [0.1; 3]),
        joint("fixed", "bolts", ["one", "tool"], &format!("xyz=\"1 0 0\" rpy=\"{FRAC_PI_2:?} 0 0\""), ""),
        tool.to_owned(),
    ];
    let import = imported(&robot(&parts.concat()));
    assert_links(&import, 0, &[[1.0, 3.0, 0.1 + 0.05 + 2.0 / 36.0 + 1.0 / 9.0, 2.0 / 3.0, 0.0]]);
    assert_eq!(
        import.end_effectors,
        [Some("tool".to_owned())],
        "the only leaf is the end effector, whatever it weighs"
    );
    assert_eq!(import.joints[0].links, ["one", "tool"]);
}

#[test]
fn the_base_frame_moves_to_the_centre_of_mass() {
    let box_on_it =
        [joint("fixed", "bolts", ["base", "box"], "xyz=\"0 2 0\"", ""), link("box", 25.0, "1 0 0", [1.0, 2.0, 3.0])];
    let import = imported(&robot(&(arm() + &box_on_it.concat())));
    // 100 kg at the origin, 25 kg at [1, 2]
    assert_close("mount", &import.layout.arms[0].mount, &[0.3, -0.4], tolerance::URDF);
    let inertia = 20.0 + 3.0 + 100.0 * (0.04 + 0.16) + 25.0 * (0.64 + 2.56);
    let base = &import.layout.base;
    assert_close("base", &[base.mass, base.inertia], &[125.0, inertia], 100.0 * tolerance::URDF);
    // heights along the normal change no moment of inertia about it
    let text = robot(&(arm() + &box_on_it.concat())).replace("xyz=\"0 2 0\"", "xyz=\"0 2 0.5\"");
    let apart = imported(&text.replace("<origin xyz=\"0 0 0\"/><mass", "<origin xyz=\"0 0 -0.125\"/><mass"));
    let base = &apart.layout.base;
    assert_close("base", &[base.mass, base.inertia], &[125.0, inertia], 100.0 * tolerance::URDF);
}

#[test]
fn what_would_leave_the_plane_is_named_with_its_numbers() {
    let lifted = imported(&changed(
        "<link name=\"lower\"><inertial><origin xyz=\"0.5 0 0\"/>",
        "<link name=\"lower\"><inertial><origin xyz=\"0.5 0 0.125\"/>",
    ));
    let text = remarks(&lifted);
    assert!(text.starts_with("warning: the robot would leave the plane") && text.contains("`lower` 0.125 m"), "{text}");
    let step = imported(&changed("<origin xyz=\"1 0 0\"/><axis", "<origin xyz=\"1 0 0.25\"/><axis"));
    assert!(remarks(&step).contains("`upper` 0.0 m, `lower` 0.25 m"), "{}", remarks(&step));
    let text = changed("<origin xyz=\"1 0 0\"/><axis", "<origin xyz=\"1 0 0.25\"/><axis");
    let third = joint("continuous", "wrist", ["lower", "hand"], "xyz=\"1 0 0.5\"", UP)
        + &link("hand", 1.0, "0.1 0 0", [1.0; 3]);
    let steps = imported(&text.replace("</robot>", &(third + "</robot>")));
    assert!(remarks(&steps).contains("`lower` 0.25 m, `hand` 0.75 m"), "{}", remarks(&steps));
    // all at one height is a plane as well
    let text = robot(&arm()).replace("<origin xyz=\"0.5 0 0\"/><mass", "<origin xyz=\"0.5 0 0.125\"/><mass");
    let raised = text.replace("<origin xyz=\"0 0 0\"/><mass", "<origin xyz=\"0 0 0.125\"/><mass");
    assert_eq!(imported(&raised).remarks, []);
    let from = "<mass value=\"100\"/><inertia ixx=\"20\" iyy=\"20\" izz=\"20\" ixy=\"0\" ixz=\"0\"";
    let skewed = imported(&changed(from, &from.replace("ixz=\"0\"", "ixz=\"0.75\"")));
    let text = remarks(&skewed);
    assert!(text.contains("products of inertia") && text.contains("`base` [0.75, 0.0] kg m²"), "{text}");
    let from = "izz=\"20\" ixy=\"0\" ixz=\"0\" iyz=\"0\"";
    let skewed = imported(&changed(from, &from.replace("iyz=\"0\"", "iyz=\"0.75\"")));
    assert!(remarks(&skewed).contains("`base` [0.0, 0.75] kg m²"), "{}", remarks(&skewed));
    let from = "<mass value=\"100\"/><inertia ixx=\"20\" iyy=\"20\" izz=\"20\" ixy=\"0\" ixz=\"0\"";
    // 7.5e-10 of the moment of inertia, 20 kg m², is rounding
    assert_eq!(remarks(&imported(&changed(from, &from.replace("ixz=\"0\"", "ixz=\"1.5e-8\"")))), "");
    let nearly =
        imported(&changed("<origin xyz=\"1 0 0\"/><axis", "<origin xyz=\"1 0 0\" rpy=\"0.000003 0 0\"/><axis"));
    assert!(remarks(&nearly).contains("`elbow` 3.0e-6 rad"), "{}", remarks(&nearly));
}

/// Principal moments whose axes are turned by all three angles: of R = Rz(yaw) Ry(pitch) Rx(roll) the last row squared weights
/// them, 0.302339 kg m² by hand.
#[test]
fn inertias_are_turned_with_their_origin() {
    let [roll, pitch, yaw] = [0.5_f64, 0.4, 0.3];
    let moments = [0.1, 0.3, 0.35];
    let text = changed(&link("upper", 10.0, "0.5 0 0", [1.0; 3]), &link("upper", 10.0, "0.5 0 0", moments));
    let turned = text.replacen(
        "xyz=\"0.5 0 0\"/><mass value=\"10\"/><inertia ixx=\"0.1\"",
        &format!("xyz=\"0.5 0 0\" rpy=\"{roll} {pitch} {yaw}\"/><mass value=\"10\"/><inertia ixx=\"0.1\""),
        1,
    );
    assert_ne!(text, turned);
    let row = [-pitch.sin(), pitch.cos() * roll.sin(), pitch.cos() * roll.cos()];
    let expected: f64 = row.iter().zip(moments).map(|(part, moment)| part * part * moment).sum();
    assert!((expected - 0.302_339).abs() < 1e-6, "{expected}");
    assert_links(&imported(&turned), 0, &[[1.0, 10.0, expected, 0.5, 0.0], [1.0, 10.0, 1.0, 0.5, 0.0]]);
}

/// With products of inertia the moment about the normal is r I rᵀ, r the last row of the rotation; a quaternion of the same
/// rotation gives the same.
#[test]
fn products_of_inertia_are_turned_with_their_origin() {
    let [roll, pitch, yaw] = [0.5_f64, 0.4, 0.3];
    let ([xx, yy, zz], [xy, xz, yz]) = ([0.3, 0.32, 0.35], [0.04, -0.03, 0.02]);
    let plain = link("upper", 10.0, "0.5 0 0", [xx, yy, zz]);
    let products = plain.replace("ixy=\"0\" ixz=\"0\" iyz=\"0\"", &format!("ixy=\"{xy}\" ixz=\"{xz}\" iyz=\"{yz}\""));
    assert_ne!(plain, products);
    let row = [-pitch.sin(), pitch.cos() * roll.sin(), pitch.cos() * roll.cos()];
    let [x, y, z] = row;
    let of_products = 2.0 * (x * y * xy + x * z * xz + y * z * yz);
    let expected = x * x * xx + y * y * yy + z * z * zz + of_products;
    assert!(of_products.abs() > 0.01, "{of_products}");
    // the product of half turns about z, y and x
    let [[sr, cr], [sp, cp], [sy, cy]] = [roll, pitch, yaw].map(|angle| [(0.5 * angle).sin(), (0.5 * angle).cos()]);
    let quaternion = [
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    ];
    let quaternion = quaternion.map(|part| format!("{part:?}")).join(" ");
    for (version, rotation) in
        [("1.0", format!("rpy=\"{roll} {pitch} {yaw}\"")), ("1.1", format!("quat_xyzw=\"{quaternion}\""))]
    {
        let turned = products.replace("<origin xyz=\"0.5 0 0\"/>", &format!("<origin xyz=\"0.5 0 0\" {rotation}/>"));
        let text = changed(&link("upper", 10.0, "0.5 0 0", [1.0; 3]), &turned);
        let import =
            imported(&text.replace("<robot name=\"bot\">", &format!("<robot name=\"bot\" version=\"{version}\">")));
        assert_links(&import, 0, &[[1.0, 10.0, expected, 0.5, 0.0], [1.0, 10.0, 1.0, 0.5, 0.0]]);
    }
}

/// A rotor that is given by its inertia alone adds that to the link which it is fixed to, wherever it sits.
#[test]
fn an_inertia_without_a_mass_is_added() {
    let rotor = joint("fixed", "bearing", ["upper", "rotor"], "xyz=\"0.2 0.1 0\"", "")
        + &link("rotor", 0.0, "0 0 0", [0.25; 3]);
    let import = imported(&robot(&(arm() + &rotor)));
    assert_links(&import, 0, &[[1.0, 10.0, 1.25, 0.5, 0.0], [1.0, 10.0, 1.0, 0.5, 0.0]]);
}

/// Rounding of a rotated frame leaves no part of a mount: an exact zero selects generated code.
#[test]
fn a_mount_on_a_turned_frame_has_exact_zeros() {
    let turned = joint("fixed", "bolts", ["base", "bracket"], &format!("xyz=\"0 0 0\" rpy=\"0 0 {FRAC_PI_2:?}\""), "");
    let text = changed("<parent link=\"base\"/>", "<parent link=\"bracket\"/>");
    let import = imported(&text.replace("</robot>", &(turned + "<link name=\"bracket\"/></robot>")));
    assert_eq!(import.layout.arms[0].mount.map(f64::to_bits), [0.0, 0.5_f64].map(f64::to_bits));
    // 25 kg at 1.5 m move the centre of mass of 125 kg by 0.3 m, up to the mount but for its last digit
    let ballast =
        joint("fixed", "bolts", ["base", "ballast"], "xyz=\"1.5 0 0\"", "") + &link("ballast", 25.0, "0 0 0", [1.0; 3]);
    let text = changed("<origin xyz=\"0.5 0 0\"/><axis", "<origin xyz=\"0.30000000000000004 0.5 0\"/><axis");
    let import = imported(&text.replace("</robot>", &(ballast + "</robot>")));
    assert_eq!(import.layout.arms[0].mount.map(f64::to_bits), [0.0, 0.5_f64].map(f64::to_bits));
}

/// Arms are in the order of their first joints in the file, whatever these are mounted on.
#[test]
fn arms_are_in_the_order_of_the_file() {
    let wheel = [
        joint("continuous", "wheel", ["box", "disc"], "xyz=\"0 0 0\"", UP),
        link("disc", 1.0, "0 0 0", [1.0; 3]),
        joint("fixed", "bolts", ["base", "box"], "xyz=\"0 0 0\"", ""),
        "<link name=\"box\"/>".to_owned(),
    ];
    let names = |text: &str| imported(text).layout.arms.into_iter().map(|arm| arm.name).collect::<Vec<_>>();
    assert_eq!(names(&robot(&(wheel.concat() + &arm()))), ["wheel", "shoulder"]);
    assert_eq!(names(&robot(&(arm() + &wheel.concat()))), ["shoulder", "wheel"]);
}

#[test]
fn end_effectors_are_found_named_or_estimated() {
    let second = joint("fixed", "end2", ["lower", "tip2"], "xyz=\"0 2 0\"", "") + "<link name=\"tip2\"/>";
    let two = robot(&(arm() + &second));
    let import = imported(&two);
    assert_eq!(import.end_effectors, [Some("tip".to_owned())]);
    assert!(remarks(&import).contains("`tip` and `tip2`"), "{}", remarks(&import));
    let import = imported_with(&two, &["tip2"]);
    assert_eq!((import.end_effectors.clone(), import.remarks.len()), (vec![Some("tip2".to_owned())], 0));
    assert_links(&import, 0, &[[1.0, 10.0, 1.0, 0.5, 0.0], [2.0, 10.0, 1.0, 0.0, -0.5]]);
    assert_angles(&import, &[[1.0, 0.0], [1.0, FRAC_PI_2]]);

    let without = robot(
        &arm()
            .replace(&joint("fixed", "end", ["lower", "tip"], "xyz=\"1 0 0\"", ""), "")
            .replace("<link name=\"tip\"/>\n", ""),
    );
    let import = imported(&without.replace(
        "<link name=\"lower\"><inertial><origin xyz=\"0.5 0 0\"/>",
        "<link name=\"lower\"><inertial><origin xyz=\"0 0.3 0\"/>",
    ));
    assert_links(&import, 0, &[[1.0, 10.0, 1.0, 0.5, 0.0], [0.6, 10.0, 1.0, 0.3, 0.0]]);
    assert!(
        remarks(&import).contains("no frame for its end effector") && remarks(&import).contains("--tip"),
        "{}",
        remarks(&import)
    );
    let wheel = without.replace(
        "<link name=\"lower\"><inertial><origin xyz=\"0.5 0 0\"/>",
        "<link name=\"lower\"><inertial><origin xyz=\"0 0 0\"/>",
    );
    assert_links(&imported(&wheel), 0, &[[1.0, 10.0, 1.0, 0.5, 0.0], [0.0, 10.0, 1.0, 0.0, 0.0]]);
    let import = imported_with(&wheel, &["lower"]);
    assert_eq!((import.layout.arms[0].links[1].length, import.remarks.len()), (0.0, 0));
}

#[test]
fn the_world_is_no_base() {
    for kind in ["fixed", "floating", "planar"] {
        let world = joint(kind, "anchor", ["world", "base"], "xyz=\"7 8 9\" rpy=\"1 2 3\"", "");
        let import = imported(&robot(&(arm() + "<link name=\"world\"/>" + &world)));
        assert_eq!(import.layout, imported(&robot(&arm())).layout, "{kind}");
        assert_eq!(remarks(&import).contains("floats freely"), kind == "fixed");
        // a frame between both
        let world = joint("fixed", "anchor", ["world", "ground"], "xyz=\"7 8 9\"", "")
            + &joint(kind, "float", ["ground", "base"], "xyz=\"1 2 3\" rpy=\"3 2 1\"", "");
        let import = imported(&robot(&(arm() + "<link name=\"world\"/><link name=\"ground\"/>" + &world)));
        assert_eq!(
            (import.layout, &*import.base),
            (imported(&robot(&arm())).layout, &["base".to_owned()][..]),
            "{kind}"
        );
    }
}

/// From version 1.2 on one limit of an angle may be without the other; a continuous joint has none, whatever is written.
#[test]
fn limits_of_angles_are_those_of_revolute_joints() {
    let limited = |kind: &str, version: &str, limit: &str| {
        let text = robot(&arm()).replacen(UP, &format!("{UP}<limit {limit}/>"), 1).replacen("continuous", kind, 1);
        remarks(&imported(
            &text.replace("<robot name=\"bot\">", &format!("<robot name=\"bot\" version=\"{version}\">")),
        ))
    };
    let omitted = "limits of joints are omitted: `shoulder`";
    for (limit, range) in
        [("lower=\"-1\"", "[-1.0, inf]"), ("upper=\"2\"", "[-inf, 2.0]"), ("lower=\"-1\" upper=\"2\"", "[-1.0, 2.0]")]
    {
        let found = limited("revolute", "1.2", limit);
        assert!(found.contains(&format!("{omitted} angle {range} rad")), "{limit}: {found}");
        assert_eq!(limited("continuous", "1.2", limit), "", "{limit}");
    }
    let found = limited("continuous", "1.0", "lower=\"-1\" upper=\"2\" effort=\"30\" velocity=\"4\"");
    assert!(found.contains(&format!("{omitted} rate 4.0 rad/s, torque 30.0 N m")), "{found}");
    // limits of 0, which are those that are not given, do not bound a continuous joint that is held
    let text = robot(&arm()).replacen(UP, &format!("{UP}<limit effort=\"30\" velocity=\"4\"/>"), 1);
    let held = vec![HeldJoint { name: "shoulder".to_owned(), position: 0.5 }];
    let import = import(&text, &ImportOptions { held, ..ImportOptions::default() }).expect("a layout");
    assert!(remarks(&import).contains("note: joint `shoulder` is fixed at 0.5 rad"), "{}", remarks(&import));
    assert!(!remarks(&import).contains("outside its limits"), "{}", remarks(&import));
}

#[test]
fn friction_alone_is_a_loss() {
    let text = robot(&arm()).replacen(UP, &format!("{UP}<dynamics friction=\"0.5\"/>"), 1);
    let expected = "warning: losses of joints are omitted: `shoulder` damping 0.0 N m s/rad, friction 0.5 N m";
    assert_eq!(remarks(&imported(&text)), expected);
}

#[test]
fn losses_limits_and_missing_axes_are_reported() {
    let more = "<axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"2\" effort=\"30\" velocity=\"0\"/>\
                <dynamics damping=\"0.25\" friction=\"0\"/>";
    let text = robot(&arm()).replacen("<axis xyz=\"0 0 1\"/>", more, 1).replacen("continuous", "revolute", 1);
    let text = remarks(&imported(&text));
    assert!(text.contains("warning: losses of joints are omitted: `shoulder` damping 0.25"), "{text}");
    assert!(text.contains("`shoulder` angle [-1.0, 2.0] rad, torque 30.0 N m"), "{text}");
    let axes = robot(&arm())
        .replacen("<axis xyz=\"0 0 1\"/>", "", 1)
        .replace("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"1 0 0\"/>");
    let import = imported(&axes);
    assert_eq!((import.normal, import.x_axis), ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
    assert!(remarks(&import).contains("no <axis>; URDF's default is x: `shoulder`"), "{}", remarks(&import));
}

#[test]
fn names_become_valid_names() {
    let named =
        |name: &str| import(&robot(&arm()).replace("\"bot\"", &format!("\"{name}\"")), &ImportOptions::default());
    for (robot, layout) in
        [("Big-Arm 2.0", "big_arm_2_0"), ("2r", "robot_2r"), ("loop", "loop_robot"), ("a&amp;b", "a_b")]
    {
        assert_eq!(named(robot).expect(robot).layout.name, layout);
    }
    // a name of 64 letters is the longest one
    assert_eq!(named(&"x".repeat(70)).expect("a long name").layout.name, "x".repeat(64));
    let problem = named("腕").expect_err("no letters").to_string();
    assert!(problem.contains("腕") && problem.contains("--name"), "{problem}");
    // line breaks end no comment and no name
    let import =
        imported(&robot(&arm()).replace("\"elbow\"", "\"el&#10;bow = 1\"").replace("\"shoulder\"", "\"a&#10;b\""));
    assert!(import.to_toml("a\nb = 2").lines().all(|line| !line.starts_with("bow") && !line.starts_with("b =")));
    // arms are called as export calls them, unless two would be called the same
    let second = joint("continuous", "x_joint1", ["base", "wheel"], "xyz=\"0 0 0\"", UP)
        + &link("wheel", 1.0, "0 0 0", [1.0; 3]);
    let arms = |text: &str| imported(text).layout.arms.into_iter().map(|arm| arm.name).collect::<Vec<_>>();
    let both = robot(&(arm() + &second));
    assert_eq!(arms(&both), ["shoulder", "x"]);
    assert_eq!(arms(&both.replace("\"shoulder\"", "\"x\"")), ["x", "x_joint1"]);
}

/// (what is wrong, the URDF, what the message says)
type Refused = (&'static str, String, &'static [&'static str]);

fn refused_joints() -> Vec<Refused> {
    let branch =
        joint("continuous", "third", ["upper", "twig"], "xyz=\"0 0 0\"", UP) + &link("twig", 1.0, "0 0 0", [1.0; 3]);
    let elbow = "<joint name=\"elbow\" type=\"continuous\">";
    vec![
        ("nothing", String::new(), &["not a URDF"]),
        ("not XML", "name = \"layout\"".to_owned(), &["not a URDF"]),
        ("another document", "<html><body>robot</body></html>".to_owned(), &["no links", "<robot>"]),
        ("not closed", robot(&arm()).replace("</robot>", ""), &["not a URDF"]),
        ("made to break the parser", "<a>".repeat(100_000), &["100000 deep", "64"]),
        ("no joints", robot(""), &["`bot`", "`base`", "revolute"]),
        (
            "prismatic",
            changed(elbow, "<joint name=\"elbow\" type=\"prismatic\">"),
            &["`elbow`", "prismatic", "`lower`", "revolute"],
        ),
        ("floating inside", changed(elbow, "<joint name=\"elbow\" type=\"floating\">"), &["`elbow`", "floating"]),
        (
            "unknown joint",
            changed(elbow, "<joint name=\"elbow\" type=\"screw\">"),
            &["line 6, joint `elbow`", "`screw`", "`revolute`"],
        ),
        (
            "branch",
            robot(&(arm() + &branch)),
            &["link `upper`", "`elbow` (continuous) to `lower`", "`third` (continuous) to `twig`", "base"],
        ),
        (
            "mimic",
            changed(elbow, &format!("{elbow}<mimic joint=\"shoulder\"/>")),
            &["line 6, joint `elbow`", "mimics joint `shoulder`"],
        ),
        (
            "another axis",
            changed("<origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/>", "<origin xyz=\"1 0 0\"/><axis xyz=\"0 1 1\"/>"),
            &["`elbow`", "0.785398 rad", "parallel"],
        ),
        (
            "an axis whose square has no place in 64 bits",
            changed("<origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/>", "<origin xyz=\"1 0 0\"/><axis xyz=\"1e300 0 0\"/>"),
            &["line 6, joint `elbow`", "`xyz` of <axis> is \"1e300 0 0\", where 1e300 is too large", "1e100"],
        ),
        (
            "a length whose square has no place in 64 bits",
            changed("<origin xyz=\"1 0 0\"/><axis", "<origin xyz=\"1e200 1e200 0\"/><axis"),
            &["line 6, joint `elbow`", "`xyz` of <origin> is \"1e200 1e200 0\", where 1e200 is too large"],
        ),
        (
            "no axis",
            changed("<origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/>", "<origin xyz=\"1 0 0\"/>"),
            &["`elbow`", "[1.0, 0.0, 0.0]", "missing <axis>"],
        ),
        (
            "zero axis",
            changed("<origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/>", "<origin xyz=\"1 0 0\"/><axis xyz=\"0 0 0\"/>"),
            &["`elbow`", "[0, 0, 0]"],
        ),
    ]
}

fn refused_bodies() -> Vec<Refused> {
    let with = |more: &str| robot(&(arm() + more));
    let fixed_box =
        joint("fixed", "bolts", ["lower", "box"], "xyz=\"0 0 0\"", "") + &link("box", -1.0, "0 0 0", [1.0; 3]);
    let lower = "<link name=\"lower\"><inertial><origin xyz=\"0.5 0 0\"/><mass value=\"10\"/>";
    vec![
        (
            "massless link",
            changed(&link("upper", 10.0, "0.5 0 0", [1.0; 3]), "<link name=\"upper\"/>"),
            &["link `upper`", "it moves and its mass is 0.0 kg", "<inertial>"],
        ),
        (
            "massless link, and a tip fixed to it",
            changed(&link("lower", 10.0, "0.5 0 0", [1.0; 3]), "<link name=\"lower\"/>"),
            &["link `lower`", "it moves, with the 1 fixed to it, and its mass is 0.0 kg"],
        ),
        (
            "massless base",
            robot(&arm()).replace(&link("base", 100.0, "0 0 0", [20.0; 3]), "<link name=\"base\"/>"),
            &["link `base`", "0.0 kg"],
        ),
        ("negative mass of what is fixed", with(&fixed_box), &["link `box`", "-1.0 kg"]),
        (
            "no inertia",
            changed(&link("lower", 10.0, "0.5 0 0", [1.0; 3]), &link("lower", 10.0, "0.5 0 0", [1.0, 1.0, 0.0])),
            &["link `lower`", "0.0 kg m²"],
        ),
        ("not finite", changed(lower, &lower.replace("10", "inf")), &["link `lower`", "[inf]"]),
        (
            "a centre of mass that is not finite",
            changed(lower, &lower.replace("0.5 0 0", "0.5 inf 0")),
            &["link `lower`", "its centre of mass is [0.5, inf, 0.0]", "finite numbers"],
        ),
        (
            "a rotation of an inertia that is not finite",
            changed(lower, &lower.replace("0.5 0 0\"", "0.5 0 0\" rpy=\"0 0 inf\"")),
            &["link `lower`", "the rpy of its inertia is [0.0, 0.0, inf]"],
        ),
        (
            "comma for point",
            changed(lower, &lower.replace("10", "1,5")),
            &["line 7, link `lower`", "`value` of <mass>", "`1,5`"],
        ),
        (
            "a word among numbers",
            changed(lower, &lower.replace("0.5 0 0", "0.5 oops 0 0")),
            &["link `lower`", "`oops`"],
        ),
        (
            "after tags of several lines",
            changed(
                "<joint name=\"elbow\" type=\"continuous\">",
                "<joint\n name=\"elbow\"\n type=\"continuous\"><!--\n-->",
            )
            .replace(lower, &lower.replace("10", "x")),
            &["line 10, link `lower`"],
        ),
        ("xacro", changed(lower, &lower.replace("10", "${m}")), &["`${m}`", "xacro"]),
        (
            "no inertia tensor",
            with("<link name=\"odd\"><inertial><mass value=\"1\"/></inertial></link>"),
            &["line 10, link `odd`", "inertia"],
        ),
    ]
}

fn refused_trees() -> Vec<Refused> {
    let with = |more: &str| robot(&(arm() + more));
    vec![
        ("no such link", with(&joint("fixed", "lost", ["lower", "hand"], "", "")), &["joint `lost`", "child `hand`"]),
        ("two roots", with("<link name=\"loose\"/>"), &["`base`", "`loose`"]),
        (
            "two parents",
            with(&joint("fixed", "loop", ["base", "lower"], "", "")),
            &["link `lower`", "`elbow`", "`loop`"],
        ),
        (
            "a rotation that is not finite",
            changed("<origin xyz=\"1 0 0\"/><axis", "<origin xyz=\"1 0 0\" rpy=\"0 0 inf\"/><axis"),
            &["joint `elbow`", "its origin's rpy is [0.0, 0.0, inf]"],
        ),
        (
            "a place that is not finite",
            changed("<origin xyz=\"1 0 0\"/><axis", "<origin xyz=\"1 inf 0\"/><axis"),
            &["joint `elbow`", "its origin is [1.0, inf, 0.0]"],
        ),
        ("a circle", with(&joint("fixed", "loop", ["tip", "base"], "", "")), &["circle"]),
        (
            "a circle aside",
            with(&format!(
                "<link name=\"p\"/><link name=\"q\"/>{}{}",
                joint("fixed", "r", ["p", "q"], "", ""),
                joint("fixed", "s", ["q", "p"], "", "")
            )),
            &["link `p`", "circle"],
        ),
        (
            "a name of nothing",
            changed("<joint name=\"elbow\"", "<joint name=\"\""),
            &["line 6, joint ``", "its `name` is \"\", expected a name"],
        ),
        ("a link twice", with("<link name=\"tip\"/>"), &["line 1", "link `tip`", "two"]),
        ("a joint twice", with(&joint("fixed", "end", ["tip", "tip"], "", "")), &["joint `end`", "two"]),
        (
            "millimetres",
            changed(
                "<child link=\"lower\"/><origin xyz=\"1 0 0\"/>",
                "<child link=\"lower\"/><origin xyz=\"90000 0 0\"/>",
            ),
            &["millimetres", "90000"],
        ),
    ]
}

#[test]
fn what_a_layout_cannot_hold_is_refused_by_name() {
    for (what, text, hints) in [refused_joints(), refused_bodies(), refused_trees()].concat() {
        let problem = match import(&text, &ImportOptions::default()) {
            Ok(import) => panic!("{what}: {import:?}"),
            Err(problem) => problem.to_string(),
        };
        for hint in hints {
            assert!(problem.contains(hint), "{what}: no `{hint}` in\n{problem}");
        }
    }
    for (names, hints) in [
        (&["tips"][..], &["`tips`", "did you mean `tip`?", "`lower` or `tip` (arm `shoulder`)"][..]),
        (&["upper"], &["`upper`", "not at the end"]),
        (&["tip", "lower"], &["`lower`", "`shoulder` has the end effector `tip` already"]),
    ] {
        let problem = import(&robot(&arm()), &options(names)).expect_err("no end effector").to_string();
        for hint in hints {
            assert!(problem.contains(hint), "{names:?}: no `{hint}` in\n{problem}");
        }
    }
}

/// Through a URDF and back: the same to the bit but for the mount angles, which pass sine, cosine and arctangent.
#[track_caller]
fn assert_round_trip(layout: &Layout) {
    let import = imported(&export(layout));
    // in the URDF's configuration of zeros the joints of the layout are at zero, too
    for joint in &import.joints {
        assert!(joint.sign > 0.0 && joint.offset.abs() <= tolerance::URDF, "{joint}");
    }
    let mut back = import.layout;
    for (arm, back) in layout.arms.iter().zip(&mut back.arms) {
        let turns = ((arm.mount_angle - back.mount_angle) / TAU).round();
        assert_close("mount angle", &[back.mount_angle + TAU * turns], &[arm.mount_angle], tolerance::URDF);
        back.mount_angle = arm.mount_angle;
    }
    assert_eq!(&back, layout);
}

#[test]
fn shipped_layouts_come_back() {
    for (name, text) in registry::SHIPPED {
        let layout = without_outlines(Layout::parse(text, name).unwrap_or_else(|report| panic!("{report}")));
        let back = imported(&export(&layout)).layout;
        assert_round_trip(&layout);
        assert!(registry::generated(&back).is_ok(), "{name}: exact zeros stay, so that its generated code fits");
    }
    for name in ["awkward", "cubesat"] {
        assert_round_trip(&Layout::read(&file(&format!("tests/urdf/{name}.toml"))).unwrap_or_else(|r| panic!("{r}")));
    }
}

/// A URDF of this crate has no collision geometry.
fn without_outlines(mut layout: Layout) -> Layout {
    layout.base.outline = None;
    layout.arms.iter_mut().flat_map(|arm| &mut arm.links).for_each(|link| link.outline = None);
    layout
}

/// Layouts of any shape: some lengths, mounts and centres of mass are exact zeros, some numbers tiny or huge.
fn layouts() -> impl Strategy<Value = Layout> {
    let number = || prop_oneof![1 => Just(0.0), 4 => -2.0..2.0_f64];
    let positive = || (-6.0..6.0_f64).prop_map(|log| 10.0_f64.powf(log));
    let length = prop_oneof![1 => Just(0.0), 4 => 0.01..3.0_f64];
    let link = (length, positive(), positive(), [number(), number()]).prop_map(|(length, mass, inertia, com)| Link {
        length,
        mass,
        inertia,
        com,
        outline: None,
    });
    let angle = prop_oneof![1 => Just(0.0), 1 => Just(PI), 4 => -TAU..TAU];
    let name = prop_oneof!["[ -~]{0,8}[!-~]", "[a-z_]{1,4}_joint1", "\\PC{1,6}"]
        .prop_filter("hidden characters come back as escape sequences", |name| !name.contains(is_hidden));
    let arm = (name, [number(), number()], angle, vec(link, 1..5));
    let layouts = (positive(), positive(), vec(arm, 1..5)).prop_map(|(mass, inertia, arms)| Layout {
        name: "any".to_owned(),
        base: Base { mass, inertia, outline: None },
        arms: (1..)
            .zip(arms)
            .map(|(k, (name, mount, mount_angle, links))| Arm { name: format!("{name}{k}"), mount, mount_angle, links })
            .collect(),
    });
    let is_resolved = |layout: &Layout| {
        let refused = Layout::parse(&layout.to_toml(), "layout.toml").err();
        refused.is_none_or(|report| !report.to_string().contains("16 digits do not "))
    };
    layouts.prop_filter("a body beside which the others are lost", is_resolved)
}

proptest! {
    #![proptest_config(sample::config())]

    #[test]
    fn any_layout_comes_back(layout in layouts()) {
        assert_round_trip(&layout);
    }
}

#[test]
fn the_commands_write_files_or_the_standard_output() {
    let folder = TempDir::new().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (urdf, toml) = (path("robot.urdf"), path("robot.toml"));
    let (code, out, err) = said(&["export", "dual_arm_2r"]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(said(&["export", "dual_arm_2r", "--out", &urdf]), (0, String::new(), String::new()));
    assert_eq!(fs::read_to_string(&urdf).expect("a URDF"), out);
    let (code, out, err) = said(&["import", &urdf]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.starts_with(&format!("# Imported from {urdf}")), "{out}");
    assert_eq!(said(&["import", &urdf, "--out", &toml]), (0, String::new(), String::new()));
    assert_eq!(fs::read_to_string(&toml).expect("a layout"), out);

    let (code, out, err) = said(&["import", &file("tests/urdf/clutter.urdf").display().to_string(), "--name", "mine"]);
    assert_eq!(code, 0);
    assert!(out.contains("\nname = \"mine\"\n") && out.contains("# warning: the robot would leave the plane"), "{out}");
    assert!(err.contains("import: note: arm `shoulder`, joint 3 = -`wrist`"), "{err}");
    assert!(err.contains("import: warning: the robot would leave the plane"), "{err}");
}

/// Outlines of the base and of links are counted together.
#[test]
fn outlines_that_a_urdf_lacks_are_counted() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("robot.toml");
    let plain = fs::read_to_string(file("codegen/layouts/single_arm_2r.toml")).expect("a layout");
    let plain = without_outlines(Layout::parse(&plain, "single_arm_2r.toml").expect("a layout"));
    for (of_base, of_links) in [(false, 0), (false, 2), (true, 0), (true, 1)] {
        let mut layout = plain.clone();
        layout.base.outline = of_base.then_some(Outline::disc(0.5));
        layout.arms[0].links[..of_links].iter_mut().for_each(|link| link.outline = Some(Outline::disc(0.1)));
        fs::write(&path, layout.to_toml()).expect("written");
        let (code, _, err) = said(&["export", &path.display().to_string()]);
        let expected = match usize::from(of_base) + of_links {
            0 => String::new(),
            count => {
                format!("warning: outlines are no part of the URDF, and `import` has none: {count} are left out\n")
            }
        };
        assert_eq!((code, err), (0, expected));
    }
}

#[test]
fn bad_input_is_exit_code_2_and_leaves_nothing() {
    let folder = TempDir::new().expect("a folder");
    let urdf = folder.path().join("robot.urdf");
    fs::write(&urdf, robot(&arm()).replace("type=\"fixed\"", "type=\"prismatic\"")).expect("written");
    let toml = folder.path().join("robot.toml");
    let (urdf, toml) = (urdf.display().to_string(), toml.display().to_string());
    for (arguments, hints) in [
        (&["import", &urdf, "--out", &toml][..], &["robot.urdf: line 8, joint `end`", "prismatic"][..]),
        (&["import", &urdf, "--name", "Fn", "--out", &toml], &["robot.urdf", "`Fn`", "lower-case"]),
        (&["import", &urdf.replace("robot.", "robto."), "--out", &toml], &["no file", "robot.urdf"]),
        (&["import", &folder.path().display().to_string()], &["is a folder", "URDF", "robot.urdf"]),
        (&["export", "src", "--out", &toml], &["`src` is a folder, expected a TOML file"]),
        (&["check", "LICENSE"], &["`LICENSE` is not the name of a shipped layout", "`./LICENSE`"]),
        (&["export", "dual_arm", "--out", &toml], &["no shipped layout `dual_arm`"]),
    ] {
        let (code, out, err) = said(arguments);
        assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}: {err}");
        for hint in hints {
            assert!(err.contains(hint), "{arguments:?}: no `{hint}` in\n{err}");
        }
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1, "{arguments:?}");
    }
}
