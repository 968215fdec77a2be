//! `planar-capture export LAYOUT.toml`.

use super::{Problem, layout, text};
use planar_capture::urdf;
use std::path::PathBuf;
use std::process::ExitCode;

/// Write a layout as a URDF that Pinocchio and MuJoCo load with the same dynamics.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The layout: a path, or the name of a shipped one.
    layout: String,
    /// The URDF file [default: the standard output].
    #[arg(long, value_name = "ROBOT.urdf")]
    out: Option<PathBuf>,
}

/// Reads, writes.
pub fn run(arguments: &Arguments) -> Result<ExitCode, Problem> {
    let layout = layout::read(&arguments.layout)?;
    text::write(arguments.out.as_deref(), &urdf::export(&layout))?;
    Ok(ExitCode::SUCCESS)
}
