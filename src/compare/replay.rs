//! A sample as a file, so that `eval` can compute it again.

use crate::sampling::Sample;
use crate::states::to_json;

/// The state as the array that `eval` reads.
#[must_use]
pub fn states_text(sample: &Sample) -> String {
    format!("[{}]\n", to_json(&sample.instant))
}
