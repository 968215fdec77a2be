//! `planar-capture import ROBOT.urdf`: writes the layout of a URDF.

use super::out_file::{Force, write_new};
use super::terminal::note;
use super::{CommandError, file_error};
use crate::diagnostic::read_text;
use crate::urdf::{self, HeldJoint, ImportOptions};
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture import robot.urdf --out robot.toml
  planar-capture import robot.urdf --tip left_tool --tip right_tool
  planar-capture import robot.urdf --subtree torso --fix shoulder_roll=0 --fix wrist_yaw=1.5708";

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
    #[command(flatten)]
    force: Force,
    /// Link whose frame is the tip of its arm, once for each arm [default: the first massless link fixed to its end].
    #[arg(long = "tip", value_name = "LINK")]
    end_effectors: Vec<String>,
    /// Link that is the base, with what it carries; the rest is left out [default: the root].
    #[arg(long, value_name = "LINK")]
    subtree: Option<String>,
    /// Hold a joint at an angle in rad (a prismatic one at a distance in m), once for each joint: so a robot that moves in
    /// space moves in a plane.
    #[arg(long = "fix", value_name = "JOINT=ANGLE", value_parser = held_joint, allow_hyphen_values = true)]
    held: Vec<HeldJoint>,
    /// Name of the layout [default: from the robot's name].
    #[arg(long)]
    name: Option<String>,
}

/// `JOINT=ANGLE`; a name may have `=` in it.
fn held_joint(text: &str) -> Result<HeldJoint, String> {
    let (name, position) = text.rsplit_once('=').ok_or("expected JOINT=ANGLE, such as elbow=0.5")?;
    let position = position.trim().parse().map_err(|_| format!("`{position}` is no number, expected rad (or m)"))?;
    Ok(HeldJoint { name: name.to_owned(), position })
}

/// Converts the URDF and prints the remarks.
pub fn run(arguments: &Arguments) -> Result<ExitCode, CommandError> {
    let file = arguments.urdf.display().to_string();
    let options = ImportOptions {
        name: arguments.name.clone(),
        end_effectors: arguments.end_effectors.clone(),
        subtree: arguments.subtree.clone(),
        held: arguments.held.clone(),
    };
    let imported = urdf::import(&read_text(&arguments.urdf, "URDF")?, &options).map_err(file_error(&file))?;
    let written = write_new(arguments.out.as_deref(), &arguments.force, &imported.to_toml(&file));
    for joint in imported.joints.iter().filter(|joint| !joint.is_same_angle()) {
        note(format_args!("import: note: {joint}"));
    }
    for remark in &imported.remarks {
        note(format_args!("import: {remark}"));
    }
    written.map(|()| ExitCode::SUCCESS)
}
