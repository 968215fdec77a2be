//! Simultaneous impacts: the velocities after an instant from the velocities before it and the contacts.

use super::complementarity::solve_contacts;
use super::delassus_matrix::DelassusMatrix;
use crate::body::Body;
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::{add_scaled, copy, dot, matrix_rows};
use crate::scalar::Real;
use crate::state::{Coordinates, State};
use crate::validate::{finite_state, length};

/// The results of an impact: impulses, and velocities after it except that of the base.
#[derive(Debug)]
pub struct ImpactOutput<'a, T> {
    /// rad/s.
    pub joint_rates: &'a mut [T],
    /// [ω, vx, vy] of each body's COM.
    pub body_twists: &'a mut [[T; 3]],
    /// [n, fx, fy] on the robot at each contact's end effector, inertial axes, N m s, N s.
    pub impulses: &'a mut [[T; 3]],
}

/// The impact of all contacts at one instant; returns the base twist after it.
///
/// Poisson's law of restitution without friction, after Glocker & Pfeiffer (*Multiple impacts with friction in rigid
/// multibody systems*, 1995), in two phases. With u = A v before a phase and u⁺ = u + W p after it:
///
/// | rows | compression, impulse p | restitution, further impulse p₂ |
/// |---|---|---|
/// | rigid, pin | u⁺ = 0 | u⁺ = 0 |
/// | bounce | p ≥ 0, u⁺ ≥ 0, p u⁺ = 0 | p₂ ≥ e p, u⁺ ≥ 0, (p₂ − e p) u⁺ = 0 |
///
/// The momentum of the robot and the bodies together is conserved to rounding. Energy does not increase for any
/// restitutions: p₂ minimises the energy gain `u·p₂ + ½ p₂ᵀ W p₂` over all p₂ ≥ e p, which include p itself, and p
/// returns exactly the energy lost in the compression. A single bounce follows Newton's law, u⁺ = −e u; a separating
/// bounce has no impulse.
///
/// # Errors
/// [`Error::Length`], [`Error::NotFinite`]; [`Error::Singular`] for contacts that depend on each other, such as two
/// rigid ones on arms with too few joints for a loop.
pub fn impact<T: Real, M: Model<T> + ?Sized>(
    model: &M,
    state: &State<'_, T>,
    bodies: &[Body<T>],
    mut delassus: DelassusMatrix<'_, T>,
    after: &mut ImpactOutput<'_, T>,
) -> Result<[T; 3], Error> {
    finite_state(state)?;
    length("joint_rates", model.joints(), state.joint_rates.len())?;
    length("joint_rates_after", model.joints(), after.joint_rates.len())?;
    length("body_twists_after", bodies.len(), after.body_twists.len())?;
    length("impulses", delassus.contacts.len(), after.impulses.len())?;
    copy(state.joint_rates, after.joint_rates);
    for (twist, body) in after.body_twists.iter_mut().zip(bodies) {
        *twist = body.twist;
    }
    let [before, compression, total, shifted, given] = core::mem::take(&mut delassus.vectors);
    model.end_effector_twists(state, delassus.end_effectors)?;
    for (velocity, row) in before.iter_mut().zip(delassus.rows()) {
        *velocity = row.velocity(delassus.end_effectors, after.body_twists)?;
    }
    solve_contacts(delassus.matrix, before, delassus.bilateral, delassus.factors, compression)?;
    for ((given, impulse), row) in given.iter_mut().zip(compression.iter()).zip(delassus.rows()) {
        *given = *impulse + row.restitution.map_or(T::ZERO, |e| e * *impulse);
    }
    let products = matrix_rows(delassus.matrix, before.len());
    for ((shifted, before), row) in shifted.iter_mut().zip(before.iter()).zip(products) {
        *shifted = *before + dot(row, &*given);
    }
    solve_contacts(delassus.matrix, shifted, delassus.bilateral, delassus.factors, total)?;
    for (total, given) in total.iter_mut().zip(given.iter()) {
        *total += *given;
    }
    let mut base_twist = state.base_twist;
    let ImpactOutput { joint_rates, body_twists, impulses } = after;
    delassus.add_responses(total, Coordinates { base: &mut base_twist, joints: joint_rates, bodies: body_twists });
    let mut components = total.iter();
    for (wrench, contact) in impulses.iter_mut().zip(delassus.contacts) {
        *wrench = [T::ZERO; 3];
        for (row, impulse) in contact.rows().zip(&mut components) {
            add_scaled(wrench, *impulse, &row.wrench);
        }
    }
    Ok(base_twist)
}
