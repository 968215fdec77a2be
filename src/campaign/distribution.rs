//! Distributions of varied values, drawn by their quantile functions.
//!
//! # Example
//! ```
//! use planar_capture::campaign::distribution::{Distribution, Kind};
//!
//! let mass = Distribution { kind: Kind::Uniform { min: 8.0, max: 12.0 }, bounds: [f64::NEG_INFINITY, 11.0] };
//! assert_eq!(mass.mass_within_bounds(), 0.75);
//! assert_eq!(mass.quantile(0.5).number(), Some(9.5)); // kg, in the middle of what the bound leaves
//! ```

use super::normal;
use crate::scenario::variation::VariedValue;
use std::fmt::{self, Display, Formatter};

/// How a value varies, truncated where it has bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// Untruncated.
    pub kind: Kind,
    /// Smallest and largest value; infinite without a bound.
    pub bounds: [f64; 2],
}

/// A distribution without bounds.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// With mean and standard deviation.
    Normal {
        /// In the variable's unit.
        mean: f64,
        /// Greater than 0.
        std: f64,
    },
    /// Between two values.
    Uniform {
        /// Smallest.
        min: f64,
        /// Largest, greater than that.
        max: f64,
    },
    /// Of a positive variable whose logarithm is normal.
    LogNormal {
        /// Of the variable itself, greater than 0.
        mean: f64,
        /// Of the variable itself, greater than 0.
        std: f64,
    },
    /// With a density that rises from `min` to `mode` and falls to `max`, linearly.
    Triangular {
        /// Smallest.
        min: f64,
        /// Most likely.
        mode: f64,
        /// Largest, greater than the smallest.
        max: f64,
    },
    /// Values that are equally likely, at least one.
    Choice(Vec<VariedValue>),
}

/// In words: `normal, mean 10, standard deviation 1, at least 5`.
impl Display for Distribution {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.kind {
            Kind::Normal { mean, std } => write!(f, "normal, mean {mean}, standard deviation {std}"),
            Kind::LogNormal { mean, std } => write!(f, "lognormal, mean {mean}, standard deviation {std}"),
            Kind::Uniform { min, max } => write!(f, "uniform from {min} to {max}"),
            Kind::Triangular { min, mode, max } => write!(f, "triangular from {min} to {max}, most likely {mode}"),
            Kind::Choice(values) => {
                let values: Vec<_> = values.iter().map(ToString::to_string).collect();
                write!(f, "one of {}", values.join(", "))
            }
        }?;
        let [low, high] = self.bounds;
        if low.is_finite() {
            write!(f, ", at least {low}")?;
        }
        if high.is_finite() {
            write!(f, ", at most {high}")?;
        }
        Ok(())
    }
}

impl Distribution {
    /// The value at a probability, 0 < u < 1.
    #[must_use]
    pub fn quantile(&self, u: f64) -> VariedValue {
        let [low, high] = self.bounds;
        let value = match &self.kind {
            Kind::Choice(values) => return values[choice(u, values.len())].clone(),
            Kind::Normal { mean, std } => {
                let [a, b] = [low, high].map(|bound| (bound - mean) / std);
                mean + std * truncated_normal(u, [a, b])
            }
            Kind::LogNormal { mean, std } => {
                let [location, scale] = of_logarithm(*mean, *std);
                // there is nothing below 0
                let [a, b] = [low, high].map(|bound| (libm::log(bound.max(0.0)) - location) / scale);
                libm::exp(location + scale * truncated_normal(u, [a, b]))
            }
            Kind::Uniform { min, max } => {
                let (from, to) = (min.max(low), max.min(high));
                from + u * (to - from)
            }
            Kind::Triangular { min, mode, max } => truncated_triangular(u, [*min, *mode, *max], self.bounds),
        };
        VariedValue::Number(value.clamp(low, high))
    }

