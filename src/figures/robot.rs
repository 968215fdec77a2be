//! Lines that show a robot and what it captures.

use super::figure::{Mark, Series};
use super::style::{Colour, Dash, Shape};
use crate::layout::{Arm, Layout};
use crate::simulate::Motion;
use std::f64::consts::TAU;

const LINK: f64 = 3.0;
const OUTLINE: f64 = 1.6;

/// Base, arms and joints; the base is the uniform square of its mass and inertia.
pub(super) fn robot(layout: &Layout, motion: &Motion) -> Vec<Series> {
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

/// A target about its COM, with the spot at which it is held.
pub(super) fn target(label: &str, colour: Colour, centre: [f64; 2], radius: f64, spot: [f64; 2]) -> Vec<Series> {
    vec![
        circle(label, colour, Dash::Solid, centre, radius),
        // a spoke shows how the target turns
        line(label, colour, Dash::Solid, OUTLINE, vec![centre.into(), spot.into()]),
    ]
}

/// Where a target was expected.
pub(super) fn expected(label: &str, centre: [f64; 2], radius: f64) -> Series {
    circle(label, Colour::Grey, Dash::Dashed, centre, radius)
}

fn circle(label: &str, colour: Colour, dash: Dash, centre: [f64; 2], radius: f64) -> Series {
    let points = (0..=48).map(|i| place(centre, TAU * f64::from(i) / 48.0, [radius, 0.0])).collect();
    line(label, colour, dash, OUTLINE, points)
}

fn line(label: &str, colour: Colour, dash: Dash, width: f64, points: Vec<(f64, f64)>) -> Series {
    Series { label: Some(label.to_owned()), colour, mark: Mark::Line(dash, width), points }
}

/// A point given in a frame at `origin`, turned by `angle`.
pub(super) fn place(origin: [f64; 2], angle: f64, point: [f64; 2]) -> (f64, f64) {
    let ((sin, cos), [x, y]) = (angle.sin_cos(), point);
    (origin[0] + cos * x - sin * y, origin[1] + sin * x + cos * y)
}
