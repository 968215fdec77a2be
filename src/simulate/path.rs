//! The path of a phase: positions and rates at knots, and the cubic Hermite interpolant between them.
//!
//! Knots are states of the simulation. A state is omitted where the interpolant through its neighbours reproduces it,
//! so that their number depends on how much the motion bends and not on the number of steps. Those of a long path are in
//! a file.
//!
//! # Example
//! ```
//! use planar_capture::simulate::path::{PathInterval, PathPart};
//!
//! // one position over one second, x = t³
//! let interval = PathInterval { span: [0.0, 1.0], start: [&[0.0], &[0.0]], end: [&[1.0], &[3.0]] };
//! let (mut position, mut rate, mut acceleration) = ([0.0], [0.0], [0.0]);
//! interval.at(0.5, &mut position, &mut rate);
//! assert_eq!((position, rate), ([0.125], [0.75]));
//! // the bounds are those of 3 t² and 6 t
//! interval.bounds(&[0.0], &mut rate, &mut acceleration);
//! assert_eq!((rate, acceleration), ([3.0], [6.0]));
//! ```

use crate::error::Error;
use crate::simulate::knots::Knots;
use crate::state::split;
use multiversion::multiversion;
use std::io;

/// Largest deviation of an omitted state from the interpolant, rad or m, for positions up to 1.
const TOLERANCE: f64 = 1e-10;
/// The largest rounding error of a change of positions, relative to these: of a step, of a state within the next one, and of
/// the frame that is integrated in.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Most states between two knots.
const MAX_WINDOW: usize = 64;

/// The positions and rates of a phase as functions of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    knots: Knots,
    /// Number of positions.
    size: usize,
}

/// The path between two knots.
#[derive(Clone, Copy, Debug)]
pub struct PathInterval<'a> {
    /// From and to, s.
    pub span: [f64; 2],
    /// Positions and rates at its start.
    pub start: [&'a [f64]; 2],
    /// At its end.
    pub end: [&'a [f64]; 2],
}

/// What a path has of an integrated vector: positions and rates, one after the other.
pub(super) fn path_state(x: &[f64]) -> &[f64] {
    let (halves, _) = x.split_at(x.len() - 3);
    halves
}

/// Numbers of a knot with so many positions: time, positions, rates.
fn record(size: usize) -> usize {
    1 + 2 * size
}

/// A part of a path over which its bodies are looked at.
pub trait PathPart {
    /// From and to, s.
    fn span(&self) -> [f64; 2];

    /// Rates at its start.
    fn first_rates(&self) -> &[f64];

    /// Positions and rates at a time within it, s.
    fn at(&self, time: f64, positions: &mut [f64], rates: &mut [f64]);

    /// Bounds of the magnitudes of the rates, less those of a `reference`, and of their derivatives.
    fn bounds(&self, reference: &[f64], rates: &mut [f64], accelerations: &mut [f64]);
}

/// Consecutive intervals of a path.
#[derive(Clone, Copy, Debug)]
pub struct PathWindow<'a> {
    /// Two or more, one after the other.
    knots: &'a [f64],
    /// Number of positions.
    size: usize,
}

impl PathWindow<'_> {
    fn record(&self) -> usize {
        record(self.size)
    }

    fn interval(&self, index: usize) -> PathInterval<'_> {
        let record = self.record();
        let [start, end] = [index, index + 1].map(|knot| &self.knots[knot * record..(knot + 1) * record]);
        let halves = |knot| <[&[f64]; 2]>::from(<[f64]>::split_at(knot, self.size));
        PathInterval { span: [start[0], end[0]], start: halves(&start[1..]), end: halves(&end[1..]) }
    }

    fn intervals(&self) -> impl Iterator<Item = PathInterval<'_>> {
        (0..self.knots.len() / self.record() - 1).map(|index| self.interval(index))
    }
}

