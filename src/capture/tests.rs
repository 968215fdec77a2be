//! Light targets that reach a robot at rest one after the other: times, contacts and what is not met; bodies that are
//! held, and terminal errors in words.

use crate::capture::approach::ApproachTracking;
use crate::capture::assembly::{Assembly, Attachment, TargetPlacement};
use crate::capture::clearance::ClearanceTracker;
use crate::capture::contact_detection::ContactDetection;
use crate::capture::contact_pair::ContactPair;
use crate::capture::post_capture::wheels;
use crate::capture::target_motion::TargetMotion;
use crate::capture::{CaseResult, Silent, Study, StudyError, study};
use crate::contact::ContactKind;
use crate::owned::RobotState;
use crate::registry;
use crate::scenario::{OnOverlap, PostCaptureControl, Scenario};
use crate::simulate::Phase;
use crate::simulate::stepper::Integrator;
use crate::simulate::system::Body;
use planar_proof::{assert_close, file, layout};

const ANGLES: [f64; 6] = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047];
const RADIUS: f64 = 0.2;

fn end_effectors() -> [[f64; 3]; 2] {
    let mut poses = [[0.0; 3]; 2];
    registry::generic(&layout("dual_arm_3r")).end_effector_poses(&[0.0; 3], &ANGLES, &mut poses).expect("poses");
    poses
}

/// A light disc that comes along y, `aside` of an end effector, and is there at a time.
struct Coming {
    arm: usize,
    speed: f64,
    time: f64,
    aside: f64,
}

/// The robot at rest for 10 s, and 6 s after the first contact.
fn meet(coming: &[Coming; 2], step: f64) -> Result<Study, StudyError> {
    run(&meeting(coming, step))
}

fn run(scenario: &Scenario) -> Result<Study, StudyError> {
    study(scenario, &|| registry::generic(&layout("dual_arm_3r")), 1.0, &mut Silent)
}

