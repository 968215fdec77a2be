//! The keys of a sweep file, one table of them for each of its tables.

use super::outputs::OutputGroup;
use super::sampling::Sampling;
use crate::format::{Choice, Count, Default, Key, NumberRule, Shape, TableFormat};

/// Of any sweep.
pub(super) const MOST_CASES: u32 = 1_000_000_000;
/// s, between the rows of time series.
pub(super) const DEFAULT_SAMPLE: f64 = 0.05;
/// What a number of 64 bits counts without a gap.
const LARGEST_SEED: f64 = 9_007_199_254_740_992.0;

/// Of a varied value, which has a unit of its own.
const VALUE: NumberRule = NumberRule::any("a number", "");
const POSITIVE: NumberRule = NumberRule::positive("a mean", "");
const SPREAD: NumberRule = NumberRule::positive("a standard deviation", "");
const VARIED: Shape = Shape::Text("the path of a key that varies");

const CASE: Shape = Shape::Number(NumberRule::whole("the index of a case", 0.0, (MOST_CASES - 1) as f64));
const OUTPUTS: Shape = Shape::Choice(output_groups);
const ONE_VALUE: Shape = Shape::Scalar(VALUE);

/// A sweep file.
pub static FORMAT: TableFormat = TableFormat {
    doc: "One case of a scenario, many times, with values drawn from distributions.",
    keys: &[
        Key::required("name", Shape::FILE_NAME, "the name of the results' folder").start("\"my_sweep\""),
        Key::required("scenario", Shape::Text("the path of a scenario file"), "relative to the sweep")
            .start("\"scenario.toml\""),
        Key::optional(
            "case",
            Shape::Text("the name of a case of the scenario"),
            Default::Words("the scenario's only one"),
            "the case that is computed",
        )
        .example("\"case1\""),
        Key::optional(
            "cases",
            Shape::Number(NumberRule::whole("a number of cases", 1.0, MOST_CASES as f64)),
            Default::Words("required; of a grid the number of its combinations"),
            "how many times it is computed",
        )
        .start("1000"),
        Key::required(
            "seed",
            Shape::Number(NumberRule::whole("a seed", 0.0, LARGEST_SEED)),
            "from which all values are drawn",
        )
        .start("1"),
        Key::optional("sampling", Shape::Choice(samplings), Default::Choice("random"), "how the cases are spread"),
        Key::optional(
            "block",
            Shape::Number(NumberRule::whole("a number of cases", 1.0, MOST_CASES as f64)),
            Default::Number(1000.0),
            "the number of cases in a file",
        ),
        Key::required("vary", Shape::Tables(&VARY), "what varies"),
        Key::optional(
            "correlation",
            Shape::Tables(&CORRELATION),
            Default::Words("keys are independent"),
            "for `\"random\"` and `\"latin_hypercube\"`",
        ),
        Key::optional("collect", Shape::Table(&COLLECT), Default::Nothing, "what is kept beside the default outputs"),
    ],
    one_of: &[],
};

static VARY: TableFormat = TableFormat {
    doc: "A value that varies.",
    keys: &[
        Key::required(
            "key",
            Shape::Text("the path of a key of the scenario, or after `layout.` of its layout"),
            "its path, as in `target.target1.mass`, `approach.proportional_gain[2]`, `layout.arm.arm1.link[0].mass`",
        )
        .start("\"target.target1.mass\""),
        Key::required("distribution", Shape::Table(&DISTRIBUTION), "of its values, in the unit of the key")
            .start("{ normal = { mean = 10.0, std = 1.0 }, min = 5.0 }"),
    ],
    one_of: &[],
};

const CONTINUOUS: &[&str] = &["normal", "uniform", "lognormal", "triangular"];

pub(super) static DISTRIBUTION: TableFormat = TableFormat {
    doc: "How a value varies, in the unit of its key.",
    keys: &[
        Key::optional("normal", Shape::Table(&NORMAL), Default::Nothing, "normal"),
        Key::optional("uniform", Shape::Table(&UNIFORM), Default::Nothing, "uniform"),
        Key::optional("lognormal", Shape::Table(&LOGNORMAL), Default::Nothing, "of a normal logarithm"),
        Key::optional("triangular", Shape::Table(&TRIANGULAR), Default::Nothing, "triangular"),
        Key::optional(
            "choice",
            Shape::List(&ONE_VALUE, Count::AtLeastOne),
            Default::Nothing,
            "equally likely values, of one kind",
        ),
        Key::optional("min", Shape::Number(VALUE), Default::Words("no bound"), "truncates").beside(CONTINUOUS),
        Key::optional("max", Shape::Number(VALUE), Default::Words("no bound"), "truncates").beside(CONTINUOUS),
    ],
    one_of: &["normal", "uniform", "lognormal", "triangular", "choice"],
};

