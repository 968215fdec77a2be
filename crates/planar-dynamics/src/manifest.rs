//! What a generated model is made of: names, order, units and defaults of its parameters.

/// Where one parameter of a generated model comes from in a layout. Arms and links count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterKind {
    /// Mass of the base, kg.
    BaseMass,
    /// Inertia of the base about its COM, kg m².
    BaseInertia,
    /// First joint of an arm in the base frame, x, m.
    MountX,
    /// First joint of an arm in the base frame, y, m.
    MountY,
    /// Direction of joint 1 = 0 in the base frame, rad.
    MountAngle,
    /// Joint to next joint, or to the end effector, m.
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

/// One run-time parameter of a generated model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Name of the field in the model's `Parameters`.
    pub name: &'static str,
    /// What it is.
    pub kind: ParameterKind,
    /// Which arm, 0 for the base.
    pub arm: usize,
    /// Which link of the arm, 0 for the base and the mounts.
    pub link: usize,
    /// SI unit.
    pub unit: &'static str,
    /// The layout's value.
    pub default: f64,
}

/// One of the full coordinates: the base's three, then the joints arm by arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// What it is: `base yaw`, or the arm's name and the joint's number.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
}

/// What one call of a function costs, its configuration stage included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// Sign changes, minima, roots, arctangents.
    pub other: usize,
}

impl Operations {
    /// Multiplications, additions and divisions together.
    #[must_use]
    pub const fn flops(&self) -> usize {
        self.multiplications + self.additions + self.divisions
    }
}

/// What a generated model was derived from, and what it expects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manifest {
    /// Name of the layout.
    pub name: &'static str,
    /// Content hash of the layout (see `Layout::sha256`).
    pub sha256: &'static str,
    /// Number of links of each arm.
    pub links: &'static [usize],
    /// Full coordinates in their order, which is that of velocities, accelerations and generalized forces too.
    pub coordinates: &'static [Coordinate],
    /// Parameters in the order of `Parameters::to_array`.
    pub parameters: &'static [Parameter],
    /// Operation counts of every function.
    pub operations: &'static [Operations],
    /// Whether the distance between the first two mounts is divided by.
    pub needs_distinct_mounts: bool,
}

impl Manifest {
    /// Position of a parameter, `None` for a structural zero.
    #[must_use]
    pub fn position(&self, kind: ParameterKind, arm: usize, link: usize) -> Option<usize> {
        self.parameters.iter().position(|p| p.kind == kind && p.arm == arm && p.link == link)
    }

    /// Number of links of all arms.
    #[must_use]
    pub fn joints(&self) -> usize {
        self.links.iter().sum()
    }
}
