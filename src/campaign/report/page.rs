//! The report as one page of HTML, which opens from disk.

use super::statistics::Percentile;
use super::{OutputReport, PERCENTILES, SweepReport};
use crate::output::markup;
use crate::plain_text::count;
use std::fmt::Write;

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:75em;padding:0 1em;color:#222}\
    table{border-collapse:collapse;margin:1em 0;display:block;overflow-x:auto}\
    th,td{padding:.25em .7em;border-bottom:1px solid #ddd;text-align:right;white-space:nowrap}\
    th:first-child,td:first-child{text-align:left}.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(22em,1fr));gap:1em;align-items:start}\
    figure{margin:0;break-inside:avoid}figure img{width:100%}figcaption{color:#666;font-size:.85em}h3{margin:1.5em 0 .3em}\
    small{color:#666}code{background:#f4f4f4;padding:0 .3em}";

/// Below this a sensitivity is not shown: it is what chance leaves.
const SHOWN: f64 = 0.005;

/// The page; `command` replays a case, its index to follow.
#[must_use]
pub fn page(report: &SweepReport, command: &str) -> String {
    let mut html = String::new();
    let name = markup::attribute(&report.name);
    let mut add = |text: &str| html.push_str(text);
    add(&format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>{name}</title><style>{STYLE}</style>\n\
         <h1>{name}</h1>\n<p>{}: ",
        count(report.cases, "case")
    ));
    let counts: Vec<_> =
        report.statuses.iter().map(|(status, count)| format!("{count} {}", status.replace('_', " "))).collect();
    add(&format!("{}.</p>\n", counts.join(", ")));
    if !report.failures.is_empty() {
        add("<h2>Failures</h2>\n");
        let rows = report.failures.iter().map(|(case, status, message)| {
            vec![case.to_string(), status.replace('_', " "), markup::attribute(message)]
        });
        add(&table(&["case", "status", "message"].map(str::to_owned), rows));
    }
    add(
        "<h2>Percentiles</h2>\n<p><small>in brackets: between these order statistics with a confidence of 95 %</small></p>\n",
    );
    let mut head = vec!["output".to_owned(), "cases".to_owned()];
    head.extend(PERCENTILES.iter().map(|p| format!("{p} %")));
    add(&table(&head, report.outputs.iter().map(percentiles)));
    let keys: Vec<String> =
        std::iter::once("output".to_owned()).chain(report.keys.iter().map(|(key, _)| markup::attribute(key))).collect();
    if !report.keys.is_empty() {
        add("<h2>Rank correlations</h2>\n");
        add(&table(&keys, report.outputs.iter().map(|output| sensitivities(output, &output.correlations))));
        add("<h2>First-order indices</h2>\n");
        if report.is_independent {
            add(
                "<p><small>the part of an output's variance that a key explains alone; from the given cases, in classes of \
                 the key</small></p>\n",
            );
            add(&table(&keys, report.outputs.iter().map(|output| sensitivities(output, &output.first_order))));
        } else {
            add("<p>None: keys are correlated, and what one of them explains another one does, too.</p>\n");
        }
    }
    add("<h2>Extremes</h2>\n");
    let head = ["output", "smallest", "case", "largest", "case"].map(str::to_owned);
    add(&table(
        &head,
        report.outputs.iter().map(|output| {
            let [(low_case, low), (high_case, high)] = output.extremes;
            vec![named(output), number(low), low_case.to_string(), number(high), high_case.to_string()]
        }),
    ));
    add(&format!("<p>A case with all it has: <code>{} INDEX --report</code></p>\n", markup::attribute(command)));
    #[cfg(feature = "figures")]
    add(&super::gallery::gallery(report));
    #[cfg(not(feature = "figures"))]
    add("<p><small>Without pictures: this program was built without the feature <code>figures</code>.</small></p>\n");
    add("</html>\n");
    html
}

fn named(output: &OutputReport) -> String {
    let unit = if output.unit.is_empty() {
        String::new()
    } else {
        format!(" <small>{}</small>", markup::attribute(&output.unit))
    };
    format!("{}{unit}", markup::attribute(&output.name))
}

fn percentiles(output: &OutputReport) -> Vec<String> {
    let shown = |Percentile { value, bounds }: &Percentile| {
        let [low, high] = bounds.map(|bound| bound.map_or("–".to_owned(), number));
        format!("{} <small>[{low}, {high}]</small>", number(*value))
    };
    let first = [named(output), output.count.to_string()];
    first.into_iter().chain(output.percentiles.iter().map(shown)).collect()
}

fn sensitivities(output: &OutputReport, values: &[Option<f64>]) -> Vec<String> {
    let shown = |value: &Option<f64>| match value {
        Some(value) if value.abs() >= SHOWN => format!("{value:.2}"),
        Some(_) => "·".to_owned(),
        None => "–".to_owned(),
    };
    std::iter::once(named(output)).chain(values.iter().map(shown)).collect()
}

/// Four digits.
fn number(value: f64) -> String {
    let text = format!("{value:.3e}");
    let plain: f64 = text.parse().unwrap_or(value);
    if plain == 0.0 || (1e-3..1e5).contains(&plain.abs()) { plain.to_string() } else { text }
}

fn table(head: &[String], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut html = String::from("<table><tr>");
    let cells = |tag: &str, cells: &[String], html: &mut String| {
        for cell in cells {
            let _ = write!(html, "<{tag}>{cell}</{tag}>");
        }
    };
    cells("th", head, &mut html);
    for row in rows {
        html.push_str("</tr>\n<tr>");
        cells("td", &row, &mut html);
    }
    html.push_str("</tr></table>\n");
    html
}
