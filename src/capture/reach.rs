//! Distances that the end effectors cannot exceed, from masses, lengths and the motion of the centre of mass.

use crate::layout::Layout;
use crate::registry;
use crate::scenario::Scenario;
use crate::simulate::bodies::{BodySums, bodies};

/// The distance of a point from the robot's COM at the end of the approach, against the reach of an arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    /// [x, y] of the robot's COM at the end of the approach, m: without external forces it moves uniformly.
    pub(crate) center_of_mass: [f64; 2],
    /// Of the point from there, m.
    pub(crate) distance: f64,
    /// Upper bound of the same distance for the end effector, m: its reach from the base COM, and Σ m d / Σ m of the
    /// base COM from the robot's COM, d being the largest distance of a link's COM from the base COM.
    pub(crate) limit: f64,
}

impl Reach {
    /// For a point [x, y], m, and an arm; `None` for a wheel, and where the numbers are too large to compute with.
    pub(crate) fn new(scenario: &Scenario, arm: usize, [x, y]: [f64; 2]) -> Option<Self> {
        let (layout, initial) = (&scenario.layout, &scenario.initial.view());
        let arm = Some(&layout.arms[arm]).filter(|arm| arm.reach() > 0.0)?;
        let model = registry::generic(layout);
        let sums = BodySums::new(bodies(&*model, initial, &[]).ok()?.into_iter());
        let (start, mass) = (sums.center_of_mass(), sums.mass);
        let momentum = model.momentum(initial).ok()?.linear_momentum;
        let center_of_mass = [0, 1].map(|i: usize| start[i] + momentum[i] / mass * scenario.approach.duration);
        let distance = libm::hypot(x - center_of_mass[0], y - center_of_mass[1]);
        Some(Self { center_of_mass, distance, limit: arm.reach_from_base() + base_distance_limit(layout) })
    }

    /// Whether no configuration of the arm brings its end effector to the point.
    pub(crate) fn is_exceeded(&self) -> bool {
        self.distance > self.limit
    }
}

/// Upper bound of the distance between the COMs of base and robot, m.
fn base_distance_limit(layout: &Layout) -> f64 {
    let mut moment = 0.0;
    for arm in &layout.arms {
        let mut joint_distance = libm::hypot(arm.mount[0], arm.mount[1]);
        for link in &arm.links {
            moment += link.mass * (joint_distance + libm::hypot(link.com[0], link.com[1]));
            joint_distance += link.length;
        }
    }
    moment / layout.mass()
}
