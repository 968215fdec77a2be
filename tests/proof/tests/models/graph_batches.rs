//! Batches of evaluated graphs against compiled code, instance by instance: the same bits and the same reasons for
//! having no result, in every instruction set that the processor has, for one robot and for as many as instances.
#![cfg(not(feature = "fused"))]

use crate::evaluator;
use planar_capture::build::evaluator::{Batch, CallError, Evaluator, InstructionSet, Order, Status};
use planar_capture::dynamics::ForwardDynamics;
use planar_capture::error::Error;
use planar_capture::evaluation::EvaluationInput;
use planar_capture::layout::Layout;
use planar_capture::owned::CloneModel;
use planar_capture::registry;
use planar_capture::sampling::REGIMES;
use planar_capture::state::{Forces, RobotState, State};
use planar_capture::structure::parameters;
use planar_capture::target::Target;
use planar_proof::file;
use std::fs;
use std::sync::Arc;

/// What results are before a batch.
const UNTOUCHED: f64 = 7.0;

fn layout(name: &str) -> Layout {
    let text = fs::read_to_string(file(&format!("codegen/layouts/{name}.toml"))).expect("a layout");
    Layout::parse(&text, name).expect("a layout")
}

/// A robot in a state.
struct Instance {
    layout: Layout,
    instant: EvaluationInput,
}

/// States of all regimes, among them some without a result, and some with angles that are reduced in another way. Every
/// robot has its own numbers, or they all have the layout's.
fn instances(layout: &Layout, count: usize, own_numbers: bool) -> Vec<Instance> {
    let of = |k: usize| {
        let sample = REGIMES[k % REGIMES.len()].sample(layout, 19, (k / REGIMES.len()) as u64);
        let mut instant = sample.instant;
        let targets = &mut instant.targets;
        let state = &mut instant.state;
        let last = state.joint_angles.len() - 1;
        match k % 31 {
            1 => state.base_pose[1] = f64::NAN, // on which no acceleration depends
            5 => instant.joint_torques[last] = f64::INFINITY,
            9 => state.joint_angles[0] = 1e300,    // far from 0
            13 => state.joint_angles[last] = -3e6, // not so far
            17 => targets[0] = Some(Target { inertia: -1e12, ..Target::massless() }), // the impact is singular
            21 => state.joint_rates[0] = 1e200,    // its square is infinite
            25 => targets[0] = Some(Target { twist: [f64::NEG_INFINITY; 3], ..Target::massless() }),
            27 => {
                // the sums of these are infinite
                state.base_pose[0] = f64::MAX;
                state.joint_angles.fill(f64::MAX);
            }
            29 => state.base_pose[0] = -4e7,
            _ => {}
        }
        Instance { layout: if own_numbers { sample.layout } else { layout.clone() }, instant }
    };
    (0..count).map(of).collect()
}

/// The elements of an input.
fn input(name: &str, instant: &EvaluationInput) -> Vec<f64> {
    let EvaluationInput { state, joint_torques, base_wrench, end_effector_wrenches, targets } = instant;
    let targets = || targets.iter().map(|target| target.unwrap_or(Target::massless()));
    match name {
        "base_pose" => state.base_pose.to_vec(),
        "joint_angles" => state.joint_angles.clone(),
        "base_twist" => state.base_twist.to_vec(),
        "joint_rates" => state.joint_rates.clone(),
        "joint_torques" => joint_torques.clone(),
        "base_wrench" => base_wrench.unwrap_or_default().to_vec(),
        "end_effector_wrenches" => match end_effector_wrenches {
            Some(wrenches) => wrenches.concat(),
            None => vec![0.0; 3 * targets().count()],
        },
        "target_masses" => targets().map(|target| target.mass).collect(),
        "target_inertias" => targets().map(|target| target.inertia).collect(),
        "contacts" => targets().flat_map(|target| target.contact).collect(),
        "target_twists" => targets().flat_map(|target| target.twist).collect(),
        other => panic!("no input is called {other}"),
    }
}

