//! Warnings about approaches: angles, rates, durations and goals.

use super::number::short;
use super::warning;
use crate::capture::reach::Reach;
use crate::diagnostic::Warning;
use crate::layout::Arm;
use crate::scenario::{EndEffectorTwistGoal, FinalRates, Scenario, Tracking};
use std::f64::consts::TAU;

/// Largest joint rate without a warning, rad/s: joints of space robots turn by degrees a second.
const MAX_RATE: f64 = TAU;

pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    let fixed = [motionless(scenario), fast(scenario), without_stiffness(scenario)].into_iter().flatten();
    let of_ends = terminal_rates(scenario).into_iter().chain(out_of_reach(scenario)).chain(beyond_limits(scenario));
    angles(scenario).into_iter().chain(of_ends).chain(fixed).collect()
}

/// The joint with the largest change of its angle, and the change, rad.
pub(super) fn largest_turn(scenario: &Scenario) -> (usize, f64) {
    let pairs = scenario.initial.joint_angles.iter().zip(&scenario.approach.final_joint_angles);
    let turns = pairs.map(|(from, to)| (to - from).abs()).enumerate();
    turns.max_by(|(_, a), (_, b)| a.total_cmp(b)).expect("a layout has joints")
}

/// The highest joint rate of a trajectory from rest to rest between the angles, rad/s.
pub(super) fn peak_rate(scenario: &Scenario) -> f64 {
    let factor = scenario.approach.trajectory.properties().peak_factor;
    factor * largest_turn(scenario).1 / scenario.approach.trajectory_time()
}

fn angles(scenario: &Scenario) -> Vec<Warning> {
    let initial = &scenario.initial.joint_angles;
    let end = match scenario.approach.tracking {
        Tracking::ResolvedMotionRate { .. } => &[][..],
        _ => &scenario.approach.final_joint_angles,
    };
    let beyond = |key: &'static str, angles: &[f64]| {
        let beyond = angles.iter().enumerate().filter(|(_, angle)| angle.abs() > TAU);
        let beyond = beyond.map(|(index, angle)| {
            let why = format!("more than a whole turn of {}", scenario.layout.joint_name(index));
            let help = format!("angles are in rad; {} is the same pose", short(angle % TAU));
            warning(format!("{key}[{index}]"), why, help)
        });
        beyond.collect::<Vec<_>>()
    };
    let turns = initial
        .iter()
        .zip(end)
        .enumerate()
        .filter(|(_, (from, to))| (*to - *from).abs() > TAU && from.abs() <= TAU && to.abs() <= TAU);
    let turns = turns.map(|(index, (from, to))| {
        let why = format!(
            "{} turns by {} rad from its initial angle {}, more than once round",
            scenario.layout.joint_name(index),
            short(to - from),
            short(*from)
        );
        let help = format!("{} is the same pose, and nearer", short(from + (to - from) % TAU));
        warning(format!("approach.final_joint_angles[{index}]"), why, help)
    });
    let beyond = [beyond("initial.joint_angles", initial), beyond("approach.final_joint_angles", end)];
    beyond.into_iter().flatten().chain(turns).collect()
}

fn motionless(scenario: &Scenario) -> Option<Warning> {
    let approach = &scenario.approach;
    let designed = approach.final_end_effector_poses.is_some();
    let there = approach.end.is_rest() && approach.final_joint_angles == scenario.initial.joint_angles;
    (there && !designed).then(|| {
        let why = "the arms are there already, and are to be at rest";
        let help = "an approach moves the arms from initial.joint_angles to other angles, or to end rates";
        warning("approach.final_joint_angles", why, help)
    })
}

fn fast(scenario: &Scenario) -> Option<Warning> {
    let approach = &scenario.approach;
    if approach.final_end_effector_poses.is_some() {
        return None; // how far the joints turn is not known yet
    }
    let peak = peak_rate(scenario);
    let (joint, turn) = largest_turn(scenario);
    (peak > MAX_RATE).then(|| {
        let key = if approach.trajectory_duration.is_some() { "trajectory_duration" } else { "duration" };
        let why = format!(
            "{} turns by {} rad in that time, at up to {} rad/s: more than a turn a second",
            scenario.layout.joint_name(joint),
            short(turn),
            short(peak)
        );
        let slower = short(approach.trajectory_time() * peak / MAX_RATE);
        let help = format!("durations are in s; {slower} s or more is slower than that");
        warning(format!("approach.{key}"), why, help)
    })
}

