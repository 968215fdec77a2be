//! Adaptive steps by a pair of formulas, with dense output.

use super::blocks::{BLOCK, Blocks, chebyshev, combine, largest_error, sum};
use super::continuation::Continuation;
use super::motion::Motion;
use super::pair::{DEGREE, DORMAND_PRINCE, MOST_STAGES, Pair, VERNER};
use crate::error::Error;
use crate::scalar::Real;

/// The next step over the one that the error estimate allows.
const SAFETY: f64 = 0.9;
/// Least and largest ratio of a step to the one before.
const RATIOS: [f64; 2] = [0.2, 10.0];
/// Least part of the allowed step that is taken to end at a requested time where that pair is the better one: between nearer
/// times, evaluations of the interpolant are fewer.
const HALF: f64 = 0.5;
/// Rejected steps without an accepted one between them that are too many.
const MOST_REJECTED: u32 = 100;

/// ẋ = f(t, x) by Verner's "most efficient" pair 9(8) with an interpolant of order 9 (`rkv989e`).
///
/// Steps are as long as the error estimate allows, `|error| ≤ tolerance (1 + |x|)` per step for every entry of x. They end
/// at a requested time where somewhat shorter ones do, and otherwise continue beyond it, where x comes from the
/// interpolant. An accepted step takes 16 evaluations, a rejected one 15; the first time within a step for which x is
/// asked takes 9 more. Steps take no memory.
///
/// # Example
/// ```
/// use planar_capture::error::Error;
/// use planar_capture::integrate::Adaptive;
/// use std::f64::consts::PI;
///
/// fn oscillator(_time: f64, x: &[f64], rate: &mut [f64]) -> Result<(), Error> {
///     rate.copy_from_slice(&[x[1], -x[0]]);
///     Ok(())
/// }
///
/// let (mut time, mut x) = (0.0, [1.0, 0.0]); // s; m and m/s
/// let mut steps = Adaptive::new(1e-12);
/// steps.start(time, PI, &x, &mut oscillator)?;
/// while time < PI {
///     time = steps.advance([time, PI], &mut x, &mut oscillator)?;
/// }
/// // half a period of 2π s
/// assert!((x[0] + 1.0).abs() < 1e-10 && x[1].abs() < 1e-10);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug)]
pub struct Adaptive {
    /// For steps that end at a requested time, and for those that continue beyond it.
    pairs: [&'static Pair; 2],
    /// Least part of the allowed step that is taken to end at a requested time.
    landing: f64,
    /// Of the last step.
    pair: &'static Pair,
    tolerance: f64,
    /// Number of entries of x.
    size: usize,
    /// f may change after this time, s.
    end: f64,
    /// Start and end of the last step, s; the same before the first one.
    span: [f64; 2],
    /// x at both.
    ends: [Blocks; 2],
    /// ẋ at the end.
    rate: Blocks,
    /// ẋ at the stages of the last step, one after the other.
    stages: Blocks,
    /// The coefficients of the interpolant over the last step, one after the other.
    interpolant: Blocks,
    /// A bound of its fourth derivatives, per s⁴; `None` before it is found.
    fourth_derivative: Option<f64>,
    /// The next step, s.
    step: f64,
    /// The same before it is shortened to end at `end`.
    next_step: f64,
    /// Steps taken or rejected so far.
    attempts: u64,
    continuation: Continuation,
    /// x at a stage.
    working: Blocks,
}

impl Adaptive {
    /// Smallest tolerance: rounding errors are larger than a smaller one.
    pub const SMALLEST_TOLERANCE: f64 = 1e-14;

    /// With this tolerance, relative and absolute; to be [started](Self::start).
    #[must_use]
    pub fn new(tolerance: f64) -> Self {
        Self::by([&VERNER, &VERNER], VERNER.landing(), tolerance)
    }

