//! `[approach]` with `tracking = "resolved_motion_rate"`: end effectors that follow paths of their own.

use super::approach::{end_effector_goals, end_effector_twists, trajectory_duration};
use super::duration_and_step;
use super::integration;
use super::joints::Joints;
use crate::diagnostic::{NumberRule, Table, Value};
use crate::scenario::{Approach, EndEffectorGoal, EndEffectorTwistGoal, FinalRates, Tracking};
use crate::simulate::actuators::Actuation;
use crate::trajectory::TrajectoryKind;

/// What only this tracking has.
pub(super) const KEYS: [&str; 3] = ["pose_gain", "rate_gain", "singularity_threshold"];

const POSE_GAIN: NumberRule = NumberRule::positive("a gain of the tips' poses", "1/s");
const RATE_GAIN: NumberRule = NumberRule::positive("a gain of the joint rates", "1/s");
const THRESHOLD: NumberRule = NumberRule::positive("a part of the largest singular value", "1");

/// Notes the keys of this tracking in an approach with another.
pub(super) fn reject_gains(table: &Table<'_>) {
    for value in KEYS.iter().filter_map(|key| table.get(key)) {
        value.reject("only `tracking = \"resolved_motion_rate\"` has it");
    }
}

/// Reads the table; `initial` are the initial joint angles.
pub(super) fn approach(table: &Table<'_>, joints: &Joints<'_>, initial: Option<&[f64]>) -> Option<Approach> {
    let times = duration_and_step(table);
    reject_joint_space(table);
    if let Some(value) = table.get("trajectory").filter(|value| value.as_str() != Some("quintic")) {
        value.reject("the tips go along quintic paths, expected `quintic` or no such key");
    }
    let goals = table
        .require(
            "final_end_effector_poses",
            "one [yaw, x, y] or [x, y] per arm, or [] for an arm that keeps its angles",
        )
        .and_then(|value| end_effector_goals(&value, joints));
    let twists = match table.get("final_end_effector_twists") {
        Some(value) => end_effector_twists(&value, joints).and_then(|twists| wanted(&value, twists, goals.as_deref())),
        None => Some(vec![[Some(0.0); 3]; joints.layout.map_or(0, |layout| layout.arms.len())]),
    };
    let rest = twists.as_ref().is_none_or(|twists| twists.as_flattened().iter().flatten().all(|part| *part == 0.0));
    let trajectory_duration = trajectory_duration(table, times, rest, "`final_end_effector_twists` of zeros");
    let pose_gain = table.number_or("pose_gain", &POSE_GAIN, 2.0);
    let rate_gain = table.number_or("rate_gain", &RATE_GAIN, 10.0);
    let threshold = match table.get("singularity_threshold") {
        Some(value) => value.number(&THRESHOLD).filter(|threshold| {
            let part = *threshold < 1.0;
            if !part {
                value.reject("expected a part of the largest singular value, less than 1");
            }
            part
        }),
        None => Some(0.04),
    };
    let actuation = Actuation::from_table(table, times, joints);
    let integration = integration::integration(table);
    let (duration, step) = times?;
    Some(Approach {
        duration,
        step,
        trajectory_duration: trajectory_duration?,
        trajectory: TrajectoryKind::Quintic,
        final_joint_angles: initial.map_or_else(|| joints.repeat(0.0), <[f64]>::to_vec),
        final_end_effector_poses: Some(goals?),
        end: FinalRates::EndEffectorTwists(twists?),
        tracking: Tracking::ResolvedMotionRate {
            pose_gain: pose_gain?,
            rate_gain: rate_gain?,
            singularity_threshold: threshold?,
        },
        actuation: actuation?,
        integration: integration?,
    })
}

/// Notes what is about joint trajectories.
fn reject_joint_space(table: &Table<'_>) {
    let gains = "resolved motion rate control has `pose_gain` and `rate_gain` instead";
    let angles = "the joints go where their tips take them, expected no such key";
    let twists = "the tips have twists, expected `final_end_effector_twists`";
    let keys = [
        ("proportional_gain", gains),
        ("derivative_gain", gains),
        ("final_joint_angles", angles),
        ("final_joint_rates", twists),
    ];
    for (key, why) in keys {
        if let Some(value) = table.get(key) {
            value.reject(why);
        }
    }
}

/// The twists, where nothing is asked of an end effector that may end anywhere, and no rate of a yaw that is free.
fn wanted(
    value: &Value<'_>,
    twists: Vec<EndEffectorTwistGoal>,
    goals: Option<&[EndEffectorGoal]>,
) -> Option<Vec<EndEffectorTwistGoal>> {
    let items = value.items("twists")?;
    let mut good = true;
    for ((twist, goal), item) in twists.iter().zip(goals?).zip(items) {
        let why = match (goal, twist) {
            (EndEffectorGoal::Any, [omega, x, y]) if [omega, x, y].into_iter().flatten().any(|part| *part != 0.0) => {
                "nothing is wanted of this tip, expected []"
            }
            (EndEffectorGoal::Position(_), [Some(omega), ..]) if *omega != 0.0 => {
                "the yaw of this tip is free, expected [vx, vy], or a pose [yaw, x, y] in `final_end_effector_poses`"
            }
            _ => continue,
        };
        item.reject(why);
        good = false;
    }
    good.then_some(twists)
}
