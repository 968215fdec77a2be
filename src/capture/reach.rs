//! Distances that the end effectors cannot exceed, from masses, lengths and the motion of the centre of mass.

use crate::layout::Layout;
use crate::registry;
use crate::scenario::Scenario;
use crate::simulate::bodies::{BodySums, bodies};

/// The distance of a point from the robot's COM at some time of the approach, against the reach of an arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    /// [x, y] of the robot's COM at that time, m: without external forces it moves uniformly.
    pub(crate) center_of_mass: [f64; 2],
    /// Of the point from there, m.
    pub(crate) distance: f64,
    /// Upper bound of the same distance for the end effector, m: its reach from the base COM, and Σ m d / Σ m of the
    /// base COM from the robot's COM, d being the largest distance of a link's COM from the base COM.
    pub(crate) limit: f64,
}

impl Reach {
    /// For a point [x, y], m, and an arm at the end of the approach; `None` for a wheel, and where the numbers are too
    /// large to compute with.
    pub(crate) fn new(scenario: &Scenario, arm: usize, point: [f64; 2]) -> Option<Self> {
        Self::at(scenario, arm, center_of_mass(scenario)?.after(scenario.approach.duration), point)
    }

    /// For a point that moves uniformly, and an arm: when it is nearest in a span of time, s, from the start of the
    /// approach on.
    pub(crate) fn nearest(scenario: &Scenario, arm: usize, point: UniformMotion, span: f64) -> Option<Self> {
        let center_of_mass = center_of_mass(scenario)?;
        let [x, y] = [0, 1].map(|i: usize| point.start[i] - center_of_mass.start[i]);
        let [vx, vy] = [0, 1].map(|i: usize| point.velocity[i] - center_of_mass.velocity[i]);
        let squared = vx * vx + vy * vy;
        let time = if squared > 0.0 { (-(x * vx + y * vy) / squared).clamp(0.0, span) } else { 0.0 };
        Self::at(scenario, arm, center_of_mass.after(time), point.after(time))
    }

    fn at(scenario: &Scenario, arm: usize, center_of_mass: [f64; 2], [x, y]: [f64; 2]) -> Option<Self> {
        let layout = &scenario.layout;
        let arm = Some(&layout.arms[arm]).filter(|arm| arm.reach() > 0.0)?;
        let distance = libm::hypot(x - center_of_mass[0], y - center_of_mass[1]);
        Some(Self { center_of_mass, distance, limit: arm.reach_from_base() + base_distance_limit(layout) })
    }

    /// Whether no configuration of the arm brings its end effector to the point.
    pub(crate) fn is_exceeded(&self) -> bool {
        self.distance > self.limit
    }
}

/// A point without forces: its place at the start of the approach, m, and its velocity, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct UniformMotion {
    pub(crate) start: [f64; 2],
    pub(crate) velocity: [f64; 2],
}

impl UniformMotion {
    fn after(self, time: f64) -> [f64; 2] {
        [0, 1].map(|i: usize| self.start[i] + self.velocity[i] * time)
    }
}

