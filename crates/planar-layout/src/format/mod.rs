//! What files that people write may hold: one table of keys for each of their TOML tables, and paths to a key.
//!
//! Readers take known keys, kinds of values, ranges, units and defaults from here, and so do the reference, JSON Schemas
//! and templates.
//!
//! It never contains: a key of a certain file. Those of layouts are [`layout::FORMAT`](crate::layout::FORMAT).

mod attributes;
mod choice;
mod number_rule;
mod path;
mod table_format;

pub use attributes::{Default, Example, With};
pub use choice::{Choice, Count};
pub use number_rule::{Bound, NumberRule, units};
pub(crate) use number_rule::{Refusal, form};
pub use path::{NoKey, Place, ShapeAt, Step, find, find_below, quoted_key};
pub use table_format::{Key, Shape, TableFormat};
