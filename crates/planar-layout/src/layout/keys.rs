//! The keys of a layout file.

use crate::format::{Default, Key, NumberRule, Shape, TableFormat};
use crate::outline;
use std::f64::consts::TAU;

const MODULE_NAME: Shape = Shape::Text("a name for a Rust module (lower-case letters, digits and `_`, a letter first)");
const MASS: Shape = Shape::Number(NumberRule::positive("a mass", "kg"));
const INERTIA: Shape = Shape::Number(NumberRule::positive("a moment of inertia", "kg m²"));
const LENGTH: Shape = Shape::Number(NumberRule::non_negative("a length", "m").not_millimetres(1e4));
const ANGLE: Shape = Shape::Number(NumberRule::any("an angle", "rad").not_degrees(TAU));
const POSITION: Shape =
    Shape::Vector(&[NumberRule::any("x", "m").not_millimetres(1e4), NumberRule::any("y", "m").not_millimetres(1e4)]);

/// A layout file.
pub static FORMAT: TableFormat = TableFormat {
    doc: "A free-floating robot: a base and the arms mounted on it. All joints are revolute. SI units, radians.",
    keys: &[
        Key::required("name", MODULE_NAME, "the name of the robot, and of the module with its code")
            .start("\"my_robot\""),
        Key::required("base", Shape::Table(&BASE), "the base"),
        Key::required("arm", Shape::Tables(&ARM), "the arms, at least one; their order is that of the joints"),
    ],
    one_of: &[],
};

static BASE: TableFormat = TableFormat {
    doc: "The free-floating base; its frame has its origin at the centre of mass.",
    keys: &[
        Key::required("mass", MASS, "of the base").start("500.0"),
        Key::required("inertia", INERTIA, "about the centre of mass").start("83.61"),
        Key::optional(
            "outline",
            Shape::Table(&outline::FORMAT),
            Default::Words("a rectangle of its mass and inertia that contains the mounts"),
            "its outline in its own frame, for clearances and pictures alone",
        )
        .example("{ box = [1.0, 1.0] }"),
    ],
    one_of: &[],
};

static ARM: TableFormat = TableFormat {
    doc: "A chain of links; joint k moves link k.",
    keys: &[
        Key::required("name", Shape::Text("a name"), "the name that scenarios use; unique in the layout")
            .start("\"arm1\""),
        Key::required("mount", POSITION, "where the first joint is, in the base's frame").start("[0.5, 0.0]"),
        Key::optional(
            "mount_angle",
            ANGLE,
            Default::Number(0.0),
            "direction of the first link at joint angle 0, from the base's x axis",
        ),
        Key::required("link", Shape::Tables(&LINK), "the links, at least one, from the base outwards").entries(2),
    ],
    one_of: &[],
};

static LINK: TableFormat = TableFormat {
    doc: "A rigid link; its frame has its origin at its joint, and x towards the next joint or the end effector.",
    keys: &[
        Key::required("length", LENGTH, "to the next joint, or to the end effector; 0 for a reaction wheel")
            .start("1.0"),
        Key::required("mass", MASS, "of the link").start("10.0"),
        Key::required("inertia", INERTIA, "about the centre of mass").start("1.05"),
        Key::optional(
            "com",
            POSITION,
            Default::Words("the middle of the link"),
            "the centre of mass in the link's frame; a y of 0 costs no operations",
        )
        .example("[0.5, 0.0]"),
        Key::optional(
            "outline",
            Shape::Table(&outline::FORMAT),
            Default::Words("the segment from its joint to its end"),
            "its outline in its own frame, for clearances and pictures alone",
        )
        .example("{ capsule = 0.05 }"),
    ],
    one_of: &[],
};
