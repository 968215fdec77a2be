//! What a core cannot do faster: operations of an evaluation, and how many of them it makes in a second at most.

use crate::clock::Clock;
use planar_capture::generated::dual_arm_3r::MANIFEST;
use planar_capture::scalar::Scalar;
use std::hint::black_box;

/// The vector that a register of the build holds.
#[cfg(target_feature = "avx512f")]
type Register = wide::f64x8;
#[cfg(all(target_feature = "avx", not(target_feature = "avx512f")))]
type Register = wide::f64x4;
#[cfg(not(target_feature = "avx"))]
type Register = wide::f64x2;

/// As many independent sums as hide each other's latency, and with two constants fit into 16 registers.
const SUMS: usize = 12;
const TURNS: u16 = 1000;

/// Products and sums of numbers that are in registers.
pub fn operation(clock: &mut impl Clock) {
    let constants = [0.999, 1e-3].map(Register::constant);
    let lanes = size_of::<Register>() / size_of::<f64>();
    let operations = u32::from(TURNS) * u32::try_from(2 * SUMS * lanes).expect("some hundred");
    clock.each("operation at the peak", operations, &[constants], |&[factor, addend]| {
        let mut sums = [factor; SUMS];
        for _ in 0..TURNS {
            for sum in &mut sums {
                *sum = Scalar::mul_add(*sum, factor, addend);
            }
        }
        black_box(sums);
    });
}

/// Sums and products of a sine with its cosine: three products and sums reduce an angle, two polynomials of degree 5 and their ends
/// follow.
const OF_SINES: usize = 35;

/// Sums, products and divisions of each function of the robot's module, by its name.
pub fn operations() -> impl Iterator<Item = (String, usize)> {
    MANIFEST.operations.iter().map(|of| (of.function.replace('_', " "), of.flops() + OF_SINES * of.sin_cos))
}
