//! The impact of any mixture of contacts.

use super::complementarity::solve_contacts;
use super::delassus_matrix::DelassusMatrix;
use crate::body::Body;
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::{copy, dot};
use crate::scalar::Real;
use crate::state::State;
use crate::validate::{finite_state, length};

/// Where the results of an impact go.
#[derive(Debug)]
pub struct ImpactOutput<'a, T> {
    /// rad/s.
    pub joint_rates: &'a mut [T],
    /// [ω, vx, vy] of each body's COM.
    pub body_twists: &'a mut [[T; 3]],
    /// [n, fx, fy] on the robot at each contact's end effector, inertial axes, N m s, N s.
    pub impulses: &'a mut [[T; 3]],
}

/// All contacts of an instant at once. Returns the base twist after it.
///
/// Poisson's law, after Glocker & Pfeiffer (*Multiple impacts with friction in rigid multibody systems*, 1995), without
/// friction: in the compression all rigid and pinned contacts close and the bounces push, p ≥ 0, until none approaches
/// any more; in the restitution each bounce gives back at least its restitution times that impulse, and the others stay
/// closed. With u = A v before, u⁺ = u + W p after:
///
/// | rows | compression | restitution, further impulse p₂ |
/// |---|---|---|
/// | rigid, pinned | u⁺ = 0 | u⁺ = 0 |
/// | bounces | p ≥ 0, u⁺ ≥ 0, p u⁺ = 0 | p₂ ≥ e p, u⁺ ≥ 0, (p₂ − e p) u⁺ = 0 |
///
/// Momentum of robot and bodies together is conserved to rounding. Energy never grows, whatever the restitutions: p₂
/// minimises the energy `u·p₂ + ½ p₂ᵀ W p₂` gained over all p₂ ≥ e p, of which the compression's own p, which gives
/// back just what that took, is one. A single bounce is Newton's law too: u⁺ = −e u. A bounce that separates takes no
/// impulse.
///
/// # Errors
/// [`Error::Length`], [`Error::NotFinite`]; [`Error::Singular`] where contacts depend on each other, as two rigid ones
/// on arms that have too few joints for a loop.
pub fn impact<T: Real>(
    model: &dyn Model<T>,
    state: &State<'_, T>,
    bodies: &[Body<T>],
    mut rows: DelassusMatrix<'_, T>,
    after: &mut ImpactOutput<'_, T>,
) -> Result<[T; 3], Error> {
    finite_state(state)?;
    length("joint_rates", model.joints(), state.joint_rates.len())?;
    length("joint_rates_after", model.joints(), after.joint_rates.len())?;
    length("body_twists_after", bodies.len(), after.body_twists.len())?;
    length("impulses", rows.contacts().len(), after.impulses.len())?;
    copy(state.joint_rates, after.joint_rates);
    for (twist, body) in after.body_twists.iter_mut().zip(bodies) {
        *twist = body.twist;
    }
    let [before, compression, total, shifted, given] = core::mem::take(&mut rows.vectors);
    model.end_effector_twists(state, rows.end_effectors)?;
    for (velocity, row) in before.iter_mut().zip(rows.rows()) {
        *velocity = row.velocity_of(rows.end_effectors, after.body_twists);
    }
    solve_contacts(rows.matrix, before, rows.bilateral, rows.factors, compression)?;
    for ((given, impulse), row) in given.iter_mut().zip(compression.iter()).zip(rows.rows()) {
        *given = *impulse + row.restitution.map_or(T::ZERO, |e| e * *impulse);
    }
    let products = rows.matrix.chunks_exact(before.len().max(1));
    for ((shifted, before), row) in shifted.iter_mut().zip(before.iter()).zip(products) {
        *shifted = *before + dot(row, &*given);
    }
    solve_contacts(rows.matrix, shifted, rows.bilateral, rows.factors, total)?;
    for (total, given) in total.iter_mut().zip(given.iter()) {
        *total += *given;
    }
    let mut base_twist = state.base_twist;
    rows.add_responses(total, &mut base_twist, after.joint_rates, after.body_twists.as_flattened_mut());
    rows.wrenches_into(total, after.impulses);
    Ok(base_twist)
}
