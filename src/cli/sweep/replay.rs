//! `--replay INDEX`: one case of a sweep as a scenario of its own.

use super::{Arguments, choose};
use crate::campaign::Campaign;
use crate::campaign::manifest::engine_of;
use crate::campaign::sweep::Draw;
use crate::cli::CommandError;
use crate::cli::dynamics::Dynamics;
use crate::cli::run::{self, RunOptions};
use crate::cli::terminal::note;
use crate::output::atomic_file::{create_folder, write_together};
use crate::program::Program;
use crate::scenario::variation::LAYOUT_FILE;
use std::path::Path;
use std::process::ExitCode;

/// Writes scenario and layout of a case into a folder of its own, and runs them there.
pub fn replay(
    campaign: &Campaign,
    case: u64,
    folder: &Path,
    arguments: &Arguments,
    program: Program<'_>,
) -> Result<ExitCode, CommandError> {
    let cases = campaign.sweep.cases;
    if case >= cases {
        let message =
            format!("--replay {case}: the sweep has {cases} cases, counted from 0: expected 0 to {}", cases - 1);
        return Err(CommandError::Usage(message));
    }
    let own = folder.join("replay").join(format!("{case:06}"));
    let values = Draw::new(&campaign.sweep).values(case);
    let texts = campaign.variation.texts(&values);
    create_folder(&own)?;
    let [scenario, layout] = ["scenario.toml", LAYOUT_FILE].map(|name| own.join(name));
    write_together([(scenario.as_path(), texts.scenario.as_bytes()), (layout.as_path(), texts.layout.as_bytes())])?;
    if !arguments.display.quiet {
        for (varied, value) in campaign.sweep.varied.iter().zip(&values) {
            note(format_args!("{} = {value}", varied.key));
        }
    }
    // by what computed the others: of a number that is 0 in this case alone there may be other code
    let dynamics = match arguments.dynamics {
        Dynamics::Auto => engine_of(folder).map_or(Dynamics::Auto, |name| Dynamics::of_name(&name)),
        chosen => chosen,
    };
    let choice = choose(campaign, dynamics, program.robots, arguments.display.quiet)?;
    let options = RunOptions { out: own.join("results"), choice, report: arguments.report, display: arguments.display };
    run::run_file(&scenario, options, program)
}
