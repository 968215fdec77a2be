//! Batches against the model's traits, instance by instance: the same bits and the same reasons for having no result, in
//! every instruction set that the processor has.

use planar_capture::batch::{
    Accelerations, AsBuilt, Avx2, Batch, BatchModel, Detected, FullImpact, Instructions, ReducedDynamics,
    ReducedImpact, States, StatesAfter, Status, Targets,
};
use planar_capture::dynamics::{self, ForwardDynamics, Impact};
use planar_capture::error::Error;
use planar_capture::generated::{asymmetric_wheel, dual_arm_3r};
use planar_capture::integrate::RungeKutta4;
use planar_capture::state::{Forces, State, vector_length};
use planar_capture::target::Target;
use planar_proof::tolerance;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// One robot with what acts on it.
#[derive(Clone)]
struct Instance {
    base_pose: [f64; 3],
    joint_angles: Vec<f64>,
    base_twist: [f64; 3],
    joint_rates: Vec<f64>,
    joint_torques: Vec<f64>,
    targets: Vec<Target<f64>>,
}

impl Instance {
    fn state(&self) -> State<'_, f64> {
        let Self { base_pose, joint_angles, base_twist, joint_rates, .. } = self;
        State { base_pose: *base_pose, joint_angles, base_twist: *base_twist, joint_rates }
    }
}

/// Robots at random, among them some without a result, and some with angles that are reduced in another way.
fn instances(count: usize, arms: usize, joints: usize) -> Vec<Instance> {
    let mut random = ChaCha8Rng::seed_from_u64(count as u64);
    let mut three = |size: f64| [(); 3].map(|()| random.random_range(-size..size));
    let mut all: Vec<Instance> = Vec::new();
    for k in 0..count {
        let (base_pose, base_twist) = (three(3.0), three(0.5));
        let mut lists = [3.0, 1.0, 10.0].map(|size| (0..joints).map(|_| three(size)[0]).collect::<Vec<_>>());
        let mut targets: Vec<Target<f64>> = (0..arms)
            .map(|_| {
                let [[mass, inertia, _], [x, y, _]] = [three(20.0), three(0.5)];
                Target { mass: mass.abs() + 1.0, inertia: inertia.abs() + 1.0, contact: [x, y], twist: three(0.5) }
            })
            .collect();
        let mut base = base_pose;
        match (count * 3 + k) % 29 {
            1 => base[1] = f64::NAN, // on which no acceleration depends
            5 => lists[2][joints - 1] = f64::INFINITY,
            9 => lists[0][0] = 1e300,          // far from 0
            13 => lists[0][joints - 1] = -3e6, // not so far
            17 => targets[0].inertia = -1e12,  // the impact is singular, or has negative energy
            21 => lists[1][0] = 1e200,         // its square is infinite
            25 => targets[arms - 1].twist[0] = f64::NEG_INFINITY,
            27 => {
                // the sums of these are infinite
                base[0] = f64::MIN;
                lists[0].fill(f64::MIN);
            }
            _ => {}
        }
        let [joint_angles, joint_rates, joint_torques] = lists;
        all.push(Instance { base_pose: base, joint_angles, base_twist, joint_rates, joint_torques, targets });
    }
    all
}

/// The matrix with a row for each number and a column for each instance.
fn matrix(instances: &[Instance], numbers: impl Fn(&Instance) -> Vec<f64>) -> Vec<f64> {
    let columns: Vec<Vec<f64>> = instances.iter().map(numbers).collect();
    let rows = columns.first().map_or(0, Vec::len);
    (0..rows).flat_map(|row| columns.iter().map(move |column| column[row])).collect()
}

/// What a trait says of one instance.
type Expected = Result<Vec<f64>, Error>;

