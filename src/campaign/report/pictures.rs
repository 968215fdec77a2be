//! The pictures of outputs: histogram, tornado of sensitivities, scatter over the strongest key; bounded in number.

use super::axis_unit::AxisUnit;
use super::histogram::Histogram;
use super::scatter::{Scatter, strongest_first};
use super::{OutputReport, SweepReport};
use crate::output::figures::draw::svg;
use crate::output::figures::{Axis, AxisRange, Colour, Dash, Figure, Mark, Panel, Series, Symbol, Width};

/// Most keys of a tornado.
const KEYS: usize = 12;

/// Of a bar below the middle of its place, in places: its name is above it.
const BELOW_NAME: f64 = 0.22;

/// Height of the marks across a bar, in places.
const MARK: f64 = 0.44;

/// A picture and what to say below it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Picture {
    pub(super) figure: Figure,
    pub(super) caption: String,
}

impl Picture {
    /// As SVG, with text of seven points at its own width.
    pub(super) fn svg(&self) -> String {
        svg(&self.figure, Width::Single)
    }
}

/// Those of an output, up to three.
pub(super) fn pictures(report: &SweepReport, output: &OutputReport) -> Vec<Picture> {
    let of_histogram = output.histogram.as_ref().map(|found| histogram(report, output, found));
    let of_scatter = output.scatter.as_ref().map(|found| scatter(report, output, found));
    of_histogram.into_iter().chain(tornado(report, output)).chain(of_scatter).collect()
}

/// With the output's name above: along an axis there is no room for a long one.
fn titled(output: &OutputReport, panel: Panel) -> Panel {
    Panel { title: Some(output.name.clone()), ..panel }
}

fn picture(kind: &str, output: &OutputReport, panel: Panel, caption: String) -> Picture {
    Picture { figure: Figure::column(&format!("{kind}_{}", output.name), vec![panel]), caption }
}

#[allow(clippy::cast_precision_loss, reason = "counts of values in memory")]
fn histogram(report: &SweepReport, output: &OutputReport, found: &Histogram) -> Picture {
    let Histogram { edges, counts } = found;
    let unit = AxisUnit::between(edges[0], edges[edges.len() - 1]);
    let highest = counts.iter().max().copied().unwrap_or_default() as f64;
    // no ticks at parts of a case
    let y = Axis { label: "cases".to_owned(), range: AxisRange::Fixed(0.0, (1.05 * highest).max(5.0)) };
    // the end of the last bar has no height
    let heights = counts.iter().map(|count| *count as f64).chain([0.0]);
    let points = edges.iter().map(|edge| unit.of(*edge)).zip(heights).collect();
    let bars = Series { label: None, colour: Colour::of(0), mark: Mark::Bars, points };
    let caption = format!("{} of {} cases in {} classes", output.count, report.cases, counts.len());
    picture("histogram", output, titled(output, Panel::new(unit.axis("", &output.unit), y, vec![bars])), caption)
}

/// `None` without a correlation.
#[allow(clippy::cast_precision_loss, reason = "a few keys")]
fn tornado(report: &SweepReport, output: &OutputReport) -> Option<Picture> {
    let mut bars = strongest_first(&output.correlations);
    let all = bars.len();
    bars.truncate(KEYS);
    if bars.is_empty() {
        return None;
    }
    // the strongest one has the highest place
    bars.reverse();
    let names = bars.iter().map(|(key, _)| report.keys[*key].0.clone()).collect();
    let bar = |(place, (_, correlation)): (usize, &(usize, f64))| Series {
        label: None,
        colour: Colour::of(usize::from(*correlation < 0.0)),
        mark: Mark::Line(Dash::Solid, 10.0),
        points: [0.0, *correlation].map(|x| (x, place as f64 + 1.0 - BELOW_NAME)).to_vec(),
    };
    // across the bars alone: their names stay free
    let mark = |place: usize, x: f64, dash: Dash| Series {
        label: None,
        colour: Colour::BLACK,
        mark: Mark::Line(dash, 1.0),
        points: [-0.5, 0.5].map(|side| (x, place as f64 + 1.0 - BELOW_NAME + side * MARK)).to_vec(),
    };
    // the normal distribution that rank correlations of independent values are near to
    let chance = 1.96 / libm::sqrt((output.count as f64 - 1.0).max(1.0));
    let bounds = [-chance, chance].into_iter().filter(|bound| bound.abs() < 1.0);
    let lines: Vec<_> = bounds.map(|x| (x, Dash::Dotted)).chain([(0.0, Dash::Solid)]).collect();
    let marks = lines.into_iter().flat_map(|(x, dash)| (0..bars.len()).map(move |place| mark(place, x, dash)));
    let series = bars.iter().enumerate().map(bar).chain(marks).collect();
    let x = Axis { label: "rank correlation".to_owned(), range: AxisRange::Fixed(-1.0, 1.0) };
    let y = Axis { label: String::new(), range: AxisRange::NamedBars(names) };
    let panel = titled(output, Panel::new(x, y, series));
    let caption = match all - bars.len() {
        0 => "all keys".to_owned(),
        others => format!("the {KEYS} strongest keys; {others} others are in the table"),
    };
    let caption = format!("{caption}; between the dotted lines are 95 % of what chance alone leaves");
    Some(picture("tornado", output, panel, caption))
}

