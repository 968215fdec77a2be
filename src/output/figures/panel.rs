//! Turns a panel into what kuva draws.

use super::dash::strokes;
use super::figure::{Axis, Figure, Mark, Panel, Series, Span};
use super::scale::{Scale, scale};
use super::style::{Dash, Shape};
use kuva::plot::line::LineStyle;
use kuva::plot::{LegendEntry, LegendPosition, LegendShape, LinePlot, MarkerShape, ScatterPlot};
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use std::sync::Arc;

/// Verdana is as wide as `DejaVu` Sans, so that labels fit where either is installed. Embedded, the font would add a
/// megabyte to every file; the PNG files have it drawn in.
const FONT: &str = "DejaVu Sans, Verdana, sans-serif";

/// Dashes of the legend's samples, which are short, against those of the curves.
const SAMPLE: f64 = 0.5;

/// What is drawn on.
#[derive(Clone, Copy, Debug)]
pub(super) enum Medium {
    /// Knows dashes.
    Vector,
    /// The library starts a dash anew at each point of a line, and does not scale it: lines are cut here instead.
    Raster {
        /// Pixels per point.
        scale: f64,
    },
}

/// Sizes of a panel, in points of the figure.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    /// Of the axes' frame.
    frame: [f64; 2],
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    /// One legend for all panels, beside them.
    pub(super) shared_legend: bool,
}

impl Size {
    /// The same for all panels of a figure.
    pub(super) fn of(figure: &Figure) -> Self {
        let shared_legend = figure.columns > 1;
        let pictures = figure.panels.iter().any(|panel| panel.equal_scale);
        let labels = figure.panels.iter().flat_map(|panel| &panel.series).filter_map(|series| series.label.as_ref());
        let names = figure.panels.iter().filter_map(|panel| match &panel.y.span {
            Span::Names(names) => Some(names),
            _ => None,
        });
        let frame = match (pictures, shared_legend) {
            (true, true) => [230.0; 2],
            (true, false) => [360.0; 2],
            (false, _) => [470.0, figure.panels.iter().map(lines).fold(190.0, f64::max)],
        };
        Self {
            frame,
            left: (34.0 + longest(names.flatten())).max(if pictures { 60.0 } else { 86.0 }),
            right: if shared_legend { 12.0 } else { 60.0 + longest(labels) },
            top: if figure.panels.iter().any(|panel| panel.title.is_some()) { 32.0 } else { 12.0 },
            bottom: 48.0,
            shared_legend,
        }
    }

    pub(super) fn width(&self) -> f64 {
        self.left + self.frame[0] + self.right
    }

    pub(super) fn height(&self) -> f64 {
        self.top + self.frame[1] + self.bottom
    }
}

/// Height of what stands line by line: the legend, and names along the axis.
fn lines(panel: &Panel) -> f64 {
    let names = if let Span::Names(names) = &panel.y.span { names.len() } else { 0 };
    let count = entries(panel, Medium::Vector).len().max(names);
    18.0 * u32::try_from(count).map_or(0.0, f64::from)
}

/// Width of the longest text.
fn longest<'a>(texts: impl Iterator<Item = &'a String>) -> f64 {
    7.2 * texts.map(|text| u32::try_from(text.chars().count()).map_or(0.0, f64::from)).fold(0.0, f64::max)
}

/// Axes, grid and legend.
pub(super) fn layout(panel: &Panel, size: &Size, medium: Medium) -> Layout {
    let [x, y] = scales(panel);
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
        .with_title_size(13)
        .with_axis_line_width(1.0)
        .with_grid_line_width(0.5)
        .with_force_margins(size.left, size.right)
        .with_force_margins_y(size.top, size.bottom);
    if let Some(title) = &panel.title {
        layout = layout.with_title(title.as_str());
    }
    if !size.shared_legend {
        layout = layout
            .with_legend_entries(entries(panel, medium))
            .with_legend_position(LegendPosition::OutsideRightTop)
            .with_legend_box(false);
    }
    layout
}

fn scales(panel: &Panel) -> [Scale; 2] {
    let points = || panel.series.iter().flat_map(|series| &series.points);
    [scale(&panel.x.span, points().map(|p| p.0)), scale(&panel.y.span, points().map(|p| p.1))]
}

