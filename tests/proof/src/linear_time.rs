//! Whether reading a text takes a time that is linear in its size.

use std::time::Instant;

/// Measured times are compared, so the bound is between ten, for linear time, and a hundred, for quadratic time.
const FACTOR: f64 = 40.0;

/// The time of a start, s, below which nothing can be said.
const LEAST: f64 = 0.02;

/// Runs `read` for texts of which the second is ten times as long as the first.
#[track_caller]
pub fn assert_linear_time(what: &str, text: impl Fn(usize) -> String, read: impl Fn(&str)) {
    let seconds = |text: &str| {
        let run = |_| {
            let start = Instant::now();
            read(text);
            start.elapsed().as_secs_f64()
        };
        (0..3).map(run).fold(f64::INFINITY, f64::min)
    };
    let (short, long) = (seconds(&text(3_000)), seconds(&text(30_000)));
    assert!(long < FACTOR * short + LEAST, "{what}: {short} s, and {long} s for ten times the text");
}
