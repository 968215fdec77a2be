//! Campaigns: one case of a scenario many times, with values drawn from distributions.

pub mod block_file;
pub mod copula;
pub mod distribution;
mod keys;
pub mod manifest;
pub mod normal;
pub mod outputs;
mod reader;
pub mod report;
pub mod row;
pub mod run;
pub mod sampling;
pub mod sweep;
pub mod uniform;

pub use keys::FORMAT;
pub use reader::Campaign;
