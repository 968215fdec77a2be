//! Names of layouts and arms from those of a URDF.

use super::UrdfError;
use crate::diagnostic::printable;
use crate::layout::Layout;
use std::collections::HashSet;

/// The requested name of the layout, else that of the robot with `_` for characters that a module name cannot have.
pub(super) fn layout_name(robot: &str, asked: Option<&str>) -> Result<String, UrdfError> {
    let wanted = "expected lower-case letters, digits and `_`, a letter first, at most 64, and no Rust keyword";
    if let Some(name) = asked {
        let invalid = || UrdfError::part("name", name, "it cannot name a layout", wanted);
        return if Layout::is_name(name) { Ok(name.to_owned()) } else { Err(invalid()) };
    }
    let words = robot.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let mut name = words.collect::<Vec<_>>().join("_").to_ascii_lowercase();
    if name.starts_with(|c: char| c.is_ascii_digit()) {
        name.insert_str(0, "robot_");
    }
    name.truncate(64);
    if !name.is_empty() && !Layout::is_name(&name) {
        name.push_str("_robot"); // a keyword
    }
    if Layout::is_name(&name) {
        return Ok(name);
    }
    Err(UrdfError::part("robot", robot, "its name gives no name of a layout", "name the layout with `--name`"))
}

/// The names of the arms: those of their first joints, without the suffix `_joint1` of `export` if they remain unique.
pub(super) fn arm_names(first_joints: &[&str]) -> Vec<String> {
    let short: Vec<&str> = first_joints
        .iter()
        .map(|joint| joint.strip_suffix("_joint1").filter(|arm| !arm.trim().is_empty()).unwrap_or(joint))
        .collect();
    let differ = short.iter().collect::<HashSet<_>>().len() == short.len();
    let chosen = if differ { &short[..] } else { first_joints };
    chosen.iter().map(|name| printable(name)).collect()
}
