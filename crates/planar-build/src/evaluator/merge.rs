//! Merging of captured targets into the last links.

use super::model::GraphModel;
use planar_dynamics::dynamics::{Kinematics, Merge, Robot};
use planar_dynamics::error::Error;
use planar_dynamics::manifest::ParameterKind::{LinkComX, LinkComY, LinkInertia, LinkLength, LinkMass};
use planar_dynamics::target::{self, Target};
use planar_dynamics::validate::{finite, pivot};

impl Merge<f64> for GraphModel {
    fn merge(
        &mut self,
        base_pose: &[f64; 3],
        joint_angles: &[f64],
        targets: &[Option<Target<f64>>],
    ) -> Result<(), Error> {
        self.check_targets(targets)?;
        let mut end_effectors = vec![[0.0; 3]; self.arms()];
        self.end_effector_poses(base_pose, joint_angles, &mut end_effectors)?;
        let mut values = self.parameters().to_vec();
        for (arm, (target, end_effector)) in targets.iter().zip(&end_effectors).enumerate() {
            let Some(target) = target else { continue };
            let last = self.evaluator().structure().links[arm].saturating_sub(1);
            let place = |kind| self.position(kind, arm, last);
            let [mass, inertia, x, y] = [place(LinkMass)?, place(LinkInertia)?, place(LinkComX)?, place(LinkComY)?];
            let before =
                target::LinkInertia { mass: values[mass], inertia: values[inertia], com: [values[x], values[y]] };
            let after = target.merged_link(&before, values[place(LinkLength)?], end_effector[0]);
            (values[mass], values[inertia]) = (after.mass, after.inertia);
            [values[x], values[y]] = after.com;
        }
        finite("merged parameters", &values)?;
        match self.with_parameters(values) {
            Some(merged) => *self = merged,
            None => pivot("the merged robot", f64::NAN)?,
        }
        Ok(())
    }
}
