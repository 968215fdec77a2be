//! Robot and targets as lines in the plane.

use super::figure::{Mark, Series};
use super::style::{Colour, Dash, Symbol};
use crate::frames::{point, poses, robot_frames};
use crate::layout::Layout;
use crate::outline::Outline;
use crate::output::scene::{Shape, base_shape};
use crate::owned::RobotState;
use crate::scenario::Target;

const LINK_WIDTH: f64 = 3.0;
const OUTLINE_WIDTH: f64 = 1.6;
const LINK_OUTLINE_WIDTH: f64 = 0.9;
const ARROW_WIDTH: f64 = 2.2;

/// Length of an arrow's head over that of the arrow.
const HEAD: f64 = 0.35;

/// Base, arms and joints.
pub(super) fn robot(layout: &Layout, state: &RobotState) -> Vec<Series> {
    let frames = robot_frames(layout);
    let poses = poses(&frames, state, &[]);
    let mut series = vec![outline("base", Colour::BLACK, Dash::Solid, &base_shape(layout), state.base_pose)];
    for (i, arm) in layout.arms.iter().enumerate() {
        let own = frames.iter().zip(&poses).filter(|(frame, _)| frame.arm == Some(i));
        let own_poses: Vec<_> = own.map(|(_, pose)| pose).collect();
        let mut points: Vec<(f64, f64)> = own_poses.iter().map(|[_, x, y]| (*x, *y)).collect();
        series.push(Series::line(&arm.name, Colour::of(i), Dash::Solid, LINK_WIDTH, points.clone()));
        // given outlines alone: others are the line
        let bodies = arm.links.iter().zip(own_poses).filter_map(|(link, pose)| Some((link.outline.clone()?, *pose)));
        series.extend(bodies.map(|(body, pose)| {
            let line = outline(&arm.name, Colour::of(i), Dash::Solid, &Shape::Outline(body), pose);
            Series { label: None, mark: Mark::Line(Dash::Solid, LINK_OUTLINE_WIDTH), ..line }
        }));
        // the end effector is no joint
        points.pop();
        let mark = Mark::Points(Symbol::Circle);
        series.push(Series { label: None, colour: Colour::of(i), mark, points });
    }
    series
}

/// A target's outline, and lines from its COM that show the orientation: to each end effector in contact, or along the
/// x axis of a disc without contacts.
pub(super) fn target(target: &Target, colour: Colour, pose: [f64; 3], end_effectors: &[[f64; 2]]) -> Vec<Series> {
    let [_, x, y] = pose;
    let mut ends = end_effectors.to_vec();
    if let (Outline::Disc { radius, .. }, []) = (&target.outline, end_effectors) {
        ends.push(point(pose, [*radius, 0.0]));
    }
    let mut series = vec![outline(&target.name, colour, Dash::Solid, &Shape::Outline(target.outline.clone()), pose)];
    let spoke =
        |end: [f64; 2]| Series::line(&target.name, colour, Dash::Solid, OUTLINE_WIDTH, vec![(x, y), end.into()]);
    series.extend(ends.into_iter().map(spoke));
    series
}

/// The symbol of a pin.
pub(super) fn pin(position: [f64; 2]) -> Series {
    Series::symbols("pin", Colour::BLACK, Symbol::Circle, vec![position.into()])
}

/// An arrow from a point; `None` if it has no length.
pub(super) fn arrow(label: &str, from: [f64; 2], along: [f64; 2]) -> Option<Series> {
    let length = libm::hypot(along[0], along[1]);
    if length < 1e-9 {
        return None;
    }
    let to = [from[0] + along[0], from[1] + along[1]];
    let angle = libm::atan2(along[1], along[0]);
    let barb = |turn: f64| point([angle + turn, to[0], to[1]], [-HEAD * length, 0.0]).into();
    let points = vec![from.into(), to.into(), barb(0.5), to.into(), barb(-0.5)];
    Some(Series::line(label, Colour::VIOLET, Dash::Solid, ARROW_WIDTH, points))
}

/// The outline of a target at its expected position.
pub(super) fn expected_target(label: &str, target: &Target, [x, y]: [f64; 2]) -> Series {
    outline(label, Colour::GREY, Dash::Dashed, &Shape::Outline(target.outline.clone()), [target.yaw, x, y])
}

pub(super) fn outline(label: &str, colour: Colour, dash: Dash, shape: &Shape, pose: [f64; 3]) -> Series {
    let [corners, _] = shape.lines();
    Series::line(
        label,
        colour,
        dash,
        OUTLINE_WIDTH,
        corners.into_iter().map(|corner| point(pose, corner).into()).collect(),
    )
}
