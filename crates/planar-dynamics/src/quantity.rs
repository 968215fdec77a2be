//! The table of quantities: name, unit, shape and function of everything that a model computes.
//!
//! A row defines the method of its trait with its implementations for generated models and the generic one, its place in
//! `eval`, in `compare` and in the reference vectors of generated modules, and the tests that every layout's graph has
//! it. A row of [`with_quantities!`](crate::with_quantities) also needs a derivation (`codegen/`), and a formula and
//! natural sizes in the generic implementation (`planar_build::prove`); the compiler reports those that are missing.
//!
//! # Example
//! ```
//! use planar_dynamics::quantity::Quantity;
//!
//! let jacobian = Quantity::EndEffectorJacobian.row();
//! // two arms with six joints: ω, vx and vy of each arm, by the base's three coordinates and the joints
//! let shape: Vec<usize> = jacobian.shape.iter().map(|extent| extent.count(2, 6)).collect();
//! assert_eq!((jacobian.name, shape), ("end_effector_jacobian", vec![6, 9]));
//! assert_eq!(Quantity::KineticEnergy.row().unit, "J");
//! ```

/// Number of entries along one axis of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The same for every robot.
    Fixed(usize),
    /// One per arm.
    Arms,
    /// ω, vx and vy of every arm.
    ArmTwists,
    /// One per joint.
    Joints,
    /// The base and every link.
    Bodies,
    /// The base's three coordinates and the joints.
    Coordinates,
}

impl Extent {
    /// The number for a robot of so many arms and joints.
    #[must_use]
    pub const fn count(self, arms: usize, joints: usize) -> usize {
        match self {
            Self::Fixed(count) => count,
            Self::Arms => arms,
            Self::ArmTwists => 3 * arms,
            Self::Joints => joints,
            Self::Bodies => joints + 1,
            Self::Coordinates => 3 + joints,
        }
    }
}

/// How rounding errors enter a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounding {
    /// By sums and products alone.
    Polynomial,
    /// Also by solving equations, which amplifies them by the condition number.
    Solved,
}

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Definition {
    /// The name in `compare`. `impact.G` is the entry `G` of the block `impact` in the output of `eval`.
    pub name: &'static str,
    /// SI unit, as written in graphs.
    pub unit: &'static str,
    /// One entry per axis, row-major; none for a scalar.
    pub shape: &'static [Extent],
    /// The functions of a generated model that return it.
    pub functions: &'static [&'static str],
    /// Its name among their results.
    pub output: &'static str,
    /// How rounding errors enter it.
    pub rounding: Rounding,
    /// Its place in the output of `eval`; `None` where it is not part of that.
    pub shown: Option<u8>,
}

