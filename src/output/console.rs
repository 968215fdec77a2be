//! The table that a run prints: what happened in each case, on one screen.

use crate::capture::contact_at_time::ImpactContact;
use crate::capture::impact::ImpactResult;
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::scenario::{Detection, PostCaptureControl, Scenario, Tracking};
use crate::simulate::Phase;
use crate::simulate::conservation::ConservationErrors;
use std::fmt::Write;

/// An end effector this far from where it is to touch its target is told of, m.
const APART: f64 = 1e-4;

/// The numbers of a study in words and columns.
#[must_use]
pub fn table(scenario: &Scenario, study: &Study) -> String {
    let mut text = String::new();
    // writing to a String does not fail
    let _ = write_table(&mut text, scenario, study);
    text
}

fn write_table(out: &mut String, scenario: &Scenario, study: &Study) -> std::fmt::Result {
    approach(out, scenario, study)?;
    if study.cases.iter().any(|case| case.capture.is_some()) {
        impulses(out, scenario, study)?;
        balances(out, scenario, study)?;
        remainders(out, study)?;
    }
    missed(out, scenario, study)
}

fn approach(out: &mut String, scenario: &Scenario, study: &Study) -> std::fmt::Result {
    let phase = &study.approach;
    let Some(end) = phase.end() else { return Ok(()) };
    writeln!(out, "{} on {}", scenario.name, scenario.layout.name)?;
    if let Some(inverse_kinematics) = &study.inverse_kinematics {
        writeln!(
            out,
            "  final joint angles designed in {} rounds [rad]: {}\n  (tips missed by {:.1e}; {})",
            inverse_kinematics.rounds,
            list(&inverse_kinematics.joint_angles, 6),
            inverse_kinematics.residual,
            spare(inverse_kinematics.spare_joints)
        )?;
    }
    if let Some(terminal_rates) = &study.terminal_rates {
        writeln!(
            out,
            "  end rates designed in {} rounds [rad/s]: {}\n  (generalized Jacobian at the final pose: smallest/largest singular value {:.3})",
            terminal_rates.iterations,
            list(&terminal_rates.joint_rates, 6),
            terminal_rates.singularity_margin
        )?;
    }
    let [yaw, x, y] = end.state.base_pose;
    let meanwhile = match scenario.contact.detection {
        Detection::Time => "",
        Detection::Event => ", had there been no contact",
    };
    writeln!(out, "\nAfter the approach of {} s{meanwhile}", phase.duration)?;
    writeln!(out, "  base: yaw {yaw:.6} rad, x {x:.6} m, y {y:.6} m")?;
    for (i, (arm, (pose, twist))) in
        scenario.layout.arms.iter().zip(end.end_effector_poses.iter().zip(&end.end_effector_twists)).enumerate()
    {
        write!(
            out,
            "  tip of {}: ({:.4}, {:.4}) m, {:.4} rad/s, ({:.4}, {:.4}) m/s",
            arm.name, pose[1], pose[2], twist[0], twist[1], twist[2]
        )?;
        let contact_at_time = scenario.targets.iter().filter(|_| scenario.contact.detection == Detection::Time);
        let mut touches = contact_at_time.flat_map(|target| target.touches.iter().map(move |touch| (target, touch)));
        let touch = touches.find(|(_, touch)| touch.arm == i);
        if let Some((target, touch, [x, y])) = touch.and_then(|(target, touch)| Some((target, touch, target.position?)))
        {
            let miss = (pose[1] - touch.contact[0] - x).hypot(pose[2] - touch.contact[1] - y);
            write!(out, "; misses the contact point of {} by {miss:.4} m", target.name)?;
        }
        writeln!(out)?;
        if let Some(miss) = study.terminal_errors.get(i).and_then(Option::as_ref) {
            let head =
                if miss.reached { "misses the wanted pose by" } else { "DID NOT REACH the wanted pose: misses it by" };
            writeln!(out, "    {head} {miss}")?;
        }
    }
    if let Some(margin) = phase.singularity_margin {
        let damped = match scenario.approach.tracking {
            Tracking::ResolvedMotionRate { singularity_threshold, .. } if margin < singularity_threshold => {
                format!(
                    "\n  (below {singularity_threshold} it was damped: the way is through a singular pose, or to one out of reach)"
                )
            }
            _ => String::new(),
        };
        writeln!(
            out,
            "  generalized Jacobian on the way: smallest/largest singular value {margin:.4} at the least{damped}"
        )?;
    }
    if !phase.saturation.joints.is_empty() {
        writeln!(out, "  joint torques at their limits for [s]: {}", list(&phase.saturation.joints, 3))?;
    }
    limit_violations(out, "  ", phase)?;
    let ConservationErrors { momentum_drift, energy_error, center_of_mass_drift } = phase.drift;
    writeln!(
        out,
        "  momentum drift {momentum_drift:.1e}, energy error {energy_error:.1e}, centre-of-mass drift {center_of_mass_drift:.1e}"
    )
}

