//! The table that `run` prints: approach, impulses, balances and residual motion of every case.

use super::impacts::impacts;
use crate::capture::clearance::{LeastDistance, Overlap};
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::impact::ImpactResult;
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::scenario::{Case, Detection, PostCaptureControl, Scenario, Tracking};
use crate::simulate::Phase;
use crate::simulate::conservation::ConservationErrors;
use std::fmt::{self, Write};

/// Distance of an end effector from its wanted contact point above which it is reported, m.
const REPORTED_MISS: f64 = 1e-4;

/// Number of overlaps of a case that are printed.
const SHOWN_OVERLAPS: usize = 3;

/// The results of a study in words and columns.
#[must_use]
pub fn table(scenario: &Scenario, study: &Study) -> String {
    let mut text = String::new();
    // writing to a String does not fail
    let _ = write_table(&mut text, scenario, study);
    text
}

fn write_table(out: &mut String, scenario: &Scenario, study: &Study) -> fmt::Result {
    approach(out, scenario, study)?;
    if study.cases.iter().any(|case| case.capture.is_some()) {
        impulses(out, scenario, study)?;
        balances(out, study)?;
        post_impact(out, scenario, study)?;
        residual_motion(out, study)?;
    }
    clearance(out, study)?;
    closest_approaches(out, scenario, study)?;
    thinned(out, study)
}

/// Says that figures and report do not show all samples of a long phase.
fn thinned(out: &mut String, study: &Study) -> fmt::Result {
    let after = study.cases.iter().filter_map(|case| Some((&case.name, &case.capture.as_ref()?.post_impact)));
    let own = study.cases.iter().filter_map(|case| Some((&case.name, case.approach.as_ref()?)));
    let approach = "approach".to_owned();
    for (name, phase) in std::iter::once((&approach, &study.approach)).chain(own).chain(after) {
        let (shown, all) = (phase.samples.len(), phase.sample_count());
        if shown < all {
            writeln!(out, "\n{name}: figures and report show {shown} of {all} samples")?;
        }
    }
    Ok(())
}

fn approach(out: &mut String, scenario: &Scenario, study: &Study) -> fmt::Result {
    let phase = &study.approach;
    let end = phase.end();
    writeln!(out, "{} on {}", scenario.name, scenario.layout.name)?;
    if let Some(found) = &study.inverse_kinematics {
        writeln!(
            out,
            "  final joint angles found in {} iterations [rad]: {}\n  (end effectors miss by {:.1e}; {})",
            found.iterations,
            list(&found.joint_angles, 6),
            found.residual,
            redundancy(found.spare_joints)
        )?;
    }
    if let Some(found) = &study.terminal_rates {
        writeln!(
            out,
            "  final joint rates found in {} iterations [rad/s]: {}\n  (generalized Jacobian at the final pose: \
             smallest/largest singular value {:.3})",
            found.iterations,
            list(&found.joint_rates, 6),
            found.singularity_margin
        )?;
    }
    let [yaw, x, y] = end.state.base_pose;
    let condition = match scenario.contact.detection {
        Detection::Time => "",
        Detection::Event => ", if there were no contact",
    };
    writeln!(out, "\nAfter the approach of {} s{condition}", phase.duration)?;
    writeln!(out, "  base: yaw {yaw:.6} rad, x {x:.6} m, y {y:.6} m")?;
    let end_effectors = end.end_effector_poses.iter().zip(&end.end_effector_twists);
    for (i, (arm, ([_, x, y], [omega, vx, vy]))) in scenario.layout.arms.iter().zip(end_effectors).enumerate() {
        let name = &arm.name;
        write!(out, "  end effector of {name}: ({x:.4}, {y:.4}) m, {omega:.4} rad/s, ({vx:.4}, {vy:.4}) m/s")?;
        if let Some((target, [wanted_x, wanted_y])) = wanted_contact(scenario, i) {
            let miss = libm::hypot(x - wanted_x, y - wanted_y);
            write!(out, "; misses the contact point of {target} by {miss:.4} m")?;
        }
        writeln!(out)?;
        if let Some(error) = study.terminal_errors.get(i).and_then(Option::as_ref) {
            let head =
                if error.reached { "misses the wanted pose by" } else { "DID NOT REACH the wanted pose: misses it by" };
            writeln!(out, "    {head} {error}")?;
        }
    }
    if let Some(margin) = phase.singularity_margin {
        writeln!(out, "  generalized Jacobian in the approach: smallest/largest singular value at least {margin:.4}")?;
        if let Tracking::ResolvedMotionRate { singularity_threshold, .. } = scenario.approach.tracking
            && margin < singularity_threshold
        {
            writeln!(
                out,
                "  (damped below {singularity_threshold}: the path passes a singular pose or leads to a pose out of reach)"
            )?;
        }
    }
    limits(out, "  ", phase)?;
    let ConservationErrors { momentum_drift, energy_error, center_of_mass_drift } = phase.drift;
    writeln!(
        out,
        "  momentum drift {momentum_drift:.1e}, energy error {energy_error:.1e}, centre-of-mass drift {center_of_mass_drift:.1e}"
    )
}

