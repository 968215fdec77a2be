//! `planar-capture run SCENARIO.toml`: simulates a scenario and writes its results.

use super::CommandError;
use super::dynamics::Dynamics;
use super::optional_outputs::{self, file_per_case};
use super::progress::{Display, Progress};
use super::terminal::{note, print};
use crate::capture::{Study, StudyError, study};
use crate::check::help_with_gains;
use crate::engine::Choice;
use crate::output::console::table;
use crate::output::html_report::write_report;
use crate::output::result_folder::ResultFolder;
use crate::output::run_folder::{SUMMARY, objection};
use crate::output::run_manifest::RunManifest;
use crate::output::summary::summary;
use crate::output::time_series::write_csv;
use crate::registry::Robots;
use crate::scenario::{Scenario, Source};
use serde_json::Value;
use std::env::consts::EXE_SUFFIX;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Time between two rows where it is not given, s.
const DEFAULT_SAMPLE: f64 = 0.05;

#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The scenario file.
    scenario: PathBuf,
    /// Folder for summary.json and the CSV time series [default: results/NAME, NAME the scenario's].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace the files in DIR, whatever they are; not folders in it, hidden files or your home folder.
    #[arg(long)]
    force: bool,
    /// The implementation of the dynamics.
    #[arg(long, value_enum, default_value_t = Dynamics::Auto)]
    dynamics: Dynamics,
    /// Write report.html too: an animation with plots that opens in any browser, without a network.
    #[arg(long)]
    report: bool,
    /// Time between two rows of the CSV time series, s; at least one step of the scenario [default: 0.05].
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    sample: Option<f64>,
    #[command(flatten)]
    display: Display,
    #[command(flatten)]
    optional_outputs: optional_outputs::Flags,
}

/// What another command chooses of a run.
#[cfg(feature = "sweep")]
pub struct RunOptions {
    /// The folder for the results, which is this command's own.
    pub out: PathBuf,
    /// What computes the dynamics.
    pub choice: Choice,
    /// Whether to write report.html.
    pub report: bool,
    /// How progress is shown.
    pub display: Display,
}

/// Runs a scenario file for another command.
#[cfg(feature = "sweep")]
pub fn run_file(
    scenario: &Path,
    RunOptions { out, choice, report, display }: RunOptions,
    robots: Robots<'_>,
) -> Result<ExitCode, CommandError> {
    let scenario = scenario.to_owned();
    let (dynamics, optional_outputs) = (Dynamics::Auto, optional_outputs::Flags::default());
    let arguments =
        Arguments { scenario, out: Some(out), force: true, dynamics, report, sample: None, display, optional_outputs };
    run_by(&arguments, robots, Some(choice))
}

fn positive(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "expected a number of seconds".to_owned())?;
    if value.is_finite() && value > 0.0 { Ok(value) } else { Err("expected a time greater than 0 s".to_owned()) }
}

/// Computes the study, writes its files and prints its table; exit code 1 if the audit fails.
pub fn run(arguments: &Arguments, robots: Robots<'_>) -> Result<ExitCode, CommandError> {
    run_by(arguments, robots, None)
}

