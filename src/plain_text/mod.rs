//! Text for terminals and files: lines of at most 100 characters, tables, and numbers of things.

mod count;
mod table;
mod wrap;

pub(crate) use count::count;
pub(crate) use table::{Column, Table};
pub(crate) use wrap::{entry, sentence, wrap};
