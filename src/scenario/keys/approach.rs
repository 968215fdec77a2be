//! The keys of `[approach]`.

use super::phase::{COORDINATES, DURATION, INTEGRATOR, SAMPLE_TIME, STEP, TIME, TOLERANCE, TORQUE_LIMITS, law};
use super::rules::{GOAL, JOINT_ANGLE, JOINT_RATE, TWIST_GOAL};
use crate::format::{Choice, Count, Default, Key, NumberRule, Shape, TableFormat};
use crate::scenario::Tracking;
use crate::trajectory::TrajectoryKind;

const STIFFNESS: Shape = Shape::Number(NumberRule::non_negative("a proportional gain (or one per joint)", "N m/rad"));
const DAMPING: Shape = Shape::Number(NumberRule::non_negative("a derivative gain (or one per joint)", "N m s/rad"));
const ANGLE_ERROR_GAIN: Shape =
    Shape::Number(NumberRule::non_negative("a proportional gain of computed torque (or one per joint)", "1/s²"));
const RATE_ERROR_GAIN: Shape =
    Shape::Number(NumberRule::non_negative("a derivative gain of computed torque (or one per joint)", "1/s"));

const IN_JOINT_SPACE: &[&str] = &["pd", "exact", "computed_torque"];
const WITH_LIMITS: &[&str] = &["pd", "computed_torque", "resolved_motion_rate"];
const BY_END_EFFECTORS: &[&str] = &["resolved_motion_rate"];

pub(super) static APPROACH: TableFormat = TableFormat {
    doc: "The motion of the arms before the contact: a trajectory and its tracking.",
    keys: &[
        DURATION.start("20.0"),
        STEP,
        Key::optional(
            "trajectory_duration",
            TIME,
            Default::Words("the duration"),
            "of the trajectory alone: afterwards its end is held, at rest, for which final rates are zeros or not given",
        )
        .example("15.0"),
        Key::optional(
            "trajectory",
            Shape::Choice(trajectories),
            Default::Words("required; `\"quintic\"` with `\"resolved_motion_rate\"`"),
            "the joint trajectories",
        )
        .start("\"quintic\""),
        Key::optional(
            "final_joint_angles",
            Shape::List(&JOINT_ANGLE, Count::Joints),
            Default::Words("required without `final_end_effector_poses`"),
            "the final configuration; beside `final_end_effector_poses` the first guess (by default the initial angles), \
             which selects the elbow",
        )
        .with("tracking", IN_JOINT_SPACE)
        .start("[-0.524, -1.393, -0.035, 2.618, -1.393, -0.035]"),
        Key::optional(
            "final_end_effector_poses",
            Shape::List(&GOAL, Count::Arms),
            Default::Words("required with `\"resolved_motion_rate\"`"),
            "[yaw, x, y] or [x, y] per arm, or [] for a free end",
        )
        .example("[[2.0, -1.5], [-2.0, 1.5]]"),
        Key::optional(
            "final_joint_rates",
            Shape::List(&JOINT_RATE, Count::Joints),
            Default::Words("the final velocities are those of the end effectors"),
            "the final velocities, arm by arm; with `trajectory = \"quartic\"` or `\"quintic\"` these or \
             `final_end_effector_twists` must be given, zeros to end at rest",
        )
        .with("tracking", IN_JOINT_SPACE)
        .example("[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]"),
        Key::optional(
            "final_end_effector_twists",
            Shape::List(&TWIST_GOAL, Count::Arms),
            Default::Words("zeros with `\"resolved_motion_rate\"`"),
            "the final velocities: per arm [ω, vx, vy], [vx, vy] (any ω; two links alone cannot prescribe more) or [], converted \
             by the generalized Jacobian at the final pose of the exactly tracked approach",
        )
        .start("[[0.0, -0.1, 0.0], [0.0, 0.1, 0.0]]"),
        Key::optional("tracking", Shape::Choice(laws), Default::Choice("pd"), "the control law")
            .start("\"computed_torque\""),
        Key::optional(
            "proportional_gain",
            Shape::OneOrList(&STIFFNESS, Count::Joints),
            Default::Number(49.0),
            "K_p, of the angles' errors",
        )
        .with("tracking", &["pd"]),
        Key::optional(
            "proportional_gain",
            Shape::OneOrList(&ANGLE_ERROR_GAIN, Count::Joints),
            Default::Number(49.0),
            "K_p, of the angles' errors",
        )
        .with("tracking", &["computed_torque"]),
        Key::optional(
            "derivative_gain",
            Shape::OneOrList(&DAMPING, Count::Joints),
            Default::Number(14.0),
            "K_v, of the rates' errors",
        )
        .with("tracking", &["pd"]),
        Key::optional(
            "derivative_gain",
            Shape::OneOrList(&RATE_ERROR_GAIN, Count::Joints),
            Default::Number(14.0),
            "K_v, of the rates' errors",
        )
        .with("tracking", &["computed_torque"]),
        Key::optional(
            "pose_gain",
            Shape::Number(NumberRule::positive("a gain of the end effectors' poses", "1/s")),
            Default::Number(2.0),
            "K: errors of the poses decay with exp(−K t)",
        )
        .with("tracking", BY_END_EFFECTORS),
        Key::optional(
            "rate_gain",
            Shape::Number(NumberRule::positive("a gain of the joint rates", "1/s")),
            Default::Number(10.0),
            "k: errors of the joint rates decay with exp(−k t)",
        )
        .with("tracking", BY_END_EFFECTORS),
        Key::optional(
            "singularity_threshold",
            Shape::Number(NumberRule::positive("a part of the largest singular value", "parts of 1").less_than(1.0)),
            Default::Number(0.04),
            "singular values below this part of the largest, with translations in units of the reach, are damped",
        )
        .with("tracking", BY_END_EFFECTORS),
        law("the numbers of a law that the program has of its own, which `tracking` names", "{ gain = 49.0 }"),
        TORQUE_LIMITS.with("tracking", WITH_LIMITS),
        SAMPLE_TIME.with("tracking", WITH_LIMITS),
        INTEGRATOR,
        TOLERANCE.with("integrator", &["adaptive"]),
        COORDINATES,
    ],
    one_of: &[],
};

fn trajectories() -> Vec<Choice> {
    let doc = |kind: TrajectoryKind| match kind {
        TrajectoryKind::Quartic => "eq. (6), from rest",
        TrajectoryKind::QuarticAsPrinted => "the same with eq. (7) as printed, which does not reach the final rates",
        TrajectoryKind::Cycloidal => "from rest to rest; takes no final velocities",
        TrajectoryKind::Quintic => "starts with `initial.joint_rates`",
    };
    TrajectoryKind::ALL.iter().map(|kind| Choice { name: kind.properties().name, doc: doc(*kind) }).collect()
}

fn laws() -> Vec<Choice> {
    let doc = |law: &Tracking| match law {
        Tracking::ProportionalDerivative { .. } => "eq. (18), `K_p e + K_v ė`",
        Tracking::InverseDynamics => "`I θ̈_d + c`, from the initial state of the trajectory",
        Tracking::ComputedTorque { .. } => {
            "`I (θ̈_d + K_v ė + K_p e) + c` at the measured state, including its momentum"
        }
        Tracking::ResolvedMotionRate { .. } => {
            "`I (θ̈_d + k (θ̇_d − θ̇)) + c` with `θ̇_d = J⁺ (t_d + K e − b)`: the end effectors follow straight paths"
        }
        Tracking::Own { .. } => "of the program's own",
    };
    Tracking::LAWS.iter().map(|law| Choice { name: law.name(), doc: doc(law) }).collect()
}
