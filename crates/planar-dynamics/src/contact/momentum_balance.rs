//! The velocities after an impact from the balances of momentum, where inertias differ by many orders of magnitude.

use super::Contact;
use super::impact::ImpactOutput;
use crate::body::Body;
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::{add_scaled, copy, dot, eliminate, matrix_rows, matrix_rows_mut};
use crate::scalar::Real;
use crate::state::State;
use crate::validate::{finite, finite_state, length};

/// Length of the working space of [`balance_momentum`], for `rows` rows of rigid contacts and pins.
#[must_use]
pub const fn balance_length(joints: usize, arms: usize, bodies: usize, rows: usize) -> usize {
    let robot = 3 + joints;
    let size = robot + 3 * bodies + rows;
    size * (size + 2) + robot * robot + 3 * arms * (robot + 1)
}

/// Number of rows of the rigid contacts and pins.
#[must_use]
pub fn bilateral_rows<T: Real>(contacts: &[Contact<T>]) -> usize {
    contacts.iter().map(|contact| contact.law.kind().constraints()).sum()
}

/// Solves an impact again, for the velocities and impulses together; returns the base twist after it.
///
/// ```text
/// ⎡M    0    −Aᵀ⎤ ⎡v_f ⎤   ⎡M v_i + Σ bounces   ⎤
/// ⎢0    I_t   Bᵀ⎥ ⎢t_tf⎥ = ⎢I_t t_ti − Σ bounces⎥
/// ⎣A   −B     0 ⎦ ⎣p   ⎦   ⎣0                   ⎦
/// ```
///
/// with the rows A of the end effectors and B of their partners. `after` has the impulses of the bouncing contacts, as
/// [`impact`](super::impact()) finds them; they are given here. All the rest is solved for.
///
/// [`impact`](super::impact()) adds `M⁻¹ Aᵀ p` to the velocities, which has only the digits that p has beyond the ratio of
/// the target's inertia to that of the last link; [`crate::impact::exact`] solves with M + Jᵀ N J, which has only the
/// digits of the robot's inertia beyond the target's. This does neither: errors stay at rounding for ratios from 1e-12
/// to 1e6, independently for masses and inertias.
///
/// # Errors
/// [`Error::Length`] unless `workspace` has [`balance_length`] numbers and for other wrong lengths,
/// [`Error::Index`] for arms and bodies that do not exist, [`Error::NotFinite`], [`Error::Singular`] for contacts that
/// depend on each other.
pub fn balance_momentum<T: Real, M: Model<T> + ?Sized>(
    model: &M,
    state: &State<'_, T>,
    bodies: &[Body<T>],
    contacts: &[Contact<T>],
    workspace: &mut [T],
    after: &mut ImpactOutput<'_, T>,
) -> Result<[T; 3], Error> {
    finite_state(state)?;
    let (joints, arms, rows) = (model.joints(), model.arms(), bilateral_rows(contacts));
    length("joint_rates", joints, state.joint_rates.len())?;
    length("joint_rates_after", joints, after.joint_rates.len())?;
    length("body_twists_after", bodies.len(), after.body_twists.len())?;
    length("impulses", contacts.len(), after.impulses.len())?;
    length("balance workspace", balance_length(joints, arms, bodies.len(), rows), workspace.len())?;
    let robot = 3 + joints;
    let moving = robot + 3 * bodies.len();
    let size = moving + rows;
    let mut rest = workspace;
    let mut part = |length: usize| rest.split_off_mut(..length).unwrap_or_default();
    let (system, scales) = (part(size * (size + 1)), part(size));
    let (mass_matrix, jacobian) = (part(robot * robot), part(3 * arms * robot));
    let end_effectors = part(3 * arms).as_chunks_mut().0;
    model.mass_matrix(&state.base_pose, state.joint_angles, mass_matrix)?;
    model.end_effector_jacobian(&state.base_pose, state.joint_angles, jacobian)?;

    system.fill(T::ZERO);
    let width = size + 1;
    let velocity = || state.base_twist.iter().chain(state.joint_rates);
    for (row, equation) in matrix_rows(mass_matrix, robot).zip(matrix_rows_mut(system, width)) {
        copy(row, equation);
        add(equation, size, dot(row, velocity()));
    }
    let inertias = bodies.iter().flat_map(|body| [body.inertia, body.mass, body.mass].into_iter().zip(body.twist));
    for (i, (inertia, twist)) in (robot..).zip(inertias) {
        add(system, i * width + i, inertia);
        add(system, i * width + size, inertia * twist);
    }
    // the rows' velocities when one velocity of robot or bodies is 1 and the others are 0
    for column in 0..moving {
        let of_jacobian = matrix_rows(jacobian, robot).map(|row| row.get(column));
        for (twist, entry) in end_effectors.as_flattened_mut().iter_mut().zip(of_jacobian) {
            *twist = entry.map_or(T::ZERO, |entry| *entry);
        }
        let twists = after.body_twists.as_flattened_mut().iter_mut();
        for (i, twist) in (robot..).zip(twists) {
            *twist = if i == column { T::ONE } else { T::ZERO };
        }
        let mut constraint = moving;
        for (contact, impulse) in contacts.iter().zip(after.impulses.iter()) {
            for row in contact.rows() {
                let velocity = row.velocity(end_effectors, after.body_twists)?;
                if row.restitution.is_some() {
                    add(system, column * width + size, velocity * dot(&row.wrench, impulse));
                } else {
                    add(system, column * width + constraint, -velocity);
                    add(system, constraint * width + column, velocity);
                    constraint += 1;
                }
            }
        }
    }
    eliminate("the balance of momentum at the contacts", system, scales)?;

    let mut solution = matrix_rows(system, width).filter_map(|row| row.last().copied());
    let mut base_twist = [T::ZERO; 3];
    let unknowns = base_twist.iter_mut().chain(&mut *after.joint_rates).chain(after.body_twists.as_flattened_mut());
    for (unknown, value) in unknowns.zip(&mut solution) {
        *unknown = value;
    }
    for (contact, impulse) in contacts.iter().zip(after.impulses.iter_mut()) {
        if !contact.law.kind().is_unilateral() {
            *impulse = [T::ZERO; 3];
            for (row, component) in contact.rows().zip(&mut solution) {
                add_scaled(impulse, component, &row.wrench);
            }
        }
    }
    finite("base_twist_after", &base_twist)?;
    finite("joint_rates_after", after.joint_rates)?;
    finite("body_twists_after", after.body_twists.as_flattened())?;
    finite("impulses", after.impulses.as_flattened())?;
    Ok(base_twist)
}

fn add<T: Real>(values: &mut [T], index: usize, value: T) {
    if let Some(place) = values.get_mut(index) {
        *place += value;
    }
}
