//! Constraint forces of closed loops from the state, and the projection of positions and velocities onto the
//! constraints.

use super::delassus_matrix::{DelassusMatrix, workspace_length};
use super::{Contact, LoopConstraint, entry};
use crate::body::Body;
use crate::dynamics::Model;
use crate::error::Error;
use crate::jacobian_rate::jacobian_rate_times_velocity;
use crate::linear::matrix_rows;
use crate::scalar::Real;
use crate::state::{State, StateVector, coordinates, coordinates_mut, split, split_mut, vector_length};
use crate::validate::length;

/// One correction is enough unless a step was much too long.
const MAXIMUM_CORRECTIONS: usize = 4;

/// A robot, free bodies and the constraints between them.
#[derive(Clone, Copy)]
pub struct ConstraintSolver<'a, T, M: ?Sized> {
    /// The robot.
    pub model: &'a M,
    /// The free bodies; their masses and inertias are used, their states are in the integrated vector.
    pub bodies: &'a [Body<T>],
    /// The constraints.
    pub constraints: &'a [LoopConstraint<T>],
}

/// Working space of a [`ConstraintSolver`]; any values.
#[derive(Debug)]
pub struct ConstraintWorkspace<'a, T> {
    /// One per constraint.
    pub contacts: &'a mut [Contact<T>],
    /// [`ConstraintSolver::workspace_length`].
    pub numbers: &'a mut [T],
    /// One per row, see [`ConstraintSolver::rows`].
    pub forces: &'a mut [T],
    /// 3 arms × (3 + joints).
    pub jacobian: &'a mut [T],
    /// One per arm.
    pub end_effectors: &'a mut [[T; 3]],
}

