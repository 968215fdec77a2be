//! Descriptions of layouts, scenarios and sweeps, and warnings about unlikely numbers in them: `planar-capture check`.
//!
//! Errors are found by the readers. A warning is about a valid number that is probably not what was meant; each has a
//! threshold, a named constant, that no realistic robot comes near.
//!
//! # Example
//! ```
//! use planar_capture::check::inspect;
//! use planar_capture::registry::SHIPPED;
//!
//! let text = std::fs::read_to_string("codegen/layouts/dual_arm_3r.toml")?;
//! let report = inspect(&text, "dual_arm_3r.toml", "".as_ref(), SHIPPED)?;
//! assert!(report.description.contains("560 kg") && report.warnings.count() == 0);
//! // valid, but probably in another unit: the radius of gyration is √(8e7 kg m² / 500 kg)
//! let text = text.replace("inertia = 83.61", "inertia = 8e7");
//! let report = inspect(&text, "dual_arm_3r.toml", "".as_ref(), SHIPPED)?;
//! assert!(report.warnings.render(false).contains("400 m"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod approach;
mod arms;
mod bodies;
mod breakdown;
mod clearance;
#[cfg(feature = "sweep")]
mod draws;
mod encounter;
mod kind;
mod link;
mod misses;
mod names;
mod number;
mod outlines;
mod pose;
mod repetition;
mod robot;
mod stiffness;
mod study;
#[cfg(feature = "sweep")]
mod sweep;
mod targets;

#[cfg(feature = "sweep")]
use crate::campaign::Campaign;
use crate::capture::StudyError;
use crate::diagnostic::{Report, Warning, report_error, report_warnings};
use crate::file_format::FileFormat;
use crate::layout::Layout;
use crate::registry::Robots;
use crate::scenario::{Known, Scenario, Variant};
pub use breakdown::{law_report, study_report};
use kind::kind;
use repetition::is_repeated;
use std::path::Path;

/// A valid file.
#[derive(Clone, Debug)]
pub struct CheckReport {
    /// Lines for the terminal.
    pub description: String,
    /// About the file, and about the layout that it names.
    pub warnings: Report,
    /// Why every run of the scenario is refused: its values are valid one by one, but there is no such motion.
    pub refusal: Option<Report>,
}

/// Checks TOML text of a layout, a scenario or a sweep; the other arguments are those of [`Scenario::parse`].
///
/// # Errors
/// Those of [`Layout::parse`], [`Scenario::parse`], and the reader of sweeps.
pub fn inspect<'k>(
    text: &str,
    file: &str,
    folder: &Path,
    shipped: impl Into<Known<'k>>,
) -> Result<CheckReport, Report> {
    inspect_with(text, file, folder, shipped, Robots::SHIPPED)
}

