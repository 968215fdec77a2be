//! Generated code against the generic implementation: every layout of this build × quantity × regime.

use planar_capture::dynamics::Model;
use planar_capture::error::Error;
use planar_capture::eval::to_json;
use planar_capture::layout::Layout;
use planar_capture::owned::CloneModel;
use planar_capture::quantities::differences;
use planar_capture::quantity::Quantity;
use planar_capture::registry::{GENERATED, SHIPPED, generated, generic};
use planar_capture::sampling::{REGIMES, Regime, RegimeSample};
use planar_capture::scalar::Real;
use planar_capture::state::{Forces, State};
use planar_capture::target::{LinkInertia, Target};
use planar_proof::tolerance::{INHERENT, LAYOUTS, SHORT_DISTANCE, SHORT_LINK, equivalence};
use planar_proof::{for_every_layout, layout};
use std::collections::BTreeSet;

/// States of each regime and layout.
const SAMPLES: u64 = 40;
const SEED: u64 = 20_261_121;

/// Command that reproduces the state.
fn replay(regime: Regime, index: u64, sample: &RegimeSample) -> String {
    format!(
        "seed {SEED}, regime `{}`, state {index}; replay with `planar-capture eval`:\n{}\n[{}]",
        regime.name(),
        sample.layout.to_toml(),
        to_json(&sample.instant)
    )
}

#[test]
fn generated_and_generic_agree() {
    for name in GENERATED {
        let layout = layout(name);
        for regime in REGIMES {
            let mut seen = BTreeSet::new();
            for index in 0..SAMPLES {
                let sample = regime.sample(&layout, SEED, index);
                let model = generated(&sample.layout).expect("generated code");
                let all = differences(&*model, &*generic(&sample.layout), &sample)
                    .unwrap_or_else(|errors| panic!("{name}: {errors:?}; {}", replay(regime, index, &sample)));
                for difference in all {
                    let quantity = difference.quantity.row().name;
                    let bound = equivalence(difference.quantity).bound::<f64>(difference.condition);
                    let error = difference.error;
                    assert!(bound <= difference.bound(), "{quantity}: the test allows more than `compare` does");
                    assert!(
                        error <= bound,
                        "{name}: {quantity} is off by {error:e}, bound {bound:e}; {}",
                        replay(regime, index, &sample)
                    );
                    seen.insert(difference.quantity);
                }
            }
            let missing: Vec<_> = Quantity::ALL.iter().filter(|quantity| !seen.contains(quantity)).collect();
            assert!(missing.is_empty(), "{name}, {}: never compared: {missing:?}", regime.name());
        }
    }
}

#[test]
fn every_layout_has_an_entry() {
    let sorted = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>();
    let names: Vec<_> = LAYOUTS.iter().map(|(name, _)| *name).collect();
    let shipped: Vec<_> = SHIPPED.iter().map(|(name, _)| *name).collect();
    assert_eq!(sorted(&names), sorted(&shipped), "tests/proof/src/tolerance.rs: LAYOUTS");
    assert!(sorted(GENERATED).is_subset(&sorted(&names)), "tests/proof/src/tolerance.rs: LAYOUTS");
}

