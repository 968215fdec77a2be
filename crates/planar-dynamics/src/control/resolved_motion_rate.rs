//! Joint torques that move the end effectors along paths, with feedback of their poses.

use super::{Control, inverse_dynamics};
use crate::dynamics::Model;
use crate::error::Error;
use crate::jacobian_rate::jacobian_rate_times_velocity;
use crate::linear::{dot, least_squares, matrix_rows, matrix_rows_mut};
use crate::scalar::Real;
use crate::state::{Forces, State};
use crate::trajectory::EndEffectorPath;
use crate::validate::length;

/// Resolved motion rate control with the generalized Jacobian J and feedback of the end effectors' poses x:
///
/// ```text
/// θ̇_d = J⁺ (t_d + K e − b),                      e = x_d − x,  b = t − J θ̇
/// θ̈_d = J⁺ (ṫ_d + K (t_d − t) − a),              its time derivative
/// τ   = I (θ̈_d + k (θ̇_d − θ̇)) + c
/// ```
///
/// All terms are evaluated at the measured state. b is the part of the end effectors' twists t due to the robot's
/// momentum, `J_b I_b⁻¹ h`, and zero for a robot that started at rest; a is the end effectors' acceleration at constant
/// joint rates, `J̇ θ̇ + ḃ`. Where J has full row rank and nothing is damped, every component of e obeys
/// `ë + (K + k) ė + K k e = 0`: it decays with exp(−K t) and exp(−k t), for any motion of the base. An error
/// beyond the `error_limit` decreases at the constant speed K times that.
///
/// J⁺ is the pseudoinverse of all controlled rows together, because the arms are coupled through the base. It gives the
/// smallest rates where there are redundant joints. Near a singular pose the singular directions alone are damped, see
/// `singularity_threshold`: the end effectors then leave their paths and the joint rates stay bounded.
///
/// Y. Umetani, K. Yoshida: *Resolved motion rate control of space manipulators with generalized Jacobian matrix*, IEEE
/// Trans. Robotics and Automation 5 (1989) 303–314, gives the first line for a robot without momentum; the other two
/// turn rates into torques. J. Y. S. Luh, M. W. Walker, R. P. C. Paul: *Resolved-acceleration control of mechanical
/// manipulators* (1980), gives them for a fixed base.
#[derive(Debug)]
pub struct ResolvedMotionRate<'a, T> {
    /// `x_d`, `t_d` and `ṫ_d` of every end effector.
    pub path: EndEffectorPath<'a, T>,
    /// Which of [yaw, x, y] follow the path, one per arm.
    pub controlled: &'a [[bool; 3]],
    /// Which joints are instead brought to rest, at the rate k, and kept there; one per joint.
    pub locked: &'a [bool],
    /// The length that is equivalent to one rad in singular values, one per arm, positive: its reach, m.
    pub reach: &'a [T],
    /// K, 1/s.
    pub pose_gain: T,
    /// k, 1/s.
    pub rate_gain: T,
    /// Larger errors are reduced to this, so that an unreachable pose does not demand unbounded rates: rad, and m per m
    /// of reach.
    pub error_limit: T,
    /// The fraction of the largest singular value below which others are damped, 0 to 1; see the source of
    /// `least_squares`.
    pub singularity_threshold: T,
    /// The ratio of the smallest to the largest singular value of the controlled rows of J at the last state; `None`
    /// initially.
    pub singularity_margin: Option<T>,
    /// Whether errors were reduced, or singular directions damped, at the last state; `false` initially.
    pub is_limited: bool,
    /// Working space.
    pub workspace: EndEffectorWorkspace<'a, T>,
}

/// Working space of [`ResolvedMotionRate`].
#[derive(Debug)]
pub struct EndEffectorWorkspace<'a, T> {
    /// joints².
    pub generalized_inertia: &'a mut [T],
    /// joints.
    pub generalized_bias: &'a mut [T],
    /// 3 arms × joints.
    pub generalized_jacobian: &'a mut [T],
    /// 3 arms × (3 + joints).
    pub end_effector_jacobian: &'a mut [T],
    /// One per arm.
    pub end_effector_poses: &'a mut [[T; 3]],
    /// One per arm.
    pub end_effector_twists: &'a mut [[T; 3]],
    /// The controlled rows of J: 3 arms × joints.
    pub rows: &'a mut [T],
    /// 3 arms.
    pub right_hand_side: &'a mut [T],
    /// joints.
    pub joint_accelerations: &'a mut [T],
}

