//! Scalars: the traits of the numbers that the core and generated code compute with, and their implementations.
//!
//! # Example
//! ```
//! use planar_dynamics::scalar::{Dual, Scalar};
//!
//! fn kinetic_energy<T: Scalar>(mass: T, speed: T) -> T {
//!     T::constant(0.5) * mass * speed * speed
//! }
//!
//! assert_eq!(kinetic_energy(2.0_f32, 3.0), 9.0);
//! // 2 kg at 3 m/s; the derivative by the speed is the momentum
//! assert_eq!(kinetic_energy(Dual(2.0, 0.0), Dual(3.0, 1.0)), Dual(9.0, 6.0));
//! ```

mod accelerated;
mod both;
mod dual;
pub(crate) mod far_angle;
pub(crate) mod finite;
mod float;
#[doc(hidden)]
pub mod lane;
mod number;
mod pair;
mod portable;
mod real;
pub(crate) mod sine;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
mod sine_batch;
#[cfg(any(feature = "lanes", target_arch = "x86_64", target_arch = "aarch64"))]
pub(crate) mod sine_lanes;

pub use dual::Dual;
pub use number::Scalar;
pub use pair::Pair;
pub use portable::{sqrt_f32, sqrt_f64};
pub use real::Real;
pub use sine::double::sin_cos as sin_cos_f64;
pub use sine::single::sin_cos as sin_cos_f32;

#[cfg(all(test, any(target_arch = "x86_64", target_arch = "aarch64")))]
mod tests {
    use super::{accelerated, portable};

    /// Square roots have the same bits on every target: roots of all magnitudes, of squares, and next to a tie.
    #[test]
    fn square_roots_have_the_bits_of_the_processor() {
        let special = [0.0, -0.0, 1.0, 4.0, -1.0, 5e-324, f64::MIN_POSITIVE, f64::MAX, f64::INFINITY, f64::NAN];
        let near = |bits: u64| [bits - 1, bits, bits + 1].map(f64::from_bits);
        let ties = (0..2000_u64).flat_map(|i| near((4.0_f64 - f64::EPSILON * 4.0).to_bits() - i));
        // even steps through all bits by the golden ratio
        let spread = (1..200_000_u64).flat_map(|i| {
            let x = f64::from_bits(i.wrapping_mul(0x9e37_79b9_7f4a_7c15) % (2047 << 52));
            let square = near(((x % 1e150) * (x % 1e150)).max(1e-300).to_bits());
            [x, square[0], square[1], square[2]]
        });
        let single = [0.0, -0.0, 1.0, 4.0, -1.0, 1e-45, f32::MIN_POSITIVE, f32::MAX, f32::INFINITY, f32::NAN];
        let ties_single =
            (0..2000_u32).flat_map(|i| [4.0_f32.to_bits() - i, 1.0_f32.to_bits() - i].map(f32::from_bits));
        let spread_single = (1..400_000_u32).map(|i| f32::from_bits(i.wrapping_mul(0x9e37_79b9) % (255 << 23)));
        for value in single.into_iter().chain(spread_single).chain(ties_single) {
            let (own, processor) = (portable::sqrt_f32(value), accelerated::sqrt_f32(value));
            assert!(own.to_bits() == processor.to_bits() || (own.is_nan() && processor.is_nan()), "{value:e}");
        }
        for value in special.into_iter().chain(spread).chain(ties) {
            let (own, processor) = (portable::sqrt_f64(value), accelerated::sqrt_f64(value));
            assert!(own.to_bits() == processor.to_bits() || (own.is_nan() && processor.is_nan()), "{value:e}");
            assert!(processor.to_bits() == value.sqrt().to_bits() || processor.is_nan(), "{value:e}");
        }
    }
}
