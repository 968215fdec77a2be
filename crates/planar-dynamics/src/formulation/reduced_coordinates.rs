//! The equation of motion in reduced coordinates: the base twist from the momentum by eq. (17).

use crate::control::Control;
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::{copy, dot, matrix_rows, power, solve};
use crate::momentum_equation::MomentumEquation;
use crate::scalar::Real;
use crate::state::{ActuatorWork, State, StateVector, coordinates_mut, split_mut, vector_length};
use crate::validate::length;

/// d/dt of joint angles, joint rates and base pose; every evaluation computes the base twist from eq. (17),
///
/// `I_b t_b = [l − c_o × p; p] − I_bm θ̇`,
///
/// with the initial momentum and the impulse of a base torque since, so that the momentum is conserved to rounding by
/// any integrator. The joint accelerations follow from eq. (2), `I θ̈ + c = τ − I_bmᵀ I_b⁻¹ F_b`, where the generalized
/// bias c at that twist includes the effects of the momentum.
///
/// Vectors are those of [`vector_length`], of a robot alone; the entries of the base twist are not integrated but
/// written by [`recover`](Self::recover) after every step. All slices are working space.
#[derive(Debug)]
pub struct ReducedCoordinates<'a, T> {
    /// The initial [l, px, py], about the inertial origin; N m s, N s.
    pub momentum: [T; 3],
    /// (3 + joints)².
    pub mass_matrix: &'a mut [T],
    /// joints².
    pub generalized_inertia: &'a mut [T],
    /// joints.
    pub generalized_bias: &'a mut [T],
    /// 3 arms × joints.
    pub generalized_jacobian: &'a mut [T],
}

impl<T: Real> ReducedCoordinates<'_, T> {
    /// As [`derivative`](super::derivative) in full coordinates; `torques` (joints) holds the torques at this time
    /// afterwards.
    ///
    /// # Errors
    /// [`Error::Length`] unless `x` and `rate` have [`vector_length`] entries, and those of the model and the law.
    pub fn derivative<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        control: &mut (impl Control<T, M> + ?Sized),
        time: T,
        x: &[T],
        rate: &mut [T],
        torques: &mut [T],
    ) -> Result<(), Error> {
        let Self { momentum, mass_matrix, generalized_inertia, generalized_bias, generalized_jacobian } = self;
        let (state, equation) = recovered(model, momentum, mass_matrix, x)?;
        control.joint_torques(time, model, &state, torques)?;
        let base_torque = control.base_torque().map_or(T::ZERO, |base| base.torque);
        model.reduced_dynamics(&state, generalized_inertia, generalized_bias, generalized_jacobian)?;

        length("state vector", x.len(), rate.len())?;
        let StateVector { positions: velocities, rates: accelerations, work } = split_mut(rate)?;
        let velocities = coordinates_mut(velocities, torques.len())?;
        *velocities.base = state.base_twist;
        copy(state.joint_rates, velocities.joints);
        let accelerations = coordinates_mut(accelerations, torques.len())?;
        *accelerations.base = [T::ZERO; 3];
        let by_base = equation.solve([base_torque, T::ZERO, T::ZERO]);
        let rows = matrix_rows(mass_matrix, 3 + torques.len()).skip(3);
        let known = torques.iter().zip(generalized_bias.iter());
        for ((acceleration, row), (torque, bias)) in accelerations.joints.iter_mut().zip(rows).zip(known) {
            *acceleration = *torque - *bias - dot(row, by_base);
        }
        solve("the generalized inertia I", generalized_inertia, accelerations.joints)?;
        let [omega, ..] = state.base_twist;
        *work = [power(torques, state.joint_rates), base_torque * omega, base_torque];
        Ok(())
    }

    /// Writes the base twist into an integrated vector.
    ///
    /// # Errors
    /// As [`Self::derivative`].
    pub fn recover<M: Model<T> + ?Sized>(&mut self, model: &M, x: &mut [T]) -> Result<(), Error> {
        let base_twist = recovered(model, &self.momentum, self.mass_matrix, x)?.0.base_twist;
        *coordinates_mut(split_mut(x)?.rates, model.joints())?.base = base_twist;
        Ok(())
    }
}

/// The state with the base twist that follows from the momentum, and the equation it follows from.
fn recovered<'x, 'm, T: Real, M: Model<T> + ?Sized>(
    model: &M,
    [l, px, py]: &[T; 3],
    mass_matrix: &'m mut [T],
    x: &'x [T],
) -> Result<(State<'x, T>, MomentumEquation<'m, T>), Error> {
    let joints = model.joints();
    length("state vector", vector_length(joints), x.len())?;
    let state = State::from_vector(x, joints)?;
    let impulse = ActuatorWork::from_vector(x)?.base_impulse;
    model.mass_matrix(&state.base_pose, state.joint_angles, mass_matrix)?;
    let equation = MomentumEquation::new(mass_matrix, joints)?;
    let base_twist = equation.base_twist([*l + impulse, *px, *py], &state.base_pose, state.joint_rates);
    Ok((State { base_twist, ..state }, equation))
}
