//! Arm layouts: read from TOML, written, hashed, compared with the structures of generated code; the formats of files
//! that people write; and the diagnostics of everything that is read.
//!
//! It never contains: a model, a graph, a computation of dynamics, a terminal.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, reason = "results have the same bits on every processor"))]

pub mod diagnostic;
pub mod format;
pub mod layout;
mod names;
pub mod outline;
mod proportion;
pub mod structure;
