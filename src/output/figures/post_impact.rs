//! Figures of the post-impact motion: joints, base and end effectors over time, and snapshots.

use super::configuration;
use super::figure::Figure;
use super::time_curves::{TWIST_COMPONENTS, base, end_effectors, joints, panel};
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::scenario::Scenario;

const TIME: &str = "Time after the impact [s]";

pub(super) fn figures(scenario: &Scenario, study: &Study, case: &CaseResult, capture: &CaptureResult) -> Vec<Figure> {
    let (layout, phase, name) = (&scenario.layout, &capture.post_impact, &case.name);
    let angles = joints(layout, phase, |s| &s.state.joint_angles);
    let rates = joints(layout, phase, |s| &s.state.joint_rates);
    let twists = TWIST_COMPONENTS
        .map(|(quantity, component)| panel(phase, TIME, quantity, end_effectors(layout, phase, component)));
    let mut joint_panels =
        vec![panel(phase, TIME, "Joint angle [rad]", angles), panel(phase, TIME, "Joint rate [rad/s]", rates)];
    if phase.samples.iter().any(|sample| sample.joint_torques.iter().any(|torque| *torque != 0.0)) {
        let torques = joints(layout, phase, |s| &s.joint_torques);
        joint_panels.push(panel(phase, TIME, "Joint torque [N m]", torques));
    }
    vec![
        Figure::column(&format!("post_impact_joints_{name}"), joint_panels),
        Figure::column(&format!("post_impact_base_{name}"), base(phase, TIME)),
        Figure::column(&format!("post_impact_end_effector_velocities_{name}"), twists.to_vec()),
        configuration::post_impact_motion(scenario, study, case, capture),
    ]
}
