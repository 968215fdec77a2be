//! The motion of a robot whose joint accelerations are prescribed: kinematics and eq. (17), without forces.

use crate::control::desired;
use crate::dynamics::Model;
use crate::error::Error;
use crate::momentum_equation::MomentumEquation;
use crate::scalar::Real;
use crate::trajectory::Trajectory;
use crate::validate::length;

/// d/dt of base pose, joint angles and joint rates of a robot that no external forces act on and whose joints have the
/// accelerations of a trajectory, whatever torques that takes. The base twist follows from the momentum by eq. (17),
///
/// `I_b t_b = [l − c_o × p; p] − I_bm θ̇`.
///
/// Vectors have 3 + 2 joints entries.
#[derive(Debug)]
pub struct PrescribedJoints<'a, T, R> {
    /// [l, px, py], about the inertial origin; N m s, N s.
    pub momentum: [T; 3],
    /// Accelerations.
    pub trajectory: R,
    /// (3 + joints)²; working space.
    pub mass_matrix: &'a mut [T],
}

impl<T: Real, R: Trajectory<T>> PrescribedJoints<'_, T, R> {
    /// The derivative of `x` into `rate`.
    ///
    /// # Errors
    /// [`Error::Length`], and [`Error::Singular`] for a singular `I_b`.
    pub fn derivative(&mut self, model: &dyn Model<T>, time: T, x: &[T], rate: &mut [T]) -> Result<(), Error> {
        let joints = model.joints();
        let wrong = Error::Length { quantity: "state vector", expected: 3 + 2 * joints, found: x.len() };
        length("state vector", 3 + 2 * joints, rate.len())?;
        let (pose, moved) = x.split_first_chunk().ok_or(wrong)?;
        let (angles, rates) = moved.split_at_checked(joints).ok_or(wrong)?;
        length("joint_rates", joints, rates.len())?;
        let twist = self.base_twist(model, pose, angles, rates)?;
        let accelerations = (0..joints).map(|joint| Ok(desired(&self.trajectory, joint, time, joints)?.acceleration));
        let all = twist.into_iter().chain(rates.iter().copied()).map(Ok).chain(accelerations);
        rate.iter_mut().zip(all).try_for_each(|(place, value): (&mut T, Result<T, Error>)| {
            *place = value?;
            Ok(())
        })
    }

    /// The base twist at a pose, joint angles and joint rates.
    ///
    /// # Errors
    /// As [`Self::derivative`].
    pub fn base_twist(
        &mut self,
        model: &dyn Model<T>,
        base_pose: &[T; 3],
        joint_angles: &[T],
        joint_rates: &[T],
    ) -> Result<[T; 3], Error> {
        model.mass_matrix(base_pose, joint_angles, self.mass_matrix)?;
        let equation = MomentumEquation::new(self.mass_matrix, model.joints())?;
        Ok(equation.base_twist(self.momentum, base_pose, joint_rates))
    }
}
