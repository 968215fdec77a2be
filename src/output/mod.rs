//! What is made of a study: files and what the console shows.

pub mod atomic_file;
pub mod console;
#[cfg(feature = "figures")]
pub mod figures;
pub mod html_report;
#[cfg(feature = "mcap")]
pub mod mcap;
pub mod scene;
pub mod summary;
pub mod time_series;