/// Compares results, one list of matrices, and statuses.
fn compare(what: &str, found: &[Vec<f64>], statuses: &[Status], expected: &[Expected]) {
    let count = statuses.len();
    for (k, (status, expected)) in statuses.iter().zip(expected).enumerate() {
        let found = found.iter().flat_map(|matrix| matrix.iter().skip(k).step_by(count.max(1)));
        match expected {
            Ok(expected) => {
                assert_eq!(*status, Status::Done, "{what}, {k} of {count}");
                let size = expected.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
                assert_eq!(found.clone().count(), expected.len());
                for (found, expected) in found.zip(expected) {
                    let is_equal = if cfg!(feature = "fused") {
                        (found - expected).abs() <= tolerance::LANE * size
                    } else {
                        found.to_bits() == expected.to_bits()
                    };
                    assert!(is_equal, "{what}, {k} of {count}: {found:e}, not {expected:e}");
                }
            }
            Err(error) => {
                let reason = match error {
                    Error::Singular { .. } => Status::Singular,
                    Error::NotFinite { .. } => Status::NotFinite,
                    other => panic!("{what}, {k} of {count}: {other}"),
                };
                assert_eq!(*status, reason, "{what}, {k} of {count}: {error}");
                assert!(found.into_iter().all(|value| *value == UNTOUCHED), "{what}, {k} of {count}");
            }
        }
    }
}

/// What results are before a batch.
const UNTOUCHED: f64 = 7.0;

fn check<I: Instructions, M>(model: &M, count: usize)
where
    M: BatchModel + dynamics::Model<f64>,
{
    let (arms, joints) = (M::ARMS, M::JOINTS);
    let all = instances(count, arms, joints);
    let [base_poses, joint_angles, base_twists, joint_rates, torques] = [
        matrix(&all, |i| i.base_pose.to_vec()),
        matrix(&all, |i| i.joint_angles.clone()),
        matrix(&all, |i| i.base_twist.to_vec()),
        matrix(&all, |i| i.joint_rates.clone()),
        matrix(&all, |i| i.joint_torques.clone()),
    ];
    let states = States {
        base_poses: &base_poses,
        joint_angles: &joint_angles,
        base_twists: &base_twists,
        joint_rates: &joint_rates,
    };
    let [masses, inertias, contacts, twists] = [
        matrix(&all, |i| i.targets.iter().map(|t| t.mass).collect()),
        matrix(&all, |i| i.targets.iter().map(|t| t.inertia).collect()),
        matrix(&all, |i| i.targets.iter().flat_map(|t| t.contact).collect()),
        matrix(&all, |i| i.targets.iter().flat_map(|t| t.twist).collect()),
    ];
    let targets = Targets { masses: &masses, inertias: &inertias, contacts: &contacts, twists: &twists };
    let batch = Batch::<M, I>::with_instructions(model);
    let mut statuses = vec![Status::NotFinite; count];
    let results = |rows: usize| vec![UNTOUCHED; rows * count];
    let expected = |of: &dyn Fn(&Instance) -> Expected| -> Vec<Expected> { all.iter().map(of).collect() };

    let (mut first, mut second) = (results(3), results(joints));
    let mut found = Accelerations { base: &mut first, joints: &mut second };
    batch.forward_dynamics(&states, &torques, &mut found, &mut statuses).expect("lengths fit");
    let of_one = |i: &Instance| {
        let mut found = vec![0.0; joints];
        let base =
            ForwardDynamics::forward_dynamics(model, &i.state(), &Forces::torques(&i.joint_torques), &mut found)?;
        Ok([base.to_vec(), found].concat())
    };
    compare("forward dynamics", &[first, second], &statuses, &expected(&of_one));

    let (mut first, mut second, mut third) = (results(joints * joints), results(joints), results(3 * arms * joints));
    let mut found = ReducedDynamics {
        generalized_inertia: &mut first,
        generalized_bias: &mut second,
        generalized_jacobian: &mut third,
    };
    batch.reduced_dynamics(&states, &mut found, &mut statuses).expect("lengths fit");
    let of_one = |i: &Instance| {
        let mut found = [vec![0.0; joints * joints], vec![0.0; joints], vec![0.0; 3 * arms * joints]];
        let [inertia, bias, jacobian] = &mut found;
        dynamics::ReducedDynamics::reduced_dynamics(model, &i.state(), inertia, bias, jacobian)?;
        Ok(found.concat())
    };
    compare("reduced dynamics", &[first, second, third], &statuses, &expected(&of_one));

    let (mut first, mut second, mut third) = (results(joints * joints), results(joints), results(joints));
    let mut found =
        ReducedImpact { impact_matrix: &mut first, impact_momentum: &mut second, joint_rates_after: &mut third };
    batch.reduced_impact(&states, &targets, &mut found, &mut statuses).expect("lengths fit");
    let captured = |i: &Instance| i.targets.iter().copied().map(Some).collect::<Vec<_>>();
    let of_one = |i: &Instance| {
        let mut found = [vec![0.0; joints * joints], vec![0.0; joints], vec![0.0; joints]];
        let [matrix, momentum, rates] = &mut found;
        Impact::reduced_impact(model, &i.state(), &captured(i), matrix, momentum, rates)?;
        Ok(found.concat())
    };
    compare("the paper's impact", &[first, second, third], &statuses, &expected(&of_one));

    let (mut first, mut second) = (results(3), results(joints));
    let mut found = FullImpact { base_twists_after: &mut first, joint_rates_after: &mut second };
    batch.full_impact(&states, &targets, &mut found, &mut statuses).expect("lengths fit");
    let of_one = |i: &Instance| {
        let mut rates = vec![0.0; joints];
        let base = Impact::full_impact(model, &i.state(), &captured(i), &mut rates)?;
        Ok([base.to_vec(), rates].concat())
    };
    compare("the exact impact", &[first, second], &statuses, &expected(&of_one));

    check_step::<I, M>(model, count, 0.01);
}

