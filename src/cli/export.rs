//! `planar-capture export LAYOUT.toml`: writes a layout as a URDF.

use super::{CommandError, layout, write_new};
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
}

/// Converts the layout.
pub fn run(arguments: &Arguments, robots: Robots<'_>) -> Result<ExitCode, CommandError> {
    let layout = layout::read(&arguments.layout, robots)?;
    write_new(arguments.out.as_deref(), &urdf::export(&layout))?;
    Ok(ExitCode::SUCCESS)
}