/// How the joints kept their limits, where they have any.
fn limit_violations(out: &mut String, indent: &str, phase: &Phase) -> std::fmt::Result {
    let Some(limit_violations) = &phase.limit_violations else { return Ok(()) };
    let sentences = limit_violations.sentences();
    if sentences.is_empty() {
        return writeln!(out, "{indent}all joints within their limits");
    }
    sentences.iter().try_for_each(|sentence| writeln!(out, "{indent}{sentence}"))
}

/// What there is to choose beside the wanted poses.
fn spare(joints: isize) -> String {
    match joints {
        0 => "as many joints as wanted numbers".to_owned(),
        1.. => format!("{joints} more joints than wanted numbers: steps of least size from the first guess"),
        _ => format!("{} wanted numbers more than joints, which happen to agree", -joints),
    }
}

fn impulses(out: &mut String, scenario: &Scenario, study: &Study) -> std::fmt::Result {
    writeln!(out, "\nImpulse on the robot at each contact, |[fx, fy]| [N s]")?;
    let printed = scenario.cases.iter().any(|case| case.printed_impulses.iter().any(Option::is_some));
    let detected = scenario.contact.detection == Detection::Event;
    let column = match (detected, printed) {
        (true, _) => "at [s]",
        (false, true) => "as printed",
        (false, false) => "",
    };
    let duration = scenario.contact.duration;
    let force = if duration.is_some() { "mean force [N]" } else { "" };
    let head = format!(
        "  {:<16} {:<10} {:<7} {:>10} {:>10} {column:>11} {force:>14}",
        "case", "arm", "kind", "exact", "paper eqs."
    );
    writeln!(out, "{}", head.trim_end())?;
    for (case, result) in scenario.cases.iter().zip(&study.cases) {
        let Some(captured) = &result.capture else { continue };
        let first = result.approach(study).duration;
        let later = captured.further.iter().map(|one| (first + one.time, &one.impact));
        for (time, impact) in std::iter::once((first, &captured.impact)).chain(later) {
            for contact in &impact.contacts {
                let ImpactContact { target, arm, law, .. } = contact.touching;
                let Some(of) = scenario.layout.arms.get(arm) else { continue };
                let literal = impact.paper.as_ref().and_then(|paper| *paper.impulse_magnitudes().get(arm)?);
                let literal = literal.map_or_else(|| "-".to_owned(), |value| format!("{value:.5}"));
                let printed = case.printed_impulses.get(target).copied().flatten();
                let last = match (detected, printed) {
                    (true, _) => format!("{time:.4}"),
                    (false, Some(value)) => format!("{value:.4}"),
                    (false, None) => String::new(),
                };
                let [_, fx, fy] = contact.impulse;
                let (exact, kind) = (fx.hypot(fy), law.kind().name());
                let force = duration.map_or_else(String::new, |duration| format!("{:.3}", exact / duration));
                let row = format!(
                    "  {:<16} {:<10} {kind:<7} {exact:>10.5} {literal:>10} {last:>11} {force:>14}",
                    case.name, of.name
                );
                writeln!(out, "{}", row.trim_end())?;
            }
        }
        if captured.impact.contacts.is_empty() {
            writeln!(out, "  {:<16} no contact", case.name)?;
        }
        // of one arm, the target is where the end effector puts it
        let apart = captured.impact.contacts.iter().filter(|contact| contact.touching.miss > APART);
        for ImpactContact { target, arm, miss, .. } in apart.map(|contact| contact.touching) {
            let (of, target) = (scenario.layout.arms.get(arm), scenario.targets.get(target));
            let (Some(of), Some(target)) = (of, target) else { continue };
            let (of, target) = (&of.name, &target.name);
            writeln!(out, "  {:<16} the tip of {of} is {miss:.4} m from its contact point on {target}", case.name)?;
        }
    }
    if printed && !detected {
        writeln!(out, "  (as printed: the scenario's printed_impulses, for comparison only; README says more)")?;
    }
    Ok(())
}

/// End effectors and targets that were to meet and did not.
fn missed(out: &mut String, scenario: &Scenario, study: &Study) -> std::fmt::Result {
    for case in &study.cases {
        for pair in &case.closest {
            let arm = scenario.layout.arms.get(pair.arm).map_or("", |arm| arm.name.as_str());
            let target = scenario.targets.get(pair.target).map_or("", |target| target.name.as_str());
            writeln!(
                out,
                "\n{}: the tip of {arm} never meets {target}; at {:.2} s it is {:.4} m from it",
                case.name, pair.time, pair.distance
            )?;
        }
    }
    Ok(())
}

