//! What files that people write may hold: one table of keys for each of their TOML tables, and paths to a key.
//!
//! Readers take known keys, kinds of values, ranges, units and defaults from here, and so do the reference, JSON Schemas
//! and templates.
//!
//! It never contains: a key of a certain file. Those of layouts are [`layout::FORMAT`](crate::layout::FORMAT).
//!
//! # Example
//! ```
//! use planar_layout::format::find;
//! use planar_layout::layout::FORMAT;
//!
//! let rule = find(&FORMAT, "arm.left.link[0].mass")?.number().expect("one number");
//! assert_eq!((rule.to_string().as_str(), rule.unit()), ("a mass in kg greater than 0", "kg"));
//! let wrong = find(&FORMAT, "arm.left.link[0].mas").expect_err("a key that there is not");
//! assert_eq!(wrong.nearest.as_deref(), Some("arm.left.link[0].mass"));
//! # Ok::<(), planar_layout::format::NoKey>(())
//! ```

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
