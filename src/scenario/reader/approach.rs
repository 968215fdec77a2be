//! The `[approach]` table: how the arms move to the targets.

use super::integration;
use super::joints::{Joints, check_length};
use super::resolved;
use super::{DURATION, JOINT_ANGLE, JOINT_RATE, POSE, POSITION, TWIST, duration_and_step};
use crate::diagnostic::{NumberRule, Table, Value, every, listing};
use crate::scenario::{Approach, EndEffectorGoal, EndEffectorTwistGoal, FinalRates, Tracking};
use crate::simulate::actuators::Actuation;
use crate::trajectory::TrajectoryKind;

const PROPORTIONAL_GAIN: NumberRule = NumberRule::non_negative("a proportional gain (or one per joint)", "N m/rad");
const DERIVATIVE_GAIN: NumberRule = NumberRule::non_negative("a derivative gain (or one per joint)", "N m s/rad");
/// Of accelerations, not of torques.
const ERROR_GAIN: NumberRule =
    NumberRule::non_negative("a proportional gain of computed torque (or one per joint)", "1/s²");
const RATE_GAIN: NumberRule =
    NumberRule::non_negative("a derivative gain of computed torque (or one per joint)", "1/s");

impl Approach {
    pub(super) const KEYS: [&'static str; 19] = [
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
        resolved::KEYS[0],
        resolved::KEYS[1],
        resolved::KEYS[2],
        Actuation::KEYS[0],
        Actuation::KEYS[1],
        integration::KEYS[0],
        integration::KEYS[1],
        integration::KEYS[2],
    ];

    pub(super) fn from_table(table: &Table<'_>, joints: &Joints<'_>, initial: Option<&[f64]>) -> Option<Self> {
        if Law::of(table) == Some(Law::EndEffectorFeedback) {
            return resolved::approach(table, joints, initial);
        }
        let times = duration_and_step(table);
        resolved::reject_gains(table);
        let kinds: Vec<_> = TrajectoryKind::ALL.iter().map(|kind| (kind.properties().name, *kind)).collect();
        let names: Vec<_> = kinds.iter().map(|(name, _)| *name).collect();
        let trajectory = table.require("trajectory", &listing(&names, "or")).and_then(|value| value.choice(&kinds));
        let goals = table.get("final_end_effector_poses");
        let final_joint_angles = match (table.get("final_joint_angles"), &goals) {
            (None, Some(_)) => Some(initial.map_or_else(|| joints.repeat(0.0), <[f64]>::to_vec)),
            _ => table
                .require("final_joint_angles", &joints.one_each())
                .and_then(|value| joints.numbers(&value, &JOINT_ANGLE)),
        };
        let goals = match &goals {
            Some(value) => end_effector_goals(value, joints).map(Some),
            None => Some(None),
        };
        let end = FinalRates::from_table(table, trajectory, joints);
        let rest = match &end {
            Some(FinalRates::JointRates(rates)) => rates.iter().all(|rate| *rate == 0.0),
            Some(FinalRates::EndEffectorTwists(_)) => false,
            Some(FinalRates::Rest) | None => true,
        };
        let trajectory_duration = trajectory_duration(table, times, rest, "`final_joint_rates` of zeros");
        let tracking = Tracking::from_table(table, joints);
        let actuation = match &tracking {
            Some(Tracking::Exact) => {
                let why =
                    "exact tracking gives whatever torque it takes, expected `tracking` `computed_torque` or `pd`";
                Actuation::reject(table, why);
                Some(Actuation::default())
            }
            _ => Actuation::from_table(table, times, joints),
        };
        let integration = integration::integration(table);
        let (duration, step) = times?;
        Some(Self {
            duration,
            step,
            trajectory_duration: trajectory_duration?,
            trajectory: trajectory?,
            final_joint_angles: final_joint_angles?,
            final_end_effector_poses: goals?,
            end: end?,
            tracking: tracking?,
            actuation: actuation?,
            integration: integration?,
        })
    }
}

impl FinalRates {
    fn from_table(table: &Table<'_>, trajectory: Option<TrajectoryKind>, joints: &Joints<'_>) -> Option<Self> {
        const NAMES: [&str; 2] = ["final_joint_rates", "final_end_effector_twists"];
        let [rates, twists] = NAMES.map(|key| table.get(key));
        let end = match (&rates, &twists) {
            (Some(rates), _) => joints.numbers(rates, &JOINT_RATE).map(Self::JointRates),
            (None, Some(twists)) => end_effector_twists(twists, joints).map(Self::EndEffectorTwists),
            (None, None) => None,
        };
        match (trajectory?, rates, twists) {
            (kind, None, None) if kind.properties().ends_at_rest => return Some(Self::Rest),
            (kind, rates, twists) if kind.properties().ends_at_rest => {
                for value in [rates, twists].into_iter().flatten() {
                    let name = kind.properties().name;
                    value.reject(&format!("the {name} trajectory ends at rest, expected no such key"));
                }
                return None;
            }
            (_, Some(_), Some(twists)) => {
                twists.reject("`final_joint_rates` is there too, expected only one of them");
                return None;
            }
            (_, None, None) if !NAMES.iter().any(|key| table.is_misspelt(key)) => table.reject(
                "missing key `approach.final_end_effector_twists`, expected one [ω, vx, vy] per arm \
                 (or `approach.final_joint_rates`, one rate per joint)"
                    .to_owned(),
                "quartic and quintic trajectories need rates at their end",
            ),
            _ => {}
        }
        end
    }
}

