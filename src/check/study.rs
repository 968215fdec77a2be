//! The description of a scenario: robot, approach, control laws, targets and cases.

use super::approach::{largest_turn, peak_rate};
use super::number::{list, point, short};
use super::pose::{FinalPose, final_pose};
use super::robot::{code, digest, freedom};
use super::stiffness::{fastest_mode, fastest_mode_afterwards};
use super::targets::contact_reach;
use crate::contact::ContactKind;
use crate::plain_text::Column::{Left, Right};
use crate::plain_text::{Table, count, entry, wrap};
use crate::registry::{self, Robots};
use crate::scenario::{
    Actuation, Detection, EndEffectorGoal, EndEffectorTwistGoal, FinalRates, LawNumbers, PostCaptureControl, Scenario,
    Tracking, contact_name,
};
use crate::simulate::Timing;
use crate::simulate::stepper::Integration;

pub(super) fn description(scenario: &Scenario, robots: Robots<'_>) -> String {
    let (layout, approach) = (&scenario.layout, &scenario.approach);
    let mut out = format!("{}: a scenario\n\n", scenario.name);
    let [mass, digest] = [short(layout.mass()), digest(layout)];
    out += &entry("robot", &format!("{}, {mass} kg, sha256 {digest}", layout.name));
    out += &entry("degrees of freedom", &freedom(layout));
    out += &entry("generated code", &code(layout, robots));
    out += &entry("start", &start(scenario));
    out += &entry("approach", &steps(approach.duration, approach.step, approach.integration));
    out += &entry("trajectory", &trajectory(scenario));
    out += &match &approach.final_end_effector_poses {
        Some(goals) if by_end_effectors(scenario) => entry("end effectors", &goal_poses(scenario, goals)),
        Some(goals) => entry("final angles", &format!("to be designed, for {}", goal_poses(scenario, goals))),
        None => entry("largest turn", &turn(scenario)),
    };
    out += &entry("tracking", &tracking(scenario));
    if let Some(FinalPose { arms, is_designed, margin, si_margin }) = final_pose(scenario) {
        let names: Vec<_> = arms.iter().map(|arm| arm.name.as_str()).collect();
        let (names, margin, si_margin) = (names.join(", "), short(margin), short(si_margin));
        let which = if is_designed { "the given" } else { "all" };
        let what = format!(
            "generalized Jacobian of {which} twists of {names}: smallest/largest singular value {si_margin} in SI units, {margin} \
             with lengths in units of the reach"
        );
        out += &entry("final pose", &what);
    }
    if let Some(after) = &scenario.post_impact {
        let captured: f64 = scenario.targets.iter().map(|target| target.mass).sum();
        let mass = short(layout.mass() + captured);
        out += &entry(
            "afterwards",
            &format!("{}, of {mass} kg together", steps(after.duration, after.step, after.integration)),
        );
        if after.control != PostCaptureControl::None {
            let (law, actuation) = (post_capture_law(&after.control), actuation(&after.actuation));
            let mode = fastest_mode_afterwards(scenario).map_or_else(String::new, |rate| {
                format!("; fastest mode at most {} 1/s{}", short(rate), in_a_step(rate, after.step, after.integration))
            });
            out += &entry("control afterwards", &format!("{law}{mode}{actuation}"));
        }
        out += &targets(scenario);
        out += &cases(scenario);
    }
    out
}

fn steps(duration: f64, step: f64, by: Integration) -> String {
    if by.integrator.properties().is_adaptive {
        return format!("{} s in adaptive steps, audited every {} s", short(duration), short(step));
    }
    let steps = Timing::of_steps(duration, step).steps();
    format!("{} s in {steps} steps of {} s", short(duration), short(step))
}

/// How far a mode comes in a step whose length is the scenario's.
fn in_a_step(rate: f64, step: f64, by: Integration) -> String {
    if by.integrator.properties().is_adaptive { String::new() } else { format!(", {} in a step", short(rate * step)) }
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
            format!("{place}; momentum [l, px, py] {momentum} N\u{a0}m\u{a0}s, N\u{a0}s; {energy} J")
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
            let arms = scenario.layout.arms.iter().zip(twists);
            let twists: Vec<_> = arms.map(|(arm, twist)| format!("{} {}", arm.name, wanted(twist))).collect();
            format!("end effector twists {} rad/s, m/s", twists.join(", "))
        }
    };
    let whose = if by_end_effectors(scenario) { " of the end effectors" } else { "" };
    let then = scenario.approach.trajectory_duration;
    let then = then.map_or_else(String::new, |time| format!(" in {} s, and there until the end", short(time)));
    format!("{shape}{whose}, to {end}{then}")
}

