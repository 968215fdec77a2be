//! The report as one page of HTML, which opens from disk.

use super::statistics::Percentile;
use super::{LISTED, OutputReport, PERCENTILES, SweepReport};
use crate::output::markup;
use crate::plain_text::count;
use std::fmt::Write;

const STYLE: &str = include_str!("page.css");

/// Below this a sensitivity is not shown: it is what chance leaves.
const SHOWN: f64 = 0.005;

/// The page; `command` replays a case, its index to follow.
#[must_use]
pub fn page(report: &SweepReport, command: &str) -> String {
    let mut html = String::new();
    let name = markup::attribute(&report.name);
    let mut add = |text: &str| html.push_str(text);
    add(&format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
         <title>{name}</title><style>\n{STYLE}</style>\n<h1>{name}</h1>\n<p>{}: ",
        match report.of_a_part {
            Some(_) => format!("{} of {} cases", report.cases, report.all),
            None => count(report.cases, "case"),
        }
    ));
    let counts: Vec<_> =
        report.statuses.iter().map(|(status, count)| format!("{count} {}", status.replace('_', " "))).collect();
    add(&format!("{}.", counts.join(", ")));
    let [captured, known] = report.captured;
    if known > 0 {
        #[allow(clippy::cast_precision_loss, reason = "a share")]
        let share = 100.0 * captured as f64 / known as f64;
        add(&format!(
            " All that is to be held was captured in <b>{captured}</b> of {known} cases with a result, {share:.1}\u{a0}%."
        ));
    }
    let about: Vec<_> =
        report.about.iter().map(|(what, value)| format!("{what} <b>{}</b>", markup::attribute(value))).collect();
    add(&format!(" Of {}</p>\n", about.join(", ")));
    if let Some(part) = &report.of_a_part {
        add(&format!("<p><b>{}.</b></p>\n", markup::attribute(part)));
    }
    if !report.varied.is_empty() {
        let rows = report.varied.iter().map(|(key, values)| vec![breakable(key), markup::attribute(values)]);
        add(&in_words(&table(&["varies", "distribution"].map(str::to_owned), rows)));
    }
    for ([one, other], rank) in &report.correlated {
        let [one, other] = [one, other].map(|key| markup::attribute(key));
        add(&format!("<p>Correlated: <b>{one}</b> with <b>{other}</b>, rank correlation {rank}.</p>\n"));
    }
    add(&failures(report));
    let of_sampling = report.sampling.map_or_else(String::new, |name| {
        format!(" That is the confidence of independent draws: of cases by a {name} the bounds are but a hint.")
    });
    add(&format!(
        "<h2>Percentiles</h2>\n<p class=\"note\">In brackets: the order statistics between which the percentile is with a \
         confidence of 95 %; – where there are too few cases for one.{of_sampling}</p>\n",
    ));
    let mut head = vec!["output".to_owned(), "cases".to_owned()];
    head.extend(PERCENTILES.iter().map(|p| format!("{p} %")));
    add(&table(&head, report.outputs.iter().map(percentiles)));
    let keys: Vec<String> =
        std::iter::once("output".to_owned()).chain(report.keys.iter().map(|(key, _)| breakable(key))).collect();
    if !report.keys.is_empty() {
        add(
            "<h2>Rank correlations</h2>\n<p class=\"note\">From −1 to 1: how far an output only falls or only rises with a key; \
             · is less than 0.005. An output that is least in the middle of a key's range has one near 0 although the key \
             decides it: its first-order index and its scatter show that.</p>\n",
        );
        add(&table(&keys, report.outputs.iter().map(|output| sensitivities(output, &output.correlations))));
        add("<h2>First-order indices</h2>\n");
        if report.is_independent {
            add(
                "<p class=\"note\">The part of an output's variance that a key explains alone; from the given cases, in \
                 classes of the key.</p>\n",
            );
            add(&table(&keys, report.outputs.iter().map(|output| sensitivities(output, &output.first_order))));
        } else {
            add("<p>None: keys are correlated, and what one of them explains another one does, too. A sweep without \
                 <code>[[correlation]]</code> has them.</p>\n");
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
    if !report.same.is_empty() {
        let shown = |(name, unit, size): &(String, String, f64)| {
            let unit = if unit.is_empty() { String::new() } else { format!(" {}", markup::attribute(unit)) };
            format!("{} ({}{unit})", markup::attribute(name), number(*size))
        };
        let all: Vec<_> = report.same.iter().map(shown).collect();
        add(&format!(
            "<h2>The same in all cases</h2>\n<p class=\"note\">To 1e-10 of the largest value, or in SI units where that is \
             less than 1; with the largest magnitude: {}.</p>\n",
            all.join(", ")
        ));
    }
    add(&format!(
        "<p>To compute one case again, and see its motion: <code>{} INDEX --report</code></p>\n",
        markup::attribute(command)
    ));
    #[cfg(feature = "figures")]
    add(&super::gallery::gallery(report));
    #[cfg(not(feature = "figures"))]
    add("<p><small>Without pictures: this program was built without the feature <code>figures</code>.</small></p>\n");
    add("</html>\n");
    html
}

/// What failed how often, with the first case of each kind.
fn failures(report: &SweepReport) -> String {
    if report.failures.is_empty() {
        return String::new();
    }
    let mut html = "<h2>Failures</h2>\n".to_owned();
    let rows = report.failures.iter().take(LISTED).map(|kind| {
        let [status, message] = [kind.status.replace('_', " "), markup::attribute(&kind.message)];
        vec![kind.count.to_string(), kind.case.to_string(), status, message]
    });
    html.push_str(&table(&["cases", "the first", "status", "its message"].map(str::to_owned), rows));
    if report.failures.len() > LISTED {
        let _ = writeln!(html, "<p>{LISTED} of {} kinds, those with the most cases.</p>", report.failures.len());
    }
    in_words(&html)
}

/// A table whose cells are texts, from the left and over several lines.
fn in_words(html: &str) -> String {
    html.replace("<table>", "<table class=\"words\">")
}

/// A name that may go on in the next line after its points and underscores, not within its words.
fn breakable(name: &str) -> String {
    markup::attribute(name).replace('.', ".<wbr>").replace('_', "_<wbr>")
}

fn named(output: &OutputReport) -> String {
    let unit = if output.unit.is_empty() {
        String::new()
    } else {
        format!(" <small>{}</small>", markup::attribute(&output.unit))
    };
    format!("{}{unit}", breakable(&output.name))
}

fn percentiles(output: &OutputReport) -> Vec<String> {
    let shown = |Percentile { value, bounds }: &Percentile| {
        let [low, high] = bounds.map(|bound| bound.map_or("–".to_owned(), number));
        format!("{}<br><small>[{low}, {high}]</small>", number(*value))
    };
    let first = [named(output), output.count.to_string()];
    first.into_iter().chain(output.percentiles.iter().map(shown)).collect()
}

fn sensitivities(output: &OutputReport, values: &[Option<f64>]) -> Vec<String> {
    let shown = |value: &Option<f64>| match value {
        Some(value) if value.abs() >= SHOWN => format!("{value:.2}").replace('-', "−"),
        Some(_) => "·".to_owned(),
        None => "–".to_owned(),
    };
    std::iter::once(named(output)).chain(values.iter().map(shown)).collect()
}

/// Four digits.
fn number(value: f64) -> String {
    let text = format!("{value:.3e}");
    let plain: f64 = text.parse().unwrap_or(value);
    let text = if plain == 0.0 || (1e-3..1e5).contains(&plain.abs()) { plain.to_string() } else { text };
    // a hyphen is no minus sign
    text.replace('-', "−")
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
