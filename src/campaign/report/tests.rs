//! What is the same in all cases, rows without results, and what the page says of numbers.
#![allow(clippy::float_cmp, reason = "numbers that are copied")]

use super::page::page;
use super::*;
use planar_proof::assert_close;

/// To 1e-10 of the largest magnitude, or of 1 where that is less.
#[test]
fn what_is_the_same_in_all_cases() {
    for (values, expected) in [
        (&[][..], None),
        (&[3.0], Some(3.0)),
        (&[1e-12, -9e-11], Some(9e-11)),
        (&[1e-12, 1.1e-10], None),
        (&[-1e3, -1e3 - 9e-8], Some(1e3 + 9e-8)),
        (&[-1e3, -1e3 - 1.1e-7], None),
        (&[1.0, 2.0, 1.0], None),
    ] {
        assert_eq!(same_in_all(values), expected, "{values:?}");
    }
}

/// An output of some of the cases belongs to the keys of these cases: one that is a key's value has the correlation and the
/// index of that key, and its points are on the diagonal.
#[test]
fn rows_without_a_result_leave_the_others_in_their_places() {
    let cases: Vec<u64> = (0..240).map(|row| 1000 + row).collect();
    // a key that rises, and one that only jumps
    let rising: Vec<f64> = (0..240).map(f64::from).collect();
    let other: Vec<f64> = (0..240).map(|row| f64::from(row * 89 % 241)).collect();
    let rows: Vec<usize> = (0..240).filter(|row| row % 3 != 0).collect();
    let values: Vec<f64> = rows.iter().map(|row| -other[*row]).collect();
    let keys = [("rising".to_owned(), rising), ("other".to_owned(), other)];
    let found = OutputReport::default().of(&cases, (&rows, &values), &keys, true, &mut HashMap::new());
    let found = found.expect("values");
    let correlations: Vec<f64> = found.correlations.iter().map(|of| of.expect("varies")).collect();
    assert_close("correlation", &correlations[1..], &[-1.0], 1e-12);
    assert!(correlations[0].abs() < 0.2 && found.first_order[1].is_some_and(|index| index > 0.9), "{found:?}");
    let scatter = found.scatter.expect("points");
    assert!(scatter.key == 1 && scatter.points.iter().all(|(key, output)| *key == -output));
    for (case, value) in found.extremes {
        assert_eq!(keys[1].1[usize::try_from(case - 1000).expect("a row")], -value);
    }
    assert_eq!(found.extremes[0].1, values.iter().copied().fold(f64::MAX, f64::min));
    assert_eq!(found.extremes[1].1, values.iter().copied().fold(f64::MIN, f64::max));
}

fn cells(html: &str, heading: &str) -> Vec<Vec<String>> {
    let table = html.split(&format!("<h2>{heading}</h2>")).nth(1).and_then(|rest| rest.split("</table>").next());
    let rows = table.expect("a table").split("<tr>").skip(2);
    let text = |cell: &str| cell.split("</td>").next().unwrap_or_default().to_owned();
    rows.map(|row| row.split("<td>").skip(1).map(text).collect()).collect()
}

/// Shares are of the cases with a result, extremes stand beside their cases, and correlations that are shown have two digits,
/// whatever their sign.
#[test]
fn what_the_page_says() {
    let output = OutputReport {
        name: "impulse".to_owned(),
        extremes: [(7, -2.5), (3, 4.5)],
        correlations: vec![Some(-0.504), Some(0.504), Some(0.0049), Some(-0.0049), None],
        first_order: vec![Some(0.25), Some(0.0), None, Some(0.5), Some(1.0)],
        ..OutputReport::default()
    };
    let kind = |i: usize| FailureKind { count: 1, case: 40, status: "stopped".to_owned(), message: format!("m{i}") };
    let keys = ["a", "b", "c", "d", "e"].map(|key| (key.to_owned(), String::new())).to_vec();
    let mut report = SweepReport {
        cases: 5,
        captured: [3, 4],
        keys,
        is_independent: true,
        outputs: vec![output],
        failures: (0..20).map(kind).collect(),
        ..SweepReport::default()
    };
    let html = page(&report, "again");
    assert!(!html.contains("but a hint"), "draws are independent");
    let by_sobol = SweepReport { sampling: Some("Sobol sequence"), ..SweepReport::default() };
    assert!(page(&by_sobol, "again").contains("of cases by a Sobol sequence the bounds are but a hint"));
    assert!(html.contains("captured in <b>3</b> of 4 cases with a result, 75.0\u{a0}%"), "{html}");
    assert_eq!(cells(&html, "Extremes"), [["impulse", "−2.5", "7", "4.5", "3"]]);
    assert_eq!(cells(&html, "Rank correlations"), [["impulse", "−0.50", "0.50", "·", "·", "–"]]);
    assert_eq!(cells(&html, "First-order indices"), [["impulse", "0.25", "·", "–", "0.50", "1.00"]]);
    // twenty kinds of failures, and a note only where there are more
    assert_eq!(cells(&html, "Failures").len(), 20);
    assert!(!html.contains("kinds, those with the most cases"));
    report.failures.push(kind(20));
    let html = page(&report, "again");
    assert_eq!(cells(&html, "Failures").len(), 20);
    assert!(html.contains("20 of 21 kinds, those with the most cases"));
}
