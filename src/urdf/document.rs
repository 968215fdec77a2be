//! An imported layout as a file for people.

use super::{ImportedLayout, import::ImportedJoint};
use crate::diagnostic::{listing, printable};
use std::fmt::{self, Display, Formatter};

/// Something that the user of an imported layout should know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// Whether it changes the motion.
    pub is_warning: bool,
    /// The text, one line.
    pub text: String,
}

impl Remark {
    pub(super) fn note(text: &str) -> Self {
        Self { is_warning: false, text: printable(text) }
    }

    pub(super) fn warning(text: &str) -> Self {
        Self { is_warning: true, text: printable(text) }
    }
}

impl Display for Remark {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", if self.is_warning { "warning" } else { "note" }, self.text)
    }
}

impl ImportedJoint {
    /// Whether the angle is the URDF's own.
    #[must_use]
    pub fn is_same_angle(&self) -> bool {
        self.sign > 0.0 && self.offset == 0.0
    }
}

/// The layout's angle in terms of the URDF's: `` arm `left`, joint 2 = -`elbow` + 0.5 ``.
impl Display for ImportedJoint {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let minus = if self.sign < 0.0 { "-" } else { "" };
        write!(f, "arm `{}`, joint {} = {minus}`{}`", printable(&self.arm), self.number, printable(&self.name))?;
        match self.offset {
            0.0 => Ok(()),
            offset if offset < 0.0 => write!(f, " - {:?} rad", -offset),
            offset => write!(f, " + {offset:?} rad"),
        }
    }
}

impl ImportedLayout {
    /// The layout as TOML, headed by what became what; `source` is the name of the URDF file.
    #[must_use]
    pub fn to_toml(&self, source: &str) -> String {
        let list = |names: &[String]| printable(&listing(&names.iter().map(String::as_str).collect::<Vec<_>>(), "and"));
        let mut lines = vec![
            format!("Imported from {} (planar-capture import). SI units, radians.", printable(source)),
            String::new(),
            format!("Base: {}; its frame is moved to the centre of mass.", list(&self.base)),
            format!("Plane in that frame: normal {:?}, x axis {:?}.", self.normal, self.x_axis),
            "Joints, the layout's angle = the URDF's:".to_owned(),
        ];
        for joint in &self.joints {
            lines.push(format!("  {joint}; moves {}", list(&joint.links)));
        }
        for (arm, tip) in self.layout.arms.iter().zip(&self.tips) {
            if let Some(tip) = tip {
                lines.push(format!("  arm `{}`, tip = `{}`", printable(&arm.name), printable(tip)));
            }
        }
        lines.push("Left out: visuals, collisions, materials, transmissions, orientations of tips.".to_owned());
        lines.extend(self.remarks.iter().map(ToString::to_string));
        let header: Vec<String> = lines.iter().map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect();
        header.concat() + &self.layout.to_toml()
    }
}
