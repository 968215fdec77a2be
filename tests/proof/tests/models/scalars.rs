//! Generated code with every scalar (f64, f32, lanes, dual numbers), and its errors.

use planar_capture::dynamics::{ForwardDynamics, Kinematics, MomentumAndEnergy, ReducedDynamics};
use planar_capture::error::Error;
use planar_capture::generated::dual_arm_3r::{MANIFEST, Model, Parameters};
use planar_capture::scalar::Dual;
use planar_capture::scalar::{self, Scalar};
use planar_capture::state::{Forces, State};
use planar_proof::{assert_close, tolerance};

const POSE: [f64; 3] = [0.4, 1.0, -2.0];
const ANGLES: [f64; 6] = [0.3, -1.2, 0.7, 2.1, 1.4, -0.6];
const TWIST: [f64; 3] = [0.2, -0.3, 0.1];
const RATES: [f64; 6] = [0.4, -0.2, 0.9, -0.5, 0.3, 0.8];
const TORQUES: [f64; 6] = [1.0, -2.0, 0.5, 3.0, -1.5, 0.7];

fn accelerations<T: Scalar>(constant: impl Fn(f64) -> T + Copy) -> Vec<T> {
    let parameters = std::array::from_fn(|i| constant(MANIFEST.parameters[i].default));
    let result = Model::new(Parameters::from_array(parameters)).forward_dynamics(
        &POSE.map(constant),
        &ANGLES.map(constant),
        &TWIST.map(constant),
        &RATES.map(constant),
        &TORQUES.map(constant),
    );
    result.base_acceleration.into_iter().chain(result.joint_accelerations).collect()
}

#[test]
fn single_precision_agrees_with_double() {
    let double = accelerations(|x| x);
    let size = double.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    #[allow(clippy::cast_possible_truncation, reason = "that is the test")]
    let single: Vec<f64> = accelerations(|x| x as f32).into_iter().map(f64::from).collect();
    assert_close("f32", &single, &double, tolerance::SINGLE * size);
}

#[test]
fn every_lane_agrees_with_the_scalar() {
    use wide::{f64x4, f64x8};
    let double = accelerations(|x| x);
    let size = double.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    for lane in 0..4 {
        let lanes: Vec<f64> = accelerations(f64x4::splat).into_iter().map(|x| x.to_array()[lane]).collect();
        assert_close("f64x4", &lanes, &double, tolerance::LANE * size);
    }
    for lane in 0..8 {
        let lanes: Vec<f64> = accelerations(f64x8::splat).into_iter().map(|x| x.to_array()[lane]).collect();
        assert_close("f64x8", &lanes, &double, tolerance::LANE * size);
    }
}

/// Along a motion, dT/dt = τ·θ̇, d(momentum)/dt = 0 and d(end effector pose)/dt = its twist: the derivative part of
/// dual numbers through forward dynamics, momentum and kinematics.
#[test]
fn dual_numbers_give_the_power_balance() {
    let acceleration = accelerations(|x| x);
    let moving =
        |value: &[f64], rate: &[f64]| -> Vec<Dual> { value.iter().zip(rate).map(|(v, r)| Dual(*v, *r)).collect() };
    let model = Model::<Dual>::default();
    let pose: [Dual; 3] = moving(&POSE, &TWIST).try_into().expect("three");
    let angles: [Dual; 6] = moving(&ANGLES, &RATES).try_into().expect("six");
    let twist: [Dual; 3] = moving(&TWIST, &acceleration[..3]).try_into().expect("three");
    let rates: [Dual; 6] = moving(&RATES, &acceleration[3..]).try_into().expect("six");

    let conserved = model.momentum(&pose, &angles, &twist, &rates);
    let power: f64 = TORQUES.iter().zip(RATES).map(|(t, r)| t * r).sum();
    let scale = 1e3; // N, N m of inertial forces in this state
    assert_close("power", &[conserved.kinetic_energy.1], &[power], tolerance::DUAL * scale);
    let drift = [conserved.linear_momentum[0].1, conserved.linear_momentum[1].1, conserved.angular_momentum.1];
    assert_close("momentum rate", &drift, &[0.0; 3], tolerance::DUAL * scale);

    let end_effectors = model.end_effector_poses(&pose, &angles);
    let twists = Model::<f64>::default().end_effector_twists(&POSE, &ANGLES, &TWIST, &RATES);
    for (end_effector, twist) in end_effectors.iter().zip(twists) {
        assert_close("end effector", &end_effector.map(|d| d.1), &twist, tolerance::DUAL);
    }
}

