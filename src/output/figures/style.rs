//! Colours, dash patterns and symbols.

/// The palette of Okabe and Ito, distinguishable with any colour vision, without its yellow, which has too little contrast
/// on white.
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
    /// The seventh.
    Black,
    /// Outside of the family: background.
    Grey,
}

/// The dash pattern of a line.
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

/// The symbol of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
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
    /// The colour of a family's member; from the eighth on they repeat.
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

    /// `#rrggbb`.
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
    /// The dash pattern of a family's member; from the fifth on they repeat.
    #[must_use]
    pub fn of(index: usize) -> Self {
        const ALL: [Dash; 4] = [Dash::Solid, Dash::Dashed, Dash::Dotted, Dash::DashDot];
        ALL[index % ALL.len()]
    }

    /// Lengths of strokes and gaps in turn, points; empty for a solid line.
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
