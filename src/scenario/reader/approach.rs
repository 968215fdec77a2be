//! The `[approach]` table: in joint space, or by end effectors with `tracking = "resolved_motion_rate"`.

use super::actuation::{actuation, reject_actuation};
use super::integration::integration;
use super::joints::{DERIVATIVE_GAIN, Joints, PROPORTIONAL_GAIN, check_length};
use super::{DURATION, JOINT_ANGLE, JOINT_RATE, POSE, POSITION, TWIST, duration_and_step, read_or, reject_keys};
use crate::diagnostic::{NumberRule, Table, Value, every, listing};
use crate::scenario::{Approach, EndEffectorGoal, EndEffectorTwistGoal, FinalRates, Tracking};
use crate::simulate::actuators::Actuation;
use crate::trajectory::TrajectoryKind;

const ANGLE_ERROR_GAIN: NumberRule =
    NumberRule::non_negative("a proportional gain of computed torque (or one per joint)", "1/s²");
const RATE_ERROR_GAIN: NumberRule =
    NumberRule::non_negative("a derivative gain of computed torque (or one per joint)", "1/s");
const POSE_GAIN: NumberRule = NumberRule::positive("a gain of the end effectors' poses", "1/s");
const RATE_GAIN: NumberRule = NumberRule::positive("a gain of the joint rates", "1/s");
const THRESHOLD: NumberRule = NumberRule::positive("a part of the largest singular value", "1");

/// Keys that only resolved motion rate control has.
const RESOLVED_KEYS: [&str; 3] = ["pose_gain", "rate_gain", "singularity_threshold"];

pub(super) const KEYS: &[&str] = &[
    "duration",
    "step",
    "trajectory_duration",
    "trajectory",
    "final_joint_angles",
    "final_end_effector_poses",
    "final_joint_rates",
    "final_end_effector_twists",
    "tracking",
    "proportional_gain",
    "derivative_gain",
    "pose_gain",
    "rate_gain",
    "singularity_threshold",
    "torque_limits",
    "sample_time",
    "integrator",
    "tolerance",
    "coordinates",
];

/// The trajectory of an approach and its end; `None` where a part is invalid.
#[allow(clippy::option_option, reason = "None where it is invalid, Some(None) where it is not given")]
struct Goal {
    trajectory: Option<TrajectoryKind>,
    final_joint_angles: Option<Vec<f64>>,
    final_end_effector_poses: Option<Option<Vec<EndEffectorGoal>>>,
    end: Option<FinalRates>,
}

/// Reads the table; `initial` are the initial joint angles.
pub(super) fn approach(table: &Table<'_>, joints: &Joints<'_>, initial: Option<&[f64]>) -> Option<Approach> {
    let times = duration_and_step(table);
    let laws = laws(joints);
    let law = read_or(table, "tracking", &laws[0], |value| value.choice(&laws.each_ref().map(|law| (law.name(), law))));
    let by_end_effectors = matches!(law, Some(Tracking::ResolvedMotionRate { .. }));
    // the first guess of the inverse kinematics
    let initial = initial.map_or_else(|| joints.repeat(0.0), <[f64]>::to_vec);
    let goal =
        if by_end_effectors { end_effector_goal(table, joints, initial) } else { joint_goal(table, joints, initial) };
    let trajectory_duration = trajectory_duration(table, times, goal.end.as_ref(), by_end_effectors);
    let tracking = law.and_then(|law| tracking(table, joints, law));
    let actuation = if law == Some(&Tracking::InverseDynamics) {
        let why = "exact tracking gives whatever torque it takes, expected `tracking` `computed_torque` or `pd`";
        reject_actuation(table, why);
        Some(Actuation::default())
    } else {
        actuation(table, times, joints)
    };
    let integration = integration(table);
    let (duration, step) = times?;
    Some(Approach {
        duration,
        step,
        trajectory_duration: trajectory_duration?,
        trajectory: goal.trajectory?,
        final_joint_angles: goal.final_joint_angles?,
        final_end_effector_poses: goal.final_end_effector_poses?,
        end: goal.end?,
        tracking: tracking?,
        actuation: actuation?,
        integration: integration?,
    })
}