/// No shipped graph has a square root or an angle of a vector; a robot's constants may.
#[test]
fn dual_numbers_have_the_derivatives_of_roots_angles_and_minima() {
    for (x, y, rate) in [(0.7, -1.3, 0.4), (2.5e-3, 0.9, -3.0), (41.0, 7.5, 1.0)] {
        let (a, b) = (Dual(x, rate), Dual(y, 2.0 * rate));
        let root = x.sqrt();
        assert_close("root", &[a.sqrt().0, a.sqrt().1], &[root, rate / (2.0 * root)], 1e-15 * (1.0 + 1.0 / root));
        let (angle, square) = (b.atan2(a), x * x + y * y);
        let expected = [y.atan2(x), (x * 2.0 * rate - y * rate) / square];
        assert_close("angle", &[angle.0, angle.1], &expected, 1e-14 * (1.0 + 1.0 / x));
        let smaller = if x < y { a } else { b };
        assert_eq!((Scalar::minimum(a, b), Scalar::minimum(b, a)), (smaller, smaller));
    }
    assert_eq!(Dual(0.0, 0.0).sqrt(), Dual(0.0, 0.0));
}

fn state<'a>(angles: &'a [f64], rates: &'a [f64]) -> State<'a, f64> {
    State { base_pose: POSE, joint_angles: angles, base_twist: TWIST, joint_rates: rates }
}

#[test]
fn numbers_that_are_not_finite_are_errors_that_name_them() {
    let model = Model::<f64>::default();
    let mut angles = ANGLES;
    angles[4] = f64::NAN;
    let mut out = [0.0; 6];
    let found =
        ForwardDynamics::forward_dynamics(&model, &state(&angles, &RATES), &Forces::torques(&TORQUES), &mut out);
    assert!(matches!(found, Err(Error::NotFinite { quantity: "joint_angles", index: 4, value }) if value.is_nan()));
    let torques = [0.0, f64::INFINITY, 0.0, 0.0, 0.0, 0.0];
    let found =
        ForwardDynamics::forward_dynamics(&model, &state(&ANGLES, &RATES), &Forces::torques(&torques), &mut out);
    assert_eq!(found, Err(Error::NotFinite { quantity: "joint_torques", index: 1, value: f64::INFINITY }));
    // finite input whose result is not
    let rates = [1e200; 6];
    let found = MomentumAndEnergy::momentum(&model, &state(&ANGLES, &rates));
    assert!(matches!(found, Err(Error::NotFinite { quantity: "kinetic_energy", index: 0, .. })), "{found:?}");
}

#[test]
fn lengths_are_checked() {
    let model = Model::<f64>::default();
    let mut out = [0.0; 6];
    let found =
        ForwardDynamics::forward_dynamics(&model, &state(&ANGLES[..5], &RATES), &Forces::torques(&TORQUES), &mut out);
    assert_eq!(found, Err(Error::Length { quantity: "joint_angles", expected: 6, found: 5 }));
    let mut poses = [[0.0; 3]; 3];
    let found = Kinematics::end_effector_poses(&model, &POSE, &ANGLES, &mut poses);
    assert_eq!(found, Err(Error::Length { quantity: "end_effector_poses", expected: 2, found: 3 }));
}

#[test]
fn singular_robots_are_errors() {
    // neither base nor links have mass or inertia
    let model = Model::new(Parameters::<f64>::from_array([0.0; 30]));
    let mut out = [0.0; 6];
    let found =
        ForwardDynamics::forward_dynamics(&model, &state(&ANGLES, &RATES), &Forces::torques(&TORQUES), &mut out);
    assert!(matches!(found, Err(Error::Singular { .. })), "{found:?}");
    let (mut inertia, mut bias, mut jacobian) = ([0.0; 36], [0.0; 6], [0.0; 36]);
    let found =
        ReducedDynamics::reduced_dynamics(&model, &state(&ANGLES, &RATES), &mut inertia, &mut bias, &mut jacobian);
    assert!(matches!(found, Err(Error::Singular { .. })), "{found:?}");
    assert!(out.iter().all(|x| x.to_bits() == 0), "nothing is written where there is no result");
}

/// Angles of every size: a turn, the border of the exact reduction, and far beyond it.
fn angles() -> impl Iterator<Item = f64> {
    let near = (-40_000..40_000).map(|i| f64::from(i) * 0.001_234_567);
    let quarters = (-1000..1000).flat_map(|i| {
        let quarter = f64::from(i) * std::f64::consts::FRAC_PI_2;
        [quarter.next_down(), quarter, quarter.next_up(), quarter / 2.0]
    });
    let wide = (0..400).flat_map(|i| [1.7, -2.3].map(|x: f64| x * 1.1_f64.powi(i)));
    near.chain(quarters).chain(wide).chain([0.0, -0.0, f64::MIN_POSITIVE, f64::MAX])
}

#[test]
fn sine_and_cosine_are_the_librarys() {
    for angle in angles() {
        let ((sine, cosine), (right_sine, right_cosine)) = (scalar::sin_cos_f64(angle), angle.sin_cos());
        let bound = if angle.abs() < 1.6e6 { tolerance::SINE } else { tolerance::SINE_FAR };
        assert!((sine - right_sine).abs() <= bound, "sin {angle:e}: {sine:e}, not {right_sine:e}");
        assert!((cosine - right_cosine).abs() <= bound, "cos {angle:e}: {cosine:e}, not {right_cosine:e}");
        assert!((sine * sine + cosine * cosine - 1.0).abs() <= 2.0 * tolerance::SINE, "{angle:e}");
    }
    for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(scalar::sin_cos_f64(odd).0.is_nan() && scalar::sin_cos_f64(odd).1.is_nan());
    }
}

