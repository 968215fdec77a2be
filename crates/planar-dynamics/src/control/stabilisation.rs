//! Joint and base torques that bring a robot to rest after a capture.

use super::{BaseTorque, Control};
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::{add_scaled, dot, matrix_rows};
use crate::momentum_equation::MomentumEquation;
use crate::scalar::Real;
use crate::state::{State, coordinates};
use crate::validate::length;

/// Drives the joint rates to zero, and the base rate too where an actuator can absorb the angular momentum.
///
/// The desired accelerations are `θ̈ = −k θ̇` of every joint and `ω̇ = −k_b ω` of the base. Joint torques alone conserve
/// momentum: the robot ends as a rigid body that turns with ω = l/I about its COM. The angular momentum l is absorbed by
/// - a base torque, an external moment within its limit;
/// - reaction wheels, for the remainder: they are not brought to rest but all accelerated alike, so that the base
///   decelerates as desired. With a base torque too, they return their momentum as far as the base torque can absorb it.
///
/// Linear momentum is always conserved. The torques follow from eq. (1), `M v̇ + c = [F_b; τ]`, at the measured state.
#[derive(Debug)]
pub struct Stabilisation<'a, T> {
    /// k of each joint, 1/s.
    pub joint_gain: &'a [T],
    /// `k_b`, 1/s.
    pub base_gain: T,
    /// Which joints drive balanced wheels: last bodies of an arm with their COM on the joint's axis.
    pub wheels: &'a [bool],
    /// The largest torque on the base, N m, 0 or more; `None` without such an actuator.
    pub base_torque_limit: Option<T>,
    /// The last command; `None` initially.
    pub base_torque: Option<BaseTorque<T>>,
    /// Working space, (3 + joints)².
    pub mass_matrix: &'a mut [T],
    /// Working space, 3 + joints.
    pub bias: &'a mut [T],
}

impl<T: Real, M: Model<T> + ?Sized> Control<T, M> for Stabilisation<'_, T> {
    fn joint_torques(&mut self, _: T, model: &M, state: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        let joints = model.joints();
        length("joint_torques", joints, torques.len())?;
        length("joint_gain", joints, self.joint_gain.len())?;
        length("wheels", joints, self.wheels.len())?;
        model.mass_matrix(&state.base_pose, state.joint_angles, self.mass_matrix)?;
        model.bias(state, self.bias)?;
        let slow_wheels = self.base_torque_limit.is_some();
        let decelerations = || {
            let rates = state.joint_rates.iter().zip(self.joint_gain).zip(self.wheels);
            rates.map(|((rate, gain), wheel)| if *wheel && !slow_wheels { T::ZERO } else { -(*gain * *rate) })
        };
        let wheel = || self.wheels.iter().map(|wheel| if *wheel { T::ONE } else { T::ZERO });

        // the rows of the base: I_b a_b = F_b − c_b − I_bm θ̈
        let equation = MomentumEquation::new(self.mass_matrix, joints)?;
        let bias = coordinates(self.bias, joints)?;
        let mut base = equation.solve_with_joints(bias.base.map(|bias| -bias), decelerations);
        let [omega, ..] = state.base_twist;
        let desired = -(self.base_gain * omega);
        self.base_torque = self.base_torque_limit.map(|limit| {
            let per_torque = equation.solve([T::ONE, T::ZERO, T::ZERO]);
            let command = (desired - base[0]) / per_torque[0];
            let torque = command.limit_magnitude(limit);
            add_scaled(&mut base, torque, &per_torque);
            BaseTorque { torque, saturated: command.abs() > limit }
        });
        let per_wheel = equation.solve_with_joints([T::ZERO; 3], wheel);
        let spin = if per_wheel[0] == T::ZERO { T::ZERO } else { (desired - base[0]) / per_wheel[0] };
        add_scaled(&mut base, spin, &per_wheel);

        let rows = matrix_rows(self.mass_matrix, 3 + joints).skip(3).zip(bias.joints);
        for (torque, (row, bias)) in torques.iter_mut().zip(rows) {
            let of_joints = decelerations().zip(wheel()).map(|(deceleration, wheel)| deceleration + wheel * spin);
            *torque = *bias + dot(row, base.into_iter().chain(of_joints));
        }
        Ok(())
    }

    fn base_torque(&self) -> Option<BaseTorque<T>> {
        self.base_torque
    }
}
