//! Figures of the motion after the impact.

use super::configuration;
use super::figure::Figure;
use super::time::{base, end_effectors, joints, panel};
use crate::capture::CaptureResult;
use crate::scenario::{Case, Scenario};

const TIME: &str = "Time after the impact [s]";

/// Joints, base and end effectors over time, and pictures of the robot with what it holds.
pub(super) fn figures(scenario: &Scenario, case: &Case, captured: &CaptureResult) -> Vec<Figure> {
    let (layout, phase, name) = (&scenario.layout, &captured.post_impact, &case.name);
    let angles = joints(layout, phase, |s| &s.state.joint_angles);
    let rates = joints(layout, phase, |s| &s.state.joint_rates);
    let twists = |component| end_effectors(layout, phase, component, |s| &s.end_effector_twists);
    let mut driven =
        vec![panel(phase, TIME, "Joint angle [rad]", angles), panel(phase, TIME, "Joint rate [rad/s]", rates)];
    if phase.samples.iter().any(|sample| sample.joint_torques.iter().any(|torque| *torque != 0.0)) {
        let torques = joints(layout, phase, |s| &s.joint_torques);
        driven.push(panel(phase, TIME, "Joint torque [N m]", torques));
    }
    let mut figures = vec![
        Figure::column(&format!("post_impact_joints_{name}"), &format!("Joints after the impact, {name}."), driven),
        Figure::column(
            &format!("post_impact_base_{name}"),
            &format!("Pose and twist of the base after the impact, {name}."),
            base(phase, TIME),
        ),
        Figure::column(
            &format!("post_impact_end_effector_velocities_{name}"),
            &format!("Twists of the tips, and of what they hold at the contact, after the impact, {name}."),
            vec![
                panel(phase, TIME, "Velocity x [m/s]", twists(1)),
                panel(phase, TIME, "Velocity y [m/s]", twists(2)),
                panel(phase, TIME, "Angular velocity [rad/s]", twists(0)),
            ],
        ),
    ];
    figures.extend(configuration::after_impact(scenario, name, captured));
    figures
}
