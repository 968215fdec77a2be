//! `planar-capture export LAYOUT.toml`: writes a layout as a URDF.

use super::out_file::{Force, write_new};
use super::terminal::note;
use super::{CommandError, layout};
use crate::registry::Robots;
use crate::urdf;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture export dual_arm_3r --out dual_arm_3r.urdf";

/// Write a layout as a URDF that Pinocchio and MuJoCo load with the same dynamics.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The layout: a path, or the name of a shipped one.
    layout: String,
    /// The URDF file [default: the standard output].
    #[arg(long, value_name = "ROBOT.urdf")]
    out: Option<PathBuf>,
    #[command(flatten)]
    force: Force,
}

/// Converts the layout.
pub fn run(arguments: &Arguments, robots: Robots<'_>) -> Result<ExitCode, CommandError> {
    let layout = layout::read(&arguments.layout, robots)?;
    write_new(arguments.out.as_deref(), &arguments.force, &urdf::export(&layout))?;
    let links = layout.arms.iter().flat_map(|arm| &arm.links).filter(|link| link.outline.is_some()).count();
    let outlines = links + usize::from(layout.base.outline.is_some());
    if outlines > 0 {
        note(format_args!("warning: outlines are no part of the URDF, and `import` has none: {outlines} are left out"));
    }
    Ok(ExitCode::SUCCESS)
}
