//! Errors of poses, and what counts as reached.

use super::*;
use planar_proof::{assert_close, tolerance};

/// A distance counts relative to the reach, a yaw up to whole turns; an arm that may end anywhere has no error.
#[test]
fn poses_that_are_reached() {
    let of = |goal: EndEffectorGoal, reach: f64| TerminalError::at(&goal, &[0.5, 1.0, 2.0], reach);
    assert_eq!(of(EndEffectorGoal::Any, 1.0), None);
    for (reach, reached) in [(0.1, false), (4.9, false), (5.1, true), (50.0, true)] {
        let found = of(EndEffectorGoal::Position([1.003, 2.004]), reach).expect("an error");
        assert_close("distance", &[found.distance], &[0.005], tolerance::POLYNOMIAL);
        assert_eq!((found.parts.len(), found.yaw, found.reached), (2, None, reached), "{reach}");
    }
    let turn = std::f64::consts::TAU;
    for (yaw, reached) in [(0.499_1, true), (0.500_9 - turn, true), (0.498_9, false), (0.501_1 + turn, false)] {
        let found = of(EndEffectorGoal::Pose([yaw, 1.003, 2.004]), 5.1).expect("an error");
        assert_close("distance", &[found.distance], &[0.005], tolerance::POLYNOMIAL);
        assert_eq!((found.parts.len(), found.reached), (3, reached), "{yaw}");
        assert!(found.yaw.is_some_and(|error| (0.000_8..0.001_2).contains(&error)), "{found:?}");
    }
}
