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
    // the shortest text that reads back exactly
    let mut text = zmij::Buffer::new();
    for row in all_rows(study, case) {
        let row = row?;
        csv.write_field(text.format(row.time))?;
        csv.write_field(row.phase)?;
        for column in &columns {
            csv.write_field(text.format(column.value(&row)))?;
        }
        csv.write_record(None::<&[u8]>)?;
    }
    csv.flush()
}
