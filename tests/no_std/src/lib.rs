//! A capture on a microcontroller, in `f32`: every part of the core instantiated, nothing of std, nothing allocated.
//!
//! Built for a Cortex-M4F with `build-std=core` alone. That it never panics is checked in its object code.
#![no_std]
#![forbid(unsafe_code)]

use planar_capture::body::Body;
use planar_capture::contact::{
    self, ConstraintSolver, ConstraintWorkspace, Contact, DelassusMatrix, ImpulseEllipse, InverseInertia,
    LoopConstraint, workspace_length,
};
use planar_capture::control::{
    ComputedTorque, Control, EndEffectorWorkspace, InverseDynamics, ProportionalDerivative, ResolvedMotionRate,
    SampledControl, Stabilisation, TorqueLimiter, ZeroTorque,
};
use planar_capture::dynamics::{Kinematics, Merge, Momentum, MomentumAndEnergy};
use planar_capture::error::Error;
use planar_capture::formulation::{CanonicalVariables, ReducedCoordinates, derivative};
use planar_capture::generated::dual_arm_3r::{JOINTS, Model, SIZE};
use planar_capture::impact::{self, PaperImpactWorkspace, RigidImpactOutput};
use planar_capture::integrate::{GaussLegendre, RungeKutta4, SemiImplicitEuler};
use planar_capture::state::{State, StateVector, split, split_mut, vector_length};
use planar_capture::target::Target;
use planar_capture::trajectory::{Cycloidal, EndEffectorPath, PointToPoint, Quartic, Quintic};

const LENGTH: usize = vector_length(JOINTS);
const ARMS: usize = 2;

/// The robot of the paper.
#[inline(never)]
pub fn model() -> Model<f32> {
    Model::default()
}

/// One Runge–Kutta step of the approach under PD control.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn approach_step(
    model: &Model<f32>,
    motion: PointToPoint<'_, f32>,
    final_rates: &[f32; JOINTS],
    time: f32,
    x: &mut [f32; LENGTH],
) -> Result<(), Error> {
    let mut law = ProportionalDerivative {
        trajectory: Quartic { motion, final_rates },
        proportional_gain: &[49.0; JOINTS],
        derivative_gain: &[14.0; JOINTS],
    };
    step(model, &mut law, time, x)
}

/// One step along a cycloidal trajectory with torques from inverse dynamics.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn exact_step(
    model: &Model<f32>,
    motion: PointToPoint<'_, f32>,
    time: f32,
    x: &mut [f32; LENGTH],
) -> Result<(), Error> {
    let mut law = InverseDynamics {
        trajectory: Cycloidal { motion },
        generalized_inertia: &mut [0.0; JOINTS * JOINTS],
        generalized_bias: &mut [0.0; JOINTS],
        generalized_jacobian: &mut [0.0; 3 * ARMS * JOINTS],
    };
    step(model, &mut law, time, x)
}

/// One step along a quintic under computed torque, sampled at its start, with limits.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn computed_step(
    model: &Model<f32>,
    motion: PointToPoint<'_, f32>,
    rates: [&[f32; JOINTS]; 2],
    time: f32,
    x: &mut [f32; LENGTH],
) -> Result<[bool; JOINTS], Error> {
    let mut saturated = [false; JOINTS];
    let law = ComputedTorque {
        trajectory: Quintic { motion, initial_rates: rates[0], final_rates: rates[1] },
        proportional_gain: &[49.0; JOINTS],
        derivative_gain: &[14.0; JOINTS],
        generalized_inertia: &mut [0.0; JOINTS * JOINTS],
        generalized_bias: &mut [0.0; JOINTS],
        generalized_jacobian: &mut [0.0; 3 * ARMS * JOINTS],
    };
    let mut held = [0.0; JOINTS];
    let limited = TorqueLimiter { law, torque_limits: &[20.0; JOINTS], saturated: &mut saturated };
    let mut sampled = SampledControl::new(limited, 1, &mut held);
    let before = *x;
    let state = State::from_vector(&before, JOINTS)?;
    sampled.begin_step(time, model, &state)?;
    step(model, &mut sampled, time, x)?;
    Ok(saturated)
}

/// One step with the tips on their paths; returns the singularity margin.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn steered_step(
    model: &Model<f32>,
    path: EndEffectorPath<'_, f32>,
    time: f32,
    x: &mut [f32; LENGTH],
) -> Result<Option<f32>, Error> {
    let mut law = ResolvedMotionRate {
        path,
        controlled: &[[true; 3]; ARMS],
        locked: &[false; JOINTS],
        reach: &[3.0; ARMS],
        pose_gain: 2.0,
        rate_gain: 10.0,
        error_limit: 0.05,
        singularity_threshold: 0.04,
        singularity_margin: None,
        is_limited: false,
        workspace: EndEffectorWorkspace {
            generalized_inertia: &mut [0.0; JOINTS * JOINTS],
            generalized_bias: &mut [0.0; JOINTS],
            generalized_jacobian: &mut [0.0; 3 * ARMS * JOINTS],
            end_effector_jacobian: &mut [0.0; 3 * ARMS * SIZE],
            end_effector_poses: &mut [[0.0; 3]; ARMS],
            end_effector_twists: &mut [[0.0; 3]; ARMS],
            rows: &mut [0.0; 3 * ARMS * JOINTS],
            right_hand_side: &mut [0.0; 3 * ARMS],
            joint_accelerations: &mut [0.0; JOINTS],
        },
    };
    step(model, &mut law, time, x)?;
    Ok(law.singularity_margin)
}

