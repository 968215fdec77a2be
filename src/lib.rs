//! Closed-form planar dynamics of free-floating multi-arm space robots, from approach through impact to post-impact.
//!
//! A layout of arms and links (TOML) becomes an expression graph (JSON, derived with CasADi) and the graph becomes
//! plain Rust: [`generated`]. What it is used for follows Raina & Shah, *Impact Modeling and Estimation for Multi-Arm
//! Space Robot while Capturing Tumbling Orbiting Objects* (2017); equation numbers are the paper's.
//!
//! | equation | where |
//! |---|---|
//! | (1) equations of motion | [`dynamics::EquationsOfMotion`], [`dynamics::ForwardDynamics`] |
//! | (2) reduced form: generalized inertia, bias, Jacobian | [`dynamics::ReducedDynamics`] |
//! | (3)–(5) target, contact Jacobian `J_t` | [`target`] |
//! | (6), (7) approach trajectory | [`trajectory::Quartic`], [`trajectory::QuarticAsPrinted`] |
//! | other trajectories | [`trajectory::Cycloidal`], [`trajectory::Quintic`] |
//! | end rates from the generalized Jacobian | `capture::approach::terminal_rates` |
//! | final joint angles from wanted end effector poses | `capture::approach::inverse_kinematics` |
//! | (10)–(16) impact, G and H | [`dynamics::Impact`], [`impact::exact`], [`impact::paper`] |
//! | (12) impulse | [`target::Target::impulse`] |
//! | (17) base twist from momentum | [`impact::paper`] |
//! | (18) PD control | [`control::ProportionalDerivative`] |
//! | resolved motion rate control of the end effectors | [`control::ResolvedMotionRate`] |
//! | computed torque; torque limits; sampled control | [`control::ComputedTorque`], [`control::Limited`], [`control::Sampled`] |
//! | momentum equation (17) in place of the base's equations of motion | [`formulation::Reduced`] |
//! | canonical momenta, for integrators that keep them | [`formulation::Canonical`], [`integrate::GaussLegendre`] |
//! | other integrators | [`integrate`] |
//! | events that end a phase | `simulate::event` |
//! | contacts of any kind at once: rigid, pinned, bouncing | [`mod@contact`], [`contact::impact()`] |
//! | extended inverse inertia tensor, impulse index and ellipse | [`contact::InverseInertia`] |
//! | contacts found by detection | `study::gaps` |
//! | post-impact: the merged robot | [`dynamics::Merge`] |
//! | closed loops, pinned targets | [`contact::Hold`] |
//! | stabilisation after the impact, the paper's future work | [`control::Stabilise`] |
//!
//! # Conventions
//! SI units and radians. Planar twists are `[ω, vx, vy]`, wrenches and impulses `[n, fx, fy]`, poses `[yaw, x, y]`, in
//! inertial axes; positive rotation is anticlockwise. Generalized velocity: the twist of the base COM, then the joint
//! rates arm by arm. Joint angles are relative. End-effector wrenches and impulses act *on the robot*. Angular momentum
//! is about the inertial origin. Matrices are row-major.
//!
//! # The core and the rest
//! Without default features the crate is the core: `no_std`, without allocation and panics, generic over the
//! [scalar](scalar::Scalar). Feature `std` adds files, scenarios and simulation, `build` the generation of modules for
//! other crates, `urdf` layouts from URDF files and back, `cli` (the default) the command line, `figures` figures as
//! SVG and PNG, `parquet` time series as Parquet, `mcap` recordings for Foxglove and Rerun, `lanes` SIMD lanes as
//! scalars.
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
//!
//! let robot = Model::<f64>::default(); // the paper's robot; `Model::new` takes other numbers
//! let joint_angles = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047];
//! // what depends on the configuration alone is computed once …
//! let configuration = robot.forward_dynamics_configuration(&[0.0; 3], &joint_angles);
//! // … and used with any velocities and torques
//! let at_rest = configuration.forward_dynamics(&[0.0; 3], &[0.0; JOINTS], &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
//! assert!(at_rest.joint_accelerations[2] > 0.0);
//! ```
#![cfg_attr(not(feature = "std"), no_std)]

// generated modules name this crate, from within it too
extern crate self as planar_capture;

pub mod generated;
pub mod integrate;

#[cfg(feature = "lanes")]
pub use planar_dynamics::lanes;
#[doc(hidden)]
pub use planar_dynamics::validate;
pub use planar_dynamics::{
    body, contact, control, dynamics, error, formulation, impact, implement_dynamics, include_layout, manifest,
    quantity, scalar, state, target, trajectory,
};

#[cfg(feature = "build")]
pub use planar_build as build;
#[cfg(feature = "std")]
pub use planar_build::prove::{self as generate, evaluation, generic, owned, quantities, sampling};
#[cfg(feature = "std")]
pub use planar_layout::{diagnostic, layout, structure};

#[cfg(feature = "std")]
pub mod capture;
#[cfg(feature = "std")]
pub mod check;
#[cfg(feature = "std")]
pub mod compare;
#[cfg(feature = "std")]
pub mod eval;
#[cfg(feature = "std")]
pub mod outline;
#[cfg(feature = "std")]
pub mod output;
#[cfg(feature = "std")]
pub mod python_package;
#[cfg(feature = "std")]
pub mod registry;
#[cfg(feature = "figures")]
pub mod reproduction;
#[cfg(feature = "std")]
pub mod scenario;
#[cfg(feature = "std")]
pub mod simulate;
#[cfg(feature = "urdf")]
pub mod urdf;
