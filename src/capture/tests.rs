//! Light targets that reach a robot at rest one after the other: times, contacts and what is not met; bodies that are
//! held, and terminal errors in words.

use crate::capture::assembly::{Assembly, Attachment};
use crate::capture::post_capture::wheels;
use crate::capture::{CaseResult, Silent, Study, StudyError, study};
use crate::contact::ContactKind;
use crate::owned::RobotState;
use crate::registry;
use crate::scenario::{OnOverlap, PostCaptureControl, Scenario};
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

/// An end effector inside its target at the start is refused, with how far.
#[test]
fn a_start_inside_a_target() {
    let inside = Coming { arm: 0, speed: 1.0, time: -0.15, aside: 0.0 };
    let error = meet(&[inside, Coming { arm: 1, speed: 1.0, time: 5.0, aside: 0.0 }], 0.1).expect_err("inside");
    let StudyError::Inside { arm, target, depth, .. } = error else { panic!("{error}") };
    assert_eq!((arm.as_str(), target.as_str()), ("arm1", "t0"));
    assert!((depth - 0.15).abs() < 1e-12, "{depth}");
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
        let mut scenario = meeting(&[Coming { arm: 0, speed: 1.0, time: 5.5, aside: 0.0 }, far], 0.1);
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
    // the impact is at the end of a step, so that both have the same ones, but for rounding
    assert!(alone > 1e-9 && (both / alone - 1.0).abs() < 1e-3, "{both:e}, not {alone:e}");
}
