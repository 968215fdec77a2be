//! The Delassus matrix of all contacts: the change of the rows' velocities per unit impulse along each row.

use super::complementarity::solve_rows;
use super::constraint_row::{ConstraintRow, RowSet};
use super::{Contact, ContactPartner, entry, entry_mut};
use crate::body::Body;
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::{add_scaled, matrix_rows, matrix_rows_mut};
use crate::scalar::Real;
use crate::state::{Coordinates, Forces, State, coordinates_mut};
use crate::validate::finite;

/// The number of bits of a [`RowSet`].
const MAXIMUM_ROWS: usize = 64;

/// Length of the working space of [`DelassusMatrix::new`].
#[must_use]
pub const fn workspace_length(joints: usize, arms: usize, bodies: usize, rows: usize) -> usize {
    rows * (3 + joints + 3 * bodies + 2 * rows + 5) + 6 * arms + joints
}

/// W, the inverse inertia at the contacts (the Delassus matrix): `W = A M⁻¹ Aᵀ` with the rows A and the mass matrix M of
/// the robot and the bodies together; and `M⁻¹ Aᵀ`, the change of velocities per unit impulse along each row.
#[derive(Debug)]
pub struct DelassusMatrix<'a, T> {
    pub(super) contacts: &'a [Contact<T>],
    /// W, rows × rows.
    pub(super) matrix: &'a mut [T],
    /// `M⁻¹ Aᵀ` by columns: base twist, joint rates, bodies' twists.
    responses: &'a mut [T],
    /// Working space of a solution: rows².
    pub(super) factors: &'a mut [T],
    /// Working space, five vectors of rows.
    pub(super) vectors: [&'a mut [T]; 5],
    pub(super) end_effectors: &'a mut [[T; 3]],
    wrenches: &'a mut [[T; 3]],
    zero_rates: &'a mut [T],
    /// The bilateral rows.
    pub(super) bilateral: RowSet,
}

impl<'a, T: Real> DelassusMatrix<'a, T> {
    /// Number of rows of the contacts.
    #[must_use]
    pub fn count(contacts: &[Contact<T>]) -> usize {
        contacts.iter().map(|contact| contact.rows().count()).sum()
    }

    /// The matrix at a configuration; `workspace` has [`workspace_length`] numbers.
    ///
    /// # Errors
    /// [`Error::Length`] for another workspace, [`Error::ContactRows`] for more than 64 rows, [`Error::Index`] for arms
    /// and bodies that do not exist, [`Error::NotFinite`], and those of the model.
    pub fn new<M: Model<T> + ?Sized>(
        model: &M,
        base_pose: &[T; 3],
        joint_angles: &[T],
        bodies: &[Body<T>],
        contacts: &'a [Contact<T>],
        workspace: &'a mut [T],
    ) -> Result<Self, Error> {
        let (joints, arms, count) = (model.joints(), model.arms(), Self::count(contacts));
        if count > MAXIMUM_ROWS {
            return Err(Error::ContactRows { limit: MAXIMUM_ROWS, found: count });
        }
        for contact in contacts {
            finite("contact offset", &contact.offset)?;
            if let Some(([x, y], restitution)) = contact.law.bounce() {
                finite("contact normal and restitution", &[x, y, restitution])?;
            }
        }
        let expected = workspace_length(joints, arms, bodies.len(), count);
        let wrong = Error::Length { quantity: "contact workspace", expected, found: workspace.len() };
        let mut rest = workspace;
        let mut part = |length: usize| rest.split_off_mut(..length).ok_or(wrong);
        let zero_rates = part(joints)?;
        zero_rates.fill(T::ZERO);
        let kinds = contacts.iter().flat_map(Contact::rows).enumerate();
        let mut delassus = Self {
            contacts,
            matrix: part(count * count)?,
            responses: part(count * (3 + joints + 3 * bodies.len()))?,
            factors: part(count * count)?,
            vectors: [part(count)?, part(count)?, part(count)?, part(count)?, part(count)?],
            end_effectors: part(3 * arms)?.as_chunks_mut().0,
            wrenches: part(3 * arms)?.as_chunks_mut().0,
            zero_rates,
            bilateral: kinds.fold(0, |set, (i, row)| set | RowSet::from(row.restitution.is_none()) << i),
        };
        if !rest.is_empty() {
            return Err(wrong);
        }
        delassus.compute(model, base_pose, joint_angles, bodies)?;
        Ok(delassus)
    }

    /// All rows, in the contacts' order.
    pub(super) fn rows(&self) -> impl Iterator<Item = ConstraintRow<T>> + use<'a, T> {
        self.contacts.iter().flat_map(Contact::rows)
    }

    /// Computes each column of `M⁻¹ Aᵀ` and with it a row of W.
    fn compute<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        base_pose: &[T; 3],
        joint_angles: &[T],
        bodies: &[Body<T>],
    ) -> Result<(), Error> {
        let rows = self.rows();
        let Self { contacts, matrix, responses, end_effectors, wrenches, zero_rates, .. } = self;
        let joints = zero_rates.len();
        let at_rest = State { base_pose: *base_pose, joint_angles, base_twist: [T::ZERO; 3], joint_rates: zero_rates };
        let size = 3 + joints + 3 * bodies.len();
        let products = matrix_rows_mut(matrix, Self::count(contacts));
        for (row, (response, products)) in rows.zip(matrix_rows_mut(responses, size).zip(products)) {
            let response = coordinates_mut(response, joints)?;
            response.bodies.fill([T::ZERO; 3]);
            wrenches.fill([T::ZERO; 3]);
            add_scaled(entry_mut("arm", wrenches, row.arm)?, T::ONE, &row.wrench);
            match row.partner {
                ContactPartner::EndEffector(arm) => {
                    add_scaled(entry_mut("arm", wrenches, arm)?, -T::ONE, &row.partner_wrench);
                }
                ContactPartner::Body(i) => {
                    let (body, [n, fx, fy]) = (entry("body", bodies, i)?, row.partner_wrench);
                    *entry_mut("body", response.bodies, i)? =
                        [-(n / body.inertia), -(fx / body.mass), -(fy / body.mass)];
                }
            }
            let forces = Forces { end_effector_wrenches: Some(wrenches), ..Forces::torques(zero_rates) };
            let base_twist = model.forward_dynamics(&at_rest, &forces, response.joints)?;
            *response.base = base_twist;
            model.end_effector_twists(&State { base_twist, joint_rates: response.joints, ..at_rest }, end_effectors)?;
            for (product, other) in products.iter_mut().zip(contacts.iter().flat_map(Contact::rows)) {
                *product = other.velocity(end_effectors, response.bodies)?;
            }
        }
        finite("inverse inertia at the contacts", matrix)
    }

    /// Solves `W p = b` for bilateral rows; b becomes p.
    pub(super) fn solve(&mut self, b: &mut [T]) -> Result<(), Error> {
        solve_rows(self.matrix, self.bilateral, self.factors, b)
    }

    /// `v += Σ p M⁻¹ Aᵀ`, for velocities or accelerations.
    pub(super) fn add_responses(
        &self,
        impulses: &[T],
        Coordinates { base, joints, bodies }: Coordinates<&mut [T; 3], &mut [T], &mut [[T; 3]]>,
    ) {
        let size = 3 + joints.len() + 3 * bodies.len();
        for (impulse, response) in impulses.iter().zip(matrix_rows(self.responses, size)) {
            let velocities = base.iter_mut().chain(&mut *joints).chain(bodies.as_flattened_mut());
            for (velocity, part) in velocities.zip(response) {
                *velocity += *impulse * *part;
            }
        }
    }
}
