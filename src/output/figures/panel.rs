//! A panel as layout and plots of kuva.

use super::dash::strokes;
use super::figure::{Axis, AxisRange, Figure, Mark, Panel, Series};
use super::scale::{Scale, scale};
use super::style::{Dash, Symbol};
use super::width::Width;
use kuva::plot::line::LineStyle;
use kuva::plot::{Histogram, LegendEntry, LegendPosition, LegendShape, LinePlot, MarkerShape, ScatterPlot};
use kuva::render::annotations::TextAnnotation;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use std::sync::Arc;

/// Verdana and `DejaVu` Sans have the same widths, so that labels fit with either. An embedded font would add a
/// megabyte to every SVG file.
const FONT: &str = "DejaVu Sans, Verdana, sans-serif";

/// Lengths of strokes and gaps in the legend over those of the curves.
const LEGEND_DASH: f64 = 0.5;

/// Between panels and around them, points.
pub(super) const SPACING: f64 = 8.0;
pub(super) const PADDING: f64 = 6.0;

/// Least side of a frame, points; long names can make a figure wider than its column, which then scales all of it.
const LEAST_FRAME: f64 = 130.0;

/// Width of a character, points.
const CHARACTER: f64 = 7.2;

/// Of a bar's name above the middle of its place, in places; the library puts it somewhat higher.
const NAME: f64 = -0.07;

/// Height of titles, points, and the least of those that are longer than their panel is wide.
pub(super) const TITLE: u32 = 13;
const LEAST_TITLE: u32 = 8;

/// Height of an entry of a legend, points.
const LEGEND_LINE: f64 = 18.0;

/// The kind of image.
#[derive(Clone, Copy, Debug)]
pub(super) enum Backend {
    /// SVG, which has dash patterns.
    Vector,
    /// PNG. The library restarts the dash pattern at each point of a line and does not scale it; [`strokes`] cuts the
    /// lines instead.
    Raster {
        /// Pixels per point.
        scale: f64,
    },
}

/// Sizes of a panel, points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    /// Width and height between the axes.
    frame: [f64; 2],
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    /// Height of the panels' titles.
    title: u32,
    /// Whether there is one legend for all panels.
    pub(super) shared_legend: bool,
    /// The number of entries that each panel's legend has below it; `None` for legends beside the panels.
    legend_below: Option<usize>,
}

impl Size {
    /// The same for all panels of a figure.
    pub(super) fn of(figure: &Figure, width: Width) -> Self {
        let shared_legend = figure.columns > 1;
        let equal_scale = figure.panels.iter().any(|panel| panel.equal_scale);
        let labels = figure.panels.iter().flat_map(|panel| &panel.series).filter_map(|series| series.label.as_ref());
        let names = figure.panels.iter().filter_map(|panel| match &panel.y.range {
            AxisRange::Categories(names) => Some(names),
            _ => None,
        });
        let entries = |panel: &Panel| legend_entries(&panel.series, Backend::Vector).len();
        // the library puts the axis's label above its own legend: panels of one height have legends of one height
        let legend_below = (width == Width::Single && !shared_legend)
            .then(|| figure.panels.iter().map(entries).max().unwrap_or_default());
        let beside = !shared_legend && legend_below.is_none();
        let left = (34.0 + longest(names.flatten())).max(if equal_scale { 60.0 } else { 86.0 });
        let right = if beside { 60.0 + longest(labels) } else { 12.0 };
        let lines = figure.panels.iter().map(|panel| height_of_lines(panel, beside)).fold(0.0, f64::max);
        let frame = match (width.own(), equal_scale) {
            (None, true) => [if shared_legend { 230.0 } else { 360.0 }; 2],
            (None, false) => [470.0, lines.max(190.0)],
            (Some(whole), _) => {
                let columns = u32::try_from(width.columns(figure.columns)).map_or(1.0, f64::from);
                let cell = (whole - 2.0 * PADDING - (columns - 1.0) * SPACING) / columns;
                let frame = (cell - left - right).max(LEAST_FRAME);
                [frame, if equal_scale { frame } else { lines.max(0.45 * frame).max(LEAST_FRAME) }]
            }
        };
        let legend = legend_below.filter(|entries| *entries > 0).map_or(0.0, |entries| lines_height(entries + 1));
        // in the middle of its frame, without reaching into the next panel or beyond the page
        let titles = figure.panels.iter().filter_map(|panel| panel.title.as_ref());
        let room = frame[0] + 2.0 * (left.min(right) + PADDING);
        let is_long = |title: u32| f64::from(title) / 12.0 * longest(titles.clone()) > room;
        let title = (LEAST_TITLE..TITLE).rev().fold(TITLE, |title, less| if is_long(title) { less } else { title });
        Self {
            frame,
            title,
            left,
            right,
            top: if figure.panels.iter().any(|panel| panel.title.is_some()) { 32.0 } else { 12.0 },
            bottom: 48.0 + legend,
            shared_legend,
            legend_below,
        }
    }

