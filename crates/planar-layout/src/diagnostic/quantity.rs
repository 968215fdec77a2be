//! What a number means and which numbers make sense.

use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};

/// A physical quantity: its name with an article, its unit, and the values it may take.
///
/// Shown as "a mass in kg greater than 0".
#[derive(Clone, Copy, Debug)]
pub struct NumberRule {
    what: &'static str,
    unit: &'static str,
    least: Least,
    suspect: Option<Suspect>,
}

#[derive(Clone, Copy, Debug)]
enum Least {
    None,
    Zero,
    AboveZero,
}

/// Outboard this size the number is surely in another unit, worth `factor` of the right one.
#[derive(Clone, Copy, Debug)]
struct Suspect {
    beyond: f64,
    unit: &'static str,
    factor: f64,
}

impl NumberRule {
    /// Any finite number; `what` is the name with its article, "a mass", and `unit` empty for a number without one.
    #[must_use]
    pub const fn any(what: &'static str, unit: &'static str) -> Self {
        Self { what, unit, least: Least::None, suspect: None }
    }

    /// A finite number greater than zero.
    #[must_use]
    pub const fn positive(what: &'static str, unit: &'static str) -> Self {
        Self { least: Least::AboveZero, ..Self::any(what, unit) }
    }

    /// A finite number, zero or greater.
    #[must_use]
    pub const fn non_negative(what: &'static str, unit: &'static str) -> Self {
        Self { least: Least::Zero, ..Self::any(what, unit) }
    }

    /// Refuses sizes beyond `radians` as degrees.
    #[must_use]
    pub const fn not_degrees(self, radians: f64) -> Self {
        self.suspect(radians, "degrees", PI / 180.0)
    }

    /// Refuses sizes beyond `metres` as millimetres.
    #[must_use]
    pub const fn not_millimetres(self, metres: f64) -> Self {
        self.suspect(metres, "millimetres", 1e-3)
    }

    const fn suspect(self, beyond: f64, unit: &'static str, factor: f64) -> Self {
        Self { suspect: Some(Suspect { beyond, unit, factor }), ..self }
    }

    /// Whether the number is finite and within the range; if not, a hint where there is one.
    pub(super) fn check(&self, number: f64) -> Result<(), Option<String>> {
        if !number.is_finite() {
            return Err(Some("the number must be finite and fit in 64 bits".to_owned()));
        }
        let low = match self.least {
            Least::None => false,
            Least::Zero => number < 0.0,
            Least::AboveZero => number <= 0.0,
        };
        match self.suspect {
            _ if low => Err(None),
            Some(Suspect { beyond, unit, factor }) if number.abs() > beyond => {
                let converted = number * factor;
                Err(Some(format!("this looks like {unit}: {number:?} {unit} = {converted:?} {}", self.unit)))
            }
            _ => Ok(()),
        }
    }
}

impl Display for NumberRule {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let range = match self.least {
            Least::None => "",
            Least::Zero => " of 0 or more",
            Least::AboveZero => " greater than 0",
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
