//! Compares generated code, or a graph, with the generic implementation: every quantity at random states of every regime, errors
//! relative to the natural size of each entry.
//!
//! # Example
//! ```
//! use planar_capture::compare::compare;
//! use planar_capture::engine::Choice;
//! use planar_capture::layout::Layout;
//! use planar_capture::quantity::Quantity;
//! use planar_capture::sampling::REGIMES;
//!
//! let layout = Layout::read("codegen/layouts/single_arm_3r.toml".as_ref())?;
//! let comparison = compare(&layout, &Choice::graph(&layout)?, 2, 7);
//! assert_eq!(comparison.states, 2 * REGIMES.len() as u64);
//! assert_eq!(comparison.largest_errors.len(), Quantity::ALL.len());
//! assert!(comparison.agrees());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::engine::Choice;
use crate::error::Error;
use crate::layout::Layout;
use crate::quantities::{Difference, differences};
use crate::quantity::Quantity;
use crate::registry::generic;
use crate::sampling::{REGIMES, Regime, RegimeSample};

/// The largest error of one quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct LargestError {
    /// Error and bound.
    pub difference: Difference,
    /// The regime of the state.
    pub regime: Regime,
    /// Its number in the regime.
    pub index: u64,
    /// Layout and state.
    pub sample: RegimeSample,
}

/// A state without result from at least one implementation.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// The regime of the state.
    pub regime: Regime,
    /// Its number in the regime.
    pub index: u64,
    /// The error of the generated code.
    pub generated: Option<Error>,
    /// The error of the generic implementation.
    pub generic: Option<Error>,
}

/// The comparison for one layout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Number of states compared.
    pub states: u64,
    /// One per quantity, in the order of [`Quantity::ALL`], by the ratio of error and bound.
    pub largest_errors: Vec<LargestError>,
    /// States without result from one or both implementations.
    pub refusals: Vec<Refusal>,
}

impl Comparison {
    /// Whether every quantity was compared, every error is within its bound, and both implementations refuse the same
    /// states.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.largest_errors.len() == Quantity::ALL.len()
            && self.largest_errors.iter().all(|largest| largest.difference.ratio() <= 1.0)
            && self.refusals.iter().all(|refusal| refusal.generated.is_some() && refusal.generic.is_some())
    }

    fn record(&mut self, new: LargestError) {
        let errors = &mut self.largest_errors;
        match errors.binary_search_by_key(&new.difference.quantity, |old| old.difference.quantity) {
            Err(place) => errors.insert(place, new),
            Ok(place) => {
                let ratio = new.difference.ratio();
                if ratio > errors[place].difference.ratio() || ratio.is_nan() {
                    errors[place] = new;
                }
            }
        }
    }
}

/// Compares the implementations for a layout at `samples` states of every regime; equal seeds give equal states.
#[must_use]
pub fn compare(layout: &Layout, choice: &Choice, samples: u64, seed: u64) -> Comparison {
    let mut comparison = Comparison::default();
    for regime in REGIMES {
        for index in 0..samples {
            let sample = regime.sample(layout, seed, index);
            let (model, reference) = (choice.model(&sample.layout), generic(&sample.layout));
            comparison.states += 1;
            match differences(&*model, &*reference, &sample) {
                Ok(differences) => {
                    for difference in differences {
                        comparison.record(LargestError { difference, regime, index, sample: sample.clone() });
                    }
                }
                Err([generated, generic]) => {
                    comparison.refusals.push(Refusal { regime, index, generated, generic });
                }
            }
        }
    }
    comparison
}