impl<T: Real, M: Model<T> + ?Sized> ConstraintSolver<'_, T, M> {
    /// Number of rows: 3 for each rigid constraint, 2 for each pin.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.constraints.iter().map(|constraint| constraint.law().kind().constraints()).sum()
    }

    /// Length of [`ConstraintWorkspace::numbers`].
    #[must_use]
    pub fn workspace_length(&self) -> usize {
        workspace_length(self.model.joints(), self.model.arms(), self.bodies.len(), self.rows())
    }

    /// Adds the effect of the constraint forces to `rate`, the derivative of the integrated vector `x` without
    /// constraints: `W λ = −(A v̇ + Ȧ v)`, `v̇ += M⁻¹ Aᵀ λ`. The forces do no work and conserve momentum.
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::Singular`] for constraints that depend on each other; those of the model.
    pub fn constrain(&self, x: &[T], rate: &mut [T], workspace: &mut ConstraintWorkspace<'_, T>) -> Result<(), Error> {
        self.find_contacts(x, workspace)?;
        let ConstraintWorkspace { contacts, numbers, forces, jacobian, end_effectors } = workspace;
        let (state, _, twists) = self.parts(x)?;
        let mut delassus =
            DelassusMatrix::new(self.model, &state.base_pose, state.joint_angles, self.bodies, contacts, numbers)?;
        let free = coordinates_mut(split_mut(rate)?.rates, self.model.joints())?;
        let unconstrained = State { base_twist: *free.base, joint_rates: free.joints, ..state };
        self.model.end_effector_twists(&unconstrained, delassus.end_effectors)?;
        self.model.end_effector_jacobian(&state.base_pose, state.joint_angles, jacobian)?;
        let jacobians = matrix_rows(jacobian, 3 * (3 + state.joint_rates.len()));
        for ([_, ax, ay], jacobian) in delassus.end_effectors.iter_mut().zip(jacobians) {
            let [x, y] = jacobian_rate_times_velocity(jacobian, &state);
            (*ax, *ay) = (*ax + x, *ay + y);
        }
        self.model.end_effector_twists(&state, end_effectors)?;
        for (force, row) in forces.iter_mut().zip(delassus.rows()) {
            let [omega, ..] = *row.partner.select(end_effectors, twists)?;
            *force = -(row.velocity(delassus.end_effectors, free.bodies)? + omega * omega * row.partner_distance);
        }
        delassus.solve(forces)?;
        delassus.add_responses(forces, free);
        Ok(())
    }

    /// Removes the constraint errors that rounding and the step have caused: those of positions by Newton's method with
    /// the smallest change in the metric of the masses, `W μ = −g`, `δq = M⁻¹ Aᵀ μ`, then those of velocities,
    /// `W μ = −A v`, `δv = M⁻¹ Aᵀ μ`. Both corrections are those of internal impulses and so conserve momentum.
    ///
    /// # Errors
    /// As [`ConstraintSolver::constrain`].
    pub fn project(&self, x: &mut [T], workspace: &mut ConstraintWorkspace<'_, T>) -> Result<(), Error> {
        let mut corrections = 0;
        loop {
            let error = self.find_contacts(x, workspace)?;
            let ConstraintWorkspace { contacts, numbers, forces, .. } = &mut *workspace;
            let (state, _, twists) = self.parts(x)?;
            let mut delassus =
                DelassusMatrix::new(self.model, &state.base_pose, state.joint_angles, self.bodies, contacts, numbers)?;
            let size = state.base_pose.iter().fold(T::ONE, |sum, value| sum + value.abs());
            let closed = error <= T::EPSILON * T::constant(16.0) * size || corrections == MAXIMUM_CORRECTIONS;
            if closed {
                self.model.end_effector_twists(&state, delassus.end_effectors)?;
                for (force, row) in forces.iter_mut().zip(delassus.rows()) {
                    *force = -row.velocity(delassus.end_effectors, twists)?;
                }
            }
            delassus.solve(forces)?;
            let StateVector { positions, rates, .. } = split_mut(x)?;
            let half = if closed { rates } else { positions };
            delassus.add_responses(forces, coordinates_mut(half, self.model.joints())?);
            if closed {
                return Ok(());
            }
            corrections += 1;
        }
    }

    /// The largest constraint error of a yaw (rad) or a coordinate (m), and that of their rates.
    ///
    /// # Errors
    /// [`Error::Length`]; those of the model.
    pub fn errors(&self, x: &[T], workspace: &mut ConstraintWorkspace<'_, T>) -> Result<[T; 2], Error> {
        let error = self.find_contacts(x, workspace)?;
        let (state, _, twists) = self.parts(x)?;
        self.model.end_effector_twists(&state, workspace.end_effectors)?;
        let mut rate = T::ZERO;
        for row in workspace.contacts.iter().flat_map(Contact::rows) {
            rate = rate.maximum(row.velocity(workspace.end_effectors, twists)?.abs());
        }
        Ok([error, rate])
    }

    /// Writes the constraints at `x` as contacts and their negative errors as forces; returns the largest magnitude of an
    /// error.
    fn find_contacts(&self, x: &[T], workspace: &mut ConstraintWorkspace<'_, T>) -> Result<T, Error> {
        let ConstraintWorkspace { contacts, forces, end_effectors, .. } = workspace;
        length("contacts", self.constraints.len(), contacts.len())?;
        length("constraint forces", self.rows(), forces.len())?;
        let (state, poses, _) = self.parts(x)?;
        self.model.end_effector_poses(&state.base_pose, state.joint_angles, end_effectors)?;
        let mut forces = forces.iter_mut();
        let mut largest = T::ZERO;
        for (contact, constraint) in contacts.iter_mut().zip(self.constraints) {
            let partner = constraint.partner.select(end_effectors, poses)?;
            *contact = constraint.contact(partner);
            // `zip` ends with the errors, before it takes another force
            for (error, force) in
                constraint.errors(entry("arm", end_effectors, constraint.arm)?, partner).zip(&mut forces)
            {
                *force = -error;
                largest = largest.maximum(error.abs());
            }
        }
        Ok(largest)
    }

    /// The robot's state, and the poses and twists of the bodies.
    #[allow(clippy::type_complexity, reason = "three views of one vector")]
    fn parts<'x>(&self, x: &'x [T]) -> Result<(State<'x, T>, &'x [[T; 3]], &'x [[T; 3]]), Error> {
        let joints = self.model.joints();
        length("state vector", vector_length(joints) + 6 * self.bodies.len(), x.len())?;
        let StateVector { positions, rates, .. } = split(x)?;
        let bodies = |half| coordinates(half, joints).map(|parts| parts.bodies);
        Ok((State::from_vector(x, joints)?, bodies(positions)?, bodies(rates)?))
    }
}
