//! Impacts and motion of whole studies against the reference in maximal coordinates, from the study's own states.

use crate::{Silent, scenario};
use planar_capture::capture::impact::{ImpactResult, ImpactSolution};
use planar_capture::capture::{CaptureResult, CaseResult, Study, study};
use planar_capture::contact;
use planar_capture::outline::Outline;
use planar_capture::owned::RobotState;
use planar_capture::registry;
use planar_capture::scenario::{PostCaptureControl, Scenario};
use planar_proof::maximal::body::Body;
use planar_proof::maximal::impact::{Contact, Kind, ProductImpact, impact};
use planar_proof::maximal::motion::run;
use planar_proof::maximal::system::System;
use planar_proof::{assert_close, close, tolerance};

/// Runs a study that is sampled at every step.
fn run_study(scenario: &Scenario) -> Study {
    let model = registry::generated(&scenario.layout).expect("generated code");
    let run = study(scenario, &|| model.clone_box(), 0.005, &mut Silent);
    run.unwrap_or_else(|error| panic!("{}: {error}", scenario.name))
}

/// Robot and targets as free bodies, with the constraints of earlier captures.
fn system(
    scenario: &Scenario,
    motion: &RobotState,
    targets: &[planar_capture::body::Body<f64>],
    constraints: &[Touch],
) -> System {
    let RobotState { base_pose, joint_angles, base_twist, joint_rates } = motion;
    let mut all = System::new(&scenario.layout, *base_pose, joint_angles, *base_twist, joint_rates);
    for target in targets {
        all.add(Body { mass: target.mass, inertia: target.inertia, pose: target.pose, twist: target.twist });
    }
    let captures = constraints.iter().filter_map(|touch| touch.contact(&all).constraint(&all)).collect();
    all.captures = captures;
    all
}

/// A contact of an arm with a target.
#[derive(Clone, Copy)]
struct Touch {
    arm: usize,
    target: usize,
    kind: Kind,
}

impl Touch {
    fn contact(&self, all: &System) -> Contact {
        Contact::new(all, self.arm, 1 + all.joints.len() + self.target, self.kind)
    }
}

/// Signed distance of an end effector from the convex outline of a target, and the outward normal, inertial axes.
fn signed_distance(scenario: &Scenario, all: &System, arm: usize, target: usize) -> (f64, [f64; 2]) {
    let body = all.bodies[1 + all.joints.len() + target];
    let offset = all.end_effector(arm) - body.com();
    match &scenario.targets[target].outline {
        Outline::Disc { radius, .. } => (offset.norm() - radius, (offset / offset.norm()).into()),
        Outline::Capsule { .. } => panic!("targets are discs and polygons"),
        Outline::Polygon { corners } => {
            let next = corners.iter().cycle().skip(1);
            let of_edge = |(a, b): (&[f64; 2], &[f64; 2])| {
                let (a, b) = (body.rotated((*a).into()), body.rotated((*b).into()));
                let along = (b - a) / (b - a).norm();
                let normal = nalgebra::Vector2::new(along.y, -along.x);
                (normal.dot(&(offset - a)), normal.into())
            };
            let far = (f64::NEG_INFINITY, [0.0; 2]);
            corners.iter().zip(next).map(of_edge).fold(far, |most, edge| if edge.0 > most.0 { edge } else { most })
        }
    }
}

/// Velocities and impulses of a study's impact.
fn product_impact(found: &ImpactSolution) -> ProductImpact {
    let ImpactResult { base_twist_after, joint_rates_after, .. } = &found.exact;
    let velocities = base_twist_after.iter().chain(joint_rates_after).chain(found.target_twists.as_flattened());
    let impulses = found.contacts.iter().map(|contact| contact.impulse).collect();
    ProductImpact { velocities: velocities.copied().collect(), impulses }
}

