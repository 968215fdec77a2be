//! Every bound of a comparison, and why it is what it is. Absolute, in SI units, unless it says relative.

/// ReDySim prints seven digits; its own integration error is about 5e-7.
pub const REDYSIM: f64 = 1e-6;
/// notes.md's numbers of the exactly tracked approach: half of the last digit that is printed.
pub const PRINTED_DIGITS: f64 = 5e-9;
/// Impulse table of the notes: five decimals are printed.
pub const PRINTED_IMPULSE: f64 = 6e-6;
/// Independent model (DOP853 at 1e-13) at the end of the approach: RK4 at 5 ms under PD, 1e-10 measured.
pub const APPROACH: f64 = 1e-9;
/// The same 50 s after the impact: angles grow with the error of the rates times the time, 3e-10 measured.
pub const POST_IMPACT: f64 = 5e-9;
/// Momentum of robot and targets before and after the exact impact, per unit: rounding of a 9 × 9 solve.
pub const MOMENTUM_JUMP: f64 = 1e-12;
/// Two ways to the same velocities after an impact, relative: rounding times the condition of M, below 1e4 here.
pub const SAME_IMPACT: f64 = 1e-11;
/// Pinocchio's states, relative to the largest entry: both round in double precision, 3e-14 measured.
pub const PINOCCHIO: f64 = 1e-12;
/// Single precision against double, relative: 300 operations at 6e-8 each, and the cancellation in them.
pub const SINGLE: f64 = 2e-4;
/// A lane against the scalar, relative: the lanes' sine differs by 2 ulp.
pub const LANE: f64 = 1e-12;
/// A derivative by dual numbers against the closed form, relative: rounding.
pub const DUAL: f64 = 1e-11;
/// Angle, rate and acceleration of a trajectory against central differences of step 1e-5, per unit.
pub const DIFFERENCE_QUOTIENT: f64 = 1e-8;
/// Values of a polynomial at its ends: rounding.
pub const POLYNOMIAL: f64 = 1e-14;
/// Identities of mechanics between generated functions, relative to the sum of the terms' magnitudes: rounding of some
/// hundred operations, 1e-14 measured.
pub const IDENTITY: f64 = 1e-12;
/// The same where a system of equations was solved on the way: rounding times its condition, below 1e4 for these robots.
pub const SOLVED_IDENTITY: f64 = 1e-10;
/// Energy, work and momentum along the time series of the paper's study, J, N s, N m s, all below 1: the integration
/// error of RK4 at 5 ms, 4e-13 measured.
pub const TIME_SERIES: f64 = 1e-11;
/// A quarter of a second of free motion by Runge–Kutta steps of 0.25 ms, relative: its error is O(step⁴).
pub const INTEGRATED: f64 = 1e-8;
