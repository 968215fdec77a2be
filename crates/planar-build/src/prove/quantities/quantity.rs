//! What is compared, and how close it has to be.

/// One quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// As in the output of `eval`, `impact.G` for an entry of a block; or a method's name.
    pub name: &'static str,
    /// How it comes about.
    pub class: Class,
}

/// How rounding gets into a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// By sums and products alone.
    Polynomial,
    /// By solving equations too, which magnifies rounding by their condition number.
    Solved,
}

impl Class {
    /// Largest error in natural units: 10⁻¹², or max(10⁻¹³, 8 ε condition).
    #[must_use]
    pub fn bound(self, condition: f64) -> f64 {
        match self {
            Self::Polynomial => 1e-12,
            Self::Solved => (8.0 * f64::EPSILON * condition).max(1e-13),
        }
    }
}

const fn polynomial(name: &'static str) -> Quantity {
    Quantity { name, class: Class::Polynomial }
}

const fn solved(name: &'static str) -> Quantity {
    Quantity { name, class: Class::Solved }
}

/// Every quantity; the last eleven only where a state has a target.
pub const QUANTITIES: &[Quantity] = &[
    polynomial("body_inertias"),
    polynomial("body_poses"),
    polynomial("body_twists"),
    polynomial("end_effector_poses"),
    polynomial("end_effector_twists"),
    polynomial("end_effector_jacobian"),
    polynomial("mass_matrix"),
    polynomial("bias"),
    polynomial("linear_momentum"),
    polynomial("angular_momentum"),
    polynomial("kinetic_energy"),
    solved("generalized_inertia"),
    solved("generalized_bias"),
    solved("generalized_jacobian"),
    solved("base_acceleration"),
    solved("joint_accelerations"),
    solved("impact.G"),
    solved("impact.H"),
    solved("impact.joint_rates_after"),
    solved("capture.base_twist_after"),
    solved("capture.joint_rates_after"),
    solved("capture.target_twists_after"),
    solved("capture.impulses"),
    polynomial("merged body_inertias"),
    polynomial("merged mass_matrix"),
    solved("merged base_acceleration"),
    solved("merged joint_accelerations"),
];
