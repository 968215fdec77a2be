//! Samples and phases about another origin: positions, and the angular momentum about it, `l = l' + r × p`.

use crate::simulate::system::Body;
use crate::simulate::{Phase, Sample};

/// Moves [x, y] or [yaw, x, y] by [x, y], m.
pub(crate) fn translate(pose: &mut [f64], by: [f64; 2]) {
    pose.iter_mut().rev().zip(by.into_iter().rev()).for_each(|(value, by)| *value += by);
}

/// The angular momentum about an origin, beside that about the point [x, y], of the linear momentum [px, py]: r × p.
pub(crate) fn moment([x, y]: [f64; 2], [px, py]: [f64; 2]) -> f64 {
    x * py - y * px
}

/// Moves bodies by [x, y], m.
pub(crate) fn translate_bodies(bodies: &mut [Body], by: [f64; 2]) {
    for body in bodies {
        translate(&mut body.pose, by);
    }
}

impl Sample {
    /// The sample about an origin from which the present one is at [x, y], m.
    pub(crate) fn translate(&mut self, by: [f64; 2]) {
        translate(&mut self.state.base_pose, by);
        self.end_effector_poses.iter_mut().for_each(|pose| translate(pose, by));
        translate_bodies(&mut self.bodies, by);
        self.momentum.angular_momentum += moment(by, self.momentum.linear_momentum);
    }
}

impl Phase {
    /// As [`Sample::translate`], for all samples.
    pub(crate) fn translate(&mut self, by: [f64; 2]) {
        self.samples.iter_mut().for_each(|sample| sample.translate(by));
        self.stored.iter_mut().for_each(|stored| stored.translate(by));
    }
}
