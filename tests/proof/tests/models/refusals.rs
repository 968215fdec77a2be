//! Slices of another length, and numbers that are not finite, which impacts, contacts and laws refuse by their names; laws with
//! estimates.
#![allow(clippy::float_cmp, reason = "numbers that are exact")]

use crate::evaluator;
use planar_capture::batch::{Batch, FullImpact, States, StatesAfter, Status, Targets};
use planar_capture::contact::{
    Contact, ContactLaw, ContactPartner, DelassusMatrix, ImpactOutput, balance_length, balance_momentum, impact,
    workspace_length,
};
use planar_capture::control::{Control, EstimatedState, Estimator, ProportionalDerivative, TorqueLimiter, ZeroTorque};
use planar_capture::dynamics::{AnyModel, ForwardDynamics, Impact, ReducedDynamics};
use planar_capture::error::Error;
use planar_capture::formulation::CanonicalVariables;
use planar_capture::generated::dual_arm_3r::{ARMS, JOINTS, Model, PARAMETERS, Parameters};
use planar_capture::impact::{PaperImpactWorkspace, RigidImpactOutput, exact, paper};
use planar_capture::layout::Layout;
use planar_capture::owned::CloneModel;
use planar_capture::registry::generic;
use planar_capture::state::{Forces, State};
use planar_capture::target::Target;
use planar_capture::trajectory::ConstantSetpoint;
use planar_proof::file;

const STATE: State<'_, f64> = State {
    base_pose: [0.3, 0.1, -0.2],
    joint_angles: &[0.698, -1.571, 1.047, 2.444, 1.571, -1.047],
    base_twist: [0.1, 0.2, -0.1],
    joint_rates: &[0.1, -0.2, 0.3, 0.2, -0.1, 0.1],
};

fn wrong_length<T: std::fmt::Debug>(result: &Result<T, Error>, name: &str, lengths: [usize; 2]) {
    let Err(Error::Length { quantity, expected, found }) = result else { panic!("{name}: {result:?}") };
    assert_eq!((*quantity, [*expected, *found]), (name, lengths));
}

/// Results for fewer targets than there are: none is left as it was without a word.
#[test]
fn results_of_a_rigid_impact_are_for_all_arms() {
    let solve = |twists: usize, impulses: usize| {
        let (mut twists, mut impulses) = (vec![[0.0; 3]; twists], vec![[0.0; 3]; impulses]);
        let mut after =
            RigidImpactOutput { joint_rates: &mut [0.0; JOINTS], target_twists: &mut twists, impulses: &mut impulses };
        exact(&Model::<f64>::default(), &STATE, &[None; ARMS], &mut after)
    };
    assert!(solve(ARMS, ARMS).is_ok());
    for other in [ARMS - 1, ARMS + 1] {
        wrong_length(&solve(ARMS, other), "impulses", [ARMS, other]);
        assert!(matches!(solve(other, ARMS), Err(Error::Length { expected: ARMS, found, .. }) if found == other));
    }
    // the paper's twists of targets do not come from a function of the model
    let target = Target { mass: 10.0, inertia: 1.0, contact: [0.0, 0.5], twist: [0.1, 0.0, 0.2] };
    let by_paper = |twists: usize, impulses: usize| {
        let (mut twists, mut impulses) = (vec![[0.0; 3]; twists], vec![[0.0; 3]; impulses]);
        let mut after =
            RigidImpactOutput { joint_rates: &mut [0.0; JOINTS], target_twists: &mut twists, impulses: &mut impulses };
        let mut workspace = PaperImpactWorkspace {
            impact_matrix: &mut [0.0; JOINTS * JOINTS],
            impact_momentum: &mut [0.0; JOINTS],
            jacobian: &mut [0.0; 3 * ARMS * JOINTS],
            mass_matrix: &mut [0.0; (3 + JOINTS) * (3 + JOINTS)],
        };
        paper(&Model::<f64>::default(), &STATE, &[Some(target); ARMS], &mut workspace, &mut after)
    };
    assert!(by_paper(ARMS, ARMS).is_ok());
    wrong_length(&by_paper(ARMS + 1, ARMS), "target_twists", [ARMS, ARMS + 1]);
    wrong_length(&by_paper(ARMS, ARMS - 1), "impulses", [ARMS, ARMS - 1]);
}

