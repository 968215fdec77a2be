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
    range: Option<Range>,
    below: Option<f64>,
    is_whole: bool,
}

/// An end of the range of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// The end.
    pub value: f64,
    /// Whether the number may not be the end itself.
    pub is_excluded: bool,
}

/// A range, and why there is no other; `None` where the name of the quantity says the range.
#[derive(Clone, Copy, Debug)]
struct Range {
    least: f64,
    most: f64,
    why: Option<&'static str>,
}

/// Why a number is refused.
#[derive(Debug)]
pub(crate) enum Refusal {
    /// It is not what the rule says; with a hint, if there is one.
    Hint(Option<String>),
    /// For a reason that says what would be right.
    Reason(String),
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
        Self {
            what,
            unit,
            minimum: Minimum::None,
            largest: LARGEST,
            wrong_unit: None,
            range: None,
            below: None,
            is_whole: false,
        }
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

    /// A whole number in a range, which messages say; `what` is its name, "a number of cases".
    ///
    /// The ends are whole and not negative.
    #[must_use]
    pub const fn whole(what: &'static str, least: f64, most: f64) -> Self {
        Self { is_whole: true, ..Self::any(what, "").within(least, most) }
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

    /// Rejects numbers outside a range, which the name of the quantity says.
    #[must_use]
    pub const fn within(self, least: f64, most: f64) -> Self {
        Self { range: Some(Range { least, most, why: None }), ..self }
    }

    /// Rejects numbers outside a range for a reason.
    #[must_use]
    pub const fn within_because(self, least: f64, most: f64, why: &'static str) -> Self {
        Self { range: Some(Range { least, most, why: Some(why) }), ..self }
    }

    /// Rejects this number and larger ones.
    #[must_use]
    pub const fn less_than(self, below: f64) -> Self {
        Self { below: Some(below), ..self }
    }

    /// What it is, with an article: "a mass".
    #[must_use]
    pub const fn what(&self) -> &'static str {
        self.what
    }

    /// Its unit, empty for a number without one.
    #[must_use]
    pub const fn unit(&self) -> &'static str {
        self.unit
    }

    /// Whether it may be a whole number only.
    #[must_use]
    pub const fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// The least and the largest number it may be; `None` where only the size of numbers limits it.
    #[must_use]
    pub fn bounds(&self) -> [Option<Bound>; 2] {
        let bound = |value| Bound { value, is_excluded: false };
        let magnitude = self.wrong_unit.map_or(self.largest, |wrong| wrong.limit);
        let magnitude = (magnitude < LARGEST).then_some(magnitude);
        let least = match (self.range, self.minimum) {
            (Some(range), _) => Some(bound(range.least)),
            (None, Minimum::None) => magnitude.map(|magnitude| bound(-magnitude)),
            (None, minimum) => Some(Bound { value: 0.0, is_excluded: matches!(minimum, Minimum::AboveZero) }),
        };
        let below = self.below.map(|value| Bound { value, is_excluded: true });
        let most = self.range.map(|range| range.most).or(magnitude).map(bound);
        [least, below.or(most)]
    }

    const fn reject_unit(self, limit: f64, unit: &'static str, factor: f64) -> Self {
        Self { wrong_unit: Some(WrongUnit { limit, unit, factor }), ..self }
    }

    /// Checks that the number is finite, of a magnitude that can be computed with, and in range.
    pub(crate) fn check(&self, number: f64) -> Result<(), Refusal> {
        let hint = |hint| Err(Refusal::Hint(hint));
        if !number.is_finite() {
            return hint(Some("the number must be finite and fit in 64 bits".to_owned()));
        }
        if number != 0.0 && !(SMALLEST..=self.largest).contains(&number.abs()) {
            let largest = self.largest;
            let zero = if matches!(self.minimum, Minimum::AboveZero) { "" } else { "0 or " };
            return hint(Some(format!("the number must be {zero}of a magnitude from {SMALLEST:e} to {largest:e}")));
        }
        let too_small = match self.minimum {
            Minimum::None => false,
            Minimum::Zero => number < 0.0,
            Minimum::AboveZero => number <= 0.0,
        };
        let outside = self.range.filter(|range| !(range.least..=range.most).contains(&number));
        match (self.wrong_unit, outside) {
            _ if self.is_whole && number.fract() != 0.0 => hint(None),
            _ if too_small || self.below.is_some_and(|below| number >= below) => hint(None),
            (Some(WrongUnit { limit, unit, factor }), _) if number.abs() > limit => {
                let (converted, limit, right) = (number * factor, short(limit), self.unit);
                let looks = format!("this looks like {unit}: {number:?} {unit} = {converted:?} {right}");
                hint(Some(format!("{looks}; the magnitude is at most {limit} {right}")))
            }
            (_, Some(Range { least, most, why: Some(why) })) => {
                Err(Refusal::Reason(format!("expected {} to {}: {why}", short(least), short(most))))
            }
            (_, Some(_)) => hint(None),
            _ => Ok(()),
        }
    }
}

/// A number with few digits, with an exponent where it is far from 1.
fn short(number: f64) -> String {
    if number == 0.0 || (0.01..1e4).contains(&number.abs()) { number.to_string() } else { format!("{number:e}") }
}

impl Display for NumberRule {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let range = match self.minimum {
            Minimum::None => "",
            Minimum::Zero => " of 0 or more",
            Minimum::AboveZero => " greater than 0",
        };
        let unit = if self.unit.is_empty() { String::new() } else { format!(" in {}", self.unit) };
        write!(f, "{}{unit}{range}", self.what)?;
        if let (true, Some(Range { least, most, .. })) = (self.is_whole, self.range) {
            write!(f, ", a whole number from {least} to {most}")?;
        }
        match self.below {
            Some(below) => write!(f, " and less than {below}"),
            None => Ok(()),
        }
    }
}

/// The form of a vector: "[yaw, x, y] in rad, m, m".
pub(crate) fn form(components: &[NumberRule]) -> String {
    let names: Vec<_> = components.iter().map(|component| component.what).collect();
    if names.is_empty() {
        return "[]".to_owned();
    }
    format!("[{}] in {}", names.join(", "), units(components))
}

/// The units of a vector's components: "rad, m, m", or one for all.
#[must_use]
pub fn units(components: &[NumberRule]) -> String {
    let mut units: Vec<_> = components.iter().map(|component| component.unit).collect();
    if units.windows(2).all(|pair| pair.first() == pair.last()) {
        units.truncate(1);
    }
    units.join(", ")
}

#[cfg(test)]
mod tests;