/// Runge–Kutta steps against those of the core's integrator; returns how many have which status.
fn check_step<I: Instructions, M>(model: &M, count: usize, length: f64) -> [usize; 3]
where
    M: BatchModel + dynamics::Model<f64>,
{
    let joints = M::JOINTS;
    let all = instances(count, M::ARMS, joints);
    let given = [
        matrix(&all, |i| i.base_pose.to_vec()),
        matrix(&all, |i| i.joint_angles.clone()),
        matrix(&all, |i| i.base_twist.to_vec()),
        matrix(&all, |i| i.joint_rates.clone()),
    ];
    let [base_poses, joint_angles, base_twists, joint_rates] = given.each_ref().map(Vec::as_slice);
    let states = States { base_poses, joint_angles, base_twists, joint_rates };
    let mut statuses = vec![Status::NotFinite; count];
    let mut found = [3, joints, 3, joints].map(|rows: usize| vec![UNTOUCHED; rows * count]);
    let [base_poses, joint_angles, base_twists, joint_rates] = found.each_mut().map(Vec::as_mut_slice);
    let mut after = StatesAfter { base_poses, joint_angles, base_twists, joint_rates };
    let torques = matrix(&all, |i| i.joint_torques.clone());
    let batch = Batch::<M, I>::with_instructions(model);
    batch.runge_kutta_step(&states, &torques, length, &mut after, &mut statuses).expect("lengths fit");
    let expected: Vec<Expected> = all.iter().map(|instance| step(model, joints, instance, length)).collect();
    compare("Runge-Kutta step", &found, &statuses, &expected);
    [Status::Done, Status::Singular, Status::NotFinite].map(|wanted| statuses.iter().filter(|s| **s == wanted).count())
}

/// A step of the core's integrator under constant torques.
fn step<M: ForwardDynamics<f64>>(model: &M, joints: usize, instance: &Instance, step: f64) -> Expected {
    let mut vector = vec![0.0; vector_length(joints)];
    instance.state().write(&mut vector)?;
    let mut workspace = vec![0.0; RungeKutta4::<f64>::WORKSPACE * vector.len()];
    RungeKutta4::new(&mut workspace)?.step(0.0, step, &mut vector, |_, x, slope| {
        let state = State::from_vector(x, joints)?;
        let mut accelerations = vec![0.0; joints];
        let forces = Forces::torques(&instance.joint_torques);
        let base = model.forward_dynamics(&state, &forces, &mut accelerations)?;
        slope.fill(0.0);
        let rates = State {
            base_pose: state.base_twist,
            joint_angles: state.joint_rates,
            base_twist: base,
            joint_rates: &accelerations,
        };
        rates.write(slope)
    })?;
    let after = State::from_vector(&vector, joints)?;
    let numbers = [&after.base_pose[..], after.joint_angles, &after.base_twist, after.joint_rates];
    match numbers.concat().iter().find(|number| !number.is_finite()) {
        None => Ok(numbers.concat()),
        Some(value) => Err(Error::NotFinite { quantity: "state", index: 0, value: *value }),
    }
}