fn meeting(coming: &[Coming; 2], step: f64) -> Scenario {
    let poses = end_effectors();
    let target = |(i, Coming { arm, speed, time, aside }): (usize, &Coming)| {
        let [_, x, y] = poses[*arm];
        format!(
            "[[target]]\nname = \"t{i}\"\narm = \"arm{}\"\nmass = 1e-9\ninertia = 1e-10\nradius = {RADIUS}\n\
             position = [{}, {}]\ntwist = [0.0, 0.0, {speed}]\n",
            arm + 1,
            x + aside,
            y - RADIUS - speed * time
        )
    };
    let targets: String = coming.iter().enumerate().map(target).collect();
    let text = format!(
        "name = \"it\"\nlayout = \"dual_arm_3r\"\n[initial]\njoint_angles = {ANGLES:?}\n[approach]\nduration = 10.0\n\
         step = {step}\ntrajectory = \"cycloidal\"\ntracking = \"exact\"\nfinal_joint_angles = {ANGLES:?}\n\
         [contact]\ndetection = \"event\"\n{targets}[post_impact]\nduration = 6.0\nstep = {step}\n"
    );
    Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

/// Both targets are met: each at its time and by its arm, whatever the step, and the motion lasts as long as it should.
#[test]
fn two_targets_one_after_the_other() {
    for step in [0.1, 2.0] {
        let coming = [
            Coming { arm: 0, speed: 4.0, time: 5.5, aside: 0.0 },
            Coming { arm: 1, speed: 3.0, time: 8.75, aside: 0.0 },
        ];
        let study = meet(&coming, step).expect("a study");
        let case = &study.cases[0];
        let first = case.approach.as_ref().expect("an approach").duration;
        let capture = case.capture.as_ref().expect("a capture");
        let touched = |impact: &crate::capture::impact::ImpactSolution| {
            impact.contacts.iter().map(|it| (it.contact.target, it.contact.arm)).collect::<Vec<_>>()
        };
        assert!((first - 5.5).abs() < 1e-9, "{step}: {first}");
        assert_eq!(touched(&capture.impact), [(0, 0)]);
        let [later] = capture.later_impacts.as_slice() else { panic!("{:?}", capture.later_impacts) };
        // the robot drifts with the momentum of a milligram
        assert!((later.time - 3.25).abs() < 1e-6, "{step}: {}", later.time);
        assert_eq!(touched(&later.impact), [(1, 1)]);
        assert!((capture.post_impact.duration - 6.0).abs() < 1e-12 && case.closest.is_empty());
        let end = capture.post_impact.end();
        assert!((end.time - 6.0).abs() < 1e-12 && end.state.joint_angles.len() == 6);
        // held: both targets are at their end effectors
        for (target, pose) in capture.targets.last().expect("samples").iter().zip(&end.end_effector_poses) {
            assert!((target.pose[1] - pose[1]).hypot(target.pose[2] - pose[2]) < RADIUS + 1e-9, "{target:?} {pose:?}");
        }
    }
}

/// A damping law that its steps make unstable moves the robot so fast after the second impact that the phase stops, at
/// the start of one of its steps. Its time counts from the first impact.
#[test]
fn a_phase_that_stops_after_a_later_impact() {
    let coming =
        [Coming { arm: 0, speed: 4.0, time: 5.5, aside: 0.0 }, Coming { arm: 1, speed: 3.0, time: 5.8, aside: 0.0 }];
    let mut scenario = meeting(&coming, 0.25);
    let after = scenario.post_impact.as_mut().expect("a phase");
    after.integration.integrator = Integrator::RungeKutta4;
    after.control = PostCaptureControl::Damping { derivative_gain: vec![200.0; 6] };
    let error = run(&scenario).map(|_| ()).expect_err("no numbers");
    let StudyError::PostImpact { source, .. } = error else { panic!("{error}") };
    // the motion after the second impact, of 5.7 s, has 23 steps
    let steps = (source.time - 0.3) / (5.7 / 23.0);
    assert!(steps > 0.5 && (steps - steps.round()).abs() < 1e-3, "{steps}: {source}");
}

/// Targets that come at the same time are met in one impact.
#[test]
fn two_targets_at_once() {
    let study = meet(&[0, 1].map(|arm| Coming { arm, speed: 4.0, time: 5.5, aside: 0.0 }), 0.1).expect("a study");
    let capture = study.cases[0].capture.as_ref().expect("a capture");
    assert_eq!((capture.impact.contacts.len(), capture.later_impacts.len()), (2, 0));
}

/// A bar that two arms are to pin: the second end effector meets it after the first one holds it.
#[test]
fn a_target_that_is_held_is_met_by_another_arm() {
    let text = format!(
        "name = \"it\"\nlayout = \"dual_arm_3r\"\n[initial]\njoint_angles = {ANGLES:?}\n[approach]\nduration = 5.0\n\
         step = 0.05\ntrajectory = \"cycloidal\"\ntracking = \"exact\"\nfinal_joint_angles = {ANGLES:?}\n[contact]\n\
         detection = \"event\"\n[[target]]\nname = \"bar\"\narm = [\"arm1\", \"arm2\"]\nkind = \"pin\"\nmass = 10.0\n\
         inertia = 8.0\npolygon = [[-3.3, -0.2], [3.3, -0.2], [3.3, 0.2], [-3.3, 0.2]]\nposition = [0.1, -0.6]\n\
         yaw = 0.03\ntwist = [0.0, 0.0, 0.2]\n[post_impact]\nduration = 20.0\nstep = 0.05\n"
    );
    let scenario = Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED);
    let study = run(&scenario.unwrap_or_else(|e| panic!("{e}"))).expect("a study");
    let case = &study.cases[0];
    let capture = case.capture.as_ref().expect("a capture");
    let arms: Vec<usize> = capture.impacts().flat_map(|impact| &impact.contacts).map(|made| made.contact.arm).collect();
    assert!(arms == [0, 1] || arms == [1, 0], "{arms:?}");
    assert!(capture.later_impacts.len() == 1 && case.closest.is_empty(), "{:?}", case.closest);
}