fn joint_goal(table: &Table<'_>, joints: &Joints<'_>, initial: Vec<f64>) -> Goal {
    reject_keys(table, &RESOLVED_KEYS, "only `tracking = \"resolved_motion_rate\"` has it");
    let kinds: Vec<_> = TrajectoryKind::ALL.iter().map(|kind| (kind.properties().name, *kind)).collect();
    let names: Vec<_> = kinds.iter().map(|(name, _)| *name).collect();
    let trajectory = table.require("trajectory", &listing(&names, "or")).and_then(|value| value.choice(&kinds));
    let poses = table.get("final_end_effector_poses");
    let final_joint_angles = match table.get("final_joint_angles") {
        None if poses.is_some() => Some(initial),
        _ => table
            .require("final_joint_angles", &joints.one_each())
            .and_then(|value| joints.numbers(&value, &JOINT_ANGLE)),
    };
    Goal {
        trajectory,
        final_joint_angles,
        final_end_effector_poses: poses.map_or(Some(None), |value| end_effector_poses(&value, joints).map(Some)),
        end: final_rates(table, trajectory, joints),
    }
}

fn end_effector_goal(table: &Table<'_>, joints: &Joints<'_>, initial: Vec<f64>) -> Goal {
    let gains = "resolved motion rate control has `pose_gain` and `rate_gain` instead";
    reject_keys(table, &["proportional_gain", "derivative_gain"], gains);
    reject_keys(table, &["final_joint_angles"], "the joints follow the end effectors, expected no such key");
    reject_keys(table, &["final_joint_rates"], "end effectors have twists, expected `final_end_effector_twists`");
    if let Some(value) = table.get("trajectory").filter(|value| value.as_str() != Some("quintic")) {
        value.reject("end effectors follow quintic paths, expected `quintic` or no such key");
    }
    let poses = table
        .require(
            "final_end_effector_poses",
            "one [yaw, x, y] or [x, y] per arm, or [] for an arm that keeps its angles",
        )
        .and_then(|value| end_effector_poses(&value, joints));
    let at_rest = vec![[Some(0.0); 3]; joints.layout.map_or(0, |layout| layout.arms.len())];
    let twists = read_or(table, "final_end_effector_twists", at_rest, |value| {
        let twists = end_effector_twists(value, joints)?;
        agree(value, &twists, poses.as_deref()?).then_some(twists)
    });
    Goal {
        trajectory: Some(TrajectoryKind::Quintic),
        final_joint_angles: Some(initial),
        final_end_effector_poses: poses.map(Some),
        end: twists.map(FinalRates::EndEffectorTwists),
    }
}

/// Rejects a twist of an end effector that may end anywhere, and a yaw rate where the yaw is free.
fn agree(value: &Value<'_>, twists: &[EndEffectorTwistGoal], goals: &[EndEffectorGoal]) -> bool {
    let moving = |parts: &[Option<f64>]| parts.iter().flatten().any(|part| *part != 0.0);
    let rejections =
        value.items("twists").into_iter().flatten().zip(twists.iter().zip(goals)).filter(|(item, (twist, goal))| {
            let why = match goal {
                EndEffectorGoal::Any if moving(&twist[..]) => "this arm has no pose to reach, expected []",
                EndEffectorGoal::Position(_) if moving(&twist[..1]) => {
                    "the yaw of this end effector is free, expected [vx, vy], or a pose [yaw, x, y] in \
                     `final_end_effector_poses`"
                }
                _ => return false,
            };
            item.reject(why);
            true
        });
    rejections.count() == 0
}

