//! A number that is not one or is infinite shows in the pivot of every generated function that depends on it, and so does a
//! mass or moment of inertia of 0.

use crate::evaluator;
use planar_capture::dynamics::{AnyModel, ForwardDynamics};
use planar_capture::error::Error;
use planar_capture::scalar::{Dual, Real, Scalar};
use planar_capture::state::{Forces, RobotState};
use planar_capture::target::Target;
use planar_proof::for_every_layout;
use std::array::from_fn;

/// The inputs of generated functions, in their order.
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

/// What a function is called, which inputs it has, and its pivot.
struct Call<T> {
    function: &'static str,
    inputs: &'static [&'static str],
    pivot: T,
}

impl<T> Call<T> {
    /// Whether a result depends on the element of an input: on positions and velocities of the whole robot, none but those
    /// after an exact impact.
    fn depends_on(&self, input: &str, element: usize) -> bool {
        let is_absolute = ["base_pose", "base_twist"].contains(&input) && element > 0;
        self.inputs.contains(&input) && (!is_absolute || (self.function == "full_impact" && input == "base_twist"))
    }
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
                let mut call = |function, inputs, pivot| calls.push(Call { function, inputs, pivot });
                let r = model.forward_dynamics(&pose, &angles, &twist, &rates, &torques);
                call("forward_dynamics", &INPUTS[..5], r.smallest_pivot);
                let r = model.forward_dynamics_with_base_wrench(&pose, &angles, &twist, &rates, &torques, &wrench);
                call("forward_dynamics_with_base_wrench", &INPUTS[..6], r.smallest_pivot);
                let r = model
                    .forward_dynamics_with_wrenches(&pose, &angles, &twist, &rates, &torques, &wrench, &wrenches);
                call("forward_dynamics_with_wrenches", &INPUTS[..7], r.smallest_pivot);
                let r = model.reduced_dynamics(&pose, &angles, &twist, &rates);
                call("reduced_dynamics", &INPUTS[..4], r.smallest_pivot);
                let r = model.generalized_jacobian(&pose, &angles);
                call("generalized_jacobian", &INPUTS[..2], r.smallest_pivot);
                let r = model.reduced_impact(&pose, &angles, &rates, &masses, &inertias, &contacts, &twists);
                let inputs = &["base_pose", "joint_angles", "joint_rates", INPUTS[7], INPUTS[8], INPUTS[9], INPUTS[10]];
                call("reduced_impact", inputs, r.smallest_pivot);
                let r = model.full_impact(&pose, &angles, &twist, &rates, &masses, &inertias, &contacts, &twists);
                let inputs = &[
                    "base_pose", "joint_angles", "base_twist", "joint_rates", INPUTS[7], INPUTS[8], INPUTS[9],
                    INPUTS[10],
                ];
                call("full_impact", inputs, r.smallest_pivot);
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
            fn an_input_that_is_not_finite_shows() {
                assert!(calls(parameters(), &inputs()).iter().all(|call| call.pivot > 1e-3), "a state of finite numbers");
                for (place, (name, i)) in elements().enumerate() {
                    for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                        let mut inputs = inputs();
                        inputs[place] = number;
                        for call in calls(parameters(), &inputs) {
                            let Call { function, pivot, .. } = call;
                            let is_seen = pivot.is_nan();
                            assert_eq!(is_seen, call.depends_on(name, i), "{function}: {name}[{i}] = {number}: {pivot}");
                        }
                    }
                }
            }

            /// The same by the functions of a configuration, and by one state of several.
            #[test]
            fn an_input_of_a_configuration_that_is_not_finite_shows() {
                let model = Model::<f64>::default();
                let (pose, angles) = ([0.3, 0.1, -0.2], [0.4; JOINTS]);
                let configuration = model.forward_dynamics_configuration(&pose, &angles);
                let pivot = |torque: f64| configuration.forward_dynamics(&[0.0; 3], &[0.0; JOINTS], &[torque; JOINTS]).smallest_pivot;
                assert!(pivot(1.0) > 1e-3 && pivot(f64::NAN).is_nan() && pivot(f64::INFINITY).is_nan());
            }

            /// With a point mass whose joint is in line with a massless link before it, the mass matrix is singular in some
            /// configurations; the base's pivot is not.
            #[test]
            fn a_mass_or_moment_of_inertia_of_zero_shows() {
                use ParameterKind::{BaseInertia, BaseMass, LinkInertia, LinkMass};
                for (place, parameter) in MANIFEST.parameters.iter().enumerate() {
                    if ![BaseMass, BaseInertia, LinkMass, LinkInertia].contains(&parameter.kind) {
                        continue;
                    }
                    for zero in [0.0, -0.0] {
                        let mut values = parameters();
                        values[place] = zero;
                        for Call { function, pivot, .. } in calls(values, &inputs()) {
                            assert!(pivot.is_nan(), "{function}: {} = {zero} leaves a pivot of {pivot}", parameter.name);
                        }
                        let (model, mut accelerations) = (Model::new(Parameters::from_array(values)), [0.0; JOINTS]);
                        let state = RobotState { joint_angles: [0.4; JOINTS], joint_rates: [0.1; JOINTS], base_pose: [0.0; 3], base_twist: [0.0; 3] };
                        let torques = [1.0; JOINTS];
                        let found = ForwardDynamics::forward_dynamics(&model, &state.view(), &Forces::torques(&torques), &mut accelerations);
                        assert!(matches!(found, Err(Error::Singular { .. })), "{}: {found:?}", parameter.name);
                    }
                }
            }

            /// A robot with one parameter that is not finite: which, its place, whether it is the length of a last link, and all.
            fn not_finite(mut check: impl FnMut(&str, usize, bool, [f64; PARAMETERS])) {
                for (place, parameter) in MANIFEST.parameters.iter().enumerate() {
                    let is_end =
                        parameter.kind == ParameterKind::LinkLength && parameter.link + 1 == MANIFEST.links[parameter.arm];
                    for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                        let mut values = parameters();
                        values[place] = number;
                        check(&format!("{} = {number}", parameter.name), place, is_end, values);
                    }
                }
            }

            #[test]
            fn a_parameter_that_is_not_finite_shows() {
                not_finite(|which, _, is_end, values| {
                    for Call { function, pivot, .. } in calls(values, &inputs()) {
                        // where an end effector is matters to what acts there alone
                        let matters = !is_end || !["forward_dynamics", "forward_dynamics_with_base_wrench"].contains(&function);
                        assert_eq!(pivot.is_nan(), matters, "{function}: {which}: {pivot}");
                    }
                });
            }

            /// Traits tell it from a singular robot, though the pivot is none for both.
            #[test]
            fn a_parameter_that_is_not_finite_has_its_error() {
                let torques = [0.3; JOINTS];
                let wrenches = [[0.1, 0.2, 0.3]; ARMS];
                let forces = Forces { end_effector_wrenches: Some(&wrenches), ..Forces::torques(&torques) };
                let targets = [Some(Target { mass: 10.0, inertia: 1.0, contact: [0.1, -0.2], twist: [0.1; 3] }); ARMS];
                let state = RobotState { joint_angles: [0.4; JOINTS], joint_rates: [0.1; JOINTS], base_pose: [0.3; 3], base_twist: [0.2; 3] };
                let state = state.view();
                let graph = evaluator("graphs", stringify!($name));
                not_finite(|which, place, is_end, values| {
                    let evaluated = graph.model_with(values.to_vec()).expect("its parameters");
                    let compiled = Model::new(Parameters::from_array(values));
                    for model in [&compiled as &AnyModel<f64>, &evaluated] {
                        let (mut joints, mut matrix, mut jacobian) = ([0.0; JOINTS], [0.0; JOINTS * JOINTS], [0.0; 3 * ARMS * JOINTS]);
                        let mut bias = [0.0; JOINTS];
                        let found = [
                            model.forward_dynamics(&state, &forces, &mut joints).map(drop),
                            model.reduced_dynamics(&state, &mut matrix, &mut bias, &mut jacobian),
                            model.reduced_impact(&state, &targets, &mut matrix, &mut bias, &mut joints),
                            model.full_impact(&state, &targets, &mut joints).map(drop),
                        ];
                        for found in found {
                            // where an end effector is may be in a result and in no pivot
                            let is_said = matches!(found, Err(Error::NotFinite { quantity: "parameters", index, .. }) if index == place)
                                || (is_end && matches!(found, Err(Error::NotFinite { .. })));
                            assert!(is_said, "{which}: {found:?}");
                        }
                    }
                });
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
                        assert_eq!(second.is_nan(), call.depends_on(name, i), "{function}: {name}[{i}] = NaN: {second}");
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
