//! Lines that show a robot and what it captures.

use super::figure::{Mark, Series};
use super::style::{Colour, Dash, Shape};
use crate::layout::Layout;
use crate::outline::Outline;
use crate::output::scene::{base, point, poses, robot_frames};
use crate::owned::RobotState;
use crate::scenario::Target;

const LINK: f64 = 3.0;
const OUTLINE: f64 = 1.6;

/// Length of an arrow's head as part of the arrow.
const HEAD: f64 = 0.35;

/// Base, arms and joints.
pub(super) fn robot(layout: &Layout, state: &RobotState) -> Vec<Series> {
    let frames = robot_frames(layout);
    let poses = poses(&frames, state, &[]);
    let [edge, _] = base(layout).lines();
    let edge = edge.into_iter().map(|corner| point(state.base_pose, corner).into()).collect();
    let mut series = vec![line("base", Colour::Black, Dash::Solid, OUTLINE, edge)];
    for (i, arm) in layout.arms.iter().enumerate() {
        let own = frames.iter().zip(&poses).filter(|(frame, _)| frame.arm == Some(i));
        let mut points: Vec<(f64, f64)> = own.map(|(_, [_, x, y])| (*x, *y)).collect();
        series.push(line(&arm.name, Colour::of(i), Dash::Solid, LINK, points.clone()));
        // the end effector is no joint
        points.pop();
        let mark = Mark::Points(Shape::Circle);
        series.push(Series { label: None, colour: Colour::of(i), mark, points });
    }
    series
}

/// A target's outline and a spoke to each end effector at it, or along a disc's x axis: they show how it turns.
pub(super) fn target(
    target: &Target,
    colour: Colour,
    pose: [f64; 3],
    end_effectors: impl Iterator<Item = [f64; 2]>,
) -> Vec<Series> {
    let [_, x, y] = pose;
    let mut spots: Vec<[f64; 2]> = end_effectors.collect();
    if let (Outline::Disc { radius }, true) = (&target.surface, spots.is_empty()) {
        spots.push(point(pose, [*radius, 0.0]));
    }
    let mut series = vec![outline(&target.name, colour, Dash::Solid, &target.surface, pose)];
    let spoke = |spot: [f64; 2]| line(&target.name, colour, Dash::Solid, OUTLINE, vec![(x, y), spot.into()]);
    series.extend(spots.into_iter().map(spoke));
    series
}

/// Where a target turns freely about an end effector.
pub(super) fn pin([x, y]: [f64; 2]) -> Series {
    Series {
        label: Some("pin".to_owned()),
        colour: Colour::Black,
        mark: Mark::Points(Shape::Circle),
        points: vec![(x, y)],
    }
}

/// An arrow from a point; `None` where it has no length.
pub(super) fn arrow(label: &str, from: [f64; 2], along: [f64; 2]) -> Option<Series> {
    let length = along[0].hypot(along[1]);
    if length < 1e-9 {
        return None;
    }
    let to = [from[0] + along[0], from[1] + along[1]];
    let angle = along[1].atan2(along[0]);
    let barb = |turn: f64| point([angle + turn, to[0], to[1]], [-HEAD * length, 0.0]).into();
    let points = vec![from.into(), to.into(), barb(0.5), to.into(), barb(-0.5)];
    Some(line(label, Colour::Black, Dash::Solid, OUTLINE, points))
}

/// Where a target was expected.
pub(super) fn expected(label: &str, target: &Target, [x, y]: [f64; 2]) -> Series {
    outline(label, Colour::Grey, Dash::Dashed, &target.surface, [target.yaw, x, y])
}

fn outline(label: &str, colour: Colour, dash: Dash, surface: &Outline, pose: [f64; 3]) -> Series {
    let [edge, _] = crate::output::scene::outline(surface).lines();
    line(label, colour, dash, OUTLINE, edge.into_iter().map(|corner| point(pose, corner).into()).collect())
}

fn line(label: &str, colour: Colour, dash: Dash, width: f64, points: Vec<(f64, f64)>) -> Series {
    Series { label: Some(label.to_owned()), colour, mark: Mark::Line(dash, width), points }
}
