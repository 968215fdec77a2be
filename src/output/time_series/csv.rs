//! The time series of a case as CSV.

use super::{Column, all_rows, columns};
use crate::capture::{CaseResult, Study};
use crate::scenario::Scenario;
use std::io::{self, Write};

/// Writes a header row with units, then one row per sample: time, phase and the [`columns`].
///
/// # Errors
/// Those of the writer.
pub fn write_csv(scenario: &Scenario, study: &Study, case: &CaseResult, to: impl Write) -> io::Result<()> {
    let columns = columns(scenario, case);
    let mut csv = csv::Writer::from_writer(to);
    let names = ["time [s]".to_owned(), "phase".to_owned()];
    csv.write_record(names.into_iter().chain(columns.iter().map(Column::heading)))?;
    for row in all_rows(study, case) {
        let row = row?;
        let values = columns.iter().map(|column| number(column.value(&row)));
        csv.write_record([number(row.time), row.phase.to_owned()].into_iter().chain(values))?;
    }
    csv.flush()
}

/// The shortest text that reads back exactly.
fn number(value: f64) -> String {
    format!("{value:?}")
}