/// One step of coming to rest, by joints and thrusters on the base.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn stabilise_step(model: &Model<f32>, time: f32, x: &mut [f32; LENGTH]) -> Result<(), Error> {
    let mut law = Stabilisation {
        joint_gain: &[0.5; JOINTS],
        base_gain: 0.5,
        wheels: &[false; JOINTS],
        base_torque_limit: Some(0.02),
        base_torque: None,
        mass_matrix: &mut [0.0; SIZE * SIZE],
        bias: &mut [0.0; SIZE],
    };
    step(model, &mut law, time, x)
}

/// The exact capture; the model becomes the merged robot, and x holds the velocities after the impact.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn capture(
    model: &mut Model<f32>,
    targets: &[Option<Target<f32>>; ARMS],
    x: &mut [f32; LENGTH],
) -> Result<[[f32; 3]; ARMS], Error> {
    let before = *x;
    let state = State::from_vector(&before, JOINTS)?;
    let (mut joint_rates, mut target_twists, mut impulses) = ([0.0; JOINTS], [[0.0; 3]; ARMS], [[0.0; 3]; ARMS]);
    let mut after =
        RigidImpactOutput { joint_rates: &mut joint_rates, target_twists: &mut target_twists, impulses: &mut impulses };
    let base_twist = impact::exact(model, &state, targets, &mut after)?;
    model.merge(&state.base_pose, state.joint_angles, targets)?;
    State { base_twist, joint_rates: &joint_rates, ..state }.write(x)?;
    Ok(impulses)
}

/// The paper's impact.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn paper(
    model: &Model<f32>,
    state: &State<'_, f32>,
    targets: &[Option<Target<f32>>; ARMS],
    joint_rates: &mut [f32; JOINTS],
) -> Result<[f32; 3], Error> {
    let mut workspace = PaperImpactWorkspace {
        impact_matrix: &mut [0.0; JOINTS * JOINTS],
        impact_momentum: &mut [0.0; JOINTS],
        jacobian: &mut [0.0; 3 * ARMS * JOINTS],
        mass_matrix: &mut [0.0; SIZE * SIZE],
    };
    let mut after =
        RigidImpactOutput { joint_rates, target_twists: &mut [[0.0; 3]; ARMS], impulses: &mut [[0.0; 3]; ARMS] };
    impact::paper(model, state, targets, &mut workspace, &mut after)
}

/// One step without torques.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn integrate_to_contact(model: &Model<f32>, time: f32, x: &mut [f32; LENGTH]) -> Result<(), Error> {
    step(model, &mut ZeroTorque, time, x)
}

/// One semi-implicit step in reduced coordinates, with the momentum [l, px, py].
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn reduced_step(model: &Model<f32>, momentum: [f32; 3], time: f32, x: &mut [f32; LENGTH]) -> Result<(), Error> {
    let mut equation = ReducedCoordinates {
        momentum,
        mass_matrix: &mut [0.0; SIZE * SIZE],
        generalized_inertia: &mut [0.0; JOINTS * JOINTS],
        generalized_bias: &mut [0.0; JOINTS],
        generalized_jacobian: &mut [0.0; 3 * ARMS * JOINTS],
    };
    let mut torques = [0.0; JOINTS];
    let mut workspace = [0.0; LENGTH];
    let mut euler = SemiImplicitEuler::new(&mut workspace);
    euler.step(time, 0.005, x, |t, x, rate| equation.derivative(model, &mut ZeroTorque, t, x, rate, &mut torques))?;
    equation.recover(model, x)
}

/// One Gauss–Legendre step of free motion, of positions and momenta.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn symplectic_step(model: &Model<f32>, time: f32, x: &mut [f32; LENGTH]) -> Result<(), Error> {
    let mut canonical = CanonicalVariables {
        inertias: &mut [[0.0; 2]; JOINTS + 1],
        poses: &mut [[0.0; 3]; JOINTS + 1],
        twists: &mut [[0.0; 3]; JOINTS + 1],
        offsets: &mut [[0.0; 2]; JOINTS],
        leaves: &mut [false; JOINTS],
        rates: &mut [0.0; JOINTS],
    };
    let before = *x;
    let state = State::from_vector(&before, JOINTS)?;
    canonical.measure(model, &state.base_pose, state.joint_angles)?;
    canonical.momenta(model, &state, split_mut(x)?.rates)?;
    let mut workspace = [0.0; GaussLegendre::<f32>::WORKSPACE * LENGTH];
    let mut gauss = GaussLegendre::new(&mut workspace)?;
    let mut joint_rates = [0.0; JOINTS];
    gauss.step(time, 0.05, x, |_, x, rate| {
        let StateVector { rates: momenta, .. } = split(x)?;
        let at = State::from_vector(x, JOINTS)?;
        let base_twist = canonical.velocities(model, at.base_pose, at.joint_angles, momenta, &mut joint_rates)?;
        let now = State { base_twist, joint_rates: &joint_rates, ..at };
        rate.fill(0.0);
        now.write(rate)?;
        let StateVector { positions: velocities, rates: forces, .. } = split_mut(rate)?;
        for (velocity, force) in velocities.iter_mut().zip(forces.iter_mut()) {
            *velocity = core::mem::take(force);
        }
        canonical.add_energy_gradient(model, &now, forces)
    })
}