fn balances(out: &mut String, scenario: &Scenario, study: &Study) -> std::fmt::Result {
    writeln!(out, "\nRobot and targets together, before and after the impact")?;
    writeln!(
        out,
        "  {:<16} {:<6} {:>14} {:>14} {:>26}",
        "case", "model", "energy before", "energy after", "momentum jump [l, px, py]"
    )?;
    for case in &study.cases {
        let Some(captured) = &case.capture else { continue };
        let later = captured.further.iter().map(|one| &one.impact);
        for impact in std::iter::once(&captured.impact).chain(later) {
            balance(out, case, "exact", &impact.exact)?;
            if let Some(literal) = &impact.paper {
                balance(out, case, "paper", literal)?;
            }
        }
    }
    let torques = match scenario.post_impact.as_ref().map(|after| &after.control) {
        None | Some(PostCaptureControl::None) => "no torques".to_owned(),
        Some(control) => format!("control `{}`", control.name()),
    };
    writeln!(out, "  (J; N m s, N s)\n\nAfter the impact, {torques}")?;
    let [momentum, energy, motion] = ["momentum drift", "energy error", "COM drift"];
    writeln!(out, "  {:<16} {:>10} {momentum:>15} {energy:>13} {motion:>10}", "case", "time [s]")?;
    for case in &study.cases {
        let Some(CaptureResult { post_impact, .. }) = &case.capture else { continue };
        let ConservationErrors { momentum_drift, energy_error, center_of_mass_drift } = post_impact.drift;
        writeln!(
            out,
            "  {:<16} {:>10} {momentum_drift:>15.1e} {energy_error:>13.1e} {center_of_mass_drift:>10.1e}",
            case.name, post_impact.duration
        )?;
        let [open, opening] = post_impact.constraint_errors;
        if open > 0.0 {
            writeln!(out, "    what is held is open by {open:.1e} (rad, m) at most, and opens by {opening:.1e} 1/s")?;
        }
        limit_violations(out, "    ", post_impact)?;
    }
    Ok(())
}

fn remainders(out: &mut String, study: &Study) -> std::fmt::Result {
    let each = study.cases.iter().filter_map(|case| {
        let captured = case.capture.as_ref()?;
        Some((case, &captured.post_impact, captured.remainder.as_ref()?))
    });
    let each: Vec<_> = each.collect();
    if each.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "\nWhat remains of the motion then: rates [rad/s], momentum about the COM of the whole [N m s, N s]"
    )?;
    let head = ["case", "base rate", "l/I", "joint rates", "l", "px", "py"];
    let [case, base, rigid, joints, l, px, py] = head;
    writeln!(out, "  {case:<16} {base:>10} {rigid:>10} {joints:>11} {l:>10} {px:>10} {py:>10}")?;
    for (case, phase, left) in each {
        let [l, px, py] = left.momentum;
        writeln!(
            out,
            "  {:<16} {:>10.6} {:>10.6} {:>11.1e} {l:>10.6} {px:>10.6} {py:>10.6}",
            case.name, left.base_rate, left.rigid_rate, left.largest_joint_rate
        )?;
        if !left.wheel_rates.is_empty() {
            writeln!(out, "    wheels turn at {} rad/s", list(&left.wheel_rates, 6))?;
        }
        if let Some(end) = phase.end().filter(|end| end.base_torque.is_some()) {
            writeln!(
                out,
                "    the base torque took {:.6} N m s and did {:.6} J; {:.3} s at its limit",
                -end.work.base_impulse, end.work.base_work, phase.saturation.base
            )?;
        }
        if !phase.saturation.joints.is_empty() {
            writeln!(out, "    joint torques at their limits for [s]: {}", list(&phase.saturation.joints, 3))?;
        }
    }
    Ok(())
}

fn balance(out: &mut String, case: &CaseResult, model: &str, result: &ImpactResult) -> std::fmt::Result {
    let [l, px, py] = result.momentum_jump;
    writeln!(
        out,
        "  {:<16} {:<6} {:>14.6} {:>14.6}   {:>9.1e} {:>9.1e} {:>9.1e}",
        case.name, model, result.kinetic_energy_before, result.kinetic_energy_after, l, px, py
    )
}

fn list(values: &[f64], digits: usize) -> String {
    values.iter().map(|value| format!("{value:.digits$}")).collect::<Vec<_>>().join(", ")
}
