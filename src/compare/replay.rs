//! A sample as a file, so that `eval` can compute it again.

use crate::eval::to_json;
use crate::sampling::RegimeSample;

/// The state as the array that `eval` reads.
#[must_use]
pub fn states_text(sample: &RegimeSample) -> String {
    format!("[{}]\n", to_json(&sample.instant))
}
