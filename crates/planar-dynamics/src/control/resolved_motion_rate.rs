//! End effectors on their paths, by feedback of where they are.

use super::{Control, inverse_dynamics};
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::least_squares;
use crate::scalar::Real;
use crate::state::{Forces, State};
use crate::trajectory::EndEffectorPath;
use crate::validate::length;

/// Resolved motion rate control with the generalized Jacobian J, in closed loop over the end effectors' poses x:
///
/// ```text
/// θ̇_d = J⁺ (t_d + K e − b),                      e = x_d − x,  b = t − J θ̇
/// θ̈_d = J⁺ (ṫ_d + K (t_d − t) − a),              its rate on the way
/// τ   = I (θ̈_d + k (θ̇_d − θ̇)) + c
/// ```
///
/// all of the measured state. b is the part of the end effectors' twists t that the robot's momentum gives, `J_b I_b⁻¹
/// h`, zero for a robot that was at rest; a the end effectors' acceleration at constant joint rates, `J̇ θ̇ + ḃ`. Where
/// J has full row rank and nothing is damped, every component of e obeys `ë + (K + k) ė + K k e = 0` on its own: it
/// decays with exp(−K t) and exp(−k t), whatever the base does. (An error beyond the `error_limit` shrinks at the
/// constant speed K times that.)
///
/// J⁺ is of all wanted rows together, for the arms couple through the base. It gives the shortest rates where joints
/// are to spare; near a singular pose it is damped, in the singular directions alone, by the `singularity_threshold`:
/// the end effectors then leave their paths and the joint rates stay bounded.
///
/// Y. Umetani, K. Yoshida: *Resolved motion rate control of space manipulators with generalized Jacobian matrix*, IEEE
/// Trans. Robotics and Automation 5 (1989) 303–314, has the first line for a robot without momentum; with the other two
/// the rates are those of torques. J. Y. S. Luh, M. W. Walker, R. P. C. Paul: *Resolved-acceleration control of
/// mechanical manipulators* (1980), has them for a fixed base.
#[derive(Debug)]
pub struct ResolvedMotionRate<'a, T> {
    /// `x_d`, `t_d` and `ṫ_d` of every end effector.
    pub path: EndEffectorPath<'a, T>,
    /// Which of [yaw, x, y] follow the path, one per arm.
    pub wanted: &'a [[bool; 3]],
    /// Which joints are brought to rest instead, at the rate k, and kept there; one per joint.
    pub held: &'a [bool],
    /// The length that counts as much as one rad in singular values, one per arm, positive: its reach, m.
    pub reach: &'a [T],
    /// K, 1/s.
    pub pose_gain: T,
    /// k, 1/s.
    pub rate_gain: T,
    /// Errors count as no more than this, so that a pose out of reach does not stiffen the law without bound: rad, and
    /// m per m of reach.
    pub error_limit: T,
    /// The part of the largest singular value below which others are damped, 0 to 1; see the source of `least_squares`.
    pub singularity_threshold: T,
    /// The smallest singular value over the largest of the wanted rows of J, the smallest so far; `None` to begin with.
    pub singularity_margin: Option<T>,
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
    /// The wanted rows: 3 arms × joints.
    pub rows: &'a mut [T],
    /// 3 arms.
    pub right: &'a mut [T],
    /// joints.
    pub joint_accelerations: &'a mut [T],
}

impl<T: Real> ResolvedMotionRate<'_, T> {
    /// Fills the wanted rows of J, in units of the reach, and what they should give; returns how many there are.
    fn equations(
        &mut self,
        time: T,
        state: &State<'_, T>,
        base_acceleration: &[T; 3],
        joints: usize,
    ) -> Result<usize, Error> {
        let w = &mut self.workspace;
        let arms = self.wanted.len();
        let mut places = w.rows.chunks_exact_mut(joints.max(1)).zip(w.right.iter_mut());
        let jacobians = w.generalized_jacobian.chunks_exact((3 * joints).max(1));
        let full = w.end_effector_jacobian.chunks_exact((3 * (3 + joints)).max(1));
        let measured = w.end_effector_poses.iter().zip(w.end_effector_twists.iter());
        let end_effectors = jacobians.zip(full).zip(measured).zip(self.wanted.iter().zip(self.reach));
        let mut count = 0;
        for (arm, (((jacobian, full), (pose, twist)), (wanted, reach))) in end_effectors.enumerate() {
            let missing = Error::Length { quantity: "tip path", expected: arms, found: arm };
            let desired = self.path.end_effector(arm, time).ok_or(missing)?;
            let drift = acceleration(full, state, base_acceleration);
            let targets = desired.pose.iter().zip(&desired.twist).zip(&desired.acceleration);
            let found = pose.iter().zip(twist).zip(&drift);
            let units = [T::ONE, *reach, *reach];
            let parts = jacobian.chunks_exact(joints.max(1)).zip(targets.zip(found)).zip(wanted.iter().zip(&units));
            for ((row, (((x_d, t_d), a_d), ((x, t), a))), (wanted, unit)) in parts {
                if !*wanted {
                    continue;
                }
                let Some((place, right)) = places.next() else { return Ok(count) };
                let by_joints = row.iter().zip(state.joint_rates).fold(T::ZERO, |sum, (j, rate)| sum + *j * *rate);
                let error = bounded(*x_d - *x, self.error_limit * *unit);
                let rate = *t_d + self.pose_gain * error - (*t - by_joints);
                *right = (*a_d + self.pose_gain * (*t_d - *t) - *a + self.rate_gain * rate) / *unit;
                for (place, (entry, held)) in place.iter_mut().zip(row.iter().zip(self.held)) {
                    *place = if *held { T::ZERO } else { *entry / *unit };
                }
                count += 1;
            }
        }
        Ok(count)
    }
}

