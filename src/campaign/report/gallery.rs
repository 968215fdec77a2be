//! The pictures in the page, as SVG in addresses of images: each can be saved as a file.

use super::SweepReport;
use super::pictures::pictures;
use crate::output::markup;
use std::fmt::Write;

/// Most outputs that have pictures, three each.
pub(super) const OUTPUTS: usize = 12;

/// The section of the pictures.
pub(super) fn gallery(report: &SweepReport) -> String {
    let places = report.pictured(OUTPUTS);
    if places.is_empty() {
        return String::new();
    }
    let mut html = "<h2 id=\"pictures\">Pictures</h2>\n".to_owned();
    if report.pictured.is_empty() && places.len() < report.outputs.len() {
        let _ = writeln!(
            html,
            "<p>Of the {} outputs on which a key has the strongest effect, by rank correlation or the root of the first-order index; the tables have all {}.</p>",
            places.len(),
            report.outputs.len()
        );
    }
    for place in places {
        let output = &report.outputs[place];
        let name = markup::attribute(&output.name);
        let _ = writeln!(html, "<h3>{name}</h3>\n<div class=\"pictures\">");
        for picture in pictures(report, output) {
            let (address, file) = (address(&picture.svg()), markup::attribute(&picture.figure.name));
            let caption = markup::text(&picture.caption);
            let _ = writeln!(
                html,
                "<figure><img alt=\"{file}\" src=\"{address}\"><figcaption>{caption}</figcaption></figure>"
            );
        }
        html.push_str("</div>\n");
    }
    html
}

/// The text of an SVG file as an address, in an attribute between quotes.
fn address(svg: &str) -> String {
    let mut address = "data:image/svg+xml;charset=utf-8,".to_owned();
    for c in svg.chars() {
        match c {
            '%' => address.push_str("%25"),
            '#' => address.push_str("%23"),
            '"' => address.push_str("%22"),
            '&' => address.push_str("%26"),
            '<' => address.push_str("%3C"),
            '>' => address.push_str("%3E"),
            '\n' => address.push_str("%0A"),
            other => address.push(other),
        }
    }
    address
}

#[cfg(test)]
mod tests {
    use super::{OUTPUTS, address, gallery};
    use crate::campaign::report::SweepReport;
    use crate::campaign::report::pictures::tests::report;

    #[test]
    fn addresses_have_nothing_that_ends_them() {
        let found = address("<svg a=\"#b\">\n50% & ⁻³</svg>");
        assert_eq!(found, "data:image/svg+xml;charset=utf-8,%3Csvg a=%22%23b%22%3E%0A50%25 %26 ⁻³%3C/svg%3E");
    }

    #[test]
    fn names_are_escaped_and_bytes_are_the_same() {
        let page = || gallery(&report(&["a<b>&\"c\""]));
        assert_eq!(page(), page());
        assert!(page().contains("<h3>a&lt;b&gt;&amp;&quot;c&quot;</h3>") && !page().contains("a<b"), "{}", page());
    }

    #[test]
    fn of_many_outputs_the_most_sensitive_ones_are_drawn() {
        let names: Vec<String> = (0..300).map(|i| format!("output{i}")).collect();
        let mut many = report(&names.iter().map(String::as_str).collect::<Vec<_>>());
        for place in [7, 250] {
            many.outputs[place].correlations[0] = Some(-1.0);
        }
        let page = gallery(&many);
        assert_eq!(page.matches("<img").count(), 3 * OUTPUTS);
        assert!(page.contains("<h3>output250</h3>") && page.contains("<h3>output0</h3>"), "the first of equal ones");
        assert!(!page.contains("<h3>output11</h3>") && page.contains("the tables have all 300"));
        assert_eq!(gallery(&SweepReport::default()), "");
    }

    /// Whole words: `impulse` is not `impulses`.
    #[test]
    fn outputs_that_are_asked_for_are_drawn_alone() {
        let mut some = report(&["impulse_arm1", "impulses", "least_distance", "impulse"]);
        some.pictured = ["impulse", "contact"].map(str::to_owned).to_vec();
        let page = gallery(&some);
        assert_eq!(page.matches("<h3>").count(), 2);
        assert!(page.contains("<h3>impulse_arm1</h3>") && page.contains("<h3>impulse</h3>"), "{page}");
        some.pictured = vec!["contact".to_owned()];
        assert_eq!(gallery(&some), "");
    }
}
