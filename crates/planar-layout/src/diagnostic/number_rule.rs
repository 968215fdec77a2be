//! The quantity that a number stands for, and the range of its values.

use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};

/// Magnitudes whose products of three have a place in 64 bits, which those of masses, lengths and rates need.
const SMALLEST: f64 = 1e-100;
const LARGEST: f64 = 1e100;

/// A physical quantity: its name with an article, its unit, and the values it may take.
///
/// Shown as "a mass in kg greater than 0".
#[derive(Clone, Copy, Debug)]
pub struct NumberRule {
    what: &'static str,
    unit: &'static str,
    minimum: Minimum,
    largest: f64,
    wrong_unit: Option<WrongUnit>,
}

#[derive(Clone, Copy, Debug)]
enum Minimum {
    None,
    Zero,
    AboveZero,
}

/// A number above the limit is in another unit, `factor` times the right one.
#[derive(Clone, Copy, Debug)]
struct WrongUnit {
    limit: f64,
    unit: &'static str,
    factor: f64,
}

impl NumberRule {
    /// Any finite number; `what` is the name with its article, "a mass", and `unit` empty for a number without one.
    #[must_use]
    pub const fn any(what: &'static str, unit: &'static str) -> Self {
        Self { what, unit, minimum: Minimum::None, largest: LARGEST, wrong_unit: None }
    }

    /// A finite number greater than zero.
    #[must_use]
    pub const fn positive(what: &'static str, unit: &'static str) -> Self {
        Self { minimum: Minimum::AboveZero, ..Self::any(what, unit) }
    }

    /// A finite number, zero or greater.
    #[must_use]
    pub const fn non_negative(what: &'static str, unit: &'static str) -> Self {
        Self { minimum: Minimum::Zero, ..Self::any(what, unit) }
    }

    /// Rejects magnitudes above `radians` as degrees.
    #[must_use]
    pub const fn not_degrees(self, radians: f64) -> Self {
        self.reject_unit(radians, "degrees", PI / 180.0)
    }

    /// Rejects magnitudes above `metres` as millimetres.
    #[must_use]
    pub const fn not_millimetres(self, metres: f64) -> Self {
        self.reject_unit(metres, "millimetres", 1e-3)
    }

    /// Rejects magnitudes above a limit.
    #[must_use]
    pub const fn at_most(self, largest: f64) -> Self {
        Self { largest, ..self }
    }

    const fn reject_unit(self, limit: f64, unit: &'static str, factor: f64) -> Self {
        Self { wrong_unit: Some(WrongUnit { limit, unit, factor }), ..self }
    }

    /// Checks that the number is finite, of a magnitude that can be computed with, and in range; the error is a hint, if there is one.
    pub(super) fn check(&self, number: f64) -> Result<(), Option<String>> {
        if !number.is_finite() {
            return Err(Some("the number must be finite and fit in 64 bits".to_owned()));
        }
        if number != 0.0 && !(SMALLEST..=self.largest).contains(&number.abs()) {
            let largest = self.largest;
            return Err(Some(format!("the number must be 0 or of a magnitude from {SMALLEST:e} to {largest:e}")));
        }
        let too_small = match self.minimum {
            Minimum::None => false,
            Minimum::Zero => number < 0.0,
            Minimum::AboveZero => number <= 0.0,
        };
        match self.wrong_unit {
            _ if too_small => Err(None),
            Some(WrongUnit { limit, unit, factor }) if number.abs() > limit => {
                let converted = number * factor;
                Err(Some(format!("this looks like {unit}: {number:?} {unit} = {converted:?} {}", self.unit)))
            }
            _ => Ok(()),
        }
    }
}

impl Display for NumberRule {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let range = match self.minimum {
            Minimum::None => "",
            Minimum::Zero => " of 0 or more",
            Minimum::AboveZero => " greater than 0",
        };
        let unit = if self.unit.is_empty() { String::new() } else { format!(" in {}", self.unit) };
        write!(f, "{}{unit}{range}", self.what)
    }
}

/// The form of a vector: "[yaw, x, y] in rad, m, m".
pub(super) fn form(components: &[NumberRule]) -> String {
    let names: Vec<_> = components.iter().map(|component| component.what).collect();
    let mut units: Vec<_> = components.iter().map(|component| component.unit).collect();
    if units.windows(2).all(|pair| pair.first() == pair.last()) {
        units.truncate(1);
    }
    format!("[{}] in {}", names.join(", "), units.join(", "))
}
