//! Text for terminals and files: lines of at most 100 characters, and tables.

mod table;
mod wrap;

pub(crate) use table::{Column, Table};
pub(crate) use wrap::{entry, sentence, wrap};