fn ticks(axis: &Axis, scale: Scale) -> TickFormat {
    let names = match &axis.span {
        Span::Names(names) => names.clone(),
        Span::Powers(..) => return TickFormat::Custom(Arc::new(|exponent| power_of_ten(exponent.round()))),
        _ => return TickFormat::Custom(Arc::new(move |value| scale.label(value))),
    };
    TickFormat::Custom(Arc::new(move |value| {
        let place = (1_u32..).zip(&names).find(|(i, _)| (f64::from(*i) - value).abs() < 0.1);
        place.map(|(_, name)| name.clone()).unwrap_or_default()
    }))
}

/// 10⁻⁶ for −6.
fn power_of_ten(exponent: f64) -> String {
    let raised = format!("{exponent:.0}")
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            digit => digit.to_digit(10).and_then(|digit| char::from_u32(0x2070 + digit)).unwrap_or(digit),
        })
        .collect::<String>();
    format!("10{raised}")
}

/// Each label once, in the order of drawing.
pub(super) fn entries(panel: &Panel, medium: Medium) -> Vec<LegendEntry> {
    let mut entries: Vec<LegendEntry> = Vec::new();
    for series in &panel.series {
        let Some(label) = &series.label else { continue };
        // the library's samples of dashed lines reach up to the text
        let label = format!("\u{2002}{label}");
        if entries.iter().any(|entry| entry.label == label) {
            continue;
        }
        let (shape, dasharray) = match series.mark {
            Mark::Line(dash, _) => (LegendShape::Line, lengths(dash, SAMPLE, medium)),
            Mark::Points(shape) => (LegendShape::Marker(marker(shape)), None),
        };
        let color = series.colour.hexadecimal().to_owned();
        entries.push(LegendEntry { label, color, shape, dasharray });
    }
    entries
}

/// Strokes and gaps, `size` times as long as in the figure.
fn lengths(dash: Dash, size: f64, medium: Medium) -> Option<String> {
    let scale = match medium {
        Medium::Vector => size,
        Medium::Raster { scale } => size * scale,
    };
    let lengths: Vec<String> = dash.lengths().iter().map(|length| (length * scale).to_string()).collect();
    if lengths.is_empty() { None } else { Some(lengths.join(" ")) }
}

/// Lines and points.
pub(super) fn plots(panel: &Panel, size: &Size, medium: Medium) -> Vec<Plot> {
    let [x, y] = scales(panel);
    let points_per_unit = [size.frame[0] / (x.high - x.low), size.frame[1] / (y.high - y.low)];
    panel.series.iter().flat_map(|series| plot(series, points_per_unit, medium)).collect()
}

fn plot(series: &Series, points_per_unit: [f64; 2], medium: Medium) -> Vec<Plot> {
    let colour = series.colour.hexadecimal();
    let points = series.points.iter().copied();
    let line =
        |points: Vec<(f64, f64)>, width| LinePlot::new().with_data(points).with_color(colour).with_stroke_width(width);
    match (series.mark, medium) {
        (Mark::Points(shape), _) => {
            let symbols = ScatterPlot::new().with_data(points).with_color(colour).with_size(4.5);
            vec![Plot::Scatter(symbols.with_marker(marker(shape)))]
        }
        (Mark::Line(dash, width), Medium::Raster { .. }) => {
            let cut = strokes(&series.points, points_per_unit, dash);
            cut.into_iter().map(|stroke| Plot::Line(line(stroke, width))).collect()
        }
        (Mark::Line(dash, width), Medium::Vector) => {
            let style = lengths(dash, 1.0, medium).map_or(LineStyle::Solid, LineStyle::Custom);
            vec![Plot::Line(line(points.collect(), width).with_line_style(style))]
        }
    }
}

fn marker(shape: Shape) -> MarkerShape {
    match shape {
        Shape::Circle => MarkerShape::Circle,
        Shape::Square => MarkerShape::Square,
        Shape::Cross => MarkerShape::Cross,
        Shape::Plus => MarkerShape::Plus,
    }
}
