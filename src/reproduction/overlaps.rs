//! What the bodies of the paper's cases pass through, and when.

use super::Run;
use super::markdown::{number, table};
use crate::capture::clearance::Overlap;

/// Overlaps of less depth are contacts that are made from within, m.
const SHOWN_DEPTH: f64 = 1e-3;

/// A row for each pair of bodies and case of the first reading, in the order of the beginnings.
pub(super) fn overlaps(run: &Run) -> String {
    let mut rows = Vec::new();
    for case in &run.study.cases {
        let deep = case.clearance.overlaps.iter().filter(|overlap| overlap.depth > SHOWN_DEPTH);
        rows.extend(deep.map(|Overlap { bodies: [a, b], span: [from, to], depth, .. }| {
            let bodies = format!("`{a}`, `{b}`");
            vec![case.name.clone(), bodies, number(*from, 2), number(*to, 2), number(*depth, 3)]
        }));
    }
    table(&["case", "bodies", "from [s]", "to [s]", "depth [m]"], &rows)
}