/// A target that passes beside its end effector is the one that is not met, by its least distance and time.
#[test]
fn what_is_not_met() {
    for missed in [0, 1] {
        let coming =
            |arm: usize, time: f64| Coming { arm, speed: 4.0, time, aside: if arm == missed { 0.75 } else { 0.0 } };
        let study = meet(&[coming(0, 5.5), coming(1, 8.75)], 2.0).expect("a study");
        let case = &study.cases[0];
        let [closest] = case.closest.as_slice() else { panic!("{:?}", case.closest) };
        assert_eq!((closest.target, closest.arm), (missed, missed));
        assert!((closest.distance - (0.75 - RADIUS)).abs() < 2e-6, "{closest:?}");
        let time = [5.5, 8.75][missed] + RADIUS / 4.0;
        assert!((closest.time - time).abs() < 2e-3, "{closest:?}, not {time}");
        assert!(case.capture.as_ref().is_some_and(|capture| capture.later_impacts.is_empty()));
    }
}

/// An end effector inside its target at the start is refused, with how far, in full down to a tenth of a millimetre.
#[test]
fn a_start_inside_a_target() {
    for (wanted, shown) in [(0.15, "0.1500 m"), (5e-4, "0.0005 m"), (5e-5, "5.0e-5 m"), (1e-9, "1.0e-9 m")] {
        let inside = Coming { arm: 0, speed: 1.0, time: -wanted, aside: 0.0 };
        let error = meet(&[inside, Coming { arm: 1, speed: 1.0, time: 5.0, aside: 0.0 }], 0.1).expect_err("inside");
        assert!(error.to_string().contains(&format!("starts {shown} inside")), "{error}");
        let StudyError::Inside { arm, target, depth, .. } = error else { panic!("{error}") };
        assert_eq!((arm.as_str(), target.as_str()), ("arm1", "t0"));
        assert!((depth - wanted).abs() < 1e-12, "{depth}");
    }
}

/// The bodies beside the robot that pins hold: not those that are free, nor those that are merged.
#[test]
fn bodies_that_pins_hold() {
    let state = RobotState {
        base_pose: [0.0; 3],
        joint_angles: ANGLES.to_vec(),
        base_twist: [0.0; 3],
        joint_rates: vec![0.0; 6],
    };
    let body = |x: f64| Body { mass: 1.0, inertia: 1.0, pose: [0.0, x, 0.0], twist: [0.0; 3] };
    let targets = [body(1.0), body(2.0), body(3.0)];
    let pinned = |attachments: &[Attachment]| {
        let model = registry::generic(&layout("dual_arm_3r"));
        let assembly = Assembly::new(model, &state, &targets, attachments).expect("an assembly");
        assembly.pinned(&assembly.separate(&targets)).iter().map(|body| body.pose[1]).collect::<Vec<_>>()
    };
    let hold = |target: usize, arm: usize, kind: ContactKind| Attachment { target, arm, kind };
    assert!(pinned(&[]).is_empty());
    assert_eq!(pinned(&[hold(1, 0, ContactKind::Pin)]), [2.0]);
    assert_eq!(pinned(&[hold(1, 0, ContactKind::Pin), hold(2, 1, ContactKind::Pin)]), [2.0, 3.0]);
    assert_eq!(pinned(&[hold(1, 0, ContactKind::Rigid), hold(2, 1, ContactKind::Pin)]), [3.0]);
    assert!(pinned(&[hold(0, 1, ContactKind::Rigid)]).is_empty());
}

#[test]
fn terminal_errors_in_words() {
    let error = crate::capture::terminal_error::TerminalError {
        parts: vec![],
        distance: 0.001_25,
        yaw: Some(0.5),
        reached: false,
    };
    assert_eq!(error.to_string(), "1.25e-3 m, 5.00e-1 rad");
    assert_eq!(crate::capture::terminal_error::TerminalError { yaw: None, ..error }.to_string(), "1.25e-3 m");
}

