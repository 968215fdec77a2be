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

/// The same for a value whose rate is known, too, per s: each value with its rate.
///
/// By Newton's method from the end with the smaller value, to a little beyond the root, so that the other end follows; by
/// bisection where that leaves the bracket, or has not halved it twice.
///
/// # Errors
/// Those of `value_at`.
pub(crate) fn root_by_rates<E>(
    [mut above, mut below]: [f64; 2],
    [mut high, mut low]: [[f64; 2]; 2],
    tolerance: f64,
    mut value_at: impl FnMut(f64) -> Result<[f64; 2], E>,
) -> Result<f64, E> {
    let mut slow = 0;
    while (below - above).abs() > tolerance && low[0] < 0.0 {
        let length = below - above;
        let newton = |time: f64, [value, rate]: [f64; 2]| time - value / rate;
        let beyond = 0.25 * tolerance * length.signum();
        let toward = if high[0] < -low[0] { newton(above, high) + beyond } else { newton(below, low) - beyond };
        // NaN is nowhere
        let is_inside = (toward - above) * (toward - below) < 0.0;
        let time = if is_inside && slow < 2 { toward } else { above + 0.5 * length };
        let value = value_at(time)?;
        if value[0] > 0.0 {
            (above, high) = (time, value);
        } else {
            (below, low) = (time, value);
        }
        slow = if slow < 2 && (below - above).abs() > 0.5 * length.abs() { slow + 1 } else { 0 };
    }
    Ok(below)
}

/// The number of bisections that reduce a bracket to the tolerance.
#[allow(clippy::cast_possible_truncation, reason = "54 at most, for the accuracy is above rounding")]
fn bisections(length: f64, tolerance: f64) -> i32 {
    libm::log2(length / tolerance).ceil().max(0.0) as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    const TOLERANCE: f64 = 1e-9;

    /// The root of a function with its rate between two times, and how many values it took.
    fn found(times: [f64; 2], value: impl Fn(f64) -> [f64; 2]) -> (f64, u32) {
        let mut count = 0;
        let counted = |time: f64| {
            count += 1;
            Ok::<_, Infallible>(value(time))
        };
        let Ok(root) = root_by_rates(times, times.map(&value), TOLERANCE, counted);
        (root, count)
    }

    /// From either side, and at a time at which the value is not above 0.
    #[test]
    fn smooth_values_take_few_evaluations() {
        let falling = |t: f64| [0.3 - t.powi(3), -3.0 * t * t];
        let swinging = |t: f64| [(3.0 * t).cos(), -3.0 * (3.0 * t).sin()];
        let line = |t: f64| [0.7 - t, -1.0];
        let exact = [0.3_f64.cbrt(), std::f64::consts::FRAC_PI_6, 0.7];
        let values: [&dyn Fn(f64) -> [f64; 2]; 3] = [&falling, &swinging, &line];
        for (value, exact) in values.into_iter().zip(exact) {
            let (root, count) = found([0.0, 1.0], value);
            assert!((root - exact).abs() <= TOLERANCE && value(root)[0] <= 0.0 && count < 9, "{root} {exact} {count}");
            let mirrored = |t: f64| {
                let [value, rate] = value(1.0 - t);
                [value, -rate]
            };
            let (root, count) = found([1.0, 0.0], mirrored);
            assert!((1.0 - root - exact).abs() <= TOLERANCE && count < 9, "{root} {exact} {count}");
        }
    }

    /// Rates that are wrong cost evaluations, and no accuracy.
    #[test]
    fn wrong_rates_are_survived() {
        let exact = 1.0 / 3.0;
        for rate in [0.0, 1.0, -1e-3, -1e6, f64::NAN, f64::INFINITY] {
            let (root, count) = found([0.0, 1.0], |t| [exact - t, rate]);
            assert!(root >= exact && root - exact <= TOLERANCE && count <= 90, "{rate}: {root} {count}");
        }
        // a kink, and a step
        let (root, count) = found([0.0, 1.0], |t| if t < exact { [1e-6, 0.0] } else { [-1e3, 0.0] });
        assert!(root >= exact && root - exact <= TOLERANCE && count <= 90, "{root} {count}");
    }
}