    pub(super) fn width(&self) -> f64 {
        self.left + self.frame[0] + self.right
    }

    pub(super) fn height(&self) -> f64 {
        self.top + self.frame[1] + self.bottom
    }
}

/// Height of the categories, or of a legend beside them if that has more lines.
fn height_of_lines(panel: &Panel, legend_beside: bool) -> f64 {
    let names = match &panel.y.range {
        AxisRange::Categories(names) => {
            let symbols = panel.series.iter().filter(|series| matches!(series.mark, Mark::Points(_))).count();
            // two symbols to a line
            names.len() * symbols.div_ceil(2).max(1)
        }
        AxisRange::NamedBars(names) => 2 * names.len(),
        _ => 0,
    };
    let legend = if legend_beside { legend_entries(&panel.series, Backend::Vector).len() } else { 0 };
    lines_height(names.max(legend))
}

fn lines_height(lines: usize) -> f64 {
    LEGEND_LINE * u32::try_from(lines).map_or(0.0, f64::from)
}

/// Width of the longest text.
fn longest<'a>(texts: impl Iterator<Item = &'a String>) -> f64 {
    CHARACTER * texts.map(|text| u32::try_from(text.chars().count()).map_or(0.0, f64::from)).fold(0.0, f64::max)
}

/// Axes, grid and legend.
pub(super) fn layout(panel: &Panel, size: &Size, backend: Backend) -> Layout {
    let [x, y] = scales(panel);
    let x = match panel.x.range {
        AxisRange::Categories(_) | AxisRange::PowersOfTen(..) => x,
        _ => x.with_room(size.frame[0], CHARACTER),
    };
    let mut layout = Layout::new((x.low, x.high), (y.low, y.high))
        .with_x_axis_min(x.low)
        .with_x_axis_max(x.high)
        .with_y_axis_min(y.low)
        .with_y_axis_max(y.high)
        .with_x_tick_step(x.step)
        .with_y_tick_step(y.step)
        .with_x_label(panel.x.label.as_str())
        .with_y_label(panel.y.label.as_str())
        .with_x_tick_format(ticks(&panel.x, x))
        .with_y_tick_format(ticks(&panel.y, y))
        .with_font_family(FONT)
        .with_box_axes()
        .with_label_size(13)
        .with_tick_size(12)
        .with_body_size(12)
        .with_title_size(size.title)
        .with_axis_line_width(1.0)
        .with_grid_line_width(0.5)
        .with_force_margins(size.left, size.right)
        .with_force_margins_y(size.top, size.bottom);
    if let Some(title) = &panel.title {
        layout = layout.with_title(title.as_str());
    }
    if let AxisRange::NamedBars(names) = &panel.y.range {
        let middle = f64::midpoint(x.low, x.high);
        let name = |(i, name): (u32, &String)| TextAnnotation::new(name, middle, f64::from(i) + NAME);
        layout = (1_u32..).zip(names).map(name).fold(layout, Layout::with_annotation);
    }
    // without entries, the library puts the axis's label over its ticks
    if !size.shared_legend && size.legend_below != Some(0) {
        let mut entries = legend_entries(&panel.series, backend);
        let blank = || LegendEntry {
            label: "\u{2002}".to_owned(),
            color: "white".to_owned(),
            shape: LegendShape::Line,
            dasharray: None,
        };
        entries.resize_with(entries.len().max(size.legend_below.unwrap_or_default()), blank);
        layout = layout
            .with_legend_entries(entries)
            .with_legend_position(if size.legend_below.is_some() {
                LegendPosition::OutsideBottomLeft
            } else {
                LegendPosition::OutsideRightTop
            })
            .with_legend_box(false);
    }
    layout
}

fn scales(panel: &Panel) -> [Scale; 2] {
    let points = || panel.series.iter().flat_map(|series| &series.points);
    [scale(&panel.x.range, points().map(|p| p.0)), scale(&panel.y.range, points().map(|p| p.1))]
}

