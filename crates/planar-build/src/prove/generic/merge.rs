//! The merged robot: each last link composed with the target that it holds.

use super::{Body, Configuration, Generic, length};
use nalgebra::{Rotation2, Vector2};
use planar_dynamics::dynamics::{Merge, Robot};
use planar_dynamics::error::Error;
use planar_dynamics::target::Target;
use planar_dynamics::validate::{finite, finite_target};

/// Two bodies as one, both COMs in the frame of the first: the COM is the mean by mass, and the inertia about it is
/// the sum of both by the parallel axis theorem.
fn composed(link: &Body, mass: f64, inertia: f64, com: Vector2<f64>) -> Body {
    let own = Vector2::from(link.com);
    let total = link.mass + mass;
    let centre = (link.mass * own + mass * com) / total;
    let about = |inertia: f64, mass: f64, com: Vector2<f64>| inertia + mass * (com - centre).norm_squared();
    Body {
        mass: total,
        inertia: about(link.inertia, link.mass, own) + about(inertia, mass, com),
        com: centre.into(),
        joint: link.joint.clone(),
    }
}

impl Merge<f64> for Generic {
    fn merge(
        &mut self,
        base_pose: &[f64; 3],
        joint_angles: &[f64],
        targets: &[Option<Target<f64>>],
    ) -> Result<(), Error> {
        length("targets", self.arms(), targets.len())?;
        let at = Configuration::new(self, base_pose, joint_angles)?;
        let mut bodies = self.bodies.clone();
        for (arm, target) in targets.iter().enumerate() {
            let Some(target) = target else { continue };
            finite_target(target)?;
            let frame = &self.end_effectors[arm];
            if frame.body == 0 {
                // a base with its COM elsewhere would be another coordinate
                return Err(Error::Length { quantity: "links of an arm with a target", expected: 1, found: 0 });
            }
            let (yaw, _) = at.end_effector(arm);
            let com = Vector2::from(frame.position) - Rotation2::new(-yaw) * Vector2::from(target.contact);
            let merged = composed(&bodies[frame.body], target.mass, target.inertia, com);
            finite("merged parameters", &[merged.mass, merged.inertia, merged.com[0], merged.com[1]])?;
            bodies[frame.body] = merged;
        }
        self.bodies = bodies;
        Ok(())
    }
}
