//! What is drawn: the bodies, each in a frame of its own.

use super::frames;
use crate::layout::{Layout, Link};
use crate::scenario::Scenario;
use crate::surface::Surface;
use std::f64::consts::TAU;

/// A body's frame, in which it does not move, and its look.
pub(super) struct Body {
    pub(super) frame: String,
    pub(super) shape: Shape,
    /// Red, green, blue, opacity; 0 to 1.
    pub(super) colour: [f64; 4],
    /// Extent across the plane, m.
    pub(super) thickness: f64,
}

/// A body seen along the plane's normal; m.
pub(super) enum Shape {
    Rectangle { centre: [f64; 2], size: [f64; 2] },
    Disc { radius: f64 },
    Polygon { corners: Vec<[f64; 2]> },
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
pub(super) fn bodies(scenario: &Scenario) -> Vec<Body> {
    let layout = &scenario.layout;
    let width = link_width(layout);
    let base =
        Body { frame: frames::BASE.to_owned(), shape: base(layout), colour: colour(BASE, 1.0), thickness: 2.0 * width };
    let links = layout.arms.iter().zip(ARMS.iter().cycle()).flat_map(|(arm, rgb)| {
        arm.links.iter().enumerate().map(move |(k, link)| Body {
            frame: frames::link(arm, k),
            shape: shape(link, width),
            colour: colour(*rgb, 1.0),
            thickness: width,
        })
    });
    let targets = scenario.targets.iter().map(|target| Body {
        frame: frames::target(target),
        shape: match &target.surface {
            Surface::Disc { radius } => Shape::Disc { radius: *radius },
            Surface::Polygon { corners } => Shape::Polygon { corners: corners.clone() },
        },
        colour: colour(TARGET, 0.5),
        thickness: width,
    });
    std::iter::once(base).chain(links).chain(targets).collect()
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

/// It reaches to its mounts, and is a body of its mass and inertia else; as in the report.
fn base(layout: &Layout) -> Shape {
    let half = layout.base.radius_of_gyration() * 1.5_f64.sqrt();
    let reach = |i: usize| layout.arms.iter().map(|arm| arm.mount[i].abs()).fold(half, f64::max);
    Shape::Rectangle { centre: [0.0; 2], size: [2.0 * reach(0), 2.0 * reach(1)] }
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
    pub(super) fn lines(&self) -> [Vec<[f64; 2]>; 2] {
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
