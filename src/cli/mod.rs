//! The command line: results on the standard output, errors and progress on the standard error, exit codes.
//!
//! [`main_with`] is the same command line for a program of one's own, with the robots that are compiled into it.
//!
//! # Example
//! The program of a crate with no robot or law of its own; `planar-capture new` writes one with a robot.
//! ```no_run
//! use std::process::ExitCode;
//!
//! fn main() -> ExitCode {
//!     planar_capture::cli::main_with_laws(&[], &[])
//! }
//! ```

#![warn(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "`println!` and `eprintln!` panic where they cannot write: `terminal` prints"
)]

mod animate;
mod cases;
mod check;
mod compare;
mod completions;
mod derive;
mod draw;
mod dynamics;
mod eval;
mod export;
mod file_format;
mod generate;
mod help;
mod import;
mod layout;
mod list;
mod new;
mod optional_outputs;
mod out_file;
mod out_folder;
mod progress;
mod reproduce;
mod run;
mod schema;
mod seconds;
#[cfg(feature = "sweep")]
mod sweep;
mod template;
mod terminal;

#[cfg(feature = "sweep")]
use crate::campaign::report::ReportError;
use crate::diagnostic::Report;
use crate::laws::RegisteredLaw;
use crate::output::finite::NotFinite;
use crate::output::output_error::OutputError;
use crate::output::result_folder::ClaimError;
use crate::program::Program;
use crate::registry::{CompiledRobot, Robots};
use clap::{Parser, Subcommand};
use std::error::Error;
use std::io::{ErrorKind, IsTerminal, Write};
use std::process::ExitCode;

/// Planar dynamics of free-floating multi-arm space robots: approach, impact, post-impact.
#[derive(Debug, Parser)]
#[command(version, arg_required_else_help = true, max_term_width = 100, disable_help_subcommand = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::Arguments),
    #[cfg(feature = "sweep")]
    Sweep(sweep::Arguments),
    Animate(animate::Arguments),
    Draw(draw::Arguments),
    Eval(eval::Arguments),
    Compare(compare::Arguments),
    Generate(generate::Arguments),
    Derive(derive::Arguments),
    New(new::Arguments),
    Check(check::Arguments),
    Import(import::Arguments),
    Export(export::Arguments),
    Reproduce(reproduce::Arguments),
    List(list::Arguments),
    Template(template::Arguments),
    Schema(schema::Arguments),
    Completions(completions::Completions),
    Man(completions::Manual),
}

