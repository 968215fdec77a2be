//! Approaches that turn the arms too far, too fast or not at all.

use super::number::short;
use super::targets::distance_and_most;
use crate::diagnostic::Warning;
use crate::scenario::{EndEffectorGoal, FinalRates, Scenario, Tracking};
use std::f64::consts::TAU;

/// Joints of space robots turn by degrees a second, not by more than a turn, in rad/s.
const FASTEST: f64 = TAU;

/// What is odd about the angles, rates and times of an approach.
pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    let fixed = [motionless(scenario), hasty(scenario), slack(scenario)];
    let of_ends = terminal_rates(scenario).into_iter().chain(out_of_reach(scenario)).chain(beyond_limits(scenario));
    angles(scenario).into_iter().chain(of_ends).chain(fixed.into_iter().flatten()).collect()
}

/// The joint that turns furthest, and by how much, in rad.
pub(super) fn largest_turn(scenario: &Scenario) -> (usize, f64) {
    let pairs = scenario.initial.joint_angles.iter().zip(&scenario.approach.final_joint_angles);
    let turns = pairs.map(|(from, to)| (to - from).abs()).enumerate();
    turns.max_by(|(_, a), (_, b)| a.total_cmp(b)).unwrap_or_default()
}

/// The highest rate on the way that the angles alone ask for, in rad/s.
pub(super) fn peak_rate(scenario: &Scenario) -> f64 {
    let factor = scenario.approach.trajectory.properties().peak_factor;
    factor * largest_turn(scenario).1 / scenario.approach.trajectory_time()
}

/// `joint 2 of arm1`, by the index over all arms.
pub(super) fn joint_name(scenario: &Scenario, index: usize) -> String {
    scenario.layout.joint_name(index)
}

fn angles(scenario: &Scenario) -> Vec<Warning> {
    let initial = &scenario.initial.joint_angles;
    let end = match scenario.approach.tracking {
        Tracking::ResolvedMotionRate { .. } => &[][..],
        _ => &scenario.approach.final_joint_angles,
    };
    let beyond = |key: &'static str, angles: &[f64]| {
        let beyond: Vec<_> = angles.iter().enumerate().filter(|(_, angle)| angle.abs() > TAU).collect();
        let odd = |(index, angle): &(usize, &f64)| Warning {
            key: format!("{key}[{index}]"),
            why: format!("more than a whole turn of {}", joint_name(scenario, *index)),
            help: format!("angles are in rad; {} is the same pose", short(*angle % TAU)),
        };
        beyond.iter().map(odd).collect::<Vec<_>>()
    };
    let turns = initial.iter().zip(end).enumerate().filter(|(_, (from, to))| (*to - *from).abs() > TAU);
    let turns =
        turns.filter(|(_, (from, to))| from.abs() <= TAU && to.abs() <= TAU).map(|(index, (from, to))| Warning {
            key: format!("approach.final_joint_angles[{index}]"),
            why: format!(
                "{} turns by {} rad from its initial angle {}, more than once round",
                joint_name(scenario, index),
                short(to - from),
                short(*from)
            ),
            help: format!("{} is the same pose, and nearer", short(from + (to - from) % TAU)),
        });
    let beyond = [beyond("initial.joint_angles", initial), beyond("approach.final_joint_angles", end)];
    beyond.into_iter().flatten().chain(turns).collect()
}

fn motionless(scenario: &Scenario) -> Option<Warning> {
    let approach = &scenario.approach;
    let rest = match &approach.end {
        FinalRates::Rest => true,
        FinalRates::JointRates(rates) => rates.iter().all(|rate| *rate == 0.0),
        FinalRates::EndEffectorTwists(twists) => twists.as_flattened().iter().flatten().all(|part| *part == 0.0),
    };
    let designed = approach.final_end_effector_poses.is_some();
    (rest && !designed && approach.final_joint_angles == scenario.initial.joint_angles).then(|| Warning {
        key: "approach.final_joint_angles".to_owned(),
        why: "the arms are there already, and are to be at rest".to_owned(),
        help: "an approach moves the arms from initial.joint_angles to other angles, or to end rates".to_owned(),
    })
}

fn hasty(scenario: &Scenario) -> Option<Warning> {
    let approach = &scenario.approach;
    if approach.final_end_effector_poses.is_some() {
        return None; // how far the joints turn is not known yet
    }
    let peak = peak_rate(scenario);
    let (joint, turn) = largest_turn(scenario);
    (peak > FASTEST).then(|| Warning {
        key: if approach.trajectory_duration.is_some() {
            "approach.trajectory_duration".to_owned()
        } else {
            "approach.duration".to_owned()
        },
        why: format!(
            "{} turns by {} rad in that time, at up to {} rad/s: more than a turn a second",
            joint_name(scenario, joint),
            short(turn),
            short(peak)
        ),
        help: format!(
            "durations are in s; {} s or more is slower than that",
            short(approach.trajectory_time() * peak / FASTEST)
        ),
    })
}

