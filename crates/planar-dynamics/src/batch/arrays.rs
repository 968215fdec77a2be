//! The numbers of a batch: matrices in row-major order with one row per number and one column per instance.

/// Positions and velocities, in the units of [`State`](crate::state::State).
#[derive(Clone, Copy, Debug)]
pub struct States<'a> {
    /// [yaw, x, y] of the base COMs: 3 rows.
    pub base_poses: &'a [f64],
    /// A row per joint, arm by arm.
    pub joint_angles: &'a [f64],
    /// [ω, vx, vy] of the base COMs: 3 rows.
    pub base_twists: &'a [f64],
    /// A row per joint.
    pub joint_rates: &'a [f64],
}

/// As [`States`], as results.
#[derive(Debug)]
pub struct StatesAfter<'a> {
    /// [yaw, x, y] of the base COMs: 3 rows.
    pub base_poses: &'a mut [f64],
    /// A row per joint, arm by arm.
    pub joint_angles: &'a mut [f64],
    /// [ω, vx, vy] of the base COMs: 3 rows.
    pub base_twists: &'a mut [f64],
    /// A row per joint.
    pub joint_rates: &'a mut [f64],
}

/// What every arm captures, in the units of [`Target`](crate::target::Target); masses and inertias of 0 where it
/// captures nothing.
#[derive(Clone, Copy, Debug)]
pub struct Targets<'a> {
    /// A row per arm.
    pub masses: &'a [f64],
    /// A row per arm.
    pub inertias: &'a [f64],
    /// [rx, ry] from the COM to the contact point: 2 rows per arm.
    pub contacts: &'a [f64],
    /// [ω, vx, vy] of the COM before the impact: 3 rows per arm.
    pub twists: &'a [f64],
}

/// Results of [`Batch::forward_dynamics`](super::Batch::forward_dynamics).
#[derive(Debug)]
pub struct Accelerations<'a> {
    /// [α, ax, ay] of the base COMs: 3 rows; rad/s², m/s².
    pub base: &'a mut [f64],
    /// A row per joint; rad/s².
    pub joints: &'a mut [f64],
}

/// Results of [`Batch::reduced_dynamics`](super::Batch::reduced_dynamics).
#[derive(Debug)]
pub struct ReducedDynamics<'a> {
    /// I of eq. (2), row-major: joints² rows; kg m².
    pub generalized_inertia: &'a mut [f64],
    /// c of eq. (2): a row per joint; N m.
    pub generalized_bias: &'a mut [f64],
    /// J of eq. (2), row-major: 3 arms × joints rows; 1, m.
    pub generalized_jacobian: &'a mut [f64],
}

/// Results of [`Batch::reduced_impact`](super::Batch::reduced_impact).
#[derive(Debug)]
pub struct ReducedImpact<'a> {
    /// G, row-major: joints² rows; kg m².
    pub impact_matrix: &'a mut [f64],
    /// H: a row per joint; N m s.
    pub impact_momentum: &'a mut [f64],
    /// A row per joint; rad/s.
    pub joint_rates_after: &'a mut [f64],
}

/// Results of [`Batch::full_impact`](super::Batch::full_impact).
#[derive(Debug)]
pub struct FullImpact<'a> {
    /// [ω, vx, vy] of the base COMs: 3 rows; rad/s, m/s.
    pub base_twists_after: &'a mut [f64],
    /// A row per joint; rad/s.
    pub joint_rates_after: &'a mut [f64],
}