fn final_rates(table: &Table<'_>, trajectory: Option<TrajectoryKind>, joints: &Joints<'_>) -> Option<FinalRates> {
    const KEYS: [&str; 2] = ["final_joint_rates", "final_end_effector_twists"];
    let [rates, twists] = KEYS.map(|key| table.get(key));
    let end = match (&rates, &twists) {
        (Some(rates), _) => joints.numbers(rates, &JOINT_RATE).map(FinalRates::JointRates),
        (None, Some(twists)) => end_effector_twists(twists, joints).map(FinalRates::EndEffectorTwists),
        (None, None) => None,
    };
    let trajectory = trajectory?.properties();
    match (rates, twists) {
        (None, None) if trajectory.ends_at_rest => return Some(FinalRates::Rest),
        _ if trajectory.ends_at_rest => {
            let why = format!("the {} trajectory ends at rest, expected no such key", trajectory.name);
            reject_keys(table, &KEYS, &why);
            return None;
        }
        (Some(_), Some(twists)) => {
            twists.reject("`final_joint_rates` is there too, expected only one of them");
            return None;
        }
        (None, None) if !KEYS.iter().any(|key| table.is_misspelt(key)) => table.reject(
            "missing key `approach.final_end_effector_twists`, expected one [ω, vx, vy] per arm \
             (or `approach.final_joint_rates`, one rate per joint)",
            "the trajectory needs rates at its end",
        ),
        _ => {}
    }
    end
}

/// The time of the trajectory, `Some(None)` where it is that of the phase. A shorter one must end with joints at rest.
#[allow(clippy::option_option, reason = "None where it is invalid, Some(None) where it is not given")]
fn trajectory_duration(
    table: &Table<'_>,
    times: Option<(f64, f64)>,
    end: Option<&FinalRates>,
    by_end_effectors: bool,
) -> Option<Option<f64>> {
    let Some(value) = table.get("trajectory_duration") else { return Some(None) };
    let trajectory = value.number(&DURATION)?;
    let (duration, _) = times?;
    // in joint space, joints may turn although no end effector moves
    let (rest, key) = match end {
        _ if by_end_effectors => (end.is_none_or(FinalRates::is_rest), "final_end_effector_twists"),
        Some(FinalRates::EndEffectorTwists(_)) => (false, "final_joint_rates"),
        _ => (end.is_none_or(FinalRates::is_rest), "final_joint_rates"),
    };
    if trajectory > duration {
        value.reject(&format!("longer than the phase, expected at most its duration, {duration} s"));
        return None;
    }
    if trajectory < duration && !rest {
        value.reject(&format!(
            "the arms are to move on at its end and cannot stay there, expected `{key}` of zeros, or no such key"
        ));
        return None;
    }
    Some((trajectory < duration).then_some(trajectory))
}

fn end_effector_poses(value: &Value<'_>, joints: &Joints<'_>) -> Option<Vec<EndEffectorGoal>> {
    const EXPECTED: &str = "one [yaw, x, y] or [x, y] per arm in rad, m, m, or [] for an arm that may end anywhere";
    let arms = joints.layout.map(|layout| &layout.arms);
    let items = value.items(EXPECTED)?;
    check_length(value, items.len(), arms.map(Vec::len), EXPECTED)?;
    let goals = every(items.iter().enumerate().map(|(i, item)| {
        let fewer_links_than = |count: usize| arms.is_some_and(|arms| arms[i].links.len() < count);
        let (goal, refusal) = match item.items("[yaw, x, y], [x, y] or []")?.len() {
            0 => (EndEffectorGoal::Any, None),
            2 => (
                EndEffectorGoal::Position(item.vector(&POSITION)?),
                fewer_links_than(2).then_some("a single link has its end effector on a circle, expected []"),
            ),
            _ => (
                EndEffectorGoal::Pose(item.vector(&POSE)?),
                fewer_links_than(3).then_some("fewer than three links cannot choose the yaw too, expected [x, y]"),
            ),
        };
        if let Some(why) = refusal {
            item.reject(why);
        }
        refusal.is_none().then_some(goal)
    }))?;
    if goals.iter().all(EndEffectorGoal::is_empty) {
        value.reject("no arm has a pose to reach, expected a pose, or `final_joint_angles` alone");
        return None;
    }
    Some(goals)
}