#[test]
fn sine_and_cosine_in_single_precision() {
    #[allow(clippy::cast_possible_truncation, reason = "that is the test")]
    for angle in angles().map(|angle| angle as f32).filter(|angle| angle.is_finite()) {
        let ((sine, cosine), (right_sine, right_cosine)) = (scalar::sin_cos_f32(angle), f64::from(angle).sin_cos());
        let bound = if angle.abs() < 6e3 { tolerance::SINE_SINGLE } else { tolerance::SINE_FAR_SINGLE };
        assert!((f64::from(sine) - right_sine).abs() <= bound, "sin {angle:e}: {sine:e}, not {right_sine:e}");
        assert!((f64::from(cosine) - right_cosine).abs() <= bound, "cos {angle:e}: {cosine:e}, not {right_cosine:e}");
    }
    for odd in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert!(scalar::sin_cos_f32(odd).0.is_nan() && scalar::sin_cos_f32(odd).1.is_nan());
    }
}

/// Angles in which near ones, far ones and what is not a number follow each other.
fn mixed_angles() -> Vec<f64> {
    let odd = [f64::NAN, f64::INFINITY, -0.0, 1e300, -3e6, f64::NEG_INFINITY];
    angles().step_by(97).chain(odd).chain(angles().skip(5).step_by(131)).collect()
}

/// The bits of a batch are those of its angles one by one, whatever its length is.
#[cfg(not(feature = "fused"))]
#[test]
fn a_batch_of_sines_has_the_bits_of_each() {
    fn check<const N: usize>(angles: &[f64]) {
        for angles in angles.chunks_exact(N) {
            let angles: [f64; N] = angles.try_into().expect("as many");
            for ((sine, cosine), angle) in f64::sin_cos_all(angles).into_iter().zip(angles) {
                let (right_sine, right_cosine) = scalar::sin_cos_f64(angle);
                let bits = [sine, cosine].map(f64::to_bits);
                let is_same = bits == [right_sine, right_cosine].map(f64::to_bits);
                assert!(is_same || (sine.is_nan() && right_sine.is_nan()), "{N}: {angle:e} gives {sine:e}, {cosine:e}");
            }
        }
    }
    let angles = mixed_angles();
    check::<1>(&angles);
    check::<2>(&angles);
    check::<3>(&angles);
    check::<4>(&angles);
    check::<5>(&angles);
    check::<7>(&angles);
    check::<8>(&angles);
    check::<9>(&angles);
    check::<13>(&angles);
    check::<16>(&angles);
}

/// So are those of lanes.
#[cfg(not(feature = "fused"))]
#[test]
fn lanes_have_the_sines_of_the_scalar() {
    macro_rules! check {
        ($lanes:ident, $float:ident, $count:literal, $sin_cos:ident) => {
            #[allow(clippy::cast_possible_truncation, clippy::unnecessary_cast, reason = "that is the test")]
            let angles: Vec<$float> = mixed_angles().into_iter().map(|angle| angle as $float).collect();
            for angles in angles.chunks_exact($count) {
                let angles: [$float; $count] = angles.try_into().expect("as many");
                let (sine, cosine) = Scalar::sin_cos(wide::$lanes::from(angles));
                for ((angle, sine), cosine) in angles.into_iter().zip(sine.to_array()).zip(cosine.to_array()) {
                    let (right_sine, right_cosine) = scalar::$sin_cos(angle);
                    let is_same =
                        [sine, cosine].map($float::to_bits) == [right_sine, right_cosine].map($float::to_bits);
                    assert!(is_same || (sine.is_nan() && right_sine.is_nan()), "{angle:e} gives {sine:e}, {cosine:e}");
                }
            }
        };
    }
    check!(f64x2, f64, 2, sin_cos_f64);
    check!(f64x4, f64, 4, sin_cos_f64);
    check!(f64x8, f64, 8, sin_cos_f64);
    check!(f32x4, f32, 4, sin_cos_f32);
    check!(f32x8, f32, 8, sin_cos_f32);
    check!(f32x16, f32, 16, sin_cos_f32);
}

/// With the feature `fused`, too, a batch has the sines of the library.
#[cfg(feature = "fused")]
#[test]
fn a_fused_batch_has_the_librarys_sines() {
    for angles in mixed_angles().chunks_exact(7) {
        let angles: [f64; 7] = angles.try_into().expect("seven");
        for ((sine, cosine), angle) in f64::sin_cos_all(angles).into_iter().zip(angles) {
            assert!((sine - angle.sin()).abs() <= tolerance::SINE_FAR || angle.sin().is_nan(), "{angle:e}: {sine:e}");
            assert!(
                (cosine - angle.cos()).abs() <= tolerance::SINE_FAR || angle.cos().is_nan(),
                "{angle:e}: {cosine:e}"
            );
        }
    }
}
