//! What bodies look like, each in a frame of its own.

use super::{Motion, frames};
use crate::layout::{Layout, Link};
use crate::outline::Outline;
use crate::scenario::Scenario;
use std::f64::consts::TAU;

/// A body's frame, in which it does not move, and its look.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The frame's name.
    pub frame: String,
    /// In the frame.
    pub shape: Shape,
    /// Red, green, blue, opacity; 0 to 1.
    pub colour: [f64; 4],
    /// Extent across the plane, m.
    pub thickness: f64,
}

/// A body seen along the plane's normal; m.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Parallel to the frame's axes.
    Rectangle {
        /// [x, y].
        centre: [f64; 2],
        /// Along x and y.
        size: [f64; 2],
    },
    /// About the frame's origin.
    Disc {
        /// The radius.
        radius: f64,
    },
    /// Anticlockwise.
    Polygon {
        /// [x, y] each.
        corners: Vec<[f64; 2]>,
    },
}

/// Okabe and Ito's, which colour-blind readers tell apart; the same as in the report.
const ARMS: [[u8; 3]; 6] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xe6, 0x9f, 0x00],
    [0x56, 0xb4, 0xe9],
];
const BASE: [u8; 3] = [0xb4, 0xbf, 0xca];
const TARGET: [u8; 3] = [0x6d, 0x6d, 0x6d];
/// Width of a link over the mean length of links.
const SLENDERNESS: f64 = 0.08;

/// Base, links and targets.
#[must_use]
pub fn bodies(scenario: &Scenario) -> Vec<Body> {
    let layout = &scenario.layout;
    let width = link_width(layout);
    let links: Vec<&Link> = layout.arms.iter().flat_map(|arm| &arm.links).collect();
    let each = frames(scenario).into_iter().filter_map(|frame| {
        let (shape, colour, thickness) = match frame.motion {
            Motion::Base => (base(layout), colour(BASE, 1.0), 2.0 * width),
            Motion::Joint(joint) => (shape(links[joint], width), colour(ARMS[frame.arm? % ARMS.len()], 1.0), width),
            Motion::Target(target) => (outline(&scenario.targets[target].surface), colour(TARGET, 0.5), width),
            // an end effector is a point
            Motion::Fixed => return None,
        };
        Some(Body { frame: frame.name, shape, colour, thickness })
    });
    each.collect()
}

/// Of a target.
pub(crate) fn outline(surface: &Outline) -> Shape {
    match surface {
        Outline::Disc { radius } => Shape::Disc { radius: *radius },
        Outline::Polygon { corners } => Shape::Polygon { corners: corners.clone() },
    }
}

fn colour(rgb: [u8; 3], opacity: f64) -> [f64; 4] {
    let [r, g, b] = rgb.map(|part| f64::from(part) / 255.0);
    [r, g, b, opacity]
}

fn link_width(layout: &Layout) -> f64 {
    let lengths =
        || layout.arms.iter().flat_map(|arm| &arm.links).map(|link| link.length).filter(|length| *length > 0.0);
    let (sum, count) = lengths().fold((0.0, 0.0), |(sum, count), length| (sum + length, count + 1.0));
    SLENDERNESS * if count > 0.0 { sum / count } else { layout.base.radius_of_gyration() }
}

/// It reaches to its mounts, and is a uniform square of its mass and inertia else.
pub(crate) fn base(layout: &Layout) -> Shape {
    Shape::Rectangle { centre: [0.0; 2], size: base_size(layout) }
}

/// Sides of the base, m.
#[must_use]
pub fn base_size(layout: &Layout) -> [f64; 2] {
    let half = layout.base.radius_of_gyration() * 1.5_f64.sqrt();
    [0, 1].map(|i| 2.0 * layout.arms.iter().map(|arm| arm.mount[i].abs()).fold(half, f64::max))
}

/// A wheel is as large as its inertia makes it.
fn shape(link: &Link, width: f64) -> Shape {
    if link.length > 0.0 {
        Shape::Rectangle { centre: [link.length / 2.0, 0.0], size: [link.length, width] }
    } else {
        Shape::Disc { radius: (2.0 * link.inertia / link.mass).sqrt() }
    }
}

impl Shape {
    /// Lines that show place and direction: the edge, and a spoke from the frame's origin along its x axis.
    #[must_use]
    pub fn lines(&self) -> [Vec<[f64; 2]>; 2] {
        match self {
            Self::Rectangle { centre: [x, y], size: [length, width] } => {
                let corner = |a: f64, b: f64| [x + a * length / 2.0, y + b * width / 2.0];
                let edge = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)];
                [edge.map(|(a, b)| corner(a, b)).to_vec(), vec![[0.0; 2], [x + length / 2.0, 0.0]]]
            }
            Self::Disc { radius } => {
                let at = |angle: f64| [radius * angle.cos(), radius * angle.sin()];
                [(0..=48).map(|i| at(TAU * f64::from(i) / 48.0)).collect(), vec![[0.0; 2], [*radius, 0.0]]]
            }
            Self::Polygon { corners } => {
                let reach = corners.iter().fold(0.0, |most: f64, [x, _]| most.max(*x));
                let edge = corners.iter().chain(corners.first()).copied();
                [edge.collect(), vec![[0.0; 2], [reach, 0.0]]]
            }
        }
    }
}
