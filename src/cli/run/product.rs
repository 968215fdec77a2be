//! What a run prints on the standard output: tables, or summaries as JSON.

use super::super::CommandError;
use super::super::terminal::print;
use serde_json::Value;
use std::io::{self, ErrorKind, Write};

/// What the standard output is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// For people: what cannot be printed is in the files.
    Table,
    /// For programs: the product, without which a run has failed.
    Json,
}

/// The summary of a study in both forms.
pub struct Printed {
    /// For people.
    pub table: String,
    /// The content of `summary.json`.
    pub summary: Value,
}

/// The standard output of a run of several scenarios.
pub struct Product {
    format: Format,
    /// An array of summaries.
    is_array: bool,
    printed: usize,
    /// The reader closed the pipe, or an error was reported.
    is_over: bool,
}

impl Product {
    /// Of this number of scenarios.
    pub fn new(format: Format, scenarios: usize) -> Self {
        Self { format, is_array: format == Format::Json && scenarios > 1, printed: 0, is_over: false }
    }

    /// Prints the results of a scenario.
    pub fn add(&mut self, Printed { table, summary }: &Printed) -> Result<(), CommandError> {
        let before = self.printed;
        self.printed += 1;
        match self.format {
            Format::Table => {
                print(&format!("{}{table}", if before > 0 { "\n" } else { "" }));
                Ok(())
            }
            Format::Json => {
                let json = serde_json::to_string_pretty(summary).map_err(io::Error::from)?;
                let (head, tail) = match (self.is_array, before) {
                    (false, _) => ("", "\n"),
                    (true, 0) => ("[\n", ""),
                    (true, _) => (",\n", ""),
                };
                self.write(&[head, &json, tail])
            }
        }
    }

    /// Closes the array.
    pub fn finish(&mut self) -> Result<(), CommandError> {
        match (self.is_array, self.printed) {
            (false, _) => Ok(()),
            (true, 0) => self.write(&["[]\n"]),
            (true, _) => self.write(&["\n]\n"]),
        }
    }

    /// Writes texts; the files are there whether or not someone reads them here, so that a closed pipe changes nothing.
    fn write(&mut self, texts: &[&str]) -> Result<(), CommandError> {
        if self.is_over {
            return Ok(());
        }
        let mut out = io::stdout().lock();
        let written = texts.iter().try_for_each(|text| out.write_all(text.as_bytes())).and_then(|()| out.flush());
        self.is_over = written.is_err();
        match written {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error.into()),
            _ => Ok(()),
        }
    }
}
