//! A stage of which some statements are on pairs.

use super::names::Names;
use crate::format::Statement;

/// Statements, some of them on pairs, in an order in which each comes after those that it needs.
#[derive(Debug, Default)]
pub struct Stage {
    pub sections: Vec<(String, usize)>,
    pub statements: Vec<Statement>,
    pub names: Names,
}
