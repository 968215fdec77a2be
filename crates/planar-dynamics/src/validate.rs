//! Checks of lengths and numbers between slices and straight-line code; public for generated code alone.

pub use crate::scalar::finite::{all_finite, regularity, unless_finite};

use crate::error::Error;
use crate::linear::copy;
use crate::scalar::Real;
use crate::state::{Forces, RobotState, State};
use crate::target::Target;
use core::hint::black_box;

/// A slice as an array, or [`Error::Length`].
#[inline]
pub fn array<'a, X, const N: usize>(quantity: &'static str, slice: &'a [X]) -> Result<&'a [X; N], Error> {
    slice.first_chunk().filter(|_| slice.len() == N).ok_or(Error::Length { quantity, expected: N, found: slice.len() })
}

/// As [`array()`], to be written.
#[inline]
pub fn array_mut<'a, X, const N: usize>(quantity: &'static str, slice: &'a mut [X]) -> Result<&'a mut [X; N], Error> {
    let found = slice.len();
    slice.first_chunk_mut().filter(|_| found == N).ok_or(Error::Length { quantity, expected: N, found })
}

/// As [`array_mut`], row by row.
#[inline]
pub fn rows_mut<'a, X, const R: usize, const C: usize>(
    quantity: &'static str,
    slice: &'a mut [X],
) -> Result<&'a mut [[X; C]; R], Error> {
    let error = Error::Length { quantity, expected: R * C, found: slice.len() };
    let (rows, rest) = slice.as_chunks_mut();
    if rest.is_empty() && rows.len() == R { rows.first_chunk_mut().ok_or(error) } else { Err(error) }
}

/// [`Error::Length`] unless the numbers are equal.
#[inline]
pub fn length(quantity: &'static str, expected: usize, found: usize) -> Result<(), Error> {
    if found == expected { Ok(()) } else { Err(Error::Length { quantity, expected, found }) }
}

/// Copies a result whose length fits and whose numbers are finite.
#[inline]
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
#[inline]
pub fn finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), Error> {
    if all_finite([values]) { Ok(()) } else { not_finite(quantity, values) }
}

#[cold]
#[inline(never)]
fn not_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), Error> {
    match first_not_finite(values) {
        None => Ok(()),
        Some((index, value)) => Err(Error::NotFinite { quantity, index, value: value.to_f64() }),
    }
}

/// Place and value of the first number that is NaN or infinite, for functions that are rarely called and to be small.
#[inline]
pub(crate) fn first_not_finite<T: Real>(values: &[T]) -> Option<(usize, T)> {
    // opaque to the compiler, which would write it out number by number
    let mut index = 0_usize;
    for value in values {
        if !black_box(*value).is_finite() {
            return Some((index, *value));
        }
        // wrapping, because as far as the compiler knows it could overflow
        index = index.wrapping_add(1);
    }
    None
}

/// [`finite`] of all numbers of a state.
#[inline]
pub fn finite_state<T: Real>(state: &State<'_, T>) -> Result<(), Error> {
    let RobotState { base_pose, joint_angles, base_twist, joint_rates } = state;
    if all_finite([base_pose, joint_angles, base_twist, joint_rates]) {
        Ok(())
    } else {
        first_not_finite_of_state(state)
    }
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

/// Joint angles and rates as arrays.
#[inline]
pub fn joint_arrays<'a, T: Real, const N: usize>(state: &State<'a, T>) -> Result<[&'a [T; N]; 2], Error> {
    Ok([array("joint_angles", state.joint_angles)?, array("joint_rates", state.joint_rates)?])
}

/// [`joint_arrays`] of a state with finite numbers.
#[inline]
pub fn finite_joint_arrays<'a, T: Real, const N: usize>(state: &State<'a, T>) -> Result<[&'a [T; N]; 2], Error> {
    // of a known number the sums of zeros have no loops
    let [angles, rates] = joint_arrays(state)?;
    finite_state(&State { joint_angles: angles, joint_rates: rates, ..*state })?;
    Ok([angles, rates])
}

/// A pivot at or below this, relative to its scale, is that of a singular matrix.
pub(crate) fn pivot_limit<T: Real>() -> T {
    T::EPSILON * T::constant(8.0)
}

/// Whether the smallest relative pivot exceeds 8 ε.
#[inline]
pub fn is_regular<T: Real>(smallest: T) -> bool {
    smallest > pivot_limit()
}

/// Whether the pivot is regular and all numbers are finite: [`is_regular`] and [`all_finite`], or, where numbers are
/// compared one by one, a single comparison, as 0 x is 0 where x is finite, else NaN.
#[cfg_attr(target_arch = "arm", inline)]
#[cfg_attr(not(target_arch = "arm"), inline(always))]
#[allow(clippy::inline_always, reason = "what it borrows would be in memory")]
pub fn is_regular_and_finite<T: Real, const N: usize>(smallest: T, slices: [&[T]; N]) -> bool {
    if cfg!(not(target_arch = "arm")) {
        return is_regular(smallest) && all_finite(slices);
    }
    is_regular(slices.into_iter().fold(smallest, unless_finite))
}

/// As [`is_regular_and_finite`], of parts, too, whose number the caller has no name for.
#[inline]
pub fn are_regular_and_finite<'a, T: Real + 'a, const N: usize>(
    smallest: T,
    parts: impl Iterator<Item = &'a [T]>,
    slices: [&[T]; N],
) -> bool {
    if cfg!(not(target_arch = "arm")) {
        return parts.fold(is_regular(smallest), |all, part| all & all_finite([part])) && all_finite(slices);
    }
    is_regular_and_finite(parts.fold(smallest, unless_finite), slices)
}

/// As [`pivot`], or of parameters that are not finite [`Error::NotFinite`], for which a pivot is none, too.
#[inline]
pub fn pivot_of<T: Real, P: AsRef<[T]>>(
    parameters: impl FnOnce() -> P,
    what: &'static str,
    smallest: T,
) -> Result<(), Error> {
    pivot(what, smallest).or_else(|singular| finite("parameters", parameters().as_ref()).and(Err(singular)))
}

/// [`Error::Singular`] unless the smallest relative pivot exceeds 8 ε.
#[inline]
pub fn pivot<T: Real>(what: &'static str, smallest: T) -> Result<(), Error> {
    let limit = pivot_limit::<T>();
    if smallest > limit {
        Ok(())
    } else {
        Err(Error::Singular { what, pivot: smallest.to_f64(), limit: limit.to_f64() })
    }
}
