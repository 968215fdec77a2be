//! Files of `run` that only a build with the cargo feature of the same name can write.

use super::CommandError;
use crate::capture::{CaseResult, Study};
use crate::diagnostic::nearest;
use crate::output::figure_kinds::{FIGURE_KINDS, is_kind};
use crate::output::result_folder::StagedFolder;
use crate::output::study_part::StudyPart;
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

type Write = fn(&StagedFolder, &StudyPart<'_>, &Flags) -> Result<(), CommandError>;

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
    /// Draw figures too, as SVG, PDF and PNG in DIR/figures: all, or those of which a name begins with one in LIST, such
    /// as `approach,momentum`; needs a build with the feature `figures`.
    #[arg(long, help_heading = "Results", value_name = "LIST", value_delimiter = ',', num_args = 0..=1)]
    #[arg(require_equals = true, default_missing_value = "", value_parser = kind)]
    figures: Option<Vec<String>>,
    /// Width of the figures: what they need, or one or two columns of a journal (252 and 516 points).
    #[arg(long, help_heading = "Results", value_enum, default_value_t = FigureWidth::Page)]
    #[arg(value_name = "WIDTH", requires = "figures")]
    figure_width: FigureWidth,
    /// Write DIR/CASE.parquet too: the time series in binary; needs a build with the feature `parquet`.
    #[arg(long, help_heading = "Results")]
    parquet: bool,
    /// Write DIR/CASE.mcap too, for Foxglove and Rerun; needs a build with the feature `mcap`.
    #[arg(long, help_heading = "Results")]
    mcap: bool,
}

/// Widths of figures, in builds without them too.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum FigureWidth {
    /// What each needs.
    #[default]
    Page,
    /// Two columns, 516 points, text of 8 points.
    Double,
    /// One column, 252 points, text of 7 points.
    Single,
}

fn kind(text: &str) -> Result<String, String> {
    if text.is_empty() || is_kind(text) {
        return Ok(text.to_owned());
    }
    let meant = nearest(text, FIGURE_KINDS).map_or_else(String::new, |kind| format!("did you mean `{kind}`? "));
    Err(format!("{meant}expected some of {}, or their first words", FIGURE_KINDS.join(", ")))
}

impl Flags {
    /// The outputs that are requested.
    pub fn requested(&self) -> Vec<OptionalOutput> {
        // only a build with figures has a use for their width
        let Self { figures, figure_width: _, parquet, mcap } = self;
        let flags = [(figures.is_some(), FIGURES), (*parquet, PARQUET), (*mcap, MCAP)];
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
    pub fn write(self, folder: &StagedFolder, part: &StudyPart<'_>, flags: &Flags) -> Result<(), CommandError> {
        self.write.map_or(Ok(()), |write| write(folder, part, flags))
    }
}

#[cfg(feature = "parquet")]
fn parquet(
    folder: &StagedFolder,
    StudyPart { scenario, study, manifest, .. }: &StudyPart<'_>,
    _: &Flags,
) -> Result<(), CommandError> {
    use crate::output::time_series::write_parquet;
    file_per_case(folder, study, "parquet", |case, to| write_parquet(scenario, study, case, manifest, to))
}

#[cfg(feature = "mcap")]
fn mcap(
    folder: &StagedFolder,
    StudyPart { scenario, study, manifest, .. }: &StudyPart<'_>,
    _: &Flags,
) -> Result<(), CommandError> {
    use crate::output::mcap::write_mcap;
    file_per_case(folder, study, "mcap", |case, to| write_mcap(scenario, study, case, manifest, to))
}

/// Writes a file `CASE.extension` for each case.
pub fn file_per_case(
    folder: &StagedFolder,
    study: &Study,
    extension: &str,
    mut write: impl FnMut(&CaseResult, &mut BufWriter<&File>) -> io::Result<()>,
) -> Result<(), CommandError> {
    let mut cases = study.cases.iter();
    Ok(cases.try_for_each(|case| folder.write(&format!("{}.{extension}", case.name), |to| write(case, to)))?)
}

#[cfg(feature = "figures")]
fn figures(
    folder: &StagedFolder,
    StudyPart { scenario, study, variant, .. }: &StudyPart<'_>,
    flags: &Flags,
) -> Result<(), CommandError> {
    use crate::output::figure_kinds::begins_with;
    use crate::output::figures::{Width, draw, figures};
    use std::io::Write;

    let width = match flags.figure_width {
        FigureWidth::Page => Width::Page,
        FigureWidth::Double => Width::Double,
        FigureWidth::Single => Width::Single,
    };
    let wanted: Vec<_> = flags.figures.iter().flatten().filter(|word| !word.is_empty()).collect();
    let is_wanted = |name: &str| wanted.is_empty() || wanted.iter().any(|word| begins_with(name, word));
    let own = variant.map_or_else(String::new, |variant| format!("{}/", variant.name()));
    for figure in figures(scenario, study).iter().filter(|figure| is_wanted(&figure.name)) {
        let failed = |error: draw::DrawError| CommandError::Figures(error.into());
        let svg = draw::svg(figure, width).into_bytes();
        let files = [
            ("svg", svg),
            ("pdf", draw::pdf(figure, width).map_err(failed)?),
            ("png", draw::png(figure, width).map_err(failed)?),
        ];
        for (extension, bytes) in files {
            folder.write(&format!("figures/{own}{}.{extension}", figure.name), |to| to.write_all(&bytes))?;
        }
    }
    Ok(())
}
