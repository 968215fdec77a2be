//! What a figure shows, independent of the library that draws it.

use super::style::{Colour, Dash, Shape};

/// Panels with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Usable as a file name.
    pub name: String,
    /// What it shows, in one sentence.
    pub caption: String,
    /// Panels side by side; with more than one they share a legend.
    pub columns: usize,
    /// Row by row.
    pub panels: Vec<Panel>,
}

/// One pair of axes and what is drawn between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Above the panel.
    pub title: Option<String>,
    /// Horizontal.
    pub x: Axis,
    /// Vertical.
    pub y: Axis,
    /// A metre to the right is as long as a metre up.
    pub equal_scale: bool,
    /// In the order of drawing.
    pub series: Vec<Series>,
}

/// One axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// From where to where.
    pub span: Span,
}

/// From where to where an axis goes.
#[derive(Clone, Debug, PartialEq)]
pub enum Span {
    /// As far as the data, and at least so much: noise about zero stays a line.
    Data(f64),
    /// The same, and zero is on it: parts of the whole are seen as such.
    DataAndZero(f64),
    /// From the first number to the second.
    Between(f64, f64),
    /// From ten to the first exponent to ten to the second; the data are logarithms to base 10.
    Powers(i16, i16),
    /// One place for each name, at 1, 2, … from the lower or left end.
    Names(Vec<String>),
}

/// A line, or points.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// In the legend; series of the same label are one there.
    pub label: Option<String>,
    /// Told apart by colour …
    pub colour: Colour,
    /// … and by what does not need colour.
    pub mark: Mark,
    /// (x, y).
    pub points: Vec<(f64, f64)>,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// A line through the points; its width in points of the figure.
    Line(Dash, f64),
    /// A symbol at each point.
    Points(Shape),
}

impl Axis {
    /// Fits the data, showing at least `least` of the quantity.
    #[must_use]
    pub fn new(label: &str, least: f64) -> Self {
        Self { label: label.to_owned(), span: Span::Data(least) }
    }

    /// Time, exactly as long as `duration`, in s.
    #[must_use]
    pub fn time(label: &str, duration: f64) -> Self {
        Self { label: label.to_owned(), span: Span::Between(0.0, duration) }
    }
}

impl Panel {
    /// A panel without title and with axes of their own scales.
    #[must_use]
    pub fn new(x: Axis, y: Axis, series: Vec<Series>) -> Self {
        Self { title: None, x, y, equal_scale: false, series }
    }
}

impl Figure {
    /// Panels below each other.
    #[must_use]
    pub fn column(name: &str, caption: &str, panels: Vec<Panel>) -> Self {
        Self { name: name.to_owned(), caption: caption.to_owned(), columns: 1, panels }
    }
}
