//! Numbers as people read them.

/// Four significant digits, without zeros at the end.
pub(super) fn short(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-4..1e7).contains(&size) {
        if !value.is_finite() {
            return "more than 1e308".to_owned();
        }
        let text = format!("{value:.3e}");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", without_zeros(digits));
    }
    let decimals = [1e3, 1e2, 1e1, 1e0, 1e-1, 1e-2, 1e-3].iter().position(|least| size >= *least).unwrap_or(7);
    without_zeros(&format!("{value:.decimals$}")).to_owned()
}

fn without_zeros(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

/// `(x, y)`.
pub(super) fn point([x, y]: [f64; 2]) -> String {
    format!("({}, {})", short(x), short(y))
}

/// `[ω, vx, vy]`.
pub(super) fn list(values: &[f64]) -> String {
    format!("[{}]", values.iter().map(|value| short(*value)).collect::<Vec<_>>().join(", "))
}
