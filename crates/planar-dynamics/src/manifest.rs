//! The description of a generated model: its layout, coordinates, parameters and operation counts.
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::MANIFEST;
//! use planar_dynamics::manifest::ParameterKind;
//!
//! assert_eq!((MANIFEST.links, MANIFEST.joints(), MANIFEST.coordinates.len()), (&[3, 3][..], 6, 9));
//! let length = MANIFEST.position(ParameterKind::LinkLength, 1, 2).expect("the third link of the second arm");
//! let length = &MANIFEST.parameters[length];
//! assert_eq!((length.name, length.default, length.unit), ("arm2_link3_length", 1.0, "m"));
//! // the mounts are on the base's x axis: an exact zero, which is no parameter
//! assert_eq!(MANIFEST.position(ParameterKind::MountY, 0, 0), None);
//! ```

/// The number of a layout that a parameter of a generated model stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ParameterKind {
    /// Mass of the base, kg.
    BaseMass,
    /// Inertia of the base about its COM, kg m².
    BaseInertia,
    /// First joint of an arm in the base frame, x, m.
    MountX,
    /// First joint of an arm in the base frame, y, m.
    MountY,
    /// Direction of the first link at joint angle 0, from the base x axis, rad.
    MountAngle,
    /// From a link's joint to the next joint, or to the end effector, m.
    LinkLength,
    /// Mass of a link, kg.
    LinkMass,
    /// Inertia of a link about its COM, kg m².
    LinkInertia,
    /// COM of a link in its frame, x along the link, m.
    LinkComX,
    /// COM of a link in its frame, y across the link, m.
    LinkComY,
}

impl ParameterKind {
    /// All kinds.
    pub const ALL: [Self; 10] = [
        Self::BaseMass,
        Self::BaseInertia,
        Self::MountX,
        Self::MountY,
        Self::MountAngle,
        Self::LinkLength,
        Self::LinkMass,
        Self::LinkInertia,
        Self::LinkComX,
        Self::LinkComY,
    ];
}

/// One run-time parameter of a generated model.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Parameter {
    /// Name of the field in the model's `Parameters`.
    pub name: &'static str,
    /// What it is.
    pub kind: ParameterKind,
    /// The arm, from 0; 0 for the base.
    pub arm: usize,
    /// The link of the arm, from 0; 0 for the base and the mounts.
    pub link: usize,
    /// SI unit.
    pub unit: &'static str,
    /// The layout's value.
    pub default: f64,
}

/// One of the full coordinates: the base's three, then the joints arm by arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Coordinate {
    /// `base yaw`, or the arm's name and the joint's number.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
}

/// Operation counts of one call of a function, its configuration stage included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Operations {
    /// The function of the model.
    pub function: &'static str,
    /// Products.
    pub multiplications: usize,
    /// Sums and differences.
    pub additions: usize,
    /// Quotients.
    pub divisions: usize,
    /// Pairs of a sine and a cosine.
    pub sin_cos: usize,
    /// Sign changes, minima, square roots, arctangents.
    pub other: usize,
}

impl Operations {
    /// Multiplications, additions and divisions together.
    #[must_use]
    pub const fn flops(&self) -> usize {
        self.multiplications + self.additions + self.divisions
    }
}

/// The description of a generated model.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Manifest {
    /// Name of the layout.
    pub name: &'static str,
    /// Content hash of the layout (see `Layout::sha256`).
    pub sha256: &'static str,
    /// Number of links of each arm.
    pub links: &'static [usize],
    /// Full coordinates in their order, also that of velocities, accelerations and generalized forces.
    pub coordinates: &'static [Coordinate],
    /// Parameters in the order of `Parameters::to_array`.
    pub parameters: &'static [Parameter],
    /// Operation counts of every function.
    pub operations: &'static [Operations],
    /// Whether the model divides by the distance between the first two mounts.
    pub needs_distinct_mounts: bool,
}

impl Manifest {
    /// Position of a parameter, `None` for a structural zero.
    #[must_use]
    pub const fn position(&self, kind: ParameterKind, arm: usize, link: usize) -> Option<usize> {
        let mut index = 0;
        while index < self.parameters.len() {
            let p = &self.parameters[index];
            if p.kind as u8 == kind as u8 && p.arm == arm && p.link == link {
                return Some(index);
            }
            index += 1;
        }
        None
    }

    /// Number of links of all arms.
    #[must_use]
    pub fn joints(&self) -> usize {
        self.links.iter().sum()
    }
}
