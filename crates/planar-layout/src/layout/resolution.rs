//! What is left of a robot's inertias where its joints are free, by which 16 digits resolve its motion or do not.

use super::{Arm, Layout};

/// Smallest ratio of the inertia that a joint or the base moves with the joints beyond it free (articulated) to that with
/// them locked (composite). Mass matrices have the composite inertias, and factorisations leave the articulated ones as
/// their differences: accelerations of the generic implementation and captures are wrong by less than 1e-6
/// above this one (950 robots with masses from 1e-6 to 1e6 kg, against 60 digits), and soon by more below it.
pub(super) const LEAST_SHARE: f64 = 1e-5;

/// Robots are looked at in two poses, neither of which is stretched: all joints at 1 rad, and at −1 and 1 rad in turn. The
/// ratio of the better one counts, as a pose near a singular one says nothing of the robot.
const POSES: [[f64; 2]; 2] = [[1.0, 1.0], [-1.0, 1.0]];

/// Where the least is left.
#[derive(Clone, Copy)]
pub(super) struct Weakest {
    /// Arm and link; `None` for the base.
    pub link: Option<(usize, usize)>,
    /// The ratio of articulated to composite inertia.
    pub share: f64,
}

/// An inertia that moves with a point: of its twist [ω, vx, vy] half the quadratic form is the kinetic energy. Symmetric.
#[derive(Clone, Copy)]
struct PointInertia([[f64; 3]; 3]);

impl PointInertia {
    /// Of a body whose centre of mass is at [x, y] from the point.
    fn new(mass: f64, inertia: f64, [x, y]: [f64; 2]) -> Self {
        Self([[inertia + mass * (x * x + y * y), -mass * y, mass * x], [-mass * y, mass, 0.0], [mass * x, 0.0, mass]])
    }

    fn plus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| std::array::from_fn(|k| self.0[i][k] + other.0[i][k])))
    }

    /// The same with another point of the same body, from which this one is at [x, y].
    fn at(&self, [x, y]: [f64; 2]) -> Self {
        // of the twist there: ω, vx − y ω, vy + x ω
        let [[moment, mx, my], [_, xx, xy], [_, _, yy]] = self.0;
        let [row_x, row_y] = [mx - y * xx + x * xy, my - y * xy + x * yy];
        let turning = moment + (x * my - y * mx) + (x * row_y - y * row_x);
        Self([[turning, row_x, row_y], [row_x, xx, xy], [row_y, xy, yy]])
    }

    /// What is left where one component of the twist is free.
    fn free(&self, component: usize) -> Self {
        let of_free = self.0[component];
        let without = |i: usize, k: usize| self.0[i][k] - of_free[i] * (of_free[k] / of_free[component]);
        let is_free = |i: usize, k: usize| i == component || k == component;
        Self(std::array::from_fn(|i| std::array::from_fn(|k| if is_free(i, k) { 0.0 } else { without(i, k) })))
    }
}

impl Weakest {
    /// Of a robot.
    pub(super) fn of(layout: &Layout) -> Self {
        let [one, other] = POSES.map(|angles| Self::in_pose(layout, angles));
        if other.share > one.share { other } else { one }
    }

    fn in_pose(layout: &Layout, angles: [f64; 2]) -> Self {
        let mut weakest = Self { link: None, share: 1.0 };
        let base = PointInertia::new(layout.base.mass, layout.base.inertia, [0.0; 2]);
        let [mut locked, mut free] = [base; 2];
        for (i, arm) in layout.arms.iter().enumerate() {
            let [of_locked, of_free] = weakest.take_arm(i, arm, angles);
            (locked, free) = (locked.plus(&of_locked.at(arm.mount)), free.plus(&of_free.at(arm.mount)));
        }
        for component in 0..3 {
            weakest.take(None, component, &locked, &free);
            free = free.free(component);
        }
        weakest
    }

    /// Takes the joints of an arm, the last one first; returns the inertias that the base has at its mount.
    fn take_arm(&mut self, arm: usize, of: &Arm, angles: [f64; 2]) -> [PointInertia; 2] {
        let mut yaw = of.mount_angle;
        let turned = of.links.iter().zip(angles.iter().cycle()).map(|(link, angle)| {
            yaw += angle;
            (link, yaw)
        });
        let links: Vec<_> = turned.collect();
        let [mut locked, mut free] = [PointInertia([[0.0; 3]; 3]); 2];
        for (k, (link, yaw)) in links.into_iter().enumerate().rev() {
            let (sin, cos) = (libm::sin(yaw), libm::cos(yaw));
            let [x, y] = link.com;
            let own = PointInertia::new(link.mass, link.inertia, [cos * x - sin * y, sin * x + cos * y]);
            let end = [cos * link.length, sin * link.length];
            (locked, free) = (own.plus(&locked.at(end)), own.plus(&free.at(end)));
            self.take(Some((arm, k)), 0, &locked, &free);
            free = free.free(0);
        }
        [locked, free]
    }

    fn take(&mut self, link: Option<(usize, usize)>, component: usize, locked: &PointInertia, free: &PointInertia) {
        let share = free.0[component][component] / locked.0[component][component];
        if share < self.share {
            *self = Self { link, share };
        }
    }
}
