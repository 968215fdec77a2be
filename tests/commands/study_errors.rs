//! Scenarios that are valid by themselves but have no result: the key, its value and place, and no file.

use crate::command;
use planar_capture::capture::StudyError;
use planar_capture::error::Error;
use planar_capture::registry::SHIPPED;
use planar_capture::scenario::Scenario;
use planar_proof::{file, said};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// (what is wrong, the scenario, the change to it, the key, its value, exit code)
type NoResult = (&'static str, &'static str, &'static [(&'static str, &'static str)], &'static str, &'static str, i32);

const PAPER: &str = "raina_shah_2017";
const NO_RESULT: &[NoResult] = &[
    ("rates diverge", PAPER, &[("proportional_gain = 49.0", "proportional_gain = 4.9e7")], "approach.step", "0.005", 1),
    (
        "rates diverge at the default step",
        PAPER,
        &[("proportional_gain = 49.0", "proportional_gain = 4.9e7"), ("step = 0.005 # s", "# s")],
        "approach.step",
        "default, 0.005",
        1,
    ),
    (
        "a singular final pose",
        PAPER,
        &[("[-0.524, -1.393, -0.035, 2.618, -1.393, -0.035]", "[-0.524, 0.0, 0.0, 2.618, 0.0, 0.0]")],
        "approach.final_end_effector_twists",
        "[[0.0, -0.1, 0.0], [0.0, 0.1, 0.0]]",
        2,
    ),
    (
        "a pose out of reach",
        "redysim_single_arm_3r",
        &[(
            "final_joint_angles = [-1.5707963267948966, -1.5707963267948966, -1.5707963267948966]",
            "final_end_effector_poses = [[5.0, 0.0]]",
        )],
        "approach.final_end_effector_poses[0]",
        "[5.0, 0.0]",
        2,
    ),
    (
        "a pose that is not reached",
        "redysim_single_arm_3r",
        &[(
            "final_joint_angles = [-1.5707963267948966, -1.5707963267948966, -1.5707963267948966]",
            "final_end_effector_poses = [[3.6, 0.0]]",
        )],
        "approach.final_end_effector_poses",
        "[[3.6, 0.0]]",
        2,
    ),
    (
        "a start inside a target",
        "elastic_rebound",
        &[("radius = 0.3", "radius = 4.0")],
        "target[0].position",
        "[4.6, -0.35]",
        2,
    ),
    (
        "steps that do not converge",
        PAPER,
        &[("step = 0.005 # s", "step = 0.5 # s"), ("integrator = \"rk4\"", "integrator = \"gauss_legendre\"")],
        "approach.step",
        "0.5",
        1,
    ),
    (
        "a goal of the end effectors at the end of the world",
        "large_target",
        &[("[[1.5708, 0.7, 2.2],", "[[1.5708, 1e15, 2.2],")],
        "approach.final_end_effector_poses[0]",
        "[1.5708, 1e15, 2.2]",
        2,
    ),
    (
        "a law that is too stiff for adaptive steps",
        "large_target",
        &[("derivative_gain = 14.0", "derivative_gain = 1e100")],
        "post_impact.derivative_gain",
        "1e100",
        1,
    ),
    (
        "coordinates without bodies",
        "large_target",
        &[("[post_impact]", "[post_impact]\ncoordinates = \"reduced\"")],
        "post_impact.coordinates",
        "\"reduced\"",
        2,
    ),
];

/// Exit code and standard error of a run with a change, and the text that it read.
fn run(scenario: &str, changes: &[(&str, &str)], folder: &Path) -> (i32, String, String) {
    let mut text = fs::read_to_string(file(&format!("scenarios/{scenario}.toml"))).expect("a scenario");
    for (from, to) in changes {
        assert!(text.contains(from), "{scenario}: no {from}");
        text = text.replacen(from, to, 1);
    }
    let path = folder.join("scenario.toml");
    fs::write(&path, &text).expect("written");
    let (code, out, err) = said(
        command().args(["run", "-q"]).arg(&path).arg("--out").arg(folder.join("results")).output().expect("it runs"),
    );
    assert_eq!(out, "", "{err}");
    assert!(!folder.join("results").exists(), "nothing is written: {err}");
    (code, err, text)
}

#[test]
fn an_error_of_the_study_is_shown_at_its_key() {
    for (what, scenario, changes, key, value, expected) in NO_RESULT {
        let folder = TempDir::new().expect("a folder");
        let (code, err, text) = run(scenario, changes, folder.path());
        assert_eq!(code, *expected, "{what}: {err}");
        let default = value.starts_with("default");
        let message = if default { format!("`{key}` is left at its {value}:") } else { format!("`{key}` is {value}:") };
        assert!(err.starts_with(&format!("error: {message}")), "{what}: no {message} in\n{err}");
        let (table, name) = key.rsplit_once('.').expect("a key of a table");
        let line =
            text.lines().position(|line| line.starts_with(&format!("[{}", table.replacen("target[0]", "[target", 1))));
        let line = line.expect("the table's header");
        let name = name.split('[').next().expect("a name");
        let own = text.lines().skip(line).position(|line| line.starts_with(&format!("{name} =")));
        let line = line + 1 + own.filter(|_| !default).unwrap_or_default();
        assert!(err.contains(&format!("scenario.toml:{line}:")), "{what}: not line {line} in\n{err}");
        // what needs no simulation to be seen, `check` refuses too
        let (checked, _, refusal) =
            said(command().arg("check").arg(folder.path().join("scenario.toml")).output().expect("it runs"));
        let seen = (checked, refusal.ends_with(&err));
        assert_eq!(seen, if *expected == 1 { (0, false) } else { (2, true) }, "{what}: {refusal}\nbeside\n{err}");
    }
}

/// Bounces that do not end are rare: the key of the error alone.
#[test]
fn bounces_without_end_are_shown_at_the_restitution() {
    let scenario = Scenario::read(&file("scenarios/elastic_rebound.toml"), SHIPPED).expect("a scenario");
    let chatter = |case: &str| {
        let (case, target) = (case.to_owned(), "box".to_owned());
        StudyError::Chatter { case, impacts: 1001, target, time: 3.0 }.key(&scenario)
    };
    assert_eq!((chatter("half").path.as_str(), chatter("half").value.as_str()), ("case[1].restitutions.box", "0.5"));
    let mut plain = scenario.clone();
    plain.cases[1].restitutions = vec![0.0, 0.0];
    let singular = Error::Singular { what: "the contacts", pivot: 0.0, limit: 1e-12 };
    let impact = StudyError::Impact { case: "half".to_owned(), source: singular }.key(&plain);
    assert_eq!((impact.path.as_str(), impact.value.as_str()), ("target[0].kind", "bounce"));
    let (case, target) = ("half".to_owned(), "box".to_owned());
    let chatter = StudyError::Chatter { case, impacts: 1001, target, time: 3.0 }.key(&plain);
    assert_eq!((chatter.path.as_str(), chatter.value.as_str()), ("target[1].restitution", "0"));
}

/// A long phase needs a temporary file: a message names the folder that there is none in.
#[cfg(unix)]
#[test]
fn an_absent_folder_for_temporary_files_is_named() {
    let folder = TempDir::new().expect("a folder");
    let text = fs::read_to_string(file("scenarios/redysim_single_arm_3r.toml")).expect("a scenario");
    let path = folder.path().join("long.toml");
    let text = text.replacen("duration = 20.0", "duration = 200.0\nstep = 0.005", 1);
    fs::write(&path, text).expect("written");
    let absent = folder.path().join("absent");
    let mut run = command();
    run.arg("run").arg(&path).args(["--sample", "0.005", "--out"]).arg(folder.path().join("results"));
    let output = run.env("TMPDIR", &absent).output().expect("it runs");
    let err = String::from_utf8(output.stderr).expect("UTF-8");
    assert!(output.status.code() == Some(2) && err.contains(&absent.display().to_string()), "{err}");
    assert!(err.contains("TMPDIR"), "{err}");
}
