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
        push_all(&mut line, &[row.time]);
        line.extend_from_slice(row.phase.as_bytes());
        line.push(b',');
        push_all(&mut line, &values);
        // the comma after the last number
        line.pop();
        line.push(b'\n');
        to.write_all(&line)?;
    }
    to.flush()
}

/// Numbers that are formatted before the first of their texts is copied. The formatter writes a text by parts, and what reads it as a
/// whole waits until these are in the cache, which takes two thirds of the formatter's time unless there is other work until then.
const AT_ONCE: usize = 16;

/// Appends the shortest texts that read back exactly, each with a comma after it. No number needs quotation marks.
fn push_all(line: &mut Vec<u8>, numbers: &[f64]) {
    let mut buffers: [_; AT_ONCE] = std::array::from_fn(|_| zmij::Buffer::new());
    for numbers in numbers.chunks(AT_ONCE) {
        let mut texts = [""; AT_ONCE];
        for ((text, buffer), number) in texts.iter_mut().zip(&mut buffers).zip(numbers) {
            *text = buffer.format(*number);
        }
        for text in &texts[..numbers.len()] {
            push(line, text.as_bytes());
            line.push(b',');
        }
    }
}

/// Appends a text.
fn push(line: &mut Vec<u8>, text: &[u8]) {
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
