//! One CSV time series per case: the approach, then the motion after the impact.

use crate::layout::Layout;
use crate::simulate::{Phase, Sample};
use crate::study::{CaseResult, Study};
use std::io::{self, Write};

/// Writes the time series of one case: a header row with units, one row per sample.
///
/// Where a torque acts on the base, there are columns for it, its work and its impulse; the torque is 0 in phases without.
/// At the impact there are two rows of the same time, before and after it. Work is counted from the start of each phase.
///
/// # Errors
/// What the writer says.
pub fn write_csv(layout: &Layout, study: &Study, case: &CaseResult, to: impl Write) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(to);
    let base_torque =
        case.capture.iter().filter_map(|captured| captured.post_impact.end()).any(|end| end.base_torque.is_some());
    csv.write_record(header(layout, base_torque))?;
    let approach = case.approach(study);
    write_phase(&mut csv, "approach", 0.0, approach, base_torque)?;
    if let Some(captured) = &case.capture {
        write_phase(&mut csv, "post_impact", approach.duration, &captured.post_impact, base_torque)?;
    }
    csv.flush()
}

fn header(layout: &Layout, base_torque: bool) -> Vec<String> {
    let mut names = vec!["time [s]".to_owned(), "phase".to_owned()];
    let mut add = |prefix: &str, parts: &[(&str, &str)]| {
        names.extend(parts.iter().map(|(part, unit)| format!("{prefix}{part} [{unit}]")));
    };
    let pose = [("yaw", "rad"), ("x", "m"), ("y", "m")];
    let twist = [("omega", "rad/s"), ("vx", "m/s"), ("vy", "m/s")];
    add("base_", &pose);
    each_joint(layout, |joint| add(&format!("{joint}_"), &[("angle", "rad")]));
    add("base_", &twist);
    for part in [("rate", "rad/s"), ("torque", "N m")] {
        each_joint(layout, |joint| add(&format!("{joint}_"), &[part]));
    }
    for parts in [&pose, &twist] {
        for arm in &layout.arms {
            add(&format!("{}_tip_", arm.name), parts);
        }
    }
    add("linear_momentum_", &[("x", "N s"), ("y", "N s")]);
    add("", &[("angular_momentum", "N m s"), ("kinetic_energy", "J"), ("joint_work", "J")]);
    if base_torque {
        add("base_", &[("torque", "N m"), ("work", "J"), ("impulse", "N m s")]);
    }
    names
}

fn each_joint(layout: &Layout, mut name: impl FnMut(String)) {
    for arm in &layout.arms {
        for k in 1..=arm.links.len() {
            name(format!("{}_joint{k}", arm.name));
        }
    }
}

fn write_phase(
    csv: &mut csv::Writer<impl Write>,
    name: &str,
    start: f64,
    phase: &Phase,
    base_torque: bool,
) -> io::Result<()> {
    for sample in &phase.samples {
        let mut row = vec![number(start + sample.time), name.to_owned()];
        row.extend(values(sample).map(number));
        if base_torque {
            let of_base = [sample.base_torque.unwrap_or_default(), sample.base_work, sample.base_impulse];
            row.extend(of_base.map(number));
        }
        csv.write_record(row)?;
    }
    Ok(())
}

/// In the order of [`header`].
fn values(sample: &Sample) -> impl Iterator<Item = f64> {
    let motion = &sample.motion;
    let before_tips = [
        &motion.base_pose[..],
        &motion.joint_angles,
        &motion.base_twist,
        &motion.joint_rates,
        &sample.joint_torques,
        sample.end_effector_poses.as_flattened(),
        sample.end_effector_twists.as_flattened(),
        &sample.linear_momentum,
    ];
    let last = [sample.angular_momentum, sample.kinetic_energy, sample.work];
    before_tips.into_iter().flatten().copied().chain(last).collect::<Vec<_>>().into_iter()
}

/// The shortest text that reads back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}
