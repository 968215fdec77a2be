//! Generated against generic: random states by regime, every quantity, errors in natural units.

mod bounds;
mod quantity;
mod regime;
mod replay;
mod scale;
mod system;
mod values;

pub use quantity::{Class, QUANTITIES, Quantity};
pub use regime::{REGIMES, Regime, Sample};
pub use replay::{layout_text, states_text};

use crate::error::Error;
use crate::layout::Layout;
use crate::models::{NoModel, generated, generic};
use crate::owned::CloneModel;
#[allow(unused_imports, reason = "for reference vectors, which come with the feature `build`")]
pub(crate) use scale::{Scale, Scales};
pub(crate) use values::values;

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

/// The worst that was found in one quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// How far, compared with its bound.
    pub difference: Difference,
    /// In which regime.
    pub regime: Regime,
    /// Which of its samples.
    pub index: u64,
    /// Layout and state.
    pub sample: Sample,
}

/// A state that one implementation has no answer for.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// In which regime.
    pub regime: Regime,
    /// Which of its samples.
    pub index: u64,
    /// What the generated code says.
    pub generated: Option<Error>,
    /// What the generic implementation says.
    pub generic: Option<Error>,
}

/// The outcome for one layout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Number of states compared.
    pub states: u64,
    /// One per quantity, in the order of [`QUANTITIES`], by the ratio of error and bound.
    pub worst: Vec<Worst>,
    /// States without an answer from one or both.
    pub refusals: Vec<Refusal>,
}

impl Comparison {
    /// Whether every error is within its bound, and both implementations have answers for the same states.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.worst.len() == QUANTITIES.len()
            && self.worst.iter().all(|worst| worst.difference.ratio() <= 1.0)
            && self.refusals.iter().all(|refusal| refusal.generated.is_some() && refusal.generic.is_some())
    }

    fn record(&mut self, worst: Worst) {
        let rank = |quantity: &Quantity| QUANTITIES.iter().position(|q| q.name == quantity.name);
        let new = rank(worst.difference.quantity);
        match self.worst.binary_search_by_key(&new, |old| rank(old.difference.quantity)) {
            Err(place) => self.worst.insert(place, worst),
            Ok(place) => {
                let Some(old) = self.worst.get_mut(place) else { return };
                let (ratio, beaten) = (worst.difference.ratio(), old.difference.ratio());
                if ratio > beaten || ratio.is_nan() {
                    *old = worst;
                }
            }
        }
    }
}

/// Compares the implementations for a layout at `samples` states of every regime; the same seed, the same states.
///
/// # Errors
/// [`NoModel`] where no generated code has the layout's structure.
pub fn compare(layout: &Layout, samples: u64, seed: u64) -> Result<Comparison, NoModel> {
    let mut comparison = Comparison::default();
    for regime in REGIMES {
        for index in 0..samples {
            let sample = regime.sample(layout, seed, index);
            let (model, reference) = (generated(&sample.layout)?, generic(&sample.layout));
            comparison.states += 1;
            match differences(&*model, &*reference, &sample) {
                Ok(differences) => {
                    for difference in differences {
                        comparison.record(Worst { difference, regime, index, sample: sample.clone() });
                    }
                }
                Err([generated, generic]) => {
                    comparison.refusals.push(Refusal { regime, index, generated, generic });
                }
            }
        }
    }
    Ok(comparison)
}
