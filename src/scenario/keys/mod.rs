//! The keys of a scenario file, one table of them for each of its tables.

mod approach;
mod capture;
mod phase;
mod post_impact;
mod rules;
mod target;

use crate::format::{Count, Default, Key, Shape, TableFormat};
#[cfg(feature = "cli")]
pub(crate) use rules::LARGEST_ANGLE;
use rules::{JOINT_ANGLE, JOINT_RATE, POSE, TWIST};

/// A scenario file.
pub static FORMAT: TableFormat = TableFormat {
    doc: "A robot, its initial state, the approach of its arms, its targets, and the motion after the impact. SI units, \
          radians, inertial axes; twists are [ω, vx, vy], poses [yaw, x, y].",
    keys: &[
        Key::required("name", Shape::FILE_NAME, "the name of the results' folder").start("\"my_study\""),
        Key::required(
            "layout",
            Shape::Text("a shipped layout's name or the path of a layout file"),
            "the robot: the name of a shipped layout, or a path relative to the scenario, which ends in `.toml` or contains \
             a `/`",
        )
        .start("\"dual_arm_3r\""),
        Key::required("initial", Shape::Table(&INITIAL), "the state at the start"),
        Key::optional(
            "limits",
            Shape::Table(&capture::LIMITS),
            Default::Nothing,
            "limits of joint angles and rates, which are monitored and not enforced",
        ),
        Key::required("approach", Shape::Table(&approach::APPROACH), "the motion of the arms before the contact"),
        Key::optional(
            "target",
            Shape::Tables(&target::TARGET),
            Default::Words("the study ends with the approach"),
            "the bodies that arms touch",
        ),
        Key::optional("contact", Shape::Table(&capture::CONTACT), Default::Nothing, "when contacts begin"),
        Key::optional(
            "clearance",
            Shape::Table(&capture::CLEARANCE),
            Default::Nothing,
            "what follows from bodies that overlap",
        ),
        Key::optional(
            "case",
            Shape::Tables(&capture::CASE),
            Default::Words("one, with the name of the scenario"),
            "variants of the capture",
        ),
        Key::optional(
            "post_impact",
            Shape::Table(&post_impact::POST_IMPACT),
            Default::Words("required with a target"),
            "the motion after the impact",
        ),
    ],
    one_of: &[],
};

static INITIAL: TableFormat = TableFormat {
    doc: "The state of the robot at the start.",
    keys: &[
        Key::required("joint_angles", Shape::List(&JOINT_ANGLE, Count::Joints), "arm by arm")
            .start("[0.698, -1.571, 1.047, 2.444, 1.571, -1.047]"),
        Key::optional("base_pose", POSE, Default::Zeros, "of the base, yaw and COM"),
        Key::optional("base_twist", TWIST, Default::Zeros, "of the base's COM"),
        Key::optional("joint_rates", Shape::List(&JOINT_RATE, Count::Joints), Default::Zeros, "arm by arm")
            .example("[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]"),
    ],
    one_of: &[],
};