/// What compiled code says of one instance: the outputs of a function, besides those that its trait does not give.
/// `None` is a function that no trait has.
fn expected(function: &str, model: &dyn CloneModel, instant: &EvaluationInput) -> Option<Result<Vec<Vec<f64>>, Error>> {
    let (arms, joints) = (model.arms(), model.joints());
    let pose = &instant.state.base_pose;
    let angles = &instant.state.joint_angles;
    let state = State {
        base_pose: *pose,
        joint_angles: angles,
        base_twist: instant.state.base_twist,
        joint_rates: &instant.state.joint_rates,
    };
    let zeros = |count: usize| vec![0.0; count];
    let wrench = input("base_wrench", instant);
    let wrenches = input("end_effector_wrenches", instant);
    let mut triples = vec![[0.0; 3]; arms.max(joints + 1)];
    let forward = |base_wrench: bool, end_effector_wrenches: bool| {
        let forces = Forces {
            joint_torques: &instant.joint_torques,
            base_wrench: base_wrench.then(|| [wrench[0], wrench[1], wrench[2]]),
            end_effector_wrenches: end_effector_wrenches.then(|| wrenches.as_chunks().0),
        };
        let mut found = zeros(joints);
        model.forward_dynamics(&state, &forces, &mut found).map(|base| vec![base.to_vec(), found])
    };
    Some(match function {
        "body_poses" | "body_twists" => {
            let into = &mut triples[..=joints];
            let found = if function == "body_poses" {
                model.body_poses(pose, angles, into)
            } else {
                model.body_twists(&state, into)
            };
            found.map(|()| vec![into.concat()])
        }
        "end_effector_poses" | "end_effector_twists" => {
            let into = &mut triples[..arms];
            let found = if function == "end_effector_poses" {
                model.end_effector_poses(pose, angles, into)
            } else {
                model.end_effector_twists(&state, into)
            };
            found.map(|()| vec![into.concat()])
        }
        "end_effector_jacobian" => {
            let mut found = zeros(3 * arms * (3 + joints));
            model.end_effector_jacobian(pose, angles, &mut found).map(|()| vec![found])
        }
        "mass_matrix" => {
            let mut found = zeros((3 + joints) * (3 + joints));
            model.mass_matrix(pose, angles, &mut found).map(|()| vec![found])
        }
        "bias" => {
            let mut found = zeros(3 + joints);
            model.bias(&state, &mut found).map(|()| vec![found])
        }
        "momentum" => model.momentum(&state).map(|found| {
            vec![found.linear_momentum.to_vec(), vec![found.angular_momentum], vec![found.kinetic_energy]]
        }),
        "reduced_dynamics" => {
            let mut found = vec![zeros(joints * joints), zeros(joints), zeros(3 * arms * joints)];
            let [inertia, bias, jacobian] = &mut found[..] else { unreachable!("three") };
            model.reduced_dynamics(&state, inertia, bias, jacobian).map(|()| found)
        }
        "forward_dynamics" => forward(false, false),
        "forward_dynamics_with_base_wrench" => forward(true, false),
        "forward_dynamics_with_wrenches" => forward(true, true),
        "reduced_impact" => {
            let mut found = vec![zeros(joints * joints), zeros(joints), zeros(joints)];
            let [matrix, momentum, rates] = &mut found[..] else { unreachable!("three") };
            model.reduced_impact(&state, &instant.targets, matrix, momentum, rates).map(|()| found)
        }
        "full_impact" => {
            let mut rates = zeros(joints);
            model.full_impact(&state, &instant.targets, &mut rates).map(|base| vec![base.to_vec(), rates])
        }
        _ => return None,
    })
}

/// Which outputs of a function its trait gives.
fn is_wanted(function: &str, output: &str) -> bool {
    output != "smallest_pivot" && (function != "full_impact" || !output.starts_with("impact_"))
}

