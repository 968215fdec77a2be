//! Subdivides a step until the cubic interpolant of its states is the motion between them.
//!
//! An accurate step may be long: those of an adaptive integrator and of Gauss–Legendre follow motions that turn far
//! within one, which the cubic through its ends does not show. Interpolant and integrator are compared in the middle of
//! an interval, where the error of the interpolant is largest: in positions, and in rates, as an error that is odd about
//! the middle has a slope there. A motion that the parts before a step continue needs no evaluations for it, and where the
//! integrator bounds the fourth derivative, short parts need no comparison.

use crate::error::Error;
use crate::simulate::continued_motion::ContinuedMotion;
use crate::simulate::path::{Cubic, PathInterval, path_state};
use crate::simulate::stepper::StateAt;
use crate::simulate::system::System;
use crate::state::{split, split_mut};
use multiversion::multiversion;

/// Largest deviation of a point of the bodies from its motion, m: a hundredth of the resolution of distances.
const TOLERANCE: f64 = 1e-8;
/// The part of the tolerance that is left for a motion which bends more within a part than the parts before show.
const MARGIN: f64 = 4.0;
/// The tolerance relative to a position, for rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The states within the last part of a step, and what is needed to divide the next one.
pub(crate) struct Subdivision {
    /// Times and states at the ends of its intervals, the first one at the start of the part; before the first part, its start.
    knots: Vec<(f64, Vec<f64>)>,
    /// Most bisections of an interval; 0 where the interpolant is not compared.
    divisions: u32,
    comparison: Comparison,
    /// Memory of [`bisect`](Self::bisect).
    rights: Vec<(f64, Vec<f64>)>,
    /// The ends of the last parts; nothing where the interpolant is not compared.
    continued: ContinuedMotion,
    /// Memory of knots that are gone.
    spare: Vec<Vec<f64>>,
}

impl Subdivision {
    /// Of a motion that starts at this state.
    pub(crate) fn new(system: &System<'_>, divisions: u32, (time, start): (f64, &[f64])) -> Self {
        Self {
            knots: vec![(time, start.to_vec())],
            divisions,
            comparison: Comparison::new(system),
            rights: Vec::new(),
            continued: ContinuedMotion::default(),
            spare: Vec::new(),
        }
    }

    /// Divides the part of a step over the times of `span`, which starts where the one before it ended and ends at this integrated
    /// vector; the fourth derivatives of its entries over the part are no larger than `fourth_derivative`.
    pub(crate) fn divide(
        &mut self,
        span: [f64; 2],
        end: &[f64],
        fourth_derivative: f64,
        state_at: &mut StateAt<'_>,
    ) -> Result<(), Error> {
        let Self { knots, divisions, comparison, continued, spare, .. } = self;
        let before = knots.len().checked_sub(2).map(|i| knots.swap_remove(i));
        spare.extend(knots.drain(..knots.len() - 1).map(|(_, state)| state));
        let (time, start) = &mut knots[0];
        *time = span[0];
        let is_short = *divisions == 0 || comparison.is_cubic(span[1] - span[0], fourth_derivative);
        let is_reproduced = match &before {
            // where the interpolant over this part and one before it is the motion, that over this part alone is
            Some((time, state)) if !is_short && span[0] - time >= 0.5 * (span[1] - span[0]) => {
                comparison.is_reproduced([*time, span[1]], [state, end], (span[0], start))?
            }
            _ => is_short,
        };
        if !is_short {
            continued.push(span, [start, end].map(path_state));
        }
        spare.extend(before.map(|(_, state)| state));
        if is_reproduced {
            let end = self.copy(end);
            self.knots.push((span[1], end));
            return Ok(());
        }
        if !self.is_continued(span)? {
            return self.bisect(span, end, state_at);
        }
        let continued = std::mem::take(&mut self.continued);
        let mut state_at = |time: f64, into: &mut Vec<f64>| {
            into.clear();
            into.extend_from_slice(end);
            split_mut(into).map(|into| continued.at(time, [into.positions, into.rates]))
        };
        let divided = self.bisect(span, end, &mut state_at);
        self.continued = continued;
        divided
    }

    /// Whether the ends of the parts before show the motion within this one, from the first knot.
    fn is_continued(&mut self, [from, to]: [f64; 2]) -> Result<bool, Error> {
        let [positions, rates] = &mut self.comparison.found;
        let Some(share) = self.continued.start_by_others([positions, rates]) else { return Ok(false) };
        let start = split(&self.knots[0].1)?;
        let is_continued = self.comparison.is_found(to - from, [start.positions, start.rates], MARGIN * share);
        if is_continued {
            self.continued.follow();
        }
        Ok(is_continued)
    }

    /// A copy in memory of knots that are gone.
    fn copy(&mut self, state: &[f64]) -> Vec<f64> {
        let mut own = self.spare.pop().unwrap_or_default();
        own.clear();
        own.extend_from_slice(state);
        own
    }

