//! Bringing a robot to rest after a capture.

use super::{BaseTorque, Control};
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::dot;
use crate::momentum_equation::MomentumEquation;
use crate::scalar::Real;
use crate::state::State;
use crate::validate::length;

/// Joint rates to zero, and the base rate with them where an actuator can take the angular momentum.
///
/// Wanted are `θ̈ = −k θ̇` for every joint and `ω̇ = −k_b ω` for the base. By joint torques alone the momentum stays:
/// the robot ends as one rigid body that turns with ω = l/I about its COM. What takes the angular momentum l:
/// - A base torque gives the robot momentum from outside, within its limit.
/// - Reaction wheels take what is left to do: they are not brought to rest but accelerated, all alike, so that the base
///   slows down as wanted. With a base torque too, they give back what they hold as far as that can take it.
///
/// Linear momentum stays in any case. The torques follow from eq. (1), `M v̇ + c = [F_b; τ]`, at the measured state.
#[derive(Debug)]
pub struct Stabilise<'a, T> {
    /// k of each joint, 1/s.
    pub joint_gain: &'a [T],
    /// `k_b`, 1/s.
    pub base_gain: T,
    /// Which joints turn balanced wheels: bodies with their COM on the joint's axis and nothing beyond it.
    pub wheels: &'a [bool],
    /// The largest torque on the base, N m, 0 or more; `None` where there is no such actuator.
    pub base_torque_limit: Option<T>,
    /// What was last commanded; `None` to begin with.
    pub base_torque: Option<BaseTorque<T>>,
    /// Working space, (3 + joints)².
    pub mass_matrix: &'a mut [T],
    /// Working space, 3 + joints.
    pub bias: &'a mut [T],
}

impl<T: Real> Control<T> for Stabilise<'_, T> {
    fn joint_torques(
        &mut self,
        _: T,
        model: &dyn Model<T>,
        state: &State<'_, T>,
        torques: &mut [T],
    ) -> Result<(), Error> {
        let joints = model.joints();
        length("joint_torques", joints, torques.len())?;
        length("joint_gain", joints, self.joint_gain.len())?;
        length("wheels", joints, self.wheels.len())?;
        model.mass_matrix(&state.base_pose, state.joint_angles, self.mass_matrix)?;
        model.bias(state, self.bias)?;
        let slow_wheels = self.base_torque_limit.is_some();
        let slowing = || {
            let rates = state.joint_rates.iter().zip(self.joint_gain).zip(self.wheels);
            rates.map(|((rate, gain), wheel)| if *wheel && !slow_wheels { T::ZERO } else { -(*gain * *rate) })
        };
        let wheel = || self.wheels.iter().map(|wheel| if *wheel { T::ONE } else { T::ZERO });

        // the first three rows: I_b a_b = F_b − c_b − I_bm θ̈
        let equation = MomentumEquation::new(self.mass_matrix, joints)?;
        let without_torque = self.bias.first_chunk::<3>().map_or([T::ZERO; 3], |bias| bias.map(|bias| -bias));
        let mut base = equation.solve_with_joints(without_torque, slowing);
        let [omega, ..] = state.base_twist;
        let wanted = -(self.base_gain * omega);
        self.base_torque = self.base_torque_limit.map(|limit| {
            let per_torque = equation.solve([T::ONE, T::ZERO, T::ZERO]);
            let command = (wanted - base[0]) / per_torque[0];
            let saturated = command.abs() > limit;
            let torque = match saturated {
                true if command < T::ZERO => -limit,
                true => limit,
                false => command,
            };
            add(&mut base, &per_torque, torque);
            BaseTorque { torque, saturated }
        });
        let per_wheel = equation.solve_with_joints([T::ZERO; 3], wheel);
        let spin = if per_wheel[0] == T::ZERO { T::ZERO } else { (wanted - base[0]) / per_wheel[0] };
        add(&mut base, &per_wheel, spin);

        let rows = self.mass_matrix.chunks_exact((3 + joints).max(1)).zip(self.bias.iter()).skip(3);
        for (torque, (row, bias)) in torques.iter_mut().zip(rows) {
            let Some((of_base, of_joints)) = row.split_first_chunk::<3>() else { continue };
            let accelerations = slowing().zip(wheel()).map(|(slowing, wheel)| slowing + wheel * spin);
            *torque = *bias + dot(of_base, base) + dot(of_joints, accelerations);
        }
        Ok(())
    }

    fn base_torque(&self) -> Option<BaseTorque<T>> {
        self.base_torque
    }
}

fn add<T: Real>(sum: &mut [T; 3], part: &[T; 3], times: T) {
    for (sum, part) in sum.iter_mut().zip(part) {
        *sum += *part * times;
    }
}