/// The same, by what another command has chosen to compute the dynamics.
fn run_by(arguments: &Arguments, robots: Robots<'_>, chosen: Option<Choice>) -> Result<ExitCode, CommandError> {
    optional_outputs::require(&arguments.optional_outputs.requested())?;
    let (scenario, source) = Scenario::read_with_source(&arguments.scenario, &robots.layouts())?;
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new("results").join(&scenario.name));
    let keep = [&source.scenario.file, &source.layout.file].map(Path::new);
    let objection = |folder: &Path, names: &[String]| objection(folder, names, &scenario.name);
    let folder = ResultFolder::claim(&folder, arguments.force, &keep, &objection)?;
    if let Some((sample, step)) = arguments.sample.and_then(|sample| Some((sample, longer_step(&scenario, sample)?))) {
        note(format_args!(
            "warning: --sample {sample:?} s is shorter than the scenario's step of {step:?} s: rows are at every step"
        ));
    }
    let file = &source.scenario.file;
    let choice = match chosen {
        Some(choice) => choice,
        None => arguments.dynamics.choose(&scenario.layout, file, robots, arguments.display.quiet)?,
    };
    let model = choice.model(&scenario.layout);
    let mut progress = Progress::new(arguments.display);
    let result = study(&scenario, &|| model.clone_box(), arguments.sample.unwrap_or(DEFAULT_SAMPLE), &mut progress);
    progress.finish();
    let study = result.map_err(|error| study_error(&error, &scenario, &source.scenario))?;
    let failures = study.audit_failures();
    let code = if failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) };
    let shown = folder.path().display().to_string();
    let manifest = RunManifest::new(&scenario, source, command());
    let summary = summary(&scenario, choice.engine.name(), &study, &manifest)
        .map_err(|source| CommandError::Numbers { file: arguments.scenario.display().to_string(), source })?;
    write_results(&folder, &scenario, arguments, &study, (&manifest, summary))?;
    print(&format!("{}\nResults in {shown}\n", table(&scenario, &study)));
    for failure in &failures {
        note(format_args!("audit: {failure}"));
    }
    if failures.iter().any(|failure| failure.contains("over its bound")) {
        note("a smaller `tolerance`, or with a fixed integrator a shorter `step`, makes drifts and errors smaller");
    }
    Ok(code)
}

/// The longest step of a phase that is longer than the interval of rows, s.
fn longer_step(scenario: &Scenario, sample: f64) -> Option<f64> {
    let steps = [Some(scenario.approach.step), scenario.post_impact.as_ref().map(|phase| phase.step)];
    // the least that is not rounding
    steps.into_iter().flatten().filter(|step| sample < step * (1.0 - 1e-6)).reduce(f64::max)
}

/// The error at its key in the scenario; exit code 1 where a valid simulation broke down.
fn study_error(error: &StudyError, scenario: &Scenario, source: &Source) -> CommandError {
    let stopped = match error {
        StudyError::Approach(stopped) => Some(("approach", stopped)),
        StudyError::PostImpact { source, .. } => Some(("post_impact", source)),
        _ => None,
    };
    let exit_code = if stopped.is_some_and(|(_, stopped)| !stopped.is_misuse()) { 1 } else { 2 };
    let help = stopped.and_then(|(phase, _)| help_with_gains(scenario, phase));
    let report = error.report(scenario, &source.text, &source.file, help);
    CommandError::Computation { report, exit_code }
}

/// Writes all files before the first gets its place, so that a full disk leaves no mixture of two runs.
fn write_results(
    folder: &ResultFolder<'_>,
    scenario: &Scenario,
    arguments: &Arguments,
    study: &Study,
    (manifest, mut summary): (&RunManifest, Value),
) -> Result<(), CommandError> {
    let staged = folder.stage()?;
    file_per_case(&staged, study, "csv", |case, to| write_csv(scenario, study, case, to))?;
    if arguments.report {
        staged.write("report.html", |to| write_report(scenario, study, manifest, to))?;
    }
    for output in arguments.optional_outputs.requested() {
        output.write(&staged, scenario, study, manifest)?;
    }
    let mut files = staged.files()?;
    files.push(SUMMARY.to_owned());
    files.sort();
    summary["files"] = files.into();
    staged.write(SUMMARY, |to| {
        serde_json::to_writer_pretty(&mut *to, &summary)?;
        writeln!(to)
    })?;
    Ok(folder.commit(staged, SUMMARY)?)
}

/// The command line, as it can be typed again.
fn command() -> String {
    let mut words: Vec<_> = std::env::args_os().map(|argument| argument.to_string_lossy().into_owned()).collect();
    if let Some(program) = words.first_mut() {
        // without the folder, in which others do not have it
        let name = Path::new(program).file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        name.strip_suffix(EXE_SUFFIX).unwrap_or(&name).clone_into(program);
    }
    // only a NUL cannot be quoted, which no argument has
    shlex::try_join(words.iter().map(String::as_str)).unwrap_or_default()
}