/// A pin between both end effectors, and a bounce.
fn contacts(offset: f64, normal: f64, restitution: f64) -> [Contact<f64>; 2] {
    let pin = Contact { arm: 0, partner: ContactPartner::EndEffector(1), offset: [0.3, offset], law: ContactLaw::Pin };
    [pin, Contact { law: ContactLaw::Bounce { normal: [normal, 0.6], restitution }, offset: [0.1, 0.2], ..pin }]
}

fn rows<'a>(contacts: &'a [Contact<f64>], numbers: &'a mut [f64]) -> Result<DelassusMatrix<'a, f64>, Error> {
    DelassusMatrix::new(&Model::<f64>::default(), &STATE.base_pose, STATE.joint_angles, &[], contacts, numbers)
}

#[test]
fn contacts_that_are_no_numbers_are_named() {
    let refused = |contacts: [Contact<f64>; 2]| {
        let mut numbers = vec![0.0; workspace_length(JOINTS, ARMS, 0, DelassusMatrix::count(&contacts))];
        rows(&contacts, &mut numbers).map(drop)
    };
    assert_eq!(refused(contacts(0.5, 0.8, 0.4)), Ok(()));
    for (contacts, name, place) in [
        (contacts(f64::NAN, 0.8, 0.4), "contact offset", 1),
        (contacts(0.5, f64::INFINITY, 0.4), "contact normal and restitution", 0),
        (contacts(0.5, 0.8, f64::NAN), "contact normal and restitution", 2),
    ] {
        let found = refused(contacts);
        assert!(
            matches!(found, Err(Error::NotFinite { quantity, index, .. }) if (quantity, index) == (name, place)),
            "{found:?}"
        );
    }
}

/// The space of an impact and of its balance, and the impulses of both.
#[test]
fn impacts_have_the_space_that_they_need() {
    let (model, contacts) = (Model::<f64>::default(), contacts(0.5, 0.8, 0.4));
    let length = workspace_length(JOINTS, ARMS, 0, DelassusMatrix::count(&contacts));
    let solve = |space: usize, impulses: usize| {
        let (mut numbers, mut impulses) = (vec![0.0; space], vec![[0.0; 3]; impulses]);
        let mut after = ImpactOutput { joint_rates: &mut [0.0; JOINTS], body_twists: &mut [], impulses: &mut impulses };
        impact(&model, &STATE, &[], rows(&contacts, &mut numbers)?, &mut after)
    };
    assert!(solve(length, 2).is_ok());
    wrong_length(&solve(length + 1, 2), "contact workspace", [length, length + 1]);
    wrong_length(&solve(length, 1), "impulses", [2, 1]);
    let length = balance_length(JOINTS, ARMS, 0, 2);
    let balance = |space: usize, impulses: usize| {
        let (mut numbers, mut impulses) = (vec![0.0; space], vec![[0.0; 3]; impulses]);
        let mut after = ImpactOutput { joint_rates: &mut [0.0; JOINTS], body_twists: &mut [], impulses: &mut impulses };
        balance_momentum(&model, &STATE, &[], &contacts, &mut numbers, &mut after)
    };
    assert!(balance(length, 2).is_ok());
    wrong_length(&balance(length + 1, 2), "balance workspace", [length, length + 1]);
    wrong_length(&balance(length, 3), "impulses", [2, 3]);
}

