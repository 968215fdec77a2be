//! Every bound of a comparison, with its reason. Bounds are absolute and in SI units unless stated as relative.

/// ReDySim prints seven digits; its own integration error is about 5e-7.
pub const REDYSIM: f64 = 1e-6;
/// notes.md's numbers of the exactly tracked approach: half of the last digit that is printed.
pub const PRINTED_DIGITS: f64 = 5e-9;
/// Independent model (DOP853 at 1e-13) along approaches of 60 s under PD control: RK4 at 5 ms, 1.5e-11 measured.
pub const LONG_APPROACH: f64 = 1e-10;
/// Impulse table of the notes: five decimals are printed.
pub const PRINTED_IMPULSE: f64 = 6e-6;
/// Independent model (DOP853 at 1e-13) at the end of the approach: RK4 at 5 ms under PD, 1e-10 measured.
pub const APPROACH: f64 = 1e-9;
/// The same 50 s after the impact: angles grow with the error of the rates times the time, 3e-10 measured.
pub const POST_IMPACT: f64 = 5e-9;
/// Joint accelerations of a robot with a short link of little inertia, relative to the largest: rounding over the least
/// ratio of inertias that layouts may have, 1e-9.
pub const UNRESOLVED_LINK: f64 = 1e-6;
/// Momentum of robot and targets before and after the exact impact, per unit: rounding of a 9 × 9 solve.
pub const MOMENTUM_JUMP: f64 = 1e-12;
/// Two ways to the same velocities after an impact, relative: rounding times the condition of M, below 1e4 here.
pub const SAME_IMPACT: f64 = 1e-11;
/// Pinocchio's numbers, relative to the largest entry: both round in double precision, 5e-14 measured.
pub const PINOCCHIO: f64 = 1e-12;
/// Captures against sixty decimal digits, relative to the largest entry: rounding of a 21 × 21 elimination, 6e-15
/// measured.
pub const CAPTURE: f64 = 5e-14;
/// Impacts by the inverse inertia at the contacts and by the balance of momentum, relative to the largest entry, in
/// epsilon: random contacts that nearly depend on each other have a condition of 1e6 to 1e7, 4e5 measured.
pub const SAME_BALANCE: f64 = 1e7;
/// MuJoCo's, relative to the largest entry: it has absolute positions, of which 1000 m leave 1e-13 m; 1e-12 measured.
pub const MUJOCO: f64 = 1e-11;
/// Impacts by the full system with the impulses as unknowns, relative to the largest entry: small parts of its solution
/// keep fewer digits, the base twist of the boom the fewest, 3e-11 measured.
pub const OUTSIDE_IMPACT: f64 = 2e-10;
/// Single precision against double, relative: 300 operations at 6e-8 each, and the cancellation in them.
pub const SINGLE: f64 = 2e-4;
/// A lane against the scalar, relative: the lanes' sine differs by 2 ulp.
pub const LANE: f64 = 1e-12;
/// Own sine and cosine, absolute: rounding of the polynomials and the reduction, a unit in the last place of 1. Below
/// 1.5e-16 measured.
pub const SINE: f64 = 2e-16;
/// The same in `f32`. 9e-8 measured.
pub const SINE_SINGLE: f64 = 1e-7;
/// Far from 0, where the remainder has been rounded twice more.
pub const SINE_FAR: f64 = 3e-16;
/// The same in `f32`.
pub const SINE_FAR_SINGLE: f64 = 1.5e-7;
/// The core's arctangents, in rad: the last correction is of a few roundings of π.
pub const ARCTANGENT: f64 = 1e-15;
/// Generated derivatives against dual numbers through the same module, relative to the largest entry of the matrix: two
/// ways through systems of equations of condition below 1e4, 1e-12 measured.
pub const DERIVATIVE: f64 = 1e-10;
/// A derivative by dual numbers against the closed form, relative: rounding.
pub const DUAL: f64 = 1e-11;
/// Angle, rate and acceleration of a trajectory against central differences of step 1e-5, per unit.
pub const DIFFERENCE_QUOTIENT: f64 = 1e-8;
/// Values of a polynomial at its ends: rounding.
pub const POLYNOMIAL: f64 = 1e-14;
/// Identities of mechanics between generated functions, relative to the sum of the terms' magnitudes: rounding of some
/// hundred operations, 1e-14 measured.
pub const IDENTITY: f64 = 1e-12;
/// The same where a system of equations was solved on the way: rounding times its condition, below 1e4 for these
/// robots.
pub const SOLVED_IDENTITY: f64 = 1e-10;
/// Joint angles and rates that a law with inverse dynamics should give, rad, rad/s: the integration error of RK4 at 5
/// ms over 4 s of fast motion.
pub const CONTROLLED: f64 = 1e-8;
/// Residual motion after stabilisation for 50 s at 0.5 1/s, rad/s, N m s: exp(−25) of the initial motion.
pub const STABILISED: f64 = 1e-10;
/// Angles under hold control for 50 s after the paper's impact, rad, and rates, rad/s: the slowest mode
/// of 49 N m/rad and 14 N m s/rad on a stretched arm takes 40 s to decay, 5e-4 measured.
pub const HELD: f64 = 1e-3;
/// Rates that should decay exponentially, relative to the largest: RK4 steps of 5 ms of motions of up to 2 rad/s.
pub const DECAY: f64 = 1e-6;
/// End effector poses by inverse kinematics, rad, m: its iteration stops at 1e-11 per unit.
pub const REACHED: f64 = 1e-9;
/// End effectors along and at the end of their paths under resolved motion rate control, rad, m, rad/s, m/s: the
/// integration error of RK4 at 5 ms, which feedback reduces; 3e-10 measured, near a singular pose.
pub const STEERED: f64 = 1e-8;
/// The same with torques constant for up to 40 ms, at the end: half a sample of delay in accelerations of some mm/s².
pub const STEERED_SAMPLED: f64 = 1e-4;
/// Accelerations of end effectors, per unit, times the singularity margin: differences of twists of step 1e-6, and rounding
/// times the condition of the generalized Jacobian.
pub const STEERED_ACCELERATION: f64 = 1e-8;
/// Energy, work and momentum along the time series of the paper's study, J, N s, N m s, all below 1: the integration
/// error of RK4 at 5 ms, 4e-13 measured.
pub const TIME_SERIES: f64 = 1e-11;
/// A quarter of a second of free motion by Runge–Kutta steps of 0.25 ms, relative: its error is O(step⁴).
pub const INTEGRATED: f64 = 1e-8;
/// A central difference of the energy of step 1e-5, relative: its square, and rounding over the step.
pub const ENERGY_GRADIENT: f64 = 1e-8;
/// Times of events, s, and event functions there: events are located to 1e-13.
pub const EVENT_TIME: f64 = 1e-12;
/// Times, s, and relative impulses of contacts found in long steps, against RK4 at 1 ms: the errors of both
/// integrators, of which Gauss–Legendre has ten steps in a turn.
pub const LONG_STEPS: f64 = 1e-6;
/// Least distances and depths, m: the resolution of the search.
pub const CLEARANCE: f64 = 1e-6;
/// Joint angles, rad, after a minute of motion on a target of 1e5 times the robot's mass and on one of 1e7: the share of the
/// robot in the motion of the first, and what the motion makes of it.
pub const HEAVY_TARGETS: f64 = 1e-3;
/// Time of an event that passes zero by a nanometre, s: the value decreases by 2e-5 m/s there, and rounding over 600
/// steps is 1e-12 m.
pub const GRAZING: f64 = 1e-7;
/// The same steps to the same instant, the last of another length, rad, m and per second; 1e-11 by an interpolant.
pub const SAME_STEPS: f64 = 1e-10;
/// A measured order of convergence against the order: the next term of the error. 0.07 measured, of rk4 at 0.05 s.
pub const ORDER: f64 = 0.15;
/// The same of a difference of two solutions, whose leading terms partly cancel.
pub const ORDER_OF_DIFFERENCE: f64 = 0.5;
/// Error of an adaptive run of two seconds in units of its tolerance: the tolerance is of one step.
pub const ADAPTIVE: f64 = 1.0;
/// Rounding of a motion of two seconds, rad, m and per second.
pub const ROUNDED_MOTION: f64 = 2e-13;
/// The end of an approach by integrals over panels of one length and another, rad, m and per second: rounding of some
/// hundred sums.
pub const INTEGRALS: f64 = 1e-12;
/// Samples between adaptive steps at 1e-10 against steps that end there, rad, m and per second.
pub const DENSE: f64 = 1e-9;
/// Momentum drift in reduced coordinates, relative: rounding of a 3 × 3 solve, 4e-16 measured.
pub const MOMENTUM_RECOVERED: f64 = 1e-14;
/// Momentum drift of 4,000 Gauss–Legendre steps, relative: rounding of each, 7e-14 measured.
pub const MOMENTUM_KEPT: f64 = 1e-12;
/// Four seconds of the same free motion in full and in reduced coordinates at 1e-13, rad, m and per second.
pub const SAME_MOTION: f64 = 1e-11;
/// One second of it by Gauss–Legendre steps of 20 ms.
pub const SAME_MOTION_COARSE: f64 = 1e-10;
/// One second of a closed loop by several schemes, projected after every step, rad, m and per second.
pub const CLOSED_LOOP: f64 = 1e-8;
/// A straight line, m, rad: rounding.
pub const STRAIGHT: f64 = 1e-13;
/// One second under sampled torques by steps of 2 and 50 ms and adaptive ones, rad, m and per second.
pub const SAMPLED: f64 = 1e-9;

