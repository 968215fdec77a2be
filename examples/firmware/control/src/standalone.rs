//! The capture by a module that stands alone: arrays, and functions of the model.

use crate::Real;
use crate::dual_arm_3r::{
    ARMS, ForwardDynamics, FullImpact, Impulses, JOINTS, Model, Parameters, ReducedDynamics, StateAfter, Status,
    self_test,
};
use crate::mission::{self, Record, STEP, Writer};
use crate::route::{Case, Function, NAMES, Route};
use crate::states::Inputs;

const PROPORTIONAL_GAIN: [Real; JOINTS] = [mission::PROPORTIONAL_GAIN; JOINTS];
const DERIVATIVE_GAIN: [Real; JOINTS] = [mission::DERIVATIVE_GAIN; JOINTS];
const MASSES: [Real; ARMS] = [mission::TARGET_MASS; ARMS];
const INERTIAS: [Real; ARMS] = [mission::TARGET_INERTIA; ARMS];
const TWISTS: [[Real; 3]; ARMS] = [mission::TARGET_TWIST; ARMS];

type Position = ([Real; 3], [Real; JOINTS], [Real; 3], [Real; JOINTS]);

/// Approach, contact, impact, and the motion of the merged robot.
///
/// # Errors
/// What the module says of the numbers.
#[inline(never)]
pub fn capture(record: &mut Record) -> Result<(), Status> {
    let mut record = Writer(record);
    let mut robot = Model::<Real>::default();
    let mut x: Position = ([0.0; 3], mission::INITIAL_ANGLES, [0.0; 3], [0.0; JOINTS]);
    for step in 0..mission::APPROACH_STEPS {
        let (angles, rates) = quartic(Real::from(step) * STEP);
        let torques = robot.pd_torques(&x.1, &x.3, &angles, &rates, &PROPORTIONAL_GAIN, &DERIVATIVE_GAIN)?;
        advance(&robot, &mut x, &torques)?;
    }
    put(&mut record, &x);

    let contacts = &mission::CONTACTS;
    let after = robot.full_impact(&x.0, &x.1, &x.2, &x.3, &MASSES, &INERTIAS, contacts, &TWISTS);
    (x.2, x.3) = (after.base_twist_after, after.joint_rates_after);
    let impulses = robot.impulses(&x.0, &x.1, &x.2, &x.3, &MASSES, &INERTIAS, contacts, &TWISTS)?;
    robot.merge(&x.0, &x.1, &MASSES, &INERTIAS, contacts)?;
    put(&mut record, &x);
    record.put(impulses.impulses.as_flattened());

    for _ in 0..mission::POST_IMPACT_STEPS {
        advance(&robot, &mut x, &[0.0; JOINTS])?;
    }
    put(&mut record, &x);
    Ok(())
}

#[inline]
fn advance(robot: &Model<Real>, x: &mut Position, torques: &[Real; JOINTS]) -> Result<(), Status> {
    let after = robot.rk4_step(&x.0, &x.1, &x.2, &x.3, torques, STEP)?;
    *x = (after.base_pose_after, after.joint_angles_after, after.base_twist_after, after.joint_rates_after);
    Ok(())
}

fn put(record: &mut Writer<'_>, (pose, angles, twist, rates): &Position) {
    record.put(pose);
    record.put(angles);
    record.put(twist);
    record.put(rates);
}

/// Eq. (6): angles and rates at a time (s).
fn quartic(time: Real) -> ([Real; JOINTS], [Real; JOINTS]) {
    let (mut angles, mut rates) = (mission::INITIAL_ANGLES, [0.0; JOINTS]);
    let tau = time / mission::DURATION;
    let (tau2, tau3) = (tau * tau, tau * tau * tau);
    let of_angle =
        [tau3 * (10.0 - 15.0 * tau + 6.0 * tau2), mission::DURATION * (tau3 * (-4.0 + 7.0 * tau - 3.0 * tau2))];
    let of_rate =
        [tau2 * (30.0 - 60.0 * tau + 30.0 * tau2) / mission::DURATION, tau2 * (-12.0 + 28.0 * tau - 15.0 * tau2)];
    let ends = mission::FINAL_ANGLES.iter().zip(&mission::FINAL_RATES);
    for ((angle, rate), (to, end)) in angles.iter_mut().zip(&mut rates).zip(ends) {
        let change = *to - *angle;
        let sum = |[of_change, of_end]: [Real; 2]| change * of_change + *end * of_end;
        *angle += sum(of_angle);
        *rate = sum(of_rate);
    }
    (angles, rates)
}

/// A module that stands alone.
#[derive(Clone, Copy, Debug)]
pub struct Standalone;

/// What the functions give.
#[derive(Debug)]
pub struct Results {
    model: Model<Real>,
    forward: ForwardDynamics<Real>,
    reduced: ReducedDynamics<Real>,
    base: [Real; 3],
    joints: [Real; JOINTS],
    impulses: Impulses<Real>,
    after: StateAfter<Real>,
}