/// Names, units and shapes of results are equal in graphs and the table of quantities.
#[test]
fn every_result_of_every_graph_is_in_the_table_of_quantities() {
    for (name, _) in SHIPPED {
        let graph = planar_proof::json(&format!("codegen/graphs/{name}.json"));
        let arms = graph["layout"]["arms"].as_array().expect("arms");
        let joints = arms.iter().map(|arm| arm["links"].as_u64().expect("links")).sum::<u64>();
        let (arms, joints) = (arms.len(), usize::try_from(joints).expect("a few"));
        let expected: BTreeSet<String> = Quantity::ALL
            .iter()
            .flat_map(|quantity| {
                let row = quantity.row();
                let shape: Vec<usize> = row.shape.iter().map(|extent| extent.count(arms, joints)).collect();
                row.functions.iter().map(move |function| format!("{function}.{} {shape:?} {}", row.output, row.unit))
            })
            .collect();
        let mut found = BTreeSet::new();
        for family in graph["families"].as_array().expect("families") {
            for function in family["functions"].as_array().expect("functions") {
                for output in function["outputs"].as_array().expect("outputs") {
                    let text = |key: &str| output[key].as_str().expect("text").to_owned();
                    let shape = output["shape"].to_string().replace(',', ", ");
                    found.insert(format!(
                        "{}.{} {shape} {}",
                        function["name"].as_str().expect("a name"),
                        text("name"),
                        text("unit")
                    ));
                }
            }
        }
        // a pivot says how well a result is conditioned; it is no quantity
        found.retain(|result| !result.contains(".smallest_pivot "));
        assert_eq!(found, expected, "{name}: the graph's results, and the table's");
    }
}

/// Largest difference over the largest entry, against the entry of [`INHERENT`].
fn check(layout: &str, quantity: &str, found: &[f64], expected: &[f64]) {
    let (_, bound, _) = INHERENT.iter().find(|(entry, ..)| *entry == quantity).expect("an entry");
    let size = expected.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let error = planar_proof::difference(found, expected) / size;
    assert!(error <= *bound, "{layout}: {quantity} is off by {error:e}, bound {bound:e}");
}

/// M + Σ `Jᵀ N J` and M v + Σ `JᵀJ_t⁻ᵀ I_t t` put together from the generic M and J, entry by entry.
fn full_impact(model: &dyn Model<f64>, state: &State<'_, f64>, targets: &[Target<f64>]) -> (Vec<f64>, Vec<f64>) {
    let size = 3 + model.joints();
    let (mut matrix, mut jacobian) = (vec![0.0; size * size], vec![0.0; 3 * targets.len() * size]);
    model.mass_matrix(&state.base_pose, state.joint_angles, &mut matrix).expect("M");
    model.end_effector_jacobian(&state.base_pose, state.joint_angles, &mut jacobian).expect("J");
    let v: Vec<f64> = state.base_twist.iter().chain(state.joint_rates).copied().collect();
    let mut momentum: Vec<f64> =
        matrix.chunks_exact(size).map(|row| row.iter().zip(&v).map(|(m, v)| m * v).sum()).collect();
    for (target, rows) in targets.iter().zip(jacobian.chunks_exact(3 * size)) {
        let (spin, rest) = rows.split_at(size);
        let (x, y) = rest.split_at(size);
        // twist of the target's COM per unit of a coordinate
        let columns: Vec<[f64; 3]> = (0..size).map(|j| target.twist_from_contact(&[spin[j], x[j], y[j]])).collect();
        let weights = [target.inertia, target.mass, target.mass];
        for (j, a) in columns.iter().enumerate() {
            for (k, b) in columns.iter().enumerate() {
                matrix[j * size + k] += (0..3).map(|i| a[i] * weights[i] * b[i]).sum::<f64>();
            }
            momentum[j] += (0..3).map(|i| a[i] * weights[i] * target.twist[i]).sum::<f64>();
        }
    }
    (matrix, momentum)
}

