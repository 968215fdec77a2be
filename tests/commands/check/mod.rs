//! `planar-capture check`: descriptions, warnings and errors.

mod description;
mod invalid_files;
#[cfg(feature = "sweep")]
mod sweeps;
mod warnings;

use crate::command;
use planar_capture::check::{CheckReport, inspect};
use planar_capture::registry::SHIPPED;
use planar_proof::{file, said};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A robot without warnings: two arms and a wheel.
const LAYOUT: &str = r#"name = "robot"
[base]
mass = 500.0
inertia = 80.0
[[arm]]
name = "left"
mount = [0.5, 0.0]
[[arm.link]]
length = 1.0
mass = 10.0
inertia = 1.0
[[arm.link]]
length = 1.0
mass = 10.0
inertia = 1.0
com = [0.5, 0.1]
[[arm.link]]
length = 0.5
mass = 5.0
inertia = 0.1
[[arm]]
name = "right"
mount = [-0.5, 0.0]
[[arm.link]]
length = 2.0
mass = 10.0
inertia = 3.0
[[arm]]
name = "wheel"
mount = [0.5, 0.0]
[[arm.link]]
length = 0.0
mass = 4.0
inertia = 0.5
"#;

/// A scenario of that robot without warnings.
const SCENARIO: &str = r#"name = "study"
layout = "robot"
[initial]
joint_angles = [0.7, -1.6, 1.0, 0.0, 0.0]
[approach]
duration = 20.0
trajectory = "quartic"
final_joint_angles = [-0.5, -1.4, -0.1, 0.0, 0.0]
final_joint_rates = [0.01, 0.0, 0.0, 0.0, 0.0]
[[target]]
name = "ball"
arm = "left"
mass = 10.0
inertia = 1.0
contact = [0.0, 0.5]
radius = 0.5
twist = [0.2, 0.0, 0.0]
position = [1.5, -2.0]
[[case]]
name = "spin"
[[case]]
name = "still"
target_twists = { ball = [0.0, 0.0, 0.0] }
[post_impact]
duration = 50.0
[clearance] # the outlines are defaults: other tests look at overlaps
ignore = [
  ["base", "arms/left/link2"], ["base", "arms/left/link3"], ["base", "targets/ball"],
  ["arms/left/link1", "arms/left/link3"], ["arms/left/link1", "arms/right/link1"], ["arms/left/link1", "targets/ball"],
  ["arms/left/link2", "arms/right/link1"], ["arms/left/link2", "arms/wheel/link1"], ["arms/left/link2", "targets/ball"],
  ["arms/left/link3", "arms/right/link1"], ["arms/left/link3", "arms/wheel/link1"], ["arms/left/link3", "targets/ball"],
  ["arms/right/link1", "arms/wheel/link1"], ["arms/right/link1", "targets/ball"], ["arms/wheel/link1", "targets/ball"],
]
"#;

fn inspect_text(text: &str) -> CheckReport {
    let shipped = [("robot", LAYOUT)];
    inspect(text, "it.toml", Path::new(""), &shipped).unwrap_or_else(|report| panic!("{report}\nin\n{text}"))
}

fn check(arguments: &[&str], folder: &Path) -> (i32, String, String) {
    said(command().arg("check").args(arguments).current_dir(folder).output().expect("it runs"))
}

#[test]
fn shipped_files_have_no_warnings() {
    let layouts = SHIPPED.iter().map(|(name, _)| (*name).to_owned());
    let folders = ["codegen/layouts", "scenarios"];
    let paths = folders.into_iter().flat_map(|folder| fs::read_dir(file(folder)).expect("a folder"));
    let paths = paths.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_file());
    let paths = paths.map(|path| path.display().to_string());
    let all: Vec<_> = layouts.chain(paths).collect();
    assert!(all.len() >= 2 * SHIPPED.len() + 5);
    for each in all {
        let (code, out, err) = check(&[&each], Path::new("."));
        assert_eq!((code, err.as_str()), (0, ""), "{each}");
        assert!(out.ends_with("\nno warnings\n"), "{each}:\n{out}");
    }
}

#[test]
fn warnings_accompany_the_description() {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("odd.toml"), LAYOUT.replace("inertia = 3.0", "inertia = 30")).expect("written");
    let (code, out, err) = check(&["odd.toml"], folder.path());
    assert_eq!(code, 0);
    assert!(out.starts_with("robot: a layout") && !out.contains("no warnings"), "{out}");
    assert!(err.starts_with("warning: `arm[1].link[0].inertia` is 30") && err.ends_with("\n\n1 warning\n"), "{err}");
    // a scenario in its layout's folder, from another folder
    fs::write(folder.path().join("study.toml"), SCENARIO.replace("\"robot\"", "\"odd.toml\"")).expect("written");
    let path = folder.path().join("study.toml");
    let (code, out, err) = check(&[&path.display().to_string()], Path::new("."));
    assert_eq!(code, 0, "{err}");
    assert!(out.starts_with("study: a scenario") && err.contains("odd.toml:27:"), "{out}{err}");
}

#[test]
fn unknown_names_and_missing_files() {
    for (argument, expected) in [("dual_arm_4r", "`dual_arm_3r`"), ("nowhere.toml", "no file `nowhere.toml`")] {
        let (code, out, err) = check(&[argument], Path::new("."));
        assert_eq!((code, out.as_str()), (2, ""), "{err}");
        assert!(err.contains(expected), "{err}");
    }
}
