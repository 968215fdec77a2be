//! Lines that show a robot and what it captures.

use super::figure::{Mark, Series};
use super::style::{Colour, Dash, Shape};
use crate::layout::{Arm, Layout};
use crate::owned::RobotState;
use crate::scenario::Target;
use crate::surface::Surface;
use std::f64::consts::TAU;

const LINK: f64 = 3.0;
const OUTLINE: f64 = 1.6;

/// Length of an arrow's head as part of the arrow.
const HEAD: f64 = 0.35;

/// Base, arms and joints; the base is the uniform square of its mass and inertia.
pub(super) fn robot(layout: &Layout, motion: &RobotState) -> Vec<Series> {
    let [yaw, x, y] = motion.base_pose;
    let half = (6.0 * layout.base.inertia / layout.base.mass).sqrt() / 2.0;
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let square = corners.map(|(a, b)| place([x, y], yaw, [half * a, half * b]));
    let mut series = vec![line("base", Colour::Black, Dash::Solid, OUTLINE, square.to_vec())];
    let mut joint_angles = motion.joint_angles.iter();
    for (i, arm) in layout.arms.iter().enumerate() {
        let points = chain(arm, motion.base_pose, &mut joint_angles);
        let joints = points.len().saturating_sub(1);
        series.push(line(&arm.name, Colour::of(i), Dash::Solid, LINK, points.clone()));
        series.push(Series {
            label: None,
            colour: Colour::of(i),
            mark: Mark::Points(Shape::Circle),
            points: points.into_iter().take(joints).collect(),
        });
    }
    series
}

/// The joints of an arm and its tip.
fn chain<'a>(arm: &Arm, base: [f64; 3], joint_angles: &mut impl Iterator<Item = &'a f64>) -> Vec<(f64, f64)> {
    let [yaw, x, y] = base;
    let mut direction = yaw + arm.mount_angle;
    let mut points = vec![place([x, y], yaw, arm.mount)];
    for link in &arm.links {
        let Some(&(x, y)) = points.last() else { break };
        direction += joint_angles.next().copied().unwrap_or_default();
        points.push(place([x, y], direction, [link.length, 0.0]));
    }
    points
}

/// A target's outline and a spoke to each tip at it, or along a disc's x axis: they show how it turns.
pub(super) fn target(
    target: &Target,
    colour: Colour,
    pose: [f64; 3],
    tips: impl Iterator<Item = [f64; 2]>,
) -> Vec<Series> {
    let [yaw, x, y] = pose;
    let mut spots: Vec<[f64; 2]> = tips.collect();
    if let (Surface::Disc { radius }, true) = (&target.surface, spots.is_empty()) {
        spots.push(place([x, y], yaw, [*radius, 0.0]).into());
    }
    let mut series = vec![outline(&target.name, colour, Dash::Solid, &target.surface, pose)];
    let spoke = |spot: [f64; 2]| line(&target.name, colour, Dash::Solid, OUTLINE, vec![(x, y), spot.into()]);
    series.extend(spots.into_iter().map(spoke));
    series
}

/// Where a target turns freely about a tip.
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
    let barb = |turn: f64| place(to, angle + turn, [-HEAD * length, 0.0]);
    let points = vec![from.into(), to.into(), barb(0.5), to.into(), barb(-0.5)];
    Some(line(label, Colour::Black, Dash::Solid, OUTLINE, points))
}

/// Where a target was expected.
pub(super) fn expected(label: &str, target: &Target, [x, y]: [f64; 2]) -> Series {
    outline(label, Colour::Grey, Dash::Dashed, &target.surface, [target.yaw, x, y])
}

fn outline(label: &str, colour: Colour, dash: Dash, surface: &Surface, [yaw, x, y]: [f64; 3]) -> Series {
    let points = match surface {
        Surface::Disc { radius } => {
            (0..=48).map(|i| place([x, y], TAU * f64::from(i) / 48.0, [*radius, 0.0])).collect()
        }
        Surface::Polygon { corners } => {
            corners.iter().chain(corners.first()).map(|corner| place([x, y], yaw, *corner)).collect()
        }
    };
    line(label, colour, dash, OUTLINE, points)
}

fn line(label: &str, colour: Colour, dash: Dash, width: f64, points: Vec<(f64, f64)>) -> Series {
    Series { label: Some(label.to_owned()), colour, mark: Mark::Line(dash, width), points }
}

/// A point given in a frame at `origin`, turned by `angle`.
fn place(origin: [f64; 2], angle: f64, point: [f64; 2]) -> (f64, f64) {
    let ((sin, cos), [x, y]) = (angle.sin_cos(), point);
    (origin[0] + cos * x - sin * y, origin[1] + sin * x + cos * y)
}
