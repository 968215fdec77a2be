//! The derivation's own tests, and the committed graphs against the layouts.
//!
//! `PLANAR_CAPTURE_NO_PYTHON=1` leaves these out and says so; without Python they fail and say what to install.

use std::io::Write;
use std::process::{Command, Output};

/// Interpreters to look for, best first.
const PYTHONS: [&str; 5] = ["python3", "python3.13", "python3.12", "python3.11", "python"];
const OLDEST: &str = "import sys; sys.exit(sys.version_info < (3, 11))";

/// A Python of 3.11 or newer, as a message where there is none.
pub fn python() -> Result<&'static str, String> {
    let works = |name: &&str| Command::new(name).args(["-c", OLDEST]).output().is_ok_and(|out| out.status.success());
    PYTHONS.into_iter().find(|name| works(name)).ok_or_else(|| {
        format!(
            "the derivation's tests need Python 3.11 or newer with venv, and none of {} is that.\n\
             Install it (Debian, Ubuntu: apt install python3 python3-venv), or set PLANAR_CAPTURE_NO_PYTHON=1 to run the \
             other tests only",
            PYTHONS.join(", ")
        )
    })
}

/// Runs `python -m codegen` with these arguments from the repository's root; `None` where the environment excludes
/// Python.
fn codegen(arguments: &[&str]) -> Option<Output> {
    if std::env::var("PLANAR_CAPTURE_NO_PYTHON").is_ok_and(|value| value == "1") {
        // straight to the stream: what the macros print is shown for failing tests only
        let _ = writeln!(
            std::io::stderr(),
            "skipped, for PLANAR_CAPTURE_NO_PYTHON=1: python -m codegen {}",
            arguments.join(" ")
        );
        return None;
    }
    let python = python().unwrap_or_else(|message| panic!("{message}"));
    let mut command = Command::new(python);
    command.args(["-m", "codegen"]).args(arguments).current_dir(planar_proof::file(""));
    Some(command.output().expect("a program that was found runs"))
}

#[track_caller]
fn assert_succeeds(arguments: &[&str]) {
    let Some(output) = codegen(arguments) else { return };
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    println!("{out}{err}");
    assert!(output.status.success(), "python -m codegen {} failed:\n{out}{err}", arguments.join(" "));
}

#[test]
fn graphs_are_what_the_layouts_give() {
    assert_succeeds(&["--check"]);
}

#[test]
fn derivation_agrees_with_the_lagrangian() {
    assert_succeeds(&["--test"]);
}
