//! Drawings of robots, and files that are not replaced without `--force`.

use crate::said;
use planar_proof::file;
use std::fs;
use tempfile::TempDir;

#[test]
fn a_drawing_has_the_angles_that_are_given() {
    let (code, zero, err) = said(&["draw", "single_arm_2r"]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(zero.starts_with("<svg") && zero.ends_with("</svg>\n") && zero.contains("joint angles 0, 0 rad"), "{zero}");
    let layout = file("codegen/layouts/single_arm_2r.toml").display().to_string();
    let (code, turned, err) = said(&["draw", &layout, "--angles", "-0.5,1.25"]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(turned.contains("joint angles −0.5, 1.25 rad") && turned != zero, "{turned}");
}

#[test]
fn angles_that_are_not_one_for_each_joint_are_refused() {
    for (angles, expected) in [
        ("0.1", &["--angles has 1 numbers, expected 6", "arm1: 3, arm2: 3"][..]),
        ("0,0,0,0,0,0,0.1", &["--angles has 7 numbers, expected 6", "arm1: 3, arm2: 3"]),
        ("0.1,x", &["'x'", "joint angles in rad"]),
        ("nan", &["'nan'", "joint angles in rad"]),
        ("1e300", &["'1e300'"]),
        ("0.1,-40", &["'-40'", "joint angles in rad: this looks like degrees"]),
        ("inf", &["'inf'", "joint angles in rad"]),
    ] {
        let (code, out, err) = said(&["draw", "dual_arm_3r", "--angles", angles]);
        assert_eq!((code, out.as_str()), (2, ""), "{angles}");
        assert!(expected.iter().all(|text| err.contains(text)), "{angles}: {err}");
    }
}

/// All commands that write a single file of a user's choice refuse one that exists, before they compute anything, and replace it
/// with `--force`.
#[test]
fn a_file_that_exists_is_replaced_by_force_alone() {
    let folder = TempDir::new().expect("a folder");
    let [out, urdf] = ["it", "robot.urdf"].map(|name| folder.path().join(name).display().to_string());
    let scenario = file("scenarios/redysim_single_arm_3r.toml").display().to_string();
    assert_eq!(said(&["export", "single_arm_2r", "--out", &urdf]).0, 0);
    for command in [
        &["draw", "single_arm_2r"][..],
        &["animate", &scenario, "--seconds", "1", "-q"],
        &["template", "layout"],
        &["schema", "layout"],
        &["export", "single_arm_2r"],
        &["import", &urdf],
    ] {
        fs::write(&out, "mine").expect("written");
        let (code, _, err) = said(&[command, &["--out", &out]].concat());
        assert!(code == 2 && err.contains("it already exists") && err.contains("--force"), "{command:?}: {err}");
        assert_eq!(fs::read_to_string(&out).expect("a file"), "mine", "{command:?}");
        assert_eq!(said(&[command, &["--force", "--out", &out]].concat()).0, 0, "{command:?}");
        assert!(fs::read_to_string(&out).expect("a file") != "mine", "{command:?}");
        let (code, _, err) = said(&[command, &["--force"]].concat());
        assert!(code == 2 && err.contains("--out"), "--force is of a file: {err}");
    }
    let (code, _, err) = said(&["draw", "single_arm_2r", "--force", "--out", &folder.path().display().to_string()]);
    assert!(code == 2 && folder.path().is_dir(), "a folder is none: {err}");
}

/// A picture is SVG, whatever its file is called.
#[test]
fn files_of_other_pictures_are_refused() {
    let folder = TempDir::new().expect("a folder");
    let scenario = file("scenarios/redysim_single_arm_3r.toml").display().to_string();
    for command in [&["draw", "single_arm_2r"][..], &["animate", &scenario, "-q"]] {
        let out = folder.path().join("it.png").display().to_string();
        let (code, _, err) = said(&[command, &["--out", &out]].concat());
        assert!(code == 2 && err.contains("expected a file that ends in `.svg`"), "{command:?}: {err}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
}

/// A folder that is not there is named before anything is computed: this scenario would be refused.
#[test]
fn a_folder_that_is_not_there_is_named_first() {
    let folder = TempDir::new().expect("a folder");
    let [out, scenario] = ["none/it.svg", "none.toml"].map(|name| folder.path().join(name).display().to_string());
    for command in [&["animate", &scenario][..], &["draw", "single_arm_2r"], &["template", "layout"]] {
        let (code, stdout, err) = said(&[command, &["--out", &out]].concat());
        assert_eq!((code, stdout.as_str(), err.lines().count()), (2, "", 1), "{command:?}: {err}");
        assert!(err.contains("it.svg: there is no folder ") && !err.contains(".planar-capture-"), "{command:?}: {err}");
    }
}
