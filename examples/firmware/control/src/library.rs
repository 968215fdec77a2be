//! The capture by the library: traits over slices, whose lengths the compiler knows, control laws, integrators.

use crate::Real;
use crate::mission::{self, Record, STEP, Writer};
use crate::route::{Case, Function, Route};
use crate::states::Inputs;
use planar_capture::control::{Control, ProportionalDerivative, SampledControl, ZeroTorque};
use planar_capture::dynamics::{ForwardDynamics, Impact, Merge, ReducedDynamics};
use planar_capture::error::Error;
use planar_capture::generated::dual_arm_3r::{ARMS, JOINTS, Model, Parameters};
use planar_capture::impact::{self, RigidImpactOutput};
use planar_capture::integrate::RungeKutta4;
use planar_capture::state::{Forces, State, vector_length};
use planar_capture::target::Target;
use planar_capture::trajectory::{DesiredJoint, PointToPoint, Quartic, Trajectory};

/// Length of the state vector: pose, angles, twist, rates, work of the torques.
const LENGTH: usize = vector_length(JOINTS);

/// Approach, contact, impact, and the motion of the merged robot.
///
/// # Errors
/// What the library says of the numbers.
#[inline(never)]
pub fn capture(record: &mut Record) -> Result<(), Error> {
    let mut record = Writer(record);
    let mut robot = Model::<Real>::default();
    let (mut x, mut memory) = ([0.0; LENGTH], Memory::NEW);
    let angles = &mission::INITIAL_ANGLES;
    State { base_pose: [0.0; 3], joint_angles: angles, base_twist: [0.0; 3], joint_rates: &[0.0; JOINTS] }
        .write(&mut x)?;
    let motion =
        PointToPoint { initial_angles: angles, final_angles: &mission::FINAL_ANGLES, duration: mission::DURATION };
    let law = ProportionalDerivative {
        trajectory: Quartic { motion, final_rates: &mission::FINAL_RATES },
        proportional_gain: &[mission::PROPORTIONAL_GAIN; JOINTS],
        derivative_gain: &[mission::DERIVATIVE_GAIN; JOINTS],
    };
    let mut held = [0.0; JOINTS];
    let mut law = SampledControl::new(law, 1, &mut held);
    for step in 0..mission::APPROACH_STEPS {
        let time = Real::from(step) * STEP;
        law.begin_step(time, &robot, &State::from_vector(&x, JOINTS)?)?;
        integrate(&robot, &mut law, time, &mut x, &mut memory)?;
    }
    record.put(&x[..LENGTH - 3]);

    let targets: [Option<Target<Real>>; ARMS] = mission::CONTACTS.map(|contact| {
        let (mass, inertia, twist) = (mission::TARGET_MASS, mission::TARGET_INERTIA, mission::TARGET_TWIST);
        Some(Target { mass, inertia, contact, twist })
    });
    let (mut joint_rates, mut twists, mut impulses) = ([0.0; JOINTS], [[0.0; 3]; ARMS], [[0.0; 3]; ARMS]);
    let mut after =
        RigidImpactOutput { joint_rates: &mut joint_rates, target_twists: &mut twists, impulses: &mut impulses };
    let before = x;
    let state = State::from_vector(&before, JOINTS)?;
    let base_twist = impact::exact(&robot, &state, &targets, &mut after)?;
    robot.merge(&state.base_pose, state.joint_angles, &targets)?;
    State { base_twist, joint_rates: &joint_rates, ..state }.write(&mut x)?;
    record.put(&x[..LENGTH - 3]);
    record.put(impulses.as_flattened());

    for step in 0..mission::POST_IMPACT_STEPS {
        integrate(&robot, &mut ZeroTorque, Real::from(step) * STEP, &mut x, &mut memory)?;
    }
    record.put(&x[..LENGTH - 3]);
    Ok(())
}

/// What a step needs besides the state: it is made once, and is not on the stack of each step.
#[derive(Debug)]
struct Memory {
    workspace: [Real; 3 * LENGTH],
    torques: [Real; JOINTS],
}

impl Memory {
    const NEW: Self = Self { workspace: [0.0; _], torques: [0.0; _] };
}

#[inline]
fn integrate(
    robot: &Model<Real>,
    law: &mut impl Control<Real, Model<Real>>,
    time: Real,
    x: &mut [Real; LENGTH],
    memory: &mut Memory,
) -> Result<(), Error> {
    let mut integrator = RungeKutta4::new(&mut memory.workspace)?;
    integrator.robot_step(robot, law, time, STEP, x, &mut memory.torques)
}

/// Set values of all joints.
struct SetPoint<'a> {
    angles: &'a [Real; JOINTS],
    rates: &'a [Real; JOINTS],
}

impl Trajectory<Real> for SetPoint<'_> {
    fn joint(&self, joint: usize, _: Real) -> Option<DesiredJoint<Real>> {
        Some(DesiredJoint { angle: *self.angles.get(joint)?, rate: *self.rates.get(joint)?, acceleration: 0.0 })
    }
}

/// The library.
#[derive(Clone, Copy, Debug)]
pub struct Library;

/// What the functions take.
#[derive(Debug)]
pub struct Prepared {
    targets: [Option<Target<Real>>; ARMS],
    memory: Memory,
    held: [Real; JOINTS],
}

/// What the functions give.
#[derive(Debug)]
pub struct Results {
    model: Model<Real>,
    base: [Real; 3],
    joints: [Real; JOINTS],
    generalized_inertia: [Real; JOINTS * JOINTS],
    generalized_bias: [Real; JOINTS],
    generalized_jacobian: [Real; 3 * ARMS * JOINTS],
    target_twists: [[Real; 3]; ARMS],
    impulses: [[Real; 3]; ARMS],
    x: [Real; LENGTH],
}