fn terminal_rates(scenario: &Scenario) -> Vec<Warning> {
    match &scenario.approach.end {
        FinalRates::Rest => Vec::new(),
        FinalRates::JointRates(rates) => {
            let fast = rates.iter().enumerate().filter(|(_, rate)| rate.abs() > MAX_RATE);
            fast.map(|(index, rate)| {
                let why = format!("{} is to turn more than once a second", scenario.layout.joint_name(index));
                let [degrees, radians] = [*rate, rate.to_radians()].map(short);
                let help = format!("joint rates are in rad/s; {degrees}°/s are {radians} rad/s");
                warning(format!("approach.final_joint_rates[{index}]"), why, help)
            })
            .collect()
        }
        FinalRates::EndEffectorTwists(twists) => {
            let of_arms = twists.iter().zip(&scenario.layout.arms).enumerate();
            let fast = of_arms.filter(|(_, (twist, arm))| rate_of(twist, arm) > MAX_RATE);
            fast.map(|(index, (_, arm))| {
                let why = format!("faster than {}, stretched, turning once a second", arm.name);
                let help = "a twist is [ω, vx, vy] in rad/s, m/s, m/s";
                warning(format!("approach.final_end_effector_twists[{index}]"), why, help)
            })
            .collect()
        }
    }
}

/// The rate of an end effector, rad/s: the larger one of its own and that of its arm, stretched, at its speed.
fn rate_of(twist: &EndEffectorTwistGoal, arm: &Arm) -> f64 {
    let [omega, vx, vy] = twist.map(|part| part.unwrap_or(0.0));
    omega.abs().max(libm::hypot(vx, vy) / arm.reach_from_base())
}

/// The largest rate of an end effector at the end of the approach, rad/s; 0 where it is not given.
pub(super) fn final_rate(scenario: &Scenario) -> f64 {
    let FinalRates::EndEffectorTwists(twists) = &scenario.approach.end else { return 0.0 };
    twists.iter().zip(&scenario.layout.arms).map(|(twist, arm)| rate_of(twist, arm)).fold(0.0, f64::max)
}

/// End effector poses that no configuration reaches, where the arms stretch towards them. (A joint trajectory to them is
/// refused.)
fn out_of_reach(scenario: &Scenario) -> Vec<Warning> {
    if !matches!(scenario.approach.tracking, Tracking::ResolvedMotionRate { .. }) {
        return Vec::new();
    }
    let goals = scenario.approach.final_end_effector_poses.iter().flatten().enumerate();
    let far = goals.filter_map(|(i, goal)| {
        let Reach { distance, limit, .. } = Reach::new(scenario, i, goal.position()?).filter(Reach::is_exceeded)?;
        let why = format!(
            "out of reach, {} m from where the robot's COM is at the end of the approach; no pose of {} brings its end effector \
             further out than {} m",
            short(distance),
            scenario.layout.arms[i].name,
            short(limit)
        );
        let help = "places are in m, in the inertial frame; no motion of the arms moves the robot's COM";
        Some(warning(format!("approach.final_end_effector_poses[{i}]"), why, help))
    });
    far.collect()
}

/// Final angles and rates beyond the limits of their joints. (An initial state beyond them is an error.)
pub(super) fn beyond_limits(scenario: &Scenario) -> Vec<Warning> {
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
    let all = angles.chain(rates).map(|(what, i, why)| {
        let help = format!("limits.joint_{what} says so; a run reports what goes beyond it, and ends with exit code 1");
        warning(format!("approach.final_joint_{what}[{i}]"), why, help)
    });
    all.collect()
}

fn without_stiffness(scenario: &Scenario) -> Option<Warning> {
    let (Tracking::ProportionalDerivative { proportional_gain, .. }
    | Tracking::ComputedTorque { proportional_gain, .. }) = &scenario.approach.tracking
    else {
        return None;
    };
    proportional_gain.iter().all(|gain| *gain == 0.0).then(|| {
        let why = "nothing pulls the arms to their trajectory";
        let help = "a gain is 49 by default; `tracking = \"exact\"` follows without gains";
        warning("approach.proportional_gain", why, help)
    })
}