/// Compares an impact of the study with the reference's; returns its captures.
fn check_impact(scenario: &Scenario, before: &System, capture: &ImpactSolution) -> Vec<Touch> {
    let mut touches = vec![];
    for contact in &capture.contacts {
        let touching = contact.contact;
        let kind = match touching.law {
            contact::ContactLaw::Rigid => Kind::Rigid,
            contact::ContactLaw::Pin => Kind::Pin,
            contact::ContactLaw::Bounce { normal, restitution } => {
                let (_, expected) = signed_distance(scenario, before, touching.arm, touching.target);
                assert_close("normal", &normal, &expected, tolerance::IN_SERIES);
                Kind::Bounce { normal, restitution }
            }
        };
        let body = &before.bodies[1 + before.joints.len() + touching.target];
        let offset = before.end_effector(touching.arm) - body.com();
        assert_close("offset", &touching.offset, offset.as_slice(), tolerance::STRAIGHT);
        touches.push(Touch { arm: touching.arm, target: touching.target, kind });
    }
    let contacts: Vec<_> = touches.iter().map(|touch| touch.contact(before)).collect();
    let expected = impact(before, &contacts);
    let mut after = before.clone();
    after.apply(&contacts, &expected);
    product_impact(capture).assert_agrees(
        &after,
        &expected.impulses,
        tolerance::CONTACT_IMPACT / expected.margin.powi(2),
    );
    touches.retain(|touch| !matches!(touch.kind, Kind::Bounce { .. }));
    touches
}

/// Compares the motion from sample `from`, for at most `duration`, with that of the reference.
fn check_motion(scenario: &Scenario, captured: &CaptureResult, from: usize, constraints: &[Touch], duration: f64) {
    let samples = &captured.post_impact.samples;
    let to = samples.iter().rposition(|sample| sample.time <= samples[from].time + duration + 1e-9).expect("a sample");
    let mut all = system(scenario, &samples[from].state, &captured.targets[from], constraints);
    let after = scenario.post_impact.as_ref().expect("a motion after it");
    let law = |_: f64, angles: &[f64], rates: &[f64]| match &after.control {
        PostCaptureControl::None => vec![0.0; angles.len()],
        PostCaptureControl::Damping { derivative_gain } => {
            rates.iter().zip(derivative_gain).map(|(rate, k)| -k * rate).collect()
        }
        other => panic!("{other:?}"),
    };
    run(&mut all, samples[to].time - samples[from].time, 0.25, &law);
    let end = &samples[to].state;
    close("angles", &end.joint_angles, &all.joint_angles(), tolerance::MAXIMAL_MOTION);
    close("rates", &end.joint_rates, &all.joint_rates(), tolerance::MAXIMAL_MOTION);
    close("base pose", &end.base_pose, &all.bodies[0].pose, tolerance::MAXIMAL_MOTION);
    for (target, body) in captured.targets[to].iter().zip(&all.bodies[1 + all.joints.len()..]) {
        close("target pose", &target.pose, &body.pose, tolerance::MAXIMAL_MOTION);
        close("target twist", &target.twist, &body.twist, tolerance::MAXIMAL_MOTION);
    }
}

/// Checks all impacts and the motion after each; returns the number of impacts.
fn check_case(scenario: &Scenario, study: &Study, case: &CaseResult) -> usize {
    let Some(captured) = &case.capture else { return 0 };
    let before = &case.approach(study).end().state;
    let mut constraints = check_impact(scenario, &system(scenario, before, &case.targets, &[]), &captured.impact);
    let first = captured.later_impacts.first().map_or(f64::INFINITY, |further| further.time);
    check_motion(scenario, captured, 0, &constraints, first.min(4.0));
    for further in &captured.later_impacts {
        // the instant has two samples, before and after the impact
        let at = captured.post_impact.samples.iter().position(|sample| sample.time >= further.time).expect("a sample");
        let before = system(scenario, &captured.post_impact.samples[at].state, &captured.targets[at], &constraints);
        constraints.extend(check_impact(scenario, &before, &further.impact));
        let next = captured.later_impacts.iter().map(|one| one.time).find(|time| *time > further.time);
        if at + 1 < captured.post_impact.samples.len() {
            check_motion(
                scenario,
                captured,
                at + 1,
                &constraints,
                (next.unwrap_or(f64::INFINITY) - further.time).min(4.0),
            );
        }
    }
    1 + captured.later_impacts.len()
}

fn check_scenario(name: &str) -> (Scenario, Study, Vec<usize>) {
    let scenario = scenario(name);
    let study = run_study(&scenario);
    assert_eq!(study.audit_failures(), Vec::<String>::new(), "{name}");
    let impacts = study.cases.iter().map(|case| check_case(&scenario, &study, case)).collect();
    (scenario, study, impacts)
}