fn bounded<T: Real>(value: T, limit: T) -> T {
    match value.abs() > limit {
        true if value < T::ZERO => -limit,
        true => limit,
        false => value,
    }
}

/// Of an end effector, from the three rows of `[J_be J_me]` (the velocity of an end effector under a rate is that rate
/// turned by 90° times the way from the axis to the end effector), with joint rates as they are: `J_be a_b − Σ (ω_k² −
/// ω_{k−1}²) r_k`, `ω_k` being the absolute rate of the body beyond axis k and `r_k` the way from there to the end
/// effector; axis 0 is the base COM.
fn acceleration<T: Real>(jacobian: &[T], state: &State<'_, T>, [alpha, x, y]: &[T; 3]) -> [T; 3] {
    let mut rows = jacobian.chunks_exact((jacobian.len() / 3).max(1));
    let (Some(spin), Some(right), Some(up)) = (rows.next(), rows.next(), rows.next()) else { return [T::ZERO; 3] };
    let base = |row: &[T]| match row {
        [by_spin, by_x, by_y, ..] => *by_spin * *alpha + *by_x * *x + *by_y * *y,
        _ => T::ZERO,
    };
    let (mut ax, mut ay) = (base(right), base(up));
    let [omega, ..] = state.base_twist;
    let axes = spin.iter().zip(right).zip(up);
    let of_base = axes.clone().zip(core::iter::once(&omega));
    let mut rate = T::ZERO;
    for (((spin, right), up), turning) in of_base.chain(axes.skip(3).zip(state.joint_rates)) {
        let next = rate + *spin * *turning;
        let more = next * next - rate * rate;
        ax -= more * *up;
        ay += more * *right;
        rate = next;
    }
    [base(spin), ax, ay]
}

impl<T: Real> Control<T> for ResolvedMotionRate<'_, T> {
    fn joint_torques(
        &mut self,
        time: T,
        model: &dyn Model<T>,
        state: &State<'_, T>,
        torques: &mut [T],
    ) -> Result<(), Error> {
        let (joints, arms) = (model.joints(), model.arms());
        length("joint_torques", joints, torques.len())?;
        length("wanted", arms, self.wanted.len())?;
        length("held", joints, self.held.len())?;
        length("reach", arms, self.reach.len())?;
        let w = &mut self.workspace;
        length("rows", 3 * arms * joints, w.rows.len())?;
        length("right", 3 * arms, w.right.len())?;
        model.reduced_dynamics(state, w.generalized_inertia, w.generalized_bias, w.generalized_jacobian)?;
        model.end_effector_jacobian(&state.base_pose, state.joint_angles, w.end_effector_jacobian)?;
        model.end_effector_poses(&state.base_pose, state.joint_angles, w.end_effector_poses)?;
        model.end_effector_twists(state, w.end_effector_twists)?;
        // under these torques the joint rates stay as they are
        let base_acceleration =
            model.forward_dynamics(state, &Forces::torques(w.generalized_bias), w.joint_accelerations)?;
        let count = self.equations(time, state, &base_acceleration, joints)?;

        let w = &mut self.workspace;
        let rows = w.rows.get_mut(..count * joints).unwrap_or_default();
        let right = w.right.get_mut(..count).unwrap_or_default();
        let margin = least_squares(rows, right, joints, self.singularity_threshold, w.joint_accelerations);
        if count > 0 && !self.singularity_margin.is_some_and(|least| least <= margin) {
            self.singularity_margin = Some(margin);
        }
        let mut wanted = w.joint_accelerations.iter().zip(state.joint_rates);
        inverse_dynamics(w.generalized_inertia, w.generalized_bias, torques, |_| {
            Ok(wanted.next().map_or(T::ZERO, |(wanted, rate)| *wanted - self.rate_gain * *rate))
        })
    }
}
