//! Single columns of the files of a sweep: memory for one of them at a time.

use crate::campaign::block_file::{CASES, Damage};
use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int8Type, Int64Type};
use arrow_array::{Array, RecordBatch};
use arrow_schema::{DataType, Field};
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Results of a sweep that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum UnreadableError {
    /// The folder with the files of cases.
    #[error("cannot read the folder {path}: {source}", path = path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A file of cases that is not what was written.
    #[error("{0}: remove this file, and the command that computes it does so again")]
    Damaged(#[from] Damage),
    /// A file of cases.
    #[error(
        "cannot read {path}: {source}; remove this file, and the same command computes its cases again",
        path = path.display()
    )]
    File {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
}

impl UnreadableError {
    /// For a file of cases.
    fn file(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::File { path: path.to_owned(), source }
    }
}

/// The files of cases that are there, in order.
#[derive(Clone, Debug)]
pub struct Columns {
    files: Vec<PathBuf>,
}

/// The values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Column {
    /// Also `case`; `None` where there is none.
    Numbers(Vec<Option<f64>>),
    /// `None` where there is none.
    Texts(Vec<Option<String>>),
}

impl Columns {
    /// Of a folder of results.
    ///
    /// # Errors
    /// [`UnreadableError`].
    pub fn of(folder: &Path) -> Result<Self, UnreadableError> {
        let cases = folder.join(CASES);
        let read = || fs::read_dir(&cases)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>();
        let mut files = read().map_err(|source| UnreadableError::Folder { path: cases, source })?;
        files.retain(|path| path.extension().is_some_and(|extension| extension == "parquet"));
        files.sort();
        Ok(Self { files })
    }

    /// Of one file.
    pub fn of_file(file: PathBuf) -> Self {
        Self { files: vec![file] }
    }

    /// Their paths.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Name and unit of every column.
    ///
    /// # Errors
    /// [`UnreadableError`].
    pub fn names(&self) -> Result<Vec<(String, String)>, UnreadableError> {
        let Some(path) = self.files.first() else { return Ok(Vec::new()) };
        let builder = open(path).map_err(UnreadableError::file(path))?;
        let unit = |field: &Field| field.metadata().get("unit").cloned().unwrap_or_default();
        Ok(builder.schema().fields().iter().map(|field| (field.name().clone(), unit(field))).collect())
    }

    /// The values of the column at a place, in the order of the cases.
    ///
    /// # Errors
    /// [`UnreadableError`].
    pub fn column(&self, place: usize) -> Result<Column, UnreadableError> {
        let (mut numbers, mut texts) = (Vec::new(), Vec::new());
        for path in &self.files {
            let mut read = || -> io::Result<()> {
                let builder = open(path)?;
                let mask = ProjectionMask::roots(builder.parquet_schema(), [place]);
                for batch in builder.with_projection(mask).build().map_err(io::Error::other)? {
                    push(&batch.map_err(io::Error::other)?, &mut numbers, &mut texts);
                }
                Ok(())
            };
            read().map_err(UnreadableError::file(path))?;
        }
        Ok(if texts.is_empty() { Column::Numbers(numbers) } else { Column::Texts(texts) })
    }
}

fn open(path: &Path) -> io::Result<ParquetRecordBatchReaderBuilder<File>> {
    ParquetRecordBatchReaderBuilder::try_new(File::open(path)?).map_err(io::Error::other)
}

/// Adds the only column of a batch.
#[allow(clippy::cast_precision_loss, reason = "indices of cases")]
fn push(batch: &RecordBatch, numbers: &mut Vec<Option<f64>>, texts: &mut Vec<Option<String>>) {
    let array = batch.column(0);
    match array.data_type() {
        DataType::Float64 => numbers.extend(array.as_primitive::<Float64Type>().iter()),
        DataType::Int64 => numbers.extend(array.as_primitive::<Int64Type>().iter().map(|value| Some(value? as f64))),
        DataType::Boolean => {
            numbers.extend(array.as_boolean().iter().map(|value| Some(f64::from(u8::from(value?)))));
        }
        DataType::Dictionary(..) => {
            let keys = array.as_dictionary::<Int8Type>();
            let values = keys.values().as_string::<i32>();
            texts.extend(keys.keys().iter().map(|key| Some(values.value(usize::try_from(key?).ok()?).to_owned())));
        }
        _ => texts.extend(array.as_string::<i32>().iter().map(|value| value.map(str::to_owned))),
    }
}