/// A target that one of its two arms meets leaves the other's closest approach.
#[test]
fn the_other_arm_of_a_target_has_a_closest_approach() {
    let [[_, x, y], [_, other_x, other_y]] = end_effectors();
    let text = format!(
        "name = \"it\"\nlayout = \"dual_arm_3r\"\n[initial]\njoint_angles = {ANGLES:?}\n[approach]\nduration = 5.0\n\
         step = 0.5\ntrajectory = \"cycloidal\"\ntracking = \"exact\"\nfinal_joint_angles = {ANGLES:?}\n[contact]\n\
         detection = \"event\"\n[[target]]\nname = \"t\"\narm = [\"arm1\", \"arm2\"]\nmass = 1e-9\ninertia = 1e-10\n\
         radius = {RADIUS}\nposition = [{x}, {}]\ntwist = [0.0, 0.0, 1.0]\n[post_impact]\nduration = 1.0\nstep = 0.5\n",
        y - RADIUS - 4.0
    );
    let scenario = Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED);
    let study = run(&scenario.unwrap_or_else(|e| panic!("{e}"))).expect("a study");
    let [closest] = study.cases[0].closest.as_slice() else { panic!("{:?}", study.cases[0].closest) };
    assert_eq!((closest.target, closest.arm), (0, 1));
    // the target comes to rest below the first end effector
    let rest = (other_x - x).hypot(other_y - (y - RADIUS)) - RADIUS;
    assert!(closest.distance <= rest + 1e-6 && closest.distance > 0.0, "{closest:?} {rest}");
}

/// Bodies that meet after an impact end the case then, by their given outlines: a held disc and one that comes after it,
/// after one impact and after two.
#[test]
fn an_overlap_after_impacts_ends_the_case() {
    for (later, expected) in [(None, 8.0), (Some(7.0), 9.0)] {
        let second = later.map_or(Coming { arm: 1, speed: 4.0, time: 90.0, aside: 9.0 }, |time| Coming {
            arm: 1,
            speed: 3.0,
            time,
            aside: 0.0,
        });
        let mut scenario = meeting(&[Coming { arm: 0, speed: 4.0, time: 5.5, aside: 0.0 }, second], 0.5);
        scenario.clearance.on_overlap = OnOverlap::Stop;
        // default outlines end no case
        scenario.layout.base.outline = None;
        scenario.layout.arms.iter_mut().flat_map(|arm| &mut arm.links).for_each(|link| link.outline = None);
        // a third disc, which no arm is to meet, touches the first from the side
        let mut third = scenario.targets[0].clone();
        third.name = "t2".to_owned();
        third.contacts.iter_mut().for_each(|contact| contact.kind = None);
        let [[_, x, y], [_, other, _]] = end_effectors();
        let side = (x - other).signum();
        third.position = Some([x + side * (2.0 * RADIUS + 2.0 * expected), y - RADIUS]);
        third.twist = [0.0, -2.0 * side, 0.0];
        scenario.cases[0].target_twists.push(third.twist);
        scenario.cases[0].kinds.push(vec![None]);
        scenario.cases[0].restitutions.push(0.0);
        scenario.cases[0].printed_impulses.push(None);
        scenario.targets.push(third);
        let study = run(&scenario).expect("a study");
        let case = &study.cases[0];
        let stopped = case.stopped.expect("an overlap");
        assert!((stopped - expected).abs() < 1e-5, "{stopped}, not {expected}");
        let capture = case.capture.as_ref().expect("a capture");
        assert_eq!(capture.later_impacts.len(), usize::from(later.is_some()));
        let first = case.approach.as_ref().expect("an approach").duration;
        assert!((first + capture.post_impact.duration - stopped).abs() < 1e-9, "{}", capture.post_impact.duration);
    }
}

