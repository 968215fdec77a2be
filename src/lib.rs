//! Closed-form planar dynamics of free-floating multi-arm space robots, from approach through impact to post-impact.
//!
//! A layout of arms and links (TOML) becomes an expression graph (JSON, derived with CasADi) and the graph becomes
//! plain Rust: [`generated`]. The phases follow Raina & Shah, *Impact Modeling and Estimation for Multi-Arm Space Robot
//! while Capturing Tumbling Orbiting Objects* (2017).
//!
//! It never contains: a formula of the dynamics of its own, in place of the core's, the generated or the generic ones.
//!
//! Methods of models are traits: the derivation of each equation is in `codegen`, its generic formula in
//! `planar_build::prove::generic`, in files of the same names (`reduced_dynamics.py` and `reduced.rs` for eq. (2),
//! `impact.py` and `impact.rs` for eqs. (10) to (16)).
//!
//! # Equations of the paper
//! | equation | meaning | item |
//! |---|---|---|
//! | (1) | equations of motion: mass matrix, bias, forward dynamics | [`dynamics::EquationsOfMotion`], [`dynamics::ForwardDynamics`] |
//! | (2) | reduced form: generalized inertia, bias and Jacobian; torques | [`dynamics::ReducedDynamics`], [`control::InverseDynamics`] |
//! | (3)–(5) | target, contact Jacobian `J_t` | [`target::Target`], [`target::Target::contact_jacobian`] |
//! | (6), (7) | approach trajectory; as printed | [`trajectory::Quartic`]; [`trajectory::QuarticAsPrinted`] |
//! | (10), (11), (13) | momentum balance of the impact: in full coordinates; reduced | [`impact::exact`]; [`impact::paper`] |
//! | (12) | impulse, solved from eq. (3) | [`target::Target::impulse`] |
//! | (14) | target twist after the impact | [`target::Target::twist_from_contact`] |
//! | (15), (16) | joint rates after the impact: G and H | [`dynamics::Impact::reduced_impact`], [`impact::paper`] |
//! | (17) | base twist from the momentum (`momentum_equation.rs` of the core) | [`impact::paper`], [`formulation::ReducedCoordinates`] |
//! | (18) | PD control | [`control::ProportionalDerivative`] |
//!
//! # Beyond the paper
//! | computation | item |
//! |---|---|
//! | terminal joint rates from end effector twists, by the generalized Jacobian | `capture::approach::terminal_rates` |
//! | final joint angles from end effector poses | `capture::approach::inverse_kinematics` |
//! | other trajectories | [`trajectory::Cycloidal`], [`trajectory::Quintic`] |
//! | resolved motion rate control of the end effectors | [`control::ResolvedMotionRate`] |
//! | computed torque; torque limits; sampled control | [`control::ComputedTorque`], [`control::TorqueLimiter`], [`control::SampledControl`] |
//! | canonical variables, for integrators that conserve momenta | [`formulation::CanonicalVariables`], [`integrate::GaussLegendre`] |
//! | other integrators | [`integrate`] |
//! | events that end a phase; contact detection | `simulate::event`, `capture::contact_detection` |
//! | several contacts at once: rigid, pinned, bouncing | [`mod@contact`], [`contact::impact()`] |
//! | extended inverse inertia tensor, impulse index and ellipse | [`contact::InverseInertia`], `capture::contact_response` |
//! | robot with captured targets: merged links, closed loops | [`dynamics::Merge`], [`contact::ConstraintSolver`] |
//! | stabilisation after the capture, the paper's future work | [`control::Stabilisation`] |
//!
//! # Conventions
//! SI units and radians. Planar twists are `[ω, vx, vy]`, wrenches and impulses `[n, fx, fy]`, poses `[yaw, x, y]`, in
//! inertial axes; positive rotation is anticlockwise. Generalized velocity: the twist of the base COM, then the joint
//! rates arm by arm. Joint angles are relative. End-effector wrenches and impulses act *on the robot*. Angular momentum
//! is about the inertial origin. Matrices are row-major.
//!
//! # Features
//! Without default features the crate is the core: `no_std`, without allocation and panics, generic over the
//! [scalar](scalar::Scalar). Feature `std` adds files, scenarios and simulation, `build` the generation of modules for
//! other crates, `urdf` layouts from URDF files and back, `fmu` FMUs for co-simulation, `cli` (the default) the command
//! line, `sweep` (another default) campaigns, `figures` figures as SVG and PNG, `parquet` time series as Parquet, `mcap` recordings for Foxglove and Rerun,
//! `lanes` SIMD lanes as scalars, `batch` many instances at once, `fused` products and sums with one rounding where the processor has
//! it, `serde` the formats of serde, `prove` the proof of what build scripts render.
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
//!
//! Derivatives: `docs/derivatives.md`; directional ones by [dual numbers](scalar::Dual).
#![cfg_attr(docsrs, feature(doc_cfg))]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, reason = "results have the same bits on every processor"))]
#![cfg_attr(not(feature = "std"), no_std)]

