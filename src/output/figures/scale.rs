//! Ends and ticks of an axis.

use super::figure::Span;

/// An axis from end to end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) low: f64,
    pub(super) high: f64,
    /// Between two ticks.
    pub(super) step: f64,
}

impl Scale {
    /// A tick's value with the digits that its step asks for.
    pub(super) fn label(&self, value: f64) -> String {
        // rounding away from a tick at zero is not to be shown
        let value = if value.abs() < 1e-6 * self.step { 0.0 } else { value };
        // the first digit of the step is its only one; a little more, or 0.1 would look like less
        match [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5].iter().position(|unit| self.step * 1.001 >= *unit) {
            Some(digits) if self.step < 1e5 => format!("{value:.digits$}"),
            _ if value == 0.0 => "0".to_owned(),
            _ => format!("{value:.0e}"),
        }
    }
}

/// The scale of an axis for its data.
pub(super) fn scale(span: &Span, values: impl Iterator<Item = f64>) -> Scale {
    match span {
        Span::Between(low, high) => Scale { low: *low, high: *high, step: round_step(high - low) },
        Span::Powers(low, high) => {
            let step = if high - low > 7 { 2.0 } else { 1.0 };
            Scale { low: f64::from(*low), high: f64::from(*high), step }
        }
        Span::Names(names) => {
            let count = u32::try_from(names.len()).map_or(1.0, f64::from);
            Scale { low: 0.5, high: count + 0.5, step: 1.0 }
        }
        Span::Data(least) | Span::DataAndZero(least) => {
            let zero = matches!(span, Span::DataAndZero(_)).then_some(0.0);
            let (low, high) = values.chain(zero).fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
            let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
            let (middle, least) = (f64::midpoint(low, high), if *least > 0.0 { *least } else { 1.0 });
            let half = (0.5 * (high - low)).max(0.5 * least) * 1.06;
            let step = round_step(2.0 * half);
            let (low, high) = (((middle - half) / step).floor() * step, ((middle + half) / step).ceil() * step);
            Scale { low, high, step }
        }
    }
}

/// 1, 2 or 5 of a power of ten: four to eight ticks.
fn round_step(span: f64) -> f64 {
    let raw = span / 5.0;
    let power = 10_f64.powf(raw.log10().floor());
    let factor = match raw / power {
        ..1.5 => 1.0,
        ..3.5 => 2.0,
        ..7.5 => 5.0,
        _ => 10.0,
    };
    factor * power
}