fn end_effector_twists(value: &Value<'_>, joints: &Joints<'_>) -> Option<Vec<EndEffectorTwistGoal>> {
    let arms = joints.layout.map(|layout| &layout.arms);
    let expected = match arms {
        Some(arms) => {
            let names: Vec<_> = arms.iter().map(|arm| arm.name.as_str()).collect();
            let (count, names) = (arms.len(), names.join(", "));
            format!("{count} twists [ω, vx, vy], one per arm ({names}), or [vx, vy] or [] where less is wanted")
        }
        None => "one twist [ω, vx, vy] per arm, or [vx, vy] or [] where less is wanted".to_owned(),
    };
    let items = value.items(&expected)?;
    check_length(value, items.len(), arms.map(Vec::len), &expected)?;
    let [_, vx, vy] = TWIST;
    let twists = every(items.iter().map(|item| match item.items("[ω, vx, vy], [vx, vy] or []")?.len() {
        0 => Some([None; 3]),
        2 => item.vector(&[vx, vy]).map(|[vx, vy]| [None, Some(vx), Some(vy)]),
        _ => item.vector(&TWIST).map(|twist| twist.map(Some)),
    }))?;
    if twists.as_flattened().iter().all(Option::is_none) {
        value.reject("no end effector has a twist to reach, expected a twist, or `final_joint_rates`");
        return None;
    }
    Some(twists)
}

/// The tracking laws with their default gains; the default law first.
fn laws(joints: &Joints<'_>) -> [Tracking; 4] {
    let (proportional_gain, derivative_gain) = (joints.repeat(49.0), joints.repeat(14.0));
    [
        Tracking::ProportionalDerivative {
            proportional_gain: proportional_gain.clone(),
            derivative_gain: derivative_gain.clone(),
        },
        Tracking::InverseDynamics,
        Tracking::ComputedTorque { proportional_gain, derivative_gain },
        Tracking::ResolvedMotionRate { pose_gain: 2.0, rate_gain: 10.0, singularity_threshold: 0.04 },
    ]
}

/// A law with the gains of the table in place of its defaults.
fn tracking(table: &Table<'_>, joints: &Joints<'_>, law: &Tracking) -> Option<Tracking> {
    let mut law = law.clone();
    let rules = match law {
        Tracking::ComputedTorque { .. } => [&ANGLE_ERROR_GAIN, &RATE_ERROR_GAIN],
        _ => [&PROPORTIONAL_GAIN, &DERIVATIVE_GAIN],
    };
    match &mut law {
        Tracking::InverseDynamics => {
            let why = "exact tracking has no gains, expected `tracking = \"pd\"` with them";
            reject_keys(table, &["proportional_gain", "derivative_gain"], why);
        }
        Tracking::ProportionalDerivative { proportional_gain, derivative_gain }
        | Tracking::ComputedTorque { proportional_gain, derivative_gain } => {
            every([
                joints.read_gain(table, "proportional_gain", rules[0], proportional_gain),
                joints.read_gain(table, "derivative_gain", rules[1], derivative_gain),
            ])?;
        }
        Tracking::ResolvedMotionRate { pose_gain, rate_gain, singularity_threshold } => {
            let pose = table.number_or("pose_gain", &POSE_GAIN, *pose_gain);
            let rate = table.number_or("rate_gain", &RATE_GAIN, *rate_gain);
            let part = read_or(table, "singularity_threshold", *singularity_threshold, threshold);
            (*pose_gain, *rate_gain, *singularity_threshold) = (pose?, rate?, part?);
        }
    }
    Some(law)
}

fn threshold(value: &Value<'_>) -> Option<f64> {
    let threshold = value.number(&THRESHOLD)?;
    if threshold >= 1.0 {
        value.reject("expected a part of the largest singular value, less than 1");
        return None;
    }
    Some(threshold)
}
