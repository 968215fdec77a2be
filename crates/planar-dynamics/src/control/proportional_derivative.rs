//! Proportional-derivative control, eq. (18): joint torques from the errors of joint angles and rates.

use super::{Control, follow};
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::State;
use crate::trajectory::Trajectory;
use crate::validate::length;

/// Eq. (18), PD control: `τ = K_p (θ_d − θ) + K_v (θ̇_d − θ̇)`, gains per joint.
#[derive(Clone, Copy, Debug)]
pub struct ProportionalDerivative<'a, T, R> {
    /// Desired angles and rates.
    pub trajectory: R,
    /// Diagonal of `K_p`, N m/rad.
    pub proportional_gain: &'a [T],
    /// Diagonal of `K_v`, N m s/rad.
    pub derivative_gain: &'a [T],
}

impl<T: Real, M: Model<T> + ?Sized, R: Trajectory<T>> Control<T, M> for ProportionalDerivative<'_, T, R> {
    #[cfg_attr(target_arch = "arm", inline)]
    #[cfg_attr(not(target_arch = "arm"), inline(always))]
    #[allow(clippy::inline_always, reason = "a call would pass all numbers through memory")]
    fn joint_torques(&mut self, time: T, _: &M, state: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        let expected = torques.len();
        length("proportional_gain", expected, self.proportional_gain.len())?;
        length("derivative_gain", expected, self.derivative_gain.len())?;
        let gains = self.proportional_gain.iter().zip(self.derivative_gain);
        let joints = torques.iter_mut().zip(state.joint_angles.iter().zip(state.joint_rates).zip(gains));
        follow(&self.trajectory, time, joints, |(torque, ((angle, rate), (kp, kv))), desired| {
            // two signs of eq. (18) exchanged: without a desired rate there is nothing to subtract
            *torque = *kp * (desired.angle - *angle) - *kv * (*rate - desired.rate);
        })
    }
}
