//! The result of an import: a layout, the relation of its joints to those of the URDF, and its TOML file.

use super::remark::Remark;
use crate::diagnostic::{listing, printable};
use crate::layout::Layout;
use std::fmt::{self, Display, Formatter};

/// A layout, and how it follows from the URDF.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedLayout {
    /// The layout.
    pub layout: Layout,
    /// The links of the base; its frame is that of the first, moved to the common centre of mass.
    pub base: Vec<String>,
    /// Normal of the plane in the frame of the base link.
    pub normal: [f64; 3],
    /// The x axis of plane and layout, in the frame of the base link; y is normal × x.
    pub x_axis: [f64; 3],
    /// The joints in the order of the layout.
    pub joints: Vec<ImportedJoint>,
    /// Per arm the link at its end effector, if there is one.
    pub end_effectors: Vec<Option<String>>,
    /// Notes and warnings.
    pub remarks: Vec<Remark>,
}

/// A joint of the layout: its angle is `sign` × the URDF's + `offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedJoint {
    /// The arm.
    pub arm: String,
    /// Counted from 1 at the base.
    pub number: usize,
    /// Its name in the URDF.
    pub name: String,
    /// The links that it moves: its child, and those fixed to that.
    pub links: Vec<String>,
    /// −1 if the URDF's axis points against the plane's normal.
    pub sign: f64,
    /// The layout's angle at 0 of the URDF's, rad; 0 for the first joint of an arm, which has `mount_angle`.
    pub offset: f64,
}

impl ImportedJoint {
    /// Whether the angle is that of the URDF.
    #[must_use]
    pub fn is_same_angle(&self) -> bool {
        self.sign > 0.0 && self.offset == 0.0
    }
}

/// The layout's angle as a function of the URDF's: `` arm `left`, joint 2 = -`elbow` + 0.5 ``.
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
    /// The layout as TOML, after a header with joints and remarks; `source` is the name of the URDF file.
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
        for (arm, tip) in self.layout.arms.iter().zip(&self.end_effectors) {
            if let Some(tip) = tip {
                lines.push(format!("  arm `{}`, tip = `{}`", printable(&arm.name), printable(tip)));
            }
        }
        lines.push("Omitted: visuals, collisions, materials, transmissions, orientations of tips.".to_owned());
        lines.extend(self.remarks.iter().map(ToString::to_string));
        let header: Vec<String> = lines.iter().map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect();
        header.concat() + &self.layout.to_toml()
    }
}
