//! The `[approach]` table: in joint space, or by end effectors with `tracking = "resolved_motion_rate"`.

use super::actuation::actuation;
use super::duration_and_step;
use super::integration::integration;
use super::joints::{Joints, check_length};
use super::own_law::law_numbers;
use crate::diagnostic::{Table, Value, every};
use crate::scenario::{Approach, EndEffectorGoal, EndEffectorTwistGoal, FinalRates, LawFormat, LawNumbers, Tracking};
use crate::simulate::actuators::Actuation;
use crate::trajectory::TrajectoryKind;

const GAINS: [&str; 2] = ["proportional_gain", "derivative_gain"];

/// The trajectory of an approach and its end; `None` where a part is invalid.
#[allow(clippy::option_option, reason = "None where it is invalid, Some(None) where it is not given")]
struct Goal {
    trajectory: Option<TrajectoryKind>,
    final_joint_angles: Option<Vec<f64>>,
    final_end_effector_poses: Option<Option<Vec<EndEffectorGoal>>>,
    end: Option<FinalRates>,
}

/// Reads the table; `initial` are the initial joint angles.
pub(super) fn approach(
    table: &Table<'_>,
    joints: &Joints<'_>,
    initial: Option<&[f64]>,
    own: &[LawFormat],
) -> Option<Approach> {
    let times = duration_and_step(table);
    let unmade: Vec<_> =
        own.iter().map(|law| Tracking::Own { name: law.name, numbers: LawNumbers::default() }).collect();
    let laws: Vec<_> = Tracking::LAWS.iter().chain(&unmade).map(|law| (law.name(), law)).collect();
    let law = table.choice("tracking", &laws);
    match law {
        // its numbers are in its own table; all else is as under any law of the joints
        Some(Tracking::Own { .. }) => {
            for key in table.keys_without("tracking", "computed_torque").into_iter().chain(GAINS) {
                table.reject_keys(&[key], "the numbers of a law of one's own are in `[approach.law]`");
            }
        }
        Some(law) => {
            for key in table.keys_without("tracking", law.name()) {
                table.reject_keys(&[key], why_not(law, key));
            }
            table.reject_keys(&["law"], "only `tracking` with the name of a law of the program's own has it");
        }
        None => {}
    }
    let by_end_effectors = matches!(law, Some(Tracking::ResolvedMotionRate { .. }));
    // the first guess of the inverse kinematics
    let initial = initial.map_or_else(|| joints.repeat(0.0), <[f64]>::to_vec);
    let goal =
        if by_end_effectors { end_effector_goal(table, joints, initial) } else { joint_goal(table, joints, initial) };
    let trajectory_duration = trajectory_duration(table, times, goal.end.as_ref(), by_end_effectors);
    let tracking = law.and_then(|law| tracking(table, joints, law, own));
    let actuation = match law {
        Some(Tracking::InverseDynamics) => Some(Actuation::default()),
        _ => actuation(table, times, joints),
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
    let kinds: Vec<_> = TrajectoryKind::ALL.iter().map(|kind| (kind.properties().name, *kind)).collect();
    let trajectory = table.choice("trajectory", &kinds);
    let poses = table.get("final_end_effector_poses");
    let final_joint_angles = match table.get("final_joint_angles") {
        None if poses.is_some() => Some(initial),
        _ => table.require_as("final_joint_angles", &joints.one_each()).and_then(|value| joints.numbers(&value)),
    };
    Goal {
        trajectory,
        final_joint_angles,
        final_end_effector_poses: poses.map_or(Some(None), |value| end_effector_poses(&value, joints).map(Some)),
        end: final_rates(table, trajectory, joints),
    }
}

fn end_effector_goal(table: &Table<'_>, joints: &Joints<'_>, initial: Vec<f64>) -> Goal {
    if let Some(value) = table.get("trajectory").filter(|value| value.as_str() != Some("quintic")) {
        value.reject("end effectors follow quintic paths, expected `quintic` or no such key");
    }
    let poses = table
        .require_as(
            "final_end_effector_poses",
            "one [yaw, x, y] or [x, y] per arm, or [] for an arm that keeps its angles",
        )
        .and_then(|value| end_effector_poses(&value, joints));
    let at_rest = vec![[Some(0.0); 3]; joints.layout.map_or(0, |layout| layout.arms.len())];
    let twists = table.read_or("final_end_effector_twists", at_rest, |value| {
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
        (Some(rates), _) => joints.numbers(rates).map(FinalRates::JointRates),
        (None, Some(twists)) => end_effector_twists(twists, joints).map(FinalRates::EndEffectorTwists),
        (None, None) => None,
    };
    let trajectory = trajectory?.properties();
    match (rates, twists) {
        (None, None) if trajectory.ends_at_rest => return Some(FinalRates::Rest),
        _ if trajectory.ends_at_rest => {
            let why = format!("the {} trajectory ends at rest, expected no such key", trajectory.name);
            table.reject_keys(&KEYS, &why);
            return None;
        }
        (Some(_), Some(twists)) => {
            twists.reject("`final_joint_rates` is there too, expected only one of them");
            return None;
        }
        (None, None) if !KEYS.iter().any(|key| table.is_misspelt(key)) => table.reject(
            "missing key `approach.final_end_effector_twists`, expected one [ω, vx, vy] per arm \
             (or `approach.final_joint_rates`, one rate per joint; zeros to end at rest)",
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
    let trajectory = value.number()?;
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
            "the arms may move at its end, where they are to stay: expected `{key}` of zeros, or no such key"
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
                EndEffectorGoal::Position(item.vector()?),
                fewer_links_than(2).then_some("a single link has its end effector on a circle, expected []"),
            ),
            _ => (
                EndEffectorGoal::Pose(item.vector()?),
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
    let twists = every(items.iter().map(|item| match item.items("[ω, vx, vy], [vx, vy] or []")?.len() {
        0 => Some([None; 3]),
        2 => item.vector().map(|[vx, vy]| [None, Some(vx), Some(vy)]),
        _ => item.vector::<3>().map(|twist| twist.map(Some)),
    }))?;
    if twists.as_flattened().iter().all(Option::is_none) {
        value.reject("no end effector has a twist to reach, expected a twist, or `final_joint_rates`");
        return None;
    }
    Some(twists)
}

/// Why a key may not be given with a law.
fn why_not(law: &Tracking, key: &str) -> &'static str {
    match (law, key) {
        (_, "pose_gain" | "rate_gain" | "singularity_threshold") => "only `tracking = \"resolved_motion_rate\"` has it",
        (Tracking::InverseDynamics, "torque_limits" | "sample_time") => {
            "exact tracking gives whatever torque it takes, expected `tracking` `computed_torque`, `pd` or `resolved_motion_rate`"
        }
        (Tracking::InverseDynamics, _) => "exact tracking has no gains, expected `tracking = \"pd\"` with them",
        (_, "final_joint_angles") => "the joints follow the end effectors, expected no such key",
        (_, "final_joint_rates") => "end effectors have twists, expected `final_end_effector_twists`",
        _ => "resolved motion rate control has `pose_gain` and `rate_gain` instead",
    }
}

/// A law with its gains.
fn tracking(table: &Table<'_>, joints: &Joints<'_>, law: &Tracking, own: &[LawFormat]) -> Option<Tracking> {
    let gains = || {
        let gain = |key| joints.gain(table, table.entry_with(key, "tracking", law.name()));
        GAINS.map(gain)
    };
    Some(match law {
        Tracking::Own { name, .. } => Tracking::Own { name, numbers: law_numbers(table, "approach.law", name, own)? },
        Tracking::InverseDynamics => Tracking::InverseDynamics,
        Tracking::ProportionalDerivative { .. } => {
            let [proportional_gain, derivative_gain] = gains();
            Tracking::ProportionalDerivative {
                proportional_gain: proportional_gain?,
                derivative_gain: derivative_gain?,
            }
        }
        Tracking::ComputedTorque { .. } => {
            let [proportional_gain, derivative_gain] = gains();
            Tracking::ComputedTorque { proportional_gain: proportional_gain?, derivative_gain: derivative_gain? }
        }
        Tracking::ResolvedMotionRate { .. } => {
            let [pose_gain, rate_gain, threshold] =
                ["pose_gain", "rate_gain", "singularity_threshold"].map(|key| table.number(key));
            Tracking::ResolvedMotionRate {
                pose_gain: pose_gain?,
                rate_gain: rate_gain?,
                singularity_threshold: threshold?,
            }
        }
    })
}
