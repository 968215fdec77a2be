//! A Runge–Kutta step of a robot whose number of joints the compiler knows, with one look at its numbers, at the end.

use super::runge_kutta4::{advance, stages};
use crate::linear::{add_scaled, dot};
use crate::scalar::Real;
use crate::state::{split, split_mut};
use crate::validate::{all_finite, is_regular};
use core::hint::black_box;

/// Positions or rates of a robot: of the base and the joints.
pub type Half<'a, T, const JOINTS: usize> = (&'a [T; 3], &'a [T; JOINTS]);

/// A stage, the weighted sums of slopes, the sum of places, and accelerations of base and joints.
type Numbers<'a, T, const JOINTS: usize, const LENGTH: usize> =
    (&'a mut [T; LENGTH], &'a mut [T; LENGTH], &'a mut [T; 3], &'a mut ([T; 3], [T; JOINTS]));

/// The step of an integrated vector of so many numbers under the torques at each of its stages; `accelerate` takes positions, rates
/// and torques, fills the accelerations of base and joints, and returns the smallest pivot.
///
/// `None`, with `x` unchanged, for vectors of another length, without torques, and where the step is not regular and finite. Each
/// branch between stages would keep numbers in memory, and a stage wait for them.
#[inline(always)]
#[allow(clippy::inline_always, reason = "the caller may know the torques")]
pub fn step_at_once<T: Real, const JOINTS: usize, const LENGTH: usize>(
    accelerate: &impl Fn([Half<'_, T, JOINTS>; 2], &[T; JOINTS], &mut [T; 3], &mut [T; JOINTS]) -> T,
    torques_at: &mut (impl FnMut(T, &[T], &mut [T]) -> Option<()> + ?Sized),
    [time, step]: [T; 2],
    x: &mut [T],
    torques: &mut [T],
) -> Option<()> {
    let x: &mut [T; LENGTH] = x.try_into().ok()?;
    let torques: &mut [T; JOINTS] = torques.try_into().ok()?;
    let (mut sum, mut stage) = ([T::ZERO; LENGTH], [T::ZERO; LENGTH]);
    // slopes depend on all numbers but the place of the base: the places of all stages are finite where their sum is
    let mut places = [T::ZERO; 3];
    let mut accelerations = ([T::ZERO; 3], [T::ZERO; JOINTS]);
    let mut all = (&mut stage, &mut sum, &mut places, &mut accelerations);
    // four times in the text: a loop would look up the weights
    let [first, second, third, fourth] = stages(step).map(|(at, weight, next)| (time + at, weight, next));
    let pivots = [
        stage_at_once::<_, _, _, true>(accelerate, torques_at, first, x, &mut all, torques)?,
        stage_at_once::<_, _, _, false>(accelerate, torques_at, second, x, &mut all, torques)?,
        stage_at_once::<_, _, _, false>(accelerate, torques_at, third, x, &mut all, torques)?,
        stage_at_once::<_, _, _, false>(accelerate, torques_at, fourth, x, &mut all, torques)?,
    ];
    if !(pivots.into_iter().fold(true, |all, pivot| all & is_regular(pivot)) && all_finite([&sum, &places])) {
        return None;
    }
    add_scaled(x, step / T::constant(6.0), &sum);
    Some(())
}

/// One stage at its time, with its weight and the next stage's distance: sums, the next stage, and the smallest pivot. The first one is
/// at `x` itself: a copy would be a call, whose loads wait for the stores of the step before.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as where it is called")]
fn stage_at_once<T: Real, const JOINTS: usize, const LENGTH: usize, const FIRST: bool>(
    accelerate: &impl Fn([Half<'_, T, JOINTS>; 2], &[T; JOINTS], &mut [T; 3], &mut [T; JOINTS]) -> T,
    torques_at: &mut (impl FnMut(T, &[T], &mut [T]) -> Option<()> + ?Sized),
    (time, weight, next): (T, T, T),
    x: &[T; LENGTH],
    (stage, sum, places, (base, joints)): &mut Numbers<'_, T, JOINTS, LENGTH>,
    torques: &mut [T; JOINTS],
) -> Option<T> {
    let now: &[T; LENGTH] = if FIRST { x } else { stage };
    add_scaled(*places, T::ONE, now);
    torques_at(time, now, torques)?;
    let now = split(now).ok()?;
    let (positions, rates) = (parts(now.positions)?, parts(now.rates)?);
    let pivot = accelerate([positions, rates], torques, base, joints);
    let power = dot(torques, rates.1);
    let (sum, x, stage) = (split_mut(*sum).ok()?, split(x).ok()?, split_mut(*stage).ok()?);
    let now_rates = if FIRST { x.rates } else { &*stage.rates };
    advance(sum.positions, stage.positions, x.positions, now_rates, weight, next);
    // by the loads that match the stores of the accelerations
    let (base_sum, joints_sum) = sum.rates.split_at_mut_checked(3)?;
    let (base_stage, joints_stage) = stage.rates.split_at_mut_checked(3)?;
    let (base_x, joints_x) = x.rates.split_at_checked(3)?;
    advance(base_sum, base_stage, base_x, base, weight, next);
    advance(joints_sum, joints_stage, joints_x, joints, weight, next);
    // that of the next stage is not asked for
    let [joint_work, ..] = sum.work;
    *joint_work = T::mul_add(power, weight, *joint_work);
    Some(pivot)
}

/// The parts of one half of the vector.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as where it is called")]
fn parts<T, const JOINTS: usize>(half: &[T]) -> Option<Half<'_, T, JOINTS>> {
    let (base, joints) = half.split_first_chunk()?;
    Some((base, joints.try_into().ok()?))
}

/// The same reference. Where the processor has vectors, the compiler does not know what is beside the number, and loads it alone: a
/// vector over two stores would wait until both are in the cache. With AVX-512 it loads numbers alone anyway, and the reference would
/// be waited for.
#[inline(always)]
#[allow(clippy::inline_always, reason = "there is nothing to call")]
pub fn unknown<X>(reference: &X) -> &X {
    let has_pairs = cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) && cfg!(not(target_feature = "avx512f"));
    if has_pairs { black_box(reference) } else { reference }
}