#[test]
fn laws_and_coordinates_have_the_space_that_they_need() {
    let model = Model::<f64>::default();
    let limited = |limits: &[f64], flags: &mut [bool]| {
        let mut law = TorqueLimiter { law: ZeroTorque, torque_limits: limits, saturated: flags };
        law.joint_torques(0.0, &model, &STATE, &mut [0.0; JOINTS])
    };
    assert_eq!(limited(&[1.0; JOINTS], &mut [false; JOINTS]), Ok(()));
    wrong_length(&limited(&[1.0; JOINTS], &mut [false; JOINTS - 1]), "saturated", [JOINTS, JOINTS - 1]);
    wrong_length(&limited(&[1.0; 1], &mut [false; JOINTS]), "torque_limits", [JOINTS, 1]);
    let measured = |[offsets, leaves, rates]: [usize; 3]| {
        let mut variables = CanonicalVariables {
            inertias: &mut [[0.0; 2]; 1 + JOINTS],
            poses: &mut [[0.0; 3]; 1 + JOINTS],
            twists: &mut [[0.0; 3]; 1 + JOINTS],
            offsets: &mut vec![[0.0; 2]; offsets],
            leaves: &mut vec![false; leaves],
            rates: &mut vec![0.0; rates],
        };
        variables.measure(&model, &STATE.base_pose, STATE.joint_angles)
    };
    assert_eq!(measured([JOINTS; 3]), Ok(()));
    for other in [[JOINTS - 1, JOINTS, JOINTS], [JOINTS, JOINTS + 1, JOINTS]] {
        wrong_length(&measured(other), "canonical working space", [JOINTS, other[0] + other[1] - JOINTS]);
    }
}

/// Forces and targets that are no numbers are named themselves, and not what would be computed of them.
#[test]
fn forces_and_targets_that_are_no_numbers_are_named() {
    let model = Model::<f64>::default();
    let name = |found: Result<[f64; 3], Error>| match found {
        Err(Error::NotFinite { quantity, index, .. }) => (quantity, index),
        other => panic!("{other:?}"),
    };
    let mut out = [0.0; JOINTS];
    let mut accelerations =
        |forces: &Forces<'_, f64>| name(ForwardDynamics::forward_dynamics(&model, &STATE, forces, &mut out));
    let torques = Forces::torques(&[0.5; JOINTS]);
    let base = Forces { base_wrench: Some([0.0, f64::NAN, 0.0]), ..torques };
    assert_eq!(accelerations(&base), ("base_wrench", 1));
    let wrenches = [[0.0; 3], [0.0, 0.0, f64::INFINITY]];
    let tips = Forces { end_effector_wrenches: Some(&wrenches), ..torques };
    assert_eq!(accelerations(&tips), ("end_effector_wrenches", 5));
    let target =
        |twist, contact| Target { mass: 10.0, inertia: 1.0, contact: [0.0, contact], twist: [0.1, 0.0, twist] };
    for (target, expected) in
        [(target(f64::NAN, 0.5), ("target twist", 2)), (target(0.2, f64::NAN), ("target contact", 1))]
    {
        let mut after = [0.0; JOINTS];
        assert_eq!(name(Impact::full_impact(&model, &STATE, &[None, Some(target)], &mut after)), expected);
    }
}

