//! How a phase is integrated.

/// By which integrator, in which coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integration {
    /// The integrator.
    pub scheme: Scheme,
    /// What is integrated.
    pub coordinates: Formulation,
}

/// An integrator. What each is and can stands with its steps, in [`stepper`](super::stepper).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scheme {
    /// Classical Runge–Kutta steps of order 4.
    #[default]
    RungeKutta4,
    /// Rates, then positions by the new rates: order 1.
    SemiImplicitEuler,
    /// Gauss–Legendre steps of order 6 in canonical variables: keeps both momenta, and the energy for very long times.
    GaussLegendre,
    /// Verner's pair of orders 9 and 8, with steps of its own.
    Adaptive {
        /// Relative and per unit, of each step.
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