fn terminal_rates(scenario: &Scenario) -> Vec<Warning> {
    let fast = |key: String, why: String, help: &str| Warning { key, why, help: help.to_owned() };
    match &scenario.approach.end {
        FinalRates::Rest => Vec::new(),
        FinalRates::JointRates(rates) => {
            let odd = rates.iter().enumerate().filter(|(_, rate)| rate.abs() > FASTEST);
            odd.map(|(index, rate)| {
                let why = format!("{} is to turn more than once a second", joint_name(scenario, index));
                fast(
                    format!("approach.final_joint_rates[{index}]"),
                    why,
                    &format!("joint rates are in rad/s; {}°/s are {} rad/s", short(*rate), short(rate.to_radians())),
                )
            })
            .collect()
        }
        FinalRates::EndEffectorTwists(twists) => {
            let twists = twists.iter().map(|twist| twist.map(Option::unwrap_or_default));
            let odd = twists.zip(&scenario.layout.arms).enumerate().filter(|(_, ([omega, vx, vy], arm))| {
                omega.abs() > FASTEST || vx.hypot(*vy) > FASTEST * arm.reach_from_base()
            });
            odd.map(|(index, (_, arm))| {
                let why = format!("faster than {}, stretched, turning once a second", arm.name);
                let help = "a twist is [ω, vx, vy] in rad/s, m/s, m/s";
                fast(format!("approach.final_end_effector_twists[{index}]"), why, help)
            })
            .collect()
        }
    }
}

/// End effector poses beyond what any pose of the arm gives. Whether the arm gets to what is nearer is seen when it is
/// run.
fn out_of_reach(scenario: &Scenario) -> Vec<Warning> {
    let goals = scenario.approach.final_end_effector_poses.iter().flatten().enumerate();
    let far = goals.filter_map(|(i, goal)| {
        let (EndEffectorGoal::Position([x, y]) | EndEffectorGoal::Pose([_, x, y])) = goal else { return None };
        let (distance, most) = distance_and_most(scenario, i, [*x, *y])?;
        (distance > most).then(|| Warning {
            key: format!("approach.final_end_effector_poses[{i}]"),
            why: format!(
                "out of reach, {} m from where the robot's COM is at the end of the approach; no pose of {} brings its tip \
                 further out than {} m",
                short(distance),
                arm_name(scenario, i),
                short(most)
            ),
            help: "places are in m, in the inertial frame; the COM of robot and arms goes its way whatever they do".to_owned(),
        })
    });
    far.collect()
}

/// Where the approach should end beyond the limits of its joints. (An initial state there is refused.)
fn beyond_limits(scenario: &Scenario) -> Vec<Warning> {
    let approach = &scenario.approach;
    let limits = || scenario.joint_limits.iter().enumerate();
    let angles = match approach.final_end_effector_poses {
        Some(_) => &[][..], // not known before the run, or a first guess
        None => &approach.final_joint_angles,
    };
    let rates = match &approach.end {
        FinalRates::JointRates(rates) => &rates[..],
        FinalRates::Rest | FinalRates::EndEffectorTwists(_) => &[],
    };
    let angles = limits().zip(angles).filter_map(|((i, joint), angle)| {
        let limit = joint.angle_beyond(*angle)?;
        Some(("angles", i, format!("beyond the limit of {}, {} rad", joint.name, short(limit))))
    });
    let rates = limits().zip(rates).filter_map(|((i, joint), rate)| {
        let limit = joint.rate_beyond(*rate)?;
        Some(("rates", i, format!("beyond the limit of {}, {} rad/s", joint.name, short(limit))))
    });
    let oddity = |(what, i, why)| Warning {
        key: format!("approach.final_joint_{what}[{i}]"),
        why,
        help: format!("limits.joint_{what} says so; a run reports what goes beyond it, and ends with exit code 1"),
    };
    angles.chain(rates).map(oddity).collect()
}

fn arm_name(scenario: &Scenario, arm: usize) -> &str {
    scenario.layout.arms.get(arm).map_or("this arm", |arm| arm.name.as_str())
}

fn slack(scenario: &Scenario) -> Option<Warning> {
    let (Tracking::ProportionalDerivative { proportional_gain, .. }
    | Tracking::ComputedTorque { proportional_gain, .. }) = &scenario.approach.tracking
    else {
        return None;
    };
    proportional_gain.iter().all(|gain| *gain == 0.0).then(|| Warning {
        key: "approach.proportional_gain".to_owned(),
        why: "nothing pulls the arms to their trajectory".to_owned(),
        help: "a gain is 49 by default; `tracking = \"exact\"` follows without gains".to_owned(),
    })
}