/// Calls a macro with the table.
///
/// `functions` depend on the configuration or the state alone: each is a method of the trait before the brace, with a
/// `matrix`, a `vector` or a list of `triples` as its result. `results` are those of the other traits' methods. The
/// last entry is [`Definition::shown`].
#[doc(hidden)]
#[macro_export]
macro_rules! with_quantities {
    ($($apply:tt)+) => {
        $($apply)+! {
            functions {
                /// Poses, twists and Jacobians.
                trait Kinematics {
                    /// [yaw, x, y] of every body's COM, inertial frame: the base, then the links arm by arm.
                    BodyPoses body_poses(configuration) triples [Bodies] "rad, m, m", None;
                    /// [ω, vx, vy] of every body's COM, inertial axes: the base, then the links arm by arm.
                    BodyTwists body_twists(state) triples [Bodies] "rad/s, m/s, m/s", None;
                    /// [yaw, x, y] of each end effector, inertial frame; the yaw is not wrapped.
                    EndEffectorPoses end_effector_poses(configuration) triples [Arms] "rad, m, m", Some(5);
                    /// [ω, vx, vy] of each end effector, inertial axes.
                    EndEffectorTwists end_effector_twists(state) triples [Arms] "rad/s, m/s, m/s", None;
                    /// `[J_be J_me]`: 3 arms × (3 + joints).
                    EndEffectorJacobian end_effector_jacobian(configuration) matrix [ArmTwists, Coordinates] "1, m", Some(6);
                }
                /// The full coordinates: M and `[c_b; c_m]` of eq. (1).
                trait EquationsOfMotion {
                    /// M: (3 + joints)².
                    MassMatrix mass_matrix(configuration) matrix [Coordinates, Coordinates] "kg m^2, kg m, kg", Some(1);
                    /// `[c_b; c_m]`: 3 + joints.
                    Bias bias(state) vector [Coordinates] "N m, N, N, then N m", Some(2);
                }
            }
            results {
                BodyInertias "body_inertias": Polynomial [Bodies, Fixed(2)] "kg, kg m^2", [] "", None;
                LinearMomentum "linear_momentum": Polynomial [Fixed(2)] "N s", ["momentum"] "linear_momentum", Some(10);
                AngularMomentum "angular_momentum": Polynomial [] "N m s", ["momentum"] "angular_momentum", Some(11);
                KineticEnergy "kinetic_energy": Polynomial [] "J", ["momentum"] "kinetic_energy", Some(12);
                GeneralizedInertia "generalized_inertia": Solved [Joints, Joints] "kg m^2",
                    ["reduced_dynamics"] "generalized_inertia", Some(3);
                GeneralizedBias "generalized_bias": Solved [Joints] "N m",
                    ["reduced_dynamics"] "generalized_bias", Some(4);
                GeneralizedJacobian "generalized_jacobian": Solved [ArmTwists, Joints] "1, m, m per arm",
                    ["reduced_dynamics", "generalized_jacobian"] "generalized_jacobian", Some(7);
                BaseAcceleration "base_acceleration": Solved [Fixed(3)] "rad/s^2, m/s^2, m/s^2",
                    ["forward_dynamics", "forward_dynamics_with_base_wrench", "forward_dynamics_with_wrenches"]
                    "base_acceleration", Some(8);
                JointAccelerations "joint_accelerations": Solved [Joints] "rad/s^2",
                    ["forward_dynamics", "forward_dynamics_with_base_wrench", "forward_dynamics_with_wrenches"]
                    "joint_accelerations", Some(9);
                ImpactMatrix "impact.G": Solved [Joints, Joints] "kg m^2", ["reduced_impact"] "impact_matrix", Some(13);
                ImpactMomentum "impact.H": Solved [Joints] "N m s", ["reduced_impact"] "impact_momentum", Some(14);
                ImpactJointRates "impact.joint_rates_after": Solved [Joints] "rad/s",
                    ["reduced_impact"] "joint_rates_after", Some(15);
                CaptureBaseTwist "capture.base_twist_after": Solved [Fixed(3)] "rad/s, m/s, m/s",
                    ["full_impact"] "base_twist_after", Some(16);
                CaptureJointRates "capture.joint_rates_after": Solved [Joints] "rad/s",
                    ["full_impact"] "joint_rates_after", Some(17);
                CaptureTargetTwists "capture.target_twists_after": Solved [Arms, Fixed(3)] "rad/s, m/s, m/s",
                    [] "", Some(18);
                CaptureImpulses "capture.impulses": Solved [Arms, Fixed(3)] "N m s, N s, N s", [] "", Some(19);
                CaptureMomentum "capture momentum": Polynomial [Coordinates] "N m s, N s, N s, then N m s",
                    ["full_impact"] "impact_momentum", None;
                MergedBodyInertias "merged body_inertias": Polynomial [Bodies, Fixed(2)] "kg, kg m^2", [] "", None;
                MergedMassMatrix "merged mass_matrix": Polynomial [Coordinates, Coordinates] "kg m^2, kg m, kg",
                    ["full_impact"] "impact_matrix", None;
                MergedBaseAcceleration "merged base_acceleration": Solved [Fixed(3)] "rad/s^2, m/s^2, m/s^2",
                    [] "", None;
                MergedJointAccelerations "merged joint_accelerations": Solved [Joints] "rad/s^2", [] "", None;
            }
        }
    };
}

/// An element of the result of a function of the table.
#[doc(hidden)]
#[macro_export]
macro_rules! element {
    (triples $scalar:ty) => {
        [$scalar; 3]
    };
    ($matrix_or_vector:ident $scalar:ty) => {
        $scalar
    };
}

macro_rules! shape {
    (triples [$rows:ident]) => {
        &[Extent::$rows, Extent::Fixed(3)]
    };
    ($kind:ident [$($extent:ident $(($count:literal))?),*]) => {
        &[$(Extent::$extent $(($count))?),*]
    };
}

macro_rules! quantities {
    (
        functions { $($(#[$of_trait:meta])* trait $trait:ident {
            $($(#[$doc:meta])* $function:ident $method:ident($inputs:ident) $kind:ident $extents:tt $unit:literal, $shown:expr;)*
        })* }
        results { $($result:ident $name:literal: $rounding:ident $shape:tt $of:literal,
            $functions:tt $output:literal, $place:expr;)* }
    ) => {
        /// A quantity that a model computes at one state.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Quantity {
            $($($(#[$doc])* $function,)*)*
            $(#[doc = concat!("`", $name, "`.")] $result,)*
        }

        impl Quantity {
            /// All quantities, in the order of the table.
            pub const ALL: &'static [Self] = &[$($(Self::$function,)*)* $(Self::$result,)*];

            /// Its row of the table.
            #[must_use]
            pub const fn row(self) -> &'static Definition {
                match self {
                    $($(Self::$function => &Definition {
                        name: stringify!($method),
                        unit: $unit,
                        shape: shape!($kind $extents),
                        functions: &[stringify!($method)],
                        output: stringify!($method),
                        rounding: Rounding::Polynomial,
                        shown: $shown,
                    },)*)*
                    $(Self::$result => &Definition {
                        name: $name,
                        unit: $of,
                        shape: shape!(result $shape),
                        functions: &$functions,
                        output: $output,
                        rounding: Rounding::$rounding,
                        shown: $place,
                    },)*
                }
            }
        }
    };
}

with_quantities!(quantities);
