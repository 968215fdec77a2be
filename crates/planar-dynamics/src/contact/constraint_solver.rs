//! Motion with holds: the constraint forces, and what rounding opened closed again.

use super::delassus_matrix::{DelassusMatrix, workspace_length};
use super::{Contact, ContactPartner, LoopConstraint};
use crate::body::Body;
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::{Coordinates, CoordinatesMut, State, StateVector, StateVectorMut, split, split_mut, vector_length};
use crate::validate::length;

/// The most corrections of positions after a step; one is enough but where a step was much too long.
const MOST_CORRECTIONS: usize = 4;

/// A robot, the bodies beside it and what the end effectors hold.
#[derive(Clone, Copy)]
pub struct ConstraintSolver<'a, T> {
    /// The robot.
    pub model: &'a dyn Model<T>,
    /// The bodies beside it, for their masses and inertias: where they are is in the integrated vector.
    pub bodies: &'a [Body<T>],
    /// What is held.
    pub constraints: &'a [LoopConstraint<T>],
}

/// Working space of a [`ConstraintSolver`]; any values.
#[derive(Debug)]
pub struct ConstraintWorkspace<'a, T> {
    /// As many as closures.
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

impl<T: Real> ConstraintSolver<'_, T> {
    /// Number of constraints: 3 for each rigid hold, 2 for each pin.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.constraints.iter().map(|constraint| if constraint.yaw.is_some() { 3 } else { 2 }).sum()
    }

    /// Length of [`ConstraintWorkspace::numbers`].
    #[must_use]
    pub fn workspace_length(&self) -> usize {
        workspace_length(self.model.joints(), self.model.arms(), self.bodies.len(), self.rows())
    }

    /// Adds to `rate`, the derivative of the integrated vector `x` without holds, what the constraint forces do:
    /// `W λ = −(A v̇ + Ȧ v)`, `v̇ += M⁻¹ Aᵀ λ`, so that no hold opens. They do no work and change no momentum.
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::Singular`] where holds depend on each other; what the model says.
    pub fn constrain(&self, x: &[T], rate: &mut [T], workspace: &mut ConstraintWorkspace<'_, T>) -> Result<(), Error> {
        self.find_contacts(x, workspace)?;
        let ConstraintWorkspace { contacts, numbers, forces, jacobian, end_effectors } = workspace;
        let (state, _, twists) = self.parts(x)?;
        let mut rows =
            DelassusMatrix::new(self.model, &state.base_pose, state.joint_angles, self.bodies, contacts, numbers)?;
        let StateVectorMut { rates: accelerations, .. } = split_mut(rate)?;
        let CoordinatesMut { base, joints, bodies } = CoordinatesMut::new(accelerations, self.model.joints())?;
        let free = State { base_twist: *base, joint_rates: joints, ..state };
        self.model.end_effector_twists(&free, rows.end_effectors)?;
        self.model.end_effector_jacobian(&state.base_pose, state.joint_angles, jacobian)?;
        add_centripetal(&state, jacobian, rows.end_effectors);
        self.model.end_effector_twists(&state, end_effectors)?;
        for (force, row) in forces.iter_mut().zip(rows.rows()) {
            let spin = match row.other {
                ContactPartner::Body(i) => twists.get(i),
                ContactPartner::EndEffector(arm) => end_effectors.get(arm),
            };
            let omega = spin.map_or(T::ZERO, |[omega, ..]| *omega);
            *force = -(row.velocity_of(rows.end_effectors, bodies) + omega * omega * row.reach);
        }
        rows.solve(forces)?;
        rows.add_responses(forces, base, joints, bodies.as_flattened_mut());
        Ok(())
    }

    /// Closes what rounding and the step opened: positions by Newton's method with the least change that the masses
    /// allow, `W μ = −g`, `δq = M⁻¹ Aᵀ μ`, then the velocities, `W μ = −A v`, `δv = M⁻¹ Aᵀ μ`. Both are what internal
    /// impulses do, so that momentum stays.
    ///
    /// # Errors
    /// As [`ConstraintSolver::constrain`].
    pub fn restore(&self, x: &mut [T], workspace: &mut ConstraintWorkspace<'_, T>) -> Result<(), Error> {
        let mut rounds = 0;
        loop {
            let open = self.find_contacts(x, workspace)?;
            let ConstraintWorkspace { contacts, numbers, forces, .. } = &mut *workspace;
            let (state, _, twists) = self.parts(x)?;
            let mut rows =
                DelassusMatrix::new(self.model, &state.base_pose, state.joint_angles, self.bodies, contacts, numbers)?;
            let size = state.base_pose.iter().fold(T::ONE, |sum, value| sum + value.abs());
            let closed = open <= T::EPSILON * T::constant(16.0) * size || rounds == MOST_CORRECTIONS;
            if closed {
                self.model.end_effector_twists(&state, rows.end_effectors)?;
                for (force, row) in forces.iter_mut().zip(rows.rows()) {
                    *force = -row.velocity_of(rows.end_effectors, twists);
                }
            }
            rows.solve(forces)?;
            let StateVectorMut { positions, rates, .. } = split_mut(x)?;
            let half = if closed { rates } else { positions };
            let CoordinatesMut { base, joints, bodies } = CoordinatesMut::new(half, self.model.joints())?;
            rows.add_responses(forces, base, joints, bodies.as_flattened_mut());
            if closed {
                return Ok(());
            }
            rounds += 1;
        }
    }

    /// By how much the holds are open: the largest error of a yaw (rad) or a coordinate (m), and of their rates.
    ///
    /// # Errors
    /// [`Error::Length`]; what the model says.
    pub fn errors(&self, x: &[T], workspace: &mut ConstraintWorkspace<'_, T>) -> Result<[T; 2], Error> {
        let open = self.find_contacts(x, workspace)?;
        let (state, _, twists) = self.parts(x)?;
        self.model.end_effector_twists(&state, workspace.end_effectors)?;
        let rows = workspace.contacts.iter().flat_map(Contact::rows);
        let rates = rows.map(|row| row.velocity_of(workspace.end_effectors, twists).abs());
        Ok([open, rates.fold(T::ZERO, largest)])
    }

    /// The holds as contacts at `x`, with minus what they are open by as forces; returns the largest size of that.
    fn find_contacts(&self, x: &[T], workspace: &mut ConstraintWorkspace<'_, T>) -> Result<T, Error> {
        length("contacts", self.constraints.len(), workspace.contacts.len())?;
        length("constraint forces", self.rows(), workspace.forces.len())?;
        let (state, poses, _) = self.parts(x)?;
        self.model.end_effector_poses(&state.base_pose, state.joint_angles, workspace.end_effectors)?;
        let mut forces = workspace.forces.iter_mut();
        let mut open = T::ZERO;
        for (place, constraint) in workspace.contacts.iter_mut().zip(self.constraints) {
            let held = match constraint.other {
                ContactPartner::Body(i) => poses.get(i),
                ContactPartner::EndEffector(arm) => workspace.end_effectors.get(arm),
            };
            let count = workspace.end_effectors.len();
            let end_effector = workspace.end_effectors.get(constraint.arm).ok_or(Error::Index {
                what: "arm that holds",
                index: constraint.arm,
                count,
            })?;
            let held = held.ok_or(constraint.other.missing(count, poses.len()))?;
            *place = constraint.contact(held);
            // the errors first: where they end, no force is taken
            for (error, force) in constraint.errors(end_effector, held).zip(&mut forces) {
                *force = -error;
                open = largest(open, error.abs());
            }
        }
        Ok(open)
    }

    /// The robot's state, and poses and twists of the bodies.
    #[allow(clippy::type_complexity, reason = "three views of one vector")]
    fn parts<'x>(&self, x: &'x [T]) -> Result<(State<'x, T>, &'x [[T; 3]], &'x [[T; 3]]), Error> {
        let joints = self.model.joints();
        length("state vector", vector_length(joints) + 6 * self.bodies.len(), x.len())?;
        let StateVector { positions, rates, .. } = split(x)?;
        let bodies = |half| Coordinates::new(half, joints).map(|parts| parts.bodies);
        Ok((State::from_vector(x, joints)?, bodies(positions)?, bodies(rates)?))
    }
}

/// Adds `J̇ v` to the accelerations of the end effectors: `−Σ ω² d` over the segments d from the base COM to an end
/// effector, each turning with the sum ω of the rates before it. The columns of J are the lever arms from which the
/// segments follow.
fn add_centripetal<T: Real>(state: &State<'_, T>, jacobian: &[T], end_effectors: &mut [[T; 3]]) {
    let width = 3 + state.joint_rates.len();
    let [base_rate, ..] = state.base_twist;
    for ([_, ax, ay], rows) in end_effectors.iter_mut().zip(jacobian.chunks_exact((3 * width).max(1))) {
        let entry = |row: usize, column: usize| rows.get(row * width + column).copied().unwrap_or(T::ZERO);
        // from the axis of a column to the end effector
        let lever = |column: usize| [entry(2, column), -entry(1, column)];
        let mut omega = base_rate;
        let mut last = lever(0);
        let mut add = |omega: T, from: [T; 2], to: [T; 2]| {
            *ax -= omega * omega * (from[0] - to[0]);
            *ay -= omega * omega * (from[1] - to[1]);
        };
        for (joint, rate) in state.joint_rates.iter().enumerate() {
            if entry(0, 3 + joint) == T::ZERO {
                continue; // of another arm
            }
            let next = lever(3 + joint);
            add(omega, last, next);
            omega += *rate;
            last = next;
        }
        add(omega, last, [T::ZERO; 2]);
    }
}

fn largest<T: Real>(a: T, b: T) -> T {
    if b > a { b } else { a }
}