/// The target that an arm is to touch at the end of the approach, and the expected place of its contact point [x, y],
/// m.
fn wanted_contact(scenario: &Scenario, arm: usize) -> Option<(&str, [f64; 2])> {
    let at_time = scenario.targets.iter().filter(|_| scenario.contact.detection == Detection::Time);
    let mut touches = at_time.flat_map(|target| target.contacts.iter().map(move |touch| (target, touch)));
    let (target, touch) = touches.find(|(_, touch)| touch.arm == arm)?;
    let [x, y] = target.position?;
    Some((&target.name, [x + touch.point[0], y + touch.point[1]]))
}

/// Times at the torque limits, and violations of the joint limits, of a phase that has such limits.
fn limits(out: &mut String, indent: &str, phase: &Phase) -> fmt::Result {
    if !phase.saturation.joints.is_empty() {
        writeln!(out, "{indent}joint torques at their limits for [s]: {}", list(&phase.saturation.joints, 3))?;
    }
    let Some(violations) = &phase.limit_violations else { return Ok(()) };
    let sentences = violations.sentences();
    if sentences.is_empty() {
        return writeln!(out, "{indent}all joints within their limits");
    }
    sentences.iter().try_for_each(|sentence| writeln!(out, "{indent}{sentence}"))
}

/// Compares the number of joints with the number of prescribed coordinates.
fn redundancy(spare_joints: isize) -> String {
    match spare_joints {
        0 => "as many joints as prescribed coordinates".to_owned(),
        1.. => format!("{spare_joints} more joints than prescribed coordinates: smallest steps from the first guess"),
        _ => format!("{} more prescribed coordinates than joints, which happen to agree", -spare_joints),
    }
}

fn impulses(out: &mut String, scenario: &Scenario, study: &Study) -> fmt::Result {
    writeln!(out, "\nImpulse on the robot at each contact, |[fx, fy]| [N s]")?;
    let printed = scenario.cases.iter().any(|case| case.printed_impulses.iter().any(Option::is_some));
    let detected = scenario.contact.detection == Detection::Event;
    let column = match (detected, printed) {
        (true, _) => "at [s]",
        (false, true) => "as printed",
        (false, false) => "",
    };
    let force = if scenario.contact.duration.is_some() { "mean force [N]" } else { "" };
    let head = format!(
        "  {:<16} {:<10} {:<7} {:>10} {:>10} {column:>11} {force:>14}",
        "case", "arm", "kind", "exact", "paper eqs."
    );
    writeln!(out, "{}", head.trim_end())?;
    for (case, result) in scenario.cases.iter().zip(&study.cases) {
        let Some(capture) = &result.capture else { continue };
        impulses_of_case(out, scenario, study, (case, result))?;
        if capture.impact.contacts.is_empty() {
            writeln!(out, "  {:<16} no contact", case.name)?;
        }
        // a target that one arm touches is where the end effector puts it
        let missed = capture.impact.contacts.iter().filter(|result| result.contact.miss > REPORTED_MISS);
        for ImpactContact { target, arm, miss, .. } in missed.map(|result| result.contact) {
            let (arm, target) = (&scenario.layout.arms[arm].name, &scenario.targets[target].name);
            writeln!(
                out,
                "  {:<16} the end effector of {arm} is {miss:.4} m from its contact point on {target}",
                case.name
            )?;
        }
    }
    if printed && !detected {
        writeln!(out, "  (as printed: the scenario's printed_impulses, for comparison only; see README)")?;
    }
    Ok(())
}