fn goal_poses(scenario: &Scenario, goals: &[EndEffectorGoal]) -> String {
    let goals = scenario.layout.arms.iter().zip(goals).map(|(arm, goal)| match goal {
        EndEffectorGoal::Any => format!("{} in any pose", arm.name),
        EndEffectorGoal::Position(position) => format!("{} at {} m", arm.name, point(*position)),
        EndEffectorGoal::Pose(pose) => format!("{} in the pose {} rad, m", arm.name, list(pose)),
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
        let in_a_step = in_a_step(rate, scenario.approach.step, scenario.approach.integration);
        format!("; fastest mode {} 1/s{in_a_step}", short(rate))
    });
    format!("{}{mode}{}", law(scenario), actuation(&scenario.approach.actuation))
}

fn actuation(Actuation { torque_limits, steps_per_sample }: &Actuation) -> String {
    let limits = torque_limits.as_ref().map(|limits| format!("; at most {} N\u{a0}m", gains(limits)));
    let samples = steps_per_sample.map(|steps| format!("; sampled every {}, and held", count(steps as usize, "step")));
    limits.unwrap_or_default() + &samples.unwrap_or_default()
}

fn post_capture_law(control: &PostCaptureControl) -> String {
    match control {
        PostCaptureControl::None => "none".to_owned(),
        PostCaptureControl::Hold { proportional_gain, derivative_gain } => {
            format!("hold, {} N\u{a0}m/rad, {} N\u{a0}m\u{a0}s/rad", gains(proportional_gain), gains(derivative_gain))
        }
        PostCaptureControl::Damping { derivative_gain } => {
            format!("damping, {} N\u{a0}m\u{a0}s/rad", gains(derivative_gain))
        }
        PostCaptureControl::Stabilise { derivative_gain, base_gain, base_torque_limit } => {
            let rates = format!("stabilise, joints {} 1/s, base {} 1/s", gains(derivative_gain), short(*base_gain));
            let torque = base_torque_limit.map(|limit| format!("; base torque of at most {} N\u{a0}m", short(limit)));
            rates + &torque.unwrap_or_default()
        }
        PostCaptureControl::Own { name, numbers } => own_law(name, numbers),
    }
}

fn own_law(name: &str, numbers: &LawNumbers) -> String {
    let numbers = numbers.iter().map(|(key, number)| format!(", {key} {}", short(number)));
    format!("{name}, a law of this program{}", numbers.collect::<String>())
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
        Tracking::Own { name, numbers } => own_law(name, numbers),
        Tracking::ProportionalDerivative { proportional_gain, derivative_gain } => {
            format!("PD, {} N\u{a0}m/rad, {} N\u{a0}m\u{a0}s/rad", gains(proportional_gain), gains(derivative_gain))
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

fn targets(scenario: &Scenario) -> String {
    let mut table = Table::new(&[
        Left("target"),
        Left("arm"),
        Right("mass [kg]"),
        Right("inertia [kg m²]"),
        Left("contact [m]"),
        Left("position [m]"),
        Left("from robot's COM [m]"),
    ]);
    for target in &scenario.targets {
        let mut contacts = target.contacts.iter().map(|contact| {
            let at = match scenario.contact.detection {
                Detection::Time => point(contact.point),
                Detection::Event => "detected".to_owned(),
            };
            (scenario.layout.arms[contact.arm].name.clone(), at)
        });
        let (arm, contact) = contacts.next().unwrap_or_default();
        let reach = contact_reach(scenario, target);
        let reach = reach.map(|reach| format!("{} of at most {}", short(reach.distance), short(reach.limit)));
        let position = target.position.map(point).unwrap_or_default();
        let [mass, inertia] = [target.mass, target.inertia].map(short);
        table.row([target.name.clone(), arm, mass, inertia, contact, position, reach.unwrap_or_default()]);
        for (arm, contact) in contacts {
            let none = String::new;
            table.more([none(), arm, none(), none(), contact, none(), none()]);
        }
    }
    format!("\n{}", table.text())
}

fn cases(scenario: &Scenario) -> String {
    let own = scenario.variants.iter().flat_map(|variant| &variant.scenario.cases);
    let mut cases: Vec<_> = scenario.cases.iter().chain(own).collect();
    cases.sort_by_key(|case| case.index);
    let number = count(cases.len(), "case");
    let width = cases.iter().map(|case| case.name.len()).fold(12, usize::max);
    let mut out = format!("\n  {number}, target twists [ω, vx, vy] in rad/s, m/s, and what the contacts do\n");
    for case in cases {
        let each = scenario.targets.iter().zip(&case.target_twists).zip(case.kinds.iter().zip(&case.restitutions));
        let targets: Vec<_> = each
            .map(|((target, twist), (kinds, restitution))| {
                format!("{} {} {}", target.name, list(twist), contacts(kinds, *restitution))
            })
            .collect();
        let (first, next) = (format!("  {:<width$}", case.name), " ".repeat(2 + width));
        out.extend(wrap(&first, &next, &targets.join(", ")).iter().flat_map(|line| [line.as_str(), "\n"]));
        if let Some(variant) = scenario.variant(&case.name) {
            let own = format!("its own approach, with {}", variant.values());
            out.extend(wrap(&next, &next, &own).iter().flat_map(|line| [line.as_str(), "\n"]));
        }
    }
    out
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
