//! Draws figures with kuva: nothing of that library is known outside this file and its neighbour `panel`.

use super::figure::Figure;
use super::panel::{self, Medium, Size};
use kuva::backend::svg::SvgBackend;
use kuva::render::figure::{Figure as Grid, FigureLegendPosition};
use kuva::render::render::Scene;

/// Pixels of the PNG per point of the figure: 300 per inch and more at a page's width.
const PIXELS: f32 = 3.0;

/// A figure that could not be drawn.
#[derive(Debug, thiserror::Error)]
#[error("figure `{name}` could not be drawn: {reason}")]
pub struct DrawError {
    /// The figure's name.
    pub name: String,
    /// What the library says.
    pub reason: String,
}

/// The figure as SVG with text; the same figure gives the same bytes.
#[must_use]
pub fn svg(figure: &Figure) -> String {
    let text = SvgBackend::new().with_pretty(true).render_scene(&scene(figure, Medium::Vector));
    number_clips(&text)
}

/// The figure as PNG.
///
/// # Errors
/// [`DrawError`] with the library's reason.
pub fn png(figure: &Figure) -> Result<Vec<u8>, DrawError> {
    let scene = scene(figure, Medium::Raster { scale: f64::from(PIXELS) });
    let image = kuva::PngBackend::new().with_scale(PIXELS).render_scene(&scene);
    image.map_err(|reason| DrawError { name: figure.name.clone(), reason })
}

fn scene(figure: &Figure, medium: Medium) -> Scene {
    let columns = figure.columns.max(1);
    let rows = figure.panels.len().div_ceil(columns).max(1);
    let size = Size::of(figure);
    let mut grid = Grid::new(rows, columns)
        .with_plots(figure.panels.iter().map(|panel| panel::plots(panel, &size, medium)).collect())
        .with_layouts(figure.panels.iter().map(|panel| panel::layout(panel, &size, medium)).collect())
        .with_cell_size(size.width(), size.height())
        .with_spacing(8.0)
        .with_padding(6.0);
    if size.shared_legend {
        let entries = figure.panels.first().map(|panel| panel::entries(panel, medium)).unwrap_or_default();
        grid = grid.with_shared_legend_position(FigureLegendPosition::RightMiddle).with_shared_legend_entries(entries);
    }
    grid.render()
}

/// Numbers the clip paths from 0: the library counts them on from one figure to the next.
fn number_clips(text: &str) -> String {
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
