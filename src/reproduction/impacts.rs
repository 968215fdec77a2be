//! Table 5 and the balances of momentum and energy, by the exact and the paper's equations.

use super::Run;
use super::markdown::{jump, number, point, table};
use super::printed::{IMPACT_DURATION, IMPULSES};
use crate::capture::CaptureResult;
use crate::capture::impact::ImpactResult;

/// Name in the template and table.
pub(super) fn tables(runs: &[Run; 3]) -> Vec<(&'static str, String)> {
    let [tracked, _, as_printed] = runs;
    vec![
        ("impulses", impulses(runs)),
        ("mean_forces", mean_forces(tracked)),
        ("balance", balance(tracked)),
        ("balance_as_printed", balance(as_printed)),
        ("differences", differences(tracked)),
        ("differences_as_printed", differences(as_printed)),
        ("post_impact", post_impact(tracked)),
    ]
}

/// The captures of a run with their cases' names.
fn captures(run: &Run) -> impl Iterator<Item = (&str, &CaptureResult)> {
    run.study.cases.iter().filter_map(|case| Some((case.name.as_str(), case.capture.as_ref()?)))
}

fn impulses(runs: &[Run; 3]) -> String {
    let all: Vec<Vec<&CaptureResult>> =
        runs.iter().map(|run| captures(run).map(|(_, captured)| captured).collect()).collect();
    let mut rows = Vec::new();
    for (case, printed) in IMPULSES.iter().enumerate() {
        for (contact, printed) in printed.iter().enumerate() {
            let mut row = vec![format!("case {}, contact {}", case + 1, contact + 1), number(*printed, 4)];
            for captured in &all {
                let impact = &captured[case].impact;
                for result in std::iter::once(&impact.exact).chain(&impact.paper) {
                    row.push(number(result.impulse_magnitudes()[contact].expect("both arms capture"), 4));
                }
            }
            rows.push(row);
        }
    }
    let head = [
        "[N s]",
        "Table 5",
        "PD, exact",
        "PD, literal",
        "exact tracking, exact",
        "exact tracking, literal",
        "(7) as printed, exact",
        "(7) as printed, literal",
    ];
    table(&head, &rows)
}

/// The least and the largest mean force of the exact impacts within the paper's duration, N.
fn mean_forces(run: &Run) -> String {
    let impulses = captures(run).flat_map(|(_, captured)| captured.impact.exact.impulse_magnitudes());
    let forces = impulses.flatten().map(|impulse| impulse / IMPACT_DURATION);
    let (least, most) =
        forces.fold((f64::MAX, 0.0), |(least, most): (f64, f64), force| (least.min(force), most.max(force)));
    format!("{} to {}", number(least, 0), number(most, 0))
}

fn balance(run: &Run) -> String {
    let mut rows = Vec::new();
    for (case, captured) in captures(run) {
        let literal = captured.impact.paper.iter().map(|result| ("literal", result));
        for (model, result) in std::iter::once(("exact", &captured.impact.exact)).chain(literal) {
            let mut row = vec![format!("{case}, {model}")];
            row.extend([result.kinetic_energy_before, result.kinetic_energy_after].map(|energy| number(energy, 6)));
            row.extend(result.momentum_jump.map(jump));
            rows.push(row);
        }
    }
    table(&["", "energy before [J]", "after [J]", "jump of l [N m s]", "of px [N s]", "of py [N s]"], &rows)
}

/// How far the literal equations are from the exact ones.
fn differences(run: &Run) -> String {
    let most = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
    let targets = |result: &ImpactResult| -> Vec<f64> {
        result.target_twists_after.iter().flatten().flatten().copied().collect()
    };
    let rows: Vec<Vec<String>> = captures(run)
        .filter_map(|(case, CaptureResult { impact: both, .. })| {
            let (exact, literal) = (&both.exact, both.paper.as_ref()?);
            Some(vec![
                case.to_owned(),
                number(most(&exact.joint_rates_after, &literal.joint_rates_after), 5),
                number((exact.base_twist_after[0] - literal.base_twist_after[0]).abs(), 5),
                number(most(&exact.base_twist_after[1..], &literal.base_twist_after[1..]), 5),
                number(most(&targets(exact), &targets(literal)), 5),
            ])
        })
        .collect();
    let head = ["", "a joint rate [rad/s]", "base ω [rad/s]", "base v [m/s]", "a target's twist [rad/s, m/s]"];
    table(&head, &rows)
}

fn post_impact(run: &Run) -> String {
    let rows: Vec<Vec<String>> = captures(run)
        .map(|(case, captured)| {
            let end = captured.post_impact.end();
            let [yaw, x, y] = end.state.base_pose;
            let angles = end.state.joint_angles.iter().map(|angle| number(*angle, 3)).collect::<Vec<_>>().join(", ");
            vec![case.to_owned(), number(yaw, 4), point([x, y], 4), angles]
        })
        .collect();
    table(&["50 s after the impact", "base yaw [rad]", "base position [m]", "joint angles [rad]"], &rows)
}
