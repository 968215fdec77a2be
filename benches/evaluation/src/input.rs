//! What other engines compute with: the robot, states, and the results of generated code, as numbers in a text.

use crate::Problem;
use crate::measure::{ANGLES, STEP, layout};
use crate::runge_kutta::GAINS;
use crate::states::states;
use planar_capture::generated::dual_arm_3r::Model;
use std::path::Path;

/// How many states.
const COUNT: usize = 64;

/// Writes the numbers in the order of `engines/input.hpp`.
///
/// # Errors
/// Where the layout cannot be read, or the file not written.
pub fn write(path: &Path) -> Result<(), Problem> {
    let layout = layout()?;
    let mut numbers = vec![layout.base.mass, layout.base.inertia];
    #[allow(clippy::cast_precision_loss, reason = "few")]
    let count = |count: usize| count as f64;
    numbers.push(count(layout.arms.len()));
    for arm in &layout.arms {
        numbers.extend([arm.mount[0], arm.mount[1], arm.mount_angle, count(arm.links.len())]);
        for link in &arm.links {
            numbers.extend([link.length, link.mass, link.inertia, link.com[0], link.com[1]]);
        }
    }
    numbers.extend(GAINS);
    numbers.extend(ANGLES);
    numbers.extend([STEP, count(COUNT)]);
    let model = Model::<f64>::default();
    for s in states(COUNT) {
        let accelerations =
            model.forward_dynamics(&s.base_pose, &s.joint_angles, &s.base_twist, &s.joint_rates, &s.torques);
        let reduced = model.reduced_dynamics(&s.base_pose, &s.joint_angles, &s.base_twist, &s.joint_rates);
        for part in [
            &s.base_pose[..],
            &s.joint_angles,
            &s.base_twist,
            &s.joint_rates,
            &s.torques,
            &accelerations.base_acceleration,
            &accelerations.joint_accelerations,
            reduced.generalized_inertia.as_flattened(),
            &reduced.generalized_bias,
            reduced.generalized_jacobian.as_flattened(),
        ] {
            numbers.extend(part);
        }
    }
    // each number reads as itself
    let text: String = numbers.iter().flat_map(|number| [format!("{number:e}"), "\n".to_owned()]).collect();
    Ok(std::fs::write(path, text)?)
}