/// That of the robot's COM.
fn center_of_mass(scenario: &Scenario) -> Option<UniformMotion> {
    let initial = &scenario.initial.view();
    let model = registry::generic(&scenario.layout);
    let sums = BodySums::new(bodies(&*model, initial, &[]).ok()?.into_iter());
    let velocity = model.momentum(initial).ok()?.linear_momentum.map(|momentum| momentum / sums.mass);
    Some(UniformMotion { start: sums.center_of_mass(), velocity })
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

#[cfg(test)]
mod tests {
    use super::{Reach, UniformMotion};
    use crate::registry;
    use crate::scenario::Scenario;
    use planar_proof::assert_close;

    /// A robot that drifts for 3 s, of which its trajectory takes 1 s.
    const TEXT: &str = "name = \"it\"\nlayout = \"single_arm_2r\"\n[initial]\njoint_angles = [0.4, -0.9]\n\
                        base_twist = [0.0, 0.2, -0.1]\n[approach]\nduration = 3.0\ntrajectory_duration = 1.0\n\
                        trajectory = \"cycloidal\"\nfinal_joint_angles = [0.4, -0.9]\n";

    #[test]
    fn the_centre_of_mass_moves_to_the_end_of_the_approach() {
        let moving = Scenario::parse(TEXT, "it.toml", "".as_ref(), registry::SHIPPED).expect("a scenario");
        let mut resting = moving.clone();
        resting.initial.base_twist = [0.0; 3];
        let [end, start] = [&moving, &resting].map(|it| Reach::new(it, 0, [9.0, 9.0]).expect("a reach").center_of_mass);
        assert_close("way", &[end[0] - start[0], end[1] - start[1]], &[0.6, -0.3], 1e-12);
    }

    /// A point that comes from afar is nearest where it passes, or at an end of the time.
    #[test]
    fn a_moving_point_is_nearest_where_it_passes() {
        let scenario = Scenario::parse(TEXT, "it.toml", "".as_ref(), registry::SHIPPED).expect("a scenario");
        let center = |span| {
            let still = UniformMotion { start: [0.0; 2], velocity: [0.2, -0.1] };
            Reach::nearest(&scenario, 0, still, span).expect("a reach").center_of_mass
        };
        let start = center(0.0);
        let distance = |[x, y]: [f64; 2], span| {
            let start = [start[0] + x, start[1] + y];
            let passing = UniformMotion { start, velocity: [-0.8, -0.1] };
            Reach::nearest(&scenario, 0, passing, span).expect("a reach").distance
        };
        // relative to the robot's COM it comes along x by 1 m/s
        let found = [distance([5.0, 2.0], 9.0), distance([5.0, 2.0], 2.0), distance([-5.0, 2.0], 9.0)];
        assert_close("distances", &found, &[2.0, libm::hypot(3.0, 2.0), libm::hypot(5.0, 2.0)], 1e-12);
    }

    /// Of an arm of one link, whose COM is anywhere in its frame, the base is farthest where the COM is on the line of the
    /// mount.
    #[test]
    fn the_limit_is_that_of_the_stretched_arm() {
        let mut scenario = Scenario::parse(TEXT, "it.toml", "".as_ref(), registry::SHIPPED).expect("a scenario");
        let arm = &mut scenario.layout.arms[0];
        arm.links.truncate(1);
        arm.links[0].com = [0.3, -0.4];
        (scenario.initial.joint_angles, scenario.initial.joint_rates) = (vec![0.4], vec![0.0]);
        let (mount, length) = (libm::hypot(arm.mount[0], arm.mount[1]), arm.links[0].length);
        let share = arm.links[0].mass / scenario.layout.mass();
        let limit = Reach::new(&scenario, 0, [9.0, 9.0]).expect("a reach").limit;
        assert_close("limit", &[limit], &[mount + length + share * (mount + 0.5)], 1e-12);
    }

    /// Of several arms each has its own limit, and the others' links only move the base.
    #[test]
    fn each_arm_has_its_own_limit() {
        let text = TEXT.replace("single_arm_2r", "triple_arm_3r");
        let angles = "[0.3, -0.9, 0.4, 0.3, -0.9, 0.4, 0.3, -0.9, 0.4]";
        let mut scenario =
            Scenario::parse(&text.replace("[0.4, -0.9]", angles), "it.toml", "".as_ref(), registry::SHIPPED)
                .expect("a scenario");
        let limits =
            |scenario: &Scenario| [0, 1, 2].map(|arm| Reach::new(scenario, arm, [9.0, 9.0]).expect("a reach").limit);
        let before = limits(&scenario);
        // a longer last link has its COM where it was
        scenario.layout.arms[2].links[2].length += 1.0;
        let after = limits(&scenario);
        assert_close("limits", &after, &[before[0], before[1], before[2] + 1.0], 1e-12);
    }
}
