//! `planar-capture import ROBOT.urdf`: writes the layout of a URDF.

use super::terminal::note;
use super::{CommandError, file_error, write_new};
use crate::diagnostic::read_text;
use crate::urdf::{self, ImportOptions};
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture import robot.urdf --out robot.toml
  planar-capture import robot.urdf --tip left_tool --tip right_tool";

/// Import a URDF as a layout.
///
/// A tree of links with parallel revolute joints becomes a free-floating robot in their plane. The root link is the base and
/// every chain of joints on it an arm; fixed joints merge links. The head of the layout lists joints and omissions; notes
/// and warnings also go to the standard error.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The URDF file.
    urdf: PathBuf,
    /// The layout file [default: the standard output].
    #[arg(long, value_name = "LAYOUT.toml")]
    out: Option<PathBuf>,
    /// Link whose frame is the tip of its arm, once for each arm [default: the first massless link fixed to its end].
    #[arg(long = "tip", value_name = "LINK")]
    end_effectors: Vec<String>,
    /// Name of the layout [default: from the robot's name].
    #[arg(long)]
    name: Option<String>,
}

/// Converts the URDF and prints the remarks.
pub fn run(arguments: &Arguments) -> Result<ExitCode, CommandError> {
    let file = arguments.urdf.display().to_string();
    let options = ImportOptions { name: arguments.name.clone(), end_effectors: arguments.end_effectors.clone() };
    let imported = urdf::import(&read_text(&arguments.urdf, "URDF")?, &options).map_err(file_error(&file))?;
    let written = write_new(arguments.out.as_deref(), &imported.to_toml(&file));
    for joint in imported.joints.iter().filter(|joint| !joint.is_same_angle()) {
        note(format_args!("import: note: {joint}"));
    }
    for remark in &imported.remarks {
        note(format_args!("import: {remark}"));
    }
    written.map(|()| ExitCode::SUCCESS)
}
