//! `J̇ v` of an end effector from its Jacobian and the robot's velocities.

use crate::scalar::Real;
use crate::state::State;

/// The linear part [ax, ay] of `J̇ v = −Σ (ω_k² − ω_{k−1}²) r_k`, m/s², from the three rows of the end effector's
/// `[J_be J_me]`; its angular part is zero.
///
/// `ω_k` is the absolute rate of the body beyond axis k and `r_k` points from the axis to the end effector; axis 0 is at
/// the base COM. A column of the Jacobian is `[1, −r_ky, r_kx]`, or zero for a joint of another arm.
pub(crate) fn jacobian_rate_times_velocity<T: Real>(jacobian: &[T], state: &State<'_, T>) -> [T; 2] {
    let width = 3 + state.joint_rates.len();
    let row = |i: usize| jacobian.iter().skip(i * width).take(width);
    let velocities = state.base_twist.iter().chain(state.joint_rates);
    let mut omega = T::ZERO;
    let [mut ax, mut ay] = [T::ZERO; 2];
    for (((angular, x), y), velocity) in row(0).zip(row(1)).zip(row(2)).zip(velocities) {
        let next = omega + *angular * *velocity;
        let change = next * next - omega * omega;
        ax -= change * *y;
        ay += change * *x;
        omega = next;
    }
    [ax, ay]
}
