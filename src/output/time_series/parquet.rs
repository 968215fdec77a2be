//! The time series of a case as Parquet.

use super::{Column, Columns, TimeSeriesRow, all_rows, provenance};
use crate::capture::{CaseResult, Study};
use crate::output::run_manifest::RunManifest;
use crate::scenario::Scenario;
use arrow_array::types::Int8Type;
use arrow_array::{ArrayRef, DictionaryArray, Float64Array, RecordBatch};
use arrow_schema::{DataType, Field, Schema};
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, Encoding, ZstdLevel};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use std::collections::HashMap;
use std::io::{self, Write};
use std::sync::Arc;

/// Rows that are converted to arrays at a time.
const BATCH: usize = 1 << 13;

/// Rows of a group, which is encoded in memory.
const GROUP: usize = 1 << 16;

/// Writes the columns of the CSV under the same names with the same values: f64, the phase a dictionary of text,
/// compressed by zstd. The metadata of a numeric field has its `unit`, that of the file the [`provenance`].
///
/// # Errors
/// Those of the writer.
pub fn write_parquet(
    scenario: &Scenario,
    study: &Study,
    case: &CaseResult,
    manifest: &RunManifest,
    to: impl Write + Send,
) -> io::Result<()> {
    let columns = Columns::of(scenario, case);
    let schema = Arc::new(schema(columns.list()));
    let origin = provenance(scenario, case, manifest);
    let origin = origin.into_iter().map(|(key, value)| KeyValue::new(key, value)).collect();
    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::default()))
        // few values repeat, but exponents compress well when bytes are split into streams
        .set_dictionary_enabled(false)
        .set_encoding(Encoding::BYTE_STREAM_SPLIT)
        .set_column_dictionary_enabled("phase".into(), true)
        .set_column_encoding("phase".into(), Encoding::PLAIN)
        .set_max_row_group_row_count(Some(GROUP))
        .set_key_value_metadata(Some(origin))
        .build();
    let mut writer = ArrowWriter::try_new(to, Arc::clone(&schema), Some(properties)).map_err(failed)?;
    let mut rows = all_rows(study, case).peekable();
    while rows.peek().is_some() {
        let rows = rows.by_ref().take(BATCH).collect::<io::Result<Vec<_>>>()?;
        let rows = &rows[..];
        let batch = RecordBatch::try_new(Arc::clone(&schema), arrays(&columns, rows)).map_err(io::Error::other)?;
        writer.write(&batch).map_err(failed)?;
    }
    writer.close().map_err(failed)?;
    Ok(())
}

fn schema(columns: &[Column]) -> Schema {
    let number = |name: String, unit: &str| {
        Field::new(name, DataType::Float64, false).with_metadata(HashMap::from([("unit".to_owned(), unit.to_owned())]))
    };
    let text = DataType::Dictionary(Box::new(DataType::Int8), Box::new(DataType::Utf8));
    let mut fields = vec![number("time [s]".to_owned(), "s"), Field::new("phase", text, false)];
    fields.extend(columns.iter().map(|column| number(column.heading(), column.unit)));
    Schema::new(fields)
}

/// One array per field of the [`schema`].
fn arrays(columns: &Columns, rows: &[TimeSeriesRow<'_>]) -> Vec<ArrayRef> {
    let mut numbers = vec![Vec::with_capacity(rows.len()); columns.list().len()];
    let mut values = Vec::new();
    for row in rows {
        columns.values(row, &mut values);
        numbers.iter_mut().zip(&values).for_each(|(column, value)| column.push(*value));
    }
    let times = Float64Array::from_iter_values(rows.iter().map(|row| row.time));
    let phases: DictionaryArray<Int8Type> = rows.iter().map(|row| row.phase).collect();
    let mut arrays: Vec<ArrayRef> = vec![Arc::new(times), Arc::new(phases)];
    arrays.extend(numbers.into_iter().map(|column| -> ArrayRef { Arc::new(Float64Array::from(column)) }));
    arrays
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
