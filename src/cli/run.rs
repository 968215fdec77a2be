//! `planar-capture run SCENARIO.toml`: simulates a scenario and writes its results.

use super::dynamics::Dynamics;
use super::progress::{Display, Progress};
use super::terminal::{note, print};
use super::{CommandError, file_error, optional_outputs};
use planar_capture::capture::scenario_key::ScenarioKey;
use planar_capture::capture::{Study, StudyError, study};
use planar_capture::diagnostic::report_error;
use planar_capture::output::atomic_file::{StagedFile, create_folder};
use planar_capture::output::console::table;
use planar_capture::output::html_report::write_report;
use planar_capture::output::summary::summary;
use planar_capture::output::time_series::write_csv;
use planar_capture::registry;
use planar_capture::scenario::{Scenario, Source};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The scenario file.
    scenario: PathBuf,
    /// Folder for summary.json and the CSV time series [default: results/NAME, NAME the scenario's].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The implementation of the dynamics.
    #[arg(long, value_enum, default_value_t = Dynamics::Generated)]
    dynamics: Dynamics,
    /// Write report.html too: an animation with plots that opens in any browser, without a network.
    #[arg(long)]
    report: bool,
    /// Time between two rows of the CSV time series, s.
    #[arg(long, value_name = "SECONDS", default_value = "0.05", value_parser = positive)]
    sample: f64,
    #[command(flatten)]
    display: Display,
    #[command(flatten)]
    optional_outputs: optional_outputs::Flags,
}

fn positive(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "expected a number of seconds".to_owned())?;
    if value.is_finite() && value > 0.0 { Ok(value) } else { Err("expected a time greater than 0 s".to_owned()) }
}

/// Computes the study, writes its files and prints its table; exit code 1 if the audit fails.
pub fn run(arguments: &Arguments) -> Result<ExitCode, CommandError> {
    optional_outputs::require(&arguments.optional_outputs.requested())?;
    let (scenario, source) = Scenario::read_with_source(&arguments.scenario, registry::SHIPPED)?;
    let model = arguments.dynamics.model(&scenario.layout).map_err(file_error(&source.scenario.file))?;
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new("results").join(&scenario.name));
    let mut progress = Progress::new(arguments.display);
    let result = study(&scenario, &|| model.clone_box(), arguments.sample, &mut progress);
    progress.finish();
    let study = result.map_err(|error| study_error(&error, &scenario, &source.scenario))?;
    let failures = study.audit_failures();
    let code = if failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) };
    write_results(&folder, &scenario, arguments, &study)?;
    print(&format!("{}\nResults in {}\n", table(&scenario, &study), folder.display()));
    for failure in &failures {
        note(format_args!("audit: {failure}"));
    }
    if failures.iter().any(|failure| failure.contains("over its bound")) {
        note("a shorter `step`, or `integrator = \"adaptive\"`, makes drifts and errors smaller");
    }
    Ok(code)
}

/// The error at its key in the scenario; exit code 1 where a valid simulation broke down.
fn study_error(error: &StudyError, scenario: &Scenario, source: &Source) -> CommandError {
    let exit_code = match error {
        StudyError::Approach(stopped) | StudyError::PostImpact { source: stopped, .. } if !stopped.is_misuse() => 1,
        _ => 2,
    };
    let ScenarioKey { path, value } = error.key(scenario);
    let report = report_error(&source.text, &source.file, (&path, &value), &error.to_string());
    CommandError::Computation { report, exit_code }
}

/// Writes all files before the first gets its name, so that a full disk leaves no mixture of two runs.
fn write_results(folder: &Path, scenario: &Scenario, arguments: &Arguments, study: &Study) -> Result<(), CommandError> {
    create_folder(folder)?;
    let mut files =
        optional_outputs::file_per_case(folder, study, "csv", |case, to| write_csv(scenario, study, case, to))?;
    let summary = summary(scenario, arguments.dynamics.name(), study);
    files.push(StagedFile::new(&folder.join("summary.json"), |to| {
        serde_json::to_writer_pretty(&mut *to, &summary)?;
        writeln!(to)
    })?);
    if arguments.report {
        files.push(StagedFile::new(&folder.join("report.html"), |to| write_report(scenario, study, to))?);
    }
    for output in arguments.optional_outputs.requested() {
        files.extend(output.stage(folder, scenario, study)?);
    }
    files.into_iter().try_for_each(StagedFile::commit)?;
    Ok(())
}
