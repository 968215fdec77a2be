//! Cost and accuracy of the integrators: the paper's approach and free motion by every integrator in both coordinates.
//! Writes `docs/integrators.md` with its figures, or checks that they are up to date.
//!
//! Work is counted in evaluations of the derivative, which does not depend on the machine, but for the last bit of its
//! `pow`.

#![allow(clippy::disallowed_methods, reason = "what is reported has a few digits")]

mod figure;
mod long_time;
mod method;
mod motion;
mod report;
mod work;

use planar_capture::output::atomic_file::{create_folder, write_text};
use planar_capture::output::figures::Width;
use planar_capture::output::figures::draw::svg;
use std::path::Path;
use std::process::ExitCode;

/// Any error.
type Problem = Box<dyn std::error::Error>;

const MEND: &str = "cargo run --release --manifest-path benches/integrators/Cargo.toml";

fn main() -> ExitCode {
    let check = std::env::args().skip(1).any(|argument| argument == "--check");
    match compute().and_then(|files| if check { compare(&files) } else { write(&files) }) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}

/// Path below `docs`, and content.
fn compute() -> Result<Vec<(&'static str, String)>, Problem> {
    let works = [work::approach()?, work::tumbling()?];
    let motions = long_time::motions()?;
    Ok(vec![
        ("integrators.md", report::write(&works, &motions)?),
        ("integrators/work_precision.svg", svg(&figure::work_precision(&works), Width::Page)),
        ("integrators/long_time.svg", svg(&figure::long_time(&motions), Width::Page)),
    ])
}

fn write(files: &[(&str, String)]) -> Result<(), Problem> {
    for (path, text) in files {
        let path = documents().join(path);
        create_folder(path.parent().ok_or("no folder")?)?;
        write_text(&path, text)?;
    }
    Ok(())
}

fn compare(files: &[(&str, String)]) -> Result<(), Problem> {
    for (path, text) in files {
        if std::fs::read_to_string(documents().join(path)).ok().as_ref() != Some(text) {
            return Err(format!("docs/{path} is not up to date; run: {MEND}").into());
        }
    }
    println!("docs/integrators.md: fresh");
    Ok(())
}

fn documents() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}
