//! Figures as SVG and PNG by the library kuva, which only this module and `panel` use.

use super::figure::Figure;
use super::panel::{self, Backend, Size};
use kuva::backend::svg::SvgBackend;
use kuva::render::figure::{Figure as Grid, FigureLegendPosition};
use kuva::render::render::Scene;

/// Pixels of the PNG per point of the figure: at least 300 per inch at the width of a page.
const PIXELS_PER_POINT: f32 = 3.0;

/// A figure that could not be drawn.
#[derive(Debug, thiserror::Error)]
#[error("figure `{name}` could not be drawn: {reason}")]
pub struct DrawError {
    /// The figure's name.
    pub name: String,
    /// The library's message.
    pub reason: String,
}

/// The figure as SVG; equal figures give equal bytes.
#[must_use]
pub fn svg(figure: &Figure) -> String {
    renumber_clip_paths(&SvgBackend::new().with_pretty(true).render_scene(&scene(figure, Backend::Vector)))
}

/// The figure as PNG.
///
/// # Errors
/// [`DrawError`] with the library's reason.
pub fn png(figure: &Figure) -> Result<Vec<u8>, DrawError> {
    let scene = scene(figure, Backend::Raster { scale: f64::from(PIXELS_PER_POINT) });
    let image = kuva::PngBackend::new().with_scale(PIXELS_PER_POINT).render_scene(&scene);
    image.map_err(|reason| DrawError { name: figure.name.clone(), reason })
}

fn scene(figure: &Figure, backend: Backend) -> Scene {
    let columns = figure.columns.max(1);
    let rows = figure.panels.len().div_ceil(columns).max(1);
    let size = Size::of(figure);
    let mut grid = Grid::new(rows, columns)
        .with_plots(figure.panels.iter().map(|panel| panel::plots(panel, &size, backend)).collect())
        .with_layouts(figure.panels.iter().map(|panel| panel::layout(panel, &size, backend)).collect())
        .with_cell_size(size.width(), size.height())
        .with_spacing(8.0)
        .with_padding(6.0);
    if size.shared_legend {
        let entries = panel::legend_entries(figure.panels.iter().flat_map(|panel| &panel.series), backend);
        grid = grid.with_shared_legend_position(FigureLegendPosition::RightMiddle).with_shared_legend_entries(entries);
    }
    grid.render()
}

/// Numbers the clip paths from 0; the library's numbers continue from one figure to the next.
fn renumber_clip_paths(text: &str) -> String {
    const PREFIX: &str = "kuva-clip-";
    let mut parts = text.split(PREFIX);
    let mut numbered = parts.next().unwrap_or_default().to_owned();
    let mut seen: Vec<&str> = Vec::new();
    for part in parts {
        let digits = part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len());
        let (number, rest) = part.split_at(digits);
        let index = seen.iter().position(|known| *known == number).unwrap_or_else(|| {
            seen.push(number);
            seen.len() - 1
        });
        numbered.extend(["clip-", &index.to_string(), rest]);
    }
    numbered
}
