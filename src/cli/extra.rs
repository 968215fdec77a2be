//! What `run` writes only where the build has a cargo feature for it.

use super::Problem;
use planar_capture::capture::Study;
use planar_capture::output::atomic_file::Staged;
use planar_capture::scenario::Scenario;
use std::fmt;
use std::path::Path;
#[cfg(any(feature = "parquet", feature = "mcap"))]
use {
    planar_capture::capture::CaseResult,
    std::fs::File,
    std::io::{self, BufWriter},
};

/// A kind of output that takes a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extra {
    /// Pictures, and the report that shows them.
    Figures,
    /// A Parquet file per case.
    Parquet,
    /// An MCAP file per case.
    Mcap,
}

/// The flags of `run` that ask for them.
#[derive(Debug, clap::Args)]
pub struct Flags {
    /// Draw figures too, as SVG and PNG in DIR/figures; needs a build with the feature `figures`.
    #[arg(long)]
    figures: bool,
    /// Write DIR/CASE.parquet too: the time series in binary; needs a build with the feature `parquet`.
    #[arg(long)]
    parquet: bool,
    /// Write DIR/CASE.mcap too, for Foxglove and Rerun; needs a build with the feature `mcap`.
    #[arg(long)]
    mcap: bool,
}

impl Flags {
    /// What is asked for.
    pub fn asked(&self) -> Vec<Extra> {
        let flags = [(self.figures, Extra::Figures), (self.parquet, Extra::Parquet), (self.mcap, Extra::Mcap)];
        flags.into_iter().filter_map(|(asked, extra)| asked.then_some(extra)).collect()
    }
}

/// What was asked for, where the build lacks some of it.
#[derive(Debug)]
pub struct Lacking(Vec<Extra>);

/// Says how to build what has all that is asked for.
pub fn require(asked: &[Extra]) -> Result<(), Problem> {
    if asked.iter().all(|extra| extra.is_there()) { Ok(()) } else { Err(Problem::Lacking(Lacking(asked.to_vec()))) }
}

impl fmt::Display for Lacking {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lacking: Vec<_> = self.0.iter().filter(|extra| !extra.is_there()).map(|extra| extra.lack()).collect();
        let features: Vec<_> = self.0.iter().map(|extra| extra.feature()).collect();
        let features = features.join(",");
        write!(
            f,
            "this build {}; one that does: cargo run --release --features {features} -- …, \
             or cargo install --path . --features {features}",
            lacking.join(" and ")
        )
    }
}

impl Extra {
    fn feature(self) -> &'static str {
        match self {
            Self::Figures => "figures",
            Self::Parquet => "parquet",
            Self::Mcap => "mcap",
        }
    }

    fn lack(self) -> &'static str {
        match self {
            Self::Figures => "draws no figures",
            Self::Parquet => "writes no Parquet",
            Self::Mcap => "writes no MCAP",
        }
    }

    fn is_there(self) -> bool {
        match self {
            Self::Figures => cfg!(feature = "figures"),
            Self::Parquet => cfg!(feature = "parquet"),
            Self::Mcap => cfg!(feature = "mcap"),
        }
    }

    /// Its files for a study, written but not in their places yet.
    pub fn stage(self, folder: &Path, scenario: &Scenario, study: &Study) -> Result<Vec<Staged>, Problem> {
        require(&[self])?;
        match self {
            #[cfg(feature = "figures")]
            Self::Figures => figures(folder, scenario, study),
            #[cfg(feature = "parquet")]
            Self::Parquet => {
                use planar_capture::output::time_series::write_parquet;
                per_case(folder, study, "parquet", |case, to| write_parquet(scenario, study, case, to))
            }
            #[cfg(feature = "mcap")]
            Self::Mcap => {
                use planar_capture::output::mcap::write_mcap;
                per_case(folder, study, "mcap", |case, to| write_mcap(scenario, study, case, to))
            }
            #[allow(unreachable_patterns, reason = "a build may have all of them")]
            _ => {
                let _ = (folder, scenario, study);
                Ok(Vec::new()) // `require` has said so
            }
        }
    }
}

/// A file CASE.extension for each case.
#[cfg(any(feature = "parquet", feature = "mcap"))]
fn per_case(
    folder: &Path,
    study: &Study,
    extension: &str,
    write: impl Fn(&CaseResult, &mut BufWriter<&File>) -> io::Result<()>,
) -> Result<Vec<Staged>, Problem> {
    let stage = |case: &CaseResult| {
        let path = folder.join(format!("{}.{extension}", case.name));
        Ok(Staged::new(&path, |to| write(case, to))?)
    };
    study.cases.iter().map(stage).collect()
}

/// All figures of a study, as SVG and PNG in a folder `figures`.
#[cfg(feature = "figures")]
fn figures(folder: &Path, scenario: &Scenario, study: &Study) -> Result<Vec<Staged>, Problem> {
    use planar_capture::output::atomic_file::make_folder;
    use planar_capture::output::figures::{draw, figures};
    use std::io::Write;

    let folder = folder.join("figures");
    make_folder(&folder)?;
    let mut files = Vec::new();
    for figure in figures(scenario, study) {
        let (svg, png) = (draw::svg(&figure), draw::png(&figure)?);
        for (extension, bytes) in [("svg", svg.as_bytes()), ("png", &png)] {
            let path = folder.join(format!("{}.{extension}", figure.name));
            files.push(Staged::new(&path, |to| to.write_all(bytes))?);
        }
    }
    Ok(files)
}
