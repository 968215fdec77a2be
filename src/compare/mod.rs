//! Generated code against the generic implementation: random states by regime, every quantity, errors in natural units.

mod replay;

pub use replay::states_text;

use crate::error::Error;
use crate::layout::Layout;
use crate::quantities::{Difference, differences};
use crate::quantity::Quantity;
use crate::registry::{NoModel, generated, generic};
use crate::sampling::{REGIMES, Regime, RegimeSample};

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
    pub sample: RegimeSample,
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
    /// One per quantity, in the order of [`Quantity::ALL`], by the ratio of error and bound.
    pub worst: Vec<Worst>,
    /// States without an answer from one or both.
    pub refusals: Vec<Refusal>,
}

impl Comparison {
    /// Whether every error is within its bound, and both implementations have answers for the same states.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.worst.len() == Quantity::ALL.len()
            && self.worst.iter().all(|worst| worst.difference.ratio() <= 1.0)
            && self.refusals.iter().all(|refusal| refusal.generated.is_some() && refusal.generic.is_some())
    }

    fn record(&mut self, worst: Worst) {
        match self.worst.binary_search_by_key(&worst.difference.quantity, |old| old.difference.quantity) {
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
