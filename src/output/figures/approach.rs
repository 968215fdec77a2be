//! Figures of the approach: joints, base and end effectors over time.

use super::figure::{Figure, Panel, Series};
use super::style::{Colour, Dash};
use super::time_curves::{TWIST_COMPONENTS, base, end_effectors, joints, panel};
use crate::capture::Study;
use crate::scenario::{FinalRates, Scenario};
use crate::simulate::Phase;

const TIME: &str = "Time [s]";

pub(super) fn figures(scenario: &Scenario, study: &Study) -> Vec<Figure> {
    let (layout, phase) = (&scenario.layout, &study.approach);
    let angles = joints(layout, phase, |s| &s.state.joint_angles);
    let rates = joints(layout, phase, |s| &s.state.joint_rates);
    let torques = joints(layout, phase, |s| &s.joint_torques);
    vec![
        Figure::column("approach_joint_angles", vec![panel(phase, TIME, "Joint angle [rad]", angles)]),
        Figure::column(
            "approach_joint_rates",
            vec![panel(phase, TIME, "Joint rate [rad/s]", rates), panel(phase, TIME, "Joint torque [N m]", torques)],
        ),
        Figure::column("approach_base", base(phase, TIME)),
        Figure::column(
            "approach_end_effector_velocities",
            TWIST_COMPONENTS.map(|(quantity, component)| velocities(scenario, phase, quantity, component)).to_vec(),
        ),
    ]
}

/// One component of the end effectors' twists, and its desired value at the end.
fn velocities(scenario: &Scenario, phase: &Phase, quantity: &str, component: usize) -> Panel {
    let mut series = end_effectors(&scenario.layout, phase, component);
    if let FinalRates::EndEffectorTwists(desired) = &scenario.approach.end {
        series.extend(desired.iter().zip(&scenario.layout.arms).enumerate().filter_map(|(i, (twist, arm))| {
            let value = twist[component]?;
            let points = vec![(0.0, value), (phase.duration, value)];
            Some(Series::line(&format!("{}, wanted", arm.name), Colour::of(i), Dash::Dotted, 1.2, points))
        }));
    }
    panel(phase, TIME, quantity, series)
}