macro_rules! inherent {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            use planar_capture::generated::$name::{ARMS, JOINTS, Model};
            let (model, layout) = (Model::<f64>::default(), layout(stringify!($name)));
            let reference = generic(&layout);
            for index in 0..SAMPLES {
                let sample = Regime::Moving.sample(&layout, SEED, index);
                let instant = &sample.instant;
                let state = instant.state.view();
                let angles: &[f64; JOINTS] = state.joint_angles.try_into().expect("joints");
                let rates: &[f64; JOINTS] = state.joint_rates.try_into().expect("joints");
                let targets: Vec<_> = instant.targets.iter().map(|t| t.unwrap_or_else(Target::massless)).collect();
                let targets: [Target<f64>; ARMS] = targets.try_into().expect("arms");

                let found = model.generalized_jacobian(&state.base_pose, angles).generalized_jacobian;
                let (mut i, mut c, mut j) = ([0.0; JOINTS * JOINTS], [0.0; JOINTS], [0.0; 3 * ARMS * JOINTS]);
                reference.reduced_dynamics(&state, &mut i, &mut c, &mut j).expect("J");
                check(stringify!($name), "generalized_jacobian alone", found.as_flattened(), &j);

                let found = model.full_impact(
                    &state.base_pose,
                    angles,
                    &state.base_twist,
                    rates,
                    &targets.map(|t| t.mass),
                    &targets.map(|t| t.inertia),
                    &targets.map(|t| t.contact),
                    &targets.map(|t| t.twist),
                );
                let (matrix, momentum) = full_impact(&*reference, &state, &targets);
                check(stringify!($name), "full impact_matrix", found.impact_matrix.as_flattened(), &matrix);
                check(stringify!($name), "full impact_momentum", &found.impact_momentum, &momentum);
            }
        }
    )*};
}

/// The operations of a module's manifest are the graph's, of every kind.
macro_rules! manifest {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            let graph = planar_proof::json(concat!("codegen/graphs/", stringify!($name), ".json"));
            let functions = graph["families"].as_array().expect("families").iter();
            let functions: Vec<_> =
                functions.flat_map(|family| family["functions"].as_array().expect("functions")).collect();
            let operations = planar_capture::generated::$name::MANIFEST.operations;
            assert_eq!(operations.len(), functions.len());
            for (found, function) in operations.iter().zip(functions) {
                let count = |kinds: &[&str]| -> usize {
                    let one = |kind: &&str| function["operations"][kind].as_u64().unwrap_or(0);
                    usize::try_from(kinds.iter().map(one).sum::<u64>()).expect("some hundreds")
                };
                assert_eq!(found.function, function["name"]);
                assert_eq!(found.multiplications, count(&["mul"]), "{}", found.function);
                assert_eq!(found.additions, count(&["add", "sub"]), "{}", found.function);
                assert_eq!(found.divisions, count(&["div"]), "{}", found.function);
                assert_eq!(found.sin_cos, count(&["sin_cos"]), "{}", found.function);
                assert_eq!(found.other, count(&["neg", "min", "sqrt", "atan2"]), "{}", found.function);
                assert_eq!(found.flops(), count(&["flops"]), "{}", found.function);
            }
        }
    )*};
}

mod operations_of_the_manifest {
    use super::*;

    for_every_layout!(manifest);
}

mod outputs_without_a_trait {
    use super::*;

    for_every_layout!(inherent);
}

/// Joint angles, joint rates, targets.
type Input<'a> = (&'a [f64], &'a [f64], &'a [Option<Target<f64>>]);

/// Result of every method of a model with one invalid argument.
fn errors(model: &dyn CloneModel, (angles, rates, targets): Input<'_>) -> Vec<Result<(), Error>> {
    let (arms, joints) = (model.arms(), model.joints());
    let size = 3 + joints;
    let state = State { base_pose: [0.1, 0.2, 0.3], joint_angles: angles, base_twist: [0.1; 3], joint_rates: rates };
    let (pose, mut joint) = (&state.base_pose, vec![0.0; joints]);
    let (mut square, mut reduced) = (vec![0.0; size * size], vec![0.0; joints * joints]);
    let (mut end_effectors, mut bodies) = (vec![[0.0; 3]; arms], vec![[0.0; 3]; joints + 1]);
    let mut vector = vec![0.0; joints];
    vec![
        model.end_effector_poses(pose, angles, &mut end_effectors),
        model.end_effector_jacobian(pose, angles, &mut vec![0.0; 3 * arms * size]),
        model.end_effector_twists(&state, &mut end_effectors),
        model.body_poses(pose, angles, &mut bodies),
        model.body_twists(&state, &mut bodies),
        model.mass_matrix(pose, angles, &mut square),
        model.bias(&state, &mut vec![0.0; size]),
        model.reduced_dynamics(&state, &mut reduced, &mut vector, &mut vec![0.0; 3 * arms * joints]),
        model.forward_dynamics(&state, &Forces::torques(&vec![0.0; joints]), &mut joint).map(drop),
        model.momentum(&state).map(drop),
        model.reduced_impact(&state, targets, &mut reduced, &mut vector, &mut joint),
        model.full_impact(&state, targets, &mut joint).map(drop),
        model.clone_box().merge(pose, angles, targets),
    ]
}

