//! A sweep as plain data.
//!
//! # Example
//! ```
//! use planar_capture::campaign::Campaign;
//! use planar_capture::campaign::sweep::Draw;
//! use planar_capture::registry::SHIPPED;
//! use planar_capture::scenario::variation::VariedValue::Number;
//!
//! let text = r#"
//! name = "heavier_base"
//! scenario = "redysim_single_arm_3r.toml"
//! seed = 1
//! sampling = "grid"
//! block = 4
//! vary = [
//!     { key = "layout.base.mass", distribution = { choice = [400.0, 500.0, 600.0] } },
//!     { key = "approach.duration", distribution = { choice = [10.0, 20.0] } },
//! ]
//! "#;
//! let sweep = Campaign::parse(text, "heavier_base.toml", "scenarios".as_ref(), SHIPPED)?.sweep;
//! // the last key varies fastest; the second file has what is left of six cases
//! assert_eq!(Draw::new(&sweep).values(3), [Number(500.0), Number(20.0)]);
//! assert_eq!((sweep.blocks(), sweep.cases_of(1)), (2, 4..6));
//! # Ok::<(), planar_capture::diagnostic::Report>(())
//! ```

use super::copula::Copula;
use super::distribution::Distribution;
use super::outputs::OutputGroup;
use super::sampling::{KeySampling, Sampling};
use crate::scenario::find_key;
use crate::scenario::variation::VariedValue;

/// One case of a scenario, many times with other values.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Names the results; usable as a file name.
    pub name: String,
    /// The case of the scenario that is computed.
    pub case: String,
    /// Their number, at least one.
    pub cases: u64,
    /// Of all that is drawn.
    pub seed: u64,
    /// How the cases are spread.
    pub sampling: Sampling,
    /// The number of cases in a file.
    pub block: u64,
    /// What varies, in the order of the columns.
    pub varied: Vec<Varied>,
    /// Rank correlations; `None` where there are none.
    pub copula: Option<Copula>,
    /// What is kept beside the default outputs.
    pub collect: Collect,
}

impl Sweep {
    /// The pairs of keys that are correlated, and their rank correlations.
    #[must_use]
    pub fn correlations(&self) -> Vec<([&str; 2], f64)> {
        let ranks = self.copula.iter().flat_map(Copula::ranks);
        ranks.map(|(pair, rank)| (pair.map(|key| &*self.varied[key].key), rank)).collect()
    }
}

/// A key that varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// Its path.
    pub key: String,
    /// Of its values.
    pub distribution: Distribution,
}

impl Varied {
    /// The unit of its values; empty where another key decides on it, as it does for gains.
    #[must_use]
    pub fn unit(&self) -> String {
        let place = find_key(&self.key).ok().map(|(_, place)| place).filter(|place| place.keys.len() == 1);
        place.and_then(|place| Some(place.number()?.unit().to_owned())).unwrap_or_default()
    }

    /// The key with its unit, as an axis has it: `target.debris.mass [kg]`.
    #[must_use]
    pub fn label(&self) -> String {
        let unit = self.unit();
        if unit.is_empty() { self.key.clone() } else { format!("{} [{unit}]", self.key) }
    }
}

/// The `[collect]` table.
#[derive(Clone, Debug, PartialEq)]
pub struct Collect {
    /// Outputs beyond the default ones.
    pub outputs: Vec<OutputGroup>,
    /// Cases whose time series are kept, sorted.
    pub series: Vec<u64>,
    /// Time between their rows, s.
    pub sample: f64,
}

/// Draws the values of any case.
#[derive(Clone, Debug)]
pub struct Draw<'a> {
    sweep: &'a Sweep,
    samplings: Vec<KeySampling>,
}

impl<'a> Draw<'a> {
    /// Of a sweep.
    #[must_use]
    pub fn new(sweep: &'a Sweep) -> Self {
        let keys: Vec<_> =
            sweep.varied.iter().map(|varied| (varied.key.as_str(), varied.distribution.choices())).collect();
        Self { sweep, samplings: KeySampling::of_keys(sweep.sampling, sweep.seed, sweep.cases, &keys) }
    }

    /// The values of a case, in the order of the keys.
    #[must_use]
    pub fn values(&self, case: u64) -> Vec<VariedValue> {
        let mut numbers: Vec<f64> = self.samplings.iter().map(|sampling| sampling.number(case)).collect();
        if let Some(copula) = &self.sweep.copula {
            copula.mix(&mut numbers);
        }
        let varied = self.sweep.varied.iter().zip(numbers);
        varied.map(|(varied, number)| varied.distribution.quantile(number)).collect()
    }
}

impl Sweep {
    /// The number of files of cases.
    #[must_use]
    pub fn blocks(&self) -> u64 {
        self.cases.div_ceil(self.block)
    }

    /// The cases of a file.
    #[must_use]
    pub fn cases_of(&self, block: u64) -> std::ops::Range<u64> {
        block * self.block..((block + 1) * self.block).min(self.cases)
    }

    /// How many cases a block has.
    #[must_use]
    pub fn count_of(&self, block: u64) -> u64 {
        let cases = self.cases_of(block);
        cases.end - cases.start
    }

    /// What is to be said of statistics of so many of its cases; `None` of all of them.
    #[must_use]
    pub fn of_a_part(&self, cases: u64) -> Option<String> {
        (cases < self.cases).then(|| {
            let sampling = match self.sampling {
                // any part of these is a sample as all of it is
                Sampling::Random => String::new(),
                Sampling::Grid => ", which lacks combinations of the grid".to_owned(),
                Sampling::LatinHypercube | Sampling::Sobol => {
                    let name = self.sampling.in_words();
                    format!(", which covers the ranges of the keys less evenly than the whole {name}")
                }
            };
            format!(
                "{} of the sweep's cases are not here: statistics are of this part alone{sampling}",
                self.cases - cases
            )
        })
    }
}