/// The examples of the documents.
#[cfg(doctest)]
#[doc = include_str!("../docs/derivatives.md")]
pub struct Examples;

// generated modules name this crate, from within it too
extern crate self as planar_capture;

pub mod generated;
pub mod integrate;

/// # Example
/// ```
/// use planar_capture::batch::{Accelerations, Batch, States, Status};
/// use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
///
/// const N: usize = 100;
/// let robot = Model::<f64>::default();
/// let states = States {
///     base_poses: &[0.0; 3 * N], // all yaws, then all x, then all y
///     joint_angles: &[0.5; JOINTS * N],
///     base_twists: &[0.0; 3 * N],
///     joint_rates: &[0.0; JOINTS * N],
/// };
/// let torques = [1.0; JOINTS * N];
/// let (mut base, mut joints) = ([0.0; 3 * N], [0.0; JOINTS * N]);
/// let mut statuses = [Status::Done; N];
/// let mut accelerations = Accelerations { base: &mut base, joints: &mut joints };
/// Batch::new(&robot).forward_dynamics(&states, &torques, &mut accelerations, &mut statuses)?;
/// assert!(statuses.iter().all(|status| *status == Status::Done));
/// assert!(joints[0] != 0.0 && joints[0] == joints[N - 1]);
/// # Ok::<(), planar_capture::error::Error>(())
/// ```
#[cfg(feature = "batch")]
pub use planar_dynamics::batch;
#[cfg(feature = "batch")]
#[doc(hidden)]
pub use planar_dynamics::implement_batch;
#[cfg(feature = "lanes")]
pub use planar_dynamics::lanes;
#[doc(hidden)]
pub use planar_dynamics::validate;
pub use planar_dynamics::{
    body, contact, control, dynamics, error, formulation, impact, impact_equations, implement_dynamics, include_layout,
    manifest, quantity, scalar, state, target, trajectory,
};

#[cfg(feature = "build")]
pub use planar_build as build;
/// # Example
/// ```
/// use planar_capture::evaluator::{Batch, Status};
/// use planar_capture::{graphs, layout::Layout};
///
/// const N: usize = 100;
/// let layout = Layout::read("codegen/layouts/dual_arm_3r.toml".as_ref()).expect("a layout");
/// let evaluator = graphs::find(&layout)?.evaluator;
/// let robot = evaluator.model(&layout).expect("a layout of the graph's structure");
///
/// // the elements of each instance follow each other
/// let (base_poses, joint_angles) = ([0.0; N * 3], [0.5; N * 6]);
/// let (base_twists, joint_rates, joint_torques) = ([0.0; N * 3], [0.0; N * 6], [1.0; N * 6]);
/// let inputs: [&[f64]; 5] = [&base_poses, &joint_angles, &base_twists, &joint_rates, &joint_torques];
/// let (mut base, mut joints, mut statuses) = ([0.0; N * 3], [0.0; N * 6], [Status::Done; N]);
/// // without the third output, the smallest pivot: the statuses tell whether that is too small
/// let mut outputs = [Some(&mut base[..]), Some(&mut joints[..]), None];
/// Batch::of(&robot).call("forward_dynamics", &inputs, &mut outputs, &mut statuses)?;
/// assert!(statuses.iter().all(|status| *status == Status::Done));
/// assert!(joints[0] != 0.0 && joints[0] == joints[N * 6 - 6]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "std")]
pub use planar_build::evaluator;
#[cfg(feature = "std")]
pub use planar_build::prove::{self as generate, evaluation, generic, owned, quantities, rigid_capture, sampling};
#[cfg(feature = "std")]
pub use planar_layout::{diagnostic, format, layout, outline, structure};

#[cfg(feature = "sweep")]
pub mod campaign;
#[cfg(feature = "std")]
pub mod capture;
#[cfg(feature = "std")]
pub mod check;
#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "std")]
pub mod compare;
#[cfg(feature = "std")]
pub mod engine;
#[cfg(feature = "std")]
pub mod eval;
#[cfg(feature = "std")]
pub mod file_format;
#[cfg(feature = "fmu")]
pub mod fmu;
#[cfg(feature = "std")]
pub mod frames;
#[cfg(feature = "std")]
pub mod graphs;
#[cfg(feature = "std")]
pub mod laws;
#[cfg(feature = "std")]
pub mod named_layout;
#[cfg(feature = "std")]
pub mod output;
#[cfg(feature = "cli")]
pub mod own_crate;
#[cfg(feature = "std")]
mod plain_text;
#[cfg(feature = "std")]
pub mod program;
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
