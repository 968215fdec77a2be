//! The ends of the ranges of numbers: what a rule says of itself is what it accepts.

use super::{NumberRule, SMALLEST, form, units};

/// A number just on one side of another; beside zero the first one that has a place in 64 bits.
fn beside(value: f64, up: bool) -> f64 {
    match (value == 0.0, up) {
        (true, true) => SMALLEST,
        (true, false) => -SMALLEST,
        (false, true) => value.next_up(),
        (false, false) => value.next_down(),
    }
}

/// Numbers are accepted up to the ends of the range that is stated, with the ends but for those that are excluded.
#[test]
fn ranges_end_where_they_are_said_to() {
    let any = NumberRule::any("a number", "");
    let mut seen = [0; 2];
    for rule in [
        NumberRule::positive("a mass", "kg"),
        NumberRule::non_negative("a gain", ""),
        NumberRule::positive("a part", "").less_than(1.0),
        NumberRule::non_negative("a part", "").less_than(1.0),
        any.within(-2.0, 3.0),
        any.within_because(0.5, 3.0, "it is so"),
        any.at_most(5.0),
        any.not_degrees(7.0),
        NumberRule::positive("a length", "m").not_millimetres(100.0),
    ] {
        let [least, most] = rule.bounds();
        for (bound, up) in [(least, false), (most, true)].into_iter().filter_map(|(bound, up)| Some((bound?, up))) {
            let accepts = |value: f64| rule.check(value).is_ok();
            assert_eq!(accepts(bound.value), !bound.is_excluded, "{rule:?} at {bound:?}");
            assert!(!accepts(beside(bound.value, up)), "{rule:?} beyond {bound:?}");
            assert!(accepts(beside(bound.value, !up)), "{rule:?} within {bound:?}");
            seen[usize::from(bound.is_excluded)] += 1;
        }
    }
    assert_eq!(seen, [11, 5], "ends that are included, and excluded");
    let whole = NumberRule::whole("a number of cases", 1.0, 10.0);
    for (value, accepted) in [(0.0, false), (1.0, true), (1.5, false), (10.0, true), (11.0, false)] {
        assert_eq!(whole.check(value).is_ok(), accepted, "{value}");
    }
}

/// One unit for all components that have it, each of its own where they differ.
#[test]
fn a_unit_that_all_components_have_is_said_once() {
    let [x, y, yaw] = [NumberRule::any("x", "m"), NumberRule::any("y", "m"), NumberRule::any("yaw", "rad")];
    assert_eq!((units(&[x, y]), form(&[x, y])), ("m".to_owned(), "[x, y] in m".to_owned()));
    assert_eq!(form(&[yaw, x, y]), "[yaw, x, y] in rad, m, m");
}
