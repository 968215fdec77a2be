//! The continuation of the last step: polynomials of time near the motion over the next one.
//!
//! The sums of ẋ for the first stages are exact for lower powers of time than those of the others are. Where feedback is
//! fast beside the motion, what they miss of the motion limits the step (Prothero & Robinson 1974), long before the
//! motion itself does. With x = p + y the method takes the step of y, and p, a polynomial, is exact: the stages get what
//! their sums miss of p. Any p will do, and the nearer it is to x, the smaller is y.

use super::blocks::{BLOCK, Blocks};
use super::pair::Pair;

/// The polynomials.
#[derive(Debug, Default)]
pub(super) struct Continuation {
    /// Factors of the second to the fifth power of time, in lengths of the last step.
    coefficients: [Blocks; 4],
    /// Length of the last step, s; 0 where there is none.
    length: f64,
}

impl Continuation {
    /// For vectors of this many blocks, without a last step.
    pub(super) fn reset(&mut self, blocks: usize) {
        for vector in &mut self.coefficients {
            vector.clear();
            vector.resize(blocks, [0.0; BLOCK]);
        }
        self.length = 0.0;
    }

    /// Continues a step of a length, s, by the ẋ of its stages and at its end.
    pub(super) fn follow(&mut self, pair: &Pair, length: f64, stages: &[[f64; BLOCK]], end: &[[f64; BLOCK]]) {
        self.length = length;
        for (coefficients, weights) in self.coefficients.iter_mut().zip(&pair.continuing) {
            for (i, block) in coefficients.iter_mut().enumerate() {
                *block = [0.0; BLOCK];
                for (stage, weight) in pair.continued.iter().zip(weights) {
                    let rate = if *stage == pair.stages { &end[i] } else { &stages[stage * end.len() + i] };
                    block.iter_mut().zip(rate).for_each(|(sum, rate)| *sum += length * weight * rate);
                }
            }
        }
    }

    /// Adds what the sums of a stage of the next step, of another length, s, miss of the polynomials.
    pub(super) fn correct(&self, step: f64, defects: &[f64; 4], at: &mut Blocks) {
        if self.length == 0.0 {
            return;
        }
        let ratio = step / self.length;
        let mut power = ratio;
        for (coefficients, defect) in self.coefficients.iter().zip(defects) {
            power *= ratio;
            if *defect == 0.0 {
                continue;
            }
            let entries = at.as_flattened_mut().iter_mut().zip(coefficients.as_flattened());
            entries.for_each(|(at, coefficient)| *at += power * defect * coefficient);
        }
    }
}

#[cfg(test)]
mod tests;
