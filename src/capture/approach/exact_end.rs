//! The end of an approach that is tracked exactly, from kinematics alone.

use crate::dynamics::Model;
use crate::error::Error;
use crate::formulation::PrescribedJoints;
use crate::integrate::RungeKutta4;
use crate::owned::RobotState;
use crate::scalar::Real;
use crate::simulate::PhaseError;
use crate::state::State;
use crate::trajectory::Trajectory;

/// Steps of the first integration.
const FIRST_STEPS: u32 = 64;
/// Most steps: a path that needs more of them is rougher than any simulation of it.
const MOST_STEPS: u32 = 1 << 13;
/// Largest change by half the step, rad or m for positions up to 1. The error is then a fifteenth of it, which is known
/// and subtracted (Richardson's extrapolation): some 1e-12 are left.
const TOLERANCE: f64 = 5e-10;

/// A robot at the end of its approach.
#[derive(Clone, Debug, PartialEq)]
pub struct ApproachEnd {
    /// s.
    pub time: f64,
    /// Of the robot.
    pub state: RobotState,
    /// [yaw, x, y] of each end effector; rad, m.
    pub end_effector_poses: Vec<[f64; 3]>,
    /// [ω, vx, vy] of each end effector; rad/s, m/s.
    pub end_effector_twists: Vec<[f64; 3]>,
}

/// The end of a motion from a state whose joints have a trajectory's accelerations. The base follows from the momentum,
/// so that no dynamics are computed; the steps of a Runge–Kutta method are halved until the end no longer
/// changes. At `knots` (s), in order and
/// the last one the end, accelerations may jump.
///
/// # Errors
/// Time and reason of a singular base inertia; [`Error::NotConverged`] for an end that does not settle.
pub(crate) fn exact_end(
    model: &dyn Model<f64>,
    trajectory: impl Trajectory<f64>,
    initial: &RobotState,
    knots: &[f64],
) -> Result<ApproachEnd, PhaseError> {
    let at = |time| move |source| PhaseError { time, source };
    let end = knots.last().copied().unwrap_or_default();
    let joints = model.joints();
    let momentum = model.momentum(&initial.view()).map_err(at(0.0))?;
    let [px, py] = momentum.linear_momentum;
    let mut mass_matrix = vec![0.0; (3 + joints) * (3 + joints)];
    let mut motion =
        PrescribedJoints { momentum: [momentum.angular_momentum, px, py], trajectory, mass_matrix: &mut mass_matrix };
    let start = [&initial.base_pose[..], &initial.joint_angles, &initial.joint_rates].concat();
    let mut workspace = vec![0.0; RungeKutta4::<f64>::WORKSPACE * start.len()];
    let mut integrate = |steps: u32| -> Result<Vec<f64>, PhaseError> {
        let mut method = RungeKutta4::new(&mut workspace).map_err(at(0.0))?;
        let (mut x, mut from) = (start.clone(), 0.0);
        for to in knots {
            let step = (to - from) / f64::from(steps);
            for i in 0..steps {
                let time = from + f64::from(i) * step;
                let derivative = |t: f64, x: &[f64], rate: &mut [f64]| motion.derivative(model, t, x, rate);
                method.step(time, step, &mut x, derivative).map_err(at(time))?;
            }
            from = *to;
        }
        Ok(x)
    };
    let mut steps = FIRST_STEPS;
    let mut x = integrate(steps)?;
    loop {
        steps *= 2;
        let finer = integrate(steps)?;
        let changes = x.iter().zip(&finer).map(|(x, y)| (x - y).abs() / y.abs().max(1.0));
        let change = changes.fold(0.0, |most: f64, change| Real::maximum(most, change));
        if change <= TOLERANCE {
            x = x.iter().zip(&finer).map(|(x, y)| y + (y - x) / 15.0).collect();
            break;
        }
        if steps >= MOST_STEPS {
            let what = "positions and rates at the end of the approach, with its steps halved each time,";
            return Err(at(end)(Error::NotConverged { what, iterations: (steps / FIRST_STEPS).ilog2(), change }));
        }
        x = finer;
    }
    let (base_pose, moved) = x.split_first_chunk().expect("a vector begins with the base pose");
    let (joint_angles, joint_rates) = moved.split_at(joints);
    let base_twist = motion.base_twist(model, base_pose, joint_angles, joint_rates).map_err(at(end))?;
    let state = RobotState {
        base_pose: *base_pose,
        base_twist,
        joint_angles: joint_angles.to_vec(),
        joint_rates: joint_rates.to_vec(),
    };
    of_state(model, state, end).map_err(at(end))
}

fn of_state(model: &dyn Model<f64>, state: RobotState, time: f64) -> Result<ApproachEnd, Error> {
    let State { base_pose, joint_angles, .. } = state.view();
    let [mut poses, mut twists] = [(); 2].map(|()| vec![[0.0; 3]; model.arms()]);
    model.end_effector_poses(&base_pose, joint_angles, &mut poses)?;
    model.end_effector_twists(&state.view(), &mut twists)?;
    Ok(ApproachEnd { time, state, end_effector_poses: poses, end_effector_twists: twists })
}