/// Wheels are arms of one balanced link without a length that hold nothing.
#[test]
fn which_joints_turn_wheels() {
    let mut robot = layout("dual_arm_2r");
    robot.arms[1].links.truncate(1);
    let hold = |arm: usize| Attachment { target: 0, arm, kind: ContactKind::Rigid };
    assert_eq!(wheels(&robot, &[]), [false; 3]);
    (robot.arms[1].links[0].length, robot.arms[1].links[0].com) = (0.0, [0.0; 2]);
    assert_eq!(wheels(&robot, &[]), [false, false, true]);
    assert_eq!(wheels(&robot, &[hold(0)]), [false, false, true]);
    assert_eq!(wheels(&robot, &[hold(0), hold(1)]), [false; 3]);
    robot.arms[1].links[0].com = [0.0, 0.1];
    assert_eq!(wheels(&robot, &[]), [false; 3]);
}

/// Σ [I ω + x m vy − y m vx, m vx, m vy] and Σ ½ (I ω² + m v²).
#[test]
fn momentum_and_energy_of_the_targets() {
    let body = |mass: f64, pose: [f64; 3], twist: [f64; 3]| Body { mass, inertia: 2.0, pose, twist };
    let targets = vec![body(3.0, [0.1, 2.0, -1.0], [0.5, 1.0, 2.0]), body(1.0, [0.0, 0.0, 4.0], [-1.0, 3.0, 0.0])];
    let (momentum, energy) = CaseResult { targets, ..CaseResult::default() }.targets_momentum();
    let expected = [1.0 + 12.0 + 3.0 - 2.0 - 12.0, 6.0, 6.0, 0.25 + 7.5 + 1.0 + 4.5];
    assert_close("sums", &[&momentum[..], &[energy]].concat(), &expected, 1e-12);
}

/// An end effector that was inside a target which it does not hold fails the audit; one beside it does not.
#[test]
fn depths_are_audited() {
    let coming = |arm: usize, time: f64| Coming { arm, speed: 4.0, time, aside: 0.75 };
    let mut study = meet(&[coming(0, 5.5), coming(1, 8.75)], 2.0).expect("a study");
    let inside = |study: &Study| study.audit_failures().iter().filter(|line| line.contains("inside a target")).count();
    assert_eq!((study.cases[0].closest.len(), inside(&study)), (2, 0));
    study.cases[0].closest[1].distance = -1e-3;
    assert_eq!(inside(&study), 1);
    let failures = study.audit_failures();
    for instead in ["`kind = \"pin\"` or `\"rigid\"`", "`restitution`", "shorter `post_impact.duration`"] {
        assert!(failures.iter().any(|line| line.contains(instead)), "{instead}: {failures:?}");
    }
}

/// A light box that bounces without loss between two end effectors does not stop: after a thousand more impacts than the
/// first, the next one ends the study. It has too much inertia to turn.
#[test]
fn bounces_without_end() {
    let [[_, x, y], [_, other_x, other_y]] = end_effectors();
    let apart = (x - other_x).hypot(y - other_y);
    let (yaw, gap) = (f64::atan2(y - other_y, x - other_x), apart - 0.4);
    let speed = 500.0 * gap;
    let text = format!(
        "name = \"it\"\nlayout = \"dual_arm_3r\"\n[initial]\njoint_angles = {ANGLES:?}\n[approach]\nduration = 1.0\n\
         step = 0.5\ntrajectory = \"cycloidal\"\ntracking = \"exact\"\nfinal_joint_angles = {ANGLES:?}\n[contact]\n\
         detection = \"event\"\n[[target]]\nname = \"t\"\narm = [\"arm1\", \"arm2\"]\nkind = \"bounce\"\n\
         restitution = 1.0\nmass = 1e-9\ninertia = 1e3\nyaw = {yaw}\n\
         polygon = [[-0.2, -0.1], [0.2, -0.1], [0.2, 0.1], [-0.2, 0.1]]\nposition = [{}, {}]\ntwist = [0.0, {}, {}]\n\
         [post_impact]\nduration = 4.0\nstep = 4.0\n",
        0.5 * (x + other_x),
        0.5 * (y + other_y),
        speed * yaw.cos(),
        speed * yaw.sin()
    );
    let mut scenario =
        Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"));
    scenario.clearance.only_given = true;
    let error = run(&scenario).expect_err("bounces");
    assert!(error.to_string().contains("`kind = \"pin\"` or `\"rigid\"`"), "{error}");
    let StudyError::Chatter { impacts, time, target, .. } = error else { panic!("{error}") };
    assert_eq!((impacts, target.as_str()), (1001, "t"));
    // the box turns a little after all
    assert!((time - 1001.0 / 500.0).abs() < 1e-3, "{time}");
}