/// Why a command has no result.
#[derive(Debug, thiserror::Error)]
enum CommandError {
    /// An input file is invalid.
    #[error("{}", .0.render(color()))]
    Input(#[from] Report),
    /// The arguments, or the files that they name, do not permit the command.
    #[error("error: {0}")]
    Usage(String),
    /// The content of an input file has no result.
    #[error("error: {file}: {source}")]
    File { file: String, source: Box<dyn Error>, exit_code: u8 },
    /// A computation has no result, by a value of an input file.
    #[error("{}", .report.render(color()))]
    Computation { report: Report, exit_code: u8 },
    /// A figure or the reproduction report failed.
    #[cfg(feature = "figures")]
    #[error("error: {0}")]
    Figures(Box<dyn Error>),
    /// A result cannot be written.
    #[error("error: {0}")]
    Output(#[from] OutputError),
    /// There is no report on a sweep.
    #[cfg(feature = "sweep")]
    #[error("error: {0}")]
    SweepReport(#[from] ReportError),
    /// Results are not to be written to a folder.
    #[error("error: {0}")]
    Folder(#[from] ClaimError),
    /// A result is no number.
    #[error("error: {file}: {source}")]
    Numbers { file: String, source: NotFinite },
    /// The standard output, which is the product of the command, cannot be written.
    #[error("error: cannot write to standard output: {0}")]
    Print(#[from] std::io::Error),
}

/// Converts an error about an input file, with exit code 2.
fn file_error<E: Error + 'static>(file: &str) -> impl FnOnce(E) -> CommandError {
    move |source| CommandError::File { file: file.to_owned(), source: source.into(), exit_code: 2 }
}

impl CommandError {
    /// 2 for unsuitable input, 1 if a computation broke down or a check failed.
    fn exit_code(&self) -> u8 {
        match self {
            Self::File { exit_code, .. } | Self::Computation { exit_code, .. } => *exit_code,
            Self::Numbers { .. } => 1,
            _ => 2,
        }
    }
}

/// Whether messages on the standard error are coloured.
fn color() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Writes a text, which is the product of the command, to the standard output.
fn print_product(text: &str) -> Result<(), CommandError> {
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes())?;
    // what is still in the buffer at the end of the process is lost without an error
    Ok(out.flush()?)
}

/// Runs the command line of `planar-capture`.
#[must_use]
pub fn main() -> ExitCode {
    main_with(&[])
}

/// Runs the command line with robots of one's own ([`robot!`](crate::robot)): they are known by their names wherever a
/// shipped layout is, and `--dynamics auto` and `generated` find their code.
#[must_use]
pub fn main_with(robots: &[CompiledRobot]) -> ExitCode {
    main_with_laws(robots, &[])
}

/// Makes a file that grows beyond what the system allows (`ulimit -f`) an error of its writing, as on a full disk: by default a
/// signal ends the process without a word.
fn report_long_files() {
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
}

/// As [`main_with`], with control laws of one's own beside the robots: a scenario names one by `tracking = "NAME"` or,
/// after the capture, `control = "NAME"`, and gives its numbers in `[approach.law]` or `[post_impact.law]`.
#[must_use]
pub fn main_with_laws(robots: &[CompiledRobot], laws: &[RegisteredLaw]) -> ExitCode {
    report_long_files();
    let program = Program { robots: Robots::with(robots), laws };
    let robots = program.robots;
    let command = help::parse().command;
    if let Some(name) = program.repeated_law() {
        terminal::note(format_args!(
            "error: two control laws have the name `{name}`: each law of a program has a name of its own, and none that \
             `planar-capture list` shows"
        ));
        return ExitCode::from(2);
    }
    let result = match command {
        Command::Run(arguments) => run::run(&arguments, program),
        #[cfg(feature = "sweep")]
        Command::Sweep(arguments) => sweep::run(&arguments, program),
        Command::Animate(arguments) => animate::run(&arguments, program),
        Command::Draw(arguments) => draw::run(&arguments, robots),
        Command::Eval(arguments) => eval::run(&arguments, robots),
        Command::Compare(arguments) => compare::run(&arguments, robots),
        Command::Generate(arguments) => generate::run(&arguments, robots),
        Command::Derive(arguments) => derive::run(&arguments, robots),
        Command::New(arguments) => new::run(&arguments, robots),
        Command::Check(arguments) => check::run(&arguments, program),
        Command::Import(arguments) => import::run(&arguments),
        Command::Export(arguments) => export::run(&arguments, robots),
        Command::Reproduce(arguments) => reproduce::run(&arguments),
        Command::List(arguments) => list::run(&arguments, program),
        Command::Template(arguments) => template::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments, program),
        Command::Completions(arguments) => completions::completions(&arguments),
        Command::Man(arguments) => completions::manual(&arguments),
    };
    match result {
        Ok(code) => code,
        // the product goes to a reader that has closed the pipe, for example `| head`
        Err(CommandError::Print(error)) if error.kind() == ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            terminal::note(&error);
            ExitCode::from(error.exit_code())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::CommandError;
    use crate::output::finite::finite;
    use serde_json::json;

    /// Numbers that are none come from a computation, whatever its input was.
    #[test]
    fn exit_codes_tell_computations_from_inputs() {
        let source = finite(json!({"energy": f64::INFINITY})).expect_err("no number");
        assert_eq!(CommandError::Numbers { file: "it.toml".to_owned(), source }.exit_code(), 1);
        assert_eq!(CommandError::Usage("it".to_owned()).exit_code(), 2);
        let source = std::io::Error::other("it").into();
        assert_eq!(CommandError::File { file: "it.toml".to_owned(), source, exit_code: 1 }.exit_code(), 1);
    }
}
