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
/// Pinocchio's numbers, relative to the largest entry: both round in double precision, 5e-14 measured.
pub const PINOCCHIO: f64 = 1e-12;
/// MuJoCo's, relative to the largest entry: it has absolute positions, of which 1000 m leave 1e-13 m; 1e-12 measured.
pub const MUJOCO: f64 = 1e-11;
/// Impacts by the full system with the impulses as unknowns, relative to the largest entry: what is small beside
/// the rest of its solution keeps fewer digits, the base twist of the boom the fewest, 3e-11 measured.
pub const OUTSIDE_IMPACT: f64 = 2e-10;
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
