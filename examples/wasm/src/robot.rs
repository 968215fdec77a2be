//! The robot, its accelerations, and what a capture makes of it.
#![allow(unsafe_code, reason = "the attribute that gives a function its name in the module")]

use crate::Real;
use core::mem::MaybeUninit;
use planar_capture::dynamics::{ForwardDynamics, Merge};
use planar_capture::generated::dual_arm_3r::{ARMS, JOINTS, Model, PARAMETERS, Parameters, SIZE};
use planar_capture::impact::{self, RigidImpactOutput};
use planar_capture::state::{Forces, State};
use planar_capture::target::Target;

/// A robot with its numbers, opaque to the caller.
pub type Robot = Model<Real>;

/// Positions and velocities, in this order.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RobotState {
    /// [yaw, x, y] of the base COM; rad, m.
    pub base_pose: [Real; 3],
    /// Arm by arm, rad.
    pub joint_angles: [Real; JOINTS],
    /// [ω, vx, vy] of the base COM, inertial axes; rad/s, m/s.
    pub base_twist: [Real; 3],
    /// Arm by arm, rad/s.
    pub joint_rates: [Real; JOINTS],
}

impl RobotState {
    pub(crate) fn view(&self) -> State<'_, Real> {
        State {
            base_pose: self.base_pose,
            joint_angles: &self.joint_angles,
            base_twist: self.base_twist,
            joint_rates: &self.joint_rates,
        }
    }
}

/// What an end effector captures, in this order; an arm whose target has mass 0 captures nothing.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Captured {
    /// kg.
    pub mass: Real,
    /// About its COM, kg m².
    pub inertia: Real,
    /// [rx, ry] from its COM to the contact point, inertial axes, m.
    pub contact: [Real; 2],
    /// [ω, vx, vy] of its COM before the impact, inertial axes; rad/s, m/s.
    pub twist: [Real; 3],
}

fn targets(captured: &[Captured; ARMS]) -> [Option<Target<Real>>; ARMS] {
    captured.map(|Captured { mass, inertia, contact, twist }| {
        (mass != 0.0).then_some(Target { mass, inertia, contact, twist })
    })
}

/// Bytes of a robot.
#[unsafe(no_mangle)]
pub extern "C" fn robot_bytes() -> usize {
    size_of::<Robot>()
}

/// The parameters of the layout, in the order of its manifest: kg, kg m², m, rad.
#[unsafe(no_mangle)]
pub extern "C" fn default_parameters(parameters: &mut [Real; PARAMETERS]) {
    *parameters = Parameters::default().to_array();
}

/// A robot of these parameters.
#[unsafe(no_mangle)]
pub extern "C" fn new_robot(parameters: &[Real; PARAMETERS], robot: &mut MaybeUninit<Robot>) {
    robot.write(Model::new(Parameters::from_array(*parameters)));
}

/// Accelerations of base and joints under joint torques (N m): rad/s², m/s², m/s², then rad/s².
#[unsafe(no_mangle)]
pub extern "C" fn forward_dynamics(
    robot: &Robot,
    state: &RobotState,
    joint_torques: &[Real; JOINTS],
    accelerations: &mut [Real; SIZE],
) -> bool {
    let (base, joints) = accelerations.split_at_mut(3);
    let forces = Forces::torques(joint_torques);
    let found = ForwardDynamics::forward_dynamics(robot, &state.view(), &forces, joints);
    found.map(|acceleration| base.copy_from_slice(&acceleration)).is_ok()
}

/// Captures targets, rigidly: the velocities of the state, the targets' twists (rad/s, m/s) and the impulses [n, fx, fy] on
/// the robot (N m s, N s) are those after it.
#[unsafe(no_mangle)]
pub extern "C" fn exact_impact(
    robot: &Robot,
    state: &mut RobotState,
    captured: &[Captured; ARMS],
    target_twists: &mut [[Real; 3]; ARMS],
    impulses: &mut [[Real; 3]; ARMS],
) -> bool {
    let mut joint_rates = [0.0; JOINTS];
    let mut after = RigidImpactOutput { joint_rates: &mut joint_rates, target_twists, impulses };
    let found = impact::exact(robot, &state.view(), &targets(captured), &mut after);
    found.map(|base_twist| (state.base_twist, state.joint_rates) = (base_twist, joint_rates)).is_ok()
}

/// Makes it the robot that holds these targets, in the configuration of the state.
#[unsafe(no_mangle)]
pub extern "C" fn merge(robot: &mut Robot, state: &RobotState, captured: &[Captured; ARMS]) -> bool {
    Merge::merge(robot, &state.base_pose, &state.joint_angles, &targets(captured)).is_ok()
}
