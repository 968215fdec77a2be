//! Standard output and standard error that are closed pipes or full disks: what a command found stays its exit code.
#![cfg(target_os = "linux")]

use crate::command;
use planar_proof::file;
use std::fs::{self, File};
use std::path::Path;
use std::process::Stdio;
use tempfile::TempDir;

/// A standard stream that cannot be written.
#[derive(Clone, Copy, Debug)]
enum Unwritable {
    /// A pipe whose reader is gone.
    Closed,
    /// A disk without space.
    Full,
}

const BOTH: [Unwritable; 2] = [Unwritable::Closed, Unwritable::Full];

impl Unwritable {
    fn stream(self) -> Stdio {
        match self {
            Self::Closed => std::io::pipe().expect("a pipe").1.into(),
            Self::Full => File::options().write(true).open("/dev/full").expect("Linux has it").into(),
        }
    }
}

/// Exit code and standard error with such a standard output.
fn printing_to(out: Unwritable, arguments: &[&str]) -> (i32, String) {
    let output = command().args(arguments).stdout(out.stream()).output().expect("it runs");
    (output.status.code().expect("an exit code"), String::from_utf8(output.stderr).expect("UTF-8"))
}

/// Exit code with such a standard error.
fn noting_to(err: Unwritable, arguments: &[&str]) -> i32 {
    command().args(arguments).stderr(err.stream()).output().expect("it runs").status.code().expect("an exit code")
}

/// An approach with a step in which the audit fails, and one in which it does not.
fn approaches(folder: &Path) -> [String; 2] {
    let text = fs::read_to_string(file("scenarios/redysim_single_arm_3r.toml")).expect("a scenario");
    [("poor", "0.2"), ("good", "0.005")].map(|(name, step)| {
        let text = text.replacen("duration = 20.0", &format!("duration = 20.0\nstep = {step}"), 1);
        let path = folder.join(format!("{name}.toml"));
        fs::write(&path, text.replacen("redysim_single_arm_3r", name, 1)).expect("written");
        path.display().to_string()
    })
}

#[test]
fn run_exits_with_what_the_audit_found() {
    let folder = TempDir::new().expect("a folder");
    let [poor, good] = approaches(folder.path());
    for out in BOTH {
        for (scenario, expected) in [(&poor, 1), (&good, 0)] {
            let results = format!("{scenario}.{out:?}");
            let (code, err) = printing_to(out, &["run", scenario, "--out", &results]);
            assert_eq!(code, expected, "{out:?}: {err}");
            assert_eq!(err.contains("audit: "), expected == 1, "{out:?}: {err}");
            assert_eq!(err.contains("cannot write to standard output"), matches!(out, Unwritable::Full), "{err}");
            assert!(Path::new(&results).join("summary.json").exists(), "{out:?}");
        }
        assert_eq!(noting_to(out, &["run", &poor, "--out", &format!("{poor}.{out:?}")]), 1);
        assert_eq!(noting_to(out, &["run", "missing.toml"]), 2);
    }
}

#[test]
fn compare_exits_with_what_it_found() {
    let folder = TempDir::new().expect("a folder");
    let text = fs::read_to_string(file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    // two arms at almost the same place: rounding is over the bound of the comparison
    let close = folder.path().join("close.toml").display().to_string();
    fs::write(&close, text.replace("[-0.5, 0.0]", "[0.499998, 0.0]")).expect("written");
    let results = folder.path().join("worst").display().to_string();
    for out in BOTH {
        for (layout, expected) in [(close.as_str(), 1), ("single_arm_2r", 0)] {
            let results = format!("{results}_{expected}");
            let (code, err) = printing_to(out, &["compare", layout, "--samples", "20", "--out", &results]);
            assert_eq!(code, expected, "{out:?}: {err}");
        }
    }
}

#[test]
fn check_exits_with_what_it_found() {
    let folder = TempDir::new().expect("a folder");
    let bad = folder.path().join("bad.toml").display().to_string();
    fs::write(&bad, "name = \"bad\"\n").expect("written");
    for out in BOTH {
        assert_eq!(printing_to(out, &["check", "dual_arm_3r"]).0, 0, "{out:?}");
        assert_eq!(printing_to(out, &["check", &bad]).0, 2, "{out:?}");
        assert_eq!(noting_to(out, &["check", &bad]), 2, "{out:?}");
    }
}

/// A reader that closes the pipe has what it wants; a full disk loses the product.
#[test]
fn a_product_that_is_lost_is_an_error() {
    let folder = TempDir::new().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let [states, bad, urdf] = ["states.json", "bad.json", "robot.urdf"].map(path);
    let state = r#"{"base_pose": [0, 0, 0], "joint_angles": [0.1, 0.2, 0.3], "base_twist": [0, 0, 0], "joint_rates": [0, 0, 0]}"#;
    fs::write(&states, format!("[{state}]")).expect("written");
    fs::write(&bad, format!("[{}]", state.replacen("0.1", "\"0.1\"", 1))).expect("written");
    assert!(command().args(["export", "single_arm_3r", "--out", &urdf]).status().expect("it runs").success());
    let products: [&[&str]; 3] =
        [&["eval", "single_arm_3r", &states], &["export", "single_arm_3r"], &["import", &urdf]];
    for arguments in products {
        let (code, err) = printing_to(Unwritable::Full, arguments);
        assert_eq!(code, 2, "{arguments:?}");
        assert!(err.contains("cannot write to standard output"), "{arguments:?}: {err}");
        assert_eq!(printing_to(Unwritable::Closed, arguments).0, 0, "{arguments:?}");
    }
    for out in BOTH {
        let (code, err) = printing_to(out, &["eval", "single_arm_3r", &bad]);
        assert_eq!(code, 2, "{out:?}");
        assert!(err.contains("joint_angles"), "{out:?}: {err}");
    }
}

/// With `--format json` the standard output is the product of a run: a full disk loses it; a closed pipe changes nothing.
#[test]
fn summaries_that_are_lost_are_an_error() {
    let folder = TempDir::new().expect("a folder");
    let [poor, good] = approaches(folder.path());
    let out = folder.path().join("results").display().to_string();
    let json = |scenarios: &[&str], to: Unwritable| {
        let mut arguments = vec!["run", "--format", "json", "--out", &out, "--force"];
        arguments.extend(scenarios);
        printing_to(to, &arguments)
    };
    for (scenario, expected) in [(&poor, 1), (&good, 0)] {
        assert_eq!(json(&[scenario], Unwritable::Closed).0, expected);
        let (code, err) = json(&[scenario], Unwritable::Full);
        assert_eq!(code, 2, "{err}");
        assert!(err.contains("cannot write to standard output"), "{err}");
        assert!(Path::new(&out).join("summary.json").exists());
        fs::remove_dir_all(&out).expect("removed");
    }
    assert_eq!(json(&[&poor, &good], Unwritable::Closed).0, 1);
    let (code, err) = json(&[&good, &poor], Unwritable::Full);
    assert_eq!((code, err.matches("cannot write to standard output").count()), (2, 1), "{err}");
    assert!(Path::new(&out).join("poor/summary.json").exists(), "the files are complete");
}
