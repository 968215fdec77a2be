//! The rows of all contacts together: what unit impulses along them do.

use super::complementarity::solve_rows;
use super::constraint_row::{ConstraintRow, Set};
use super::{Contact, ContactPartner};
use crate::body::Body;
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::{Forces, State};
use crate::validate::{finite, length};

/// The most rows that are solved together: a bit each.
const MOST_ROWS: usize = 64;

/// Numbers of working space for [`DelassusMatrix::new`].
#[must_use]
pub const fn workspace_length(joints: usize, arms: usize, bodies: usize, rows: usize) -> usize {
    rows * (3 + joints + 3 * bodies + 2 * rows + 5) + 6 * arms + joints
}

/// W, the inverse inertia that the contacts see (the Delassus matrix): `W = A M⁻¹ Aᵀ` with the rows A and the mass
/// matrix M of robot and bodies together; and `M⁻¹ Aᵀ`, the change of velocities per unit impulse along each row.
#[derive(Debug)]
pub struct DelassusMatrix<'a, T> {
    contacts: &'a [Contact<T>],
    /// W, rows × rows.
    pub(super) matrix: &'a mut [T],
    /// `M⁻¹ Aᵀ`, one column after the other: base twist, joint rates, bodies' twists.
    pub(super) responses: &'a mut [T],
    /// Working space of a solution: rows².
    pub(super) factors: &'a mut [T],
    /// Working space, five vectors of rows.
    pub(super) vectors: [&'a mut [T]; 5],
    pub(super) end_effectors: &'a mut [[T; 3]],
    wrenches: &'a mut [[T; 3]],
    still: &'a mut [T],
    /// Rows that pull as well as they push.
    pub(super) bilateral: Set,
}

impl<'a, T: Real> DelassusMatrix<'a, T> {
    /// How many rows contacts have.
    #[must_use]
    pub fn count(contacts: &[Contact<T>]) -> usize {
        contacts.iter().map(|contact| contact.rows().count()).sum()
    }

    /// At a configuration; `workspace` has [`workspace_length`] numbers.
    ///
    /// # Errors
    /// [`Error::Length`] for another workspace or more than 64 rows; [`Error::Index`] for arms and bodies that there
    /// are not; [`Error::NotFinite`]; what the model says.
    pub fn new(
        model: &dyn Model<T>,
        base_pose: &[T; 3],
        joint_angles: &[T],
        bodies: &[Body<T>],
        contacts: &'a [Contact<T>],
        workspace: &'a mut [T],
    ) -> Result<Self, Error> {
        let (joints, arms) = (model.joints(), model.arms());
        let count = Self::count(contacts);
        check(contacts, arms, bodies.len())?;
        length("contact workspace", workspace_length(joints, arms, bodies.len(), count), workspace.len())?;
        if count > MOST_ROWS {
            return Err(Error::Length { quantity: "contact rows", expected: MOST_ROWS, found: count });
        }
        let mut rest = workspace;
        let mut part = |length: usize| {
            // the length of the whole was checked
            let (part, others) = core::mem::take(&mut rest).split_at_mut_checked(length).unwrap_or_default();
            rest = others;
            part
        };
        let (matrix, factors) = (part(count * count), part(count * count));
        let responses = part(count * (3 + joints + 3 * bodies.len()));
        let vectors = [part(count), part(count), part(count), part(count), part(count)];
        let (end_effectors, _) = part(3 * arms).as_chunks_mut::<3>();
        let (wrenches, _) = part(3 * arms).as_chunks_mut::<3>();
        let still = part(joints);
        still.fill(T::ZERO);
        let kinds = contacts.iter().flat_map(Contact::rows).enumerate();
        let bilateral = kinds.fold(0, |set, (i, row)| set | Set::from(row.restitution.is_none()) << i);
        let mut rows =
            Self { contacts, matrix, responses, factors, vectors, end_effectors, wrenches, still, bilateral };
        rows.respond(model, base_pose, joint_angles, bodies)?;
        Ok(rows)
    }

