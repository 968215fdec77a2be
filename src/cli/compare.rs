//! `planar-capture compare LAYOUT.toml`: generated against generic dynamics at random states.

use super::out_folder::out_folder;
use super::terminal::{note, print};
use super::{CommandError, derive, file_error, layout};
use crate::compare::{Comparison, LargestError, Refusal, compare};
use crate::engine::{Choice, Engine};
use crate::eval::to_json;
use crate::layout::Layout;
use crate::output::result_folder::{ResultFolder, outside_of_runs};
use crate::plain_text::Column::{Left, Right};
use crate::plain_text::{Table, sentence};
use crate::quantity::Quantity;
use crate::registry::Robots;
use std::cmp::Ordering;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture compare dual_arm_3r
  planar-capture compare mine.toml --samples 1000 --seed 7";

/// Compare the derived dynamics with the generic implementation at random states.
///
/// Derived are the compiled code of the layout's structure, else its graph, which is derived first where there is none.
/// Errors are relative to the natural size of each entry: the sum of the magnitudes of its terms. The worst state of
/// each quantity is written for `eval`. Exit code 1 if an error exceeds its bound.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The layout: a path, or the name of a shipped one.
    layout: String,
    /// Number of states of each regime.
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..1 << 48))]
    samples: u64,
    /// Seed of the random states.
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// Folder for the worst states [default: results/compare/NAME, NAME the layout's].
    #[arg(long, value_name = "DIR", value_parser = out_folder())]
    out: Option<PathBuf>,
    /// Replace the files in DIR, whatever they are; not folders in it, hidden files or your home folder.
    #[arg(long)]
    force: bool,
    /// Show no progress.
    #[arg(short, long)]
    quiet: bool,
}

/// Compares the implementations, writes the worst states and prints a table.
pub fn run(arguments: &Arguments, robots: Robots<'_>) -> Result<ExitCode, CommandError> {
    let layout = layout::read(&arguments.layout, robots)?;
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new("results/compare").join(&layout.name));
    let keep: &[&Path] = if Layout::is_path(&arguments.layout) { &[Path::new(&arguments.layout)] } else { &[] };
    let objection = |folder: &Path, names: &[String]| objection(folder, names, &layout);
    outside_of_runs(&folder, None)?;
    let folder = ResultFolder::claim(&folder, arguments.force, keep, &objection)?;
    let choice = choose(&layout, arguments, robots)?;
    let comparison = compare(&layout, &choice, arguments.samples, arguments.seed);
    let shown = folder.path().display().to_string();
    let staged = folder.stage()?;
    for LargestError { difference, sample, .. } in &comparison.largest_errors {
        let name = file_name(difference.quantity);
        staged.write(&format!("{name}.toml"), |to| to.write_all(sample.layout.to_toml().as_bytes()))?;
        staged.write(&format!("{name}.json"), |to| writeln!(to, "[{}]", to_json(&sample.instant)))?;
    }
    folder.commit(staged, &format!("{}.toml", file_name(Quantity::ALL[0])))?;
    let code = if comparison.agrees() { ExitCode::SUCCESS } else { ExitCode::from(1) };
    print(&format!(
        "{}Worst states in {shown}; replay one there:\nplanar-capture eval QUANTITY.toml QUANTITY.json\n",
        table(&comparison, (&layout.name, &choice), arguments),
    ));
    comparison.refusals.iter().filter_map(|refusal| one_sided(refusal, choice.engine)).for_each(note);
    let over: Vec<_> = comparison
        .largest_errors
        .iter()
        .filter(|largest| largest.difference.ratio().partial_cmp(&1.0).is_none_or(Ordering::is_gt))
        .collect();
    for LargestError { difference, regime, index, .. } in over {
        let (name, regime) = (difference.quantity.row().name, regime.name());
        note(format_args!(
            "compare: {name} is off by {:.1e} in {regime}, state {index}, over its bound {:.1e}",
            difference.error,
            difference.bound()
        ));
    }
    for quantity in Quantity::ALL {
        if !comparison.largest_errors.iter().any(|largest| largest.difference.quantity == *quantity) {
            note(format_args!("compare: {} was never compared", quantity.row().name));
        }
    }
    Ok(code)
}

