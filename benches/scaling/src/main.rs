//! Cost over the number of arms and links: derives, compiles and evaluates robots from one arm of two links to four arms of
//! ten, and writes `docs/scaling.md` and `docs/scaling.svg`.

#![allow(clippy::disallowed_methods, reason = "what is measured does not depend on the last bit")]

mod compilation;
mod derivation;
mod evaluation;
mod figure;
mod fit;
mod report;
mod shape;

use compilation::{Compilation, compile};
use derivation::Derivation;
use evaluation::{Evaluation, evaluate};
use fit::Fit;
use planar_capture::output::atomic_file::write_text;
use shape::Shape;
use std::path::Path;
use std::process::ExitCode;

/// Any error.
type Problem = Box<dyn std::error::Error>;

/// Repetitions of each timing; the fastest counts, because of other programs on the machine.
const REPEATS: u32 = 3;

/// The measurements of one robot.
#[derive(Debug)]
struct Row {
    shape: Shape,
    derivation: Derivation,
    release: Compilation,
    debug: Compilation,
    evaluation: Evaluation,
}

fn main() -> ExitCode {
    match measure() {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}

fn measure() -> Result<(), Problem> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (work, documents) = (here.join("target/work"), here.join("../../docs"));
    std::fs::create_dir_all(&documents)?;
    eprintln!("preparing the environment of the derivation");
    planar_capture::generate::derive(
        &Shape { arms: 1, links: 2 }.layout(),
        &[],
        planar_capture::python_package::PYTHON_PACKAGE,
        &mut |_| {},
    )?;
    let mut derived = Vec::new();
    for shape in Shape::all() {
        eprintln!("{}: deriving", shape.name());
        derived.push((shape, Derivation::of(shape)?));
    }
    let mut compiled = Vec::new();
    for (shape, derivation) in &derived {
        eprintln!("{}: compiling", shape.name());
        let build = |release| compile(&derivation.standalone, &work.join(shape.name()), release);
        compiled.push((build(true)?, build(false)?));
    }
    let evaluated = evaluate(&derived, &work)?;
    let rows: Vec<Row> = derived
        .into_iter()
        .zip(compiled)
        .zip(evaluated)
        .map(|(((shape, derivation), (release, debug)), evaluation)| Row {
            shape,
            derivation,
            release,
            debug,
            evaluation,
        })
        .collect();
    let counts: Vec<_> = rows.iter().map(|row| (row.shape, row.derivation.flops("forward_dynamics"))).collect();
    let fit = Fit::of(&counts).ok_or("too few robots for a fit")?;
    let report = report::write(&rows)?;
    write_text(&documents.join("scaling.md"), &report)?;
    let drawing = figure::draw(&rows, fit);
    write_text(&documents.join("scaling.svg"), &drawing)?;
    print!("{report}");
    Ok(())
}
