//! The report on a sweep: percentiles, failures, sensitivities, and the cases to look at.
//!
//! # Example
//! ```
//! use planar_capture::campaign::report::{OutputReport, SweepReport};
//!
//! // of three outputs the rank correlations with the only key that varies
//! let output = |correlation| OutputReport { correlations: vec![correlation], ..OutputReport::default() };
//! let outputs = [Some(0.1), Some(-0.9), Some(0.5)].map(output).to_vec();
//! let report = SweepReport { outputs, ..SweepReport::default() };
//! assert_eq!(report.most_sensitive(2), [1, 2]);
//! ```

#[cfg(feature = "figures")]
mod axis_unit;
mod columns;
mod failures;
#[cfg(feature = "figures")]
mod gallery;
mod histogram;
mod page;
#[cfg(feature = "figures")]
mod pictures;
mod scatter;
mod statistics;

use crate::campaign::block_file::{self, Damage};
use crate::campaign::manifest::origin;
use crate::campaign::reader::Campaign;
use crate::campaign::row::Status;
use crate::campaign::sampling::Sampling;
use crate::output::atomic_file::write_text;
use crate::output::figure_kinds::begins_with;
use crate::output::output_error::OutputError;
pub use columns::UnreadableError;
use columns::{Column, Columns};
pub use failures::FailureKind;
use failures::kinds_of;
pub use histogram::Histogram;
use page::page;
pub use scatter::Scatter;
use scatter::{effects, strongest_first};
pub use statistics::Percentile;
use statistics::{PercentileRanks, correlation, first_order, ranks};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The percentiles of an output, in hundredths.
pub const PERCENTILES: [u8; 5] = [5, 25, 50, 75, 95];

/// Most kinds of failures that are listed.
const LISTED: usize = 20;

/// An output of which no two cases differ by more, in SI units and relative to its largest value, is the same in all: what
/// is left are rounding and the tolerance of the integration.
pub const SAME: f64 = 1e-10;

/// What there is to say about a sweep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SweepReport {
    /// The sweep's name.
    pub name: String,
    /// What was computed: scenario, case, robot, sampling and seed, each with its name.
    pub about: Vec<(&'static str, String)>,
    /// Every key that varies, with its unit, and its distribution in words.
    pub varied: Vec<(String, String)>,
    /// The pairs of keys that are correlated, and their rank correlations.
    pub correlated: Vec<([String; 2], f64)>,
    /// Cases in which all that is to be held was captured, and cases with a result.
    pub captured: [usize; 2],
    /// Rows that were read.
    pub cases: usize,
    /// The cases of the whole sweep.
    pub all: u64,
    /// What is to be said of statistics of these rows where they are a part of the sweep.
    pub of_a_part: Option<String>,
    /// Rows by status, those that occur.
    pub statuses: Vec<(String, usize)>,
    /// The kinds of failures, the most frequent one first.
    pub failures: Vec<FailureKind>,
    /// Names and units of the keys that vary with numbers.
    pub keys: Vec<(String, String)>,
    /// Outputs that vary.
    pub outputs: Vec<OutputReport>,
    /// Name, unit and largest magnitude of those that are the same in all cases, to [`SAME`].
    pub same: Vec<(String, String, f64)>,
    /// Whether keys are independent, as first-order indices suppose.
    pub is_independent: bool,
    /// What the cases are a sample by, where they are not drawn independently, as confidence bounds suppose.
    pub sampling: Option<&'static str>,
    /// The outputs that have pictures, by the first words of their names; without any the most sensitive ones.
    pub pictured: Vec<String>,
}

/// One output.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutputReport {
    /// As in the files.
    pub name: String,
    /// SI.
    pub unit: String,
    /// How many cases have it.
    pub count: usize,
    /// In the order of [`PERCENTILES`].
    pub percentiles: Vec<Percentile>,
    /// The cases with the smallest and the largest value, and these.
    pub extremes: [(u64, f64); 2],
    /// Rank correlation with each key.
    pub correlations: Vec<Option<f64>>,
    /// First-order index of each key; empty where keys are correlated.
    pub first_order: Vec<Option<f64>>,
    /// How many cases have which values.
    pub histogram: Option<Histogram>,
    /// Over the key with the strongest effect.
    pub scatter: Option<Scatter>,
}

impl SweepReport {
    /// The places of the outputs that are asked for; where none are, of so many of the [most sensitive](Self::most_sensitive).
    #[must_use]
    pub fn pictured(&self, most: usize) -> Vec<usize> {
        if self.pictured.is_empty() {
            return self.most_sensitive(most);
        }
        let is_wanted = |output: &OutputReport| self.pictured.iter().any(|word| begins_with(&output.name, word));
        (0..self.outputs.len()).filter(|place| is_wanted(&self.outputs[*place])).collect()
    }

