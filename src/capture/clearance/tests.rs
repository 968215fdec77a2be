//! Pairs of bodies by name; least distances and overlaps of moving bodies against dense samples.

use super::SAME_TIME;
use super::bodies::{ClearanceBody, bodies, pairs};
use super::search::PairOverlap;
use super::{Clearance, ClearanceError, ClearanceTracker, LeastDistance, Overlap, ineffective_ignores};
use crate::capture::assembly::Attachment;
use crate::capture::contact_pair::ContactPair;
use crate::capture::proximity::convex::{ConvexPart, separation_of};
use crate::capture::target_motion::TargetMotion;
use crate::contact::ContactKind;
use crate::frames::{Frame, point, poses};
use crate::outline::Outline;
use crate::owned::RobotState;
use crate::registry;
use crate::scenario::Scenario;
use crate::simulate::path::{Path, PathRecorder};
use crate::simulate::system::Body;
use planar_proof::file;
use planar_proof::sample::config;
use proptest::array::uniform2;
use proptest::prelude::*;
use std::collections::BTreeSet;

/// A scenario of a layout with two targets, which arms 1 and 2 are to capture.
fn scenario(layout: &str, arms: [&str; 2], joints: usize) -> Scenario {
    let angles = format!("{:?}", vec![0.1; joints]);
    let target = |name: &str, arm: &str| {
        format!(
            "[[target]]\nname = \"{name}\"\narm = \"{arm}\"\nmass = 1.0\ninertia = 1.0\nradius = 0.5\nposition = [9.0, 9.0]\n"
        )
    };
    let text = format!(
        "name = \"it\"\nlayout = \"{layout}\"\n[initial]\njoint_angles = {angles}\n[approach]\nduration = 1.0\n\
         trajectory = \"cycloidal\"\ntracking = \"exact\"\nfinal_joint_angles = {angles}\n\
         [contact]\ndetection = \"event\"\n{}{}[post_impact]\nduration = 1.0\nstep = 0.01\n",
        target("t1", arms[0]),
        target("t2", arms[1])
    );
    Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

/// The pairs that are looked at, by the last parts of their names, and whether they are to meet.
fn named_pairs(scenario: &Scenario) -> BTreeSet<(String, String, bool)> {
    let frames = scenario.frames();
    let all = bodies(scenario, &frames);
    let name = |i: usize| all[i].name.replace("arms/", "").replace("targets/", "");
    let found = pairs(scenario, &frames, &all);
    assert!(found.iter().all(|pair| pair.group == usize::from(pair.contact.is_some())));
    found.iter().map(|pair| (name(pair.bodies[0]), name(pair.bodies[1]), pair.contact.is_some())).collect()
}

/// All pairs of these names but those, and the ones that are to meet.
fn expected_pairs(names: &[&str], joined: &[(&str, &str)], meet: &[(&str, &str)]) -> BTreeSet<(String, String, bool)> {
    let mut expected = BTreeSet::new();
    for (i, a) in names.iter().enumerate() {
        for b in &names[i + 1..] {
            if !joined.contains(&(a, b)) {
                expected.insert(((*a).to_owned(), (*b).to_owned(), meet.contains(&(a, b))));
            }
        }
    }
    expected
}

#[test]
fn pairs_are_those_that_no_joint_joins() {
    let mut it = scenario("dual_arm_2r", ["arm1", "arm2"], 4);
    let names = ["base", "arm1/link1", "arm1/link2", "arm2/link1", "arm2/link2", "t1", "t2"];
    let meet = [("arm1/link2", "t1"), ("arm2/link2", "t2")];
    let mut joined = vec![
        ("base", "arm1/link1"),
        ("arm1/link1", "arm1/link2"),
        ("base", "arm2/link1"),
        ("arm2/link1", "arm2/link2"),
    ];
    assert_eq!(named_pairs(&it), expected_pairs(&names, &joined, &meet));
    // whichever is named first
    for (ignored, pair) in [(["base", "targets/t2"], ("base", "t2")), (["targets/t2", "targets/t1"], ("t1", "t2"))] {
        it.clearance.ignore = vec![ignored.map(str::to_owned)];
        let without = [&joined[..], &[pair]].concat();
        assert_eq!(named_pairs(&it), expected_pairs(&names, &without, &meet));
    }
    it.clearance.ignore = Vec::new();
    // arms that begin at one point of the base
    it.layout.arms[1].mount = it.layout.arms[0].mount;
    joined.push(("arm1/link1", "arm2/link1"));
    assert_eq!(named_pairs(&it), expected_pairs(&names, &joined, &meet));

    // a wheel between a link and the base joins all three; nothing else does
    let mut wheel = scenario("dual_arm_2r", ["arm1", "arm2"], 4);
    wheel.layout.arms[0].links[0].length = 0.0;
    let joined = [&joined[..4], &[("base", "arm1/link2")]].concat();
    assert_eq!(named_pairs(&wheel), expected_pairs(&names, &joined, &meet));
}

/// Arms of three, two and one links: last links are those of their own arm, and default outlines as long as their own link.
#[test]
fn arms_of_unequal_length() {
    let it = scenario("asymmetric_wheel", ["long", "short"], 6);
    let links = ["long/link1", "long/link2", "long/link3", "short/link1", "short/link2", "wheel/link1"];
    let names = [&["base"], &links[..], &["t1", "t2"]].concat();
    let joined = [
        ("base", "long/link1"),
        ("long/link1", "long/link2"),
        ("long/link2", "long/link3"),
        ("base", "short/link1"),
        ("short/link1", "short/link2"),
        ("base", "wheel/link1"),
    ];
    let meet = [("long/link3", "t1"), ("short/link2", "t2")];
    assert_eq!(named_pairs(&it), expected_pairs(&names, &joined, &meet));
    let all = bodies(&it, &it.frames());
    let reach = |link: &str| all.iter().find(|body| body.name == format!("arms/{link}")).expect("a body").reach();
    planar_proof::assert_close("lengths", &links.map(reach), &[1.2, 0.9, 0.35, 0.7, 0.6, 0.0], 0.0);
}

/// A robot that drifts, turns and moves its joints, and free targets, over two phases; in the second, arm 1 holds the
/// first target.
struct Motion {
    scenario: Scenario,
    frames: Vec<Frame>,
    bodies: Vec<ClearanceBody>,
    targets: Vec<Body>,
    rates: [f64; 3],
    /// Of the path of a phase.
    intervals: u32,
}

const DURATIONS: [f64; 2] = [2.0, 1.5];
const GRID: f64 = 0.004;

impl Motion {
    fn robot(&self, time: f64) -> (RobotState, Vec<f64>) {
        let [a, b, c] = self.rates;
        let turn = |k: f64, phase: f64| (k * (0.8 * time + phase).sin(), k * 0.8 * (0.8 * time + phase).cos());
        let joints = [turn(a, 0.0), turn(b, 1.0), turn(c, 2.0), turn(a, 3.0)];
        let state = RobotState {
            base_pose: [0.2 * a * time, 0.3 * b * time, 0.2 * c * time],
            joint_angles: joints.iter().map(|(angle, _)| *angle).collect(),
            base_twist: [0.2 * a, 0.3 * b, 0.2 * c],
            joint_rates: joints.iter().map(|(_, rate)| *rate).collect(),
        };
        let parts: [&[f64]; 4] = [&state.base_pose, &state.joint_angles, &state.base_twist, &state.joint_rates];
        let numbers = parts.concat();
        (state, numbers)
    }

    fn path(&self, start: f64, duration: f64) -> Path {
        let mut recorder = PathRecorder::new(7, 0);
        for i in 0..=self.intervals {
            let time = duration * f64::from(i) / f64::from(self.intervals);
            recorder.record(time, &self.robot(start + time).1);
        }
        recorder.end()
    }

    fn result(&self) -> (Clearance, ClearanceTracker) {
        let mut tracker =
            ClearanceTracker::new(&self.scenario, &[0, 1].map(|i| ContactPair { target: i, contact: 0, arm: i }));
        let held = [Attachment { target: 0, arm: 0, kind: ContactKind::Pin }];
        for (start, duration, attachments) in [(0.0, DURATIONS[0], &[][..]), (DURATIONS[0], DURATIONS[1], &held)] {
            let targets: Vec<_> = self.targets.iter().map(|target| target.after(start)).collect();
            let path = self.path(start, duration);
            tracker.add_phase(&path, start, TargetMotion::Free(&targets), attachments).expect("bounds");
        }
        (tracker.result(), tracker)
    }

    /// The signed distance of two bodies, or of an end effector and a target, by names.
    fn distance(&self, names: [&str; 2], time: f64) -> f64 {
        let Self { frames, bodies, .. } = self;
        let targets: Vec<_> = self.targets.iter().map(|target| target.after(time).pose).collect();
        let placed = poses(frames, &self.robot(time).0, &targets);
        let parts = names.map(|name| {
            let frame = frames.iter().position(|frame| frame.name == name).expect("a frame");
            let own = bodies.iter().find(|body| body.name == name).map(|body| body.parts.clone());
            let place = |part: &ConvexPart| {
                let corners = part.corners.iter().map(|corner| point(placed[frame], *corner));
                (corners.collect::<Vec<_>>(), part.radius)
            };
            own.unwrap_or_else(|| vec![ConvexPart::point()]).iter().map(place).collect::<Vec<_>>()
        });
        let mut least = f64::INFINITY;
        for (a, radius) in &parts[0] {
            for (b, other) in &parts[1] {
                least = least.min(separation_of(a, b, radius + other).distance);
            }
        }
        least
    }

    /// The least of dense samples, and its time; a held pair until then.
    fn sampled(&self, names: [&str; 2], end: f64) -> Vec<(f64, f64)> {
        let count = f64::floor(end / GRID);
        let times = std::iter::successors(Some(0.0), |i| (*i < count).then_some(i + 1.0)).map(|i| i * GRID);
        times.map(|time| (time, self.distance(names, time))).collect()
    }
}

fn targets() -> impl Strategy<Value = [Vec<f64>; 2]> {
    let target = (-3.0..3.0_f64, -2.0..2.0_f64, -2.0..2.0_f64, -3.0..3.0_f64, -1.5..1.5_f64, -1.5..1.5_f64);
    uniform2(target.prop_map(|(yaw, x, y, omega, vx, vy)| vec![yaw, x, y, omega, vx, vy]))
}

/// An L, and a disc.
fn outlines() -> [Outline; 2] {
    let corners = vec![[-0.4, -0.3], [0.6, -0.3], [0.6, -0.1], [-0.2, -0.1], [-0.2, 0.5], [-0.4, 0.5]];
    [Outline::polygon(corners).expect("a polygon"), Outline::Disc { center: [0.1, 0.0], radius: 0.25 }]
}

/// Compares a least distance with dense samples of all pairs that it is the least of.
fn check_least(motion: &Motion, found: &LeastDistance, pairs: &[([String; 2], f64)]) {
    let [a, b] = found.bodies.each_ref().map(String::as_str);
    let there = motion.distance([a, b], found.time);
    assert!((there - found.distance).abs() < 1e-8, "{found:?}, not {there}");
    for (names, end) in pairs {
        let names = names.each_ref().map(String::as_str);
        for (time, distance) in motion.sampled(names, *end) {
            assert!(found.distance <= distance + 1.1e-6, "{names:?} {time}: {distance} below {found:?}");
        }
    }
}

/// Compares the overlaps of a pair with dense samples.
fn check_overlaps(motion: &Motion, clearance: &Clearance, names: &[String; 2], end: f64) {
    let found: Vec<_> = clearance.overlaps.iter().filter(|overlap| overlap.bodies == *names).collect();
    let samples = motion.sampled(names.each_ref().map(String::as_str), end);
    let inside = |time: f64| found.iter().find(|overlap| (overlap.span[0]..=overlap.span[1]).contains(&time));
    for (time, distance) in &samples {
        match inside(*time) {
            Some(overlap) => {
                assert!((-overlap.depth - 1.1e-6..1.1e-2).contains(distance), "{time} {distance}: {overlap:?}");
            }
            None => assert!(*distance > -1.1e-6, "{time} {distance}: {names:?} {found:?}"),
        }
    }
    for overlap in found {
        let [from, to] = overlap.span;
        let at = |time| motion.distance(names.each_ref().map(String::as_str), time);
        assert!(from <= to && (from == 0.0 || at(from).abs() < 1e-7), "{overlap:?} {}", at(from));
        assert!((to - end).abs() < 1e-9 || at(to).abs() < 1e-7, "{overlap:?} {}", at(to));
        let within = samples.iter().filter(|(time, _)| (from..=to).contains(time));
        let deepest = within.fold(0.0, |depth: f64, (_, distance)| depth.max(-distance));
        // points move by some 6 m/s at most
        assert!(overlap.depth <= deepest + 6.0 * GRID, "{overlap:?} {deepest}");
        assert_eq!(overlap.is_default, names.iter().any(|name| !name.starts_with("targets")));
    }
}

/// With `only_given`, a pair with a default outline is left out.
#[test]
fn pairs_of_given_outlines_alone() {
    let mut it = scenario("dual_arm_2r", ["arm1", "arm2"], 4);
    it.clearance.only_given = true;
    assert_eq!(named_pairs(&it), BTreeSet::from([("t1".to_owned(), "t2".to_owned(), false)]));
    it.layout.arms[0].links[1].outline = Some(Outline::Disc { center: [0.1, 0.0], radius: 0.25 });
    let found = named_pairs(&it).into_iter().map(|(a, b, _)| [a, b]).collect::<Vec<_>>();
    assert_eq!(found, [["arm1/link2", "t1"], ["arm1/link2", "t2"], ["t1", "t2"]]);
}

/// Pairs to ignore that are not compared anyway: a body with itself, joined ones, and one that is there before.
#[test]
fn ignored_pairs_that_change_nothing() {
    let mut it = scenario("dual_arm_2r", ["arm1", "arm2"], 4);
    let pairs = [
        ["base", "targets/t1"],
        ["base", "base"],
        ["arms/arm1/link2", "arms/arm1/link1"],
        ["targets/t1", "targets/t2"],
        ["targets/t1", "base"],
        ["targets/t1", "targets/t2"],
        ["base", "targets/t2"],
    ];
    it.clearance.ignore = pairs.map(|pair| pair.map(str::to_owned)).to_vec();
    let found = ineffective_ignores(&it);
    assert_eq!(found.iter().map(|(i, _)| *i).collect::<Vec<_>>(), [1, 2, 4, 5]);
    for ((_, why), expected) in found.iter().zip(["with itself", "common joint", "there before", "there before"]) {
        assert!(why.contains(expected), "{why}");
    }
}

/// The least distance besides those that are to meet, else of all; none without pairs.
#[test]
fn the_least_distance_that_is_shown() {
    let at = |distance: f64| Some(LeastDistance { distance, time: 1.0, bodies: ["a", "b"].map(str::to_owned) });
    let shown = |least, besides_contacts| {
        let clearance = Clearance { least, besides_contacts, ..Clearance::default() };
        clearance.least_shown().map(|least| least.distance.to_bits())
    };
    assert_eq!(shown(at(1.0), at(2.0)), Some(f64::to_bits(2.0)));
    assert_eq!(shown(at(1.0), None), Some(f64::to_bits(1.0)));
    assert_eq!(shown(None, None), None);
}

/// A robot at rest, and two targets of these outlines.
fn resting(outlines: [Outline; 2], targets: [([f64; 3], [f64; 3]); 2]) -> Motion {
    let mut scenario = scenario("dual_arm_2r", ["arm1", "arm2"], 4);
    for (target, outline) in scenario.targets.iter_mut().zip(outlines) {
        target.outline = outline;
    }
    let frames = scenario.frames();
    let bodies = bodies(&scenario, &frames);
    let targets = targets.map(|(pose, twist)| Body { mass: 1.0, inertia: 1.0, pose, twist }).to_vec();
    Motion { scenario, frames, bodies, targets, rates: [0.0; 3], intervals: 1 }
}

const NAMES: [&str; 2] = ["targets/t1", "targets/t2"];

fn overlaps(clearance: &Clearance) -> Vec<&Overlap> {
    clearance.overlaps.iter().filter(|overlap| overlap.bodies == NAMES).collect()
}

/// A disc of 0.25 m with an end effector 0.1 m beside its centre.
#[test]
fn an_end_effector_inside_a_target() {
    let disc = || Outline::Disc { center: [0.0; 2], radius: 0.25 };
    let mut motion = resting([disc(), disc()], [([0.0, 30.0, 0.0], [0.0; 3]), ([0.0, -30.0, 0.0], [0.0; 3])]);
    let tip = poses(&motion.frames, &motion.robot(0.0).0, &[[0.0; 3]; 2]);
    let frame = motion.frames.iter().position(|frame| frame.name == "arms/arm2/tip").expect("a frame");
    let [x, y] = point(tip[frame], [0.0; 2]);
    motion.targets[1].pose = [0.0, x, y + 0.1];
    let (_, tracker) = motion.result();
    assert!((tracker.penetration() - 0.15).abs() < 1e-12, "{}", tracker.penetration());
    assert!((tracker.closest()[1].distance + 0.15).abs() < 1e-12, "{:?}", tracker.closest());
}

/// A bar that is inside a wall at the start, and again after a turn: an overlap ends and another begins, however small
/// the depths at the ends of the interval are.
#[test]
fn a_gap_between_two_overlaps_is_found() {
    let bar = Outline::polygon(vec![[0.0, -0.01], [1.0, 0.0], [0.0, 0.01]]).expect("a bar");
    let wall = Outline::polygon(vec![[-2.0, 0.0], [2.0, 0.0], [2.0, 1.0], [-2.0, 1.0]]).expect("a wall");
    let turn = std::f64::consts::PI;
    // from straight up, 0.01 m inside
    let motion = resting([wall, bar], [([0.0, 30.0, 0.99], [0.0; 3]), ([0.5 * turn, 30.0, 0.0], [turn, 0.0, 0.0])]);
    let (clearance, _) = motion.result();
    let found = overlaps(&clearance);
    let out = f64::acos(0.99) / turn;
    let expected = [[0.0, out], [2.0 - out, 2.0 + out]];
    assert_eq!(found.len(), 2, "{found:?}");
    for (overlap, span) in found.iter().zip(expected) {
        assert!((0..2).all(|i| (overlap.span[i] - span[i]).abs() < 1e-6), "{overlap:?}, not {span:?}");
        assert!((overlap.depth - 0.01).abs() < 2e-6, "{overlap:?}");
    }
}

/// A tip that is half a micrometre outside a wall at the start dips into it by some.
#[test]
fn a_dip_from_a_near_touch_is_found() {
    let bar = Outline::polygon(vec![[0.0, -0.01], [1.0, 0.0], [0.0, 0.01]]).expect("a bar");
    let wall = Outline::polygon(vec![[-2.0, 0.0], [2.0, 0.0], [2.0, 1.0], [-2.0, 1.0]]).expect("a wall");
    let (before, after) = (5e-3, 8e-3);
    let rate = (before + after) / DURATIONS[0];
    let up = 0.5 * std::f64::consts::PI;
    let height = f64::cos(before) + 5e-7;
    let motion = resting([wall, bar], [([0.0, 30.0, height], [0.0; 3]), ([up - before, 30.0, 0.0], [rate, 0.0, 0.0])]);
    let (clearance, _) = motion.result();
    let found = overlaps(&clearance);
    let [overlap] = found[..] else { panic!("{found:?}") };
    let half = f64::acos(height) / rate;
    let expected = [before / rate - half, before / rate + half];
    assert!((0..2).all(|i| (overlap.span[i] - expected[i]).abs() < 1e-6), "{overlap:?}, not {expected:?}");
    assert!((overlap.depth - (1.0 - height)).abs() < 1.1e-6, "{overlap:?}");
}

/// A long bar dips into a wall by little more than a micrometre, so slowly that an instant within that micrometre comes
/// before the one that is deeper: the overlap begins where the two touch.
#[test]
fn a_slow_overlap_begins_at_its_touch() {
    let bar = Outline::polygon(vec![[0.0, -1.0], [100.0, 0.0], [0.0, 1.0]]).expect("a bar");
    let wall = Outline::polygon(vec![[-200.0, 0.0], [200.0, 0.0], [200.0, 1.0], [-200.0, 1.0]]).expect("a wall");
    let (before, after) = (2.7e-4, 5e-5);
    let rate = (before + after) / DURATIONS[0];
    let up = 0.5 * std::f64::consts::PI;
    let motion =
        resting([wall, bar], [([0.0, 300.0, 100.0 - 1.2e-6], [0.0; 3]), ([up - before, 300.0, 0.0], [rate, 0.0, 0.0])]);
    let (clearance, _) = motion.result();
    let found = overlaps(&clearance);
    let [overlap] = found[..] else { panic!("{found:?}") };
    // 1 − cos φ = ½ φ², to 1e-9 of it
    let half = f64::sqrt(2.0 * 1.2e-8);
    let expected = [(before - half) / rate, (before + half) / rate];
    assert!((0..2).all(|i| (overlap.span[i] - expected[i]).abs() < 1e-5), "{overlap:?}, not {expected:?}");
    assert!((overlap.depth - 1.2e-6).abs() < 2e-7, "{overlap:?}");
}

/// A bar that is farther away than what is nearest, though not by circles, meets another one in the next interval of
/// 1.5 s.
#[test]
fn long_intervals_miss_no_overlap() {
    let bar = || Outline::polygon(vec![[-0.25, -3.0], [0.25, -3.0], [0.25, 3.0], [-0.25, 3.0]]).expect("a bar");
    let at = |x: f64, vx: f64| ([0.0, x, 30.0], [0.0, vx, 0.0]);
    let (clearance, _) = resting([bar(), bar()], [at(0.0, 0.0), at(5.2, -1.5)]).result();
    let found = overlaps(&clearance);
    let [overlap] = found[..] else { panic!("{found:?}") };
    assert!((overlap.span[0] - 4.7 / 1.5).abs() < 1e-6 && (overlap.depth - 0.5).abs() < 2e-6, "{overlap:?}");
    // the bar is 1.7 m away after 2 s, and would be 0.7 m away if it moved by 1 m in the next interval
    let scenario = scenario("dual_arm_2r", ["arm1", "arm2"], 4);
    let robot = Motion { scenario, ..resting([bar(), bar()], [at(0.0, 0.0), at(90.0, 0.0)]) };
    assert!(robot.result().0.least.is_some_and(|least| least.distance < 0.7));

    // joints that move make a knot every 2 s: the second interval is skipped for the bound of the first
    let mut slower = resting([bar(), bar()], [at(0.0, 0.0), at(7.0, -1.0)]);
    (slower.rates, slower.intervals) = ([1.0; 3], 4);
    let mut tracker = ClearanceTracker::new(&slower.scenario, &[]);
    tracker.add_phase(&slower.path(0.0, 8.0), 0.0, TargetMotion::Free(&slower.targets), &[]).expect("bounds");
    let clearance = tracker.result();
    assert!(matches!(overlaps(&clearance)[..], [one] if (one.span[0] - 6.5).abs() < 1e-6), "{:?}", clearance.overlaps);
}

/// Distances are counted and timed from the start of the approach: of a phase from 100 s to 200 s twice as many are
/// allowed at its end as at its start.
#[test]
fn distances_are_used_up_at_their_time() {
    let bar = || Outline::polygon(vec![[-1.0, -0.01], [1.0, -0.01], [1.0, 0.01], [-1.0, 0.01]]).expect("a bar");
    let mut motion = resting([bar(), bar()], [([0.0, 30.0, 0.0], [0.0; 3]), ([0.5, 30.0, 0.5], [3.0, 0.0, 0.0])]);
    motion.scenario.clearance.only_given = true;
    // joints that move make knots of the ends of intervals
    (motion.rates, motion.intervals) = ([1.0; 3], 2);
    let run = |most: u64| {
        let mut scenario = motion.scenario.clone();
        scenario.clearance.max_distances = most;
        let mut tracker = ClearanceTracker::new(&scenario, &[]);
        let end = tracker.add_phase(&motion.path(100.0, 100.0), 100.0, TargetMotion::Free(&motion.targets), &[]);
        (
            end.map_err(|error| match error {
                ClearanceError::Exhausted(what) => what,
                ClearanceError::Path(error) => panic!("{error}"),
            }),
            tracker.result().evaluations,
        )
    };
    let (end, all) = run(u64::MAX);
    assert!(end.is_ok() && all > 1000, "{all}");
    // the second half, from 150 s, has the second half of them
    assert!(run(all * 3 / 4).0.is_ok());
    for most in [all / 4, all / 3] {
        let (end, count) = run(most);
        let what = end.expect_err("too many");
        assert_eq!((what.evaluations, what.of_pair, what.parts), (count, count, [1, 1]));
        assert_eq!(what.bodies, NAMES);
        assert!((100.0..=200.0).contains(&what.time), "{what:?}");
        let said = what.to_string();
        assert!(said.contains(&count.to_string()) && said.contains(NAMES[1]), "{said}");
    }
}

/// A rod that turns ten times a second passes through a bar: the overlaps are those of samples every 5 µs, each with its
/// own depth, whether an interval is many turns or a small part of one.
#[test]
fn a_fast_rod_overlaps_as_often_as_it_passes() {
    let mut scenario = scenario("dual_arm_2r", ["arm1", "arm2"], 4);
    let outlines = [[0.5, 0.005], [0.3, 0.01]]
        .map(|[x, y]| Outline::polygon(vec![[-x, -y], [x, -y], [x, y], [-x, y]]).expect("a rectangle"));
    for (target, outline) in scenario.targets.iter_mut().zip(outlines) {
        target.outline = outline;
    }
    let frames = scenario.frames();
    let bodies = bodies(&scenario, &frames);
    let body = |pose, twist| Body { mass: 1.0, inertia: 1.0, pose, twist };
    let targets = vec![body([0.0, 30.0, 0.0], [0.0; 3]), body([0.0, 30.1, 0.6], [62.8, 0.0, -0.9])];
    let mut motion = Motion { scenario, frames, bodies, targets, rates: [0.0; 3], intervals: 1 };
    let names = ["targets/t1", "targets/t2"];
    let (mut truth, mut was_inside): (Vec<([f64; 2], f64)>, _) = (Vec::new(), false);
    for i in 0..400_000 {
        let time = f64::from(i) * 5e-6;
        let depth = -motion.distance(names, time);
        if depth > 0.0 {
            if !was_inside {
                truth.push(([time, time], depth));
            }
            let (span, deepest) = truth.last_mut().expect("one was added");
            (span[1], *deepest) = (time, deepest.max(depth));
        }
        was_inside = depth > 0.0;
    }
    truth.retain(|(_, depth)| *depth > 1e-6);
    assert!(truth.len() > 10, "{truth:?}");
    for intervals in [1, 7, 400, 20_000] {
        motion.intervals = intervals;
        let (clearance, _) = motion.result();
        let found: Vec<_> = clearance.overlaps.iter().filter(|overlap| overlap.bodies == names).collect();
        assert_eq!(found.len(), truth.len(), "{intervals}: {found:?}");
        for (overlap, (span, depth)) in found.iter().zip(&truth) {
            let off = [0, 1].map(|i| (overlap.span[i] - span[i]).abs());
            // within a sample; in one, the rod moves by 0.1 mm
            assert!(off.iter().all(|off| *off <= 6e-6), "{intervals}: {overlap:?}, not {span:?}");
            assert!((overlap.depth - depth).abs() < 1e-4, "{intervals}: {overlap:?}, not {depth}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, ..config() })]

    #[test]
    fn least_distances_and_overlaps_are_those_of_dense_samples(moved in targets(), rates in prop::array::uniform3(-1.2..1.2_f64)) {
        let mut scenario = scenario("dual_arm_2r", ["arm1", "arm2"], 4);
        for (target, outline) in scenario.targets.iter_mut().zip(outlines()) {
            target.outline = outline;
        }
        let body = |v: &Vec<f64>| Body { mass: 1.0, inertia: 1.0, pose: [v[0], v[1], v[2]], twist: [v[3], v[4], v[5]] };
        let frames = scenario.frames();
        let bodies = bodies(&scenario, &frames);
        let motion = Motion { scenario, frames, bodies, targets: moved.iter().map(body).collect(), rates, intervals: 200 };
        let (clearance, tracker) = motion.result();
        let end: f64 = DURATIONS.iter().sum();
        let name = |short: &str| if short.contains('/') { format!("arms/{short}") } else if short.starts_with('t') { format!("targets/{short}") } else { short.to_owned() };
        let pairs: Vec<_> = named_pairs(&motion.scenario)
            .into_iter()
            .map(|(a, b, meet)| {
                let held = (a.as_str(), b.as_str()) == ("arm1/link2", "t1");
                ([name(&a), name(&b)], if held { DURATIONS[0] } else { end }, meet)
            })
            .collect();
        let of = |with_contacts: bool| -> Vec<_> {
            pairs.iter().filter(|(.., meet)| with_contacts || !meet).map(|(names, end, _)| (names.clone(), *end)).collect()
        };
        check_least(&motion, clearance.least.as_ref().expect("pairs"), &of(true));
        check_least(&motion, clearance.besides_contacts.as_ref().expect("pairs"), &of(false));
        for (names, end) in of(true) {
            check_overlaps(&motion, &clearance, &names, end);
        }
        prop_assert!(clearance.overlaps.is_sorted_by(|a, b| a.span[0] <= b.span[0] + SAME_TIME));
        let given = clearance.overlaps.iter().find(|overlap| !overlap.is_default).map_or(0.0, |overlap| overlap.span[0]);
        let first = tracker.first_given_overlap().map_or(0.0, |(_, time)| time);
        prop_assert!((first - given).abs() <= SAME_TIME, "{} {}", first, given);

        let closest = tracker.closest();
        prop_assert_eq!(closest.len(), 2);
        let mut depth: f64 = 0.0;
        for (i, end) in [DURATIONS[0], end].into_iter().enumerate() {
            let (names, found) = ([["arms/arm1/tip", "targets/t1"], ["arms/arm2/tip", "targets/t2"]][i], &closest[i]);
            prop_assert_eq!((found.arm, found.target), (i, i));
            let samples = motion.sampled(names, end);
            let least = samples.iter().fold(f64::INFINITY, |least, (_, distance)| least.min(*distance));
            prop_assert!((motion.distance(names, found.time) - found.distance).abs() < 1e-8);
            prop_assert!(found.distance <= least + 1.1e-6, "{:?} {}", found, least);
            depth = depth.max(-found.distance);
        }
        prop_assert!((tracker.penetration() - depth).abs() < 1.1e-6, "{} {}", tracker.penetration(), depth);
    }
}

#[test]
fn an_overlap_in_words_says_when_however_short_it_is() {
    let words =
        |span, depth| Overlap { bodies: ["base".into(), "a".into()], span, depth, is_default: false }.sentence();
    assert_eq!(words([1.0, 2.5], 0.25), "`base` and `a` overlap from 1.000 s to 2.500 s by up to 2.50e-1 m");
    assert_eq!(words([1.0, 1.000_002], 3e-7), "`base` and `a` overlap at 1.000 s for 2.0e-6 s by up to 3.00e-7 m");
    assert_eq!(words([1.0, 1.002], 0.25), "`base` and `a` overlap from 1.000 s to 1.002 s by up to 2.50e-1 m");
    assert_eq!(words([1.0, 1.0], 0.0), "`base` and `a` begin to overlap at 1.000 s");
    for (span, expected) in
        [([1.0, 1.0], "at 1.000 s (default outlines)"), ([1.0, 2.0], "5.00e-1 m (default outlines)")]
    {
        let overlap = Overlap { bodies: ["base".into(), "a".into()], span, depth: 0.5, is_default: true };
        assert!(overlap.sentence().ends_with(expected), "{}", overlap.sentence());
    }
}

/// Overlaps of the parts of two bodies are one while they last together: from the first to the last end, as deep as the
/// deepest. A case ends at the earliest of all pairs.
#[test]
fn overlaps_of_parts_are_joined() {
    let (_, mut tracker) =
        resting([0.1, 0.1].map(Outline::disc), [([0.0, 30.0, 0.0], [0.0; 3]), ([0.0; 3], [0.0; 3])]).result();
    tracker.bodies.bodies.iter_mut().for_each(|body| body.is_default = false);
    let mut found = |overlaps: &[(usize, [f64; 2], f64)]| {
        let each = overlaps.iter().map(|(pair, span, depth)| PairOverlap { pair: *pair, span: *span, depth: *depth });
        tracker.bodies.found.overlaps = each.collect();
        let spans = tracker.result().overlaps.iter().map(|overlap| (overlap.span, overlap.depth)).collect::<Vec<_>>();
        (spans, tracker.first_given_overlap())
    };
    let parts = [(0, [1.0, 5.0], 0.1), (0, [2.0, 3.0], 0.3), (0, [4.0, 6.0], 0.2)];
    for order in [[0, 1, 2], [1, 0, 2], [2, 1, 0]] {
        let (spans, first) = found(&order.map(|i| parts[i]));
        assert_eq!((spans, first), (vec![([1.0, 6.0], 0.3)], Some((0, 1.0))), "{order:?}");
    }
    let (spans, first) = found(&[(0, [2.0, 3.0], 0.1), (0, [3.5, 4.0], 0.2), (1, [1.0, 9.0], 0.3)]);
    assert_eq!(spans, [([1.0, 9.0], 0.3), ([2.0, 3.0], 0.1), ([3.5, 4.0], 0.2)]);
    assert_eq!(first, Some((1, 1.0)));
}

/// An overlap of a last link with its target ends where the arm takes hold of it.
#[test]
fn what_is_held_overlaps_until_then() {
    let disc = || Outline::Disc { center: [0.0; 2], radius: 0.25 };
    let mut motion = resting([disc(), disc()], [([0.0; 3], [0.0; 3]), ([0.0, -30.0, 0.0], [0.0; 3])]);
    let tip = poses(&motion.frames, &motion.robot(0.0).0, &[[0.0; 3]; 2]);
    let frame = motion.frames.iter().position(|frame| frame.name == "arms/arm1/tip").expect("a frame");
    motion.targets[0].pose = tip[frame];
    let (clearance, _) = motion.result();
    let names = ["arms/arm1/link2", "targets/t1"];
    let overlap = clearance.overlaps.iter().find(|overlap| overlap.bodies == names).expect("an overlap");
    planar_proof::assert_close("span", &overlap.span, &[0.0, DURATIONS[0]], 1e-9);
}

/// The last links of all arms that are to hold a target are to meet it.
#[test]
fn every_arm_of_a_target_is_to_meet_it() {
    let mut it = scenario("dual_arm_2r", ["arm1", "arm2"], 4);
    let second = it.targets[1].contacts[0];
    it.targets[0].contacts.push(second);
    let meets: BTreeSet<_> =
        named_pairs(&it).into_iter().filter(|(.., meets)| *meets).map(|(a, b, _)| (a, b)).collect();
    let expected = [("arm1/link2", "t1"), ("arm2/link2", "t1"), ("arm2/link2", "t2")];
    assert_eq!(meets, expected.map(|(a, b)| (a.to_owned(), b.to_owned())).into());
}
