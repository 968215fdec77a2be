//! The description of a scenario: robot, approach, control laws, targets and cases.

use super::approach::{largest_turn, peak_rate};
use super::number::{count, list, point, short};
use super::pose::{FinalPose, final_pose};
use super::robot::{code, digest, freedom};
use super::stiffness::{fastest_mode, fastest_mode_afterwards};
use super::targets::contact_reach;
use crate::contact::ContactKind;
use crate::registry::{self, Robots};
use crate::scenario::{
    Actuation, Detection, EndEffectorGoal, EndEffectorTwistGoal, FinalRates, PostCaptureControl, Scenario, Tracking,
    contact_name,
};
use crate::simulate::Timing;
use std::fmt::{self, Write};

pub(super) fn description(scenario: &Scenario, robots: Robots<'_>) -> String {
    let mut text = String::new();
    write(&mut text, scenario, robots).expect("writing to a String does not fail");
    text
}

fn write(out: &mut String, scenario: &Scenario, robots: Robots<'_>) -> fmt::Result {
    let (layout, approach) = (&scenario.layout, &scenario.approach);
    writeln!(out, "{}: a scenario\n", scenario.name)?;
    let [mass, digest, freedom] = [short(layout.mass()), digest(layout), freedom(layout)];
    writeln!(out, "  robot               {}, {mass} kg, sha256 {digest}", layout.name)?;
    writeln!(out, "  degrees of freedom  {freedom}")?;
    writeln!(out, "  generated code      {}", code(layout, robots))?;
    writeln!(out, "  start               {}", start(scenario))?;
    writeln!(out, "  approach            {}", steps(approach.duration, approach.step))?;
    writeln!(out, "  trajectory          {}", trajectory(scenario))?;
    match &approach.final_end_effector_poses {
        Some(goals) if by_end_effectors(scenario) => writeln!(out, "  end effectors       to {}", goal_poses(goals))?,
        Some(goals) => writeln!(out, "  final angles        to be designed, for {}", goal_poses(goals))?,
        None => writeln!(out, "  largest turn        {}", turn(scenario))?,
    }
    writeln!(out, "  tracking            {}", tracking(scenario))?;
    if let Some(FinalPose { arms, margin }) = final_pose(scenario) {
        let names: Vec<_> = arms.iter().map(|arm| arm.name.as_str()).collect();
        let margin = short(margin);
        writeln!(
            out,
            "  final pose          generalized Jacobian of {}: smallest/largest singular value {margin}",
            names.join(", ")
        )?;
    }
    if let Some(after) = &scenario.post_impact {
        let captured: f64 = scenario.targets.iter().map(|target| target.mass).sum();
        let mass = short(layout.mass() + captured);
        writeln!(out, "  afterwards          {}, of {mass} kg together", steps(after.duration, after.step))?;
        if after.control != PostCaptureControl::None {
            let actuation = actuation(&after.actuation);
            let mode = fastest_mode_afterwards(scenario).map_or_else(String::new, |rate| {
                format!("; fastest mode at most {} 1/s, {} in a step", short(rate), short(rate * after.step))
            });
            writeln!(out, "  control afterwards  {}{mode}{actuation}", post_capture_law(&after.control))?;
        }
        targets(out, scenario)?;
        cases(out, scenario)?;
    }
    Ok(())
}

fn steps(duration: f64, step: f64) -> String {
    let steps = Timing { duration, step, sample: step, ..Timing::default() }.steps();
    format!("{} s in {steps} steps of {} s", short(duration), short(step))
}