/// The elements of all instances in an order.
fn array(columns: &[Vec<f64>], order: Order) -> Vec<f64> {
    match order {
        Order::Instances => columns.concat(),
        Order::Elements => {
            let rows = columns.first().map_or(0, Vec::len);
            (0..rows).flat_map(|row| columns.iter().map(move |column| column[row])).collect()
        }
    }
}

/// Compares all functions of some instances; returns how many have a result, and how many have none.
fn check(evaluator: &Arc<Evaluator>, all: &[Instance], own: bool, order: Order, set: InstructionSet) -> [usize; 2] {
    let count = all.len();
    let numbers = |i: &Instance| parameters(evaluator.structure(), &i.layout).expect("its structure");
    let numbers = array(&all.iter().map(numbers).collect::<Vec<_>>(), order);
    let model = all.first().map(|instance| evaluator.model(&instance.layout).expect("its structure"));
    let batch = match &model {
        Some(model) if !own => Batch::of(model),
        _ => Batch::of_each(evaluator, &numbers),
    };
    let batch = batch.in_order(order).with_instructions(set);
    let codes: Vec<_> = all.iter().map(|i| registry::generated(&i.layout).expect("its code")).collect();
    let mut results = [0; 2];
    for function in evaluator.functions() {
        let name = function.name();
        let inputs: Vec<Vec<f64>> = function
            .inputs()
            .iter()
            .map(|argument| array(&all.iter().map(|i| input(&argument.name, &i.instant)).collect::<Vec<_>>(), order))
            .collect();
        let inputs: Vec<&[f64]> = inputs.iter().map(Vec::as_slice).collect();
        let mut found: Vec<_> = function.outputs().iter().map(|o| vec![UNTOUCHED; o.rows() * count]).collect();
        let mut outputs: Vec<_> = function
            .outputs()
            .iter()
            .zip(&mut found)
            .map(|(output, found)| is_wanted(name, &output.name).then_some(found.as_mut_slice()))
            .collect();
        let mut statuses = vec![Status::NotFinite; count];
        batch.call(name, &inputs, &mut outputs, &mut statuses).expect("arrays that fit");
        for (k, (instance, code)) in all.iter().zip(&codes).enumerate() {
            let what = || format!("{name}, {k} of {count}, {order:?}, {set:?}");
            let Some(expected) = expected(name, &**code, &instance.instant) else { continue };
            let status = match &expected {
                Ok(_) => Status::Done,
                Err(Error::Singular { .. }) => Status::Singular,
                Err(Error::NotFinite { .. }) => Status::NotFinite,
                Err(other) => panic!("{}: {other}", what()),
            };
            assert_eq!(statuses[k], status, "{}: {expected:?}", what());
            results[usize::from(expected.is_err())] += 1;
            let wanted = function.outputs().iter().zip(&found).filter(|(output, _)| is_wanted(name, &output.name));
            for (position, (output, found)) in wanted.enumerate() {
                let rows = output.rows();
                for row in 0..rows {
                    let found = match order {
                        Order::Instances => found[k * rows + row],
                        Order::Elements => found[row * count + k],
                    };
                    let expected = expected.as_ref().map_or(UNTOUCHED, |expected| expected[position][row]);
                    assert_eq!(found.to_bits(), expected.to_bits(), "{} {}: {found:e}", what(), output.name);
                }
            }
        }
    }
    results
}

const ORDERS: [Order; 2] = [Order::Instances, Order::Elements];
const SETS: [InstructionSet; 3] = [InstructionSet::Detected, InstructionSet::Avx2, InstructionSet::AsBuilt];

#[test]
fn batches_of_all_layouts_have_the_bits_of_their_code() {
    for (index, name) in registry::GENERATED.iter().enumerate() {
        let (evaluator, layout) = (evaluator("graphs", name), layout(name));
        for own in [true, false] {
            let all = instances(&layout, 171, own);
            let results = check(&evaluator, &all, own, ORDERS[index % 2], InstructionSet::Detected);
            assert!(results[0] > 1500 && results[1] > 100, "{name}: {results:?}");
        }
    }
}