/// The time of the trajectory, `Some(None)` where it is that of the phase; `rest` is whether it ends at rest, and `by`
/// how it would.
#[allow(clippy::option_option, reason = "nothing where it is wrong, and nothing given")]
pub(super) fn trajectory_duration(
    table: &Table<'_>,
    times: Option<(f64, f64)>,
    rest: bool,
    by: &str,
) -> Option<Option<f64>> {
    let Some(value) = table.get("trajectory_duration") else { return Some(None) };
    let trajectory = value.number(&DURATION)?;
    let (duration, _) = times?;
    if trajectory > duration {
        value.reject(&format!("longer than the phase, expected at most its duration, {duration} s"));
        return None;
    }
    if trajectory < duration && !rest {
        value.reject(&format!(
            "the arms are to move on at its end and cannot stay there, expected {by}, or no such key"
        ));
        return None;
    }
    Some((trajectory < duration).then_some(trajectory))
}

pub(super) fn end_effector_goals(value: &Value<'_>, joints: &Joints<'_>) -> Option<Vec<EndEffectorGoal>> {
    const WANTED: &str = "one [yaw, x, y] or [x, y] per arm in rad, m, m, or [] for an arm that may end anywhere";
    let arms = joints.layout.map(|layout| &layout.arms);
    let items = value.items(WANTED)?;
    check_length(value, items.len(), arms.map(Vec::len), WANTED)?;
    let goals = every(items.iter().enumerate().map(|(i, item)| {
        let links = arms.and_then(|arms| arms.get(i)).map_or(usize::MAX, |arm| arm.links.len());
        let goal = match item.items("[yaw, x, y], [x, y] or []")?.len() {
            0 => EndEffectorGoal::Any,
            2 => EndEffectorGoal::Position(item.vector(&POSITION)?),
            _ => EndEffectorGoal::Pose(item.vector(&POSE)?),
        };
        let short = match goal {
            EndEffectorGoal::Any => None,
            EndEffectorGoal::Position(_) => (links < 2).then_some("a single link has its tip on a circle, expected []"),
            EndEffectorGoal::Pose(_) => {
                (links < 3).then_some("fewer than three links cannot choose the yaw too, expected [x, y]")
            }
        };
        if let Some(why) = short {
            item.reject(why);
            return None;
        }
        Some(goal)
    }))?;
    if goals.iter().all(EndEffectorGoal::is_empty) {
        value.reject("nothing is wanted of any tip, expected a pose, or `final_joint_angles` alone");
        return None;
    }
    Some(goals)
}

pub(super) fn end_effector_twists(value: &Value<'_>, joints: &Joints<'_>) -> Option<Vec<EndEffectorTwistGoal>> {
    let arms = joints.layout.map(|layout| &layout.arms);
    let wanted = match arms {
        Some(arms) => {
            let names: Vec<_> = arms.iter().map(|arm| arm.name.as_str()).collect();
            let (count, names) = (arms.len(), names.join(", "));
            format!("{count} twists [ω, vx, vy], one per arm ({names}), or [vx, vy] or [] where less is wanted")
        }
        None => "one twist [ω, vx, vy] per arm, or [vx, vy] or [] where less is wanted".to_owned(),
    };
    let items = value.items(&wanted)?;
    check_length(value, items.len(), arms.map(Vec::len), &wanted)?;
    let [_, vx, vy] = TWIST;
    let twists = every(items.iter().map(|item| match item.items("[ω, vx, vy], [vx, vy] or []")?.len() {
        0 => Some([None; 3]),
        2 => item.vector(&[vx, vy]).map(|[vx, vy]| [None, Some(vx), Some(vy)]),
        _ => item.vector(&TWIST).map(|twist| twist.map(Some)),
    }))?;
    if twists.iter().flatten().all(Option::is_none) {
        value.reject("nothing is wanted of any tip, expected a twist, or `final_joint_rates`");
        return None;
    }
    Some(twists)
}

impl Tracking {
    fn from_table(table: &Table<'_>, joints: &Joints<'_>) -> Option<Self> {
        let law = match table.get("tracking") {
            Some(value) => value.choice(&Law::CHOICES)?,
            None => Law::Torques,
        };
        let [error, rate] = match law {
            Law::EndEffectorFeedback => return None, // read by `resolved`
            Law::Torques => [&PROPORTIONAL_GAIN, &DERIVATIVE_GAIN],
            Law::Accelerations => [&ERROR_GAIN, &RATE_GAIN],
            Law::Exact => {
                for key in ["proportional_gain", "derivative_gain"] {
                    if let Some(value) = table.get(key) {
                        value.reject("exact tracking has no gains, expected `tracking = \"pd\"` with them");
                    }
                }
                return Some(Self::Exact);
            }
        };
        let proportional_gain = joints.gain(table, "proportional_gain", error, 49.0);
        let derivative_gain = joints.gain(table, "derivative_gain", rate, 14.0);
        let (proportional_gain, derivative_gain) = (proportional_gain?, derivative_gain?);
        Some(match law {
            Law::Accelerations => Self::ComputedTorque { proportional_gain, derivative_gain },
            Law::Torques | Law::Exact | Law::EndEffectorFeedback => {
                Self::ProportionalDerivative { proportional_gain, derivative_gain }
            }
        })
    }
}

/// What the gains of a law make of an error.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Law {
    Torques,
    Accelerations,
    Exact,
    EndEffectorFeedback,
}

impl Law {
    const CHOICES: [(&'static str, Self); 4] = [
        ("pd", Self::Torques),
        ("exact", Self::Exact),
        ("computed_torque", Self::Accelerations),
        ("resolved_motion_rate", Self::EndEffectorFeedback),
    ];

    /// What the table names; `None` where that is nothing, or no law.
    fn of(table: &Table<'_>) -> Option<Self> {
        let value = table.get("tracking")?;
        Self::CHOICES.iter().find(|(name, _)| value.as_str() == Some(name)).map(|(_, law)| *law)
    }
}
