//! `planar-capture sweep SWEEP.toml`: one case of a scenario many times, with values drawn from distributions.

mod progress;
mod replay;

use super::dynamics::Dynamics;
use super::optional_outputs::{self, FIGURES};
use super::out_folder::out_folder;
use super::progress::Display;
use super::terminal::{note, print};
use super::{CommandError, file_error};
use crate::campaign::Campaign;
use crate::campaign::manifest::claim;
use crate::campaign::outputs::outputs;
use crate::campaign::report::write_report;
use crate::campaign::run::{Plan, Shard, Tally, missing, run as run_plan};
use crate::diagnostic::nearest;
use crate::engine::Choice;
use crate::output::atomic_file::create_folder;
use crate::output::figure_kinds::begins_with;
use crate::output::result_folder::{existing_folder, outside_of_runs};
use crate::program::Program;
use crate::registry::Robots;
use progress::Progress;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread;

/// As shells report a command that SIGINT has ended.
const INTERRUPTED: u8 = 130;

const EXAMPLES: &str = "\
Examples:
  planar-capture sweep scenarios/sweeps/uncertain_capture.toml --report
  planar-capture sweep mine.toml --out shared/mine --shard 2/8
  planar-capture sweep mine.toml --replay 1234 --report

Exit code: 0 done, and a case without a result is a row with its message; 2 unsuitable input, or results that cannot be \
written; 130 interrupted, to go on when it is started again.";

/// Compute one case of a scenario many times, with values drawn from distributions.
///
/// Files of cases that are there already are not computed again: a sweep that was interrupted goes on.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The sweep file.
    sweep: PathBuf,
    /// Folder for manifest.json, cases/, digests/, timing/ and series/ [default: results/NAME, NAME the sweep's].
    #[arg(long, value_name = "DIR", value_parser = out_folder(), help_heading = "Results")]
    out: Option<PathBuf>,
    /// Compute every Nth file of cases only, from the Ith on: for several machines and one folder.
    #[arg(long, value_name = "I/N", value_parser = shard, help_heading = "Computation")]
    shard: Option<Shard>,
    /// Run the case of this index alone, as `run` does, into DIR/replay/INDEX/results.
    #[arg(long, value_name = "INDEX", conflicts_with = "shard", help_heading = "Computation")]
    replay: Option<u64>,
    /// Write DIR/report.html too: percentiles, failures, sensitivities, extremes. With --replay: that of the run.
    #[arg(long, help_heading = "Results")]
    report: bool,
    /// Pictures of the outputs alone of which a name begins with one in LIST, such as `arm1_impulse,least_distance`; needs a build
    /// with the feature `figures` [default: of those on which a key has the strongest effects].
    #[arg(long, value_name = "LIST", value_delimiter = ',', require_equals = true, help_heading = "Results")]
    #[arg(requires = "report", conflicts_with = "replay")]
    figures: Vec<String>,
    /// The implementation of the dynamics.
    #[arg(long, value_enum, default_value_t = Dynamics::Auto, help_heading = "Computation")]
    dynamics: Dynamics,
    /// Threads that compute cases [default: one for each processor].
    #[arg(long, value_name = "NUMBER", value_parser = threads, help_heading = "Computation")]
    threads: Option<NonZero<usize>>,
    #[command(flatten)]
    display: Display,
}

fn shard(text: &str) -> Result<Shard, String> {
    let wrong = || "expected I/N with 1 ≤ I ≤ N, for example 2/8".to_owned();
    let (number, of) = text.split_once('/').ok_or_else(wrong)?;
    let [number, of]: [u64; 2] = [number.parse().map_err(|_| wrong())?, of.parse().map_err(|_| wrong())?];
    Shard::new(number, of).ok_or_else(wrong)
}

fn threads(text: &str) -> Result<NonZero<usize>, String> {
    text.parse().map_err(|_| "expected a whole number of threads, at least 1".to_owned())
}