    /// The places of so many outputs, in their order: those with the strongest effects of a key, then the first ones.
    #[must_use]
    pub fn most_sensitive(&self, most: usize) -> Vec<usize> {
        let strength = |output: &OutputReport| {
            let effects = effects(&output.correlations, &output.first_order);
            strongest_first(&effects).first().map_or(0.0, |of| of.1.abs())
        };
        let mut places: Vec<_> =
            self.outputs.iter().enumerate().map(|(place, output)| (place, strength(output))).collect();
        places.sort_by(|a, b| b.1.total_cmp(&a.1));
        places.truncate(most);
        places.sort_unstable_by_key(|(place, _)| *place);
        places.into_iter().map(|(place, _)| place).collect()
    }
}

/// Why there is no report on a sweep.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The results cannot be read.
    #[error(transparent)]
    Unreadable(#[from] UnreadableError),
    /// It cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// How many cases have each status, those that occur.
fn by_status(statuses: &[Option<String>]) -> Vec<(&'static str, usize)> {
    let count = |name: &str| statuses.iter().filter(|status| status.as_deref() == Some(name)).count();
    Status::ALL.iter().map(|(name, _)| (*name, count(name))).filter(|(_, count)| *count > 0).collect()
}

/// How many cases of a file have each status, those that occur.
///
/// # Errors
/// [`UnreadableError`].
pub fn statuses_of_block(folder: &Path, block: u64) -> Result<Vec<(&'static str, usize)>, UnreadableError> {
    let columns = Columns::of_file(block_file::path(folder, block));
    let place = columns.names()?.iter().position(|(name, _)| name == "status");
    Ok(match place.map(|place| columns.column(place)).transpose()? {
        Some(Column::Texts(statuses)) => by_status(&statuses),
        _ => Vec::new(),
    })
}

/// That files are those that a sweep has written, each of its own cases: not damaged, not another's.
fn check(campaign: &Campaign, folder: &Path, files: &[PathBuf]) -> Result<(), UnreadableError> {
    let origin = origin(campaign);
    let sweep = &campaign.sweep;
    for path in files {
        let number: Option<u64> = path.file_stem().and_then(|name| name.to_str()?.parse().ok());
        let is_own = |block: &u64| *block < sweep.blocks() && block_file::path(folder, *block) == *path;
        let Some(block) = number.filter(is_own) else {
            let why = "the sweep has no file of this name".to_owned();
            return Err(Damage { path: path.clone(), why }.into());
        };
        block_file::find(folder, block, &origin, sweep.cases_of(block))?;
    }
    Ok(())
}

/// Reads the files of a sweep that are there.
///
/// # Errors
/// [`UnreadableError`].
pub fn report(campaign: &Campaign, folder: &Path) -> Result<SweepReport, UnreadableError> {
    let columns = Columns::of(folder)?;
    check(campaign, folder, columns.files())?;
    let names = columns.names()?;
    let place = |name: &str| names.iter().position(|(known, _)| known == name);
    let numbers = |name: &str| -> Result<Vec<Option<f64>>, UnreadableError> {
        Ok(match place(name).map(|place| columns.column(place)).transpose()? {
            Some(Column::Numbers(numbers)) => numbers,
            _ => Vec::new(),
        })
    };
    let texts = |name: &str| -> Result<Vec<Option<String>>, UnreadableError> {
        Ok(match place(name).map(|place| columns.column(place)).transpose()? {
            Some(Column::Texts(texts)) => texts,
            _ => Vec::new(),
        })
    };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "indices of cases")]
    let cases: Vec<u64> = numbers("case")?.into_iter().map(|case| case.unwrap_or_default() as u64).collect();
    let (statuses, messages) = (texts("status")?, texts("message")?);
    let counts = by_status(&statuses).into_iter().map(|(name, count)| (name.to_owned(), count)).collect();
    let is_done = |status: &Option<String>| status.as_deref() == Some(Status::Done.name());
    let failures = statuses.iter().enumerate().filter(|(_, status)| !is_done(status)).map(|(row, status)| {
        let message = messages.get(row).cloned().flatten().unwrap_or_default();
        FailureKind { count: 1, case: cases[row], status: status.clone().unwrap_or_default(), message }
    });
    let (mut keys, mut units) = (Vec::new(), Vec::new());
    for varied in &campaign.sweep.varied {
        let values: Option<Vec<f64>> = numbers(&varied.key)?.into_iter().collect();
        if let Some(values) = values.filter(|values| !values.is_empty()) {
            keys.push((varied.key.clone(), values));
            units.push((varied.key.clone(), varied.unit()));
        }
    }
    let is_independent = campaign.sweep.copula.is_none();
    let mut of_count = HashMap::new();
    let (mut outputs, mut same, mut captured) = (Vec::new(), Vec::new(), [0; 2]);
    let first = place("captured").unwrap_or_default();
    for (name, unit) in &names[first.min(names.len())..] {
        let values = numbers(name)?;
        if name == "captured" {
            let known = values.iter().flatten();
            captured = [known.clone().filter(|value| **value > 0.5).count(), known.count()];
        }
        let rows: Vec<usize> = (0..values.len()).filter(|row| values[*row].is_some()).collect();
        let values: Vec<f64> = values.into_iter().flatten().collect();
        if let Some(largest) = same_in_all(&values) {
            same.push((name.clone(), unit.clone(), largest));
            continue;
        }
        let found = OutputReport { name: name.clone(), unit: unit.clone(), ..OutputReport::default() };
        outputs.extend(found.of(&cases, (&rows, &values), &keys, is_independent, &mut of_count));
    }
    let (sweep, scenario) = (&campaign.sweep, &campaign.scenario);
    Ok(SweepReport {
        name: sweep.name.clone(),
        about: vec![
            ("scenario", scenario.name.clone()),
            ("case", sweep.case.clone()),
            ("robot", scenario.layout.name.clone()),
            ("sampling", sweep.sampling.name().replace('_', " ")),
            ("seed", sweep.seed.to_string()),
        ],
        varied: sweep.varied.iter().map(|varied| (varied.label(), varied.distribution.to_string())).collect(),
        correlated: sweep.correlations().into_iter().map(|(keys, rank)| (keys.map(str::to_owned), rank)).collect(),
        captured,
        cases: cases.len(),
        all: sweep.cases,
        of_a_part: sweep.of_a_part(cases.len() as u64),
        statuses: counts,
        failures: kinds_of(failures),
        keys: units,
        outputs,
        same,
        is_independent,
        sampling: (sweep.sampling != Sampling::Random).then(|| sweep.sampling.in_words()),
        pictured: Vec::new(),
    })
}