/// A second impact with a disc of a microgram changes nothing: the estimated error of the path is as if there were none, and not
/// that of two motions which each begin without one.
#[test]
fn an_impact_hands_on_the_estimated_error() {
    let scenario = |second: Option<[f64; 2]>| {
        let far = Coming { arm: 1, speed: 4.0, time: 8.5, aside: 30.0 };
        let mut scenario = meeting(&[Coming { arm: 0, speed: 1.0, time: 5.5, aside: 0.0 }, far], 0.125);
        (scenario.targets[0].mass, scenario.targets[0].inertia) = (5.0, 0.5);
        if let Some([x, y]) = second {
            scenario.targets[1].position = Some([x, y - RADIUS - 4.0 * 8.5]);
        }
        scenario.post_impact.as_mut().expect("a phase").integration.integrator = Integrator::RungeKutta4;
        run(&scenario).expect("a study")
    };
    let capture = |study: &Study| study.cases[0].capture.clone().expect("a capture");
    let one = capture(&scenario(None));
    let met = one.post_impact.samples.iter().find(|sample| (sample.time - 3.0).abs() < 1e-9).expect("a sample");
    let [_, x, y] = met.end_effector_poses[1];
    let two = capture(&scenario(Some([x, y])));
    assert_eq!((one.later_impacts.len(), two.later_impacts.len()), (0, 1));
    let [alone, both] = [one, two].map(|capture| capture.post_impact.path_error);
    // the impact is after four times a number of steps, so that both have the same ones, as have the second solutions, but for rounding
    assert!(alone > 1e-9 && (both / alone - 1.0).abs() < 1e-3, "{both:e}, not {alone:e}");
}

/// What is a tenth of a micrometre away at an impact is not part of it, and touches after it.
#[test]
fn what_is_near_touches_later() {
    let apart = 1e-7;
    let coming = [0.0, apart / 4.0].map(|later| 5.5 + later);
    let coming = [0, 1].map(|arm| Coming { arm, speed: 4.0, time: coming[arm], aside: 0.0 });
    let study = meet(&coming, 0.1).expect("a study");
    let capture = study.cases[0].capture.as_ref().expect("a capture");
    let [later] = capture.later_impacts.as_slice() else { panic!("{:?}", capture.later_impacts) };
    assert_eq!(capture.impact.contacts.len(), 1);
    assert!((later.time - apart / 4.0).abs() < 1e-9, "{}", later.time);
}

/// The distances that a case counts are those of its bodies, of its end effectors and of the contact detection.
#[test]
fn all_distances_are_counted() {
    let coming = [5.5, 8.75].into_iter().enumerate();
    let coming: Vec<_> = coming.map(|(arm, time)| Coming { arm, speed: 4.0, time, aside: 0.75 }).collect();
    let scenario = meeting(coming.as_array().expect("two"), 2.0);
    let body = |target: &crate::scenario::Target| {
        let [x, y] = target.position.expect("a place");
        Body { mass: target.mass, inertia: target.inertia, pose: [target.yaw, x, y], twist: target.twist }
    };
    let bodies: Vec<Body> = scenario.targets.iter().map(body).collect();
    let pairs = [0, 1].map(|i| ContactPair { target: i, contact: 0, arm: i });
    let mut detection = ContactDetection::new(&scenario, TargetMotion::Free(&bodies), pairs.to_vec());
    let model = registry::generic(&layout("dual_arm_3r"));
    let tracking = ApproachTracking::new(&scenario, 1.0);
    let phase = tracking.track(&*model, &[0.0; 6], &mut detection, &mut || ()).expect("a phase");
    let of_clearance = |contacts: &[ContactPair]| {
        let mut tracker = ClearanceTracker::new(&scenario, contacts);
        tracker.add_phase(&phase.path, 0.0, TargetMotion::Free(&bodies), &[]).expect("distances");
        tracker.result().evaluations
    };
    let [of_bodies, with_end_effectors] = [of_clearance(&[]), of_clearance(&pairs)];
    assert!(of_bodies > 0 && with_end_effectors > of_bodies && detection.evaluations() > 0);
    let counted = run(&scenario).expect("a study").cases[0].clearance.evaluations;
    assert_eq!(counted, with_end_effectors + detection.evaluations());
}

