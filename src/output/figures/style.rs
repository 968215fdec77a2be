//! Colours, dashes and symbols that everybody can tell apart.

/// Of the palette of Okabe and Ito, which people with any colour vision can tell apart; without its yellow, which is
/// lost on white paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// The first of a family of curves.
    Blue,
    /// The second.
    Vermillion,
    /// The third.
    Green,
    /// The fourth.
    Purple,
    /// The fifth.
    Orange,
    /// The sixth.
    Sky,
    /// The seventh, and what is wanted or printed.
    Black,
    /// What is only there to be seen against.
    Grey,
}

/// How a line is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    /// The first of a family of curves.
    Solid,
    /// The second.
    Dashed,
    /// The third.
    Dotted,
    /// The fourth.
    DashDot,
}

/// A symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// ●
    Circle,
    /// ■
    Square,
    /// ×
    Cross,
    /// +
    Plus,
}

impl Colour {
    /// The colour of a family's member; the eighth has the first one's.
    #[must_use]
    pub fn of(index: usize) -> Self {
        const ALL: [Colour; 7] = [
            Colour::Blue,
            Colour::Vermillion,
            Colour::Green,
            Colour::Purple,
            Colour::Orange,
            Colour::Sky,
            Colour::Black,
        ];
        ALL[index % ALL.len()]
    }

    /// As in SVG.
    #[must_use]
    pub fn hexadecimal(self) -> &'static str {
        match self {
            Self::Blue => "#0072b2",
            Self::Vermillion => "#d55e00",
            Self::Green => "#009e73",
            Self::Purple => "#cc79a7",
            Self::Orange => "#e69f00",
            Self::Sky => "#56b4e9",
            Self::Black => "#000000",
            Self::Grey => "#8c8c8c",
        }
    }
}

impl Dash {
    /// The dash of a family's member; the fifth has the first one's.
    #[must_use]
    pub fn of(index: usize) -> Self {
        const ALL: [Dash; 4] = [Dash::Solid, Dash::Dashed, Dash::Dotted, Dash::DashDot];
        ALL[index % ALL.len()]
    }

    /// Lengths of strokes and gaps in turn, in points of the figure; none for a line without gaps.
    #[must_use]
    pub fn lengths(self) -> &'static [f64] {
        match self {
            Self::Solid => &[],
            Self::Dashed => &[8.0, 5.0],
            Self::Dotted => &[1.5, 4.5],
            Self::DashDot => &[9.0, 4.5, 1.5, 4.5],
        }
    }
}
