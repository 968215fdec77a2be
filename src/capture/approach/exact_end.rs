//! The end of an approach that is tracked exactly, from kinematics alone.

use crate::capture::approach::collocation::{Collocation, POINTS};
use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::formulation::PrescribedJoints;
use crate::owned::RobotState;
use crate::scalar::Real;
use crate::simulate::PhaseError;
use crate::state::State;
use crate::trajectory::Trajectory;

/// Most divisions of the time between two knots: a few hundred turns of the joints.
const MOST_PANELS: u32 = 1 << 8;
/// Largest change by half as long panels, rad or rad/s for values up to 1; the error is then of rounding.
const TOLERANCE: f64 = 1e-10;

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

/// The end of a motion from a state whose joints have a trajectory's accelerations, without forces. Its center of mass
/// moves uniformly; about it the angular momentum is constant, so that the rate of the base's yaw follows from the joints'
/// motion alone. What is left are integrals over time. At `knots` (s), in order and the last one the end, accelerations
/// may jump.
///
/// # Errors
/// Time and reason of a singular base inertia; [`Error::NotConverged`] for integrals that do not settle.
pub(crate) fn exact_end(
    model: &AnyModel<f64>,
    trajectory: impl Trajectory<f64>,
    initial: &RobotState,
    knots: &[f64],
) -> Result<ApproachEnd, PhaseError> {
    let at = |time| move |source| PhaseError { time, source };
    let end = knots.last().copied().unwrap_or_default();
    let joints = model.joints();
    let mut mass_matrix = vec![0.0; (3 + joints) * (3 + joints)];
    let mut prescribed = PrescribedJoints { mass_matrix: &mut mass_matrix };
    let momentum = model.momentum(&initial.view()).map_err(at(0.0))?;
    let [px, py] = momentum.linear_momentum;
    let [mass, mx, my] = prescribed.first_moment(model, &initial.base_pose, &initial.joint_angles).map_err(at(0.0))?;
    let [yaw, x, y] = initial.base_pose;
    let start = [x + mx / mass, y + my / mass];
    let spin = momentum.angular_momentum - (start[0] * py - start[1] * px);
    let inner = std::array::from_fn(|_| (vec![0.0; joints], vec![0.0; joints]));
    let mut motion = JointMotion { model, trajectory, prescribed, spin, collocation: Collocation::new(), inner };

    let mut panels = 1;
    let mut found = motion.integrate(initial, knots, panels)?;
    loop {
        panels *= 2;
        let finer = motion.integrate(initial, knots, panels)?;
        let changes = found.iter().zip(&finer).map(|(x, y)| (x - y).abs() / y.abs().max(1.0));
        let change = changes.fold(0.0, |most: f64, change| Real::maximum(most, change));
        found = finer;
        if change <= TOLERANCE {
            break;
        }
        if panels >= MOST_PANELS {
            let what = "yaw and joint angles at the end of the approach, with panels halved each time,";
            return Err(at(end)(Error::NotConverged { what, iterations: panels.ilog2(), change }));
        }
    }
    let (joint_angles, rest) = found.split_at(joints);
    let (joint_rates, turned) = rest.split_at(joints);
    let yaw = yaw + turned[0];
    let JointMotion { mut prescribed, .. } = motion;
    let [_, mx, my] = prescribed.first_moment(model, &[yaw, 0.0, 0.0], joint_angles).map_err(at(end))?;
    let base_pose = [yaw, start[0] + (px * end - mx) / mass, start[1] + (py * end - my) / mass];
    let momentum = [momentum.angular_momentum, px, py];
    let base_twist =
        prescribed.base_twist(model, momentum, (&base_pose, joint_angles, joint_rates)).map_err(at(end))?;
    let (joint_angles, joint_rates) = (joint_angles.to_vec(), joint_rates.to_vec());
    of_state(model, RobotState { base_pose, base_twist, joint_angles, joint_rates }, end).map_err(at(end))
}

/// Joints that have a trajectory's accelerations, and the turn of the base that follows.
struct JointMotion<'a, R> {
    model: &'a AnyModel<f64>,
    trajectory: R,
    prescribed: PrescribedJoints<'a, f64>,
    /// Angular momentum about the center of mass, N m s.
    spin: f64,
    collocation: Collocation,
    /// Joint angles and rates at the points of a panel.
    inner: [(Vec<f64>, Vec<f64>); POINTS],
}

impl<R: Trajectory<f64>> JointMotion<'_, R> {
    /// Joint angles, joint rates and the turn of the base at the last knot, with so many panels up to each.
    fn integrate(&mut self, initial: &RobotState, knots: &[f64], panels: u32) -> Result<Vec<f64>, PhaseError> {
        let (mut angles, mut rates) = (initial.joint_angles.clone(), initial.joint_rates.clone());
        let (mut turned, mut from) = (0.0, 0.0);
        for to in knots {
            let length = (to - from) / f64::from(panels);
            for panel in 0..panels {
                let start = from + f64::from(panel) * length;
                turned += self
                    .add_panel(start, length, &mut angles, &mut rates)
                    .map_err(|source| PhaseError { time: start, source })?;
            }
            from = *to;
        }
        angles.append(&mut rates);
        angles.push(turned);
        Ok(angles)
    }

    /// Adds the motion of a panel to joint angles and rates; the result is the turn of the base.
    fn add_panel(&mut self, start: f64, length: f64, angles: &mut [f64], rates: &mut [f64]) -> Result<f64, Error> {
        let joints = angles.len();
        for (joint, (angle, rate)) in angles.iter_mut().zip(rates).enumerate() {
            let mut accelerations = [0.0; POINTS];
            for (acceleration, point) in accelerations.iter_mut().zip(&self.collocation.points) {
                let wanted = self.trajectory.joint(joint, start + point * length);
                let none = Error::Index { what: "joint of the trajectory", index: joint, count: joints };
                *acceleration = wanted.ok_or(none)?.acceleration;
            }
            let integrals = |values: &[f64; POINTS], start: f64| {
                let (partial, whole) = self.collocation.integrals(values);
                (partial.map(|sum| start + length * sum), start + length * whole)
            };
            let (inner_rates, last_rate) = integrals(&accelerations, *rate);
            let (inner_angles, last_angle) = integrals(&inner_rates, *angle);
            for (i, (angles, rates)) in self.inner.iter_mut().enumerate() {
                (angles[joint], rates[joint]) = (inner_angles[i], inner_rates[i]);
            }
            (*angle, *rate) = (last_angle, last_rate);
        }
        let mut yaw_rates = [0.0; POINTS];
        for (yaw_rate, (angles, rates)) in yaw_rates.iter_mut().zip(&self.inner) {
            // from the center of mass there is no linear momentum, and no yaw is another one's
            let twist = self.prescribed.base_twist(self.model, [self.spin, 0.0, 0.0], (&[0.0; 3], angles, rates))?;
            *yaw_rate = twist[0];
        }
        let (_, turned) = self.collocation.integrals(&yaw_rates);
        Ok(length * turned)
    }
}

fn of_state(model: &AnyModel<f64>, state: RobotState, time: f64) -> Result<ApproachEnd, Error> {
    let State { base_pose, joint_angles, .. } = state.view();
    let [mut poses, mut twists] = [(); 2].map(|()| vec![[0.0; 3]; model.arms()]);
    model.end_effector_poses(&base_pose, joint_angles, &mut poses)?;
    model.end_effector_twists(&state.view(), &mut twists)?;
    Ok(ApproachEnd { time, state, end_effector_poses: poses, end_effector_twists: twists })
}

#[cfg(test)]
mod tests;
