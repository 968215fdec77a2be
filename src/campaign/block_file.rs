//! A file of cases: `cases/NNNNNN.parquet`, the same bytes whoever computes it, and how long they took beside it.

use super::outputs::Output;
use super::row::Row;
use super::sweep::Sweep;
use crate::output::atomic_file::StagedFile;
use crate::output::output_error::OutputError;
use crate::scenario::variation::VariedValue;
use arrow_array::types::Int8Type;
use arrow_array::{Array, ArrayRef, BooleanArray, DictionaryArray, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, Schema};
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, ZstdLevel};
use parquet::errors::ParquetError;
use parquet::file::metadata::ParquetMetaDataReader;
use parquet::file::properties::WriterProperties;
use std::collections::HashMap;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The folder of files of cases.
pub const CASES: &str = "cases";
/// The folder of times.
pub const TIMING: &str = "timing";
/// The folder of time series.
pub const SERIES: &str = "series";

/// The path of a file of cases.
#[must_use]
pub fn path(folder: &Path, block: u64) -> PathBuf {
    folder.join(CASES).join(format!("{block:06}.parquet"))
}

/// Whether a file has these many rows, and can be read so far.
#[must_use]
pub fn is_complete(path: &Path, rows: u64) -> bool {
    let read = || {
        let file = File::open(path).ok()?;
        let metadata = ParquetMetaDataReader::new().parse_and_finish(&file).ok()?;
        u64::try_from(metadata.file_metadata().num_rows()).ok()
    };
    read() == Some(rows)
}

/// Writes a file of cases, and one of their times before it.
///
/// # Errors
/// [`OutputError`].
pub fn write(folder: &Path, block: u64, sweep: &Sweep, outputs: &[Output], rows: &[Row]) -> Result<(), OutputError> {
    let timing = folder.join(TIMING).join(format!("{block:06}.csv"));
    let times = StagedFile::new(&timing, |to| {
        writeln!(to, "case,time [s]")?;
        rows.iter().try_for_each(|row| writeln!(to, "{},{:.6}", row.case, row.seconds))
    })?;
    let cases = StagedFile::new(&path(folder, block), |to| write_rows(sweep, outputs, rows, to))?;
    times.commit()?;
    cases.commit()
}

fn write_rows(sweep: &Sweep, outputs: &[Output], rows: &[Row], to: impl Write + Send) -> io::Result<()> {
    let (fields, arrays): (Vec<Field>, Vec<ArrayRef>) = columns(sweep, outputs, rows).into_iter().unzip();
    let schema = Arc::new(Schema::new(fields));
    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::default()))
        // few numbers repeat
        .set_dictionary_enabled(false)
        .set_column_dictionary_enabled("status".into(), true)
        .set_column_dictionary_enabled("message".into(), true)
        .set_max_row_group_row_count(None)
        .build();
    let mut writer = ArrowWriter::try_new(to, Arc::clone(&schema), Some(properties)).map_err(failed)?;
    let batch = RecordBatch::try_new(schema, arrays).map_err(io::Error::other)?;
    writer.write(&batch).map_err(failed)?;
    writer.close().map_err(failed)?;
    Ok(())
}

fn columns(sweep: &Sweep, outputs: &[Output], rows: &[Row]) -> Vec<(Field, ArrayRef)> {
    let indices: Int64Array = rows.iter().map(|row| i64::try_from(row.case).ok()).collect();
    let mut columns: Vec<(Field, ArrayRef)> =
        vec![(Field::new("case", DataType::Int64, false), Arc::new(indices) as ArrayRef)];
    for (k, varied) in sweep.varied.iter().enumerate() {
        let array = of_values(rows.iter().map(|row| &row.values[k]));
        columns.push((Field::new(&varied.key, array.data_type().clone(), false), array));
    }
    let captured: BooleanArray = rows.iter().map(|row| row.captured).collect();
    columns.push((Field::new("captured", DataType::Boolean, true), Arc::new(captured)));
    for (k, output) in outputs.iter().enumerate() {
        let numbers: Float64Array = rows.iter().map(|row| row.outputs[k]).collect();
        // one entry: several have no order
        let unit = HashMap::from([("unit".to_owned(), output.unit.to_owned())]);
        let field = Field::new(&output.name, DataType::Float64, true);
        columns.push((if output.unit.is_empty() { field } else { field.with_metadata(unit) }, Arc::new(numbers)));
    }
    let statuses: DictionaryArray<Int8Type> = rows.iter().map(|row| row.status.name()).collect();
    columns.push((Field::new("status", statuses.data_type().clone(), false), Arc::new(statuses)));
    let messages: StringArray = rows.iter().map(|row| row.message.as_deref()).collect();
    columns.push((Field::new("message", DataType::Utf8, true), Arc::new(messages)));
    columns
}

/// The values of one key, which are all of one kind.
fn of_values<'a>(values: impl Iterator<Item = &'a VariedValue> + Clone) -> ArrayRef {
    match values.clone().next() {
        Some(VariedValue::Text(_)) => {
            let texts =
                values.map(|value| if let VariedValue::Text(text) = value { Some(text.as_str()) } else { None });
            Arc::new(texts.collect::<StringArray>())
        }
        Some(VariedValue::Flag(_)) => {
            let flags = values.map(|value| if let VariedValue::Flag(flag) = value { Some(*flag) } else { None });
            Arc::new(flags.collect::<BooleanArray>())
        }
        _ => Arc::new(values.map(VariedValue::number).collect::<Float64Array>()),
    }
}

/// Unwraps an error of the operating system, such as "no space left on device".
fn failed(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(source) => match source.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(source) => io::Error::other(source),
        },
        other => io::Error::other(other),
    }
}
