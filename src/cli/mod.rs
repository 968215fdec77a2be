//! Arguments, exit codes and what is printed where: results to stdout, problems and progress to stderr.

mod check;
mod compare;
mod dynamics;
mod eval;
mod export;
mod extra;
mod generate;
mod import;
mod layout;
mod progress;
mod reproduce;
mod run;
mod text;

use clap::{Parser, Subcommand};
use planar_capture::capture::StudyError;
use planar_capture::diagnostic::Report;
use planar_capture::eval::StateError;
use planar_capture::generate::{DerivationError, GenerateError};
use planar_capture::output::atomic_file::OutputError;
use planar_capture::registry::NoModel;
use planar_capture::urdf::UrdfError;
use std::io::IsTerminal;
use std::process::ExitCode;

/// Planar dynamics of free-floating multi-arm space robots: approach, impact, post-impact.
#[derive(Debug, Parser)]
#[command(version, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compute a scenario: the approach, and for every case the impact and what follows.
    Run(run::Arguments),
    Eval(eval::Arguments),
    Compare(compare::Arguments),
    Generate(generate::Arguments),
    Check(check::Arguments),
    Import(import::Arguments),
    Export(export::Arguments),
    Reproduce(reproduce::Arguments),
}

/// Why there is no result.
#[derive(Debug, thiserror::Error)]
enum Problem {
    /// An input file is wrong.
    #[error("{}", .0.render(color()))]
    Input(#[from] Report),
    /// No generated code fits.
    #[error("error: {file}: {source}")]
    Model { file: String, source: Box<NoModel> },
    /// An argument names no layout.
    #[error(
        "error: there is no shipped layout `{name}`; {meant}shipped: {shipped}; a path ends in `.toml` or contains a `/`"
    )]
    NoLayout { name: String, meant: String, shipped: String },
    /// The states cannot be read.
    #[error("error: {file}: {source}")]
    States { file: String, source: StateError },
    /// A state has no answer.
    #[error("error: {file}: state {index}: {source}")]
    Evaluation { file: String, index: usize, source: planar_capture::error::Error },
    /// Arguments that do not go together.
    #[error("error: {0}")]
    Usage(&'static str),
    /// This build lacks what is asked for.
    #[error("error: {0}")]
    Lacking(extra::Lacking),
    /// A file in the way that nobody generated.
    #[error("error: {file} is there already and was not generated: name another file, or move it away first")]
    NotGenerated { file: String },
    /// A result has no folder to go to.
    #[error("error: cannot write {file}: there is no folder {folder}; make it first")]
    NoFolder { file: String, folder: String },
    /// A file in the way that would be lost.
    #[error("error: {file} is there already: name another file, or move it away first")]
    Exists { file: String },
    /// A graph has to have its layout's name.
    #[error("error: {file}: build scripts look for the graph of layout `{name}` in {name}.json: use that name")]
    GraphName { file: String, name: String },
    /// No equations were derived.
    #[error("error: {file}: {source}")]
    Derivation { file: String, source: DerivationError },
    /// What was derived is not code.
    #[error("error: {file}: {source}")]
    Generate { file: String, source: GenerateError },
    /// A robot that no layout can describe.
    #[error("error: {file}: {source}")]
    Urdf { file: String, source: UrdfError },
    /// A computation has no answer.
    #[error("error: {file}: {source}")]
    Study { file: String, source: StudyError },
    /// A figure cannot be drawn.
    #[cfg(feature = "figures")]
    #[error("error: {0}")]
    Draw(#[from] planar_capture::output::figures::draw::DrawError),
    /// The paper's study came to nothing.
    #[cfg(feature = "figures")]
    #[error("error: {0}")]
    Reproduction(#[from] planar_capture::reproduction::ReproductionError),
    /// A result cannot be written.
    #[error("error: {0}")]
    Output(#[from] OutputError),
    /// The standard output is gone.
    #[error("error: cannot write to standard output: {0}")]
    Print(#[from] std::io::Error),
}

impl Problem {
    /// 2 for input that cannot be worked with, 1 where the physics came to nothing on the way or a check failed.
    fn exit_code(&self) -> u8 {
        match self {
            Self::Study {
                source: StudyError::Approach(stopped) | StudyError::PostImpact { source: stopped, .. },
                ..
            } if !stopped.is_misuse() => 1,
            Self::Generate { source: GenerateError::Disagreement { .. }, .. } => 1,
            _ => 2,
        }
    }
}

/// Whether problems are shown in colour.
fn color() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Runs the command line.
pub fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Eval(arguments) => eval::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Generate(arguments) => generate::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Import(arguments) => import::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Reproduce(arguments) => reproduce::run(&arguments),
    };
    match result {
        Ok(code) => code,
        // whoever reads has read enough: `| head`
        Err(Problem::Print(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::from(problem.exit_code())
        }
    }
}
