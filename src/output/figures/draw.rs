//! Figures as SVG and PNG by the library kuva, which only this module and `panel` use, and as PDF.
//!
//! # Example
//! ```
//! use planar_capture::output::figures::draw::svg;
//! use planar_capture::output::figures::{Axis, Colour, Dash, Figure, Panel, Series, Width};
//!
//! let line = Series::line("base", Colour::BLACK, Dash::Solid, 1.0, vec![(0.0, 0.0), (10.0, 1.0)]);
//! let panel = Panel::new(Axis::time("Time [s]", 10.0), Axis::new("x [m]", 0.1), vec![line]);
//! let drawn = svg(&Figure::column("drift", vec![panel]), Width::Single);
//! assert!(drawn.contains("width=\"252pt\"")); // a column of a journal, 89 mm
//! assert!(drawn.contains("Time [s]"));
//! ```

use super::figure::Figure;
use super::panel::{self, Backend, PADDING, SPACING, Size};
use super::pdf;
use super::width::Width;
use kuva::backend::svg::SvgBackend;
use kuva::render::figure::{Figure as Grid, FigureLegendPosition};
use kuva::render::render::Scene;

/// Pixels of the PNG per point of the figure: at least 300 per inch at the width of a page.
const PIXELS_PER_POINT: f64 = 3.0;

/// The same for the columns of journals: 400 per inch.
const PIXELS_PER_POINT_OF_COLUMNS: f64 = 400.0 / 72.0;

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
pub fn svg(figure: &Figure, width: Width) -> String {
    let text = own_svg(figure, width);
    let Some(points) = width.points() else { return text };
    // the root's size, which is that of its content
    let (root, rest) = text.split_once('>').unwrap_or((&text, ""));
    let [own_width, own_height] = ["width", "height"].map(|name| attribute(root, name));
    let height = points * own_height / own_width;
    let sized = root.replacen(&format!(" width=\"{own_width}\""), &format!(" width=\"{points}pt\""), 1).replacen(
        &format!(" height=\"{own_height}\""),
        &format!(" height=\"{height:.2}pt\""),
        1,
    );
    let view = format!(" viewBox=\"0 0 {own_width} {own_height}\"");
    let view = if root.contains("viewBox") { "" } else { &view };
    format!("{sized}{view}>{rest}")
}

/// The figure as PDF with embedded fonts; equal figures give equal bytes.
///
/// # Errors
/// [`DrawError`] with the libraries' reason.
pub fn pdf(figure: &Figure, width: Width) -> Result<Vec<u8>, DrawError> {
    let page = pdf::pdf(&own_svg(figure, width), &figure.name, width.points());
    page.map_err(|reason| DrawError { name: figure.name.clone(), reason })
}

/// The figure as PNG.
///
/// # Errors
/// [`DrawError`] with the library's reason.
pub fn png(figure: &Figure, width: Width) -> Result<Vec<u8>, DrawError> {
    let scale = match (width.points(), width.own()) {
        (Some(points), Some(own)) => points / own * PIXELS_PER_POINT_OF_COLUMNS,
        _ => PIXELS_PER_POINT,
    };
    let scene = scene(figure, width, Backend::Raster { scale });
    #[allow(clippy::cast_possible_truncation, reason = "a few pixels")]
    let image = kuva::PngBackend::new().with_scale(scale as f32).render_scene(&scene);
    image.map_err(|reason| DrawError { name: figure.name.clone(), reason })
}

/// In the panels' own scale.
fn own_svg(figure: &Figure, width: Width) -> String {
    let scene = scene(figure, width, Backend::Vector);
    renumber_clip_paths(&SvgBackend::new().with_pretty(true).render_scene(&scene))
}

/// A number among the attributes of an element.
fn attribute(element: &str, name: &str) -> f64 {
    let value = element.split(&format!(" {name}=\"")).nth(1).and_then(|rest| rest.split('"').next());
    value.and_then(|value| value.parse().ok()).expect("the library writes numbers")
}

fn scene(figure: &Figure, width: Width, backend: Backend) -> Scene {
    let columns = width.columns(figure.columns);
    let rows = figure.panels.len().div_ceil(columns).max(1);
    let size = Size::of(figure, width);
    let mut grid = Grid::new(rows, columns)
        .with_plots(figure.panels.iter().map(|panel| panel::plots(panel, &size, backend)).collect())
        .with_layouts(figure.panels.iter().map(|panel| panel::layout(panel, &size, backend)).collect())
        .with_cell_size(size.width(), size.height())
        .with_spacing(SPACING)
        .with_padding(PADDING);
    if let Some(title) = &figure.title {
        grid = grid.with_title(title.as_str()).with_title_size(panel::TITLE);
    }
    if size.shared_legend {
        let entries = panel::legend_entries(figure.panels.iter().flat_map(|panel| &panel.series), backend);
        grid = grid
            .with_shared_legend_position(if width == Width::Page {
                FigureLegendPosition::RightMiddle
            } else {
                FigureLegendPosition::BottomCenter
            })
            .with_shared_legend_entries(entries);
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
