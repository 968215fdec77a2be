//! A Runge–Kutta step of a robot whose number of joints the compiler knows, with one look at its numbers, at the end.
//!
//! All numbers are values of one function. A call would pass them on through memory, for which a stage waits; a closure that is used
//! several times is called, too.

#![allow(clippy::inline_always, reason = "see above")]

use super::runge_kutta4::stages;
use crate::linear::{copy, power};
use crate::scalar::Real;
use crate::state::{split, split_mut};
use crate::validate::is_regular;

/// Positions or rates of a robot: of the base and the joints.
pub type Half<'a, T, const JOINTS: usize> = (&'a [T; 3], &'a [T; JOINTS]);

/// Base pose, joint angles, base twist and joint rates of a vector, or their slopes.
type Parts<Slice> = [Slice; 4];

/// A robot whose equations of motion are in the text of each stage.
pub trait Accelerate<T, const JOINTS: usize> {
    /// By positions, rates and torques, without a look at them.
    fn accelerate(&self, state: [Half<'_, T, JOINTS>; 2], torques: &[T; JOINTS]) -> Accelerations<T, JOINTS>;
}

/// Accelerations of a robot.
#[derive(Debug)]
pub struct Accelerations<T, const JOINTS: usize> {
    /// Of the base.
    pub base: [T; 3],
    /// Of the joints.
    pub joints: [T; JOINTS],
    /// Of the equations that they solve.
    pub smallest_pivot: T,
}

/// The step of an integrated vector of so many numbers under the torques at each of its stages.
///
/// `None`, with `x` unchanged, for vectors of another length, without torques, and where the step is not regular and finite. Each
/// branch between stages would keep numbers in memory.
#[inline(always)]
#[allow(clippy::many_single_char_names, reason = "the vector and its four stages")]
pub fn step_at_once<T: Real, const JOINTS: usize, const LENGTH: usize>(
    robot: &impl Accelerate<T, JOINTS>,
    torques_at: &mut (impl FnMut(T, &[T], &mut [T]) -> Option<()> + ?Sized),
    [time, step]: [T; 2],
    x: &mut [T],
    torques: &mut [T],
) -> Option<()> {
    let x: &mut [T; LENGTH] = x.try_into().ok()?;
    let torques: &mut [T; JOINTS] = torques.try_into().ok()?;
    let [(at_a, weight_a, to_b), (at_b, weight_b, to_c), (at_c, weight_c, to_d), (at_d, weight_d, _)] = stages(step);

    let (a, power_a) = accelerations(robot, torques_at, time + at_a, x, torques)?;
    let slopes_a = slopes(x, &a)?;
    let x_b = along(x, to_b, slopes_a)?;
    let (b, power_b) = accelerations(robot, torques_at, time + at_b, &x_b, torques)?;
    let slopes_b = slopes(&x_b, &b)?;
    let x_c = along(x, to_c, slopes_b)?;
    let (c, power_c) = accelerations(robot, torques_at, time + at_c, &x_c, torques)?;
    let slopes_c = slopes(&x_c, &c)?;
    let x_d = along(x, to_d, slopes_c)?;
    let (d, power_d) = accelerations(robot, torques_at, time + at_d, &x_d, torques)?;
    let slopes_d = slopes(&x_d, &d)?;

    let weights = [weight_a, weight_b, weight_c, weight_d];
    let sums: [T; LENGTH] = weighted(weights, [slopes_a, slopes_b, slopes_c, slopes_d])?;
    let mut work = [T::ZERO];
    weighted_part(&mut work, weights, [&[power_a], &[power_b], &[power_c], &[power_d]]);

    // a sum is finite only where its terms are; slopes depend on all numbers but the place of the base
    let [pose, angles, twist, rates] = parts(&sums)?;
    let total = add_to(add_to(add_to(add_to([T::ZERO; 2], angles), rates), pose), twist);
    let ([pose_a, ..], [pose_b, ..]) = (parts(x)?, parts(&x_b)?);
    let ([pose_c, ..], [pose_d, ..]) = (parts(&x_c)?, parts(&x_d)?);
    let [total, other] = add_to(add_to(add_to(add_to(total, pose_a), pose_b), pose_c), pose_d);
    let is_finite = (total + other) * T::ZERO == T::ZERO;
    let pivots = [a, b, c, d].map(|accelerations| accelerations.smallest_pivot);
    if !pivots.into_iter().fold(is_finite, |all, pivot| all & is_regular(pivot)) {
        return None;
    }

    let sixth = step / T::constant(6.0);
    let end = along(x, sixth, parts(&sums)?)?;
    let (x, end) = (split_mut(x).ok()?, split(&end).ok()?);
    copy(end.positions, x.positions);
    copy(end.rates, x.rates);
    let ([joint_work, ..], [work]) = (x.work, work);
    *joint_work = T::mul_add(work, sixth, *joint_work);
    Some(())
}

/// Accelerations of a stage, and the power of its torques.
#[inline(always)]
fn accelerations<T: Real, const JOINTS: usize, const LENGTH: usize>(
    robot: &impl Accelerate<T, JOINTS>,
    torques_at: &mut (impl FnMut(T, &[T], &mut [T]) -> Option<()> + ?Sized),
    time: T,
    x: &[T; LENGTH],
    torques: &mut [T; JOINTS],
) -> Option<(Accelerations<T, JOINTS>, T)> {
    torques_at(time, x, torques)?;
    let [pose, angles, twist, rates] = parts(x)?;
    let (positions, rates) = (half(pose, angles)?, half(twist, rates)?);
    // as long as both are in registers
    let power = power(torques, rates.1);
    Some((robot.accelerate([positions, rates], torques), power))
}

/// Slopes of a vector.
#[inline(always)]
fn slopes<'a, T, const JOINTS: usize, const LENGTH: usize>(
    x: &'a [T; LENGTH],
    accelerations: &'a Accelerations<T, JOINTS>,
) -> Option<Parts<&'a [T]>> {
    let [.., twist, rates] = parts(x)?;
    Some([twist, rates, &accelerations.base, &accelerations.joints])
}

