//! A number that is not one shows: in the pivot of every generated function whose matrix has it, otherwise in a result.

use planar_capture::scalar::{Dual, Real, Scalar};
use planar_proof::for_every_layout;
use std::array::from_fn;

/// The inputs of generated functions, in their order, and those that a pivot has to show.
const INPUTS: [&str; 11] = [
    "base_pose",
    "joint_angles",
    "base_twist",
    "joint_rates",
    "joint_torques",
    "base_wrench",
    "end_effector_wrenches",
    "target_masses",
    "target_inertias",
    "contacts",
    "target_twists",
];
const OF_THE_ROBOT: &[&str] = &["joint_angles"];
const OF_AN_IMPACT: &[&str] = &["joint_angles", "target_masses", "target_inertias", "contacts"];

/// What a function is called, which inputs it has, which of them its pivot shows, pivot and results.
struct Call<T> {
    function: &'static str,
    inputs: &'static [&'static str],
    shown: &'static [&'static str],
    pivot: T,
    results: Vec<T>,
}

macro_rules! pivots {
    ($($name:ident)*) => {$(
        mod $name {
            use super::*;
            use planar_capture::generated::$name::{ARMS, JOINTS, MANIFEST, Model, PARAMETERS, Parameters};
            use planar_capture::manifest::ParameterKind;

            const SIZES: [usize; 11] =
                [3, JOINTS, 3, JOINTS, JOINTS, 3, 3 * ARMS, ARMS, ARMS, 2 * ARMS, 3 * ARMS];

            /// Every function with a pivot, for parameters and the elements of all inputs.
            fn calls<T: Scalar>(parameters: [T; PARAMETERS], inputs: &[T]) -> Vec<Call<T>> {
                let model = Model::new(Parameters::from_array(parameters));
                let mut given = inputs.iter().copied();
                let mut next = || given.next().expect("as many as SIZES says");
                let pose: [T; 3] = from_fn(|_| next());
                let angles: [T; JOINTS] = from_fn(|_| next());
                let twist: [T; 3] = from_fn(|_| next());
                let rates: [T; JOINTS] = from_fn(|_| next());
                let torques: [T; JOINTS] = from_fn(|_| next());
                let wrench: [T; 3] = from_fn(|_| next());
                let wrenches: [[T; 3]; ARMS] = from_fn(|_| from_fn(|_| next()));
                let [masses, inertias]: [[T; ARMS]; 2] = from_fn(|_| from_fn(|_| next()));
                let contacts: [[T; 2]; ARMS] = from_fn(|_| from_fn(|_| next()));
                let twists: [[T; 3]; ARMS] = from_fn(|_| from_fn(|_| next()));
                let mut calls = Vec::new();
                let mut call = |function, inputs, shown, pivot, results: &[&[T]]| {
                    calls.push(Call { function, inputs, shown, pivot, results: results.concat() });
                };
                let r = model.forward_dynamics(&pose, &angles, &twist, &rates, &torques);
                let results = [&r.base_acceleration[..], &r.joint_accelerations];
                call("forward_dynamics", &INPUTS[..5], OF_THE_ROBOT, r.smallest_pivot, &results);
                let r = model.forward_dynamics_with_base_wrench(&pose, &angles, &twist, &rates, &torques, &wrench);
                let results = [&r.base_acceleration[..], &r.joint_accelerations];
                call("forward_dynamics_with_base_wrench", &INPUTS[..6], OF_THE_ROBOT, r.smallest_pivot, &results);
                let r = model
                    .forward_dynamics_with_wrenches(&pose, &angles, &twist, &rates, &torques, &wrench, &wrenches);
                let results = [&r.base_acceleration[..], &r.joint_accelerations];
                call("forward_dynamics_with_wrenches", &INPUTS[..7], OF_THE_ROBOT, r.smallest_pivot, &results);
                let r = model.reduced_dynamics(&pose, &angles, &twist, &rates);
                let results = [
                    r.generalized_inertia.as_flattened(), &r.generalized_bias, r.generalized_jacobian.as_flattened(),
                ];
                call("reduced_dynamics", &INPUTS[..4], OF_THE_ROBOT, r.smallest_pivot, &results);
                let r = model.generalized_jacobian(&pose, &angles);
                let results = [r.generalized_jacobian.as_flattened()];
                call("generalized_jacobian", &INPUTS[..2], OF_THE_ROBOT, r.smallest_pivot, &results);
                let r = model.reduced_impact(&pose, &angles, &rates, &masses, &inertias, &contacts, &twists);
                let of_targets = [&r.impact_matrix.as_flattened()[..], &r.impact_momentum, &r.joint_rates_after];
                let inputs = &["base_pose", "joint_angles", "joint_rates", INPUTS[7], INPUTS[8], INPUTS[9], INPUTS[10]];
                call("reduced_impact", inputs, OF_AN_IMPACT, r.smallest_pivot, &of_targets);
                let r = model.full_impact(&pose, &angles, &twist, &rates, &masses, &inertias, &contacts, &twists);
                let results = [
                    r.impact_matrix.as_flattened(), &r.impact_momentum, &r.base_twist_after, &r.joint_rates_after,
                ];
                let inputs = &[
                    "base_pose", "joint_angles", "base_twist", "joint_rates", INPUTS[7], INPUTS[8], INPUTS[9],
                    INPUTS[10],
                ];
                call("full_impact", inputs, OF_AN_IMPACT, r.smallest_pivot, &results);
                calls
            }

            /// Name and index of every element of the inputs, in order.
            fn elements() -> impl Iterator<Item = (&'static str, usize)> {
                INPUTS.into_iter().zip(SIZES).flat_map(|(name, size)| (0..size).map(move |i| (name, i)))
            }

            fn parameters() -> [f64; PARAMETERS] {
                from_fn(|i| MANIFEST.parameters[i].default)
            }

            /// Numbers of order one, positive.
            fn inputs() -> Vec<f64> {
                (0_u32..).zip(elements()).map(|(i, _)| 0.9 + 0.5 * (f64::from(i) * 1.7).sin()).collect()
            }

            #[test]
            fn an_input_that_is_not_a_number_shows() {
                assert!(calls(parameters(), &inputs()).iter().all(|call| call.pivot > 1e-3), "a state without NaN");
                for (place, (name, i)) in elements().enumerate() {
                    let mut inputs = inputs();
                    inputs[place] = f64::NAN;
                    for Call { function, inputs, shown, pivot, results } in calls(parameters(), &inputs) {
                        if shown.contains(&name) {
                            assert!(pivot.is_nan(), "{function}: {name}[{i}] = NaN leaves a pivot of {pivot}");
                        }
                        // positions and velocities of the whole robot change nothing but momenta
                        let absolute = ["base_pose", "base_twist"].contains(&name) && i > 0;
                        if inputs.contains(&name) && !absolute {
                            let seen = pivot.is_nan() || results.iter().any(|result| result.is_nan());
                            assert!(seen, "{function}: {name}[{i}] = NaN leaves no trace");
                        }
                    }
                }
            }

            #[test]
            fn a_parameter_that_is_not_a_number_shows() {
                for (place, parameter) in MANIFEST.parameters.iter().enumerate() {
                    let mut values = parameters();
                    values[place] = f64::NAN;
                    // where an end effector is matters to what acts there alone
                    let is_end = parameter.kind == ParameterKind::LinkLength
                        && parameter.link + 1 == MANIFEST.links[parameter.arm];
                    for Call { function, pivot, .. } in calls(values, &inputs()) {
                        let shown = !is_end || function.ends_with("impact");
                        assert!(pivot.is_nan() || !shown, "{function}: {} = NaN leaves a pivot of {pivot}", parameter.name);
                    }
                }
            }

            /// In one lane, it leaves the others alone.
            #[test]
            fn a_lane_that_is_not_a_number_shows() {
                use wide::f64x4;
                let clean = calls(parameters().map(f64x4::splat), &lanes(&inputs()));
                for (place, (name, i)) in elements().enumerate() {
                    let mut inputs = lanes(&inputs());
                    inputs[place] = f64x4::from([inputs[place].to_array()[0], f64::NAN, 1.1, 0.7]);
                    for (call, clean) in calls(parameters().map(f64x4::splat), &inputs).iter().zip(&clean) {
                        let [first, second, ..] = call.pivot.to_array();
                        let function = call.function;
                        assert!(second.is_nan() || !call.shown.contains(&name), "{function}: {name}[{i}] = NaN: {second}");
                        assert_eq!(first.to_bits(), clean.pivot.to_array()[0].to_bits(), "{function}: {name}[{i}]");
                    }
                }
            }

            fn lanes(values: &[f64]) -> Vec<wide::f64x4> {
                values.iter().map(|value| wide::f64x4::splat(*value)).collect()
            }
        }
    )*};
}

