//! The motion of a robot whose joints move as prescribed: eq. (17), without forces.

use crate::dynamics::Model;
use crate::error::Error;
use crate::momentum_equation::MomentumEquation;
use crate::scalar::Real;
use crate::validate::length;

/// A robot that no external forces act on and whose joints move in a given way, whatever torques that takes: its
/// center of mass moves uniformly, and its base turns as eq. (17) says,
///
/// `I_b t_b = [l − c_o × p; p] − I_bm θ̇`.
#[derive(Debug)]
pub struct PrescribedJoints<'a, T> {
    /// (3 + joints)²; working space.
    pub mass_matrix: &'a mut [T],
}

impl<T: Real> PrescribedJoints<'_, T> {
    /// The base twist at a pose, joint angles and joint rates, for the momentum [l, px, py] about the inertial origin
    /// (N m s, N s).
    ///
    /// # Errors
    /// [`Error::Length`], and [`Error::Singular`] for a singular `I_b`.
    pub fn base_twist<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        momentum: [T; 3],
        (base_pose, joint_angles, joint_rates): (&[T; 3], &[T], &[T]),
    ) -> Result<[T; 3], Error> {
        length("joint_rates", model.joints(), joint_rates.len())?;
        model.mass_matrix(base_pose, joint_angles, self.mass_matrix)?;
        let equation = MomentumEquation::new(self.mass_matrix, model.joints())?;
        Ok(equation.base_twist(momentum, base_pose, joint_rates))
    }

    /// Mass and first moment about the base's COM, [m, m rx, m ry] in inertial axes (kg, kg m): they are in the base's
    /// rows of the mass matrix.
    ///
    /// # Errors
    /// [`Error::Length`].
    pub fn first_moment<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        base_pose: &[T; 3],
        joint_angles: &[T],
    ) -> Result<[T; 3], Error> {
        model.mass_matrix(base_pose, joint_angles, self.mass_matrix)?;
        let size = 3 + model.joints();
        let at = |row: usize, column: usize| self.mass_matrix.get(row * size + column).copied();
        let entries = [at(1, 1), at(2, 0), at(1, 0).map(|x| -x)];
        let wrong = Error::Length { quantity: "mass_matrix", expected: size * size, found: self.mass_matrix.len() };
        match entries {
            [Some(mass), Some(x), Some(y)] => Ok([mass, x, y]),
            _ => Err(wrong),
        }
    }
}
