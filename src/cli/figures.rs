//! `--figures`: a file per figure and format, where the build can draw.

use super::Problem;
use planar_capture::output::Staged;
use planar_capture::scenario::Scenario;
use planar_capture::study::Study;
use std::path::Path;

/// Says how to build what can draw.
#[cfg(not(feature = "figures"))]
pub fn require() -> Result<(), Problem> {
    Err(Problem::Usage(
        "this build draws no figures; one that does: cargo run --release --features figures -- …, \
         or cargo install --path . --features figures",
    ))
}

/// Nothing is staged by a build that draws no figures.
#[cfg(not(feature = "figures"))]
pub fn stage(_: &Path, _: &Scenario, _: &Study) -> Result<Vec<Staged>, Problem> {
    require().map(|()| Vec::new())
}

/// This build can draw.
#[cfg(feature = "figures")]
#[allow(clippy::unnecessary_wraps, reason = "other builds cannot draw")]
pub fn require() -> Result<(), Problem> {
    Ok(())
}

/// All figures of a study, as SVG and PNG in a folder `figures`.
#[cfg(feature = "figures")]
pub fn stage(folder: &Path, scenario: &Scenario, study: &Study) -> Result<Vec<Staged>, Problem> {
    use planar_capture::figures::{draw, figures};
    use planar_capture::output::make_folder;
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
