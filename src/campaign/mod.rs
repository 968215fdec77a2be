//! Campaigns: one case of a scenario many times, with values drawn from distributions.
//!
//! # Example
//! ```
//! use planar_capture::campaign::Campaign;
//! use planar_capture::registry::SHIPPED;
//!
//! let text = r#"
//! name = "heavier_base"
//! scenario = "redysim_single_arm_3r.toml"
//! seed = 1
//! sampling = "grid"
//! vary = [
//!     { key = "layout.base.mass", distribution = { choice = [400.0, 500.0, 600.0] } },
//!     { key = "approach.duration", distribution = { choice = [10.0, 20.0] } },
//! ]
//! "#;
//! let campaign = Campaign::parse(text, "heavier_base.toml", "scenarios".as_ref(), SHIPPED)?;
//! assert_eq!(campaign.sweep.cases, 3 * 2); // all combinations
//! # Ok::<(), planar_capture::diagnostic::Report>(())
//! ```

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