/// A layout from a URDF against numbers calculated by hand, and a mount angle through sine, cosine and arctangent.
pub const URDF: f64 = 1e-14;

use planar_dynamics::quantity::{Quantity, Rounding};
use planar_dynamics::scalar::Real;

/// Bound on the difference of a quantity between two formulations, in rounding units ε of the scalar: 2⁻⁵² in `f64`, 2⁻²³ in
/// `f32`. The same numbers hold for both, because the errors are roundings and nothing else.
#[derive(Clone, Copy, Debug)]
pub enum Equivalence {
    /// Times ε, in units of the entry's natural size (see `planar_capture::compare`).
    Scaled(f64),
    /// Times ε times the condition of the matrices solved on the way; 450 ε at least.
    Condition(f64),
}

impl Equivalence {
    /// The bound for one state of a model of this scalar.
    pub fn bound<T: Real>(self, condition: f64) -> f64 {
        let roundings = match self {
            Self::Scaled(roundings) => roundings,
            Self::Condition(factor) => (factor * condition).max(450.0),
        };
        roundings * T::EPSILON.to_f64()
    }
}

/// Generated against generic, measured over all layouts and regimes: a bound for every quantity by its kind of rounding
/// error, and smaller ones where measured.
pub fn equivalence(quantity: Quantity) -> Equivalence {
    match (quantity, quantity.row().rounding) {
        // parameters, copied
        (Quantity::BodyInertias, _) => Equivalence::Scaled(0.0),
        // sums and products in two orders: composite inertias against sums over bodies 3e-15 measured, positions,
        // twists and momenta below 2e-15, the bias by a centripetal sweep against differentiated Jacobians 6e-16
        (_, Rounding::Polynomial) => Equivalence::Scaled(45.0),
        // articulated inertias, eliminated centre of mass and arrow LDLᵀ against dense Cholesky: 0.1 of it measured for
        // accelerations and velocities after impacts, 0.4 for the generalized Jacobian
        (_, Rounding::Solved) => Equivalence::Condition(4.0),
    }
}