impl PathPart for PathWindow<'_> {
    fn span(&self) -> [f64; 2] {
        [self.knots[0], self.knots[self.knots.len() - self.record()]]
    }

    fn first_rates(&self) -> &[f64] {
        &self.knots[1 + self.size..][..self.size]
    }

    fn at(&self, time: f64, positions: &mut [f64], rates: &mut [f64]) {
        // the last interval that starts before the time, or the first one
        let (mut index, mut end) = (0, self.knots.len() / self.record() - 1);
        while end - index > 1 {
            let middle = usize::midpoint(index, end);
            if self.knots[middle * self.record()] < time { index = middle } else { end = middle }
        }
        self.interval(index).at(time, positions, rates);
    }

    fn bounds(&self, reference: &[f64], rates: &mut [f64], accelerations: &mut [f64]) {
        rates.fill(0.0);
        accelerations.fill(0.0);
        for interval in self.intervals() {
            let PathInterval { span: [from, to], start, end } = interval;
            widen(to - from, start.into(), end.into(), reference, rates, accelerations);
        }
    }
}

impl Path {
    /// Calls `visit` with as many consecutive intervals, in order of time; now and then with fewer.
    ///
    /// # Errors
    /// Those of `visit`, and of the file in which a long path is.
    pub fn try_for_each_window<E: From<io::Error>>(
        &self,
        count: usize,
        mut visit: impl FnMut(PathWindow<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let size = self.size;
        self.knots.try_for_each_window(self.record(), count, |knots| visit(PathWindow { knots, size }))
    }

    /// Calls `visit` with its intervals, in order of time.
    ///
    /// # Errors
    /// Those of `visit`, and of the file in which a long path is.
    pub fn try_for_each<E: From<io::Error>>(
        &self,
        mut visit: impl FnMut(PathInterval<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        self.try_for_each_window(1, |window| window.intervals().try_for_each(&mut visit))
    }

    fn record(&self) -> usize {
        record(self.size)
    }

    fn push(&mut self, time: f64, state: &[f64]) {
        self.knots.push(time, state);
    }

    fn last(&self) -> Option<(f64, &[f64])> {
        self.knots.last(self.record())
    }
}

impl<'a> PathInterval<'a> {
    /// Of a step between two integrated vectors.
    ///
    /// # Errors
    /// [`Error::StateVector`].
    pub fn between(span: [f64; 2], start: &'a [f64], end: &'a [f64]) -> Result<Self, Error> {
        let (start, end) = (split(start)?, split(end)?);
        Ok(Self { span, start: [start.positions, start.rates], end: [end.positions, end.rates] })
    }

    /// A coordinate over this interval.
    fn cubic(&self, i: usize) -> Cubic {
        let length = self.span[1] - self.span[0];
        Cubic::new(length, [self.start, self.end].map(|[positions, rates]| [positions[i], rates[i]]))
    }

    /// The times within it, s, at which a coordinate or its rate is largest or smallest.
    pub(crate) fn extremes(&self, i: usize) -> [Option<f64>; 3] {
        let Cubic { first, second, third, .. } = self.cubic(i);
        // of the rate 3 third u² + 2 second u + first, without a difference of near numbers
        let root = (second * second - 3.0 * third * first).sqrt();
        let sum = -(second + root.copysign(second));
        let [start, end] = self.span;
        [first / sum, sum / (3.0 * third), -second / (3.0 * third)]
            .map(|u| (u > 0.0 && u < 1.0).then_some(start + u * (end - start)))
    }

    /// A coordinate and its rate at a time within it, s.
    pub(crate) fn coordinate_at(&self, i: usize, time: f64) -> [f64; 2] {
        let length = self.span[1] - self.span[0];
        self.cubic(i).at((time - self.span[0]) / length, length)
    }
}

/// A coordinate over an interval: start + u (first + u (second + u third)) over the part u of it.
pub(super) struct Cubic {
    start: f64,
    first: f64,
    second: f64,
    third: f64,
}

impl Cubic {
    /// From the coordinate and its rate at the ends of an interval of a length, s.
    #[inline]
    pub(super) fn new(length: f64, ends @ [[start, v], [_, w]]: [[f64; 2]; 2]) -> Self {
        let bend = bend(length, ends);
        let [first, last] = [length * v, length * w];
        Self { start, first, second: 0.5 * (last - first) + 3.0 * bend, third: -2.0 * bend }
    }

    /// The coordinate and its rate.
    #[inline]
    fn at(&self, u: f64, length: f64) -> [f64; 2] {
        let [position, slope] = self.with_slope(u);
        [position, slope / length]
    }

    /// The coordinate and its change over the interval by its rate.
    #[inline]
    pub(super) fn with_slope(&self, u: f64) -> [f64; 2] {
        let Self { first, second, third, .. } = self;
        [self.position(u), first + u * (2.0 * second + u * 3.0 * third)]
    }

    #[inline]
    fn position(&self, u: f64) -> f64 {
        let Self { start, first, second, third } = self;
        start + u * (first + u * (second + u * third))
    }
}

/// The change of a coordinate less that by the mean of the rates at the ends; 0 where it is a rounding error of
/// positions, which over a short time would be a fast motion.
#[inline]
fn bend(length: f64, [[start, v], [end, w]]: [[f64; 2]; 2]) -> f64 {
    let bend = end - start - 0.5 * length * (v + w);
    if bend.abs() <= ROUNDING * start.abs().max(end.abs()) { 0.0 } else { bend }
}

/// The coordinates over the part u of an interval of a length, s, and their rates, from these at its ends. The slices are
/// arguments each, so that the compiler knows them apart and takes several coordinates at once.
#[multiversion(targets("x86_64+avx2"))]
fn fill(
    [u, length]: [f64; 2],
    (x, v): (&[f64], &[f64]),
    (y, w): (&[f64], &[f64]),
    positions: &mut [f64],
    rates: &mut [f64],
) {
    let ends = x.iter().zip(v).zip(y.iter().zip(w));
    for (((x, v), (y, w)), (position, rate)) in ends.zip(positions.iter_mut().zip(rates)) {
        [*position, *rate] = Cubic::new(length, [[*x, *v], [*y, *w]]).at(u, length);
    }
}

/// Whether the coordinates over the part u of an interval of a length, s, from these and their rates at its ends are those of a
/// state, which begins with them. All are looked at, several at once.
#[multiversion(targets("x86_64+avx2"))]
fn are_near([u, length]: [f64; 2], (x, v): (&[f64], &[f64]), (y, w): (&[f64], &[f64]), state: &[f64]) -> bool {
    let ends = x.iter().zip(v).zip(y.iter().zip(w));
    let mut are_near = true;
    for (((x, v), (y, w)), value) in ends.zip(state) {
        let found = Cubic::new(length, [[*x, *v], [*y, *w]]).position(u);
        are_near &= (found - value).abs() <= TOLERANCE * value.abs().max(1.0);
    }
    are_near
}

/// Widens bounds of the magnitudes of rates, less those of a reference, and of their derivatives, to those over an interval:
/// the control points of the interpolant's derivatives in Bernstein form.
#[multiversion(targets("x86_64+avx2"))]
fn widen(
    length: f64,
    (x, v): (&[f64], &[f64]),
    (y, w): (&[f64], &[f64]),
    reference: &[f64],
    rates: &mut [f64],
    accelerations: &mut [f64],
) {
    let ends = x.iter().zip(v).zip(y.iter().zip(w)).zip(reference);
    for ((((x, v), (y, w)), reference), (rate, acceleration)) in ends.zip(rates.iter_mut().zip(accelerations)) {
        let bend = 3.0 * bend(length, [[*x, *v], [*y, *w]]) / length;
        let [v, w] = [v - reference, w - reference];
        let half = 0.5 * (w - v);
        *rate = rate.max(v.abs().max(w.abs()).max((0.5 * (v + w) + bend).abs()));
        *acceleration = acceleration.max((half + bend).abs().max((half - bend).abs()) * 2.0 / length);
    }
}

impl PathPart for PathInterval<'_> {
    fn span(&self) -> [f64; 2] {
        self.span
    }

    fn first_rates(&self) -> &[f64] {
        self.start[1]
    }

    fn at(&self, time: f64, positions: &mut [f64], rates: &mut [f64]) {
        let length = self.span[1] - self.span[0];
        fill([(time - self.span[0]) / length, length], self.start.into(), self.end.into(), positions, rates);
    }

    fn bounds(&self, reference: &[f64], rates: &mut [f64], accelerations: &mut [f64]) {
        rates.fill(0.0);
        accelerations.fill(0.0);
        widen(self.span[1] - self.span[0], self.start.into(), self.end.into(), reference, rates, accelerations);
    }
}

/// Records a path while a phase runs.
#[derive(Clone, Debug)]
pub(crate) struct PathRecorder {
    path: Path,
    /// Times since the last knot.
    times: Vec<f64>,
    /// The states at these times, one after the other.
    states: Vec<f64>,
}

impl PathRecorder {
    /// For states whose positions and rates are `2 * size` numbers, of which so many are expected to be knots.
    pub(crate) fn new(size: usize, knots: usize) -> Self {
        let path = Path { knots: Knots::expecting(knots.saturating_mul(record(size))), size };
        Self { path, times: Vec::new(), states: Vec::new() }
    }

