//! The keys of `[limits]`, `[contact]`, `[clearance]` and `[[case]]`.

use super::rules::{LARGEST_ANGLE, TWIST};
use super::target::{KINDS, RESTITUTION};
use crate::format::{Choice, Count, Default, Key, NumberRule, Shape, TableFormat};
use crate::scenario::{Detection, OnOverlap};

const RANGE: Shape = Shape::OneOf(&[
    &[
        NumberRule::any("low", "rad").not_degrees(LARGEST_ANGLE),
        NumberRule::any("high", "rad").not_degrees(LARGEST_ANGLE),
    ],
    &[],
]);
const RATE: Shape = Shape::NumberOrNone(NumberRule::positive("a largest joint rate (or one per joint)", "rad/s"));
const IMPULSE: Shape = Shape::Number(NumberRule::non_negative("an impulse magnitude", "N s"));
/// Of any key, which has a rule of its own.
const SET_VALUE: Shape = Shape::Scalar(NumberRule::any("a number", ""));
const BODY: Shape = Shape::Text("the name of a body");
const PAIR: Shape = Shape::List(&BODY, Count::Exactly(2));

pub(super) static LIMITS: TableFormat = TableFormat {
    doc: "Limits of the joints, monitored at every step of both phases and not enforced.",
    keys: &[
        Key::optional(
            "joint_angles",
            Shape::OneOrList(&RANGE, Count::Joints),
            Default::Words("any angles"),
            "[low, high] of all joints, or one per joint, [] for any angle",
        )
        .example("[-3.1, 3.1]"),
        Key::optional(
            "joint_rates",
            Shape::OneOrList(&RATE, Count::Joints),
            Default::Words("any rates"),
            "the largest joint rate, of all joints, or one per joint, [] for any rate",
        )
        .example("1.0"),
    ],
    one_of: &[],
};

pub(super) static CONTACT: TableFormat = TableFormat {
    doc: "When contacts begin.",
    keys: &[
        Key::optional("detection", Shape::Choice(detections), Default::Choice("time"), "when contacts begin"),
        Key::optional(
            "duration",
            Shape::Number(NumberRule::positive("the duration of a contact", "s")),
            Default::Words("no mean forces"),
            "of an impact; gives mean forces, impulse / duration, in the outputs and changes nothing else",
        )
        .example("0.05"),
    ],
    one_of: &[],
};

pub(super) static CLEARANCE: TableFormat = TableFormat {
    doc: "What follows from bodies that overlap.",
    keys: &[
        Key::optional("on_overlap", Shape::Choice(consequences), Default::Choice("report"), "what an overlap does"),
        Key::optional(
            "ignore",
            Shape::List(&PAIR, Count::Any),
            Default::Words("no pair may overlap"),
            "pairs of bodies that may overlap",
        )
        .example("[[\"base\", \"arms/arm1/link2\"]]"),
    ],
    one_of: &[],
};

pub(super) static CASE: TableFormat = TableFormat {
    doc: "A variant of the capture. Its tables have the names of targets as keys; they replace the targets' own values.",
    keys: &[
        Key::required("name", Shape::FILE_NAME, "of its files").start("\"case1\""),
        Key::optional(
            "target_twists",
            Shape::ByName(&TWIST, "target"),
            Default::Words("the targets' own"),
            "of the targets' COMs before the impact",
        )
        .start("{ target1 = [0.2, 0.0, 0.0] }"),
        Key::optional(
            "kinds",
            Shape::ByName(&KINDS, "target"),
            Default::Words("the targets' own"),
            "of the targets' contacts",
        )
        .example("{ target1 = \"pin\" }"),
        Key::optional(
            "restitutions",
            Shape::ByName(&RESTITUTION, "target"),
            Default::Words("the targets' own"),
            "of the targets' bounces",
        )
        .example("{ target1 = 0.5 }"),
        Key::optional(
            "printed_impulses",
            Shape::ByName(&IMPULSE, "target"),
            Default::Nothing,
            "the paper's magnitudes, shown beside those of its robot and used for nothing else",
        )
        .example("{ target1 = 0.0873 }"),
        Key::optional(
            "set",
            Shape::ByName(&SET_VALUE, "path"),
            Default::Nothing,
            "other values at keys of the scenario, or after `layout.` of its layout, by their paths as in sweeps; the case \
             then has an approach of its own",
        )
        .example("{ \"layout.base.mass\" = 480.0 }"),
    ],
    one_of: &[],
};

fn detections() -> Vec<Choice> {
    let doc = |detection: Detection| match detection {
        Detection::Time => "at the end of the approach, wherever the end effectors are, as in the paper",
        Detection::Event => "when an end effector reaches the outline of its target, which moves freely from the start",
    };
    Detection::ALL.map(|(name, detection)| Choice { name, doc: doc(detection) }).to_vec()
}

fn consequences() -> Vec<Choice> {
    let doc = |consequence: OnOverlap| match consequence {
        OnOverlap::Report => "it is in the results",
        OnOverlap::Fail => "exit code 1. Overlaps with a default outline are reported alone",
        OnOverlap::Stop => {
            "the case ends where the overlap begins, exit code 1. Overlaps with a default outline are reported alone"
        }
    };
    OnOverlap::ALL.map(|(name, consequence)| Choice { name, doc: doc(consequence) }).to_vec()
}