static NORMAL: TableFormat = TableFormat {
    doc: "A normal distribution.",
    keys: &[
        Key::required("mean", Shape::Number(VALUE), "mean"),
        Key::required("std", Shape::Number(SPREAD), "standard deviation"),
    ],
    one_of: &[],
};

static LOGNORMAL: TableFormat = TableFormat {
    doc: "A distribution of positive values with a normal logarithm.",
    keys: &[
        Key::required("mean", Shape::Number(POSITIVE), "mean of the variable itself"),
        Key::required("std", Shape::Number(SPREAD), "standard deviation of the variable itself"),
    ],
    one_of: &[],
};

static UNIFORM: TableFormat = TableFormat {
    doc: "A uniform distribution.",
    keys: &[
        Key::required("min", Shape::Number(VALUE), "smallest value"),
        Key::required("max", Shape::Number(VALUE), "largest value, greater than that"),
    ],
    one_of: &[],
};

static TRIANGULAR: TableFormat = TableFormat {
    doc: "A density that rises from `min` to `mode` and falls to `max`, linearly.",
    keys: &[
        Key::required("min", Shape::Number(VALUE), "smallest value"),
        Key::required("mode", Shape::Number(VALUE), "most likely value, from `min` to `max`"),
        Key::required("max", Shape::Number(VALUE), "largest value, greater than the smallest"),
    ],
    one_of: &[],
};

static CORRELATION: TableFormat = TableFormat {
    doc: "A rank correlation of two keys that vary.",
    keys: &[
        Key::required("keys", Shape::List(&VARIED, Count::Exactly(2)), "two different paths, as they vary")
            .example("[\"target.target1.mass\", \"target.target1.inertia\"]"),
        Key::required(
            "rank",
            Shape::Number(NumberRule::any("a rank correlation between -1 and 1", "").within(-1.0, 1.0)),
            "between −1 and 1, neither of them",
        )
        .example("0.6"),
    ],
    one_of: &[],
};

static COLLECT: TableFormat = TableFormat {
    doc: "What a sweep keeps beside the default outputs.",
    keys: &[
        Key::optional("outputs", Shape::List(&OUTPUTS, Count::Any), Default::Nothing, "further columns")
            .example("[\"approach_end\"]"),
        Key::optional("series", Shape::List(&CASE, Count::Any), Default::Nothing, "cases whose time series are kept")
            .example("[0]"),
        Key::optional(
            "sample",
            Shape::Number(NumberRule::positive("a time between rows", "s")),
            Default::Number(DEFAULT_SAMPLE),
            "of time series",
        ),
    ],
    one_of: &[],
};

fn samplings() -> Vec<Choice> {
    let doc = |sampling: Sampling| match sampling {
        Sampling::Random => "independently",
        Sampling::LatinHypercube => "each of as many intervals of equal probability as there are cases has one case",
        Sampling::Sobol => "by Sobol's sequence; best with a power of two as `cases`",
        Sampling::Grid => "all combinations of choices, those of the last key fastest",
    };
    Sampling::ALL.map(|(name, sampling)| Choice { name, doc: doc(sampling) }).to_vec()
}

fn output_groups() -> Vec<Choice> {
    let doc = |group: OutputGroup| match group {
        OutputGroup::MeanForces => "impulses over `contact.duration`",
        OutputGroup::ApproachEnd => "the state at the end of the approach",
        OutputGroup::PostImpactEnd => "the state at the end of the post-impact motion",
        OutputGroup::TerminalRates => "the designed joint rates at the end of the approach",
        OutputGroup::PathErrors => "estimated errors of the paths, and drifts of the centre of mass",
        OutputGroup::Paper => "impulses by the paper's reduced equations",
    };
    OutputGroup::ALL.map(|(name, group)| Choice { name, doc: doc(group) }).to_vec()
}
