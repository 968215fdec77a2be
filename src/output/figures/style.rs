//! Colours, dash patterns and symbols.

use crate::output::scene::{PALETTE, hexadecimal};

/// A colour of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour([u8; 3]);

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
    /// The fifth.
    LongDashed,
    /// The sixth.
    DashDotDot,
    /// The seventh.
    Dense,
}

/// The symbol of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// ●
    Circle,
    /// Smaller, of many.
    Dot,
    /// ■
    Square,
    /// ×
    Cross,
    /// +
    Plus,
}

impl Colour {
    /// Follows the palette; of what belongs to the base or to the whole.
    pub const BLACK: Self = Self([0; 3]);
    /// Of overlaps.
    pub const RED: Self = Self([0xd0, 0x00, 0x00]);
    /// Of impulses: neither in the palette nor that of the base.
    pub const VIOLET: Self = Self([0x5e, 0x2c, 0xa5]);
    /// Of the background.
    pub const GREY: Self = Self([0x8c; 3]);

    /// The colour of the member `index` of a family of curves: the palette of Okabe and Ito without its yellow, then
    /// black; from the eighth on they repeat.
    #[must_use]
    pub fn of(index: usize) -> Self {
        PALETTE.get(index % (PALETTE.len() + 1)).map_or(Self::BLACK, |rgb| Self(*rgb))
    }

    /// `#rrggbb`.
    #[must_use]
    pub fn hexadecimal(self) -> String {
        hexadecimal(self.0)
    }
}

impl Dash {
    /// The dash pattern of a family's member; from the eighth on they repeat.
    #[must_use]
    pub fn of(index: usize) -> Self {
        const ALL: [Dash; 7] =
            [Dash::Solid, Dash::Dashed, Dash::Dotted, Dash::DashDot, Dash::LongDashed, Dash::DashDotDot, Dash::Dense];
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
            Self::LongDashed => &[16.0, 5.0],
            Self::DashDotDot => &[7.0, 3.0, 1.5, 3.0, 1.5, 3.0],
            Self::Dense => &[3.0, 2.0],
        }
    }
}
