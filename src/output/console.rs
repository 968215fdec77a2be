//! The table that `run` prints: approach, impulses, balances and residual motion of every case.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::console::table;
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let table = table(&scenario, &study);
//! assert!(table.contains("After the approach of 20 s"));
//! assert!(table.lines().all(|line| line.chars().count() <= 100));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::impacts::impacts;
use super::printed_impulses::are_comparable;
use crate::capture::clearance::{ClosestApproach, LeastDistance, Overlap};
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::impact::ImpactResult;
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::output::study_part::StudyPart;
use crate::plain_text::Column::{Left, Right};
use crate::plain_text::{Column, Table, sentence};
use crate::scenario::{Case, Detection, OnOverlap, PostCaptureControl, Scenario, Tracking};
use crate::simulate::Phase;
use crate::simulate::conservation::ConservationErrors;

/// Distance of an end effector from its wanted contact point above which it is reported, m.
const REPORTED_MISS: f64 = 1e-4;

/// Distance of an end effector from its contact point up to which that is hit, m: what four decimals do not show.
const HIT: f64 = 5e-5;

/// Number of overlaps of a case that are printed.
const SHOWN_OVERLAPS: usize = 3;

/// The results of a study in words and columns, at most 100 characters wide where names are not longer than those.
#[must_use]
pub fn table(scenario: &Scenario, study: &Study) -> String {
    let mut out = approach(scenario, study);
    if study.cases.iter().any(|case| case.capture.is_some()) {
        out += &impulses(scenario, study);
        out += &balances(scenario, study);
        out += &post_impact(scenario, study);
        out += &residual_motion(study);
    }
    out + &clearance(study) + &closest_approaches(scenario, study) + &thinned(study)
}

