//! One period of a control loop.
#![allow(unsafe_code, reason = "the attribute that gives a function its name in the module")]

use crate::Real;
use crate::robot::{Robot, RobotState};
use planar_capture::control::{Control, ProportionalDerivative, SampledControl};
use planar_capture::error::Error;
use planar_capture::generated::dual_arm_3r::JOINTS;
use planar_capture::integrate::RungeKutta4;
use planar_capture::state::{State, vector_length};
use planar_capture::trajectory::{DesiredJoint, Trajectory};

/// Pose, angles, twist, rates, work of the torques.
const LENGTH: usize = vector_length(JOINTS);

/// Set values of all joints.
struct SetPoint<'a> {
    angles: &'a [Real; JOINTS],
    rates: &'a [Real; JOINTS],
}

impl Trajectory<Real> for SetPoint<'_> {
    fn joint(&self, joint: usize, _: Real) -> Option<DesiredJoint<Real>> {
        Some(DesiredJoint { angle: *self.angles.get(joint)?, rate: *self.rates.get(joint)?, acceleration: 0.0 })
    }
}

/// PD torques towards desired angles and rates (rad, rad/s), with gains of every joint (N m/rad, N m s/rad), held for a
/// Runge–Kutta step of the state (s). With gains of 0 it moves freely.
#[unsafe(no_mangle)]
pub extern "C" fn control_step(
    robot: &Robot,
    state: &mut RobotState,
    desired_angles: &[Real; JOINTS],
    desired_rates: &[Real; JOINTS],
    proportional_gain: Real,
    derivative_gain: Real,
    step: Real,
) -> bool {
    let law = ProportionalDerivative {
        trajectory: SetPoint { angles: desired_angles, rates: desired_rates },
        proportional_gain: &[proportional_gain; JOINTS],
        derivative_gain: &[derivative_gain; JOINTS],
    };
    advanced(robot, state, law, step).map(|after| *state = after).is_ok()
}

fn advanced(
    robot: &Robot,
    state: &RobotState,
    law: impl Control<Real, Robot>,
    step: Real,
) -> Result<RobotState, Error> {
    let (mut held, mut torques, mut workspace) = ([0.0; JOINTS], [0.0; JOINTS], [0.0; 3 * LENGTH]);
    let mut law = SampledControl::new(law, 1, &mut held);
    law.begin_step(0.0, robot, &state.view())?;
    let mut x = [0.0; LENGTH];
    state.view().write(&mut x)?;
    let mut integrator = RungeKutta4::new(&mut workspace)?;
    integrator.robot_step(robot, &mut law, 0.0, step, &mut x, &mut torques)?;
    let after = State::from_vector(&x, JOINTS)?;
    let (mut joint_angles, mut joint_rates) = ([0.0; JOINTS], [0.0; JOINTS]);
    joint_angles.copy_from_slice(after.joint_angles);
    joint_rates.copy_from_slice(after.joint_rates);
    Ok(RobotState { base_pose: after.base_pose, joint_angles, base_twist: after.base_twist, joint_rates })
}
