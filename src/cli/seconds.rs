//! Times in arguments.

/// Of any sign.
pub fn seconds(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "expected a number of seconds".to_owned())
}

/// Greater than 0.
pub fn positive_seconds(text: &str) -> Result<f64, String> {
    let value = seconds(text)?;
    if value.is_finite() && value > 0.0 { Ok(value) } else { Err("expected a time greater than 0 s".to_owned()) }
}
