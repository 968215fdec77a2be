//! Every rigid body of a robot and what is beside it.

use crate::dynamics::Model;
use crate::error::Error;
use crate::simulate::system::Body;
use crate::state::State;

/// The base, the links arm by arm, then the bodies beside the robot, each with its pose and twist.
///
/// # Errors
/// What the model says of the state.
pub(crate) fn bodies(model: &dyn Model<f64>, state: &State<'_, f64>, beside: &[Body]) -> Result<Vec<Body>, Error> {
    let count = model.joints() + 1;
    let (mut inertias, mut poses, mut twists) = (vec![[0.0; 2]; count], vec![[0.0; 3]; count], vec![[0.0; 3]; count]);
    model.body_inertias(&mut inertias)?;
    model.body_poses(&state.base_pose, state.joint_angles, &mut poses)?;
    model.body_twists(state, &mut twists)?;
    let of_robot = inertias.iter().zip(poses).zip(twists);
    let of_robot =
        of_robot.map(|(([mass, inertia], pose), twist)| Body { mass: *mass, inertia: *inertia, pose, twist });
    Ok(of_robot.chain(beside.iter().copied()).collect())
}

/// Σ |I ω| + m |r × v| and Σ m |v|: what angular and linear momentum could be, against which their changes are rounding.
pub(crate) fn momentum_sizes(bodies: &[Body]) -> [f64; 2] {
    let mut sizes = [0.0; 2];
    for Body { mass, inertia, pose: [_, x, y], twist: [omega, vx, vy] } in bodies {
        sizes[0] += (inertia * omega).abs() + mass * (x * vy - y * vx).abs();
        sizes[1] += mass * vx.hypot(*vy);
    }
    sizes
}