/// A bound below which a comparison in single precision says something: a hundredth of what makes an entry up.
pub const SAYS_SOMETHING: f64 = 1e-2;
/// Condition from which on a system may be refused in single precision: its smallest pivot is at most 8 ε of its scale, and
/// not much larger than the inverse of the condition. 5e5 here; ε is 1.2e-7.
pub const REFUSED_CONDITION: f64 = 1.0 / (16.0 * f32::EPSILON as f64);

/// What single precision changes in 20,000 steps, relative: each step rounds each number by at most ε/2, independent roundings
/// add up to their root of the number of steps, and four standard deviations are allowed. A third of it measured.
pub fn single_precision_approach() -> f64 {
    4.0 * 20_000.0_f64.sqrt() * f64::from(f32::EPSILON)
}

/// Outputs of generated functions that are in no trait, generated against generic, relative to the largest entry.
pub const INHERENT: &[(&str, f64, &str)] = &[
    ("generalized_jacobian alone", 1e-12, "condition of the base's inertia below 1e3 in the regime `moving`"),
    ("full impact_matrix", 1e-13, "sums of products; M + JᵀNJ"),
    ("full impact_momentum", 1e-13, "sums of products; M v + JᵀJ_t⁻ᵀ I_t t"),
];

/// Every shipped layout, and what it alone covers.
pub const LAYOUTS: &[(&str, &str)] = &[
    ("asymmetric_wheel", "off-axis COMs, mounts off the axis, a mount angle, a link of length zero"),
    ("boom_7r", "a long chain"),
    ("dual_arm_2r", "two arms that a capture closes to a short loop"),
    ("dual_arm_3r", "the paper's robot"),
    ("single_arm_2r", "fewer joints than end effector coordinates"),
    ("single_arm_3r", "ReDySim's robot"),
    ("triple_arm_3r", "three arms that meet in the base alone"),
];

/// A central difference of the mass matrix of step 1e-5, relative: its square, and rounding over the step.
pub const MASS_MATRIX_RATE: f64 = 1e-8;
/// A study with generic dynamics against the same with generated code, relative: rounding over 4000 steps.
pub const SAME_STUDY: f64 = 1e-9;
/// Generated accelerations, relative, times ε arm/distance for first two mounts close to each other: the base is two
/// point masses there, which grow as the distance falls. 0.1 measured.
pub const SHORT_DISTANCE: f64 = 1.0;
/// Generated accelerations, relative, for an inner link of any length: rounding of some hundred operations, 7e-14
/// measured.
pub const SHORT_LINK: f64 = 2e-13;