fn ticks(axis: &Axis, scale: Scale) -> TickFormat {
    let names = match &axis.range {
        AxisRange::Categories(names) => names.clone(),
        AxisRange::NamedBars(_) => Vec::new(),
        AxisRange::PowersOfTen(..) => return TickFormat::Custom(Arc::new(|exponent| power_of_ten(exponent.round()))),
        _ => return TickFormat::Custom(Arc::new(move |value| scale.label(value))),
    };
    TickFormat::Custom(Arc::new(move |value| {
        let place = (1_u32..).zip(&names).find(|(i, _)| (f64::from(*i) - value).abs() < 0.1);
        place.map(|(_, name)| name.clone()).unwrap_or_default()
    }))
}

/// 10⁻⁶ for −6.
pub(crate) fn power_of_ten(exponent: f64) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let text = format!("{exponent:.0}");
    let raised: String = text.chars().map(|c| c.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize])).collect();
    format!("10{raised}")
}

/// Each label once, in the order of drawing.
pub(super) fn legend_entries<'a>(all: impl IntoIterator<Item = &'a Series>, backend: Backend) -> Vec<LegendEntry> {
    let mut entries: Vec<LegendEntry> = Vec::new();
    for series in all {
        let Some(label) = &series.label else { continue };
        // the library draws dashed lines up to the text
        let label = format!("\u{2002}{label}");
        if entries.iter().any(|entry| entry.label == label) {
            continue;
        }
        let (shape, dasharray) = match series.mark {
            Mark::Line(dash, _) => (LegendShape::Line, lengths(dash, LEGEND_DASH, backend)),
            Mark::Points(symbol) => (LegendShape::Marker(marker(symbol)), None),
            Mark::Bars => (LegendShape::Rect, None),
        };
        let color = series.colour.hexadecimal();
        entries.push(LegendEntry { label, color, shape, dasharray });
    }
    entries
}

/// Lengths of strokes and gaps, `size` times those of the figure; `None` for a solid line.
fn lengths(dash: Dash, size: f64, backend: Backend) -> Option<String> {
    let scale = match backend {
        Backend::Vector => size,
        Backend::Raster { scale } => size * scale,
    };
    let lengths: Vec<String> = dash.lengths().iter().map(|length| (length * scale).to_string()).collect();
    (!lengths.is_empty()).then(|| lengths.join(" "))
}

/// Lines and points.
pub(super) fn plots(panel: &Panel, size: &Size, backend: Backend) -> Vec<Plot> {
    let [x, y] = scales(panel);
    let points_per_unit = [size.frame[0] / (x.high - x.low), size.frame[1] / (y.high - y.low)];
    panel.series.iter().flat_map(|series| plot(series, points_per_unit, backend)).collect()
}

fn plot(series: &Series, points_per_unit: [f64; 2], backend: Backend) -> Vec<Plot> {
    let colour = series.colour.hexadecimal();
    let points = series.points.iter().copied();
    let line =
        |points: Vec<(f64, f64)>, width| LinePlot::new().with_data(points).with_color(&colour).with_stroke_width(width);
    match (series.mark, backend) {
        (Mark::Bars, _) => {
            let (edges, mut heights): (Vec<f64>, Vec<f64>) = points.unzip();
            heights.pop();
            vec![Plot::Histogram(Histogram::from_bins(edges, heights).with_color(&colour))]
        }
        (Mark::Points(symbol), _) => {
            let size = if symbol == Symbol::Dot { 2.0 } else { 4.5 };
            let scatter = ScatterPlot::new().with_data(points).with_color(&colour).with_size(size);
            vec![Plot::Scatter(scatter.with_marker(marker(symbol)))]
        }
        (Mark::Line(dash, width), Backend::Raster { .. }) => {
            let strokes = strokes(&series.points, points_per_unit, dash);
            strokes.into_iter().map(|stroke| Plot::Line(line(stroke, width))).collect()
        }
        (Mark::Line(dash, width), Backend::Vector) => {
            let style = lengths(dash, 1.0, backend).map_or(LineStyle::Solid, LineStyle::Custom);
            vec![Plot::Line(line(points.collect(), width).with_line_style(style))]
        }
    }
}

fn marker(symbol: Symbol) -> MarkerShape {
    match symbol {
        Symbol::Circle | Symbol::Dot => MarkerShape::Circle,
        Symbol::Square => MarkerShape::Square,
        Symbol::Cross => MarkerShape::Cross,
        Symbol::Plus => MarkerShape::Plus,
    }
}
