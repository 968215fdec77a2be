//! `planar-capture compare LAYOUT.toml`.

use super::{Problem, layout};
use planar_capture::compare::{Comparison, Worst, compare, states_text};
use planar_capture::output::atomic_file::{make_folder, write_whole};
use planar_capture::quantity::Quantity;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Compares generated code with the generic implementation at random states, quantity by quantity.
///
/// Errors are relative to the natural size of each entry: the sum of the magnitudes that make it up. The worst state
/// of each quantity is written so that `eval` can compute it again. Exit code 1 where a bound is exceeded.
#[derive(Debug, clap::Args)]
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
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Compares, prints, writes.
pub fn run(arguments: &Arguments) -> Result<ExitCode, Problem> {
    let layout = layout::read(&arguments.layout)?;
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new("results/compare").join(&layout.name));
    let file = arguments.layout.clone();
    let comparison = compare(&layout, arguments.samples, arguments.seed)
        .map_err(|source| Problem::Model { file, source: Box::new(source) })?;
    make_folder(&folder)?;
    for worst in &comparison.worst {
        let name = file_name(worst.difference.quantity.row().name);
        let write = |extension: &str, text: String| {
            write_whole(&folder.join(format!("{name}.{extension}")), |to| to.write_all(text.as_bytes()))
        };
        write("toml", worst.sample.layout.to_toml())?;
        write("json", states_text(&worst.sample))?;
    }
    let mut out = std::io::stdout().lock();
    print(&comparison, &layout.name, arguments, &mut out)?;
    writeln!(
        out,
        "Worst states in {0}; replay: planar-capture eval {0}/QUANTITY.toml {0}/QUANTITY.json",
        folder.display()
    )?;
    for refusal in comparison.refusals.iter().filter(|r| r.generated.is_none() || r.generic.is_none()) {
        let (who, error) = match (&refusal.generated, &refusal.generic) {
            (Some(error), _) => ("generated", error),
            (None, Some(error)) => ("generic", error),
            (None, None) => continue,
        };
        eprintln!("compare: {}, state {}: only {who} says: {error}", refusal.regime.name(), refusal.index);
    }
    for quantity in Quantity::ALL {
        if !comparison.worst.iter().any(|worst| worst.difference.quantity == *quantity) {
            eprintln!("compare: {} was never compared", quantity.row().name);
        }
    }
    Ok(if comparison.agrees() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

/// One line per quantity.
fn print(comparison: &Comparison, name: &str, arguments: &Arguments, out: &mut impl Write) -> std::io::Result<()> {
    let (states, samples, seed) = (comparison.states, arguments.samples, arguments.seed);
    writeln!(out, "{name}: generated against generic at {states} states, {samples} of each regime, seed {seed}\n")?;
    writeln!(out, "{:<28} {:>9} {:>9}  {:<14} {:>6}", "quantity", "error", "bound", "regime", "state")?;
    for Worst { difference, regime, index, .. } in &comparison.worst {
        let (quantity, error, bound) = (difference.quantity.row().name, difference.error, difference.bound());
        let over = if difference.ratio() <= 1.0 { "" } else { "  over its bound" };
        writeln!(out, "{quantity:<28} {error:>9.1e} {bound:>9.1e}  {:<14} {index:>6}{over}", regime.name())?;
    }
    let both = comparison.refusals.iter().filter(|r| r.generated.is_some() && r.generic.is_some()).count();
    if both > 0 {
        writeln!(out, "\n{both} states have no answer by either.")?;
    }
    writeln!(out)
}

fn file_name(quantity: &str) -> String {
    quantity.replace([' ', '.'], "_")
}