/// Compiled code, else a graph; where there is none it is derived.
fn choose(layout: &Layout, arguments: &Arguments, robots: Robots<'_>) -> Result<Choice, CommandError> {
    let (choice, _) = Choice::fastest(layout, robots);
    if choice.engine != Engine::Generic {
        return Ok(choice);
    }
    derive::into_cache(layout, &arguments.layout, arguments.quiet)?;
    Choice::graph(layout).map_err(file_error(&arguments.layout))
}

/// What one side alone says of a state; `None` where both have no result.
fn one_sided(refusal: &Refusal, engine: Engine) -> Option<String> {
    let Refusal { regime, index, generated, generic } = refusal;
    let (implementation, error) = match (generated, generic) {
        (Some(error), None) => (engine.name(), error),
        (None, Some(error)) => (Engine::Generic.name(), error),
        _ => return None,
    };
    Some(format!("compare: {}, state {index}: only {implementation} says: {error}", regime.name()))
}

/// Name of the files of a quantity.
fn file_name(quantity: Quantity) -> String {
    quantity.row().name.replace([' ', '.'], "_")
}

/// What stands against replacing the content of a folder with the worst states of a layout, as a predicate.
fn objection(folder: &Path, names: &[String], layout: &Layout) -> Option<String> {
    let own = |name: &&String| {
        let (name, kind) = name.rsplit_once('.').unwrap_or_default();
        ["toml", "json"].contains(&kind) && Quantity::ALL.iter().any(|quantity| file_name(*quantity) == name)
    };
    if let Some(name) = names.iter().find(|name| !own(name)) {
        return Some(format!("has `{name}`, which is not from a comparison"));
    }
    let other =
        names.iter().filter_map(|name| Layout::read(&folder.join(name)).ok()).find(|l| l.name != layout.name)?;
    Some(format!("holds the comparison of `{}`, not of `{}`", other.name, layout.name))
}

/// One line per quantity.
fn table(comparison: &Comparison, (name, choice): (&str, &Choice), arguments: &Arguments) -> String {
    let (states, samples, seed) = (comparison.states, arguments.samples, arguments.seed);
    let (engine, origin) = (choice.engine.name(), &choice.origin);
    let mut table = Table::new(&[Left("quantity"), Right("error"), Right("bound"), Left("regime"), Right("state")]);
    for LargestError { difference, regime, index, .. } in &comparison.largest_errors {
        let [error, bound] = [difference.error, difference.bound()].map(|value| format!("{value:.1e}"));
        let quantity = difference.quantity.row().name.to_owned();
        table.row([quantity, error, bound, regime.name().to_owned(), index.to_string()]);
        if difference.ratio() > 1.0 {
            table.note("over its bound");
        }
    }
    let of = sentence("", &format!("{name}: {engine} ({origin}) against generic"));
    let states = format!("{states} states, {samples} of each regime, seed {seed}");
    let both = comparison.refusals.iter().filter(|r| r.generated.is_some() && r.generic.is_some()).count();
    let none = if both == 0 { String::new() } else { format!("\n{both} states have no result by either of them.\n") };
    format!("{of}{states}\n\n{}{none}\n", table.text())
}

#[cfg(test)]
mod tests {
    use super::{Refusal, one_sided};
    use crate::engine::Engine;
    use crate::error::Error;
    use crate::sampling::REGIMES;

    #[test]
    fn the_side_that_refuses_is_named() {
        let of = |generated: bool, generic: bool| {
            let error = |what, is_there: bool| is_there.then_some(Error::Singular { what, pivot: 0.5, limit: 1.0 });
            let (generated, generic) = (error("its matrix", generated), error("the reference's", generic));
            let refusal = Refusal { regime: REGIMES[2], index: 7, generated, generic };
            one_sided(&refusal, Engine::Graph)
        };
        let state = format!("compare: {}, state 7: only", REGIMES[2].name());
        for (found, expected) in
            [(of(true, false), "graph says: its matrix"), (of(false, true), "generic says: the reference's")]
        {
            let found = found.expect("a text");
            assert!(found.starts_with(&format!("{state} {expected}")), "{found}");
        }
        assert_eq!(of(true, true), None);
    }
}