fn impulses_of_case(
    out: &mut String,
    scenario: &Scenario,
    study: &Study,
    (case, result): (&Case, &CaseResult),
) -> fmt::Result {
    for event in impacts(study, result) {
        let literal = event.solution.paper.as_ref().map(ImpactResult::impulse_magnitudes);
        for result in &event.solution.contacts {
            let ImpactContact { target, arm, law, .. } = result.contact;
            let literal = literal.as_ref().and_then(|arms| arms[arm]);
            let literal = literal.map_or_else(|| "-".to_owned(), |value| format!("{value:.5}"));
            let last = match (scenario.contact.detection, case.printed_impulses[target]) {
                (Detection::Event, _) => format!("{:.4}", event.time),
                (Detection::Time, Some(printed)) => format!("{printed:.4}"),
                (Detection::Time, None) => String::new(),
            };
            let [_, fx, fy] = result.impulse;
            let (exact, kind) = (libm::hypot(fx, fy), law.kind().name());
            let force = scenario.contact.duration.map(|duration| format!("{:.3}", exact / duration));
            let row = format!(
                "  {:<16} {:<10} {kind:<7} {exact:>10.5} {literal:>10} {last:>11} {:>14}",
                case.name,
                scenario.layout.arms[arm].name,
                force.unwrap_or_default()
            );
            writeln!(out, "{}", row.trim_end())?;
        }
    }
    Ok(())
}

/// The least distance of each case and its overlaps.
fn clearance(out: &mut String, study: &Study) -> fmt::Result {
    writeln!(out, "\nLeast distance of bodies that are not joined, besides planned contacts; negative: depth")?;
    writeln!(out, "  {:<16} {:>12} {:>10}  between", "case", "distance [m]", "time [s]")?;
    for CaseResult { name, clearance, stopped, .. } in &study.cases {
        match clearance.least_shown() {
            Some(LeastDistance { distance, time, bodies: [a, b] }) => {
                let distance = if distance.abs() < 1e-5 { format!("{distance:.2e}") } else { format!("{distance:.6}") };
                writeln!(out, "  {name:<16} {distance:>12} {time:>10.3}  {a} and {b}")?;
            }
            None => writeln!(out, "  {name:<16} all bodies are joined")?,
        }
        let shown = clearance.overlaps.iter().take(SHOWN_OVERLAPS);
        shown.map(Overlap::sentence).try_for_each(|sentence| writeln!(out, "    {sentence}"))?;
        match clearance.overlaps.len().saturating_sub(SHOWN_OVERLAPS) {
            0 => {}
            1 => writeln!(out, "    and a later overlap, see summary.json")?,
            more => writeln!(out, "    and {more} later overlaps, see summary.json")?,
        }
        if let Some(time) = stopped {
            writeln!(out, "    the case ends with this overlap, at {time:.3} s (clearance.on_overlap)")?;
        }
    }
    Ok(())
}

