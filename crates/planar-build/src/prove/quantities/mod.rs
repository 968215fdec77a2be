//! The differences of two models in each quantity of the table, in units of the quantity's natural size.
//!
//! # Example
//! ```
//! use planar_build::prove::generic::Generic;
//! use planar_build::prove::quantities::differences;
//! use planar_build::prove::sampling::Regime;
//! use planar_dynamics::quantity::Quantity;
//! use planar_layout::layout::Layout;
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
//! let layout = Layout::read(format!("{folder}/layouts/dual_arm_3r.toml").as_ref())?;
//! let sample = Regime::Moving.sample(&layout, 1, 0);
//! let mut heavier = sample.layout.clone();
//! heavier.base.mass *= 1.0 + 1e-6;
//! let (robot, other) = (Generic::new(&sample.layout), Generic::new(&heavier));
//! let own = differences(&robot, &robot, &sample).expect("a robot with masses");
//! assert!(own.iter().all(|difference| difference.error == 0.0));
//! // a millionth of a mass is more than rounding; poses do not depend on it
//! let found = differences(&other, &robot, &sample).expect("a robot with masses");
//! let ratio = |of| found.iter().find(|found| found.quantity == of).map(|found| found.ratio());
//! assert_eq!(ratio(Quantity::BodyPoses), Some(0.0));
//! assert!(ratio(Quantity::KineticEnergy).is_some_and(|ratio| ratio > 1e3));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod magnitudes;
mod natural_sizes;
mod system;

pub use natural_sizes::{NaturalSize, natural_sizes};

use crate::prove::evaluation::evaluate_all;
use crate::prove::owned::CloneModel;
use crate::prove::sampling::RegimeSample;
use planar_dynamics::error::Error;
use planar_dynamics::quantity::{Quantity, Rounding};
use planar_dynamics::scalar::Real;

/// The difference of two models in one quantity at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Which quantity.
    pub quantity: Quantity,
    /// Largest difference of an entry over the entry's natural size: the sum of the magnitudes that make it up.
    pub error: f64,
    /// Condition number of the matrices that were solved on the way, scaled to unit diagonals; 1 where none was.
    pub condition: f64,
}

impl Difference {
    /// What is allowed: 10⁻¹², or max(10⁻¹³, 8 ε condition) where equations are solved.
    #[must_use]
    pub fn bound(&self) -> f64 {
        match self.quantity.row().rounding {
            Rounding::Polynomial => 1e-12,
            Rounding::Solved => (8.0 * f64::EPSILON * self.condition).max(1e-13),
        }
    }

    /// Over 1 where the bound is exceeded.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.error / self.bound()
    }
}

/// The differences of two models in every quantity that a sample has; those of an impact only where it has a target. A model
/// of another scalar has the sample's numbers rounded to it.
///
/// # Errors
/// The errors of the models: of the first, the second, or both.
pub fn differences<T: Real>(
    model: &dyn CloneModel<T>,
    reference: &dyn CloneModel,
    sample: &RegimeSample,
) -> Result<Vec<Difference>, [Option<Error>; 2]> {
    let (found, expected) =
        match (evaluate_all(model, &sample.instant.rounded()), evaluate_all(reference, &sample.instant)) {
            (Ok(found), Ok(expected)) => (found, expected),
            (found, expected) => return Err([found.err(), expected.err()]),
        };
    let sizes = natural_sizes(sample, &expected);
    let each = sizes.into_iter().filter_map(|(quantity, NaturalSize { sizes, condition })| {
        let error = scaled_error(found.get(quantity)?, expected.get(quantity)?, &sizes);
        Some(Difference { quantity, error, condition })
    });
    Ok(each.collect())
}

/// Largest |a − b| over the entry's size, where 0/0 is 0; infinite where a value is missing or not a number.
pub(super) fn scaled_error(found: &[f64], expected: &[f64], sizes: &[f64]) -> f64 {
    if found.len() != expected.len() || found.len() != sizes.len() {
        return f64::INFINITY;
    }
    let scaled = found.iter().zip(expected).zip(sizes).map(|((a, b), size)| {
        let difference = (a - b).abs();
        if difference == 0.0 { 0.0 } else { difference / size }
    });
    // a NaN must not vanish in a maximum
    scaled.fold(0.0, |worst, error| if error.is_nan() { f64::INFINITY } else { error.max(worst) })
}