/// Computes the files that are missing; exit code 0 whatever became of single cases.
pub fn run(arguments: &Arguments, program: Program<'_>) -> Result<ExitCode, CommandError> {
    let mut campaign = Campaign::read(&arguments.sweep, program.known())?;
    campaign.laws = program.laws.to_vec();
    check_figures(&campaign, &arguments.figures)?;
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new("results").join(&campaign.sweep.name));
    existing_folder(&folder)?;
    outside_of_runs(&folder, None)?;
    if let Some(case) = arguments.replay {
        return replay::replay(&campaign, case, &folder, arguments, program);
    }
    let choice = choose(&campaign, arguments.dynamics, program.robots, arguments.display.quiet)?;
    let at_folder = |error| file_error(&campaign.source.file)(error);
    create_folder(&folder)?;
    claim(&folder, &campaign, choice.engine).map_err(at_folder)?;
    let plan = Plan::new(&campaign, &folder, arguments.shard.unwrap_or(Shard::WHOLE))?;
    for damage in &plan.damaged {
        note(format_args!("warning: {damage}: its cases are computed again"));
    }
    let tally = Arc::<Tally>::default();
    let interrupted = Arc::clone(&tally);
    // where there is no handler, the signal ends the process at once: files are whole all the same
    let _ = ctrlc::set_handler(move || interrupted.is_interrupted.store(true, Ordering::Relaxed));
    let threads = arguments.threads.or(thread::available_parallelism().ok()).map_or(1, NonZero::get);
    let progress = Progress::new(arguments.display, plan.cases, &tally);
    let result = run_plan(&campaign, &choice, &folder, &plan, threads, &tally);
    progress.finish();
    result?;
    let missing = missing(&campaign, &folder);
    print(&format!("{}\nResults in {}\n", sentence(&campaign, &plan, &tally, missing), folder.display()));
    if arguments.report {
        write_report(&campaign, &arguments.sweep, &folder, &arguments.figures)?;
        if let Some(part) = campaign.sweep.of_a_part(campaign.sweep.cases - missing) {
            print(&format!("Of the report: {part}\n"));
        }
    }
    if tally.is_interrupted.load(Ordering::Relaxed) {
        note(
            "interrupted: the same command goes on from the files that are complete (`block` cases in each); the cases of \
             others are computed again",
        );
        return Ok(ExitCode::from(INTERRUPTED));
    }
    Ok(ExitCode::SUCCESS)
}

/// Refuses pictures of outputs that the sweep has not, and those that this build does not draw.
fn check_figures(campaign: &Campaign, figures: &[String]) -> Result<(), CommandError> {
    if figures.is_empty() {
        return Ok(());
    }
    optional_outputs::require(&[FIGURES])?;
    let outputs = outputs(&campaign.scenario, &campaign.sweep.collect.outputs);
    let names = || outputs.iter().map(|output| output.name.as_str());
    match figures.iter().find(|word| !names().any(|name| begins_with(name, word))) {
        Some(unknown) => {
            let meant = nearest(unknown, names()).map_or_else(String::new, |name| format!("did you mean `{name}`? "));
            let names = names().collect::<Vec<_>>().join(", ");
            Err(CommandError::Usage(format!(
                "--figures: the sweep has no output `{unknown}`: {meant}expected some of {names}, or their first words"
            )))
        }
        None => Ok(()),
    }
}

/// What computes the cases: chosen for a layout whose numbers that vary are as different from 0 as in the cases.
fn choose(campaign: &Campaign, dynamics: Dynamics, robots: Robots<'_>, quiet: bool) -> Result<Choice, CommandError> {
    let layout = campaign.general_layout();
    let choice = dynamics.choose(&layout, &campaign.scenario_source.scenario.file, robots)?;
    if !quiet {
        dynamics.announce(&choice, &campaign.scenario_source.layout.file, "");
    }
    Ok(choice)
}

/// How many cases ended how, and how many there are not, those of other shards among them.
fn sentence(campaign: &Campaign, plan: &Plan, tally: &Tally, missing: u64) -> String {
    let computed = tally.computed.load(Ordering::Relaxed);
    let counts = tally.counts().filter(|(_, count)| *count > 0);
    let mut parts: Vec<String> = counts.map(|(name, count)| format!("{count} {}", name.replace('_', " "))).collect();
    if plan.present > 0 {
        parts.push(format!("{} were there before", plan.present));
    }
    if missing > 0 {
        parts.push(format!("{missing} are not there yet"));
    }
    format!("{}: {computed} of {} cases computed: {}", campaign.sweep.name, campaign.sweep.cases, parts.join(", "))
}