/// The tables of all parts of a run, each case with values of its own after these.
#[must_use]
pub fn table_of_parts(parts: &[StudyPart<'_>]) -> String {
    let each = parts.iter().map(|StudyPart { scenario, variant, study, .. }| {
        let own = variant.map(|variant| sentence("", &format!("Case {}: {}", variant.name(), variant.values())));
        own.unwrap_or_default() + &table(scenario, study)
    });
    each.collect::<Vec<_>>().join("\n")
}

/// Says that figures and report do not show all samples of a long phase.
fn thinned(study: &Study) -> String {
    let after = study.cases.iter().filter_map(|case| Some((&case.name, &case.capture.as_ref()?.post_impact)));
    let own = study.cases.iter().filter_map(|case| Some((&case.name, case.approach.as_ref()?)));
    let approach = "approach".to_owned();
    let phases = std::iter::once((&approach, &study.approach)).chain(own).chain(after);
    let phases = phases.map(|(name, phase)| (name, phase.samples.len(), phase.sample_count()));
    let lines = phases
        .filter(|(_, shown, all)| shown < all)
        .map(|(name, shown, all)| format!("\n{name}: figures and report show {shown} of {all} samples\n"));
    lines.collect::<Vec<_>>().concat()
}

fn approach(scenario: &Scenario, study: &Study) -> String {
    let phase = &study.approach;
    let end = phase.end();
    let mut out = format!("{} on {}\n", scenario.name, scenario.layout.name);
    if let Some(found) = &study.inverse_kinematics {
        out += &line(&format!(
            "final joint angles found in {} iterations [rad]: {} (end effectors miss by {:.1e}; {})",
            found.iterations,
            list(&found.joint_angles, 6),
            found.residual,
            redundancy(found.spare_joints)
        ));
    }
    if let Some(found) = &study.terminal_rates {
        out += &line(&format!(
            "final joint rates found in {} iterations [rad/s]: {} (generalized Jacobian of the given \
             twists at the final pose, SI units: smallest/largest singular value {:.3})",
            found.iterations,
            list(&found.joint_rates, 6),
            found.singularity_margin
        ));
    }
    let condition = match scenario.contact.detection {
        Detection::Time => "",
        Detection::Event => ", if there were no contact",
    };
    let [yaw, x, y] = end.state.base_pose.map(|part| fixed(part, 6));
    out.push('\n');
    out += &sentence("", &format!("After the approach of {} s{condition}", phase.duration));
    out += &line(&format!("base: yaw {yaw} rad, x {x} m, y {y} m"));
    out += &end_effectors(scenario, study);
    if let Some(margin) = phase.singularity_margin {
        out += &line(&format!(
            "generalized Jacobian in the approach: smallest/largest singular value at least {margin:.4}"
        ));
        if let Tracking::ResolvedMotionRate { singularity_threshold, .. } = scenario.approach.tracking
            && margin < singularity_threshold
        {
            out += &line(&format!(
                "(damped below {singularity_threshold}: the path passes a singular pose or leads to a pose out of reach)"
            ));
        }
    }
    out.extend(limits(scenario, phase).iter().map(|text| line(text)));
    let ConservationErrors { momentum_drift, energy_error, center_of_mass_drift } = phase.drift;
    out + &line(&format!(
        "momentum drift {momentum_drift:.1e}, energy error {energy_error:.1e}, \
         centre-of-mass drift {center_of_mass_drift:.1e}"
    ))
}

/// Where the end effectors are at the end of the approach, and what they should have met there.
fn end_effectors(scenario: &Scenario, study: &Study) -> String {
    let end = study.approach.end();
    let mut table = Table::new(&[
        Left("end effector"),
        Left("at [m]"),
        Left("velocity [m/s]"),
        Right("rate [rad/s]"),
        Left("contact point"),
    ]);
    let point = |point: [f64; 2]| format!("({})", list(&point, 4));
    let poses = end.end_effector_poses.iter().zip(&end.end_effector_twists);
    for (i, (arm, ([_, x, y], [omega, vx, vy]))) in scenario.layout.arms.iter().zip(poses).enumerate() {
        let wanted = wanted_contact(scenario, i).map(|(target, [wanted_x, wanted_y])| {
            let miss = libm::hypot(x - wanted_x, y - wanted_y);
            if miss < HIT { format!("{target}: hit") } else { format!("{target}: missed by {miss:.4} m") }
        });
        table.row([arm.name.clone(), point([*x, *y]), point([*vx, *vy]), fixed(*omega, 4), wanted.unwrap_or_default()]);
        if let Some(error) = study.terminal_errors.get(i).and_then(Option::as_ref) {
            let head = if error.reached { "wanted pose reached, within" } else { "wanted pose NOT REACHED: missed by" };
            table.note(format!("{head} {error}"));
        }
    }
    table.text()
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
fn limits(scenario: &Scenario, phase: &Phase) -> Vec<String> {
    let mut sentences = Vec::new();
    let times = &phase.saturation.joints;
    let at_limits = times.iter().enumerate().filter(|(_, time)| **time > 0.0);
    let at_limits: Vec<String> =
        at_limits.map(|(i, time)| format!("{} for {} s", scenario.layout.joint_name(i), fixed(*time, 3))).collect();
    if !at_limits.is_empty() {
        sentences.push(format!("joint torques at their limits: {}", at_limits.join(", ")));
    } else if !times.is_empty() {
        sentences.push("joint torques never at their limits".to_owned());
    }
    if let Some(violations) = &phase.limit_violations {
        let found = violations.sentences();
        sentences.extend(if found.is_empty() { vec!["all joints within their limits".to_owned()] } else { found });
    }
    sentences
}

/// Compares the number of joints with the number of prescribed coordinates.
fn redundancy(spare_joints: isize) -> String {
    match spare_joints {
        0 => "as many joints as prescribed coordinates".to_owned(),
        1.. => format!("{spare_joints} more joints than prescribed coordinates: smallest steps from the first guess"),
        _ => format!("{} more prescribed coordinates than joints, which happen to agree", -spare_joints),
    }
}

fn impulses(scenario: &Scenario, study: &Study) -> String {
    let printed = are_comparable(scenario) && scenario.contact.detection == Detection::Time;
    let mut table = Table::new(&[
        Left("case"),
        Left("arm"),
        Left("target"),
        Left("kind"),
        Right("exact"),
        Right("paper eqs."),
        Right("as printed"),
        Right("at [s]"),
        Right("mean force [N]"),
    ]);
    for (case, result) in scenario.cases.iter().zip(&study.cases) {
        let Some(capture) = &result.capture else { continue };
        impulses_of_case(&mut table, scenario, study, (case, result), printed);
        if capture.impact.contacts.is_empty() {
            table.note(format!("{}: no contact", case.name));
        }
        // a target that one arm touches is where the end effector puts it
        let missed = capture.impact.contacts.iter().filter(|result| result.contact.miss > REPORTED_MISS);
        for ImpactContact { target, arm, miss, .. } in missed.map(|result| result.contact) {
            let (arm, target) = (&scenario.layout.arms[arm].name, &scenario.targets[target].name);
            table.note(format!("the end effector of {arm} is {miss:.4} m from its contact point on {target}"));
        }
    }
    let mut out = format!("\nImpulse on the robot at each contact, |[fx, fy]| [N s]\n{}", table.text());
    if printed {
        out += &line("(as printed: in Table 5 of the paper, which does not follow from its equations; for comparison)");
    }
    out
}

fn impulses_of_case(
    table: &mut Table,
    scenario: &Scenario,
    study: &Study,
    (case, result): (&Case, &CaseResult),
    printed: bool,
) {
    for event in impacts(study, result) {
        let literal = event.solution.paper.as_ref().map(ImpactResult::impulse_magnitudes);
        for result in &event.solution.contacts {
            let ImpactContact { target, arm, law, .. } = result.contact;
            let literal = literal.as_ref().and_then(|arms| arms[arm]);
            let printed = case.printed_impulses[target].filter(|_| printed);
            let [_, fx, fy] = result.impulse;
            let exact = libm::hypot(fx, fy);
            let force = scenario.contact.duration.map(|duration| fixed(exact / duration, 3));
            table.row([
                case.name.clone(),
                scenario.layout.arms[arm].name.clone(),
                scenario.targets[target].name.clone(),
                law.kind().name().to_owned(),
                fixed(exact, 5),
                literal.map(|value| fixed(value, 5)).unwrap_or_default(),
                printed.map(|value| fixed(value, 4)).unwrap_or_default(),
                time_of(scenario, event.time),
                force.unwrap_or_default(),
            ]);
        }
    }
}

/// The time of an impact, s, where impacts are found by detection; else it is the end of the approach.
fn time_of(scenario: &Scenario, time: f64) -> String {
    if scenario.contact.detection == Detection::Event { fixed(time, 4) } else { String::new() }
}

/// The least distance of each case and its overlaps.
fn clearance(study: &Study) -> String {
    let mut table = Table::new(&[Left("case"), Right("distance [m]"), Right("at [s]"), Left("between")]);
    for CaseResult { name, clearance, stopped, .. } in &study.cases {
        match clearance.least_shown() {
            Some(LeastDistance { distance, time, bodies: [a, b] }) => {
                let distance = if distance.abs() < 1e-5 { format!("{distance:.2e}") } else { fixed(*distance, 6) };
                table.row([name.clone(), distance, fixed(*time, 3), format!("{a} and {b}")]);
            }
            None => table.note(format!("{name}: all bodies are joined")),
        }
        let shown = clearance.overlaps.iter().take(SHOWN_OVERLAPS);
        shown.map(Overlap::sentence).for_each(|sentence| table.note(sentence));
        match clearance.overlaps.len().saturating_sub(SHOWN_OVERLAPS) {
            0 => {}
            1 => table.note("and a later overlap, see summary.json"),
            more => table.note(format!("and {more} later overlaps, see summary.json")),
        }
        if clearance.on_overlap != OnOverlap::Report && clearance.overlaps.iter().any(|overlap| overlap.is_default) {
            table.note("overlaps of default outlines are reported alone (clearance.on_overlap)");
        }
        if let Some(time) = stopped {
            table.note(format!("the case ends with this overlap, at {time:.3} s (clearance.on_overlap)"));
        }
    }
    format!(
        "\nLeast distance of bodies that are not joined, besides planned contacts; negative: depth\n{}",
        table.text()
    )
}

/// End effectors that did not meet their targets, where contacts are found by detection, and cases without an impact.
fn closest_approaches(scenario: &Scenario, study: &Study) -> String {
    let pair_of = |case: &str, pair: &ClosestApproach| {
        let (arm, target) = (&scenario.layout.arms[pair.arm].name, &scenario.targets[pair.target].name);
        let (distance, time) = (fixed(pair.distance, 4), fixed(pair.time, 2));
        format!(
            "\n{case}: the end effector of {arm} never meets {target};\n  \
             the smallest distance is {distance} m, at {time} s\n"
        )
    };
    let mut sentences = Vec::new();
    for case in &study.cases {
        sentences.extend(case.closest.iter().map(|pair| pair_of(&case.name, pair)));
        if scenario.post_impact.is_some() && case.capture.is_none() && case.stopped.is_none() {
            sentences.push(format!("\n{}: no impact, and so no motion after it\n", case.name));
        }
    }
    sentences.concat()
}

fn balances(scenario: &Scenario, study: &Study) -> String {
    let mut table = Table::new(&[
        Left("case"),
        Right("at [s]"),
        Left("model"),
        Right("energy before [J]"),
        Right("after [J]"),
        Right("jump of l [N m s]"),
        Right("px [N s]"),
        Right("py [N s]"),
    ]);
    for case in &study.cases {
        for event in impacts(study, case) {
            let models = [("exact", Some(&event.solution.exact)), ("paper", event.solution.paper.as_ref())];
            for (model, result) in models.into_iter().filter_map(|(model, result)| Some((model, result?))) {
                let [l, px, py] = result.momentum_jump.map(two_digits);
                let [before, after] =
                    [result.kinetic_energy_before, result.kinetic_energy_after].map(|energy| fixed(energy, 6));
                let time = time_of(scenario, event.time);
                table.row([case.name.clone(), time, model.to_owned(), before, after, l, px, py]);
            }
        }
    }
    format!("\nEnergy and momentum of robot and targets together, before and after the impact\n{}", table.text())
}

fn post_impact(scenario: &Scenario, study: &Study) -> String {
    let control = match scenario.post_impact.as_ref().map(|after| &after.control) {
        None | Some(PostCaptureControl::None) => "no torques".to_owned(),
        Some(control) => format!("control `{}`", control.name()),
    };
    let columns: [Column; 5] =
        [Left("case"), Right("time [s]"), Right("momentum drift"), Right("energy error"), Right("COM drift")];
    let mut table = Table::new(&columns);
    for case in &study.cases {
        let Some(CaptureResult { post_impact, .. }) = &case.capture else { continue };
        let ConservationErrors { momentum_drift, energy_error, center_of_mass_drift } = post_impact.drift;
        let [momentum, energy, motion] =
            [momentum_drift, energy_error, center_of_mass_drift].map(|error| format!("{error:.1e}"));
        table.row([case.name.clone(), post_impact.duration.to_string(), momentum, energy, motion]);
        let [open, opening] = post_impact.constraint_errors;
        if open > 0.0 {
            table.note(format!("constraints open by {open:.1e} (rad, m) at most, at a rate of {opening:.1e} 1/s"));
        }
        for sentence in limits(scenario, post_impact) {
            table.note(sentence);
        }
    }
    format!("\nAfter the impact, {control}\n{}", table.text())
}

fn residual_motion(study: &Study) -> String {
    let mut table = Table::new(&[
        Left("case"),
        Right("base rate"),
        Right("l/I"),
        Right("joint rates"),
        Right("l [N m s]"),
        Right("px [N s]"),
        Right("py [N s]"),
    ]);
    let each = study.cases.iter().filter_map(|case| {
        let capture = case.capture.as_ref()?;
        Some((case, &capture.post_impact, capture.residual_motion.as_ref()?))
    });
    let each: Vec<_> = each.collect();
    if each.is_empty() {
        return String::new();
    }
    for (case, phase, residual) in each {
        let [l, px, py] = residual.momentum.map(|part| fixed(part, 6));
        let [base, rigid] = [residual.base_rate, residual.rigid_rate].map(|rate| fixed(rate, 6));
        table.row([case.name.clone(), base, rigid, format!("{:.1e}", residual.largest_joint_rate), l, px, py]);
        if !residual.wheel_rates.is_empty() {
            table.note(format!("wheels turn at {} rad/s", list(&residual.wheel_rates, 6)));
        }
        let end = phase.end();
        if end.base_torque.is_some() {
            let [taken, work] = [-end.work.base_impulse, end.work.base_work].map(|part| fixed(part, 6));
            let limited = fixed(phase.saturation.base, 3);
            table.note(format!("base torque: {taken} N m s taken, {work} J of work, {limited} s at its limit"));
        }
    }
    format!(
        "\nResidual motion: rates [rad/s], momentum about the common COM of robot and held targets\n{}",
        table.text()
    )
}

/// A sentence in the block of a heading.
fn line(text: &str) -> String {
    sentence("  ", text)
}

/// Two significant digits, with a power of ten only for the very small and the large.
fn two_digits(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if (9.95..100.0).contains(&size) => format!("{value:.0}"),
        size if (0.995..9.95).contains(&size) => format!("{value:.1}"),
        size if (0.0995..0.995).contains(&size) => format!("{value:.2}"),
        size if (0.00995..0.0995).contains(&size) => format!("{value:.3}"),
        _ => format!("{value:.1e}"),
    }
}

/// With this number of decimals; zero has no sign.
fn fixed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(size) if size.chars().all(|c| c == '0' || c == '.') => size.to_owned(),
        _ => text,
    }
}

fn list(values: &[f64], digits: usize) -> String {
    values.iter().map(|value| fixed(*value, digits)).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::two_digits;

    #[test]
    fn numbers_have_powers_of_ten_only_where_they_need_them() {
        let shown = [0.0, -0.0, 1.0, 0.9123, -0.0204, 0.996, 9.96, 42.4, 123.0, 8.7e-19].map(two_digits);
        assert_eq!(shown, ["0", "0", "1.0", "0.91", "-0.020", "1.0", "10", "42", "1.2e2", "8.7e-19"]);
    }
}