/// No block, less than a block, some blocks and a rest.
const COUNTS: [usize; 15] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 63, 64, 65, 128, 187];

#[test]
fn batches_of_any_size_are_as_the_model_says() {
    for count in COUNTS {
        check::<Detected, _>(&dual_arm_3r::Model::<f64>::default(), count);
    }
    check::<Detected, _>(&asymmetric_wheel::Model::<f64>::default(), 187);
}

#[test]
fn every_instruction_set_gives_the_same() {
    check::<Avx2, _>(&dual_arm_3r::Model::<f64>::default(), 187);
    check::<AsBuilt, _>(&dual_arm_3r::Model::<f64>::default(), 187);
}

#[test]
fn robots_with_a_number_that_is_not_finite_are_as_the_model_says() {
    let numbers = dual_arm_3r::Parameters::<f64>::default().to_array();
    for index in 0..numbers.len() {
        // of a negative infinity a pivot is negative, as that of a singular robot
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut numbers = numbers;
            numbers[index] = value;
            let parameters = dual_arm_3r::Parameters::from_array(numbers);
            check::<Detected, _>(&dual_arm_3r::Model::<f64>::new(parameters), 65);
        }
    }
}

/// A base of negative inertia, which the arms make up for in some poses and not in others: a step through one where they do not
/// has no result, wherever it ends.
#[test]
fn a_step_with_one_singular_stage_has_no_result() {
    let steps = |base_inertia: f64| {
        let parameters = dual_arm_3r::Parameters { base_inertia, ..dual_arm_3r::Parameters::default() };
        check_step::<Detected, _>(&dual_arm_3r::Model::<f64>::new(parameters), 187, 0.5)
    };
    let of_all = [-4.0, -5.0, -6.0, -8.0].map(steps);
    let [done, singular] = [0, 1].map(|status| of_all.iter().map(|counts| counts[status]).sum::<usize>());
    assert!(done > 99 && singular > 9, "{of_all:?}");
}

/// The instances of the other tests have all statuses.
#[test]
fn some_instances_have_no_result() {
    let all = instances(187, 2, 6);
    let model = dual_arm_3r::Model::<f64>::default();
    let failures = |wanted: fn(&Error) -> bool| {
        let failed = |i: &&Instance| {
            let targets: Vec<_> = i.targets.iter().copied().map(Some).collect();
            let found = Impact::full_impact(&model, &i.state(), &targets, &mut [0.0; 6]);
            found.is_err_and(|error| wanted(&error))
        };
        all.iter().filter(failed).count()
    };
    assert!(failures(|error| matches!(error, Error::Singular { .. })) > 2);
    assert!(failures(|error| matches!(error, Error::NotFinite { .. })) > 5);
}

#[test]
fn matrices_of_other_lengths_are_errors() {
    let model = dual_arm_3r::Model::<f64>::default();
    let states =
        States { base_poses: &[0.0; 6], joint_angles: &[0.0; 12], base_twists: &[0.0; 6], joint_rates: &[0.0; 12] };
    let mut statuses = [Status::Singular; 2];
    let (mut base, mut joints) = ([0.0; 6], [0.0; 12]);
    let mut run = |states: &States<'_>, torques: &[f64], base: &mut [f64]| {
        let mut found = Accelerations { base, joints: &mut joints };
        let result = Batch::new(&model).forward_dynamics(states, torques, &mut found, &mut statuses);
        (result, statuses)
    };
    let wrong = |quantity, expected, found| Err(Error::Length { quantity, expected, found });
    let untouched = [Status::Singular; 2];
    let angles = States { joint_angles: &[0.0; 11], ..states };
    assert_eq!(run(&angles, &[0.0; 12], &mut base), (wrong("joint_angles", 12, 11), untouched));
    assert_eq!(run(&states, &[0.0; 13], &mut base), (wrong("joint_torques", 12, 13), untouched));
    assert_eq!(run(&states, &[0.0; 12], &mut base[..5]), (wrong("base accelerations", 6, 5), untouched));
    assert_eq!(run(&states, &[0.0; 12], &mut base), (Ok(()), [Status::Done; 2]));
}