    /// The probability that the bounds leave of the distribution; a choice has no bounds.
    #[must_use]
    pub fn mass_within_bounds(&self) -> f64 {
        let [low, high] = self.bounds;
        let between = |cumulative: &dyn Fn(f64) -> f64| cumulative(high) - cumulative(low);
        match &self.kind {
            Kind::Choice(_) => 1.0,
            Kind::Normal { mean, std } => normal_mass([low, high].map(|bound| (bound - mean) / std)),
            Kind::LogNormal { mean, std } => {
                let [location, scale] = of_logarithm(*mean, *std);
                normal_mass([low, high].map(|bound| (libm::log(bound.max(0.0)) - location) / scale))
            }
            Kind::Uniform { min, max } => between(&|x| ((x - min) / (max - min)).clamp(0.0, 1.0)),
            Kind::Triangular { min, mode, max } => triangular_mass([*min, *mode, *max], self.bounds),
        }
    }

    /// The number of different values; `None` for a continuous distribution.
    #[must_use]
    pub fn choices(&self) -> Option<usize> {
        match &self.kind {
            Kind::Choice(values) => Some(values.len()),
            _ => None,
        }
    }
}

/// Index of the choice at a probability.
#[must_use]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "a sweep has no 2⁵² choices"
)]
fn choice(u: f64, count: usize) -> usize {
    ((u * count as f64) as usize).min(count - 1)
}

/// The probability between two standard normal values, by the tail on their side of 0.
fn normal_mass([a, b]: [f64; 2]) -> f64 {
    if a > 0.0 {
        normal::cumulative(-a) - normal::cumulative(-b)
    } else {
        normal::cumulative(b) - normal::cumulative(a)
    }
}

/// Standard normal between a and b; where both are above 0 by the mirrored distribution, as 1 − p has lost the digits of
/// a small p.
fn truncated_normal(u: f64, [a, b]: [f64; 2]) -> f64 {
    if a > 0.0 {
        return -truncated_normal(1.0 - u, [-b, -a]);
    }
    let (from, to) = (normal::cumulative(a), normal::cumulative(b));
    normal::quantile(from + u * (to - from))
}

/// Triangular between two bounds; where both are above the mode by the mirrored distribution, as for the normal one.
fn truncated_triangular(u: f64, corners: [f64; 3], bounds: [f64; 2]) -> f64 {
    if bounds[0] > corners[1] {
        return -truncated_triangular(1.0 - u, mirrored(corners), mirrored(bounds));
    }
    let [from, to] = bounds.map(|bound| triangular(corners, bound));
    triangular_quantile(corners, from + u * (to - from))
}

/// The probability between two bounds, by the tail on their side of the mode.
fn triangular_mass(corners: [f64; 3], bounds: [f64; 2]) -> f64 {
    if bounds[0] > corners[1] {
        return triangular_mass(mirrored(corners), mirrored(bounds));
    }
    let [from, to] = bounds.map(|bound| triangular(corners, bound));
    to - from
}

/// Of the negative variable, in ascending order.
fn mirrored<const N: usize>(mut values: [f64; N]) -> [f64; N] {
    values.reverse();
    values.map(|value| -value)
}

/// Mean and standard deviation of the logarithm.
fn of_logarithm(mean: f64, std: f64) -> [f64; 2] {
    let ratio = std / mean;
    let variance = libm::log1p(ratio * ratio);
    [libm::log(mean) - 0.5 * variance, libm::sqrt(variance)]
}

/// The probability of a value below x.
fn triangular([min, mode, max]: [f64; 3], x: f64) -> f64 {
    if x <= min {
        0.0
    } else if x >= max {
        1.0
    } else if x < mode {
        (x - min) / (max - min) * ((x - min) / (mode - min))
    } else {
        1.0 - (max - x) / (max - min) * ((max - x) / (max - mode))
    }
}

fn triangular_quantile([min, mode, max]: [f64; 3], p: f64) -> f64 {
    if p * (max - min) < mode - min {
        min + libm::sqrt(p * (max - min) * (mode - min))
    } else {
        max - libm::sqrt((1.0 - p) * (max - min) * (max - mode))
    }
}

#[cfg(test)]
mod tests;