fn start(scenario: &Scenario) -> String {
    let initial = &scenario.initial;
    let [yaw, x, y] = initial.base_pose;
    let place = format!("base at {} m, yaw {} rad", point([x, y]), short(yaw));
    let still = initial.base_twist.iter().chain(&initial.joint_rates).all(|rate| *rate == 0.0);
    match registry::generic(&scenario.layout).momentum(&initial.view()) {
        Ok(momentum) if !still => {
            let [px, py] = momentum.linear_momentum;
            let energy = short(momentum.kinetic_energy);
            let momentum = list(&[momentum.angular_momentum, px, py]);
            format!("{place}; momentum [l, px, py] {momentum} N m s, N s; {energy} J")
        }
        Ok(_) | Err(_) => format!("at rest, {place}"),
    }
}

fn by_end_effectors(scenario: &Scenario) -> bool {
    matches!(scenario.approach.tracking, Tracking::ResolvedMotionRate { .. })
}

fn trajectory(scenario: &Scenario) -> String {
    let shape = scenario.approach.trajectory.properties().name.replace('_', " ");
    let end = match &scenario.approach.end {
        FinalRates::Rest => "rest".to_owned(),
        FinalRates::JointRates(rates) => format!("joint rates {} rad/s", list(rates)),
        FinalRates::EndEffectorTwists(twists) => {
            let wanted = |twist: &EndEffectorTwistGoal| list(&twist.iter().flatten().copied().collect::<Vec<_>>());
            let twists: Vec<_> = twists.iter().map(wanted).collect();
            format!("end effector twists {} rad/s, m/s", twists.join(", "))
        }
    };
    let whose = if by_end_effectors(scenario) { " of the end effectors" } else { "" };
    let then = scenario.approach.trajectory_duration;
    let then = then.map_or_else(String::new, |time| format!(" in {} s, and there until the end", short(time)));
    format!("{shape}{whose}, to {end}{then}")
}

fn goal_poses(goals: &[EndEffectorGoal]) -> String {
    let goals = goals.iter().map(|goal| match goal {
        EndEffectorGoal::Any => "any pose".to_owned(),
        EndEffectorGoal::Position(position) => format!("end effector at {} m", point(*position)),
        EndEffectorGoal::Pose(pose) => format!("end effector pose {} rad, m", list(pose)),
    });
    goals.collect::<Vec<_>>().join(", ")
}

fn turn(scenario: &Scenario) -> String {
    let (joint, turn) = largest_turn(scenario);
    let joint = scenario.layout.joint_name(joint);
    format!("{joint}, {} rad at up to {} rad/s", short(turn), short(peak_rate(scenario)))
}

fn tracking(scenario: &Scenario) -> String {
    let mode = fastest_mode(scenario).map_or_else(String::new, |rate| {
        format!("; fastest mode {} 1/s, {} in a step", short(rate), short(rate * scenario.approach.step))
    });
    format!("{}{mode}{}", law(scenario), actuation(&scenario.approach.actuation))
}

fn actuation(Actuation { torque_limits, steps_per_sample }: &Actuation) -> String {
    let limits = torque_limits.as_ref().map(|limits| format!("; at most {} N m", gains(limits)));
    let samples = steps_per_sample.map(|steps| format!("; sampled every {}, and held", count(steps as usize, "step")));
    limits.unwrap_or_default() + &samples.unwrap_or_default()
}

fn post_capture_law(control: &PostCaptureControl) -> String {
    match control {
        PostCaptureControl::None => "none".to_owned(),
        PostCaptureControl::Hold { proportional_gain, derivative_gain } => {
            format!("hold, {} N m/rad, {} N m s/rad", gains(proportional_gain), gains(derivative_gain))
        }
        PostCaptureControl::Damping { derivative_gain } => format!("damping, {} N m s/rad", gains(derivative_gain)),
        PostCaptureControl::Stabilise { derivative_gain, base_gain, base_torque_limit } => {
            let rates = format!("stabilise, joints {} 1/s, base {} 1/s", gains(derivative_gain), short(*base_gain));
            let torque = base_torque_limit.map(|limit| format!("; base torque of at most {} N m", short(limit)));
            rates + &torque.unwrap_or_default()
        }
    }
}