impl<T: Real> ResolvedMotionRate<'_, T> {
    /// Fills the controlled rows of J, in units of the reach, and their right-hand sides; returns their number.
    fn fill_equations(
        &mut self,
        time: T,
        state: &State<'_, T>,
        base_acceleration: &[T; 3],
        joints: usize,
    ) -> Result<usize, Error> {
        let w = &mut self.workspace;
        let arms = self.controlled.len();
        let mut equations = matrix_rows_mut(w.rows, joints).zip(w.right_hand_side.iter_mut());
        let jacobians = matrix_rows(w.generalized_jacobian, 3 * joints);
        let full_jacobians = matrix_rows(w.end_effector_jacobian, 3 * (3 + joints));
        let measured = w.end_effector_poses.iter().zip(w.end_effector_twists.iter());
        let end_effectors = jacobians.zip(full_jacobians).zip(measured).zip(self.controlled.iter().zip(self.reach));
        let mut count = 0;
        for (arm, (((jacobian, full_jacobian), (pose, twist)), (controlled, reach))) in end_effectors.enumerate() {
            let missing = Error::Length { quantity: "end effector path", expected: arms, found: arm };
            let desired = self.path.end_effector(arm, time).ok_or(missing)?;
            let acceleration = acceleration(full_jacobian, state, base_acceleration);
            let targets = desired.pose.iter().zip(&desired.twist).zip(&desired.acceleration);
            let actual = pose.iter().zip(twist).zip(&acceleration);
            let units = [T::ONE, *reach, *reach];
            let components = matrix_rows(jacobian, joints).zip(targets.zip(actual)).zip(controlled.iter().zip(&units));
            let controlled = components.filter(|(_, (on, _))| **on);
            for (((row, (((x_d, t_d), a_d), ((x, t), a))), (_, unit)), (place, right)) in controlled.zip(&mut equations)
            {
                let (error, limit) = (*x_d - *x, self.error_limit * *unit);
                self.is_limited |= error.abs() > limit;
                let error = error.limit_magnitude(limit);
                let rate = *t_d + self.pose_gain * error - (*t - dot(row, state.joint_rates));
                *right = (*a_d + self.pose_gain * (*t_d - *t) - *a + self.rate_gain * rate) / *unit;
                for (place, (entry, locked)) in place.iter_mut().zip(row.iter().zip(self.locked)) {
                    *place = if *locked { T::ZERO } else { *entry / *unit };
                }
                count += 1;
            }
        }
        Ok(count)
    }
}

/// The acceleration of an end effector at constant joint rates, `J_be a_b + J̇ v`, from the three rows of `[J_be J_me]`.
fn acceleration<T: Real>(jacobian: &[T], state: &State<'_, T>, base_acceleration: &[T; 3]) -> [T; 3] {
    let [x, y] = jacobian_rate_times_velocity(jacobian, state);
    let mut acceleration = [T::ZERO, x, y];
    for (component, row) in acceleration.iter_mut().zip(matrix_rows(jacobian, jacobian.len() / 3)) {
        *component += dot(row, base_acceleration);
    }
    acceleration
}

impl<T: Real, M: Model<T> + ?Sized> Control<T, M> for ResolvedMotionRate<'_, T> {
    fn singularity_margin(&self) -> Option<T> {
        self.singularity_margin
    }

    fn is_limited(&self) -> bool {
        self.is_limited
    }

    fn joint_torques(&mut self, time: T, model: &M, state: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        let (joints, arms) = (model.joints(), model.arms());
        length("joint_torques", joints, torques.len())?;
        length("controlled", arms, self.controlled.len())?;
        length("locked", joints, self.locked.len())?;
        length("reach", arms, self.reach.len())?;
        let w = &mut self.workspace;
        length("rows", 3 * arms * joints, w.rows.len())?;
        length("right_hand_side", 3 * arms, w.right_hand_side.len())?;
        model.reduced_dynamics(state, w.generalized_inertia, w.generalized_bias, w.generalized_jacobian)?;
        model.end_effector_jacobian(&state.base_pose, state.joint_angles, w.end_effector_jacobian)?;
        model.end_effector_poses(&state.base_pose, state.joint_angles, w.end_effector_poses)?;
        model.end_effector_twists(state, w.end_effector_twists)?;
        // these torques keep the joint rates constant
        let base_acceleration =
            model.forward_dynamics(state, &Forces::torques(w.generalized_bias), w.joint_accelerations)?;
        self.is_limited = false;
        let count = self.fill_equations(time, state, &base_acceleration, joints)?;

        let w = &mut self.workspace;
        let missing = Error::Length { quantity: "rows", expected: count * joints, found: w.rows.len() };
        let rows = w.rows.get_mut(..count * joints).ok_or(missing)?;
        let right = w.right_hand_side.get_mut(..count).ok_or(missing)?;
        let margin = least_squares(rows, right, joints, self.singularity_threshold, w.joint_accelerations);
        self.singularity_margin = (count > 0).then_some(margin);
        self.is_limited |= count > 0 && margin < self.singularity_threshold;
        let desired = w.joint_accelerations.iter().zip(state.joint_rates);
        let mut add = inverse_dynamics(w.generalized_inertia, w.generalized_bias, torques);
        desired.for_each(|(desired, rate)| add(*desired - self.rate_gain * *rate));
        Ok(())
    }
}