/// End effectors that did not meet their targets, where contacts are found by detection.
fn closest_approaches(out: &mut String, scenario: &Scenario, study: &Study) -> fmt::Result {
    for case in &study.cases {
        for pair in &case.closest {
            let (arm, target) = (&scenario.layout.arms[pair.arm].name, &scenario.targets[pair.target].name);
            writeln!(
                out,
                "\n{}: the end effector of {arm} never meets {target}; the smallest distance is {:.4} m, at {:.2} s",
                case.name, pair.distance, pair.time
            )?;
        }
    }
    Ok(())
}

fn balances(out: &mut String, study: &Study) -> fmt::Result {
    writeln!(out, "\nRobot and targets together, before and after the impact")?;
    writeln!(
        out,
        "  {:<16} {:<6} {:>14} {:>14} {:>26}",
        "case", "model", "energy before", "energy after", "momentum jump [l, px, py]"
    )?;
    for case in &study.cases {
        for event in impacts(study, case) {
            balance(out, case, "exact", &event.solution.exact)?;
            if let Some(literal) = &event.solution.paper {
                balance(out, case, "paper", literal)?;
            }
        }
    }
    writeln!(out, "  (J; N m s, N s)")
}

fn balance(out: &mut String, case: &CaseResult, model: &str, result: &ImpactResult) -> fmt::Result {
    let [l, px, py] = result.momentum_jump;
    writeln!(
        out,
        "  {:<16} {:<6} {:>14.6} {:>14.6}   {:>9.1e} {:>9.1e} {:>9.1e}",
        case.name, model, result.kinetic_energy_before, result.kinetic_energy_after, l, px, py
    )
}

fn post_impact(out: &mut String, scenario: &Scenario, study: &Study) -> fmt::Result {
    let control = match scenario.post_impact.as_ref().map(|after| &after.control) {
        None | Some(PostCaptureControl::None) => "no torques".to_owned(),
        Some(control) => format!("control `{}`", control.name()),
    };
    writeln!(out, "\nAfter the impact, {control}")?;
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
            writeln!(out, "    constraints open by {open:.1e} (rad, m) at most, at a rate of {opening:.1e} 1/s")?;
        }
        limits(out, "    ", post_impact)?;
    }
    Ok(())
}

fn residual_motion(out: &mut String, study: &Study) -> fmt::Result {
    let each = study.cases.iter().filter_map(|case| {
        let capture = case.capture.as_ref()?;
        Some((case, &capture.post_impact, capture.residual_motion.as_ref()?))
    });
    let each: Vec<_> = each.collect();
    if each.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nResidual motion: rates [rad/s], momentum about the common COM of robot and targets [N m s, N s]")?;
    let [case, base, rigid, joints, l, px, py] = ["case", "base rate", "l/I", "joint rates", "l", "px", "py"];
    writeln!(out, "  {case:<16} {base:>10} {rigid:>10} {joints:>11} {l:>10} {px:>10} {py:>10}")?;
    for (case, phase, residual) in each {
        let [l, px, py] = residual.momentum;
        writeln!(
            out,
            "  {:<16} {:>10.6} {:>10.6} {:>11.1e} {l:>10.6} {px:>10.6} {py:>10.6}",
            case.name, residual.base_rate, residual.rigid_rate, residual.largest_joint_rate
        )?;
        if !residual.wheel_rates.is_empty() {
            writeln!(out, "    wheels turn at {} rad/s", list(&residual.wheel_rates, 6))?;
        }
        let end = phase.end();
        if end.base_torque.is_some() {
            writeln!(
                out,
                "    base torque: {:.6} N m s taken, {:.6} J of work, {:.3} s at its limit",
                -end.work.base_impulse, end.work.base_work, phase.saturation.base
            )?;
        }
    }
    Ok(())
}

fn list(values: &[f64], digits: usize) -> String {
    values.iter().map(|value| format!("{value:.digits$}")).collect::<Vec<_>>().join(", ")
}
