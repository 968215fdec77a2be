//! Counts of distances, and how many are allowed until when.
#![allow(clippy::float_cmp, reason = "numbers that are copied")]

use super::*;
use crate::capture::clearance::bodies::ClearanceBody;
use crate::capture::proximity::convex::{ConvexPart, PlacedPart};
use crate::capture::proximity::motion::FrameState;
use crate::outline::Outline;

/// So many in the first 100 s, and in proportion in longer times.
#[test]
fn distances_are_allowed_in_proportion_to_the_time() {
    let mut found = Findings::new(&[], 10);
    for (time, allowed) in [(0.0, 10), (30.0, 10), (100.0, 10), (250.0, 25), (1000.0, 100)] {
        for (evaluations, used_up) in [(0, false), (allowed, false), (allowed + 1, true), (allowed + 7, true)] {
            found.evaluations = evaluations;
            assert_eq!(found.are_used_up(time), used_up, "{evaluations} by {time} s");
        }
    }
}

/// Each distance counts once for its pair; the least is that of its group, with its pair and time.
#[test]
fn distances_count_for_their_pairs() {
    let pair = |group: usize| BodyPair { bodies: [0, 1], contact: None, group };
    let pairs = [pair(0), pair(1), pair(1)];
    let mut found = Findings::new(&pairs, 10);
    let point = ConvexPart::point();
    let shapes = PartPair { parts: [&point, &point], speed: 0.0, acceleration: 0.0 };
    let mut record = |index: usize, distance: f64, time: f64| {
        let at = |x: f64| FrameState::new([0.0, x, 0.0], [0.0; 3]);
        let instant = shapes.at(time, [at(0.0), at(distance)], &mut PlacedPart::default());
        found.record((index, &pairs[index]), &instant, 5.0);
    };
    // the last differs by rounding
    for (index, distance, time) in
        [(1, 3.0, 0.25), (2, 2.0, 0.5), (1, 2.5, 0.75), (0, 9.0, 1.0), (1, 2.0_f64.next_down(), 1.25)]
    {
        record(index, distance, time);
    }
    assert_eq!((found.evaluations, found.of_pairs), (5, vec![1, 3, 1]));
    assert_eq!(found.least, [Some((9.0, 6.0, 0)), Some((2.0, 5.5, 2))]);
}

#[test]
fn bodies_reach_as_far_as_their_parts() {
    let body = |outline: &Outline| {
        let parts = ConvexPart::of(outline);
        ClearanceBody { frame: 0, name: String::new(), parts, is_default: false }.reach()
    };
    let far = Outline::Capsule { ends: [[0.0; 2], [3.0, 4.0]], radius: 0.5 };
    assert!((body(&far) - 5.5).abs() < 1e-12, "{}", body(&far));
    let near = Outline::Disc { center: [0.0, 0.2], radius: 0.1 };
    assert!((body(&near) - 0.3).abs() < 1e-12, "{}", body(&near));
}