/// Blocks of all sizes and what is left of them, in every order and instruction set.
#[test]
fn batches_of_any_number_have_the_bits_of_their_code() {
    let (evaluator, layout) = (evaluator("graphs", "dual_arm_2r"), layout("dual_arm_2r"));
    for own in [true, false] {
        let all = instances(&layout, 150, own);
        for count in [0, 1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 63, 64, 65, 88, 150] {
            for order in ORDERS {
                for set in SETS {
                    check(&evaluator, &all[..count], own, order, set);
                }
            }
        }
    }
}

/// Functions that no trait has, too: for each instance alone, and for all of them.
#[test]
fn batches_of_one_have_the_bits_of_batches_of_many() {
    let (evaluator, layout) = (evaluator("graphs", "dual_arm_3r"), layout("dual_arm_3r"));
    let model = evaluator.model(&layout).expect("its structure");
    let all = instances(&layout, 100, false);
    let angles: Vec<f64> = all.iter().flat_map(|i| input("joint_angles", &i.instant)).collect();
    let poses: Vec<f64> = all.iter().flat_map(|i| input("base_pose", &i.instant)).collect();
    let of = |poses: &[f64], angles: &[f64]| {
        let (mut jacobians, mut statuses) =
            (vec![UNTOUCHED; poses.len() / 3 * 36], vec![Status::Done; poses.len() / 3]);
        let mut outputs = [Some(jacobians.as_mut_slice()), None];
        Batch::of(&model)
            .call("generalized_jacobian", &[poses, angles], &mut outputs, &mut statuses)
            .expect("arrays that fit");
        let bits: Vec<u64> = jacobians.iter().map(|number| number.to_bits()).collect();
        (bits, statuses)
    };
    let (many, statuses) = of(&poses, &angles);
    for (k, (pose, angles)) in poses.as_chunks::<3>().0.iter().zip(angles.as_chunks::<6>().0).enumerate() {
        assert_eq!(of(pose, angles), (many[36 * k..36 * (k + 1)].to_vec(), vec![statuses[k]]), "{k}");
    }
    assert!(statuses.iter().filter(|status| **status != Status::Done).count() > 1);
}

#[test]
fn parameters_that_are_not_finite_are_given_so() {
    let (evaluator, layout) = (evaluator("graphs", "single_arm_2r"), layout("single_arm_2r"));
    let mut numbers =
        [parameters(evaluator.structure(), &layout).expect("its structure"), Vec::new()].concat().repeat(20);
    numbers[3] = f64::NAN;
    let (mut base, mut joints, mut statuses) = ([UNTOUCHED; 60], [UNTOUCHED; 40], [Status::Done; 20]);
    let mut outputs = [Some(&mut base[..]), Some(&mut joints[..]), None];
    let inputs: [&[f64]; 5] = [&[0.1; 60], &[0.2; 40], &[0.3; 60], &[0.4; 40], &[0.5; 40]];
    Batch::of_each(&evaluator, &numbers)
        .call("forward_dynamics", &inputs, &mut outputs, &mut statuses)
        .expect("arrays that fit");
    assert_eq!(statuses[0], Status::NotFinite);
    assert!(statuses[1..].iter().all(|status| *status == Status::Done));
    assert!(base[..3] == [UNTOUCHED; 3] && base[3..].iter().all(|number| *number != UNTOUCHED));
}