/// The vector so far along slopes; of the work, which no stage asks for, it has nothing.
#[inline(always)]
fn along<T: Real, const LENGTH: usize>(x: &[T; LENGTH], by: T, slopes: Parts<&[T]>) -> Option<[T; LENGTH]> {
    let mut end = [T::ZERO; LENGTH];
    let ([pose, angles, twist, rates], from) = (parts_mut(&mut end)?, parts(x)?);
    along_part(pose, from[0], by, slopes[0]);
    along_part(angles, from[1], by, slopes[1]);
    along_part(twist, from[2], by, slopes[2]);
    along_part(rates, from[3], by, slopes[3]);
    Some(end)
}

/// In pairs of numbers, as [`weighted_part`]: left to itself, the compiler pairs others at each stage.
#[inline(always)]
fn along_part<T: Real>(end: &mut [T], from: &[T], by: T, slopes: &[T]) {
    let (end, last_end) = end.as_chunks_mut();
    let ((from, last_from), (slopes, last_slope)) = (from.as_chunks(), slopes.as_chunks());
    for (end, (from, slope)) in end.iter_mut().zip(from.iter().zip(slopes)) {
        *end = T::mul_add_both(*slope, [by; 2], *from);
    }
    for (end, (from, slope)) in last_end.iter_mut().zip(last_from.iter().zip(last_slope)) {
        *end = T::mul_add(*slope, by, *from);
    }
}

/// Weighted sums of slopes.
#[inline(always)]
fn weighted<T: Real, const LENGTH: usize>(weights: [T; 4], [a, b, c, d]: [Parts<&[T]>; 4]) -> Option<[T; LENGTH]> {
    let mut sums = [T::ZERO; LENGTH];
    let [pose, angles, twist, rates] = parts_mut(&mut sums)?;
    weighted_part(pose, weights, [a[0], b[0], c[0], d[0]]);
    weighted_part(angles, weights, [a[1], b[1], c[1], d[1]]);
    weighted_part(twist, weights, [a[2], b[2], c[2], d[2]]);
    weighted_part(rates, weights, [a[3], b[3], c[3], d[3]]);
    Some(sums)
}

#[inline(always)]
fn weighted_part<T: Real>(sums: &mut [T], [w_a, w_b, w_c, w_d]: [T; 4], [a, b, c, d]: [&[T]; 4]) {
    let ((sums, last_sum), (a, last_a), (b, last_b)) = (sums.as_chunks_mut(), a.as_chunks(), b.as_chunks());
    let ((c, last_c), (d, last_d)) = (c.as_chunks(), d.as_chunks());
    for (sum, ((a, b), (c, d))) in sums.iter_mut().zip(a.iter().zip(b).zip(c.iter().zip(d))) {
        let first = T::mul_add_both(*b, [w_b; 2], T::mul_both(*a, [w_a; 2]));
        *sum = T::mul_add_both(*d, [w_d; 2], T::mul_add_both(*c, [w_c; 2], first));
    }
    for (sum, ((a, b), (c, d))) in last_sum.iter_mut().zip(last_a.iter().zip(last_b).zip(last_c.iter().zip(last_d))) {
        let first = T::mul_add(*b, w_b, *a * w_a);
        *sum = T::mul_add(*d, w_d, T::mul_add(*c, w_c, first));
    }
}

/// Two sums, and the numbers.
#[inline(always)]
fn add_to<T: Real>([mut sum, mut other]: [T; 2], numbers: &[T]) -> [T; 2] {
    let (pairs, last) = numbers.as_chunks();
    for pair in pairs {
        [sum, other] = T::add_both([sum, other], *pair);
    }
    for last in last {
        sum += *last;
    }
    [sum, other]
}

#[inline(always)]
fn parts<T>(x: &[T]) -> Option<Parts<&[T]>> {
    let x = split(x).ok()?;
    let ((pose, angles), (twist, rates)) = (x.positions.split_at_checked(3)?, x.rates.split_at_checked(3)?);
    Some([pose, angles, twist, rates])
}

#[inline(always)]
fn parts_mut<T>(x: &mut [T]) -> Option<Parts<&mut [T]>> {
    let x = split_mut(x).ok()?;
    let ((pose, angles), (twist, rates)) = (x.positions.split_at_mut_checked(3)?, x.rates.split_at_mut_checked(3)?);
    Some([pose, angles, twist, rates])
}

#[inline(always)]
fn half<'a, T, const JOINTS: usize>(base: &'a [T], joints: &'a [T]) -> Option<Half<'a, T, JOINTS>> {
    Some((base.try_into().ok()?, joints.try_into().ok()?))
}