    /// The intervals of the part, in order.
    pub(crate) fn intervals(&self) -> impl Iterator<Item = Result<PathInterval<'_>, Error>> {
        let pairs = self.knots.iter().zip(self.knots.iter().skip(1));
        pairs.map(|((from, start), (to, end))| PathInterval::between([*from, *to], start, end))
    }

    /// The states at the ends of the intervals, in order.
    pub(crate) fn ends(&self) -> impl Iterator<Item = (f64, &[f64])> {
        self.knots.iter().skip(1).map(|(time, state)| (*time, &state[..]))
    }

    fn bisect(&mut self, [from, to]: [f64; 2], end: &[f64], state_at: &mut StateAt<'_>) -> Result<(), Error> {
        let shortest = (to - from) * 0.5_f64.powi(self.divisions.cast_signed());
        let last = self.copy(end);
        // the states to the right, the nearest last
        let mut rights = std::mem::take(&mut self.rights);
        rights.clear();
        rights.push((to, last));
        while let Some(right) = rights.pop() {
            let knot @ (time, _) = self.knots.pop().expect("the start");
            let middle = f64::midpoint(time, right.0);
            let is_long = right.0 - time > 1.5 * shortest && middle > time && middle < right.0;
            let divided = if is_long { self.middle(&knot, &right, middle, state_at) } else { Ok(None) };
            self.knots.push(knot);
            match divided? {
                Some(between) => rights.extend([right, (middle, between)]),
                None => self.knots.push(right),
            }
        }
        self.rights = rights;
        Ok(())
    }

    /// The state in the middle of an interval, where the interpolant does not pass through it.
    fn middle(
        &mut self,
        (from, start): &(f64, Vec<f64>),
        (to, end): &(f64, Vec<f64>),
        middle: f64,
        state_at: &mut StateAt<'_>,
    ) -> Result<Option<Vec<f64>>, Error> {
        let mut between = self.spare.pop().unwrap_or_default();
        state_at(middle, &mut between)?;
        if self.comparison.is_reproduced([*from, *to], [start, end], (middle, &between))? {
            self.spare.push(between);
            return Ok(None);
        }
        Ok(Some(between))
    }
}

/// Compares states with the interpolant.
struct Comparison {
    /// Metres per unit of each position.
    weights: Vec<f64>,
    largest_weight: f64,
    /// Positions and rates that the parts before show.
    found: [Vec<f64>; 2],
}

impl Comparison {
    fn new(system: &System<'_>) -> Self {
        let joints = system.model.joints();
        let mut weights = vec![system.reach; 3 + joints + 3 * system.bodies.len()];
        for (i, weight) in weights.iter_mut().enumerate() {
            let of_body = if i < 3 { i } else { i.saturating_sub(3 + joints) % 3 };
            if of_body > 0 {
                *weight = 1.0;
            }
        }
        let found = [vec![0.0; weights.len()], vec![0.0; weights.len()]];
        Self { weights, largest_weight: system.reach.max(1.0), found }
    }

    /// Whether the interpolant is the motion over an interval of a length, s, with such fourth derivatives: it is off by no more than
    /// `h⁴ x⁗/384`, and in the rates by what is less with their lever.
    fn is_cubic(&self, length: f64, fourth_derivative: f64) -> bool {
        self.largest_weight * fourth_derivative * length.powi(4) <= 384.0 * TOLERANCE
    }

    /// Whether the interpolant between two states passes through one between them.
    fn is_reproduced(
        &self,
        span: [f64; 2],
        [start, end]: [&[f64]; 2],
        (time, between): (f64, &[f64]),
    ) -> Result<bool, Error> {
        let [start, end, between] = [split(start)?, split(end)?, split(between)?];
        let length = span[1] - span[0];
        let at = [(time - span[0]) / length, length];
        let [start, end, between] = [start, end, between].map(|state| (state.positions, state.rates));
        Ok(passes_through(&self.weights, at, start, end, between))
    }

    /// Whether positions and rates are those that were found within an interval of a length, s, where a share of their
    /// errors counts.
    fn is_found(&self, length: f64, [expected, expected_rates]: [&[f64]; 2], share: f64) -> bool {
        let [positions, rates] = &self.found;
        let found = self.weights.iter().zip(positions.iter().zip(rates)).zip(expected.iter().zip(expected_rates));
        found.fold(true, |are_near, ((weight, (x, v)), (expected, expected_rate))| {
            are_near & is_near(*weight, share, [*x, length * v], [*expected, length * expected_rate])
        })
    }
}

/// Whether the interpolant over an interval of a length, s, from positions and rates at its ends, passes through those of a state
/// at the part u of it. All are looked at, several at once.
#[multiversion(targets("x86_64+avx2"))]
fn passes_through(
    weights: &[f64],
    [u, length]: [f64; 2],
    (x, v): (&[f64], &[f64]),
    (y, w): (&[f64], &[f64]),
    (expected, expected_rates): (&[f64], &[f64]),
) -> bool {
    let ends = x.iter().zip(v).zip(y.iter().zip(w)).zip(weights);
    let mut are_near = true;
    for ((((x, v), (y, w)), weight), (expected, expected_rate)) in ends.zip(expected.iter().zip(expected_rates)) {
        let found = Cubic::new(length, [[*x, *v], [*y, *w]]).with_slope(u);
        are_near &= is_near(*weight, 1.0, found, [*expected, length * expected_rate]);
    }
    are_near
}

/// Whether a share of the errors of a position, of so many metres per unit, and of its change over an interval by its rate is small.
#[inline(always)]
#[allow(clippy::inline_always, reason = "its vectors are those of the caller")]
fn is_near(weight: f64, share: f64, [position, change]: [f64; 2], [expected, expected_change]: [f64; 2]) -> bool {
    // the largest position error of a rate error: a quarter of the interval at most
    let error = (position - expected).abs().max(0.125 * (change - expected_change).abs());
    weight * error * share <= TOLERANCE.max(weight * ROUNDING * expected.abs())
}

#[cfg(test)]
mod tests;