/// Of a massless link with a point mass after it the mass matrix is singular where both are in line: the pivots, of which
/// the smallest is that of the base, do not show it.
#[test]
fn robots_with_a_mass_or_moment_of_inertia_of_zero_are_singular() {
    let (evaluator, layout) = (evaluator("graphs", "dual_arm_2r"), layout("dual_arm_2r"));
    let regular = parameters(evaluator.structure(), &layout).expect("its structure");
    let is_mass = |name: &str| name.ends_with("_mass") || name.ends_with("_inertia");
    let masses = evaluator.parameters().iter().enumerate().filter(|(_, parameter)| is_mass(&parameter.name));
    let masses: Vec<usize> = masses.map(|(place, _)| place).collect();
    assert_eq!(masses.len(), 10);
    let robot = |place: &usize| {
        let mut numbers = regular.clone();
        numbers[*place] = 0.0;
        numbers
    };
    let numbers: Vec<f64> = masses.iter().flat_map(robot).chain(regular.iter().copied()).collect();
    let mut statuses = [Status::Done; 11];
    let mut outputs = [None, None, None];
    let inputs: [&[f64]; 5] = [&[0.1; 33], &[0.2; 44], &[0.3; 33], &[0.4; 44], &[0.5; 44]];
    let batch = Batch::of_each(&evaluator, &numbers);
    batch.call("forward_dynamics", &inputs, &mut outputs, &mut statuses).expect("arrays that fit");
    assert!(statuses[..10].iter().all(|status| *status == Status::Singular), "{statuses:?}");
    assert_eq!(statuses[10], Status::Done);
    let state = RobotState { base_pose: [0.1; 3], joint_angles: [0.2; 4], base_twist: [0.3; 3], joint_rates: [0.4; 4] };
    for place in &masses {
        let model = evaluator.model_with(robot(place)).expect("as many");
        let found = model.forward_dynamics(&state.view(), &Forces::torques(&[0.5; 4]), &mut [0.0; 4]);
        assert!(matches!(found, Err(Error::Singular { .. })), "{found:?}");
    }
}

#[test]
fn calls_that_do_not_fit_are_refused() {
    let evaluator = evaluator("graphs", "single_arm_2r");
    let model = evaluator.model(&layout("single_arm_2r")).expect("its structure");
    let (mut poses, mut statuses) = ([UNTOUCHED; 6], [Status::Singular; 2]);
    let mut refused = |batch: Batch<'_>, name: &str, inputs: &[&[f64]], outputs: usize| {
        let mut all: Vec<_> = std::iter::repeat_with(|| None).take(outputs).collect();
        if let Some(first) = all.first_mut() {
            *first = Some(&mut poses[..]);
        }
        let error = batch.call(name, inputs, &mut all, &mut statuses).expect_err("it does not fit");
        assert_eq!((poses, statuses), ([UNTOUCHED; 6], [Status::Singular; 2]));
        error
    };
    let batch = Batch::of(&model);
    let error = refused(batch, "poses", &[], 1);
    assert!(error.to_string().contains("no function `poses`: it has forward_dynamics, "), "{error}");
    let error = refused(batch, "end_effector_poses", &[&[0.0; 6]], 1);
    assert_eq!(error.to_string(), "`end_effector_poses` has 2 inputs, not 1");
    let error = refused(batch, "end_effector_poses", &[&[0.0; 6], &[0.0; 4]], 2);
    assert_eq!(error.to_string(), "`end_effector_poses` has 1 outputs, not 2");
    let error = refused(batch, "end_effector_poses", &[&[0.0; 6], &[0.0; 5]], 1);
    let text = "`joint_angles` needs 2 numbers for each of 2 instances, it has 5 in all";
    assert_eq!(error.to_string(), text);
    let error = refused(batch, "mass_matrix", &[&[0.0; 6], &[0.0; 4]], 1);
    assert!(matches!(error, CallError::Length { elements: 25, instances: 2, found: 6, .. }), "{error}");
    let error = refused(Batch::of_each(&evaluator, &[1.0; 5]), "end_effector_poses", &[&[0.0; 6], &[0.0; 4]], 1);
    assert!(matches!(error, CallError::Length { elements: 12, found: 5, .. }), "{error}");
}