/// The residual motion is of robot and captured targets: a heavy target that is not met has no part in it.
#[test]
fn the_residual_motion_is_of_what_is_captured() {
    let coming =
        [Coming { arm: 0, speed: 4.0, time: 5.5, aside: 0.0 }, Coming { arm: 1, speed: 4.0, time: 8.75, aside: 0.75 }];
    let mut scenario = meeting(&coming, 0.5);
    scenario.targets[1].mass = 50.0;
    scenario.post_impact.as_mut().expect("a phase").control =
        PostCaptureControl::Damping { derivative_gain: vec![1.0; 6] };
    let study = run(&scenario).expect("a study");
    let capture = study.cases[0].capture.as_ref().expect("a capture");
    let residual = capture.residual_motion.as_ref().expect("a law");
    // a milligram at 4 m/s
    assert!(residual.momentum[1..].iter().all(|part| part.abs() < 1e-8), "{:?}", residual.momentum);
    scenario.post_impact.as_mut().expect("a phase").control = PostCaptureControl::None;
    let study = run(&scenario).expect("a study");
    assert!(study.cases[0].capture.as_ref().is_some_and(|capture| capture.residual_motion.is_none()));
}

/// The first rigid attachment of a target merges it with its arm; others, and pins, are constraints.
#[test]
fn a_target_is_merged_with_the_first_arm_that_holds_it_rigidly() {
    let (base_pose, joint_angles) = ([0.0; 3], ANGLES.to_vec());
    let state = RobotState { base_pose, joint_angles, base_twist: [0.0; 3], joint_rates: vec![0.0; 6] };
    let target = Body { mass: 1.0, inertia: 1.0, pose: [0.3, 1.0, 2.0], twist: [0.0; 3] };
    let (rigid, pin) = (ContactKind::Rigid, ContactKind::Pin);
    for (held, merged, constrained) in [
        ([(0, rigid), (1, rigid)], Some(0), vec![1]),
        ([(1, rigid), (0, rigid)], Some(1), vec![0]),
        ([(0, pin), (1, rigid)], Some(1), vec![0]),
        ([(0, rigid), (1, pin)], Some(0), vec![1]),
        ([(1, pin), (0, pin)], None, vec![1, 0]),
    ] {
        let attachments = held.map(|(arm, kind)| Attachment { target: 0, arm, kind });
        let model = registry::generic(&layout("dual_arm_3r"));
        let assembly = Assembly::new(model, &state, &[target], &attachments).expect("an assembly");
        let arm = match assembly.places[0] {
            TargetPlacement::Merged { arm, .. } => Some(arm),
            TargetPlacement::Separate(_) => None,
        };
        let arms: Vec<usize> = assembly.constraints.iter().map(|constraint| constraint.arm).collect();
        assert_eq!((arm, arms), (merged, constrained), "{held:?}");
    }
}

