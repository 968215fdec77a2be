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
    let mut to = csv.into_inner().map_err(csv::IntoInnerError::into_error)?;
    let mut line = Vec::new();
    for row in all_rows(study, case) {
        let row = row?;
        line.clear();
        push(&mut line, row.time);
        line.push(b',');
        line.extend_from_slice(row.phase.as_bytes());
        for column in &columns {
            line.push(b',');
            push(&mut line, column.value(&row));
        }
        line.push(b'\n');
        to.write_all(&line)?;
    }
    to.flush()
}

/// Appends the shortest text that reads back exactly. No number needs quotation marks.
fn push(line: &mut Vec<u8>, number: f64) {
    line.extend_from_slice(zmij::Buffer::new().format(number).as_bytes());
}