    /// Adds a state: positions, then rates.
    pub(crate) fn record(&mut self, time: f64, state: &[f64]) {
        if self.path.last().is_none() {
            return self.path.push(time, state);
        }
        if self.times.len() >= MAX_WINDOW || !self.is_reproduced(time, state) {
            self.push_last();
        }
        self.times.push(time);
        self.states.extend_from_slice(state);
    }

    /// Makes the last state a knot.
    fn push_last(&mut self) {
        if let Some(time) = self.times.last() {
            let (_, state) = self.states.split_at(self.states.len() - 2 * self.path.size);
            self.path.push(*time, state);
        }
        self.times.clear();
        self.states.clear();
    }

    /// Whether the interpolant from the last knot to this state passes through the states between them.
    fn is_reproduced(&self, time: f64, state: &[f64]) -> bool {
        let Self { path, times, states } = self;
        let middle = times.len() / 2;
        let (Some(at), Some((start, knot))) = (times.get(middle), path.last()) else { return true };
        let size = path.size;
        let length = time - start;
        are_near(
            [(at - start) / length, length],
            knot.split_at(size),
            state.split_at(size),
            &states[2 * size * middle..],
        )
    }

    /// The path up to the last state.
    pub(crate) fn end(mut self) -> Path {
        self.push_last();
        self.path
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(motion: impl Fn(f64) -> [f64; 2], steps: u32) -> Path {
        let mut recorder = PathRecorder::new(1, 0);
        for i in 0..=steps {
            let time = f64::from(i) / f64::from(steps);
            recorder.record(time, &motion(time));
        }
        recorder.end()
    }

    fn times(path: &Path) -> Vec<f64> {
        let mut times = Vec::new();
        let visited = path.try_for_each(|interval| {
            times.extend((times.is_empty()).then_some(interval.span[0]));
            times.push(interval.span[1]);
            io::Result::Ok(())
        });
        visited.expect("a path");
        times
    }

    /// Of s (s - 1) (s - 2), s from 0 to 2, the extremes are 1/√3 beside the middle, and the rate is least there.
    #[test]
    fn extremes_are_those_of_the_cubic_and_of_its_rate() {
        let interval =
            |of: [&'static [f64]; 2]| PathInterval { span: [2.0, 4.0], start: [of[0], of[1]], end: [of[0], of[1]] };
        let mut found: Vec<f64> = interval([&[0.0], &[2.0]]).extremes(0).into_iter().flatten().collect();
        found.sort_by(f64::total_cmp);
        let beside = 1.0 / 3.0_f64.sqrt();
        assert_eq!(found.len(), 3, "{found:?}");
        for (time, expected) in found.iter().zip([3.0 - beside, 3.0, 3.0 + beside]) {
            assert!((time - expected).abs() < 1e-14, "{found:?}");
        }
        // a coordinate at rest has none within
        assert_eq!(interval([&[1.0], &[0.0]]).extremes(0).into_iter().flatten().count(), 0);
    }

    #[test]
    fn the_interpolant_reproduces_the_omitted_states() {
        let motion = |t: f64| [(3.0 * t).sin(), 3.0 * (3.0 * t).cos()];
        let path = record(motion, 4000);
        let times = times(&path);
        assert!(times.len() < 400, "{} knots", times.len());
        assert_eq!((times[0], times[times.len() - 1]), (0.0, 1.0));
        let compared = path.try_for_each(|interval| {
            let [start, end] = interval.span;
            for part in [0.0, 0.1, 0.3, 0.5, 0.8, 1.0] {
                let time = start + part * (end - start);
                let (mut position, mut rate) = ([0.0], [0.0]);
                interval.at(time, &mut position, &mut rate);
                let [exact, exact_rate] = motion(time);
                assert!((position[0] - exact).abs() < 2.0 * TOLERANCE, "{time}: {}", position[0] - exact);
                assert!((rate[0] - exact_rate).abs() < 1e-6, "{time}: {}", rate[0] - exact_rate);
                let (mut largest, mut acceleration) = ([0.0], [0.0]);
                interval.bounds(&[0.0], &mut largest, &mut acceleration);
                assert!(rate[0].abs() <= largest[0] + 1e-9, "{time}: {} > {}", rate[0], largest[0]);
                assert!(acceleration[0] >= 9.0 * exact.abs() - 0.02, "{time}: {}", acceleration[0]);
            }
            io::Result::Ok(())
        });
        compared.expect("a path");
    }

    /// Far from zero, and with another coordinate beside it, a motion has as few knots.
    #[test]
    fn knots_are_as_few_anywhere() {
        let mut recorder = PathRecorder::new(2, 0);
        for i in 0..=4000 {
            let (sin, cos) = (3.0 * f64::from(i) / 4000.0).sin_cos();
            recorder.record(f64::from(i) / 4000.0, &[1e6 + sin, 2.0, 3.0 * cos, 0.0]);
        }
        let knots = times(&recorder.end()).len();
        assert!((60..400).contains(&knots), "{knots} knots");
    }

    /// Where a step ends just before a row, the interval between them is as short as a rounding error of the time.
    #[test]
    fn an_interval_of_no_time_has_the_rates_of_its_ends() {
        for (x, length) in [(3.0, 1e-14), (3.0, 1e-11), (-700.0, 1e-13), (1e6, 1e-9), (1e-3, 1e-12)] {
            for ulps in [-2.0, -1.0, 0.0, 1.0, 2.0] {
                let (start, rates) = ([x], [0.1, 0.1 + 1e-15]);
                let end = [x + 0.1 * length + ulps * f64::EPSILON * x];
                let interval =
                    PathInterval { span: [0.0, length], start: [&start, &rates[..1]], end: [&end, &rates[1..]] };
                let times = interval.extremes(0).into_iter().flatten().chain([0.3 * length, 0.8 * length]);
                for rate in times.map(|time| interval.coordinate_at(0, time)[1]) {
                    assert!((rate - 0.1).abs() < 1e-12, "{x} {length} {ulps}: {rate}");
                }
                let (mut rate, mut acceleration) = ([0.0], [0.0]);
                interval.bounds(&[0.0], &mut rate, &mut acceleration);
                assert!(rate[0] < 0.1 + 1e-12 && acceleration[0] <= 2e-15 / length, "{x} {length}: {acceleration:?}");
            }
        }
    }

    #[test]
    fn a_kink_is_a_knot() {
        let path = record(|t| if t < 0.5 { [0.0, 0.0] } else { [2.0 * (t - 0.5), 2.0] }, 100);
        assert!(times(&path).iter().any(|t| (t - 0.5).abs() < 0.011), "{:?}", times(&path));
    }
}
