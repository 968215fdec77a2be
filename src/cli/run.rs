//! `planar-capture run SCENARIO.toml`.

use super::Problem;
use super::dynamics::Dynamics;
use super::extra;
use super::progress::Progress;
use planar_capture::capture::{Study, study};
use planar_capture::output::atomic_file::{Staged, make_folder};
use planar_capture::output::console::table;
use planar_capture::output::html_report::write_report;
use planar_capture::output::summary::summary;
use planar_capture::output::time_series::write_csv;
use planar_capture::registry;
use planar_capture::scenario::Scenario;
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
    /// Which implementation of the dynamics computes it.
    #[arg(long, value_enum, default_value_t = Dynamics::Generated)]
    dynamics: Dynamics,
    /// Write report.html too: a replay with plots that opens in any browser, without a network.
    #[arg(long)]
    report: bool,
    /// Time between two rows of the CSV time series, s.
    #[arg(long, value_name = "SECONDS", default_value = "0.05", value_parser = positive)]
    sample: f64,
    #[command(flatten)]
    extras: extra::Flags,
}

fn positive(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "a number of seconds is wanted".to_owned())?;
    if value.is_finite() && value > 0.0 { Ok(value) } else { Err("a time in s, greater than 0, is wanted".to_owned()) }
}

/// Reads, computes, prints, writes; exit code 1 where the audit objects.
pub fn run(arguments: &Arguments) -> Result<ExitCode, Problem> {
    extra::require(&arguments.extras.asked())?;
    let scenario = Scenario::read(&arguments.scenario, registry::SHIPPED)?;
    let file = || arguments.scenario.display().to_string();
    let model = arguments
        .dynamics
        .model(&scenario.layout)
        .map_err(|source| Problem::Model { file: file(), source: Box::new(source) })?;
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new("results").join(&scenario.name));
    let mut progress = Progress::new();
    let result = study(&scenario, &|| model.clone_box(), arguments.sample, &mut progress);
    progress.finish();
    let study = result.map_err(|source| Problem::Study { file: file(), source })?;
    write_results(&folder, &scenario, arguments, &study)?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "{}\nResults in {}", table(&scenario, &study), folder.display())?;
    let objections = study.objections();
    for objection in &objections {
        eprintln!("audit: {objection}");
    }
    if objections.iter().any(|objection| objection.contains("over its bound")) {
        eprintln!("a shorter `step`, or `integrator = \"adaptive\"`, makes drifts and errors smaller");
    }
    Ok(if objections.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

/// All files are written before the first of them takes its place, so that a full disk leaves no mixture of two runs.
fn write_results(folder: &Path, scenario: &Scenario, arguments: &Arguments, study: &Study) -> Result<(), Problem> {
    make_folder(folder)?;
    let mut files = Vec::new();
    for case in &study.cases {
        let path = folder.join(format!("{}.csv", case.name));
        files.push(Staged::new(&path, |to| write_csv(scenario, study, case, to))?);
    }
    let summary = summary(scenario, arguments.dynamics.name(), study);
    files.push(Staged::new(&folder.join("summary.json"), |to| {
        serde_json::to_writer_pretty(&mut *to, &summary)?;
        writeln!(to)
    })?);
    if arguments.report {
        files.push(Staged::new(&folder.join("report.html"), |to| write_report(scenario, study, to))?);
    }
    for extra in arguments.extras.asked() {
        files.extend(extra.stage(folder, scenario, study)?);
    }
    files.into_iter().try_for_each(Staged::commit)?;
    Ok(())
}
