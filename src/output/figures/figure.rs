//! The content of a figure, independent of the library that draws it.

use super::style::{Colour, Dash, Symbol};

/// Panels of axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Usable as a file name.
    pub name: String,
    /// Above all panels.
    pub title: Option<String>,
    /// Number of panels side by side; with more than one they share a legend.
    pub columns: usize,
    /// Row by row.
    pub panels: Vec<Panel>,
}

/// One pair of axes with its curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Above the panel.
    pub title: Option<String>,
    /// Horizontal.
    pub x: Axis,
    /// Vertical.
    pub y: Axis,
    /// Whether both axes have the same scale, m.
    pub equal_scale: bool,
    /// In the order of drawing.
    pub series: Vec<Series>,
}

/// One axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// Its ends.
    pub range: AxisRange,
}

/// The ends of an axis.
#[derive(Clone, Debug, PartialEq)]
pub enum AxisRange {
    /// Those of the data, at least this far apart, so that rounding errors about a constant appear as a line.
    Data(f64),
    /// The same, including zero.
    DataAndZero(f64),
    /// From the first number to the second.
    Fixed(f64, f64),
    /// From 10^first to 10^second; the data are logarithms to base 10.
    PowersOfTen(i16, i16),
    /// One position for each name, at 1, 2, … from the lower or left end.
    Categories(Vec<String>),
    /// The same, of bars along the other axis that have their names above them, within the panel.
    NamedBars(Vec<String>),
}

/// A line, points, or bars.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// In the legend; series of equal label share an entry.
    pub label: Option<String>,
    /// Of line, symbols or bars.
    pub colour: Colour,
    /// Line, symbols or bars.
    pub mark: Mark,
    /// (x, y).
    pub points: Vec<(f64, f64)>,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// A line through the points with its width, points.
    Line(Dash, f64),
    /// A symbol at each point.
    Points(Symbol),
    /// Bars from zero to the points, each as wide as up to the next one; the last point ends the last bar.
    Bars,
}

/// Of a time: the half width of a symbol at the side of the narrowest frame.
const BEYOND: f64 = 0.04;

impl Axis {
    /// An axis over the range of the data, at least `minimum_span` long.
    #[must_use]
    pub fn new(label: &str, minimum_span: f64) -> Self {
        Self { label: label.to_owned(), range: AxisRange::Data(minimum_span) }
    }

    /// An axis of time from 0 to `duration`, s, and a little beyond: what is at its ends is neither hidden by the frame nor
    /// cut by it.
    #[must_use]
    pub fn time(label: &str, duration: f64) -> Self {
        let beyond = BEYOND * duration;
        Self { label: label.to_owned(), range: AxisRange::Fixed(-beyond, duration + beyond) }
    }
}

impl Series {
    /// A line through points, its width in points of the page.
    #[must_use]
    pub fn line(label: &str, colour: Colour, dash: Dash, width: f64, points: Vec<(f64, f64)>) -> Self {
        Self { label: Some(label.to_owned()), colour, mark: Mark::Line(dash, width), points }
    }

    /// A symbol at each point.
    #[must_use]
    pub fn symbols(label: &str, colour: Colour, symbol: Symbol, points: Vec<(f64, f64)>) -> Self {
        Self { label: Some(label.to_owned()), colour, mark: Mark::Points(symbol), points }
    }
}

impl Panel {
    /// A panel without title, with independent scales of its axes.
    #[must_use]
    pub fn new(x: Axis, y: Axis, series: Vec<Series>) -> Self {
        Self { title: None, x, y, equal_scale: false, series }
    }
}

impl Figure {
    /// Panels below each other.
    #[must_use]
    pub fn column(name: &str, panels: Vec<Panel>) -> Self {
        Self { name: name.to_owned(), title: None, columns: 1, panels }
    }
}
