//! Kinds of failures, their order, and the ranges of their numbers.

use super::{FailureKind, kinds_of};

fn failure(case: u64, message: &str) -> FailureKind {
    FailureKind { count: 1, case, status: "refused".to_owned(), message: message.to_owned() }
}

#[test]
fn numbers_that_differ_are_ranges() {
    let messages = [
        "`target[0].mass` is -2.0, expected a mass in kg greater than 0",
        "no pose of arm1 at t = 3.5e-3 s (limit: 10 m)",
        "`target[0].mass` is -1e3, expected a mass in kg greater than 0",
        "`target[0].mass` is -0.5, expected a mass in kg greater than 0",
    ];
    let found = kinds_of((3..).zip(messages).map(|(case, message)| failure(case, message)));
    let mass = "`target[0].mass` is -1e3 to -0.5, expected a mass in kg greater than 0";
    let expected = [FailureKind { count: 3, ..failure(3, mass) }, failure(4, messages[1])];
    assert_eq!(found, expected);
}

/// Words with numbers in them are no numbers, and other kinds have other words.
#[test]
fn names_are_no_numbers() {
    let messages = ["arm1 is 2.0 m away", "arm2 is 1.0 m away", "arm1 was 3.0 m away"];
    let found = kinds_of((0..).zip(messages).map(|(case, message)| failure(case, message)));
    assert_eq!(found[0], FailureKind { count: 2, ..failure(0, "arm1 is 1.0 to 2.0 m away") });
    assert_eq!(found[1].message, messages[2]);
}

/// An angle and the limit beyond which it is are of one sign.
#[test]
fn limits_of_two_signs_are_two_kinds() {
    let messages = [
        "joint 2 goes to -2.1 rad, beyond -2.0 rad",
        "joint 2 goes to 2.3 rad, beyond 2.0 rad",
        "joint 2 goes to -2.4 rad, beyond -2.0 rad",
    ];
    let found = kinds_of((0..).zip(messages).map(|(case, message)| failure(case, message)));
    let below = FailureKind { count: 2, ..failure(0, "joint 2 goes to -2.4 to -2.1 rad, beyond -2.0 rad") };
    assert_eq!(found, [below, failure(1, messages[1])]);
}

/// A sign is part of its number, and failures that are alike have one status.
#[test]
fn signs_and_statuses() {
    let found =
        kinds_of([failure(0, "off by +2.0 m"), failure(1, "off by -3.0 m"), failure(2, "off by +4.0 m")].into_iter());
    assert_eq!(found, [FailureKind { count: 3, ..failure(0, "off by -3.0 to +4.0 m") }]);
    let stopped = FailureKind { status: "stopped".to_owned(), ..failure(4, "off by +1.0 m") };
    let found = kinds_of([failure(0, "off by +2.0 m"), stopped.clone(), stopped.clone()].into_iter());
    assert_eq!(found, [FailureKind { count: 2, ..stopped }, failure(0, "off by +2.0 m")]);
}