impl Route for Standalone {
    const NAME: &'static str = "standalone";
    type Parameters = Parameters<Real>;
    type Model = Model<Real>;
    type Prepared = ();
    type Results = Results;
    const FUNCTIONS: [Function<Self>; NAMES.len()] = [
        Function { call: model_new, results: |case, each| each(&case.results.model.parameters().to_array()) },
        Function {
            call: forward_dynamics,
            results: |case, each| {
                each(&case.results.forward.base_acceleration);
                each(&case.results.forward.joint_accelerations);
            },
        },
        Function {
            call: reduced_dynamics,
            results: |case, each| {
                each(case.results.reduced.generalized_inertia.as_flattened());
                each(&case.results.reduced.generalized_bias);
                each(case.results.reduced.generalized_jacobian.as_flattened());
            },
        },
        Function { call: exact_impact, results: velocities },
        Function {
            call: exact_impact_with_impulses,
            results: |case, each| {
                velocities(case, each);
                each(case.results.impulses.target_twists_after.as_flattened());
                each(case.results.impulses.impulses.as_flattened());
            },
        },
        Function {
            call: pd_and_rk4_step,
            results: |case, each| {
                each(&case.results.after.base_pose_after);
                each(&case.results.after.joint_angles_after);
                each(&case.results.after.base_twist_after);
                each(&case.results.after.joint_rates_after);
            },
        },
        Function { call: merge, results: |case, each| each(&case.results.model.parameters().to_array()) },
    ];

    fn case(inputs: &Inputs) -> Case<Self> {
        let (parameters, model) = (Parameters::default(), Model::default());
        let results = Results {
            model,
            forward: ForwardDynamics {
                base_acceleration: [0.0; 3],
                joint_accelerations: [0.0; JOINTS],
                smallest_pivot: 0.0,
            },
            reduced: ReducedDynamics {
                generalized_inertia: [[0.0; JOINTS]; JOINTS],
                generalized_bias: [0.0; JOINTS],
                generalized_jacobian: [[0.0; JOINTS]; 3 * ARMS],
                smallest_pivot: 0.0,
            },
            base: [0.0; 3],
            joints: [0.0; JOINTS],
            impulses: Impulses { target_twists_after: [[0.0; 3]; ARMS], impulses: [[0.0; 3]; ARMS] },
            after: StateAfter {
                base_pose_after: [0.0; 3],
                joint_angles_after: [0.0; JOINTS],
                base_twist_after: [0.0; 3],
                joint_rates_after: [0.0; JOINTS],
            },
        };
        Case { parameters, model, inputs: *inputs, prepared: (), results }
    }

    fn capture(record: &mut Record) -> Result<(), &'static str> {
        capture(record).map_err(|_| "the module refuses the mission")
    }

    fn self_test() -> bool {
        self_test::run::<Real>().is_ok()
    }
}

fn velocities(case: &Case<Standalone>, each: &mut dyn FnMut(&[Real])) {
    each(&case.results.base);
    each(&case.results.joints);
}

/// Whether a pivot shows a regular system of finite numbers.
fn regular(pivot: Real) -> bool {
    pivot > 8.0 * Real::EPSILON
}

#[inline(never)]
fn model_new(case: &mut Case<Standalone>) -> bool {
    case.results.model = Model::new(case.parameters);
    true
}

#[inline(never)]
fn forward_dynamics(case: &mut Case<Standalone>) -> bool {
    let Case { model, inputs: i, results, .. } = case;
    results.forward =
        model.forward_dynamics(&i.base_pose, &i.joint_angles, &i.base_twist, &i.joint_rates, &i.joint_torques);
    regular(results.forward.smallest_pivot)
}

#[inline(never)]
fn reduced_dynamics(case: &mut Case<Standalone>) -> bool {
    let Case { model, inputs: i, results, .. } = case;
    results.reduced = model.reduced_dynamics(&i.base_pose, &i.joint_angles, &i.base_twist, &i.joint_rates);
    regular(results.reduced.smallest_pivot)
}

fn impact(case: &mut Case<Standalone>) -> bool {
    let Case { model, inputs: i, results, .. } = case;
    let FullImpact { base_twist_after, joint_rates_after, smallest_pivot, .. } = model.full_impact(
        &i.base_pose,
        &i.joint_angles,
        &i.base_twist,
        &i.joint_rates,
        &i.target_masses,
        &i.target_inertias,
        &i.contacts,
        &i.target_twists,
    );
    (results.base, results.joints) = (base_twist_after, joint_rates_after);
    regular(smallest_pivot)
}

#[inline(never)]
fn exact_impact(case: &mut Case<Standalone>) -> bool {
    impact(case)
}

#[inline(never)]
fn exact_impact_with_impulses(case: &mut Case<Standalone>) -> bool {
    let regular = impact(case);
    let Case { model, inputs: i, results, .. } = case;
    let impulses = model.impulses(
        &i.base_pose,
        &i.joint_angles,
        &results.base,
        &results.joints,
        &i.target_masses,
        &i.target_inertias,
        &i.contacts,
        &i.target_twists,
    );
    impulses.map(|impulses| results.impulses = impulses).is_ok() && regular
}

#[inline(never)]
fn pd_and_rk4_step(case: &mut Case<Standalone>) -> bool {
    let Case { model, inputs: i, results, .. } = case;
    let (angles, rates) = (&i.desired_angles, &i.desired_rates);
    model
        .pd_torques(&i.joint_angles, &i.joint_rates, angles, rates, &PROPORTIONAL_GAIN, &DERIVATIVE_GAIN)
        .and_then(|torques| {
            model.rk4_step(&i.base_pose, &i.joint_angles, &i.base_twist, &i.joint_rates, &torques, i.step)
        })
        .map(|after| results.after = after)
        .is_ok()
}

#[inline(never)]
fn merge(case: &mut Case<Standalone>) -> bool {
    let Case { model, inputs: i, results, .. } = case;
    results.model = *model;
    results.model.merge(&i.base_pose, &i.joint_angles, &i.target_masses, &i.target_inertias, &i.contacts).is_ok()
}