fn state(inputs: &Inputs) -> State<'_, Real> {
    State {
        base_pose: inputs.base_pose,
        joint_angles: &inputs.joint_angles,
        base_twist: inputs.base_twist,
        joint_rates: &inputs.joint_rates,
    }
}

impl Route for Library {
    const NAME: &'static str = "library";
    type Parameters = Parameters<Real>;
    type Model = Model<Real>;
    type Prepared = Prepared;
    type Results = Results;
    const FUNCTIONS: [Function<Self>; crate::route::NAMES.len()] = [
        Function { call: model_new, results: |case, each| each(&case.results.model.parameters().to_array()) },
        Function { call: forward_dynamics, results: velocities },
        Function {
            call: reduced_dynamics,
            results: |Case { results, .. }, each| {
                each(&results.generalized_inertia);
                each(&results.generalized_bias);
                each(&results.generalized_jacobian);
            },
        },
        Function { call: exact_impact, results: velocities },
        Function {
            call: exact_impact_with_impulses,
            results: |case, each| {
                velocities(case, each);
                each(case.results.target_twists.as_flattened());
                each(case.results.impulses.as_flattened());
            },
        },
        Function { call: pd_and_rk4_step, results: |case, each| each(&case.results.x[..LENGTH - 3]) },
        Function { call: merge, results: |case, each| each(&case.results.model.parameters().to_array()) },
    ];

    fn case(inputs: &Inputs) -> Case<Self> {
        let (parameters, model) = (Parameters::default(), Model::default());
        let mut x = [0.0; LENGTH];
        // a vector of this robot
        let _ = state(inputs).write(&mut x);
        let mut arm = 0..ARMS;
        let targets = [(); ARMS].map(|()| {
            let arm = arm.next()?;
            let (mass, inertia) = (inputs.target_masses[arm], inputs.target_inertias[arm]);
            Some(Target { mass, inertia, contact: inputs.contacts[arm], twist: inputs.target_twists[arm] })
        });
        let results = Results {
            model,
            base: [0.0; _],
            joints: [0.0; _],
            generalized_inertia: [0.0; _],
            generalized_bias: [0.0; _],
            generalized_jacobian: [0.0; _],
            target_twists: [[0.0; 3]; _],
            impulses: [[0.0; 3]; _],
            x,
        };
        Case {
            parameters,
            model,
            inputs: *inputs,
            prepared: Prepared { targets, memory: Memory::NEW, held: [0.0; _] },
            results,
        }
    }

    fn capture(record: &mut Record) -> Result<(), &'static str> {
        capture(record).map_err(|_| "the library refuses the mission")
    }

    fn self_test() -> bool {
        true // a shipped layout has no reference vectors in its code: its tests have them
    }
}

fn velocities(case: &Case<Library>, each: &mut dyn FnMut(&[Real])) {
    each(&case.results.base);
    each(&case.results.joints);
}

#[inline(never)]
fn model_new(case: &mut Case<Library>) -> bool {
    case.results.model = Model::new(case.parameters);
    true
}

#[inline(never)]
fn forward_dynamics(case: &mut Case<Library>) -> bool {
    let Case { model, inputs, results, .. } = case;
    let forces = Forces::torques(&inputs.joint_torques);
    let base = ForwardDynamics::forward_dynamics(model, &state(inputs), &forces, &mut results.joints);
    base.map(|base| results.base = base).is_ok()
}

#[inline(never)]
fn reduced_dynamics(case: &mut Case<Library>) -> bool {
    let Case { model, inputs, results, .. } = case;
    let Results { generalized_inertia, generalized_bias, generalized_jacobian, .. } = results;
    let state = state(inputs);
    ReducedDynamics::reduced_dynamics(model, &state, generalized_inertia, generalized_bias, generalized_jacobian)
        .is_ok()
}

#[inline(never)]
fn exact_impact(case: &mut Case<Library>) -> bool {
    let Case { model, inputs, prepared, results, .. } = case;
    let base = Impact::full_impact(model, &state(inputs), &prepared.targets, &mut results.joints);
    base.map(|base| results.base = base).is_ok()
}

#[inline(never)]
fn exact_impact_with_impulses(case: &mut Case<Library>) -> bool {
    let Case { model, inputs, prepared, results, .. } = case;
    let mut after = RigidImpactOutput {
        joint_rates: &mut results.joints,
        target_twists: &mut results.target_twists,
        impulses: &mut results.impulses,
    };
    let base = impact::exact(model, &state(inputs), &prepared.targets, &mut after);
    base.map(|base| results.base = base).is_ok()
}

#[inline(never)]
fn pd_and_rk4_step(case: &mut Case<Library>) -> bool {
    let Case { model, inputs, prepared, results, .. } = case;
    let law = ProportionalDerivative {
        trajectory: SetPoint { angles: &inputs.desired_angles, rates: &inputs.desired_rates },
        proportional_gain: &[mission::PROPORTIONAL_GAIN; JOINTS],
        derivative_gain: &[mission::DERIVATIVE_GAIN; JOINTS],
    };
    let mut law = SampledControl::new(law, 1, &mut prepared.held);
    State::from_vector(&results.x, JOINTS)
        .and_then(|state| law.begin_step(0.0, model, &state))
        .and_then(|()| integrate(model, &mut law, 0.0, &mut results.x, &mut prepared.memory))
        .is_ok()
}

#[inline(never)]
fn merge(case: &mut Case<Library>) -> bool {
    let Case { model, inputs, prepared, results, .. } = case;
    results.model = *model;
    results.model.merge(&inputs.base_pose, &inputs.joint_angles, &prepared.targets).is_ok()
}
