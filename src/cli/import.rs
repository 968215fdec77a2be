//! `planar-capture import ROBOT.urdf`.

use super::{CommandError, file_error, write_new};
use planar_capture::diagnostic::read_text;
use planar_capture::urdf::{self, ImportOptions};
use std::path::PathBuf;
use std::process::ExitCode;

/// Make a layout from a URDF: a tree of links with parallel revolute joints, taken as floating freely in their plane.
///
/// The root link is the base, every chain of joints on it an arm, and what fixed joints hold is one body. What became
/// what and what was left out stands at the head of the layout, and the notable part of it on the standard error.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The URDF file.
    urdf: PathBuf,
    /// The layout file [default: the standard output].
    #[arg(long, value_name = "LAYOUT.toml")]
    out: Option<PathBuf>,
    /// Link whose frame is the tip of its arm, once for each arm [default: the first massless link fixed to its end].
    #[arg(long = "tip", value_name = "LINK")]
    tips: Vec<String>,
    /// Name of the layout [default: from the robot's name].
    #[arg(long)]
    name: Option<String>,
}

/// Converts the URDF and prints the remarks.
pub fn run(arguments: &Arguments) -> Result<ExitCode, CommandError> {
    let file = arguments.urdf.display().to_string();
    let options = ImportOptions { name: arguments.name.clone(), tips: arguments.tips.clone() };
    let imported = urdf::import(&read_text(&arguments.urdf, "URDF")?, &options).map_err(file_error(&file))?;
    write_new(arguments.out.as_deref(), &imported.to_toml(&file))?;
    for joint in imported.joints.iter().filter(|joint| !joint.is_same_angle()) {
        eprintln!("import: note: {joint}");
    }
    for remark in &imported.remarks {
        eprintln!("import: {remark}");
    }
    Ok(ExitCode::SUCCESS)
}
