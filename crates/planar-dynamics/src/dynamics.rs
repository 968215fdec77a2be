//! What every model of a robot can do, generated or generic. Slices; lengths are checked once per call.
//!
//! Matrices are row-major. Where a number that comes in is not finite, or a system is singular, the answer is
//! an [`Error`] with the numbers, never a NaN.

use crate::error::Error;
use crate::scalar::Real;
use crate::state::{Forces, State};
use crate::target::Target;

/// Size and bodies of a robot.
pub trait Robot<T: Real> {
    /// Number of arms.
    fn arms(&self) -> usize;

    /// Number of joints of all arms.
    fn joints(&self) -> usize;

    /// [mass, inertia about the COM] of every body: the base, then the links arm by arm; kg, kg m².
    ///
    /// # Errors
    /// [`Error::Length`] unless there is room for joints + 1.
    fn body_inertias(&self, inertias: &mut [[T; 2]]) -> Result<(), Error>;
}

/// Poses, twists and Jacobians.
pub trait Kinematics<T: Real> {
    /// [yaw, x, y] of each tip, inertial frame; the yaw is not wrapped.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    fn end_effector_poses(&self, base_pose: &[T; 3], joint_angles: &[T], poses: &mut [[T; 3]]) -> Result<(), Error>;

    /// `[J_be J_me]`: 3 arms × (3 + joints).
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    fn end_effector_jacobian(&self, base_pose: &[T; 3], joint_angles: &[T], jacobian: &mut [T]) -> Result<(), Error>;

    /// [ω, vx, vy] of each tip, inertial axes.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    fn end_effector_twists(&self, state: &State<'_, T>, twists: &mut [[T; 3]]) -> Result<(), Error>;

    /// [yaw, x, y] of every body's COM: the base, then the links arm by arm.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    fn body_poses(&self, base_pose: &[T; 3], joint_angles: &[T], poses: &mut [[T; 3]]) -> Result<(), Error>;

    /// [ω, vx, vy] of every body's COM: the base, then the links arm by arm.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    fn body_twists(&self, state: &State<'_, T>, twists: &mut [[T; 3]]) -> Result<(), Error>;
}

/// The full coordinates: M and `[c_b; c_m]` of eq. (1).
pub trait EquationsOfMotion<T: Real> {
    /// M: (3 + joints)².
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    fn mass_matrix(&self, base_pose: &[T; 3], joint_angles: &[T], mass_matrix: &mut [T]) -> Result<(), Error>;

    /// `[c_b; c_m]`: 3 + joints.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    fn bias(&self, state: &State<'_, T>, bias: &mut [T]) -> Result<(), Error>;
}

/// The reduced coordinates of eq. (2).
pub trait ReducedDynamics<T: Real> {
    /// I (joints²), c (joints) and J (3 arms × joints).
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`], [`Error::Singular`].
    fn reduced_dynamics(
        &self,
        state: &State<'_, T>,
        generalized_inertia: &mut [T],
        generalized_bias: &mut [T],
        generalized_jacobian: &mut [T],
    ) -> Result<(), Error>;
}

/// Accelerations from forces.
pub trait ForwardDynamics<T: Real> {
    /// Returns [α, ax, ay] of the base COM and fills the joint accelerations.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`], [`Error::Singular`].
    fn forward_dynamics(
        &self,
        state: &State<'_, T>,
        forces: &Forces<'_, T>,
        joint_accelerations: &mut [T],
    ) -> Result<[T; 3], Error>;
}

/// Momentum and kinetic energy at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Momentum<T> {
    /// [px, py], inertial axes, N s.
    pub linear_momentum: [T; 2],
    /// About the inertial origin, N m s.
    pub angular_momentum: T,
    /// J.
    pub kinetic_energy: T,
}

/// Conserved quantities.
pub trait Conserved<T: Real> {
    /// Momentum and kinetic energy of the robot.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    fn momentum(&self, state: &State<'_, T>) -> Result<Momentum<T>, Error>;
}

/// Rigid capture of targets, one per arm at most.
pub trait Impact<T: Real> {
    /// The paper's reduced equations, literally: G (joints²), H (joints) and the joint rates after it, (15)–(16).
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`], [`Error::Singular`].
    fn reduced_impact(
        &self,
        state: &State<'_, T>,
        targets: &[Option<Target<T>>],
        impact_matrix: &mut [T],
        impact_momentum: &mut [T],
        joint_rates_after: &mut [T],
    ) -> Result<(), Error>;

    /// The exact impact in full coordinates: returns the base twist after it and fills the joint rates.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`], [`Error::Singular`].
    fn full_impact(
        &self,
        state: &State<'_, T>,
        targets: &[Option<Target<T>>],
        joint_rates_after: &mut [T],
    ) -> Result<[T; 3], Error>;
}

/// Becoming one with what was captured.
pub trait Merge<T: Real> {
    /// Merges each target, held at its contact point by the tip, with the last link of its arm.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`]; the model is then as it was.
    fn merge(&mut self, base_pose: &[T; 3], joint_angles: &[T], targets: &[Option<Target<T>>]) -> Result<(), Error>;
}

/// Everything that a simulation from approach to post-impact asks of a robot.
pub trait Model<T: Real>:
    Robot<T>
    + Kinematics<T>
    + EquationsOfMotion<T>
    + ReducedDynamics<T>
    + ForwardDynamics<T>
    + Conserved<T>
    + Impact<T>
    + Merge<T>
{
}

impl<T, M> Model<T> for M
where
    T: Real,
    M: Robot<T>
        + Kinematics<T>
        + EquationsOfMotion<T>
        + ReducedDynamics<T>
        + ForwardDynamics<T>
        + Conserved<T>
        + Impact<T>
        + Merge<T>,
{
}
