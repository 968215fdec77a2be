//! `planar-capture draw LAYOUT --out FILE.svg`: a drawing of a robot.

use super::out_file::{Force, check_new, svg, write_new};
use super::{CommandError, layout};
use crate::output::drawing::drawing;
use crate::registry::Robots;
use crate::scenario::LARGEST_ANGLE;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture draw dual_arm_3r --out robot.svg
  planar-capture draw mine.toml --angles 0.5,-1.2,0.7 --out mine.svg";

/// Draw a robot, as SVG: outlines, joints, mounts, centres of mass and names.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The layout: a path, or the name of a shipped one.
    layout: String,
    /// The joint angles, rad, arm by arm [default: all 0].
    #[arg(long, value_name = "RAD,RAD,…", value_delimiter = ',', allow_hyphen_values = true, value_parser = angle)]
    angles: Option<Vec<f64>>,
    /// The SVG file [default: the standard output].
    #[arg(long, value_name = "FILE.svg", value_parser = svg)]
    out: Option<PathBuf>,
    #[command(flatten)]
    force: Force,
}

/// As of a scenario's joint angles: in rad, at most two turns, beyond which they are taken for degrees.
fn angle(text: &str) -> Result<f64, String> {
    let wanted = "expected numbers with commas between them, joint angles in rad";
    let value: f64 = text.trim().parse().ok().filter(|value: &f64| value.is_finite()).ok_or(wanted)?;
    if value.abs() <= LARGEST_ANGLE { Ok(value) } else { Err(format!("{wanted}: this looks like degrees")) }
}

/// Draws the layout.
pub fn run(arguments: &Arguments, robots: Robots<'_>) -> Result<ExitCode, CommandError> {
    check_new(arguments.out.as_deref(), &arguments.force)?;
    let layout = layout::read(&arguments.layout, robots)?;
    let joints = layout.joints();
    let angles = arguments.angles.clone().unwrap_or_else(|| vec![0.0; joints]);
    if angles.len() != joints {
        let arms: Vec<_> = layout.arms.iter().map(|arm| format!("{}: {}", arm.name, arm.links.len())).collect();
        let (found, arms) = (angles.len(), arms.join(", "));
        let message = format!("--angles has {found} numbers, expected {joints}, one per joint ({arms})");
        return Err(CommandError::Usage(message));
    }
    write_new(arguments.out.as_deref(), &arguments.force, &drawing(&layout, &angles))?;
    Ok(ExitCode::SUCCESS)
}
