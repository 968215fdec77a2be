//! Ends and ticks of an axis from its range and its data.

use super::figure::AxisRange;

/// The scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) low: f64,
    pub(super) high: f64,
    /// Distance of two ticks.
    pub(super) step: f64,
}

impl Scale {
    /// With ticks so far apart that their labels do not touch along an axis of a length, where a character has a width.
    pub(super) fn with_room(self, length: f64, character: f64) -> Self {
        let first = (self.low / self.step).ceil();
        let ticks =
            || (0..100).map(|k| (first + f64::from(k)) * self.step).take_while(|tick| *tick <= self.high * 1.001);
        let longest = ticks().map(|tick| self.label(tick).chars().count()).max().unwrap_or_default();
        let needed = character * (1.0 + u32::try_from(longest).map_or(0.0, f64::from));
        if length * self.step / (self.high - self.low) >= needed || self.step >= self.high - self.low {
            return self;
        }
        Self { step: round_step(5.0 * 2.0 * self.step), ..self }.with_room(length, character)
    }

    /// A tick's value with as many digits as its step has.
    pub(super) fn label(&self, value: f64) -> String {
        // a tick at zero has rounding errors
        let value = if value.abs() < 1e-6 * self.step { 0.0 } else { value };
        // the step has one significant digit; the factor covers its rounding error
        match [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5].iter().position(|unit| self.step * 1.001 >= *unit) {
            Some(digits) if self.step < 1e5 => format!("{value:.digits$}"),
            _ if value == 0.0 => "0".to_owned(),
            _ => format!("{value:.0e}"),
        }
        // as wide as a digit, and seen: a hyphen is neither
        .replace('-', "−")
    }
}

/// The scale of an axis with these data.
pub(super) fn scale(range: &AxisRange, values: impl Iterator<Item = f64>) -> Scale {
    match range {
        AxisRange::Fixed(low, high) => Scale { low: *low, high: *high, step: round_step(high - low) },
        AxisRange::PowersOfTen(low, high) => {
            let step = if high - low > 7 { 2.0 } else { 1.0 };
            Scale { low: f64::from(*low), high: f64::from(*high), step }
        }
        AxisRange::Categories(names) | AxisRange::NamedBars(names) => {
            let count = u32::try_from(names.len()).map_or(1.0, f64::from);
            Scale { low: 0.5, high: count + 0.5, step: 1.0 }
        }
        AxisRange::Data(minimum_span) | AxisRange::DataAndZero(minimum_span) => {
            let zero = matches!(range, AxisRange::DataAndZero(_)).then_some(0.0);
            let (low, high) = values.chain(zero).fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
            let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
            let minimum_span = if *minimum_span > 0.0 { *minimum_span } else { 1.0 };
            let (centre, half) = (f64::midpoint(low, high), (0.5 * (high - low)).max(0.5 * minimum_span) * 1.06);
            let step = round_step(2.0 * half);
            Scale { low: ((centre - half) / step).floor() * step, high: ((centre + half) / step).ceil() * step, step }
        }
    }
}

/// 1, 2 or 5 times a power of ten that gives four to eight ticks.
fn round_step(span: f64) -> f64 {
    let raw = span / 5.0;
    let power = libm::pow(10_f64, libm::log10(raw).floor());
    let factor = match raw / power {
        ..1.5 => 1.0,
        ..3.5 => 2.0,
        ..7.5 => 5.0,
        _ => 10.0,
    };
    factor * power
}

#[cfg(test)]
mod tests {
    use super::super::figure::AxisRange;
    use super::{Scale, scale};

    #[test]
    fn labels_have_a_true_minus_sign_and_as_many_digits_as_their_step() {
        let scale = Scale { low: -0.1, high: 0.1, step: 0.05 };
        assert_eq!([-0.05, 0.0, 1e-12, 0.1].map(|value| scale.label(value)), ["−0.05", "0.00", "0.00", "0.10"]);
        assert_eq!(Scale { low: -1e7, high: 0.0, step: 1e6 }.label(-2e6), "−2e6");
    }

    /// 1, 2 and 5 times a power of ten follow each other until the labels fit.
    #[test]
    fn ticks_are_farther_apart_where_their_labels_would_touch() {
        let full = scale(&AxisRange::Fixed(-0.015, 0.015), std::iter::empty());
        assert!((full.step - 0.005).abs() < 1e-12);
        for (length, step) in [(470.0, 0.005), (270.0, 0.01), (120.0, 0.02)] {
            let found = full.with_room(length, 7.2).step;
            assert!((found - step).abs() < 1e-12, "{found} in {length} points");
        }
    }
}