    /// All rows, in the contacts' order.
    pub(super) fn rows(&self) -> impl Iterator<Item = ConstraintRow<T>> + use<'a, T> {
        self.contacts.iter().flat_map(Contact::rows)
    }

    /// One column of `M⁻¹ Aᵀ` after the other, and with it a row of W.
    fn respond(
        &mut self,
        model: &dyn Model<T>,
        base_pose: &[T; 3],
        joint_angles: &[T],
        bodies: &[Body<T>],
    ) -> Result<(), Error> {
        let rows = self.rows();
        let Self { contacts, matrix, responses, end_effectors, wrenches, still, .. } = self;
        let joints = still.len();
        let at_rest = State { base_pose: *base_pose, joint_angles, base_twist: [T::ZERO; 3], joint_rates: still };
        let size = 3 + joints + 3 * bodies.len();
        let products = matrix.chunks_exact_mut(Self::count(contacts).max(1));
        for (row, (response, products)) in rows.zip(responses.chunks_exact_mut(size.max(1)).zip(products)) {
            wrenches.fill([T::ZERO; 3]);
            add_at(wrenches, row.arm, &row.wrench, T::ONE);
            if let ContactPartner::EndEffector(arm) = row.other {
                add_at(wrenches, arm, &row.at_other, -T::ONE);
            }
            let Some((base, rest)) = response.split_first_chunk_mut::<3>() else { continue };
            let Some((joint_rates, of_bodies)) = rest.split_at_mut_checked(joints) else { continue };
            let forces = Forces { end_effector_wrenches: Some(wrenches), ..Forces::torques(still) };
            let base_twist = model.forward_dynamics(&at_rest, &forces, joint_rates)?;
            *base = base_twist;
            model.end_effector_twists(&State { base_twist, joint_rates, ..at_rest }, end_effectors)?;
            of_bodies.fill(T::ZERO);
            let (twists, _) = of_bodies.as_chunks_mut::<3>();
            if let ContactPartner::Body(i) = row.other
                && let (Some(body), Some(twist)) = (bodies.get(i), twists.get_mut(i))
            {
                let [n, fx, fy] = row.at_other;
                *twist = [-(n / body.inertia), -(fx / body.mass), -(fy / body.mass)];
            }
            for (product, other) in products.iter_mut().zip(contacts.iter().flat_map(Contact::rows)) {
                *product = other.velocity_of(end_effectors, twists);
            }
        }
        finite("inverse inertia at the contacts", matrix)
    }

    /// The contacts that the rows are of.
    pub(super) fn contacts(&self) -> &'a [Contact<T>] {
        self.contacts
    }

    /// Solves `W p = b` for rows that all pull and push; b becomes p.
    pub(super) fn solve(&mut self, b: &mut [T]) -> Result<(), Error> {
        solve_rows(self.matrix, self.bilateral, self.factors, b)
    }

    /// `v += Σ p M⁻¹ Aᵀ`, for velocities or accelerations.
    pub(super) fn add_responses(&self, impulses: &[T], base: &mut [T; 3], joints: &mut [T], bodies: &mut [T]) {
        let size = base.len() + joints.len() + bodies.len();
        for (impulse, response) in impulses.iter().zip(self.responses.chunks_exact(size.max(1))) {
            let velocities = base.iter_mut().chain(&mut *joints).chain(&mut *bodies);
            for (velocity, part) in velocities.zip(response) {
                *velocity += *impulse * *part;
            }
        }
    }

    /// [n, fx, fy] on the robot at each contact's end effector.
    pub(super) fn wrenches_into(&self, impulses: &[T], wrenches: &mut [[T; 3]]) {
        let mut impulses = impulses.iter();
        for (sum, contact) in wrenches.iter_mut().zip(self.contacts) {
            *sum = [T::ZERO; 3];
            for (row, impulse) in contact.rows().zip(&mut impulses) {
                for (sum, part) in sum.iter_mut().zip(row.wrench) {
                    *sum += *impulse * part;
                }
            }
        }
    }
}

/// Contacts only of what there is, with finite numbers.
fn check<T: Real>(contacts: &[Contact<T>], arms: usize, bodies: usize) -> Result<(), Error> {
    for contact in contacts {
        finite("contact offset", &contact.offset)?;
        if let Some(([x, y], restitution)) = contact.law.bounce() {
            finite("contact normal and restitution", &[x, y, restitution])?;
        }
        let (what, index, count) = match contact.other {
            _ if contact.arm >= arms => ("arm of a contact", contact.arm, arms),
            ContactPartner::EndEffector(arm) if arm >= arms => ("arm that is touched", arm, arms),
            ContactPartner::Body(body) if body >= bodies => ("body that is touched", body, bodies),
            _ => continue,
        };
        return Err(Error::Index { what, index, count });
    }
    Ok(())
}

fn add_at<T: Real>(wrenches: &mut [[T; 3]], arm: usize, wrench: &[T; 3], sign: T) {
    for (sum, part) in wrenches.get_mut(arm).into_iter().flatten().zip(wrench) {
        *sum += sign * *part;
    }
}
