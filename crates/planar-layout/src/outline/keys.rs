//! The keys of an `outline`.

use crate::format::{Count, Default, Key, NumberRule, Shape, TableFormat};
use std::f64::consts::TAU;

const RADIUS: NumberRule = NumberRule::positive("a radius", "m").not_millimetres(1e4);
const CAPSULE_RADIUS: NumberRule = NumberRule::non_negative("a radius", "m").not_millimetres(1e4);
const SIDE: NumberRule = NumberRule::positive("a side", "m").not_millimetres(1e4);
const ANGLE: NumberRule = NumberRule::any("an angle", "rad").not_degrees(TAU);
const POINT: Shape =
    Shape::Vector(&[NumberRule::any("x", "m").not_millimetres(1e4), NumberRule::any("y", "m").not_millimetres(1e4)]);

/// The outline of a base or link.
pub static FORMAT: TableFormat = TableFormat {
    doc: "The outline of a base or link, in the frame of the body: one of `disc`, `box`, `capsule` and `polygon`.",
    keys: &[
        Key::optional("disc", Shape::Number(RADIUS), Default::Nothing, "the radius of a disc"),
        Key::optional("box", Shape::Vector(&[SIDE, SIDE]), Default::Nothing, "the two sides of a rectangle"),
        Key::optional(
            "capsule",
            Shape::Number(CAPSULE_RADIUS),
            Default::Nothing,
            "the radius about a segment, 0 for the segment itself",
        ),
        Key::optional(
            "polygon",
            Shape::List(&POINT, Count::Any),
            Default::Nothing,
            "corners in their order around it, in either direction",
        ),
        Key::optional(
            "center",
            POINT,
            Default::Words("the base's centre of mass, the middle of the link"),
            "the centre of disc or box",
        )
        .beside(&["disc", "box"]),
        Key::optional("angle", Shape::Number(ANGLE), Default::Number(0.0), "by which the box is turned")
            .beside(&["box"]),
        Key::optional(
            "ends",
            Shape::List(&POINT, Count::Exactly(2)),
            Default::Words("the joint and the end of the link; of a base it must be given"),
            "the ends of the capsule's segment",
        )
        .beside(&["capsule"]),
    ],
    one_of: &["disc", "box", "capsule", "polygon"],
};
