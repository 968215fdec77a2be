//! Widths of figures: as wide as they need, or as the columns of a journal.

/// How wide a figure is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Width {
    /// As its content needs, for a screen or a whole page; text of 12 points.
    #[default]
    Page,
    /// Two columns of a journal, 516 points (182 mm); text of 8 points.
    Double,
    /// One column of a journal, 252 points (89 mm), with legends below; text of 7 points.
    Single,
}

/// Text in points of the panels' own scale.
const TEXT: f64 = 12.0;

impl Width {
    /// On the page, points; `None` where the content decides.
    #[must_use]
    pub const fn points(self) -> Option<f64> {
        match self {
            Self::Page => None,
            Self::Double => Some(516.0),
            Self::Single => Some(252.0),
        }
    }

    /// In the panels' own scale, in which text has 12 points.
    pub(super) fn own(self) -> Option<f64> {
        let text = if self == Self::Single { 7.0 } else { 8.0 };
        self.points().map(|points| points * TEXT / text)
    }

    /// Panels side by side, of those that a figure has.
    pub(super) fn columns(self, wanted: usize) -> usize {
        if self == Self::Single { wanted.clamp(1, 2) } else { wanted.max(1) }
    }
}
