//! Results of a study as files, and as the table on the console.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::{atomic_file::write_text, console::table, time_series::write_csv};
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! print!("{}", table(&scenario, &study));
//! let mut csv = Vec::new();
//! write_csv(&scenario, &study, &study.cases[0], &mut csv)?;
//! let (folder, text) = (tempfile::tempdir()?, String::from_utf8(csv)?);
//! write_text(&folder.path().join("approach.csv"), &text)?;
//! // the names, then a row at the start and after each of 20 s
//! assert_eq!(std::fs::read_to_string(folder.path().join("approach.csv"))?.lines().count(), 22);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod animation;
pub mod atomic_file;
pub mod console;
pub mod drawing;
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
pub(crate) mod regular_file;
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
