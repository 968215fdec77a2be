//! Results of a study as files, and as the table on the console.

pub mod animation;
pub mod atomic_file;
pub mod console;
pub mod figure_kinds;
#[cfg(feature = "figures")]
pub mod figures;
pub mod finite;
pub mod html_report;
pub mod impacts;
pub(crate) mod markup;
#[cfg(feature = "mcap")]
pub mod mcap;
pub mod output_error;
mod printed_impulses;
mod replacement;
pub mod result_folder;
pub mod run_folder;
pub mod run_manifest;
pub(crate) mod scene;
pub mod study_part;
pub mod summary;
mod sweep;
mod temporary;
pub mod time_series;
