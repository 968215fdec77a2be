//! The constants of sine and cosine, as the core has them.

use planar_dynamics::standalone::{Coefficients, DIGITS, DIGITS_SINGLE, DOUBLE, SINGLE};
use serde_json::{Value, json};

/// Those of both precisions, and the digits of 2/π.
pub fn constants() -> Value {
    json!({
        "double": coefficients(&DOUBLE, |number| number),
        "single": coefficients(&SINGLE, f64::from),
        "digits": words(&DIGITS),
        "digits_single": words(&DIGITS_SINGLE),
    })
}

fn words(digits: &[u32]) -> Vec<String> {
    digits.iter().map(|word| format!("0x{word:08x}U")).collect()
}

/// Polynomials in z.
fn coefficients<F: Copy, const S: usize, const C: usize>(
    of: &Coefficients<F, S, C>,
    double: impl Fn(F) -> f64,
) -> Value {
    let number = |number: F| format!("{:?}", double(number));
    let polynomial = |coefficients: &[F]| {
        let nested = coefficients.iter().rev().map(|c| format!("(real){}", number(*c)));
        nested.reduce(|inner, c| format!("{c} + (z * ({inner}))")).unwrap_or_default()
    };
    json!({
        "quarter_turn": of.quarter_turn.map(number),
        "furthest": number(of.furthest),
        "round": number(of.round),
        "sine": polynomial(&of.sine),
        "cosine": polynomial(&of.cosine),
    })
}
