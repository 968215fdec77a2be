//! `planar-capture animate SCENARIO --out FILE.svg`: a moving picture of a case.

use super::dynamics::Dynamics;
use super::out_file::{Force, check_new, svg, write_new};
use super::progress::{Display, Progress};
use super::run::study_error;
use super::seconds::{positive_seconds, seconds};
use super::terminal::note;
use super::{CommandError, cases};
use crate::capture::study_registered;
use crate::output::animation::{Excerpt, RATE, animation};
use crate::program::Program;
use crate::scenario::Scenario;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture animate scenarios/stabilised_capture.toml --until 60 --out capture.svg
  planar-capture animate scenarios/raina_shah_2017.toml --case case3 --seconds 20 --out case3.svg";

/// Write a moving picture of a case, as SVG that browsers play in any page.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The scenario file.
    #[arg(value_name = "SCENARIO")]
    scenario: PathBuf,
    /// The SVG file [default: the standard output].
    #[arg(long, value_name = "FILE.svg", value_parser = svg)]
    out: Option<PathBuf>,
    #[command(flatten)]
    force: Force,
    /// The case, by its name [default: the first one].
    #[arg(long, value_name = "NAME")]
    case: Option<String>,
    /// How long the picture plays, s, from 1 to 120.
    #[arg(long, value_name = "SECONDS", default_value = "12", value_parser = playing_time)]
    seconds: f64,
    /// The end of what is shown, s since the start of the approach [default: the end of the motion].
    #[arg(long, value_name = "SECONDS", value_parser = positive_seconds)]
    until: Option<f64>,
    /// The implementation of the dynamics.
    #[arg(long, value_enum, default_value_t = Dynamics::Auto)]
    dynamics: Dynamics,
    #[command(flatten)]
    display: Display,
}

fn playing_time(text: &str) -> Result<f64, String> {
    let value = seconds(text)?;
    if (1.0..=120.0).contains(&value) { Ok(value) } else { Err("expected 1 to 120 s".to_owned()) }
}

/// Computes the case alone and writes the picture.
pub fn run(arguments: &Arguments, program: Program<'_>) -> Result<ExitCode, CommandError> {
    check_new(arguments.out.as_deref(), &arguments.force)?;
    let (mut scenario, source) = Scenario::read_with_source(&arguments.scenario, program.known())?;
    let names = scenario.case_names();
    let wanted = arguments.case.as_deref().unwrap_or(names.first().copied().unwrap_or_default()).to_owned();
    cases::retain(&mut scenario, std::slice::from_ref(&wanted), &arguments.scenario.display().to_string())?;
    let variant = scenario.variant(&wanted).cloned();
    if let Some(variant) = &variant {
        scenario = variant.scenario.clone();
    }
    let choice = arguments.dynamics.choose(&scenario.layout, &source.scenario.file, program.robots)?;
    if !arguments.display.quiet {
        arguments.dynamics.announce(&choice, &source.layout.file, "");
    }
    let after = scenario.post_impact.as_ref().map_or(0.0, |phase| phase.duration);
    let end = scenario.approach.duration + after;
    if let Some(until) = arguments.until.filter(|until| *until > end) {
        note(format_args!(
            "warning: --until {until:?} s is beyond the end of the motion, {end:?} s: it is shown to there"
        ));
    }
    let until = arguments.until.map_or(end, |until| until.min(end));
    let sample = until / (arguments.seconds * RATE);
    let model = choice.model(&scenario.layout);
    let mut progress = Progress::new(arguments.display);
    let result = study_registered(&scenario, &|| model.clone_box(), program.laws, sample, &mut progress);
    progress.finish();
    let study = result.map_err(|error| study_error(&error, &scenario, variant.as_ref(), &source.scenario))?;
    write_new(
        arguments.out.as_deref(),
        &arguments.force,
        &animation(&scenario, &study, &study.cases[0], Excerpt { seconds: arguments.seconds, until }),
    )?;
    Ok(ExitCode::SUCCESS)
}