    /// The same for a motion with feedback. Where that is fast beside the motion, steps are as long as they are stable: those of
    /// Dormand & Prince's formula of order 8 up to 6.4 times the shortest time constant with 12 evaluations, those of the other
    /// up to 4.4 times. It takes the steps that end at a requested time, half as long as the allowed ones or more; between
    /// nearer times x is from the other's interpolant, which is of a higher order. Under fast feedback errors are up to some ten
    /// tolerances.
    #[must_use]
    pub fn with_feedback(tolerance: f64) -> Self {
        Self::by([&DORMAND_PRINCE, &VERNER], HALF, tolerance)
    }

    fn by(pairs: [&'static Pair; 2], landing: f64, tolerance: f64) -> Self {
        Self {
            pairs,
            landing,
            pair: pairs[1],
            tolerance,
            size: 0,
            end: 0.0,
            span: [0.0; 2],
            ends: [Vec::new(), Vec::new()],
            rate: Vec::new(),
            stages: Vec::new(),
            interpolant: Vec::new(),
            fourth_derivative: None,
            step: 0.0,
            next_step: 0.0,
            attempts: 0,
            continuation: Continuation::default(),
            working: Vec::new(),
        }
    }

    /// Starts at `x`; f holds until `end`. Where it was started before, the last step's length is tried first.
    ///
    /// # Errors
    /// Those of `motion`.
    pub fn start(&mut self, time: f64, end: f64, x: &[f64], motion: &mut dyn Motion) -> Result<(), Error> {
        let least = f64::EPSILON * time.abs().max(end.abs()).max(f64::MIN_POSITIVE);
        self.end = end.max(time + 4.0 * least);
        self.size = x.len();
        let blocks = x.len().div_ceil(BLOCK);
        let resize = |vector: &mut Blocks, length| {
            vector.clear();
            vector.resize(length, [0.0; BLOCK]);
        };
        self.ends.iter_mut().chain([&mut self.working, &mut self.rate]).for_each(|vector| resize(vector, blocks));
        self.continuation.reset(blocks);
        resize(&mut self.stages, MOST_STAGES * blocks);
        resize(&mut self.interpolant, DEGREE * blocks);
        self.ends[1].as_flattened_mut()[..x.len()].copy_from_slice(x);
        self.span = [time, time];
        motion.derivative(time, x, &mut self.rate.as_flattened_mut()[..x.len()])?;
        let first = if self.next_step > 0.0 { self.next_step } else { self.first_step(motion)? };
        self.step = first.min(self.end - time);
        self.next_step = self.step;
        Ok(())
    }

    /// Steps until x is known at a time after `from`, for which the last step was taken: at `time`, or at the end of a
    /// step before it. Writes x to `into` and returns its time. `time` is no later than the end.
    ///
    /// # Errors
    /// [`Error::Tolerance`] where steps become too short, and those of `motion`.
    pub fn advance(&mut self, [from, time]: [f64; 2], into: &mut [f64], motion: &mut dyn Motion) -> Result<f64, Error> {
        // `end` may be a sum of steps, rounded to before the requested time
        let wanted = time.min(self.end);
        let rounding = 4.0 * f64::EPSILON * self.end.abs();
        let [_, reached] = self.span;
        if wanted > reached + rounding && from + rounding >= reached {
            into.copy_from_slice(self.x());
            if motion.restore(into)? {
                self.start(reached, self.end, into, motion)?;
            }
            self.take_step(wanted, motion)?;
        }
        let [_, now] = self.span;
        let reached = if wanted > now + rounding { now } else { time };
        self.interpolate(reached, into, motion).map(|()| reached)
    }

    /// x at a time within the last step.
    ///
    /// # Errors
    /// Those of `motion`.
    pub fn interpolate(&mut self, time: f64, into: &mut [f64], motion: &mut dyn Motion) -> Result<(), Error> {
        let [before, now] = self.span;
        if time >= now || before >= now {
            into.copy_from_slice(self.x());
            return Ok(());
        }
        self.find_interpolant(motion)?;
        let length = now - before;
        let part = (time.max(before) - before) / length;
        chebyshev(&self.ends[0], length, part, &self.interpolant, &mut self.working);
        into.copy_from_slice(&self.working.as_flattened()[..self.size]);
        Ok(())
    }

    /// A bound of the fourth derivative of every entry of x over the last step, in its unit per s⁴; infinite where no x within that step
    /// was asked for.
    #[must_use]
    pub fn fourth_derivative(&self) -> f64 {
        self.fourth_derivative.unwrap_or(f64::INFINITY)
    }

    /// The number of steps taken or rejected so far.
    #[must_use]
    pub fn attempts(&self) -> u64 {
        self.attempts
    }

    /// The length of the next step, s, where none is shortened; 0 before the start.
    #[must_use]
    pub fn next_step(&self) -> f64 {
        self.next_step
    }

    /// x at the end of the last step.
    fn x(&self) -> &[f64] {
        &self.ends[1].as_flattened()[..self.size]
    }

    /// A step for the start, after Hairer, Nørsett & Wanner (1993), section II.4: short beside x over ẋ, and beside what
    /// the change of ẋ over such a step allows.
    fn first_step(&mut self, motion: &mut dyn Motion) -> Result<f64, Error> {
        let [time, _] = self.span;
        let size = self.size;
        let probe = &mut self.working.as_flattened_mut()[..size];
        let [x, rate] = [&self.ends[1], &self.rate].map(|blocks| &blocks.as_flattened()[..size]);
        let scale = |x: f64| self.tolerance * (1.0 + x.abs());
        let norm = |of: &[f64]| of.iter().zip(x).map(|(value, x)| (value / scale(*x)).powi(2)).sum::<f64>();
        let (of_x, of_rate) = (norm(x), norm(rate));
        let short = if of_rate <= 1e-10 || of_x <= 1e-10 { 1e-6 } else { 0.01 * (of_x / of_rate).sqrt() };
        let short = short.min(self.end - time);
        probe.iter_mut().zip(x.iter().zip(rate)).for_each(|(probe, (x, rate))| *probe = x + short * rate);
        let changed = &mut self.stages.as_flattened_mut()[..size];
        match motion.derivative(time + short, probe, changed) {
            Err(Error::NotFinite { .. } | Error::Singular { .. }) => return Ok(short * 1e-3),
            found => found?,
        }
        changed.iter_mut().zip(rate).for_each(|(changed, rate)| *changed -= rate);
        let most = of_rate.sqrt().max(norm(changed).sqrt() / short);
        let by_change = if most <= 1e-15 { short * 1e-3 } else { libm::pow(0.01 / most, 1.0 / self.pair.order) };
        Ok((100.0 * short).min(by_change))
    }

    /// One accepted step; x is asked for at `wanted`.
    fn take_step(&mut self, wanted: f64, motion: &mut dyn Motion) -> Result<(), Error> {
        let [_, start] = self.span;
        let blocks = self.rate.len();
        let (mut rejected, mut failure) = (0, None);
        loop {
            let left = self.end - start;
            let is_cut = self.step > left;
            if is_cut {
                self.next_step = self.step;
                self.step = left;
            }
            if start + self.step <= start || rejected >= MOST_REJECTED {
                let tolerance = Error::Tolerance { tolerance: self.tolerance, step: self.step };
                return Err(failure.unwrap_or(tolerance));
            }
            let steps = ((wanted - start) / self.step).ceil();
            let even = (wanted - start) / steps;
            let lands = even >= self.landing * self.step;
            if lands {
                self.step = self.step.min(even);
            }
            self.pair = self.pairs[usize::from(!lands)];
            self.attempts += 1;
            self.stages[..blocks].copy_from_slice(&self.rate);
            self.fourth_derivative = None;
            let stages = (1..self.pair.stages).try_for_each(|stage| self.add_stage(start, self.step, 1, stage, motion));
            // a step that is too long can leave what the motion is defined for; whether a shorter one does is seen then
            let error = match stages {
                Ok(()) => self.error_at_end(),
                Err(error @ (Error::NotFinite { .. } | Error::Singular { .. })) => {
                    failure = Some(error);
                    f64::INFINITY
                }
                Err(error) => return Err(error),
            };
            let allowed = SAFETY * libm::pow(error, -1.0 / self.pair.order);
            let [least, most] = RATIOS;
            let ratio = if error.is_finite() { allowed.min(most).max(least) } else { least };
            let length = self.step;
            self.step *= if rejected > 0 { ratio.min(1.0) } else { ratio };
            if error <= 1.0 {
                self.ends.swap(0, 1);
                std::mem::swap(&mut self.ends[1], &mut self.working);
                self.span = [start, if lands && steps <= 1.0 { wanted } else { start + length }];
                self.next_step = if is_cut { self.next_step.max(self.step) } else { self.step };
                let x = &self.ends[1].as_flattened()[..self.size];
                motion.derivative(self.span[1], x, &mut self.rate.as_flattened_mut()[..self.size])?;
                self.continuation.follow(self.pair, length, &self.stages, &self.rate);
                return Ok(());
            }
            rejected += 1;
        }
    }

    /// The end of a step, into working space, and its largest error over the one allowed.
    fn error_at_end(&mut self) -> f64 {
        let Self { pair, tolerance, step, ends: [_, start], stages, working: end, .. } = self;
        combine(start, *step, &pair.weights, stages, end);
        largest_error([start, end], *step, &pair.errors, stages, *tolerance)
    }

    /// Evaluates a stage of a step of a length, s, from `start`, s, where x is that of an end of the last step.
    fn add_stage(
        &mut self,
        start: f64,
        length: f64,
        end: usize,
        stage: usize,
        motion: &mut dyn Motion,
    ) -> Result<(), Error> {
        let Self { pair, size, ends, stages, continuation, working: at, .. } = self;
        let blocks = at.len();
        combine(&ends[end], length, &pair.rows[stage], stages, at);
        if let Some(defects) = &pair.defects[stage] {
            continuation.correct(length, defects, at);
        }
        let rate = &mut stages[stage * blocks..(stage + 1) * blocks];
        let time = start + pair.nodes[stage] * length;
        motion.derivative(time, &at.as_flattened()[..*size], &mut rate.as_flattened_mut()[..*size])
    }

    /// Evaluates the stages of the interpolant over the last step, and from all its coefficients, once.
    fn find_interpolant(&mut self, motion: &mut dyn Motion) -> Result<(), Error> {
        if self.fourth_derivative.is_some() {
            return Ok(());
        }
        let [start, end] = self.span;
        // the first of them is at the end of the step
        let blocks = self.rate.len();
        let Pair { stages, .. } = *self.pair;
        self.stages[stages * blocks..(stages + 1) * blocks].copy_from_slice(&self.rate);
        for stage in stages + 1..self.pair.all_stages() {
            self.add_stage(start, end - start, 0, stage, motion)?;
        }
        for (row, coefficients) in self.pair.interpolant.iter().zip(self.interpolant.chunks_exact_mut(blocks)) {
            sum(row, &self.stages, coefficients);
        }
        self.fourth_derivative = Some(fourth_derivative(end - start, self.interpolant.chunks_exact(blocks)));
        Ok(())
    }
}

/// A bound of the fourth derivative of every entry of `x + h s Σ cₖ Tₖ(u)`, `u = 2 s - 1`, over a step of a length h, s, from the
/// coefficients c of each k. With `2 s = 1 + u` it is `(2/h)⁴ h/2 ((1 + u) Σ cₖ Tₖ⁗ + 4 Σ cₖ Tₖ‴)`, and a derivative of Tₖ is largest at
/// `u = 1`.
fn fourth_derivative<'a>(length: f64, coefficients: impl Iterator<Item = &'a [[f64; BLOCK]]>) -> f64 {
    let (mut bound, mut k) = (0.0, 0.0_f64);
    for of_all in coefficients {
        let square = k * k;
        let third = square * (square - 1.0) * (square - 4.0) / 15.0;
        let fourth = third * (square - 9.0) / 7.0;
        let largest = of_all.as_flattened().iter().fold(0.0, |most: f64, c| Real::maximum(most, c.abs()));
        bound += largest * (2.0 * fourth + 4.0 * third);
        k += 1.0;
    }
    8.0 * bound / length.powi(3)
}

#[cfg(test)]
mod tests;
