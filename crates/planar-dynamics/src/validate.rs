//! Checks of lengths and numbers between slices and straight-line code; public for generated code alone.

use crate::error::Error;
use crate::linear::copy;
use crate::scalar::Real;
use crate::state::{Forces, RobotState, State};
use crate::target::Target;

/// A slice as an array, or [`Error::Length`].
pub fn array<'a, X, const N: usize>(quantity: &'static str, slice: &'a [X]) -> Result<&'a [X; N], Error> {
    slice.first_chunk().filter(|_| slice.len() == N).ok_or(Error::Length { quantity, expected: N, found: slice.len() })
}

/// [`Error::Length`] unless the numbers are equal.
pub fn length(quantity: &'static str, expected: usize, found: usize) -> Result<(), Error> {
    if found == expected { Ok(()) } else { Err(Error::Length { quantity, expected, found }) }
}

/// Copies a result whose length fits and whose numbers are finite.
pub fn store<T: Real>(quantity: &'static str, values: &[T], into: &mut [T]) -> Result<(), Error> {
    length(quantity, values.len(), into.len())?;
    finite(quantity, values)?;
    copy(values, into);
    Ok(())
}

/// As [`store`], for lists of rows.
pub fn store_rows<T: Real, const C: usize>(
    quantity: &'static str,
    rows: &[[T; C]],
    into: &mut [[T; C]],
) -> Result<(), Error> {
    length(quantity, rows.len(), into.len())?;
    store(quantity, rows.as_flattened(), into.as_flattened_mut())
}

/// [`Error::NotFinite`] with the first number that is NaN or infinite.
pub fn finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), Error> {
    if zeros(values) == T::ZERO { Ok(()) } else { first_not_finite(quantity, values) }
}

/// Σ 0·x: 0 where all numbers are finite, else NaN. One product and one sum per number and one comparison in all.
fn zeros<T: Real>(values: &[T]) -> T {
    values.iter().fold(T::ZERO, |sum, value| sum + *value * T::ZERO)
}

#[cold]
#[inline(never)]
fn first_not_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), Error> {
    match values.iter().enumerate().find(|(_, value)| !value.is_finite()) {
        None => Ok(()),
        Some((index, value)) => Err(Error::NotFinite { quantity, index, value: value.to_f64() }),
    }
}

/// [`finite`] of all numbers of a state.
pub fn finite_state<T: Real>(state: &State<'_, T>) -> Result<(), Error> {
    let RobotState { base_pose, joint_angles, base_twist, joint_rates } = state;
    let sum = zeros(base_pose) + zeros(joint_angles) + zeros(base_twist) + zeros(joint_rates);
    if sum == T::ZERO { Ok(()) } else { first_not_finite_of_state(state) }
}

#[cold]
#[inline(never)]
fn first_not_finite_of_state<T: Real>(state: &State<'_, T>) -> Result<(), Error> {
    finite_configuration(&state.base_pose, state.joint_angles)?;
    finite("base_twist", &state.base_twist)?;
    finite("joint_rates", state.joint_rates)
}

/// [`finite`] of all numbers of a configuration.
pub fn finite_configuration<T: Real>(base_pose: &[T; 3], joint_angles: &[T]) -> Result<(), Error> {
    finite("base_pose", base_pose)?;
    finite("joint_angles", joint_angles)
}

/// [`finite`] of all forces.
pub fn finite_forces<T: Real>(forces: &Forces<'_, T>) -> Result<(), Error> {
    finite("joint_torques", forces.joint_torques)?;
    finite("base_wrench", forces.base_wrench.as_slice().as_flattened())?;
    finite("end_effector_wrenches", forces.end_effector_wrenches.unwrap_or_default().as_flattened())
}

/// [`finite`] of all numbers of a target.
pub fn finite_target<T: Real>(target: &Target<T>) -> Result<(), Error> {
    finite("target mass and inertia", &[target.mass, target.inertia])?;
    finite("target contact", &target.contact)?;
    finite("target twist", &target.twist)
}

/// Joint angles and rates as arrays, after [`finite_state`].
pub fn joint_arrays<'a, T: Real, const N: usize>(state: &State<'a, T>) -> Result<[&'a [T; N]; 2], Error> {
    // of a known number the sums of zeros have no loops
    let [angles, rates] = [array("joint_angles", state.joint_angles)?, array("joint_rates", state.joint_rates)?];
    finite_state(&State { joint_angles: angles, joint_rates: rates, ..*state })?;
    Ok([angles, rates])
}

/// [`Error::Singular`] unless the smallest relative pivot exceeds 8 ε.
pub fn pivot<T: Real>(what: &'static str, smallest: T) -> Result<(), Error> {
    let limit = T::EPSILON.to_f64() * 8.0;
    let pivot = smallest.to_f64();
    if pivot > limit { Ok(()) } else { Err(Error::Singular { what, pivot, limit }) }
}
