//! The unit of an axis, in which its numbers have few digits.

use crate::output::figures::{Axis, power_of_ten};

/// Spans that are a smaller part of the numbers are shown from a number near these on: ticks of five characters do not
/// overlap.
const NARROW: f64 = 0.05;
/// Spans that are a smaller part of numbers below 1 are shown with a power of ten: without the zeros before the digits.
const RATHER_NARROW: f64 = 0.1;
/// From here on a power of ten is in the unit.
const LARGE: f64 = 1e4;
/// Below this, too.
const SMALL: f64 = 0.1;

/// What an axis shows: (value − offset) / 10^exponent.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AxisUnit {
    /// As it is printed, and as a number.
    offset: Option<(String, f64)>,
    exponent: i32,
    /// Between the ends, in this unit.
    span: f64,
}

impl AxisUnit {
    /// For numbers between these; a span of zero is one of 1 about it.
    pub(super) fn between(low: f64, high: f64) -> Self {
        let (span, largest) = (high - low, low.abs().max(high.abs()));
        let offset = (span < NARROW * largest && span > 0.0).then(|| {
            // digits down to the order of the span
            let digits = libm::log10(largest).floor() - libm::log10(span).floor();
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 16")]
            let digits = digits.clamp(0.0, 16.0) as usize;
            let text = format!("{low:.digits$e}");
            let value: f64 = text.parse().unwrap_or(low);
            let is_plain = (1e-3..1e7).contains(&value.abs());
            (if is_plain { value.to_string() } else { text }, value)
        });
        let from = offset.as_ref().map_or(0.0, |(_, value)| *value);
        let largest = (low - from).abs().max((high - from).abs());
        let small = if span < RATHER_NARROW * largest { 1.0 } else { SMALL };
        let is_handy = (small..LARGE).contains(&largest) || largest == 0.0;
        #[allow(clippy::cast_possible_truncation, reason = "exponents of numbers")]
        let exponent = if is_handy { 0 } else { (libm::log10(largest) / 3.0).floor() as i32 * 3 };
        Self { offset, exponent, span: span * factor(-exponent) }
    }

    /// In this unit.
    pub(super) fn of(&self, value: f64) -> f64 {
        (value - self.offset.as_ref().map_or(0.0, |(_, offset)| *offset)) * factor(-self.exponent)
    }

    /// The axis of a quantity: its name, what is subtracted, and the unit.
    pub(super) fn axis(&self, name: &str, unit: &str) -> Axis {
        // in the unit itself: the power of ten is of what is left
        let offset = self.offset.as_ref().map(|(text, _)| match text.strip_prefix('-') {
            Some(positive) => format!(" + {positive} {unit}"),
            None => format!(" − {text} {unit}"),
        });
        let power = (self.exponent != 0).then(|| power_of_ten(f64::from(self.exponent)));
        let units: Vec<&str> = power.as_deref().into_iter().chain((!unit.is_empty()).then_some(unit)).collect();
        let units = if units.is_empty() { String::new() } else { format!("[{}]", units.join(" ")) };
        let label = format!("{name}{} {units}", offset.unwrap_or_default().trim_end());
        Axis::new(label.trim(), self.span)
    }
}

/// 10^`exponent`; of subnormal numbers the largest factor that there is.
fn factor(exponent: i32) -> f64 {
    libm::pow(10.0, f64::from(exponent)).min(1e308)
}

#[cfg(test)]
mod tests {
    use super::AxisUnit;

    fn shown(low: f64, high: f64) -> (String, f64, f64) {
        let unit = AxisUnit::between(low, high);
        (unit.axis("x", "m").label, unit.of(low), unit.of(high))
    }

    #[test]
    fn numbers_have_few_digits() {
        assert_eq!(shown(0.5, 2.0), ("x [m]".to_owned(), 0.5, 2.0));
        let (label, low, high) = shown(-2.5e-13, 1e-14);
        assert_eq!(label, "x [10⁻¹⁵ m]");
        assert!((low + 250.0).abs() < 1e-9 && (high - 10.0).abs() < 1e-9, "{low} to {high}");
        let (label, low, high) = shown(5.123_456_1, 5.123_456_9);
        assert_eq!(label, "x − 5.1234561 m [10⁻⁹ m]");
        assert!(low.abs() < 1e-3 && (high - 800.0).abs() < 1e-3, "{low} to {high}");
        assert_eq!(shown(-400.1, -400.0).0, "x + 400.1 m [m]");
        assert_eq!(shown(0.1042, 0.108).0, "x − 0.104 m [10⁻³ m]");
        assert_eq!(shown(0.12, 0.13).0, "x [10⁻³ m]");
        assert_eq!(AxisUnit::between(0.0, 1.0).axis("x", "").label, "x");
        assert_eq!(AxisUnit::between(-3.0, -3.0).axis("", "1").label, "[1]");
    }
}
