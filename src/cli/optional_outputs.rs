//! Files of `run` that only a build with the cargo feature of the same name can write.

use super::CommandError;
use crate::capture::{CaseResult, Study};
use crate::output::result_folder::StagedFolder;
use crate::output::run_manifest::RunManifest;
use crate::scenario::Scenario;
use std::fs::File;
use std::io::{self, BufWriter};

/// A kind of output.
#[derive(Clone, Copy)]
pub struct OptionalOutput {
    /// The cargo feature that it needs.
    feature: &'static str,
    /// What a build without the feature does not do.
    absence: &'static str,
    /// Writes its files for a study to a folder; `None` in a build without the feature.
    write: Option<Write>,
}

type Write = fn(&StagedFolder, &Scenario, &Study, &RunManifest) -> Result<(), CommandError>;

pub const FIGURES: OptionalOutput = OptionalOutput {
    feature: "figures",
    absence: "draws no figures",
    #[cfg(feature = "figures")]
    write: Some(figures),
    #[cfg(not(feature = "figures"))]
    write: None,
};
const PARQUET: OptionalOutput = OptionalOutput {
    feature: "parquet",
    absence: "writes no Parquet",
    #[cfg(feature = "parquet")]
    write: Some(parquet),
    #[cfg(not(feature = "parquet"))]
    write: None,
};
const MCAP: OptionalOutput = OptionalOutput {
    feature: "mcap",
    absence: "writes no MCAP",
    #[cfg(feature = "mcap")]
    write: Some(mcap),
    #[cfg(not(feature = "mcap"))]
    write: None,
};

/// The flags of `run` that request them.
#[derive(Debug, Default, clap::Args)]
pub struct Flags {
    /// Draw figures too, as SVG and PNG in DIR/figures; needs a build with the feature `figures`.
    #[arg(long, help_heading = "Results")]
    figures: bool,
    /// Write DIR/CASE.parquet too: the time series in binary; needs a build with the feature `parquet`.
    #[arg(long, help_heading = "Results")]
    parquet: bool,
    /// Write DIR/CASE.mcap too, for Foxglove and Rerun; needs a build with the feature `mcap`.
    #[arg(long, help_heading = "Results")]
    mcap: bool,
}

impl Flags {
    /// The outputs that are requested.
    pub fn requested(&self) -> Vec<OptionalOutput> {
        let flags = [(self.figures, FIGURES), (self.parquet, PARQUET), (self.mcap, MCAP)];
        flags.into_iter().filter_map(|(requested, output)| requested.then_some(output)).collect()
    }
}

/// An error that names the missing features if this build cannot write all of these outputs.
pub fn require(outputs: &[OptionalOutput]) -> Result<(), CommandError> {
    let missing: Vec<_> = outputs.iter().filter(|output| output.write.is_none()).map(|output| output.absence).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let features = outputs.iter().map(|output| output.feature).collect::<Vec<_>>().join(",");
    Err(CommandError::Usage(format!(
        "this build {}; one that does: cargo run --release --features {features} -- …, \
         or cargo install --path . --features {features}",
        missing.join(" and ")
    )))
}

impl OptionalOutput {
    /// Writes its files for a study; none in a build that lacks the feature, see [`require`].
    pub fn write(
        self,
        folder: &StagedFolder,
        scenario: &Scenario,
        study: &Study,
        manifest: &RunManifest,
    ) -> Result<(), CommandError> {
        self.write.map_or(Ok(()), |write| write(folder, scenario, study, manifest))
    }
}

#[cfg(feature = "parquet")]
fn parquet(
    folder: &StagedFolder,
    scenario: &Scenario,
    study: &Study,
    manifest: &RunManifest,
) -> Result<(), CommandError> {
    use crate::output::time_series::write_parquet;
    file_per_case(folder, study, "parquet", |case, to| write_parquet(scenario, study, case, manifest, to))
}

#[cfg(feature = "mcap")]
fn mcap(folder: &StagedFolder, scenario: &Scenario, study: &Study, manifest: &RunManifest) -> Result<(), CommandError> {
    use crate::output::mcap::write_mcap;
    file_per_case(folder, study, "mcap", |case, to| write_mcap(scenario, study, case, manifest, to))
}

/// Writes a file `CASE.extension` for each case.
pub fn file_per_case(
    folder: &StagedFolder,
    study: &Study,
    extension: &str,
    write: impl Fn(&CaseResult, &mut BufWriter<&File>) -> io::Result<()>,
) -> Result<(), CommandError> {
    let mut cases = study.cases.iter();
    Ok(cases.try_for_each(|case| folder.write(&format!("{}.{extension}", case.name), |to| write(case, to)))?)
}

#[cfg(feature = "figures")]
fn figures(folder: &StagedFolder, scenario: &Scenario, study: &Study, _: &RunManifest) -> Result<(), CommandError> {
    use crate::output::figures::{draw, figures};
    use std::io::Write;

    for figure in figures(scenario, study) {
        let png = draw::png(&figure).map_err(|error| CommandError::Figures(error.into()))?;
        for (extension, bytes) in [("svg", draw::svg(&figure).as_bytes()), ("png", &png)] {
            folder.write(&format!("figures/{}.{extension}", figure.name), |to| to.write_all(bytes))?;
        }
    }
    Ok(())
}
