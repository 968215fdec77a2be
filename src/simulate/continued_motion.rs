//! The motion within a part of a step from the states at its ends and at those of the parts before it.
//!
//! Positions and rates at three times determine a polynomial of degree 5. With the ends of the last three parts at
//! `t₀ < t₁ < t₂` and `t₃`, that through t₀, t₁ and t₃ is off by `∏ (t − tᵢ)² x⁽⁶⁾/6!`, which the state at t₂ shows; and that
//! through t₁, t₂ and t₃ by less between t₂ and t₃, for parts of equal length by a twenty-seventh. So a smooth motion needs
//! no state within the part.

use std::array::from_fn;

/// Ends of parts that are kept.
const KEPT: usize = 3;
/// Least length of the parts before, in lengths of the part that they continue: differences of nearer ends are rounded, and
/// divided by their distance three times.
const LEAST: f64 = 0.125;
/// Factors of a polynomial of degree 5.
const FACTORS: usize = 6;

/// The ends of the last parts, and the polynomials through them.
#[derive(Clone, Debug, Default)]
pub(super) struct ContinuedMotion {
    /// Times and states, positions and then rates, in order; the last one is the end of the part.
    ends: Vec<(f64, Vec<f64>)>,
    /// The three times, each twice.
    nodes: [f64; FACTORS],
    /// Divided differences at the nodes, for each position.
    differences: Vec<[f64; FACTORS]>,
}

impl ContinuedMotion {
    /// Adds a part, from and to (s), with the states at its ends: positions, then rates. It forgets those before where they
    /// do not end where it starts.
    pub(super) fn push(&mut self, [from, to]: [f64; 2], [start, end]: [&[f64]; 2]) {
        if self.ends.last().is_none_or(|(time, _)| time.to_bits() != from.to_bits()) {
            self.ends.clear();
            self.ends.push((from, start.to_vec()));
        }
        let mut state = if self.ends.len() > KEPT { self.ends.remove(0).1 } else { Vec::new() };
        state.clear();
        state.extend_from_slice(end);
        self.ends.push((to, state));
    }

    /// Positions and rates at the start of the part by the other ends, into the last argument, and which share of their
    /// errors is left where the start is known; `None` with too few ends, or too near ones.
    pub(super) fn start_by_others(&mut self, found: [&mut [f64]; 2]) -> Option<f64> {
        let ends = self.ends.first_chunk::<4>()?;
        let [first, second, start, end] = ends.each_ref().map(|(time, _)| *time);
        if (second - first).min(start - second) < LEAST * (end - start) {
            return None;
        }
        self.interpolate([0, 1, 3]);
        self.at(start, found);
        // (t - t₁)(t - t₂)(t₃ - t) is no more than (t₃ - t₁)(t₃ - t₂)²/4 between t₂ and t₃
        let ratio = 0.25 * (end - second) * (end - start) / ((start - first) * (start - second));
        Some(ratio * ratio)
    }

    /// Prepares the states [`at`](Self::at) times within the part.
    pub(super) fn follow(&mut self) {
        self.interpolate([1, 2, 3]);
    }

    /// The polynomials through three of the ends, by divided differences.
    fn interpolate(&mut self, indices: [usize; 3]) {
        let ends = indices.map(|i| &self.ends[i]);
        let [from, middle, to] = ends.map(|(time, _)| *time);
        self.nodes = [from, from, middle, middle, to, to];
        let size = ends[0].1.len() / 2;
        let nodes = self.nodes;
        let by = |k: usize, order: usize| 1.0 / (nodes[k] - nodes[k - order]);
        let [first, second] = [by(2, 1), by(4, 1)];
        // of orders from 2, at those indices that have differences of them; divisions take longer than all else
        let factors: [[f64; FACTORS]; FACTORS - 2] =
            from_fn(|i| from_fn(|k| if k >= i + 2 { by(k, i + 2) } else { 0.0 }));
        self.differences.clear();
        self.differences.extend((0..size).map(|i| {
            let [x, rates] = [i, size + i].map(|i| ends.map(|(_, state)| state[i]));
            let slopes = [(x[1] - x[0]) * first, (x[2] - x[1]) * second];
            // of two equal nodes it is the rate
            let mut differences = [x[0], rates[0], slopes[0], rates[1], slopes[1], rates[2]];
            for (order, factors) in (2..).zip(&factors) {
                for k in (order..FACTORS).rev() {
                    differences[k] = (differences[k] - differences[k - 1]) * factors[k];
                }
            }
            differences
        }));
    }

    /// Positions and rates at a time, s.
    pub(super) fn at(&self, time: f64, [positions, rates]: [&mut [f64]; 2]) {
        for (differences, (position, rate)) in self.differences.iter().zip(positions.iter_mut().zip(rates)) {
            (*position, *rate) = (0.0, 0.0);
            for (difference, node) in differences.iter().zip(&self.nodes).rev() {
                *rate = *rate * (time - node) + *position;
                *position = *position * (time - node) + difference;
            }
        }
    }
}
