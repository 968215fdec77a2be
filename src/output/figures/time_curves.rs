//! Curves of joints, base and end effectors over the samples of a phase.

use super::figure::{Axis, Panel, Series};
use super::style::{Colour, Dash};
use crate::layout::Layout;
use crate::simulate::{Phase, Sample};

/// Width of a curve, points.
pub(super) const CURVE_WIDTH: f64 = 1.8;

/// Smallest span of an axis in rad, rad/s, m, m/s or N m: above rounding errors, below the visible motion of a robot.
pub(super) const MINIMUM_SPAN: f64 = 1e-6;

/// (axis label, index in [ω, vx, vy]) of the components of a twist, in the order of their panels.
pub(super) const TWIST_COMPONENTS: [(&str, usize); 3] =
    [("Velocity x [m/s]", 1), ("Velocity y [m/s]", 2), ("Angular velocity [rad/s]", 0)];

fn curve(phase: &Phase, label: &str, colour: Colour, dash: Dash, value: impl Fn(&Sample) -> f64) -> Series {
    let points = phase.samples.iter().map(|sample| (sample.time, value(sample)));
    Series::line(label, colour, dash, CURVE_WIDTH, points.collect())
}

/// A curve per joint: the colour shows the arm, the dash pattern the joint.
pub(super) fn joints(layout: &Layout, phase: &Phase, values: impl Fn(&Sample) -> &[f64]) -> Vec<Series> {
    let mut series = Vec::new();
    for (i, arm) in layout.arms.iter().enumerate() {
        for k in 1..=arm.links.len() {
            let (label, joint) = (format!("{} joint {k}", arm.name), series.len());
            series.push(curve(phase, &label, Colour::of(i), Dash::of(k - 1), |sample| values(sample)[joint]));
        }
    }
    series
}

/// A curve per arm of one component of its end effector's twist.
pub(super) fn end_effectors(layout: &Layout, phase: &Phase, component: usize) -> Vec<Series> {
    let arms = layout.arms.iter().enumerate();
    arms.map(|(i, arm)| {
        curve(phase, &arm.name, Colour::of(i), Dash::of(i), |sample| sample.end_effector_twists[i][component])
    })
    .collect()
}

/// A panel over the time of a phase.
pub(super) fn panel(phase: &Phase, time: &str, quantity: &str, series: Vec<Series>) -> Panel {
    Panel::new(Axis::time(time, phase.duration), Axis::new(quantity, MINIMUM_SPAN), series)
}

/// Yaw, position and their rates of the base.
pub(super) fn base(phase: &Phase, time: &str) -> Vec<Panel> {
    let component = |label: &str, i: usize, vector: fn(&Sample) -> &[f64; 3]| {
        let style = i.saturating_sub(1);
        // colours are of arms and targets
        curve(phase, label, Colour::BLACK, Dash::of(style), move |sample| vector(sample)[i])
    };
    let pose: fn(&Sample) -> &[f64; 3] = |sample| &sample.state.base_pose;
    let twist: fn(&Sample) -> &[f64; 3] = |sample| &sample.state.base_twist;
    vec![
        panel(phase, time, "Base yaw [rad]", vec![component("yaw", 0, pose)]),
        panel(phase, time, "Base position [m]", vec![component("x", 1, pose), component("y", 2, pose)]),
        panel(phase, time, "Base rate [rad/s]", vec![component("ω", 0, twist)]),
        panel(phase, time, "Base velocity [m/s]", vec![component("vx", 1, twist), component("vy", 2, twist)]),
    ]
}