fn law(scenario: &Scenario) -> String {
    match &scenario.approach.tracking {
        Tracking::ComputedTorque { proportional_gain, derivative_gain } => {
            format!("computed torque, {} 1/s², {} 1/s", gains(proportional_gain), gains(derivative_gain))
        }
        Tracking::ResolvedMotionRate { pose_gain, rate_gain, singularity_threshold } => format!(
            "resolved motion rate, poses {} 1/s, rates {} 1/s, singular values damped below {} of the largest",
            short(*pose_gain),
            short(*rate_gain),
            short(*singularity_threshold)
        ),
        Tracking::InverseDynamics => "exact, torques from inverse dynamics".to_owned(),
        Tracking::ProportionalDerivative { proportional_gain, derivative_gain } => {
            format!("PD, {} N m/rad, {} N m s/rad", gains(proportional_gain), gains(derivative_gain))
        }
    }
}

/// One number where all are the same.
#[allow(clippy::float_cmp, reason = "gains are written down, not computed")]
fn gains(values: &[f64]) -> String {
    match values {
        [first, rest @ ..] if rest.iter().all(|value| value == first) => short(*first),
        values => list(values),
    }
}

fn targets(out: &mut String, scenario: &Scenario) -> fmt::Result {
    let row = |cells: [&str; 7]| {
        let [name, arm, mass, inertia, contact, position, reach] = cells;
        let row = format!("  {name:<12} {arm:<10} {mass:>9} {inertia:>16}  {contact:<14} {position:<14} {reach}");
        format!("{}\n", row.trim_end())
    };
    let head = ["target", "arm", "mass [kg]", "inertia [kg m²]", "contact [m]", "position [m]", "from robot's COM [m]"];
    write!(out, "\n{}", row(head))?;
    for target in &scenario.targets {
        let names = target.contacts.iter().map(|contact| scenario.layout.arms[contact.arm].name.as_str());
        let arm = names.collect::<Vec<_>>().join(", ");
        let contact = match scenario.contact.detection {
            Detection::Time => {
                target.contacts.iter().map(|contact| point(contact.point)).collect::<Vec<_>>().join(", ")
            }
            Detection::Event => "detected".to_owned(),
        };
        let reach = contact_reach(scenario, target);
        let reach = reach.map(|reach| format!("{} of at most {}", short(reach.distance), short(reach.limit)));
        out.write_str(&row([
            &target.name,
            &arm,
            &short(target.mass),
            &short(target.inertia),
            &contact,
            &target.position.map(point).unwrap_or_default(),
            &reach.unwrap_or_default(),
        ]))?;
    }
    Ok(())
}

fn cases(out: &mut String, scenario: &Scenario) -> fmt::Result {
    writeln!(
        out,
        "\n  {}, target twists [ω, vx, vy] in rad/s, m/s, and what the contacts do",
        count(scenario.cases.len(), "case")
    )?;
    for case in &scenario.cases {
        let each = scenario.targets.iter().zip(&case.target_twists).zip(case.kinds.iter().zip(&case.restitutions));
        let targets: Vec<_> = each
            .map(|((target, twist), (kinds, restitution))| {
                format!("{} {} {}", target.name, list(twist), contacts(kinds, *restitution))
            })
            .collect();
        writeln!(out, "  {:<12} {}", case.name, targets.join(", "))?;
    }
    Ok(())
}

/// `rigid`, or `rigid and pin`, or `bounce (0.5)`.
fn contacts(kinds: &[Option<ContactKind>], restitution: f64) -> String {
    let alike = kinds.iter().all(|kind| Some(kind) == kinds.first());
    let shown = if alike { &kinds[..1] } else { kinds };
    let names = shown.iter().map(|kind| match kind {
        Some(kind) if kind.is_unilateral() => format!("{} ({})", kind.name(), short(restitution)),
        kind => contact_name(*kind).to_owned(),
    });
    names.collect::<Vec<_>>().join(" and ")
}
