//! Results of a study as files, and as the table on the console.

pub mod atomic_file;
pub mod console;
#[cfg(feature = "figures")]
pub mod figures;
pub mod html_report;
pub mod impacts;
#[cfg(feature = "mcap")]
pub mod mcap;
pub mod scene;
pub mod summary;
pub mod time_series;