#[test]
fn both_arms_on_one_large_target() {
    let (_, study, impacts) = check_scenario("large_target");
    assert!(impacts.iter().all(|count| *count == 1), "{impacts:?}");
    for case in &study.cases {
        let captured = case.capture.as_ref().expect("a capture");
        assert_eq!(captured.impact.contacts.len(), 2);
        let [open, opening] = captured.post_impact.constraint_errors;
        assert!(open.max(opening) <= tolerance::CONSTRAINT_ERROR, "{open:e} {opening:e}");
    }
}

#[test]
fn three_arms_and_three_kinds() {
    let (_, study, impacts) = check_scenario("three_arms");
    assert_eq!(impacts, [1]);
    let contacts = &study.cases[0].capture.as_ref().expect("a capture").impact.contacts;
    let names: Vec<_> = contacts.iter().map(|result| result.contact.law.kind().name()).collect();
    assert_eq!(names, ["rigid", "pin", "bounce"]);
}

#[test]
fn one_arm_on_a_spinning_target() {
    let (_, _, impacts) = check_scenario("spinning_target");
    assert!(!impacts.is_empty() && impacts.iter().all(|count| *count == 1), "{impacts:?}");
}

/// A grasp that does not close has no effect on its target.
#[test]
fn a_missed_target_moves_freely() {
    let (scenario, study, _) = check_scenario("missed_grasp");
    let mut missed = 0;
    for (case, result) in scenario.cases.iter().zip(&study.cases) {
        let captured = result.capture.as_ref().expect("a case");
        for (i, kinds) in case.kinds.iter().enumerate() {
            if kinds.iter().any(Option::is_some) {
                continue;
            }
            missed += 1;
            assert_close("twist", &captured.impact.target_twists[i], &case.target_twists[i], 0.0);
            let start = result.targets[i];
            for (sample, targets) in captured.post_impact.samples.iter().zip(&captured.targets) {
                assert_close("twist", &targets[i].twist, &start.twist, 0.0);
                assert_close("pose", &targets[i].pose, &start.after(sample.time).pose, tolerance::IN_SERIES);
            }
        }
    }
    assert!(missed >= 3, "{missed}");
}

/// End effectors are on the outline at contacts, to 1e-10 m, and outside before and after; elastic impacts keep the
/// energy.
#[test]
fn rebounds_are_detected() {
    let (scenario, study, impacts) = check_scenario("elastic_rebound");
    assert!(impacts.iter().sum::<usize>() >= 3, "{impacts:?}");
    for (case, result) in scenario.cases.iter().zip(&study.cases) {
        let approach = result.approach(&study);
        let touches: Vec<_> =
            scenario.targets.iter().enumerate().map(|(i, target)| (i, target.contacts[0].arm)).collect();
        for (i, sample) in approach.samples.iter().enumerate() {
            let targets: Vec<_> = result.targets_before(approach.duration - sample.time);
            let all = system(&scenario, &sample.state, &targets, &[]);
            let least = if i + 1 == approach.samples.len() { -tolerance::DETECTED } else { 0.0 };
            for (target, arm) in &touches {
                let (distance, _) = signed_distance(&scenario, &all, *arm, *target);
                assert!(distance > least, "{}: {distance:e} m at {} s", case.name, sample.time);
            }
        }
        let Some(captured) = &result.capture else { continue };
        for (sample, targets) in captured.post_impact.samples.iter().zip(&captured.targets) {
            let all = system(&scenario, &sample.state, targets, &[]);
            for (target, arm) in &touches {
                let (distance, _) = signed_distance(&scenario, &all, *arm, *target);
                assert!(distance > -tolerance::DETECTED, "{}: {distance:e} m at {} s", case.name, sample.time);
            }
        }
        let end = approach.end();
        let all = system(&scenario, &end.state, &result.targets, &[]);
        let distances = captured
            .impact
            .contacts
            .iter()
            .map(|result| signed_distance(&scenario, &all, result.contact.arm, result.contact.target).0);
        assert!(
            distances.clone().all(|distance| distance.abs() <= tolerance::DETECTED),
            "{:?}",
            distances.collect::<Vec<_>>()
        );
        let exact = &captured.impact.exact;
        let kept = exact.kinetic_energy_after / exact.kinetic_energy_before;
        if case.restitutions.iter().all(|e| *e >= 1.0) {
            assert_close("energy", &[kept], &[1.0], tolerance::IDENTITY);
        } else {
            assert!(kept < 1.0 - 1e-6, "{kept}");
        }
    }
}
