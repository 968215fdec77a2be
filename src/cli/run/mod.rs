//! `planar-capture run SCENARIO.toml ...`: simulates scenarios and writes their results.

mod product;
mod task;

use super::CommandError;
use super::cases;
use super::dynamics::Dynamics;
use super::optional_outputs;
use super::out_folder::out_folder;
use super::progress::Display;
use super::seconds::positive_seconds;
use super::terminal::note;
use crate::engine::Choice;
use crate::output::result_folder::{ClaimError, ResultFolder, outside_of_runs};
use crate::output::run_folder::{self, objection};
use crate::program::Program;
use crate::scenario::{Scenario, ScenarioSource};
use product::{Format, Product};
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use task::Task;
pub use task::study_error;

/// Time between two rows where it is not given, s.
const DEFAULT_SAMPLE: f64 = 0.05;

/// What stands for the standard input.
const STANDARD_INPUT: &str = "-";

const EXAMPLES: &str = "\
Examples:
  planar-capture run scenarios/raina_shah_2017.toml --report
  planar-capture run scenarios/*.toml --out results/today
  planar-capture run scenarios/raina_shah_2017.toml --case case2 --case case3 --out results/two
  planar-capture run mine.toml -q --format json | jq '.cases[].impact.exact.impulse_magnitudes'
  sed 's/mass = 10.0/mass = 20.0/' mine.toml | planar-capture run - --out results/heavier

Exit code: 0 done; 1 a computation broke down or the audit objects; 2 unsuitable input, or results that cannot be \
written. Of several scenarios it is the greatest; all of them are read, and their folders looked at, before the first \
is computed.";

/// Compute scenarios: the approach, and for every case the impact and the motion after it.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The scenario files; `-` for the standard input, where paths to layouts are relative to the working folder.
    #[arg(required = true, value_name = "SCENARIO")]
    scenarios: Vec<PathBuf>,
    /// Folder for summary.json, the CSV time series and all else; of several scenarios for a folder each, of their names
    /// [default: results/NAME, NAME the scenario's].
    #[arg(long, value_name = "DIR", value_parser = out_folder(), help_heading = "Results")]
    out: Option<PathBuf>,
    /// Replace the files in DIR, whatever they are; not folders in it, hidden files or your home folder. Of several
    /// scenarios: in their folders, and the files of a run that DIR itself holds.
    #[arg(long, help_heading = "Results")]
    force: bool,
    /// What the standard output is: a table, or summary.json, of several scenarios an array of them.
    #[arg(long, value_enum, default_value_t = Format::Table, help_heading = "Results")]
    format: Format,
    /// Write report.html too: an animation with plots that opens in any browser, without a network.
    #[arg(long, help_heading = "Results")]
    report: bool,
    #[command(flatten)]
    optional_outputs: optional_outputs::Flags,
    /// Time between two rows of the CSV time series, s; at least one step of the scenario [default: 0.05].
    #[arg(long, value_name = "SECONDS", value_parser = positive_seconds, help_heading = "Results")]
    sample: Option<f64>,
    /// Compute this case alone, once for each case [default: all of them]; the results are those of these cases.
    #[arg(long = "case", value_name = "NAME", help_heading = "Computation")]
    cases: Vec<String>,
    /// The implementation of the dynamics.
    #[arg(long, value_enum, default_value_t = Dynamics::Auto, help_heading = "Computation")]
    dynamics: Dynamics,
    #[command(flatten)]
    display: Display,
    /// Say what is read, how it is integrated, how long that takes, and which files are written.
    #[arg(short, long, conflicts_with = "quiet", help_heading = "Messages")]
    verbose: bool,
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
    program: Program<'_>,
) -> Result<ExitCode, CommandError> {
    let arguments = Arguments {
        scenarios: vec![scenario.to_owned()],
        out: Some(out),
        force: true,
        format: Format::Table,
        report,
        optional_outputs: optional_outputs::Flags::default(),
        sample: None,
        cases: Vec::new(),
        dynamics: Dynamics::of_name(choice.engine.name()),
        display,
        verbose: false,
    };
    run_by(&arguments, program, Some(choice))
}

/// The greatest exit code so far; what it is of was said.
struct ExitCodes(u8);

impl ExitCodes {
    fn add(&mut self, code: u8) {
        self.0 = self.0.max(code);
    }

    /// The value, or its error on the standard error.
    fn take<T>(&mut self, result: Result<T, CommandError>) -> Option<T> {
        result
            .map_err(|error| {
                note(&error);
                self.add(error.exit_code());
            })
            .ok()
    }
}

/// Reads all scenarios, claims their folders, then computes one after the other.
pub fn run(arguments: &Arguments, program: Program<'_>) -> Result<ExitCode, CommandError> {
    run_by(arguments, program, None)
}

/// The same, by what another command has chosen to compute the dynamics of its one scenario.
fn run_by(arguments: &Arguments, program: Program<'_>, mut chosen: Option<Choice>) -> Result<ExitCode, CommandError> {
    optional_outputs::require(&arguments.optional_outputs.requested())?;
    let mut codes = ExitCodes(0);
    let scenarios: Vec<_> = arguments
        .scenarios
        .iter()
        .filter_map(|path| codes.take(read(path, &arguments.cases, program).map(|read| (path, read))))
        .collect();
    let folders = folders(arguments, scenarios.iter().map(|(_, (scenario, _))| scenario.name.as_str()))?;
    let sources = scenarios.iter().flat_map(|(_, (_, source))| [&source.scenario.file, &source.layout.file]);
    let keep: Vec<_> = sources.map(Path::new).collect();
    let each = scenarios.iter().map(|(_, (scenario, _))| scenario.name.as_str());
    let objections: Vec<_> =
        each.map(|name| move |folder: &Path, names: &[String]| objection(folder, names, name)).collect();
    let above = codes.take(above(arguments)).flatten();
    let mut tasks = Vec::new();
    for (((path, (scenario, source)), folder), objection) in scenarios.iter().zip(&folders).zip(&objections) {
        // a run in the folder with those of several was said above
        let claimed = outside_of_runs(folder, several(arguments))
            .and_then(|()| ResultFolder::claim(folder, arguments.force, &keep, objection))
            .map_err(CommandError::from);
        let file = &source.scenario.file;
        let choose = |scenario: &Scenario| arguments.dynamics.choose(&scenario.layout, file, program.robots);
        let choice = chosen.take().map_or_else(|| choose(scenario), Ok);
        let own = scenario.variants.iter().map(|variant| choose(&variant.scenario)).collect::<Result<_, _>>();
        if let (Some(folder), Some(choice), Some(own)) = (codes.take(claimed), codes.take(choice), codes.take(own)) {
            let named = if arguments.scenarios.len() > 1 { format!("{}: ", scenario.name) } else { String::new() };
            tasks.push(Task { path, scenario, source, folder, choice, own, laws: program.laws, named });
        }
    }
    if codes.0 > 0 {
        // nothing is computed where something cannot be
        return Ok(ExitCode::from(codes.0));
    }
    let mut product = Product::new(arguments.format, tasks.len());
    let mut is_written = false;
    for (task, left) in tasks.iter().zip((0..tasks.len()).rev()) {
        if let Some((printed, objections)) = codes.take(task.run(arguments, left == 0)) {
            is_written = true;
            codes.take(product.add(&printed));
            task.note_objections(&objections);
            codes.add(u8::from(!objections.failures.is_empty()));
        }
    }
    if let Some(folder) = above.filter(|_| is_written) {
        codes.take(run_folder::remove(folder).map_err(CommandError::from));
    }
    codes.take(product.finish());
    Ok(ExitCode::from(codes.0))
}

/// Reads a scenario, these cases of it, from a file or the standard input.
fn read(path: &Path, cases: &[String], program: Program<'_>) -> Result<(Scenario, ScenarioSource), CommandError> {
    let (mut scenario, source) = if path == Path::new(STANDARD_INPUT) {
        Scenario::read_stream(io::stdin().lock(), "standard input", program.known())?
    } else {
        Scenario::read_with_source(path, program.known())?
    };
    cases::retain(&mut scenario, cases, &source.scenario.file)?;
    Ok((scenario, source))
}

/// The folder with those of several scenarios, where it is given.
fn several(arguments: &Arguments) -> Option<&Path> {
    arguments.out.as_deref().filter(|_| arguments.scenarios.len() > 1)
}

/// The same, where it holds the results of one run, which are to be replaced.
fn above(arguments: &Arguments) -> Result<Option<&Path>, CommandError> {
    let Some(out) = several(arguments) else { return Ok(None) };
    match run_folder::scenario_in(out) {
        Some(_) if arguments.force => Ok(Some(out)),
        Some(scenario) => {
            let found = format!("holds the results of `{scenario}`, not those of several scenarios");
            Err(ClaimError::Occupied { path: out.to_owned(), found }.into())
        }
        None => Ok(None),
    }
}

/// The folder of each scenario; they have different ones.
fn folders<'a>(
    arguments: &Arguments,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Result<Vec<PathBuf>, CommandError> {
    // some file systems ignore case
    let mut known: Vec<_> = names.clone().map(str::to_ascii_lowercase).collect();
    known.sort_unstable();
    if let Some([name, ..]) = known.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(CommandError::Usage(format!(
            "two scenarios are named `{name}`, and each has the folder of its name: change one's `name`, or run them one \
             after the other with different --out"
        )));
    }
    let of = |name: &str| match &arguments.out {
        Some(out) if arguments.scenarios.len() > 1 => out.join(name),
        Some(out) => out.clone(),
        None => Path::new("results").join(name),
    };
    Ok(names.map(of).collect())
}
