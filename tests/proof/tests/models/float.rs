//! The core's square roots and arctangents, against the standard library's.

use planar_capture::scalar::Scalar;
use planar_proof::tolerance;

/// Every size and sign, with the values between which formulas change.
fn numbers() -> impl Iterator<Item = f64> + Clone {
    let sizes = (-300..=300).map(|exponent| 10.0_f64.powi(exponent) * 1.7);
    let some = [0.0, 1.0, 2.0, 0.5, f64::MIN_POSITIVE, f64::MIN_POSITIVE / 8.0, f64::MAX, 1.0 + f64::EPSILON];
    sizes.chain(some).flat_map(|x| [x, -x])
}

#[test]
fn square_roots_are_the_librarys() {
    for x in numbers().filter(|x| *x >= 0.0) {
        assert_same_bits(x);
    }
    // every exponent and size of the first digits
    for exponent in -1074..1024 {
        (0..64).for_each(|i| assert_same_bits((1.0 + f64::from(i) * 0.015_73) * 2.0_f64.powi(exponent)));
    }
    assert!(Scalar::sqrt(-1.0_f64).is_nan() && Scalar::sqrt(f64::NAN).is_nan());
    assert!(Scalar::sqrt(f64::INFINITY).is_infinite());
}

#[track_caller]
fn assert_same_bits(x: f64) {
    let (found, right) = (Scalar::sqrt(x), x.sqrt());
    assert_eq!(found.to_bits(), right.to_bits(), "√{x:e}: {found:e}, not {right:e}");
}

#[test]
fn arctangents_are_the_librarys() {
    let turn = |i: i32| f64::from(i) * std::f64::consts::PI / 720.0;
    let around = (-720..=720).map(|i| turn(i).sin_cos());
    let far = numbers().step_by(7).flat_map(|y| numbers().step_by(11).map(move |x| (y, x)));
    for (y, x) in around.chain(far) {
        let (found, right) = (Scalar::atan2(y, x), y.atan2(x));
        // −0 and 0 are one direction: π, where the library has −π
        let difference = (found - right).abs();
        let difference = difference.min((difference - std::f64::consts::TAU).abs());
        assert!(difference <= tolerance::ARCTANGENT, "atan2({y:e}, {x:e}): {found:e}, not {right:e}");
    }
    assert!(Scalar::atan2(f64::NAN, 1.0_f64).is_nan());
}

#[test]
fn single_precision_is_the_rounded_double() {
    #[allow(clippy::cast_possible_truncation, reason = "that is the test")]
    for x in numbers().map(|x| x as f32).filter(|x| *x >= 0.0 && x.is_finite()) {
        assert!((Scalar::sqrt(x) - x.sqrt()).abs() <= f32::EPSILON * x.sqrt());
        assert!((Scalar::atan2(x, 2.0_f32) - x.atan2(2.0)).abs() <= f32::EPSILON);
    }
    let (sine, cosine) = Scalar::sin_cos(0.5_f32);
    assert!((sine - 0.5_f32.sin()).abs() + (cosine - 0.5_f32.cos()).abs() <= 2.0 * f32::EPSILON);
    assert!(Scalar::minimum(<f32 as Scalar>::ONE, <f32 as Scalar>::ZERO) < f32::constant(0.1));
    assert!(Scalar::minimum(<f64 as Scalar>::ZERO, <f64 as Scalar>::ONE) < f64::constant(0.1));
    assert_eq!(Scalar::sin_cos(0.0_f64), (0.0, 1.0));
}
