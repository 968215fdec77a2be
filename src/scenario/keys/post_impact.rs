//! The keys of `[post_impact]`.

use super::phase::{COORDINATES, DURATION, INTEGRATOR, SAMPLE_TIME, STEP, TOLERANCE, TORQUE_LIMITS, law};
use crate::format::{Choice, Count, Default, Key, NumberRule, Shape, TableFormat};
use crate::scenario::PostCaptureControl;

const STIFFNESS: Shape = Shape::Number(NumberRule::non_negative("a proportional gain (or one per joint)", "N m/rad"));
const DAMPING: Shape = Shape::Number(NumberRule::non_negative("a derivative gain (or one per joint)", "N m s/rad"));
const DECAY: Shape =
    Shape::Number(NumberRule::non_negative("a derivative gain of stabilisation (or one per joint)", "1/s"));

const LAWS: &[&str] = &["hold", "damping", "stabilise"];

pub(super) static POST_IMPACT: TableFormat = TableFormat {
    doc: "The motion of robot and targets after the impact.",
    keys: &[
        DURATION.start("50.0"),
        STEP,
        Key::optional("control", Shape::Choice(laws), Default::Choice("none"), "the control law"),
        Key::optional(
            "proportional_gain",
            Shape::OneOrList(&STIFFNESS, Count::Joints),
            Default::Number(49.0),
            "K_p, of the angles' errors",
        )
        .with("control", &["hold"]),
        Key::optional(
            "derivative_gain",
            Shape::OneOrList(&DAMPING, Count::Joints),
            Default::Number(14.0),
            "K_v, of the joint rates",
        )
        .with("control", &["hold"]),
        Key::optional(
            "derivative_gain",
            Shape::OneOrList(&DAMPING, Count::Joints),
            Default::Number(7.0),
            "K_v, of the joint rates",
        )
        .with("control", &["damping"]),
        Key::optional(
            "derivative_gain",
            Shape::OneOrList(&DECAY, Count::Joints),
            Default::Number(0.5),
            "the joint rates decay as exp(−gain t)",
        )
        .with("control", &["stabilise"]),
        Key::optional(
            "base_gain",
            Shape::Number(NumberRule::non_negative("a gain of the base rate", "1/s")),
            Default::Number(0.5),
            "the base rate decays as exp(−gain t) where an actuator takes the angular momentum",
        )
        .with("control", &["stabilise"]),
        Key::optional(
            "base_torque_limit",
            Shape::Number(NumberRule::non_negative("a limit of the torque on the base", "N m")),
            Default::Words("there are no thrusters"),
            "the largest torque of thrusters on the base",
        )
        .with("control", &["stabilise"])
        .example("5.0"),
        law("the numbers of a law that the program has of its own, which `control` names", "{ gain = 7.0 }"),
        TORQUE_LIMITS.with("control", LAWS),
        SAMPLE_TIME.with("control", LAWS),
        INTEGRATOR,
        TOLERANCE.with("integrator", &["adaptive"]),
        COORDINATES,
    ],
    one_of: &[],
};

fn laws() -> Vec<Choice> {
    let doc = |law: &PostCaptureControl| match law {
        PostCaptureControl::None => "no torques, as in the paper",
        PostCaptureControl::Hold { .. } => "PD control to the angles at the capture",
        PostCaptureControl::Damping { .. } => "`−K_v θ̇`",
        PostCaptureControl::Stabilise { .. } => "the joint rates decay exponentially, the paper's future work",
        PostCaptureControl::Own { .. } => "of the program's own",
    };
    PostCaptureControl::LAWS.iter().map(|law| Choice { name: law.name(), doc: doc(law) }).collect()
}
