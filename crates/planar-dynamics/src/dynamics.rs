//! The traits of a robot's dynamics, eqs. (1), (2) and (10) to (16), for generated models and generic ones.
//!
//! Arguments are slices, whose lengths are checked once per call. Matrices are row-major. An input or result that is not
//! finite and a singular system are an [`Error`]; no result is NaN. Buffers for results then hold nothing of use, and no NaN
//! of this call.
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
//! use planar_dynamics::dynamics::AnyModel;
//! use planar_dynamics::state::{Forces, State};
//!
//! let robot: &AnyModel<f64> = &Model::<f64>::default();
//! let (joint_angles, joint_rates, torques) = (&[0.5; JOINTS], &[0.3; JOINTS], Forces::torques(&[2.0; JOINTS]));
//! let state = State { base_pose: [0.0; 3], joint_angles, base_twist: [0.1, 0.0, 0.2], joint_rates };
//! let (mut accelerations, mut mass_matrix, mut bias) = ([0.0; 9], [0.0; 81], [0.0; 9]);
//! let base = robot.forward_dynamics(&state, &torques, &mut accelerations[3..])?;
//! accelerations[..3].copy_from_slice(&base);
//! robot.mass_matrix(&state.base_pose, joint_angles, &mut mass_matrix)?;
//! robot.bias(&state, &mut bias)?;
//! // eq. (1): no force on the base, 2 N m at every joint
//! for (i, row) in mass_matrix.chunks_exact(9).enumerate() {
//!     let inertial: f64 = row.iter().zip(&accelerations).map(|(m, a)| m * a).sum();
//!     assert!((inertial + bias[i] - if i < 3 { 0.0 } else { 2.0 }).abs() < 1e-9);
//! }
//! # Ok::<(), planar_dynamics::error::Error>(())
//! ```

use crate::error::Error;
use crate::scalar::Real;
use crate::state::{Forces, State};
use crate::target::Target;
use crate::{element, with_quantities};

/// Number of arms and joints, and inertias of the bodies.
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

macro_rules! method {
    ($(#[$doc:meta])* $method:ident(configuration) $kind:ident) => {
        $(#[$doc])*
        ///
        /// # Errors
        /// [`Error::Length`], [`Error::NotFinite`].
        fn $method(
            &self,
            base_pose: &[T; 3],
            joint_angles: &[T],
            $method: &mut [element!($kind T)],
        ) -> Result<(), Error>;
    };
    ($(#[$doc:meta])* $method:ident(state) $kind:ident) => {
        $(#[$doc])*
        ///
        /// # Errors
        /// [`Error::Length`], [`Error::NotFinite`].
        fn $method(&self, state: &State<'_, T>, $method: &mut [element!($kind T)]) -> Result<(), Error>;
    };
}

macro_rules! traits {
    (
        functions { $($(#[$doc:meta])* trait $trait:ident {
            $($(#[$of_method:meta])* $quantity:ident $method:ident($inputs:ident) $kind:ident $extents:tt $unit:literal, $shown:expr;)*
        })* }
        results $results:tt
    ) => {
        $($(#[$doc])* pub trait $trait<T: Real> {
            $(method!($(#[$of_method])* $method($inputs) $kind);)*
        })*
    };
}

// `Kinematics` and `EquationsOfMotion`, from the table of quantities
with_quantities!(traits);

/// The terms of eq. (2), `I θ̈ + c = τ`.
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

/// Eq. (1) solved for the accelerations.
pub trait ForwardDynamics<T: Real> {
    /// Returns [α, ax, ay] of the base COM, inertial axes, and fills the joint accelerations; rad/s², m/s².
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`], [`Error::Singular`].
    fn forward_dynamics(
        &self,
        state: &State<'_, T>,
        forces: &Forces<'_, T>,
        joint_accelerations: &mut [T],
    ) -> Result<[T; 3], Error>;

    /// A classical Runge–Kutta step of an integrated vector, from `time` on, where the compiler knows its length: that of
    /// [`RungeKutta4::robot_step`](crate::integrate::RungeKutta4::robot_step), in one call also where the type of the model is not known.
    /// Without `torques_at`, `torques` are those of all stages. `None`, with `x` unchanged, where the step is not regular and finite or
    /// has no torques, and for models without a definition of their own.
    #[doc(hidden)]
    fn step_at_once(
        &self,
        _torques_at: Option<&mut TorquesAt<'_, T>>,
        _time_and_step: [T; 2],
        _x: &mut [T],
        _torques: &mut [T],
    ) -> Option<()> {
        None
    }
}

/// Fills the torques at a time and an integrated vector; `None` where a law has none, or a base torque beside them.
#[doc(hidden)]
pub type TorquesAt<'a, T> = dyn FnMut(T, &[T], &mut [T]) -> Option<()> + 'a;

/// Momentum and kinetic energy at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Momentum<T> {
    /// [px, py], inertial axes, N s.
    pub linear_momentum: [T; 2],
    /// About the inertial origin, N m s.
    pub angular_momentum: T,
    /// J.
    pub kinetic_energy: T,
}

/// Momentum and energy of the robot.
pub trait MomentumAndEnergy<T: Real> {
    /// Momentum and kinetic energy of the robot.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    fn momentum(&self, state: &State<'_, T>) -> Result<Momentum<T>, Error>;
}

/// Rigid capture of targets, one per arm at most.
pub trait Impact<T: Real> {
    /// The paper's reduced equations as printed, (15) and (16): G (joints²), H (joints) and the joint rates afterwards,
    /// `G θ̇_f = H` with `G = I + Σ Jᵀ J_t⁻ᵀ I_t J_t⁻¹ J` and `H = I θ̇ + Σ Jᵀ J_t⁻ᵀ I_t t_t`.
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

    /// The exact impact in full coordinates: returns the base twist afterwards and fills the joint rates.
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

/// Merging of captured targets into the robot.
pub trait Merge<T: Real> {
    /// Makes each target, held at its contact point by the end effector, part of the last link of its arm. With a target's
    /// mass or inertia below 0 the merged robot may have one, too, which is not looked for.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`], and [`Error::Singular`] where a mass or moment of inertia is 0; the model is
    /// then unchanged.
    fn merge(&mut self, base_pose: &[T; 3], joint_angles: &[T], targets: &[Option<Target<T>>]) -> Result<(), Error>;
}

macro_rules! model {
    ($($part:ident)+) => {
        /// All traits of a robot's dynamics: what a simulation from approach to post-impact motion needs.
        pub trait Model<T: Real>: $($part<T> +)+ {}

        impl<T: Real, M: $($part<T> +)+> Model<T> for M {}
    };
}

model!(Robot Kinematics EquationsOfMotion ReducedDynamics ForwardDynamics MomentumAndEnergy Impact Merge);

/// A model whose type is not known where it is used.
pub type AnyModel<T> = dyn Model<T>;