/// Every number of a state, one after the other: its name and index, and buffers without NaN, by compiled code and by the
/// graph that it is of.
#[test]
fn every_number_of_a_state_is_named_and_none_travels() {
    let layout = Layout::read(&file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    let graph = evaluator("graphs", "dual_arm_3r").model(&layout).expect("its structure");
    let compiled = Model::<f64>::default();
    let models: [&AnyModel<f64>; 2] = [&compiled, &graph];
    let target = Target { mass: 10.0, inertia: 1.0, contact: [0.0, 0.5], twist: [0.1, 0.0, 0.2] };
    let numbers = [("base_pose", 3), ("joint_angles", JOINTS), ("base_twist", 3), ("joint_rates", JOINTS)];
    for (name, index) in numbers.into_iter().flat_map(|(name, count)| (0..count).map(move |index| (name, index))) {
        for number in [f64::NAN, f64::NEG_INFINITY] {
            let (mut angles, mut rates) = (STATE.joint_angles.to_vec(), STATE.joint_rates.to_vec());
            let (mut base_pose, mut base_twist) = (STATE.base_pose, STATE.base_twist);
            match name {
                "base_pose" => base_pose[index] = number,
                "joint_angles" => angles[index] = number,
                "base_twist" => base_twist[index] = number,
                _ => rates[index] = number,
            }
            let state = State { base_pose, joint_angles: &angles, base_twist, joint_rates: &rates };
            for model in models {
                let mut results = vec![7.0; 2 * JOINTS + 2 * JOINTS * JOINTS + JOINTS];
                let (joints, rest) = results.split_at_mut(JOINTS);
                let (after, rest) = rest.split_at_mut(JOINTS);
                let (inertia, rest) = rest.split_at_mut(JOINTS * JOINTS);
                let (jacobian, bias) = rest.split_at_mut(3 * ARMS * JOINTS);
                let found = [
                    model.forward_dynamics(&state, &Forces::torques(&[0.5; JOINTS]), joints).map(drop),
                    model.full_impact(&state, &[Some(target), None], after).map(drop),
                    model.reduced_dynamics(&state, inertia, bias, jacobian),
                ];
                for found in found {
                    let Err(Error::NotFinite { quantity, index: at, value }) = found else { panic!("{found:?}") };
                    assert_eq!((quantity, at, value.to_bits()), (name, index, number.to_bits()));
                }
                assert!(results.iter().all(|result| result.is_finite()), "{name}[{index}] = {number}: {results:?}");
            }
        }
    }
}

/// A target whose numbers have a place in 64 bits, and its inertia together with that of a link has none: nothing merges the
/// two, and the model stays as it was.
#[test]
fn what_is_no_number_together_is_not_merged() {
    let layout = Layout::read(&file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    let graph = evaluator("graphs", "dual_arm_3r").model(&layout).expect("its structure");
    let models: [Box<dyn CloneModel>; 3] = [Box::new(Model::<f64>::default()), Box::new(graph), generic(&layout)];
    let target = |contact: f64| Target { mass: 10.0, inertia: 1.0, contact: [0.0, contact], twist: [0.0; 3] };
    for mut model in models {
        let matrix = |model: &dyn CloneModel| {
            let mut matrix = [0.0; (3 + JOINTS) * (3 + JOINTS)];
            model.mass_matrix(&STATE.base_pose, STATE.joint_angles, &mut matrix).expect("a matrix");
            matrix
        };
        let before = matrix(&*model);
        let far = model.merge(&STATE.base_pose, STATE.joint_angles, &[None, Some(target(1e160))]);
        assert!(matches!(far, Err(Error::NotFinite { quantity: "merged parameters", .. })), "{far:?}");
        assert_eq!(matrix(&*model), before);
        assert_eq!(model.merge(&STATE.base_pose, STATE.joint_angles, &[None, Some(target(0.5))]), Ok(()));
        assert_ne!(matrix(&*model), before);
    }
}

/// With a base without mass a robot is singular, whatever its arms hold.
#[test]
fn a_singular_robot_is_not_merged() {
    let mut values = Parameters::<f64>::default().to_array();
    values[0] = 0.0;
    let graph = evaluator("graphs", "dual_arm_3r").model_with(values.to_vec()).expect("its parameters");
    let models: [Box<dyn CloneModel>; 2] = [Box::new(Model::new(Parameters::from_array(values))), Box::new(graph)];
    let target = Target { mass: 10.0, inertia: 1.0, contact: [0.0, 0.5], twist: [0.0; 3] };
    for mut model in models {
        let merged = model.merge(&STATE.base_pose, STATE.joint_angles, &[None, Some(target)]);
        assert!(matches!(merged, Err(Error::Singular { what: "the merged robot", .. })), "{merged:?}");
    }
}

/// Results that overflow, of numbers that do not, and a robot without masses: errors, and zeros.
#[test]
fn what_has_no_result_is_zero() {
    let rates = [1e200; JOINTS];
    let fast = State { joint_rates: &rates, ..STATE };
    let (mut joints, mut after) = ([7.0; JOINTS], [7.0; JOINTS]);
    let (mut inertia, mut bias, mut jacobian) = ([7.0; JOINTS * JOINTS], [7.0; JOINTS], [7.0; 3 * ARMS * JOINTS]);
    let nothing = Model::new(Parameters::<f64>::from_array([0.0; PARAMETERS]));
    for (model, state, is_singular) in [(Model::default(), fast, false), (nothing, STATE, true)] {
        let torques = Forces::torques(&[0.5; JOINTS]);
        let found = [
            ForwardDynamics::forward_dynamics(&model, &state, &torques, &mut joints).map(drop),
            ReducedDynamics::reduced_dynamics(&model, &state, &mut inertia, &mut bias, &mut jacobian),
            if is_singular { Impact::full_impact(&model, &state, &[None; ARMS], &mut after).map(drop) } else { Ok(()) },
        ];
        let [accelerations, reduced, impact] = found;
        if is_singular {
            let names =
                ["the articulated mass of the base", "the base inertia", "the impact matrix G in full coordinates"];
            for (found, name) in [accelerations, reduced, impact].into_iter().zip(names) {
                assert!(matches!(found, Err(Error::Singular { what, .. }) if what == name), "{found:?}");
            }
            assert_eq!(after, [0.0; JOINTS]);
        } else {
            assert!(
                matches!(accelerations, Err(Error::NotFinite { quantity: "base_acceleration", .. })),
                "{accelerations:?}"
            );
            assert!(matches!(reduced, Err(Error::NotFinite { quantity: "generalized_bias", .. })), "{reduced:?}");
        }
        assert_eq!((joints, bias, inertia, jacobian), ([0.0; JOINTS], [0.0; JOINTS], [0.0; 36], [0.0; 36]));
        (joints, inertia, bias, jacobian) = ([7.0; JOINTS], [7.0; 36], [7.0; JOINTS], [7.0; 36]);
    }
}

/// Impulses and the base's twist, of finite velocities.
#[test]
fn impulses_that_overflow_are_refused() {
    let (mut rates, mut twists, mut impulses) = ([0.0; JOINTS], [[0.0; 3]; ARMS], [[0.0; 3]; ARMS]);
    let mut after = RigidImpactOutput { joint_rates: &mut rates, target_twists: &mut twists, impulses: &mut impulses };
    let state = State { base_twist: [0.1, 0.2, 1e258], ..STATE };
    let target = Target { mass: 10.0, inertia: 1.0, contact: [0.05, 5e134], twist: [0.0; 3] };
    let found = exact(&Model::<f64>::default(), &state, &[Some(target), None], &mut after);
    assert!(matches!(found, Err(Error::NotFinite { quantity: "impulses", .. })), "{found:?}");
    // the paper's equations have the base's twist from the momentum, of rates that are finite
    let target = Target { mass: 1.0, inertia: 1.0, contact: [0.05, 0.5], twist: [1e308, 0.0, 0.0] };
    let mut workspace = PaperImpactWorkspace {
        impact_matrix: &mut [0.0; JOINTS * JOINTS],
        impact_momentum: &mut [0.0; JOINTS],
        jacobian: &mut [0.0; 3 * ARMS * JOINTS],
        mass_matrix: &mut [0.0; (3 + JOINTS) * (3 + JOINTS)],
    };
    let found = paper(&Model::<f64>::default(), &STATE, &[Some(target), None], &mut workspace, &mut after);
    assert!(matches!(found, Err(Error::NotFinite { quantity: "base_twist", .. })), "{found:?}");
}

/// Batches of two instances, with one array that is too short.
#[test]
fn batches_of_impacts_and_steps_have_arrays_of_one_length() {
    let model = Model::<f64>::default();
    let states = States {
        base_poses: &[0.0; 6],
        joint_angles: &[0.3; 2 * JOINTS],
        base_twists: &[0.0; 6],
        joint_rates: &[0.0; 2 * JOINTS],
    };
    let impact = |contacts: &[f64], twists: &[f64]| {
        let targets = Targets { masses: &[1.0; 4], inertias: &[1.0; 4], contacts, twists };
        let mut results = FullImpact { base_twists_after: &mut [0.0; 6], joint_rates_after: &mut [0.0; 2 * JOINTS] };
        Batch::new(&model).full_impact(&states, &targets, &mut results, &mut [Status::Done; 2])
    };
    assert_eq!(impact(&[0.1; 8], &[0.1; 12]), Ok(()));
    wrong_length(&impact(&[0.1; 7], &[0.1; 12]), "target contacts", [8, 7]);
    wrong_length(&impact(&[0.1; 8], &[0.1; 13]), "target twists", [12, 13]);
    let step = |angles: usize, rates: usize| {
        let mut after = StatesAfter {
            base_poses: &mut [0.0; 6],
            joint_angles: &mut vec![0.0; angles],
            base_twists: &mut [0.0; 6],
            joint_rates: &mut vec![0.0; rates],
        };
        let torques = [0.0; 2 * JOINTS];
        Batch::new(&model).runge_kutta_step(&states, &torques, 0.01, &mut after, &mut [Status::Done; 2])
    };
    assert_eq!(step(2 * JOINTS, 2 * JOINTS), Ok(()));
    wrong_length(&step(2 * JOINTS - 1, 2 * JOINTS), "joint_angles", [2 * JOINTS, 2 * JOINTS - 1]);
    wrong_length(&step(2 * JOINTS, 2 * JOINTS + 1), "joint_rates", [2 * JOINTS, 2 * JOINTS + 1]);
}

/// An estimator that takes all joints for unmoved, and keeps what it is told of the torques.
#[derive(Default)]
struct Unmoved(Vec<f64>);

impl Estimator<f64, AnyModel<f64>> for Unmoved {
    fn estimate(&mut self, _: f64, _: &AnyModel<f64>, state: &State<'_, f64>) -> Result<State<'_, f64>, Error> {
        Ok(State {
            base_pose: state.base_pose,
            joint_angles: &[0.0; JOINTS],
            base_twist: [0.0; 3],
            joint_rates: &[0.0; JOINTS],
        })
    }

    fn apply(&mut self, torques: &[f64]) {
        self.0 = torques.to_vec();
    }
}

/// A law with an estimator answers to the estimate, and the estimator is told its answer.
#[test]
fn a_law_answers_to_the_estimate_and_the_estimator_is_told() {
    let law = ProportionalDerivative {
        trajectory: ConstantSetpoint { angles: &[1.0; JOINTS] },
        proportional_gain: &[10.0; JOINTS],
        derivative_gain: &[2.0; JOINTS],
    };
    let mut estimated = EstimatedState { estimator: Unmoved::default(), law };
    let mut torques = [0.0; JOINTS];
    estimated.joint_torques(0.0, &Model::<f64>::default() as &AnyModel<f64>, &STATE, &mut torques).expect("torques");
    assert_eq!((torques, estimated.estimator.0.as_slice()), ([10.0; JOINTS], &[10.0; JOINTS][..]));
}

/// Without a trajectory of all joints there are no torques, wherever it ends.
#[test]
fn a_trajectory_of_fewer_joints_is_refused() {
    let angles = [1.0; JOINTS];
    for length in 0..JOINTS {
        let mut law = ProportionalDerivative {
            trajectory: ConstantSetpoint { angles: &angles[..length] },
            proportional_gain: &[10.0; JOINTS],
            derivative_gain: &[2.0; JOINTS],
        };
        let found = law.joint_torques(0.0, &Model::<f64>::default() as &AnyModel<f64>, &STATE, &mut [0.0; JOINTS]);
        wrong_length(&found, "trajectory", [JOINTS, length]);
    }
}
