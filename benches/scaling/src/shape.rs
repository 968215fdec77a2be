//! The measured robots: equal arms and links, from one arm of two links to four of seven; one long arm, and four of ten links.

use planar_capture::layout::{Arm, Base, Layout, Link};
use std::f64::consts::TAU;

/// A robot of equal arms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Number of arms.
    pub arms: u8,
    /// Links of each arm.
    pub links: u8,
}

impl Shape {
    /// All measured robots, by arms, then links.
    pub fn all() -> impl Iterator<Item = Self> {
        let regular =
            [1, 2, 3, 4].into_iter().flat_map(|arms| [2, 3, 5, 7].into_iter().map(move |links| (arms, links)));
        let large = [(1, 30), (4, 10)];
        regular.chain(large).map(|(arms, links)| Self { arms, links })
    }

    /// Links of all arms together.
    pub fn joints(self) -> u8 {
        self.arms * self.links
    }

    /// The name of its module.
    pub fn name(self) -> String {
        format!("arms_{}_links_{}", self.arms, self.links)
    }

    /// Arms at equal angles around the base, pointing outwards; no mount is on an axis, so that all arms have the same
    /// structural zeros. Masses and lengths are those of a satellite.
    pub fn layout(self) -> Layout {
        let link = Link { length: 0.8, mass: 7.0, inertia: 0.6, com: [0.35, 0.0], outline: None };
        let arm = |i: u8| {
            let angle = 0.5 + TAU * f64::from(i) / f64::from(self.arms);
            Arm {
                name: format!("arm{}", i + 1),
                mount: [0.5 * angle.cos(), 0.5 * angle.sin()],
                mount_angle: angle,
                links: vec![link.clone(); self.links.into()],
            }
        };
        let base = Base { mass: 400.0, inertia: 60.0, outline: None };
        Layout { name: self.name(), base, arms: (0..self.arms).map(arm).collect() }
    }
}