#[test]
fn both_refuse_the_same_input_in_the_same_words() {
    for name in GENERATED {
        let layout = layout(name);
        let (model, reference) = (generated(&layout).expect("generated code"), generic(&layout));
        let (joints, arms) = (layout.joints(), layout.arms.len());
        let good = vec![0.3; joints];
        let nan = [vec![0.3; joints - 1], vec![f64::NAN]].concat();
        let target = Target { mass: 1.0, inertia: 1.0, contact: [0.0, f64::INFINITY], twist: [0.0; 3] };
        let none = vec![None; arms];
        assert!(errors(&*model, (&good, &good, &none)).iter().all(Result::is_ok));
        let cases: [Input<'_>; 6] = [
            (&good[1..], &good, &none),
            (&good, &good[1..], &none),
            (&nan, &good, &none),
            (&good, &nan, &none),
            (&good, &good, &none[1..]),
            (&good, &good, &vec![Some(target); arms]),
        ];
        for input in cases {
            let found = errors(&*model, input);
            let expected = errors(&*reference, input);
            assert!(found.iter().any(Result::is_err));
            // a NaN is not equal to itself, its text is
            let texts = |all: &[Result<(), Error>]| all.iter().map(|r| format!("{r:?}")).collect::<Vec<_>>();
            assert_eq!(texts(&found), texts(&expected), "{name}");
        }
        let mut short = vec![0.0; joints];
        let state = State { base_pose: [0.0; 3], joint_angles: &good, base_twist: [0.0; 3], joint_rates: &good };
        assert_eq!(model.bias(&state, &mut short), reference.bias(&state, &mut short), "{name}: too short a result");
    }
}

#[test]
fn a_change_of_a_millionth_is_seen() {
    for name in GENERATED {
        let layout = layout(name);
        let mut changed = layout.clone();
        changed.arms[0].links[0].mass *= 1.0 + 1e-6;
        let sample = Regime::Moving.sample(&layout, SEED, 0);
        let all = differences(&*generated(&changed).expect("generated code"), &*generic(&layout), &sample);
        let seen: Vec<_> =
            all.expect("answers").iter().filter(|d| d.ratio() > 1.0).map(|d| d.quantity.row().name).collect();
        for quantity in ["mass_matrix", "linear_momentum", "kinetic_energy", "joint_accelerations"] {
            assert!(seen.contains(&quantity), "{name}: {quantity} hides a change of 1e-6; seen in {seen:?}");
        }
    }
}

#[test]
fn the_merged_link_is_two_bodies_in_one() {
    let link = LinkInertia { mass: 3.0, inertia: 0.4, com: [0.5, 0.1] };
    let target = Target { mass: 5.0, inertia: 0.7, contact: [0.2, -0.3], twist: [0.0; 3] };
    let (length, yaw) = (1.2, 0.9_f64);
    let merged = target.merged_link(&link, length, yaw);
    // the target's COM in the link's frame, and both about any point: here the joint
    let (sin, cos) = yaw.sin_cos();
    let [rx, ry] = target.contact;
    let com = [length - cos * rx - sin * ry, sin * rx - cos * ry];
    let about_joint = |mass: f64, inertia: f64, com: [f64; 2]| inertia + mass * (com[0] * com[0] + com[1] * com[1]);
    let sum = about_joint(link.mass, link.inertia, link.com) + about_joint(target.mass, target.inertia, com);
    let found = about_joint(merged.mass, merged.inertia, merged.com);
    planar_proof::assert_close("inertia about the joint", &[found], &[sum], 1e-14);
    let moment = |axis: usize| link.mass * link.com[axis] + target.mass * com[axis];
    let found = merged.com.map(|c| c * merged.mass);
    planar_proof::assert_close("first moment", &found, &[moment(0), moment(1)], 1e-14);
    planar_proof::assert_close("mass", &[merged.mass], &[8.0], 0.0);
}

