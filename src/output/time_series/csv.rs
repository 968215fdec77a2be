//! The time series of a case as CSV.

use super::{Column, Columns, all_rows};
use crate::capture::{CaseResult, Study};
use crate::scenario::Scenario;
use std::io::{self, Write};

/// Writes a header row with units, then one row per sample: time, phase and the [`Columns`].
///
/// # Errors
/// Those of the writer.
pub fn write_csv(scenario: &Scenario, study: &Study, case: &CaseResult, to: impl Write) -> io::Result<()> {
    let columns = Columns::of(scenario, case);
    let mut csv = csv::Writer::from_writer(to);
    let names = ["time [s]".to_owned(), "phase".to_owned()];
    csv.write_record(names.into_iter().chain(columns.list().iter().map(Column::heading)))?;
    let mut to = csv.into_inner().map_err(csv::IntoInnerError::into_error)?;
    let (mut values, mut line) = (Vec::new(), Vec::new());
    for row in all_rows(study, case) {
        let row = row?;
        columns.values(&row, &mut values);
        line.clear();
        push(&mut line, row.time);
        line.push(b',');
        line.extend_from_slice(row.phase.as_bytes());
        for value in &values {
            line.push(b',');
            push(&mut line, *value);
        }
        line.push(b'\n');
        to.write_all(&line)?;
    }
    to.flush()
}

/// Appends the shortest text that reads back exactly. No number needs quotation marks.
fn push(line: &mut Vec<u8>, number: f64) {
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format(number).as_bytes();
    // most have 16 to 24 bytes: two copies of constant length, which overlap, are no calls
    match (text.first_chunk::<16>(), text.last_chunk::<8>()) {
        (Some(first), Some(last)) => {
            let end = line.len() + text.len();
            line.extend_from_slice(first);
            line.truncate(end - last.len());
            line.extend_from_slice(last);
        }
        _ => line.extend_from_slice(text),
    }
}
