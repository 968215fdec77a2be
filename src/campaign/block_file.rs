//! A file of cases: `cases/NNNNNN.parquet`, the same bytes whoever computes it; its SHA-256 beside it, by which a damaged one is
//! found, and how long the cases took.

use super::manifest::Origin;
use super::outputs::Output;
use super::row::Row;
use super::sweep::Sweep;
use crate::output::atomic_file::{StagedFile, lock_folder};
use crate::output::output_error::OutputError;
use crate::output::regular_file;
use crate::scenario::variation::VariedValue;
use arrow_array::types::Int8Type;
use arrow_array::{Array, ArrayRef, BooleanArray, DictionaryArray, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, Schema};
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, ZstdLevel};
use parquet::errors::ParquetError;
use parquet::file::metadata::{KeyValue, ParquetMetaDataReader};
use parquet::file::properties::WriterProperties;
use std::collections::HashMap;
use std::fs::File;
use std::io::{self, Read, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The folder of files of cases.
pub const CASES: &str = "cases";
/// The folder of the digests of these.
pub const DIGESTS: &str = "digests";
/// The folder of times.
pub const TIMING: &str = "timing";
/// The folder of time series.
pub const SERIES: &str = "series";

/// The path of a file of cases.
#[must_use]
pub fn path(folder: &Path, block: u64) -> PathBuf {
    folder.join(CASES).join(format!("{block:06}.parquet"))
}

/// The path of its digest.
fn digest_path(folder: &Path, block: u64) -> PathBuf {
    folder.join(DIGESTS).join(format!("{block:06}.sha256"))
}

/// The content of that, as `sha256sum` writes it in the folder of results.
fn digest_line(digest: [u8; 32], block: u64) -> String {
    let digest = digest.map(|byte| format!("{byte:02x}")).concat();
    format!("{digest}  {CASES}/{block:06}.parquet\n")
}

/// A file of cases that is not what a sweep has written there.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path} is damaged, {why}", path = path.display())]
pub struct Damage {
    /// The file.
    pub path: PathBuf,
    /// By what that is known.
    pub why: String,
}

/// What there is of a file of cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// No file.
    Nothing,
    /// The first ones of its cases: those of a sweep that had fewer.
    Fewer,
    /// All of them.
    Whole,
}

/// What a folder has of a file of these cases: all of its bytes are read.
///
/// # Errors
/// [`Damage`] where they are not those that were written, or those of other cases or of another sweep.
pub fn find(folder: &Path, block: u64, origin: &Origin, cases: Range<u64>) -> Result<Found, Damage> {
    let path = path(folder, block);
    if path.metadata().is_err_and(|error| error.kind() == io::ErrorKind::NotFound) {
        return Ok(Found::Nothing);
    }
    match written_cases(folder, block, origin) {
        Ok([first, last]) if first == cases.start && last + 1 == cases.end => Ok(Found::Whole),
        Ok([first, last]) if first == cases.start && last + 1 < cases.end => Ok(Found::Fewer),
        Ok([first, last]) => {
            let why = format!("it has the cases {first} to {last}, expected {} to {}", cases.start, cases.end - 1);
            Err(Damage { path, why })
        }
        Err(why) => Err(Damage { path, why }),
    }
}

/// The first and the last case of a file that is as it was written by this sweep; what is wrong with it otherwise.
fn written_cases(folder: &Path, block: u64, origin: &Origin) -> Result<[u64; 2], String> {
    let (path, beside) = (path(folder, block), digest_path(folder, block));
    let digest = digest_of(&path).map_err(|error| error.to_string())?;
    let line = regular_file::read(&beside).map_err(|error| format!("{}: {error}", beside.display()))?;
    if line != digest_line(digest, block).as_bytes() {
        return Err(format!("{} has another SHA-256", beside.display()));
    }
    cases_in(&path, origin)
}

/// The first and the last case of a file of this sweep, as its metadata say, which alone are read; `None` of another file.
#[must_use]
pub fn cases_said(folder: &Path, block: u64, origin: &Origin) -> Option<[u64; 2]> {
    let path = path(folder, block);
    regular_file::check(&path).ok()?;
    cases_in(&path, origin).ok()
}

