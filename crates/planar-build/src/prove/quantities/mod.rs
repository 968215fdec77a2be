//! Every quantity of a model at one state: its values, its natural sizes, and how far two models are apart in it.

mod bounds;
mod quantity;
mod scale;
mod system;
mod values;

pub use quantity::{Class, QUANTITIES, Quantity};
pub use scale::{Scale, Scales};
pub use values::values;

use crate::prove::owned::CloneModel;
use crate::prove::sampling::Sample;
use planar_dynamics::error::Error;

/// How far two models are apart in one quantity at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Which quantity.
    pub quantity: &'static Quantity,
    /// Largest difference of an entry over the entry's natural size: the sum of the magnitudes that make it up.
    pub error: f64,
    /// Condition number of the matrices that were solved on the way, scaled to unit diagonals; 1 where none was.
    pub condition: f64,
}

impl Difference {
    /// What is allowed.
    #[must_use]
    pub fn bound(&self) -> f64 {
        self.quantity.class.bound(self.condition)
    }

    /// Over 1 where the bound is exceeded.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.error / self.bound()
    }
}

/// The differences of two models in every quantity that a sample has; those of an impact only where it has a target.
///
/// # Errors
/// What the models say of the state: the first's, the second's, or both.
pub fn differences(
    model: &dyn CloneModel,
    reference: &dyn CloneModel,
    sample: &Sample,
) -> Result<Vec<Difference>, [Option<Error>; 2]> {
    let (found, expected) = match (values(model, &sample.instant), values(reference, &sample.instant)) {
        (Ok(found), Ok(expected)) => (found, expected),
        (found, expected) => return Err([found.err(), expected.err()]),
    };
    let scales = Scales::new(sample, &expected).all();
    let pairs = found.iter().zip(&expected);
    let each = QUANTITIES.iter().zip(pairs.zip(&scales));
    Ok(each
        .filter_map(|(quantity, ((found, expected), scale))| {
            let (found, expected, scale) = (found.as_ref()?, expected.as_ref()?, scale.as_ref()?);
            let error = error(found, expected, &scale.sizes);
            Some(Difference { quantity, error, condition: scale.condition })
        })
        .collect())
}

/// Largest |a − b| over the entry's size; entries of size zero must be equal.
fn error(found: &[f64], expected: &[f64], sizes: &[f64]) -> f64 {
    if found.len() != expected.len() || found.len() != sizes.len() {
        return f64::INFINITY;
    }
    let entries = found.iter().zip(expected).zip(sizes);
    let scaled = entries.map(|((a, b), size)| {
        let difference = (a - b).abs();
        if difference == 0.0 { 0.0 } else { difference / size }
    });
    // a NaN must not vanish in a maximum
    scaled.fold(0.0, |worst, error| if error > worst || error.is_nan() { error } else { worst })
}
