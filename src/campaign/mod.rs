//! Campaigns: one case of a scenario many times, with values drawn from distributions.

mod block_file;
mod copula;
pub mod distribution;
mod keys;
pub mod manifest;
mod normal;
pub mod outputs;
mod reader;
pub mod report;
pub mod row;
pub mod run;
pub mod sampling;
pub mod sweep;
mod uniform;

pub use copula::{Copula, NotPositiveDefinite};
pub use keys::FORMAT;
pub use reader::Campaign;
