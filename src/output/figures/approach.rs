//! Figures of the approach.

use super::figure::{Figure, Mark, Panel, Series};
use super::style::{Colour, Dash};
use super::time::{base, end_effectors, joints, panel};
use crate::capture::Study;
use crate::scenario::{FinalRates, Scenario};
use crate::simulate::Phase;

const TIME: &str = "Time [s]";

/// Joints, base and end effectors over time.
pub(super) fn figures(scenario: &Scenario, study: &Study) -> Vec<Figure> {
    let (layout, phase) = (&scenario.layout, &study.approach);
    let angles = joints(layout, phase, |s| &s.state.joint_angles);
    let rates = joints(layout, phase, |s| &s.state.joint_rates);
    let torques = joints(layout, phase, |s| &s.joint_torques);
    vec![
        Figure::column(
            "approach_joint_angles",
            "Joint angles during the approach.",
            vec![panel(phase, TIME, "Joint angle [rad]", angles)],
        ),
        Figure::column(
            "approach_joint_rates",
            "Joint rates and torques during the approach.",
            vec![panel(phase, TIME, "Joint rate [rad/s]", rates), panel(phase, TIME, "Joint torque [N m]", torques)],
        ),
        Figure::column("approach_base", "Pose and twist of the base during the approach.", base(phase, TIME)),
        Figure::column(
            "approach_end_effector_velocities",
            "Twists of the tips during the approach; dotted: the twists wanted at its end.",
            ["Velocity x [m/s]", "Velocity y [m/s]", "Angular velocity [rad/s]"]
                .into_iter()
                .zip([1, 2, 0])
                .map(|(quantity, component)| velocities(scenario, phase, quantity, component))
                .collect(),
        ),
    ]
}

/// One component of the end effectors' twists, and what is wanted at the end.
fn velocities(scenario: &Scenario, phase: &Phase, quantity: &str, component: usize) -> Panel {
    let mut series = end_effectors(&scenario.layout, phase, component, |s| &s.end_effector_twists);
    if let FinalRates::EndEffectorTwists(wanted) = &scenario.approach.end {
        series.extend(wanted.iter().enumerate().filter_map(|(i, twist)| {
            let wanted = twist[component]?;
            Some(Series {
                label: scenario.layout.arms.get(i).map(|arm| format!("{}, wanted", arm.name)),
                colour: Colour::of(i),
                mark: Mark::Line(Dash::Dotted, 1.2),
                points: vec![(0.0, wanted), (phase.duration, wanted)],
            })
        }));
    }
    panel(phase, TIME, quantity, series)
}
