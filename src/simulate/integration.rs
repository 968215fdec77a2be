//! The integrator and the coordinates of a phase.

/// By which integrator, in which coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integration {
    /// The integrator.
    pub scheme: Scheme,
    /// What is integrated.
    pub coordinates: Formulation,
}

/// An integrator; its [properties](Scheme::properties) and steps are in [`stepper`](super::stepper).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scheme {
    /// Classical Runge–Kutta steps of order 4.
    #[default]
    RungeKutta4,
    /// Rates, then positions by the new rates: order 1.
    SemiImplicitEuler,
    /// Gauss–Legendre steps of order 6 in canonical variables: symplectic, conserves both momenta.
    GaussLegendre,
    /// Verner's pair of orders 9 and 8, with adaptive steps.
    Adaptive {
        /// Relative and absolute, of each step.
        tolerance: f64,
    },
}

/// What is integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Formulation {
    /// Base and joints.
    #[default]
    Full,
    /// The joints and the base pose; the base twist follows from the momentum.
    Reduced,
}
