//! A sample as a file, so that `eval` can compute it again.

use crate::eval::to_json;
use crate::sampling::Sample;

/// The state as the array that `eval` reads.
#[must_use]
pub fn states_text(sample: &Sample) -> String {
    format!("[{}]\n", to_json(&sample.instant))
}
