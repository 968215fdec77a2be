//! Pairs that are left out for some intervals, because they are far away, and looked at again.

use super::*;
use crate::capture::proximity::convex::ConvexPart;
use crate::contact::ContactKind;
use crate::frames::FrameMotion;
use crate::outline::Outline;
use crate::simulate::path::PathRecorder;
use crate::simulate::system::Body;

fn frame(motion: FrameMotion) -> Frame {
    Frame { name: String::new(), parent: None, pose: [0.0; 3], motion, arm: None }
}

/// A disc of 0.5 m about the origin of a frame.
fn disc(frame: usize) -> ClearanceBody {
    let parts = ConvexPart::of(&Outline::Disc { center: [0.0; 2], radius: 0.5 });
    ClearanceBody { frame, name: frame.to_string(), parts, is_default: false }
}

/// The least distance of a base that moves along x, a disc, and of two discs at rest, 1 m apart. `knots` are the
/// distance of the base from the first disc and its rate, each second.
fn least_distance(knots: &[[f64; 2]]) -> f64 {
    let frames = [FrameMotion::Base, FrameMotion::Target(0), FrameMotion::Target(1)].map(frame).to_vec();
    let pair = |bodies| BodyPair { bodies, contact: None, group: 0 };
    let pairs = vec![pair([0, 1]), pair([1, 2])];
    let mut tracker = DistanceTracker::new(frames, (0..3).map(disc).collect(), pairs, u64::MAX);
    let mut path = PathRecorder::new(3, 0);
    let mut time = 0.0;
    for [distance, rate] in knots {
        path.record(time, &[0.0, 1.0 + distance, 0.0, 0.0, *rate, 0.0]);
        time += 1.0;
    }
    let targets = [0.0, 2.0].map(|y| Body { mass: 1.0, inertia: 1.0, pose: [0.0, 0.0, y], twist: [0.0; 3] });
    tracker.add_phase(&path.end(), 0.0, TargetMotion::Free(&targets), &[]).expect("distances");
    assert_eq!(tracker.found.overlaps.len(), 0);
    tracker.found.least[0].expect("a distance").0
}

/// In the first interval both pairs are looked at; then the base comes nearer, far away by circles, and passes below
/// the least distance in one interval. What is known of its parts is from the first.
#[test]
fn what_comes_near_from_far_away_is_looked_at_again() {
    let resting = [3.0, 3.0, 2.5, 2.1, 1.8, 1.55, 0.95].map(|distance| [distance, 0.0]);
    let least = least_distance(&resting);
    assert!((least - 0.95).abs() < 1e-9, "{least}");
}

/// The base leaves along a cubic after an interval in which it was far away: the cubic before its own interval, which
/// passes through the discs, is no part of the path.
#[test]
fn a_curved_path_begins_at_its_interval() {
    let least = least_distance(&[[3.0, 0.0], [3.0, 0.0], [2.5, 0.0], [12.5, 30.0]]);
    assert!((least - 1.0).abs() < 1e-9, "{least}");
}

/// A body inside a target that two arms are to capture overlaps unless it is of the arm that holds the target.
#[test]
fn an_arm_overlaps_with_what_another_one_holds() {
    let overlaps = |held: &[(usize, usize)]| {
        let pairs = vec![BodyPair { bodies: [0, 1], contact: Some((1, 0)), group: 0 }];
        let frames = [FrameMotion::Base, FrameMotion::Target(0)].map(frame).to_vec();
        let mut tracker = DistanceTracker::new(frames, (0..2).map(disc).collect(), pairs, u64::MAX);
        let mut path = PathRecorder::new(3, 0);
        for time in [0.0, 1.0] {
            path.record(time, &[0.0; 6]);
        }
        let target = Body { mass: 1.0, inertia: 1.0, pose: [0.0, 0.3, 0.0], twist: [0.0; 3] };
        let attachments: Vec<_> = held
            .iter()
            .map(|(arm, target)| Attachment { arm: *arm, target: *target, kind: ContactKind::Pin })
            .collect();
        tracker.add_phase(&path.end(), 0.0, TargetMotion::Free(&[target]), &attachments).expect("distances");
        tracker.found.overlaps.len()
    };
    assert_eq!([&[][..], &[(0, 0)], &[(1, 1)], &[(1, 0)], &[(0, 0), (1, 0)]].map(overlaps), [1, 1, 1, 0, 0]);
}
