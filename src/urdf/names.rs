//! Names of layouts and arms from those of a URDF.

use super::UrdfError;
use crate::diagnostic::printable;
use crate::layout::Layout;
use std::collections::HashSet;

/// The name of the layout: the one asked for, else the robot's with what a module's name cannot hold made `_`.
pub(super) fn layout_name(robot: &str, asked: Option<&str>) -> Result<String, UrdfError> {
    let wanted = "expected lower-case letters, digits and `_`, a letter first, at most 64, and no Rust keyword";
    if let Some(name) = asked {
        let refused = || UrdfError::Name {
            name: name.to_owned(),
            found: "cannot name a layout".to_owned(),
            wanted: wanted.to_owned(),
        };
        return if Layout::is_name(name) { Ok(name.to_owned()) } else { Err(refused()) };
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
    Err(UrdfError::Name {
        name: robot.to_owned(),
        found: "is the robot's name and gives no name for a layout".to_owned(),
        wanted: "name it with `--name`".to_owned(),
    })
}

/// The names of the arms: what stands before `_joint1` in the name of the first joint, as `export` writes it, else
/// the joint's whole name.
pub(super) fn arm_names(first_joints: &[&str]) -> Vec<String> {
    let short: Vec<&str> = first_joints
        .iter()
        .map(|joint| joint.strip_suffix("_joint1").filter(|arm| !arm.trim().is_empty()).unwrap_or(joint))
        .collect();
    let differ = short.iter().collect::<HashSet<_>>().len() == short.len();
    let chosen = if differ { &short[..] } else { first_joints };
    chosen.iter().map(|name| printable(name)).collect()
}
