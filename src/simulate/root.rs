//! The root of a function of time.

/// A time at which a value is 0 or below, within a tolerance after one at which it is above 0: it is above 0 at the first
/// of the `times`, the other of which may be the earlier one, and 0 or below at the second.
///
/// By the ITP method of Oliveira & Takahashi (2020): as good as bisection at worst, superlinear for smooth values.
///
/// # Errors
/// Those of `value_at`.
pub(crate) fn root<E>(
    [mut above, mut below]: [f64; 2],
    [mut high, mut low]: [f64; 2],
    tolerance: f64,
    mut value_at: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let length = (below - above).abs();
    let shift = 0.2 / length;
    let mut reach = tolerance * 2.0_f64.powi(2 + bisections(length, tolerance));
    while (below - above).abs() > tolerance && low < 0.0 {
        let length = (below - above).abs();
        let middle = above + 0.5 * (below - above);
        let chord = above + (below - above) * (high / (high - low));
        let toward = (middle - chord).signum();
        let moved = (shift * length.powi(2)).max(0.5 * tolerance);
        let truncated = if moved <= (middle - chord).abs() { chord + toward * moved } else { middle };
        let radius = (0.5 * (reach - length)).max(0.0);
        let time = if (truncated - middle).abs() <= radius { truncated } else { middle - toward * radius };
        let value = value_at(time)?;
        if value > 0.0 {
            (above, high) = (time, value);
        } else {
            (below, low) = (time, value);
        }
        reach *= 0.5;
    }
    Ok(below)
}

/// The number of bisections that reduce a bracket to the tolerance.
#[allow(clippy::cast_possible_truncation, reason = "54 at most, for the accuracy is above rounding")]
fn bisections(length: f64, tolerance: f64) -> i32 {
    libm::log2(length / tolerance).ceil().max(0.0) as i32
}
