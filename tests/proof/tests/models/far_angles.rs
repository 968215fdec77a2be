//! Every finite angle is valid in every generated function, whatever the others are: a sum of angles beyond the largest
//! number counts as that number. An infinite one shows.

use planar_capture::scalar::{Dual, Scalar};
use planar_proof::for_every_layout;
use wide::{f32x8, f64x4};

/// What a function is called, and its results, a pivot last.
type Results<T> = Vec<(&'static str, Vec<T>)>;

/// That two functions of the same name have the same bits in all results.
fn assert_same(found: &Results<f64>, expected: &Results<f64>, what: &str) {
    for ((function, found), (_, expected)) in found.iter().zip(expected) {
        let bits = |numbers: &[f64]| numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(found), bits(expected), "{what}: {function} {found:?} {expected:?}");
    }
}

macro_rules! far_angles {
    ($($name:ident)*) => {$(
        mod $name {
            use super::*;
            use planar_capture::generated::$name::{ARMS, JOINTS, Model};

            /// Of all functions, at one configuration.
            fn results<T: Scalar>(yaw: T, angles: &[T; JOINTS]) -> Results<T> {
                let model = Model::<T>::default();
                let number = T::constant;
                let pose = [yaw, number(0.3), number(-0.2)];
                let (twist, rates) = ([0.2, -0.4, 0.1].map(number), [0.6; JOINTS].map(number));
                let (torques, wrench) = ([1.5; JOINTS].map(number), [0.3, 2.0, -1.0].map(number));
                let (masses, inertias) = ([9.0; ARMS].map(number), [0.4; ARMS].map(number));
                let (contacts, twists) = ([[0.2, -0.1].map(number); ARMS], [[0.1, -0.3, 0.2].map(number); ARMS]);
                let forward = model
                    .forward_dynamics_with_wrenches(&pose, angles, &twist, &rates, &torques, &wrench, &[wrench; ARMS]);
                let reduced = model.reduced_dynamics(&pose, angles, &twist, &rates);
                let jacobian = model.generalized_jacobian(&pose, angles);
                let momentum = model.momentum(&pose, angles, &twist, &rates);
                let impact =
                    model.reduced_impact(&pose, angles, &rates, &masses, &inertias, &contacts, &twists);
                let full =
                    model.full_impact(&pose, angles, &twist, &rates, &masses, &inertias, &contacts, &twists);
                let pose = &pose;
                vec![
                    ("forward_dynamics_with_wrenches", [
                        &forward.base_acceleration[..], &forward.joint_accelerations, &[forward.smallest_pivot],
                    ].concat()),
                    ("mass_matrix", model.mass_matrix(pose, angles).concat()),
                    ("bias", model.bias(pose, angles, &twist, &rates).to_vec()),
                    ("reduced_dynamics", [
                        reduced.generalized_inertia.as_flattened(), &reduced.generalized_bias,
                        reduced.generalized_jacobian.as_flattened(), &[reduced.smallest_pivot],
                    ].concat()),
                    ("generalized_jacobian", [
                        jacobian.generalized_jacobian.as_flattened(), &[jacobian.smallest_pivot],
                    ].concat()),
                    ("end_effector_poses", model.end_effector_poses(pose, angles).concat()),
                    ("end_effector_jacobian", model.end_effector_jacobian(pose, angles).concat()),
                    ("end_effector_twists", model.end_effector_twists(pose, angles, &twist, &rates).concat()),
                    ("body_poses", model.body_poses(pose, angles).concat()),
                    ("body_twists", model.body_twists(pose, angles, &twist, &rates).concat()),
                    ("momentum", [
                        &momentum.linear_momentum[..], &[momentum.angular_momentum, momentum.kinetic_energy],
                    ].concat()),
                    ("reduced_impact", [
                        impact.impact_matrix.as_flattened(), &impact.impact_momentum, &impact.joint_rates_after,
                        &[impact.smallest_pivot],
                    ].concat()),
                    ("full_impact", [
                        full.impact_matrix.as_flattened(), &full.impact_momentum, &full.base_twist_after,
                        &full.joint_rates_after, &[full.smallest_pivot],
                    ].concat()),
                ]
            }

            /// The largest number with the sign of each of the last digits of `signs`.
            fn largest<T: Scalar>(signs: usize, largest: T) -> (T, [T; JOINTS]) {
                let angle = |k: usize| if signs >> (k % 8) & 1 == 0 { largest } else { -largest };
                (angle(JOINTS), std::array::from_fn(angle))
            }

            #[test]
            fn every_finite_angle_is_valid() {
                fn check<T: Scalar>(number: T, numbers: impl Fn(T) -> Vec<f64>) {
                    for signs in 0..256 {
                        let (yaw, angles) = largest(signs, number);
                        for (function, results) in results(yaw, &angles) {
                            let results: Vec<f64> = results.into_iter().flat_map(&numbers).collect();
                            assert!(results.iter().all(|result| result.is_finite()), "{function}, {signs:b}: {results:?}");
                        }
                    }
                }
                for number in [f64::MAX, 1e308, 9e307] {
                    check(number, |number| vec![number]);
                }
                check(f32::MAX, |number| vec![f64::from(number)]);
                check(f64x4::splat(f64::MAX), |lanes| lanes.to_array().to_vec());
                check(f32x8::splat(f32::MAX), |lanes| lanes.to_array().map(f64::from).to_vec());
                check(Dual(f64::MAX, 1.0), |Dual(value, rate)| vec![value, rate]);
                check(Dual(f32::MAX, 1.0), |Dual(value, rate)| vec![f64::from(value), f64::from(rate)]);
            }

            /// All that depends on absolute angles, at the largest one of every link.
            #[test]
            fn a_sum_beyond_the_largest_number_is_that_number() {
                for number in [f64::MAX, f64::MIN] {
                    let (found, expected) = (results(number, &[number; JOINTS]), results(number, &[0.0; JOINTS]));
                    assert_same(&found[1..].to_vec(), &expected[1..].to_vec(), &format!("{number:e}"));
                }
            }

            /// Other lanes are not changed by a far one.
            #[cfg(not(feature = "fused"))]
            #[test]
            fn lanes_have_the_bits_of_each() {
                let lanes = [(0.4, 1.1), (f64::MAX, f64::MAX), (-1e308, -9e307), (3.0, 1e300)];
                let [yaws, angles] = [lanes.map(|(yaw, _)| yaw), lanes.map(|(_, angle)| angle)].map(f64x4::from);
                let of_lanes = results(yaws, &[angles; JOINTS]);
                for (lane, (yaw, angle)) in lanes.into_iter().enumerate() {
                    let found: Results<f64> = of_lanes
                        .iter()
                        .map(|(name, results)| (*name, results.iter().map(|lanes| lanes.to_array()[lane]).collect()))
                        .collect();
                    assert_same(&found, &results(yaw, &[angle; JOINTS]), &format!("lane {lane}"));
                }
            }

            #[test]
            fn an_infinite_angle_shows() {
                for infinite in [f64::INFINITY, f64::NEG_INFINITY] {
                    for place in 0..=JOINTS {
                        for other in [0.7, f64::MAX] {
                            let (mut yaw, mut angles) = (other, [other; JOINTS]);
                            *angles.get_mut(place).unwrap_or(&mut yaw) = infinite;
                            for (function, results) in results(yaw, &angles) {
                                let seen = results.iter().any(|result| result.is_nan());
                                assert!(seen, "{function}: {infinite} in the place {place} leaves no trace");
                            }
                        }
                    }
                }
            }
        }
    )*};
}

for_every_layout!(far_angles);
