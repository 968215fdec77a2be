//! Tables 1 to 4: robot, targets, joint angles and end effectors.

use super::Run;
use super::markdown::{number, point, table};
use super::printed::{BODIES, END_EFFECTORS, JOINT_ANGLES, LOCATIONS, TARGET};
use crate::scenario::PlannedContact;
use crate::simulate::Sample;

/// Name in the template and table.
pub(super) fn tables(runs: &[Run; 3]) -> Vec<(&'static str, String)> {
    vec![
        ("bodies", bodies(&runs[0])),
        ("targets", targets(&runs[0])),
        ("joint_angles", joint_angles(runs)),
        ("end_effectors", end_effectors(runs)),
        ("end_effector_velocities", velocities(runs)),
        ("ends", ends(runs)),
    ]
}

/// Heads of the columns for the three readings.
const READINGS: [&str; 3] = ["ours, PD control", "ours, exact tracking", "eq. (7) as printed, PD"];

fn end(run: &Run) -> &Sample {
    run.study.approach.end()
}

fn bodies(run: &Run) -> String {
    let layout = &run.scenario.layout;
    let links = || layout.arms.iter().flat_map(|arm| &arm.links);
    let same = |value: fn(&crate::layout::Link) -> f64| {
        let mut values: Vec<String> = links().map(|link| value(link).to_string()).collect();
        values.dedup();
        values.join(", ")
    };
    let [base, link] = BODIES;
    let row = |what: &str, printed: f64, ours: String| vec![what.to_owned(), printed.to_string(), ours];
    let rows = [
        row("mass of the base [kg]", base[1], layout.base.mass.to_string()),
        row("moment of inertia of the base [kg m²]", base[2], layout.base.inertia.to_string()),
        row("length of each link [m]", link[0], same(|link| link.length)),
        row("mass of each link [kg]", link[1], same(|link| link.mass)),
        row("moment of inertia of each link [kg m²]", link[2], same(|link| link.inertia)),
    ];
    table(&["", "Table 1", "ours"], &rows)
}

fn targets(run: &Run) -> String {
    let [mass, radius, inertia] = TARGET;
    let mut rows = Vec::new();
    for (target, [x, y]) in run.scenario.targets.iter().zip(LOCATIONS) {
        let PlannedContact { arm, point: [rx, ry], .. } = target.contacts[0];
        let [_, end_effector_x, end_effector_y] = end(run).end_effector_poses[arm];
        let place = [end_effector_x - rx, end_effector_y - ry];
        rows.push(vec![
            target.name.clone(),
            format!("{mass} kg, {radius} m, {inertia} kg m², at {}", point([x, y], 1)),
            format!(
                "{} kg, {} m, {} kg m², taken at {}",
                target.mass,
                target.outline.reach(),
                target.inertia,
                point(place, 4)
            ),
            number(libm::hypot(place[0] - x, place[1] - y), 4),
        ]);
    }
    table(&["", "Table 2", "ours", "apart [m]"], &rows)
}

fn joint_angles(runs: &[Run; 3]) -> String {
    let mut rows = Vec::new();
    let [initial, last] = JOINT_ANGLES;
    for (joint, (initial, last)) in initial.into_iter().zip(last).enumerate() {
        let start = runs[0].scenario.initial.joint_angles[joint];
        let mut row = vec![format!("θ{}", joint + 1), number(initial, 3), number(start, 3), number(last, 3)];
        row.extend(runs.iter().map(|run| number(end(run).state.joint_angles[joint], 4)));
        rows.push(row);
    }
    table(&[&["[rad]", "Table 3, initial", "ours, initial", "Table 3, final"][..], &READINGS].concat(), &rows)
}

fn end_effectors(runs: &[Run; 3]) -> String {
    let end_effector = |sample: &Sample, i: usize| {
        let [_, x, y] = sample.end_effector_poses[i];
        [x, y]
    };
    let mut rows = Vec::new();
    let [initial, last] = END_EFFECTORS;
    for (i, (initial, last)) in initial.into_iter().zip(last).enumerate() {
        let start = end_effector(&runs[0].study.approach.samples[0], i);
        let mut row = vec![format!("end effector {}", i + 1), point(initial, 2), point(start, 4), point(last, 1)];
        row.extend(runs.iter().map(|run| point(end_effector(end(run), i), 4)));
        rows.push(row);
    }
    let mut row = vec!["end effector 1 from the base COM".to_owned(), String::new(), String::new()];
    row.push(number(libm::hypot(last[0][0], last[0][1]), 4));
    row.extend(runs.iter().map(|run| {
        let [x, y] = end_effector(end(run), 0);
        let [_, base_x, base_y] = end(run).state.base_pose;
        number(libm::hypot(x - base_x, y - base_y), 4)
    }));
    rows.push(row);
    table(&[&["[m]", "Table 4, initial", "ours, initial", "Table 4, final"][..], &READINGS].concat(), &rows)
}

fn velocities(runs: &[Run; 3]) -> String {
    let mut rows = Vec::new();
    for (i, wanted) in [[0.0, -0.1, 0.0], [0.0, 0.1, 0.0]].into_iter().enumerate() {
        let text =
            |[omega, vx, vy]: [f64; 3], digits| format!("{}, {}", point([vx, vy], digits), number(omega, digits));
        let mut row = vec![format!("end effector {}", i + 1), text(wanted, 1)];
        row.extend(runs.iter().map(|run| text(end(run).end_effector_twists[i], 4)));
        rows.push(row);
    }
    table(&[&["(vx, vy) [m/s], ω [rad/s]", "wanted"][..], &READINGS].concat(), &rows)
}

fn ends(runs: &[Run; 3]) -> String {
    let mut rows: Vec<Vec<String>> = ["base yaw [rad]", "base position [m]"].map(|what| vec![what.to_owned()]).into();
    for run in runs {
        let [yaw, x, y] = end(run).state.base_pose;
        rows[0].push(number(yaw, 4));
        rows[1].push(point([x, y], 4));
    }
    table(&[&["after 20 s"][..], &READINGS].concat(), &rows)
}