for_every_layout!(pivots);

/// The smaller one, and NaN where either is NaN, whatever the order.
#[test]
fn the_minimum_keeps_what_is_not_a_number() {
    fn check<T: Scalar>(lanes: impl Fn(T) -> Vec<f64>) {
        let minimum = |a: f64, b: f64| lanes(T::constant(a).minimum(T::constant(b)));
        for (a, b, smaller) in [(1.0, 2.0, 1.0), (2.0, 1.0, 1.0), (-1.0, 0.0, -1.0), (3.0, 3.0, 3.0)] {
            assert!(minimum(a, b).iter().all(|found| (found - smaller).abs() <= 0.0), "{a}, {b}");
        }
        for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN), (f64::NAN, f64::NAN), (f64::NAN, f64::NEG_INFINITY)] {
            assert!(minimum(a, b).iter().all(|found| found.is_nan()), "{a}, {b}");
            assert!(minimum(b, a).iter().all(|found| found.is_nan()), "{b}, {a}");
        }
    }
    check::<f64>(|x| vec![x]);
    check::<f32>(|x| vec![x.into()]);
    check::<Dual>(|x| vec![x.0]);
    check::<wide::f64x4>(|x| x.to_array().to_vec());
    check::<wide::f64x8>(|x| x.to_array().to_vec());
    check::<wide::f32x8>(|x| x.to_array().map(f64::from).to_vec());
}

/// The larger one, and NaN where either is NaN: the largest error of many hides none.
#[test]
fn the_maximum_keeps_what_is_not_a_number() {
    fn check<T: Real>() {
        let maximum = |a: f64, b: f64| T::constant(a).maximum(T::constant(b)).to_f64();
        for (a, b, larger) in [(1.0, 2.0, 2.0), (2.0, 1.0, 2.0), (-1.0, 0.0, 0.0), (3.0, 3.0, 3.0)] {
            assert!((maximum(a, b) - larger).abs() <= 0.0, "{a}, {b}");
        }
        for (a, b) in [(f64::NAN, 1.0), (f64::NAN, f64::NAN), (f64::NAN, f64::INFINITY)] {
            assert!(maximum(a, b).is_nan() && maximum(b, a).is_nan(), "{a}, {b}");
        }
    }
    check::<f64>();
    check::<f32>();
}