fn scatter(report: &SweepReport, output: &OutputReport, found: &Scatter) -> Picture {
    let Scatter { key, stride, points } = found;
    let (key, unit_of_key) = &report.keys[*key];
    let between = |values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(value), high.max(value)));
        AxisUnit::between(low, high)
    };
    let x = between(&mut points.iter().map(|point| point.0));
    let y = between(&mut points.iter().map(|point| point.1));
    let shown = points.iter().map(|point| (x.of(point.0), y.of(point.1))).collect();
    let symbols = Series { label: None, colour: Colour::of(0), mark: Mark::Points(Symbol::Dot), points: shown };
    let panel = titled(output, Panel::new(x.axis(key, unit_of_key), y.axis("", &output.unit), vec![symbols]));
    let caption = match stride {
        1 => format!("all {} cases, over the key with the strongest rank correlation", points.len()),
        _ => format!(
            "{} of {} cases, one in {stride}, over the key with the strongest rank correlation",
            points.len(),
            output.count
        ),
    };
    picture("scatter", output, panel, caption)
}

#[cfg(test)]
pub(super) mod tests {
    use super::{Picture, pictures};
    use crate::campaign::report::histogram::Histogram;
    use crate::campaign::report::scatter::Scatter;
    use crate::campaign::report::{OutputReport, SweepReport};
    use crate::output::figures::{AxisRange, Mark};

    /// A hundred cases of three keys, and these outputs: the second key over the first.
    pub fn report(outputs: &[&str]) -> SweepReport {
        let values: Vec<f64> = (0..100).map(|i| 1e-7 * f64::from(i)).collect();
        let correlations = vec![Some(0.1), Some(-0.9), None, Some(0.5)];
        let output = |name: &&str| OutputReport {
            name: (*name).to_owned(),
            unit: "N s".to_owned(),
            count: 100,
            histogram: Histogram::of(&values),
            scatter: Scatter::of(&correlations, |_| values.clone(), &values),
            correlations: correlations.clone(),
            ..OutputReport::default()
        };
        let keys = ["a.b", "target.<t>.mass", "c", "d"].map(|key| (key.to_owned(), "kg".to_owned())).to_vec();
        SweepReport { cases: 120, keys, outputs: outputs.iter().map(output).collect(), ..SweepReport::default() }
    }

    fn of_one(name: &str) -> [Picture; 3] {
        let report = report(&[name]);
        pictures(&report, &report.outputs[0]).try_into().expect("three pictures")
    }

    #[test]
    #[allow(clippy::float_cmp, reason = "counts, and numbers that are copied")]
    fn pictures_show_the_data() {
        let [histogram, tornado, scatter] = of_one("impulse");
        let bars = &histogram.figure.panels[0].series[0];
        assert_eq!(bars.mark, Mark::Bars);
        assert_eq!(bars.points.iter().map(|point| point.1).sum::<f64>(), 100.0);
        assert_eq!(histogram.figure.panels[0].x.label, "[10⁻⁶ N s]");
        assert_eq!(histogram.caption, "100 of 120 cases in 8 classes");

        let panel = &tornado.figure.panels[0];
        // from below: the strongest one is the highest
        let AxisRange::NamedBars(names) = &panel.y.range else { panic!("{:?}", panel.y) };
        assert_eq!(names[..], ["a.b", "d", "target.<t>.mass"]);
        let ends: Vec<f64> = panel.series[..3].iter().map(|series| series.points[1].0).collect();
        assert_eq!(ends, [0.1, 0.5, -0.9]);
        // the two signs have a colour each
        let colours: Vec<_> = panel.series[..3].iter().map(|series| series.colour).collect();
        assert!(colours[0] == colours[1] && colours[1] != colours[2], "{colours:?}");
        // what chance leaves of the correlations of the hundred cases with a result
        let chance: Vec<f64> = [3, 6].map(|first| panel.series[first].points[0].0).to_vec();
        planar_proof::assert_close("chance", &chance, &[-1.96 / 99_f64.sqrt(), 1.96 / 99_f64.sqrt()], 1e-12);

        let panel = &scatter.figure.panels[0];
        assert_eq!(panel.series[0].points.len(), 100);
        assert_eq!([&*panel.x.label, &*panel.y.label], ["target.<t>.mass [10⁻⁶ kg]", "[10⁻⁶ N s]"]);
        assert!(scatter.caption.starts_with("all 100 cases"), "{}", scatter.caption);
    }

    #[test]
    fn names_are_escaped_and_bytes_are_the_same() {
        const NAME: &str = "a<b>&\"c\"";
        let texts = of_one(NAME).map(|picture| picture.svg());
        assert_eq!(texts, of_one(NAME).map(|picture| picture.svg()));
        for text in &texts {
            assert!(text.contains("a&lt;b&gt;&amp;") && !text.contains("a<b"), "{text}");
        }
    }

    #[test]
    fn without_keys_there_are_histograms_alone() {
        let mut report = report(&["impulse"]);
        report.outputs[0].correlations.clear();
        report.outputs[0].scatter = None;
        assert_eq!(pictures(&report, &report.outputs[0]).len(), 1);
    }
}
