//! The keys of `[[target]]`.

use super::rules::{LARGEST_ANGLE, POSITION, TWIST};
use crate::contact::ContactKind;
use crate::format::{Choice, Count, Default, Key, NumberRule, Shape, TableFormat};
use crate::scenario::contact_name;

const ARM: Shape = Shape::Text("the name of an arm of the layout");
const POINT: Shape = Shape::Vector(&[NumberRule::any("rx", "m"), NumberRule::any("ry", "m")]);
const KIND: Shape = Shape::Choice(kinds);

pub(super) const KINDS: Shape = Shape::OneOrList(&KIND, Count::Contacts);
pub(super) const RESTITUTION: Shape =
    Shape::Number(NumberRule::any("a restitution, 0 (no rebound) to 1 (no loss)", "").within(0.0, 1.0));

pub(super) static TARGET: TableFormat = TableFormat {
    doc: "A free rigid body that arms touch.",
    keys: &[
        Key::required("name", Shape::Text("a name"), "unique in the scenario").start("\"target1\""),
        Key::required(
            "arm",
            Shape::OneOrList(&ARM, Count::Any),
            "the arm that touches it, or a list of arms; no arm touches two targets",
        )
        .start("\"arm1\""),
        Key::required(
            "mass",
            Shape::Number(NumberRule::positive("a mass", "kg")),
            "1e-15 to 1e12 times that of the robot",
        )
        .start("10.0"),
        Key::required(
            "inertia",
            Shape::Number(NumberRule::positive("a moment of inertia", "kg m²")),
            "about its COM; 1e-15 to 1e12 times the robot's mass · reach²",
        )
        .start("1.0"),
        Key::optional(
            "contact",
            Shape::OneOrList(&POINT, Count::Contacts),
            Default::Words("required, except with `contact.detection = \"event\"`, which finds it"),
            "from its COM to the contact point, inertial axes at the impact; one for each of several arms",
        )
        .start("[0.0, 0.5]"),
        Key::optional(
            "radius",
            Shape::Number(NumberRule::positive("a radius", "m")),
            Default::Words("none where `polygon` is given"),
            "its outline: a disc; at most 1e6 times the robot's reach",
        )
        .start("0.5"),
        Key::optional(
            "polygon",
            Shape::List(&POSITION, Count::Any),
            Default::Words("none where `radius` is given"),
            "its outline: corners in its own frame that contain the COM, the origin; at most 1e6 times the robot's reach",
        )
        .example("[[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]"),
        Key::optional("kind", KINDS, Default::Choice("rigid"), "of its contacts; one, or one per arm"),
        Key::optional(
            "restitution",
            RESTITUTION,
            Default::Number(0.0),
            "of bounces; an error without a bounce",
        ),
        Key::optional("twist", TWIST, Default::Zeros, "of its COM before the impact"),
        Key::optional(
            "yaw",
            Shape::Number(NumberRule::any("a yaw", "rad").not_degrees(LARGEST_ANGLE)),
            Default::Number(0.0),
            "of its frame: at the impact, or with `contact.detection = \"event\"` at the start",
        ),
        Key::optional(
            "position",
            POSITION,
            Default::Words("required where `contact.detection` is `\"event\"`"),
            "of its COM: expected at the impact, for the reported miss; with `contact.detection = \"event\"` at the start",
        )
        .example("[2.0, -2.0]"),
    ],
    one_of: &["radius", "polygon"],
};

fn kinds() -> Vec<Choice> {
    let doc = |kind: Option<ContactKind>| match kind {
        Some(ContactKind::Rigid) => {
            "end effector and target have one twist after the impact: the contact transmits force and moment and holds"
        }
        Some(ContactKind::Pin) => {
            "the contact points have one velocity after the impact: force without moment; the target turns freely about \
             the point"
        }
        Some(ContactKind::Bounce) => {
            "an impulse along the outline's normal without friction, with the coefficient of restitution. A contact that \
             holds has none: it could create energy"
        }
        None => "no contact: a grasp that fails",
    };
    let kinds = ContactKind::ALL.into_iter().map(Some).chain([None]);
    kinds.map(|kind| Choice { name: contact_name(kind), doc: doc(kind) }).collect()
}