/// Momentum, and the tips.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn look(model: &Model<f32>, state: &State<'_, f32>, tips: &mut [[f32; 3]; ARMS]) -> Result<Momentum<f32>, Error> {
    Kinematics::end_effector_poses(model, &state.base_pose, state.joint_angles, tips)?;
    MomentumAndEnergy::momentum(model, state)
}

fn step(
    model: &Model<f32>,
    law: &mut impl Control<f32, Model<f32>>,
    time: f32,
    x: &mut [f32; LENGTH],
) -> Result<(), Error> {
    let mut workspace = [0.0; 3 * LENGTH];
    let mut torques = [0.0; JOINTS];
    let mut integrator = RungeKutta4::new(&mut workspace)?;
    integrator.robot_step(model, law, time, 0.005, x, &mut torques)
}

/// Room for both tips on one body: six rows.
const ROWS: usize = 6;
const NUMBERS: usize = workspace_length(JOINTS, ARMS, 1, ROWS);

/// One body touched by both tips, in any way; returns the impulses on the robot, and x and the body hold the velocities
/// after.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn touch(
    model: &Model<f32>,
    body: &mut Body<f32>,
    contacts: &[Contact<f32>; ARMS],
    x: &mut [f32; LENGTH],
) -> Result<[[f32; 3]; ARMS], Error> {
    let before = *x;
    let state = State::from_vector(&before, JOINTS)?;
    let bodies = [*body];
    let mut numbers = [0.0; NUMBERS];
    let length = workspace_length(JOINTS, ARMS, 1, DelassusMatrix::count(contacts));
    let numbers = numbers.get_mut(..length).unwrap_or_default();
    let rows = DelassusMatrix::new(model, &state.base_pose, state.joint_angles, &bodies, contacts, numbers)?;
    let (mut joint_rates, mut body_twists, mut impulses) = ([0.0; JOINTS], [[0.0; 3]; 1], [[0.0; 3]; ARMS]);
    let mut after =
        contact::ImpactOutput { joint_rates: &mut joint_rates, body_twists: &mut body_twists, impulses: &mut impulses };
    let base_twist = contact::impact(model, &state, &bodies, rows, &mut after)?;
    let [twist] = body_twists;
    body.twist = twist;
    State { base_twist, joint_rates: &joint_rates, ..state }.write(x)?;
    Ok(impulses)
}

/// One step with a body held by both tips.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn held_step(
    model: &Model<f32>,
    body: &Body<f32>,
    constraints: &[LoopConstraint<f32>; ARMS],
    time: f32,
    x: &mut [f32; LENGTH + 6],
) -> Result<[f32; 2], Error> {
    let bodies = [*body];
    let hold = ConstraintSolver { model, bodies: &bodies, constraints };
    let mut numbers = [0.0; NUMBERS];
    let mut forces = [0.0; ROWS];
    let mut space = ConstraintWorkspace {
        contacts: &mut [Contact::any(); ARMS],
        numbers: numbers.get_mut(..hold.workspace_length()).unwrap_or_default(),
        forces: forces.get_mut(..hold.rows()).unwrap_or_default(),
        jacobian: &mut [0.0; 3 * ARMS * SIZE],
        end_effectors: &mut [[0.0; 3]; ARMS],
    };
    let mut workspace = [0.0; 3 * (LENGTH + 6)];
    let mut torques = [0.0; JOINTS];
    let mut integrator = RungeKutta4::new(&mut workspace)?;
    integrator.step(time, 0.005, x, |t, x, rate| {
        derivative(model, &mut ZeroTorque, t, x, rate, &mut torques)?;
        hold.constrain(x, rate, &mut space)
    })?;
    hold.project(x, &mut space)?;
    hold.errors(x, &mut space)
}

/// What a contact at a tip asks of the robot.
///
/// # Errors
/// What the core says of the numbers.
#[inline(never)]
pub fn impulse_ellipse(model: &Model<f32>, state: &State<'_, f32>, arm: usize) -> Result<ImpulseEllipse<f32>, Error> {
    let mut wrenches = [[0.0; 3]; ARMS];
    let mut scratch = [0.0; 2 * JOINTS];
    let angles = state.joint_angles;
    let inertia = InverseInertia::of_end_effector(model, &state.base_pose, angles, arm, &mut wrenches, &mut scratch)?;
    Ok(inertia.impulse_ellipse())
}