/// Generated accelerations against generic ones for a layout, the largest difference in natural units.
fn acceleration_error(layout: &Layout) -> f64 {
    let (model, reference) = (generated(layout).expect("generated code"), generic(layout));
    let mut worst: f64 = 0.0;
    for index in 0..SAMPLES {
        let sample = Regime::Moving.sample(layout, SEED, index);
        let all = differences(&*model, &*reference, &sample).expect("answers");
        for difference in all.iter().filter(|d| d.quantity.row().name.contains("acceleration")) {
            worst = Real::maximum(worst, difference.error);
        }
    }
    worst
}

/// An inner link may be as short as can be, with its COM in its middle or far beyond it.
#[test]
fn a_short_inner_link_costs_no_digits() {
    for (name, place) in
        [("single_arm_3r", (0, 1)), ("dual_arm_3r", (1, 0)), ("dual_arm_2r", (0, 0)), ("boom_7r", (0, 4))]
    {
        let shipped = layout(name);
        for ratio in [1.0, 1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-20, 1e-50, 1e-100] {
            for of_com in [1.0, ratio, -0.3] {
                let mut short = shipped.clone();
                let link = &mut short.arms[place.0].links[place.1];
                link.length *= ratio;
                link.com[0] *= of_com;
                let error = acceleration_error(&short);
                assert!(
                    error <= SHORT_LINK,
                    "{name}: {error:e} at a length of {ratio:e} times its own, com {of_com:e}"
                );
            }
        }
    }
}

/// Where the square of a length, or one over it, is no number, there is an error and not an answer.
#[test]
fn a_link_shorter_than_numbers_can_square_is_an_error() {
    for length in [1e-160, 1e-300, f64::MIN_POSITIVE] {
        let mut short = layout("single_arm_3r");
        short.arms[0].links[1].length = length;
        let model = generated(&short).expect("generated code");
        let mut found = [0.0; 3];
        let state = State {
            base_pose: [0.0; 3],
            joint_angles: &[0.3, 0.4, 0.5],
            base_twist: [0.1; 3],
            joint_rates: &[0.2, 0.3, 0.1],
        };
        let result = model.forward_dynamics(&state, &Forces::torques(&[1.0, 2.0, 3.0]), &mut found);
        assert!(matches!(result, Err(Error::Singular { .. } | Error::NotFinite { .. })), "{length:e}: {result:?}");
    }
}

/// Mounts too close for that have code of their own, which divides by no distance.
#[test]
fn mounts_that_nearly_coincide_are_refused() {
    for distance in [1e-7, 1e-12, 1e-17] {
        let mut close = layout("dual_arm_3r");
        close.arms[1].mount = [close.arms[0].mount[0] - distance, 0.0];
        let Err(refused) = generated(&close) else { panic!("{distance:e} m is divided by") };
        let message = refused.to_string();
        assert!(message.contains("two arms on one mount"), "{message}");
    }
}

/// Two mounts close to each other cost digits in proportion, not as the square of their distance.
#[test]
fn close_mounts_cost_generated_accelerations_no_more_than_their_share() {
    for ratio in [1e-1_f64, 1e-2, 1e-4, 1e-6] {
        let mut close = layout("dual_arm_3r");
        close.arms[1].mount = [close.arms[0].mount[0] - ratio, 0.0];
        let (error, bound) = (acceleration_error(&close), (SHORT_DISTANCE * f64::EPSILON / ratio).max(1e-13));
        assert!(error <= bound, "off by {error:e}, bound {bound:e} at a distance of {ratio} m");
    }
}