/// A number of the audit: what it is called, its bound, and where it is in a phase.
type Audited = (&'static str, f64, fn(&mut Phase) -> &mut f64);

/// Each number of the audit alone fails it above its bound, and not below, in every phase and every impact that it is of.
#[test]
fn every_bound_of_the_audit_is_where_it_is_said() {
    let coming =
        [Coming { arm: 0, speed: 4.0, time: 5.5, aside: 0.0 }, Coming { arm: 1, speed: 3.0, time: 8.75, aside: 0.0 }];
    let mut study = meet(&coming, 2.0).expect("a study");
    // three impacts, and a case without an approach of its own
    let capture = study.cases[0].capture.as_mut().expect("a capture");
    capture.later_impacts.push(capture.later_impacts[0].clone());
    study.cases.push(CaseResult { name: "other".to_owned(), ..CaseResult::default() });
    let check = |what: &str, break_it: &dyn Fn(&mut Study, f64)| {
        for (part, count) in [(0.99, 0), (1.01, 1)] {
            let mut study = study.clone();
            break_it(&mut study, part);
            let found = study.audit_failures();
            assert!(found.len() == count && found.iter().all(|line| line.contains(what)), "{what} {part}: {found:?}");
        }
    };
    let numbers: [Audited; 6] = [
        (": momentum drift ", 1e-9, |phase| &mut phase.drift.momentum_drift),
        (": energy error ", 1e-6, |phase| &mut phase.drift.energy_error),
        (": centre-of-mass drift ", 1e-9, |phase| &mut phase.drift.center_of_mass_drift),
        (": path error ", 1e-4, |phase| &mut phase.path_error),
        (": opening of what is held ", 1e-10, |phase| &mut phase.constraint_errors[0]),
        (": rate of opening of what is held ", 1e-10, |phase| &mut phase.constraint_errors[1]),
    ];
    let phases: [fn(&mut Study) -> &mut Phase; 3] = [
        |study| &mut study.approach,
        |study| study.cases[0].approach.as_mut().expect("its own"),
        |study| &mut study.cases[0].capture.as_mut().expect("a capture").post_impact,
    ];
    for phase in phases {
        for (what, bound, number) in numbers {
            check(what, &|study, part| *number(phase(study)) = part * bound);
        }
    }
    let captured = |study: &mut Study, set: &dyn Fn(&mut crate::capture::CaptureResult)| {
        set(study.cases[0].capture.as_mut().expect("a capture"));
    };
    check("inside a target", &|study, part| captured(study, &|capture| capture.penetration = part * 1e-6));
    for i in 0..3 {
        let exact = |capture: &mut crate::capture::CaptureResult,
                     set: &dyn Fn(&mut crate::capture::impact::ImpactResult)| {
            let later = capture.later_impacts.iter_mut().map(|later| &mut later.impact);
            set(&mut std::iter::once(&mut capture.impact).chain(later).nth(i).expect("an impact").exact);
        };
        check("changes the momentum", &|study, part| {
            captured(study, &|capture| exact(capture, &|impact| impact.relative_momentum_jump = part * 1e-9));
        });
        check("raises the kinetic energy", &|study, part| {
            captured(study, &|capture| {
                exact(capture, &|impact| {
                    impact.kinetic_energy_after = impact.kinetic_energy_before * (1.0 + part * 1e-9);
                });
            });
        });
    }
}

/// Under a law that only follows the trajectory an approach begins as the scenario says, with its rates.
#[test]
fn an_approach_begins_with_the_rates_of_the_scenario() {
    let text = |tracking: &str| {
        format!(
            "name = \"it\"\nlayout = \"dual_arm_3r\"\n[initial]\njoint_angles = {ANGLES:?}\n\
             joint_rates = [0.01, -0.02, 0.03, 0.04, -0.05, 0.06]\n[approach]\nduration = 1.0\n\
             trajectory = \"cycloidal\"\ntracking = \"{tracking}\"\nfinal_joint_angles = {ANGLES:?}\n"
        )
    };
    for tracking in ["pd", "computed_torque"] {
        let scenario = Scenario::parse(&text(tracking), "it.toml", &file("scenarios"), registry::SHIPPED);
        let scenario = scenario.unwrap_or_else(|e| panic!("{e}"));
        let study = run(&scenario).expect("a study");
        assert_eq!(study.approach.samples[0].state, scenario.initial, "{tracking}");
    }
}