/// As [`inspect`], in a program that has code for these robots.
///
/// # Errors
/// Those of [`inspect`].
pub fn inspect_with<'k>(
    text: &str,
    file: &str,
    folder: &Path,
    shipped: impl Into<Known<'k>>,
    robots: Robots<'_>,
) -> Result<CheckReport, Report> {
    match kind(text, file)? {
        FileFormat::Layout => {
            let layout = Layout::parse(text, file)?;
            Ok(CheckReport {
                description: robot::description(&layout, robots),
                warnings: layout_warnings(&layout, text, file),
                refusal: None,
            })
        }
        FileFormat::Scenario => {
            let (scenario, source) = Scenario::parse_with_source(text, file, folder, shipped)?;
            let (mut warnings, error) = match &scenario.cases[..] {
                // every case has other values
                [] => (Vec::new(), None),
                _ => scenario_findings(&scenario, robots),
            };
            let common = (warnings.clone(), error.as_ref().map(|error| refused(error, &scenario)));
            let mut refusal = error.map(|error| error.report(&scenario, text, file, None));
            for variant in &scenario.variants {
                let (own, error) = variant_findings(variant, &scenario, robots);
                let is_new = |own: &Warning| !common.0.iter().any(|known| is_repeated(own, known, variant));
                warnings.extend(own.into_iter().filter(is_new).map(|warning| variant.at_its_key(warning)));
                let own = error.map(|error| refused(&error, &variant.scenario));
                let is_new = |own: &Warning| !common.1.iter().any(|known| is_repeated(own, known, variant));
                if let Some(Warning { key, why, .. }) = own.filter(is_new) {
                    let why = format!("with these values, `{key}`: {why}");
                    let report = report_error(text, file, (&variant.key(), "none"), &why, None);
                    refusal = Some(match refusal {
                        Some(before) => before.and(report),
                        None => report,
                    });
                }
            }
            Ok(CheckReport {
                description: study::description(&scenario, robots),
                warnings: scenario_warnings(&scenario, &warnings, [(text, file), (&source.text, &source.file)]),
                refusal,
            })
        }
        #[cfg(feature = "sweep")]
        FileFormat::Sweep => {
            let campaign = Campaign::parse(text, file, folder, shipped)?;
            let Campaign { scenario, scenario_source: sources, .. } = &campaign;
            let (mut warnings, refusal) = scenario_findings(scenario, robots);
            // with the values that vary it may be another one
            let before = "so it is before anything varies";
            warnings.extend(refusal.map(|error| Warning { help: before.to_owned(), ..refused(&error, scenario) }));
            let known = [warnings.clone(), by_path(&scenario.layout)].concat();
            let drawn = report_warnings(text, file, &draws::warnings(&campaign, &known, robots));
            let texts = [&sources.scenario, &sources.layout].map(|source| (&*source.text, &*source.file));
            if let Some(variant) = &campaign.variant {
                warnings = warnings.into_iter().map(|warning| variant.at_its_key(warning)).collect();
            }
            Ok(CheckReport {
                description: sweep::description(&campaign),
                warnings: drawn.and(scenario_warnings(scenario, &warnings, texts)),
                refusal: None,
            })
        }
    }
}

/// Why every run is refused, at its key.
fn refused(error: &StudyError, scenario: &Scenario) -> Warning {
    warning(error.key(scenario).path, error.to_string(), "")
}

/// Warnings about a scenario, and why every run of it is refused.
fn scenario_findings(scenario: &Scenario, robots: Robots<'_>) -> (Vec<Warning>, Option<StudyError>) {
    let mut warnings = unlikely(scenario);
    match clearance::warnings(scenario, robots) {
        Ok(found) => {
            warnings.extend(found);
            (warnings, None)
        }
        Err(error) => (warnings, Some(error)),
    }
}

/// Warnings about a scenario's numbers, without its planned path.
fn unlikely(scenario: &Scenario) -> Vec<Warning> {
    let checks = [
        names::warnings,
        approach::warnings,
        pose::warnings,
        stiffness::warnings,
        targets::warnings,
        encounter::warnings,
    ];
    checks.into_iter().flat_map(|check| check(scenario)).collect()
}

/// The same about a case with values of its own; about its layout, what is not true of the scenario's.
fn variant_findings(variant: &Variant, common: &Scenario, robots: Robots<'_>) -> (Vec<Warning>, Option<StudyError>) {
    let (mut warnings, error) = scenario_findings(&variant.scenario, robots);
    let known = by_path(&common.layout);
    let is_new = |own: &Warning| !known.iter().any(|known| is_repeated(own, known, variant));
    warnings.extend(by_path(&variant.scenario.layout).into_iter().filter(is_new));
    (warnings, error)
}

/// Warnings about a layout, at the paths that its keys have in sweeps and cases.
fn by_path(layout: &Layout) -> Vec<Warning> {
    let at = |warning: Warning| Warning { key: format!("layout.{}", warning.key), ..warning };
    of_layout(layout).into_iter().map(at).collect()
}

fn of_layout(layout: &Layout) -> Vec<Warning> {
    [bodies::warnings(layout), arms::warnings(layout), outlines::warnings(layout)].concat()
}

/// The report of warnings about a scenario, and of those about its layout; the texts are theirs, with their files.
fn scenario_warnings(scenario: &Scenario, warnings: &[Warning], [(text, file), layout]: [(&str, &str); 2]) -> Report {
    report_warnings(text, file, warnings).and(layout_warnings(&scenario.layout, layout.0, layout.1))
}

fn layout_warnings(layout: &Layout, text: &str, file: &str) -> Report {
    report_warnings(text, file, &of_layout(layout))
}

/// A warning about the value of a key, with the reason and the expected value.
fn warning(key: impl Into<String>, why: impl Into<String>, help: impl Into<String>) -> Warning {
    Warning { key: key.into(), why: why.into(), help: help.into() }
}
