//! Indices of lists and vectors at their ends.

use super::find;
use crate::format::{Count, Default, Key, NumberRule, Shape, TableFormat};

const METRES: NumberRule = NumberRule::any("a place", "m");
const POINT: Shape = Shape::Vector(&[METRES, METRES]);

static FORMAT: TableFormat = TableFormat {
    doc: "Of a test.",
    keys: &[
        Key::optional("ends", Shape::List(&POINT, Count::Exactly(2)), Default::Nothing, "two points"),
        Key::optional("mount", POINT, Default::Nothing, "a point"),
    ],
    one_of: &[],
};

/// A list of two has the indices 0 and 1, a vector of two too, whatever is in them.
#[test]
fn indices_end_before_the_length() {
    for index in [0, 1] {
        assert!(find(&FORMAT, &format!("ends[{index}][{index}]")).is_ok(), "{index}");
        assert!(find(&FORMAT, &format!("mount[{index}]")).is_ok(), "{index}");
    }
    let refused = find(&FORMAT, "ends[2]").expect_err("two ends");
    assert!(refused.why.contains("it has 2 elements, expected an index less than that"), "{refused}");
    for path in ["ends[1][2]", "mount[2]"] {
        assert!(find(&FORMAT, path).is_err(), "{path}");
    }
}