/// The largest magnitude of values that are the same to [`SAME`]; `None` of others, and of none.
fn same_in_all(values: &[f64]) -> Option<f64> {
    let first = *values.first()?;
    let bounds = |(least, most): (f64, f64), value: &f64| (least.min(*value), most.max(*value));
    let (least, most) = values.iter().fold((first, first), bounds);
    let size = least.abs().max(most.abs());
    (most - least <= SAME * size.max(1.0)).then_some(size)
}

/// Writes the report on all files of a sweep that are in a folder, whoever computed them; returns its path. `sweep` is
/// the file of the sweep as the command to replay a case has it; `pictured` as in [`SweepReport`].
///
/// # Errors
/// [`ReportError`].
pub fn write_report(
    campaign: &Campaign,
    sweep: &Path,
    folder: &Path,
    pictured: &[String],
) -> Result<PathBuf, ReportError> {
    let words = ["planar-capture", "sweep", &*sweep.to_string_lossy(), "--out", &*folder.to_string_lossy()];
    // only a NUL cannot be quoted, which no path has
    let command = format!("{} --replay", shlex::try_join(words).unwrap_or_default());
    let file = folder.join("report.html");
    let report = SweepReport { pictured: pictured.to_vec(), ..report(campaign, folder)? };
    write_text(&file, &page(&report, &command))?;
    Ok(file)
}

impl OutputReport {
    /// Of values of some rows; `None` of none.
    fn of(
        self,
        cases: &[u64],
        (rows, values): (&[usize], &[f64]),
        keys: &[(String, Vec<f64>)],
        is_independent: bool,
        of_count: &mut HashMap<usize, Vec<PercentileRanks>>,
    ) -> Option<Self> {
        let smallest = (0..values.len()).min_by(|a, b| values[*a].total_cmp(&values[*b]))?;
        let largest = (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b]))?;
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = of_count.entry(values.len()).or_insert_with(|| {
            PERCENTILES.iter().map(|p| PercentileRanks::new(values.len(), f64::from(*p) / 100.0)).collect()
        });
        let of_values = ranks(values);
        let of_keys: Vec<Vec<f64>> =
            keys.iter().map(|(_, all)| ranks(&rows.iter().map(|row| all[*row]).collect::<Vec<_>>())).collect();
        let first_order: Vec<_> =
            of_keys.iter().filter(|_| is_independent).map(|key| first_order(key, values)).collect();
        let correlations: Vec<_> = of_keys.iter().map(|key| correlation(key, &of_values)).collect();
        let of_key = |key: usize| rows.iter().map(|row| keys[key].1[*row]).collect();
        Some(Self {
            count: values.len(),
            histogram: Histogram::of(&sorted),
            scatter: Scatter::of(&effects(&correlations, &first_order), of_key, values),
            percentiles: at.iter().map(|percentile| percentile.of(&sorted)).collect(),
            extremes: [smallest, largest].map(|i| (cases[rows[i]], values[i])),
            correlations,
            first_order,
            ..self
        })
    }
}

#[cfg(test)]
mod tests;