/// The SHA-256 of a file.
fn digest_of(path: &Path) -> io::Result<[u8; 32]> {
    regular_file::check(path)?;
    let (mut file, mut hash, mut bytes) = (File::open(path)?, hmac_sha256::Hash::new(), vec![0; 1 << 16]);
    loop {
        match file.read(&mut bytes) {
            Ok(0) => return Ok(hash.finalize()),
            Ok(count) => hash.update(&bytes[..count]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

/// The first and the last case of a file, which has as many rows, of a sweep; what is wrong with it otherwise.
fn cases_in(path: &Path, origin: &Origin) -> Result<[u64; 2], String> {
    let file = File::open(path).map_err(|error| error.to_string())?;
    let metadata = ParquetMetaDataReader::new().parse_and_finish(&file).map_err(|error| error.to_string())?;
    let metadata = metadata.file_metadata();
    let entry = |name: &str| {
        let entry = metadata.key_value_metadata().into_iter().flatten().find(|entry| entry.key == name);
        entry.and_then(|entry| entry.value.as_deref())
    };
    if let Some((name, _)) = origin.iter().find(|(name, hash)| entry(name) != Some(hash)) {
        return Err(format!("it is of another sweep, by `{name}`"));
    }
    let [first, last] = [FIRST_CASE, LAST_CASE].map(|name| entry(name).and_then(|case| case.parse::<u64>().ok()));
    match (first, last, u64::try_from(metadata.num_rows())) {
        (Some(first), Some(last), Ok(rows)) if last.checked_sub(first).map(|more| more + 1) == Some(rows) => {
            Ok([first, last])
        }
        _ => Err(format!("it has {} rows, other than by `{FIRST_CASE}` and `{LAST_CASE}`", metadata.num_rows())),
    }
}

/// The entries of the metadata with the range of cases.
const FIRST_CASE: &str = "first_case";
const LAST_CASE: &str = "last_case";

/// Writes a file of cases, and before it its digest and one of their times: a file without its digest is not there even for a
/// moment. One with more cases stays: that of another process, which began later, of the same sweep with more of them.
///
/// # Errors
/// [`OutputError`].
pub fn write(
    (folder, block): (&Path, u64),
    sweep: &Sweep,
    origin: &Origin,
    outputs: &[Output],
    rows: &[Row],
) -> Result<(), OutputError> {
    let timing = folder.join(TIMING).join(format!("{block:06}.csv"));
    let times = StagedFile::new(&timing, |to| {
        writeln!(to, "case,time [s]")?;
        rows.iter().try_for_each(|row| writeln!(to, "{},{:.6}", row.case, row.seconds))
    })?;
    let path = path(folder, block);
    let mut bytes = Vec::new();
    write_rows(sweep, origin, outputs, rows, &mut bytes).map_err(OutputError::at(&path))?;
    let cases = StagedFile::new(&path, |to| to.write_all(&bytes))?;
    let line = digest_line(hmac_sha256::Hash::hash(&bytes), block);
    let digest = StagedFile::new(&digest_path(folder, block), |to| to.write_all(line.as_bytes()))?;
    // between looking and writing
    let _lock = lock_folder(folder);
    let last = rows.last().map(|row| row.case);
    if written_cases(folder, block, origin).is_ok_and(|[_, written]| Some(written) > last) {
        return Ok(());
    }
    times.commit()?;
    digest.commit()?;
    cases.commit()
}

/// What a file says of itself: of which sweep it is, and which cases it has.
fn metadata(origin: &Origin, rows: &[Row]) -> Vec<KeyValue> {
    let of_sweep = origin.iter().map(|(name, hash)| KeyValue::new((*name).to_owned(), hash.clone()));
    let ends = [(FIRST_CASE, rows.first()), (LAST_CASE, rows.last())];
    let ends = ends.map(|(name, row)| KeyValue::new(name.to_owned(), row.map(|row| row.case.to_string())));
    of_sweep.chain(ends).collect()
}

fn write_rows(
    sweep: &Sweep,
    origin: &Origin,
    outputs: &[Output],
    rows: &[Row],
    to: impl Write + Send,
) -> io::Result<()> {
    let (fields, arrays): (Vec<Field>, Vec<ArrayRef>) = columns(sweep, outputs, rows).into_iter().unzip();
    let schema = Arc::new(Schema::new(fields));
    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::default()))
        // few numbers repeat
        .set_dictionary_enabled(false)
        .set_column_dictionary_enabled("status".into(), true)
        .set_column_dictionary_enabled("message".into(), true)
        .set_max_row_group_row_count(None)
        .set_key_value_metadata(Some(metadata(origin, rows)))
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