/// Accelerations and constraint forces in maximal coordinates, relative to the largest, against the product and against
/// the whole KKT matrix: rounding times the condition of joints in a chain, 1e-14 measured.
pub const MAXIMAL_ACCELERATION: f64 = 1e-12;
/// Velocities after impacts and impulses in maximal coordinates, relative to the largest, or to the largest momentum:
/// rounding times the condition of light links with heavy targets, 2e-13 measured.
pub const MAXIMAL_IMPACT: f64 = 1e-11;
/// Angles, poses and rates after some seconds, relative to the largest: the product's RK4 at 1 ms, 4e-10 measured where
/// an arm passes a folded configuration.
pub const MAXIMAL_MOTION: f64 = 1e-9;
/// Momentum and energy of the motion in maximal coordinates, relative; its constraints before projection, rad, m: an
/// integrator of order 12 whose steps are halved until their error is 1e-13 per unit.
pub const MAXIMAL_DRIFT: f64 = 1e-11;
/// The same constraints after projection, rad, m: rounding at some metres.
pub const MAXIMAL_CONSTRAINT: f64 = 1e-13;
/// The product's impacts of any contacts against those in maximal coordinates, relative to the largest, times the
/// square of the reference's margin of dependence: the inverse inertia at the contacts is a product of constraints.
/// 2e-13 measured.
pub const CONTACT_IMPACT: f64 = 2e-12;
/// The same in single precision.
pub const CONTACT_IMPACT_SINGLE: f64 = 2e-3;
/// Above this margin dependent contacts must be refused; below it, rounding may make them seem independent.
pub const DEPENDENCE_MARGIN: f64 = 0.05;
/// Axes of the ellipse of stopping impulses, relative: the eigenvalues of a square of a matrix of condition below 1e3.
pub const ELLIPSE: f64 = 1e-9;
/// Some seconds of motion under loop constraints, adaptively at 1e-12, against maximal coordinates, relative to the
/// largest: both have errors of 1e-13 per step, which loops amplify; 2e-12 measured.
pub const CONSTRAINED_MOTION: f64 = 2e-11;
/// Loop constraint errors at any step, rad or m, and rad/s or m/s: rounding at some metres. 4e-14 measured; the
/// documented bound is 1e-10.
pub const CONSTRAINT_ERROR: f64 = 1e-12;
/// Perturbation of constraints before projection, rad, m and per second.
pub const OPENED: f64 = 1e-5;
/// Centre of mass before and after that projection, m: the square of the perturbation times some metres.
pub const CENTRE: f64 = 1e-9;
/// Distance of an end effector from the outline at a detected contact, m.
pub const DETECTED: f64 = 1e-10;
/// Normals at contacts and poses of free targets, rad, m: rounding over 10,000 steps.
pub const IN_SERIES: f64 = 1e-11;
/// A base of 1e14 kg in place of a fixed one, rad/s.
pub const HEAVY_BASE: f64 = 1e-12;
/// Poses by a recording's chain of transforms against the model's: rounding of four rotations at a few metres, and of
/// 20 s of a target's free motion. Below 1e-14 measured.
pub const TRANSFORMS: f64 = 1e-13;
/// Loop constraint error after projection, rad or m, and its rate: rounding at some metres, 2e-14 measured.
pub const PROJECTED_CONSTRAINT: f64 = 1e-12;
/// Momentum and energy of a closed loop in 2 s of steps of 5 ms at up to 0.9 rad/s: RK4, 3e-7 measured near a singular
/// pose.
pub const CONSTRAINED_DRIFT: f64 = 1e-5;
/// A body under a rigid loop constraint against the same merged with its link, after 4 s: RK4 at 5 ms on both, 2e-10
/// measured.
pub const MERGED_MOTION: f64 = 1e-9;
/// Energy after an impact over that before, less 1: rounding for an elastic one, 2e-15 measured.
pub const ENERGY_OF_AN_IMPACT: f64 = 1e-12;
/// Velocities, momentum and energy of order 1 shown by a figure, against mechanics: their drift over a phase is 1e-11.
pub const FIGURE_VALUES: f64 = 1e-9;
/// Time (s) and impulses (N s, N m s) of a contact with a target at 1e6 m: 1.2e-10 m of its position over an approach speed
/// of some centimetres per second.
pub const FAR_CONTACT: f64 = 2e-8;
/// A Gauss–Legendre step whose iteration contracts by half at worst: some roundings of numbers of order one.
pub const SETTLED: f64 = 4e-13;
/// Time for ten times the text over that for the text: between ten, for linear time, and a hundred, for quadratic time.
pub const TEN_TIMES: f64 = 40.0;
/// A time below which its ratio to another says nothing, s: that of a few interruptions.
pub const SHORT_TIME: f64 = 0.01;
/// A step and impulses by a module of its own against the library's, per number: sines of several angles at once round
/// differently there.
pub const IN_ANOTHER_MODULE: f64 = 1e-11;
