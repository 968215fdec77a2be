//! The command line: commands, output, exit codes and messages for invalid input.

#[cfg(not(feature = "all_layouts"))]
compile_error!("the tests see every layout: `cargo test` in the root, without `-p`, or with `--features all_layouts`");

mod animate;
mod c;
mod case_set;
mod check;
mod closed_output;
mod compare;
mod derivation;
mod derivatives;
mod diagnostics;
mod draw;
mod dynamics;
mod eval;
mod fmu;
mod fmu_motion;
mod formats;
mod generate;
mod hidden_characters;
mod linear_time;
mod new;
mod outlines;
mod own_test;
mod progress;
mod rendering;
mod result_folder;
mod run;
mod several;
mod study_errors;
#[cfg(feature = "sweep")]
mod sweep;
#[cfg(feature = "sweep")]
mod sweep_report;
mod terminal;
mod urdf;
mod urdf_parts;
mod urdf_xml;

use std::process::Command;
#[cfg(unix)]
use std::{path::Path, process::Output, process::Stdio, thread, time::Duration, time::Instant};

/// The installed command.
fn command() -> Command {
    Command::new(env!("CARGO_BIN_EXE_planar-capture"))
}

/// Exit code, standard output and standard error of the product with these arguments.
fn said(arguments: &[&str]) -> (i32, String, String) {
    planar_proof::said(command().args(arguments).output().expect("it runs"))
}

/// A pipe that nobody writes into.
#[cfg(unix)]
fn make_pipe(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().expect("it runs").success());
}

/// What a command with few words said; one that waits for good is ended.
#[cfg(unix)]
fn within_a_minute(mut command: Command) -> Output {
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it runs");
    let begin = Instant::now();
    while child.try_wait().expect("a child").is_none() && begin.elapsed() < Duration::from_secs(60) {
        thread::sleep(Duration::from_millis(10));
    }
    let _ = child.kill();
    child.wait_with_output().expect("it ends")
}
