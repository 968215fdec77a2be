//! Motions and their bounds against differences of positions; bounds that are attained; first contacts against dense
//! samples.

use super::convex::{ConvexPart, PlacedPart, separation_of};
use super::motion::{FrameKinematics, FrameState, MotionBound, velocity_of_base};
use super::part_pair::{Instant, PartPair};
use super::workspace::PathWorkspace;
use crate::capture::assembly::{Assembly, Attachment};
use crate::capture::target_motion::TargetMotion;
use crate::contact::ContactKind;
use crate::error::Error;
use crate::frames::{Frame, FrameMotion, frames, point, poses};
use crate::outline::Outline;
use crate::owned::RobotState;
use crate::registry;
use crate::simulate::path::{PathInterval, PathPart};
use crate::simulate::system::Body;
use planar_proof::layout;
use planar_proof::sample::config;
use proptest::array::uniform2;
use proptest::collection::vec;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// Half the time of a central difference, s, and the error of such a difference per unit.
const HALF: f64 = 1e-5;
const DIFFERENCE: f64 = 1e-7;

/// The motion of frames over an interval.
struct Motion<'a> {
    kinematics: &'a FrameKinematics<'a>,
    span: [f64; 2],
    /// Positions and rates at its ends.
    ends: [[Vec<f64>; 2]; 2],
}

impl Motion<'_> {
    fn interval(&self) -> PathInterval<'_> {
        let [start, end] = self.ends.each_ref().map(|half| half.each_ref().map(Vec::as_slice));
        PathInterval { span: self.span, start, end }
    }

    fn buffers(&self) -> [Vec<f64>; 2] {
        self.ends[0].clone()
    }

    fn states(&self, time: f64) -> Vec<FrameState> {
        let mut coordinates = self.buffers();
        let [positions, rates] = &mut coordinates;
        self.interval().at(time, positions, rates);
        let mut states = Vec::new();
        self.kinematics.states(time, &coordinates, None, &mut states);
        states
    }

    /// A point of a frame, in the frame that carries it or the inertial one.
    fn seen_from(&self, carrier: Option<usize>, frame: usize, at: [f64; 2], time: f64) -> [f64; 2] {
        let states = self.states(time);
        let [x, y] = point(states[frame].pose, at);
        carrier.map_or([x, y], |by| {
            let [_, ox, oy] = states[by].pose;
            states[by].seen([x - ox, y - oy])
        })
    }

    fn bounds(&self) -> Vec<MotionBound> {
        let mut bounds = Vec::new();
        self.kinematics.bounds(&self.interval(), &mut Vec::new(), &mut self.buffers(), &mut bounds);
        bounds
    }

    /// A velocity less that of the base at the start.
    fn relative(&self, [vx, vy]: [f64; 2]) -> [f64; 2] {
        let [bx, by] = velocity_of_base(&self.interval());
        [vx - bx, vy - by]
    }

    /// Velocity and acceleration of a point of a frame, by differences.
    fn point_motion(&self, frame: usize, at: [f64; 2], time: f64) -> [[f64; 2]; 2] {
        let [before, now, after] = [-HALF, 0.0, HALF].map(|step| {
            let FrameState { pose, twist: [omega, vx, vy], .. } = self.states(time + step)[frame];
            let [x, y] = point(pose, at);
            ([x, y], [vx - omega * (y - pose[2]), vy + omega * (x - pose[1])])
        });
        let half = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|i| (b[i] - a[i]) / (2.0 * HALF));
        let velocity = half(before.0, after.0);
        assert!((0..2).all(|i| (velocity[i] - now.1[i]).abs() < DIFFERENCE * 1e3), "{velocity:?} {:?}", now.1);
        [now.1, half(before.1, after.1)]
    }
}

fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// A robot with two arms, of which the second may hold the first of two targets.
fn captured(angles: &[f64], holds: bool) -> (Vec<Frame>, Assembly, Vec<Body>) {
    let layout = layout("dual_arm_2r");
    let state = RobotState {
        base_pose: [0.3, -0.2, 0.5],
        joint_angles: angles.to_vec(),
        base_twist: [0.0; 3],
        joint_rates: vec![0.0; 4],
    };
    let body = |x: f64| Body { mass: 2.0, inertia: 0.3, pose: [0.4, x, 1.1], twist: [0.7, -0.3, 0.2] };
    let targets = vec![body(1.5), body(-2.0)];
    let held = [Attachment { target: 0, arm: 1, kind: ContactKind::Rigid }];
    let held = if holds { &held[..] } else { &[] };
    let assembly = Assembly::new(registry::generic(&layout), &state, &targets, held).expect("an assembly");
    (frames(&layout, ["held", "free"]), assembly, targets)
}

proptest! {
    #![proptest_config(config())]

    /// Poses are those of the forward kinematics and of the assembly, twists their derivatives, and no point is faster
    /// or accelerates more than its bounds.
    #[test]
    fn frames_move_within_their_bounds(
        ends in uniform2(uniform2(vec(-1.5..1.5_f64, 13))), free in any::<bool>(), holds in any::<bool>(),
        time in 0.1..0.6_f64, direction in 0.0..TAU, reach in 0.0..1.5_f64,
    ) {
        let (frames, assembly, targets) = captured(&ends[0][0][3..7], holds);
        let motion = if free { TargetMotion::Free(&targets) } else { TargetMotion::Assembled(&assembly, &targets) };
        let kinematics = &FrameKinematics::new(&frames, motion);
        let motion = Motion { kinematics, span: [0.0, 0.7], ends };
        let (states, bounds) = (motion.states(time), motion.bounds());

        let mut coordinates = motion.buffers();
        let [positions, rates] = &mut coordinates;
        motion.interval().at(time, positions, rates);
        let state = RobotState {
            base_pose: [positions[0], positions[1], positions[2]],
            joint_angles: positions[3..7].to_vec(),
            base_twist: [rates[0], rates[1], rates[2]],
            joint_rates: rates[3..7].to_vec(),
        };
        let mut end_effectors = [[0.0; 3]; 2];
        assembly.model.end_effector_poses(&state.base_pose, &state.joint_angles, &mut end_effectors).expect("poses");
        let separate = assembly.bodies.iter().zip(positions[7..].chunks_exact(3));
        let beside: Vec<_> = separate.map(|(body, pose)| Body { pose: [pose[0], pose[1], pose[2]], ..*body }).collect();
        let placed: Vec<_> = if free {
            targets.iter().map(|target| target.after(time)).collect()
        } else {
            assembly.targets(&targets, &end_effectors, &[[0.0; 3]; 2], &beside)
        };
        let expected = poses(&frames, &state, &placed.iter().map(|target| target.pose).collect::<Vec<_>>());
        let (sin, cos) = direction.sin_cos();
        for (i, (state, bound)) in states.iter().zip(&bounds).enumerate() {
            planar_proof::assert_close(&frames[i].name, &state.pose, &expected[i], 1e-12);
            let [velocity, acceleration] = motion.point_motion(i, [reach * cos, reach * sin], time);
            let slack = 1.0 + DIFFERENCE * 1e3;
            prop_assert!(length(motion.relative(velocity)) <= bound.speed_within(reach) * slack, "{}", frames[i].name);
            prop_assert!(length(acceleration) <= bound.acceleration_within(reach) * slack + DIFFERENCE * 1e3, "{}", frames[i].name);
            prop_assert!((frames[i].motion != FrameMotion::Base) || (state.twist[0] - rates[0]).abs() < 1e-12);
        }
        let mut workspace = PathWorkspace::default();
        workspace.set_bounds(kinematics, &motion.interval());
        // at the ends the states of all frames are known, between them those of a pair
        for (a, time) in (0..frames.len()).flat_map(|a| [(a, time), (a, motion.span[1])]) {
            for b in 0..a {
                let pair = kinematics.pair([a, b]);
                let bound = workspace.relative_bound(kinematics, &pair);
                let point_a = [reach * cos, reach * sin];
                let [before, after] = [-HALF, HALF].map(|step| motion.seen_from(pair.carrier, a, point_a, time + step));
                let [of_b_before, of_b_after] = [-HALF, HALF].map(|step| motion.seen_from(pair.carrier, b, [0.0; 2], time + step));
                let rate = |before: [f64; 2], after: [f64; 2]| [0, 1].map(|i| (after[i] - before[i]) / (2.0 * HALF));
                let (rate_a, rate_b) = (rate(before, after), rate(of_b_before, of_b_after));
                let speed = length([rate_a[0] - rate_b[0], rate_a[1] - rate_b[1]]);
                prop_assert!(speed <= bound.speed([reach, 0.0]) + DIFFERENCE * 1e3, "{} {}", frames[a].name, frames[b].name);
                // the states of a pair have these rates, in inertial axes
                let relative = workspace.states(kinematics, &motion.interval(), &pair, time);
                let exact = |state: &FrameState, at: [f64; 2]| {
                    let ([dx, dy], [omega, vx, vy]) = (state.rotated(at), state.twist);
                    length([vx - omega * dy, vy + omega * dx])
                };
                prop_assert!((exact(&relative[0], point_a) - length(rate_a)).abs() < DIFFERENCE * 1e3, "{}", frames[a].name);
                prop_assert!((exact(&relative[1], [0.0; 2]) - length(rate_b)).abs() < DIFFERENCE * 1e3, "{}", frames[b].name);
            }
        }
    }

    /// The interpolant's rates stay below their bound, which is at most three times the largest, and its accelerations
    /// reach theirs at an end.
    #[test]
    fn bounds_of_an_interpolant(ends in uniform2(uniform2(-2.0..2.0_f64)), span in 0.1..3.0_f64) {
        let [start, end] = ends.each_ref().map(|[x, v]| [std::slice::from_ref(x), std::slice::from_ref(v)]);
        let interval = PathInterval { span: [1.0, 1.0 + span], start, end };
        let (mut rate, mut acceleration) = ([0.0], [0.0]);
        interval.bounds(&[0.0], &mut rate, &mut acceleration);
        let rate_at = |part: f64| {
            let (mut x, mut v) = ([0.0], [0.0]);
            interval.at(1.0 + part * span, &mut x, &mut v);
            v[0]
        };
        let largest = (0..=1000).map(|i| rate_at(f64::from(i) / 1000.0).abs()).fold(0.0, f64::max);
        prop_assert!(largest <= rate[0] * (1.0 + 1e-12) && rate[0] <= 3.0 * largest * (1.0 + 1e-5), "{} {}", rate[0], largest);
        // the rate is a quadratic polynomial: differences of its values give its derivatives at the ends exactly
        let [a, b, c] = [0.0, 0.5, 1.0].map(rate_at);
        let at_ends = f64::max((4.0 * b - 3.0 * a - c).abs(), (3.0 * c + a - 4.0 * b).abs()) / span;
        planar_proof::assert_close("acceleration", &acceleration, &[at_ends], 1e-12 * (1.0 + at_ends) / span);
    }
}

/// A base with an arm of two links along the x-axis.
fn straight_arm() -> Vec<Frame> {
    let frame = |i: usize, pose: [f64; 3], motion: FrameMotion| Frame {
        name: format!("{motion:?}"),
        parent: i.checked_sub(1),
        pose,
        motion,
        arm: Some(0),
    };
    vec![
        frame(0, [0.0; 3], FrameMotion::Base),
        frame(1, [0.0, 0.5, 0.0], FrameMotion::Joint(0)),
        frame(2, [0.0, 1.0, 0.0], FrameMotion::Joint(1)),
        frame(3, [0.0, 0.7, 0.0], FrameMotion::Fixed),
    ]
}

/// A stretched arm whose base and joints all turn one way reaches the bounds of speed, at constant rates those of
/// acceleration, and from rest those of angular acceleration.
#[test]
fn bounds_are_attained_by_a_stretched_arm() {
    let frames = straight_arm();
    let kinematics = &FrameKinematics::new(&frames, TargetMotion::Free(&[]));
    let rates = vec![0.6, 0.0, 0.3, 0.4, 0.9]; // turns, moves across
    let scaled = |factor: f64| rates.iter().map(|rate| rate * factor).collect::<Vec<_>>();
    let turning =
        Motion { kinematics, span: [-0.5, 0.5], ends: [[scaled(-0.5), rates.clone()], [scaled(0.5), rates.clone()]] };
    let short = 1e-3;
    let starting = Motion {
        kinematics,
        span: [-short, short],
        ends: [[scaled(0.5 * short * short), scaled(-short)], [scaled(0.5 * short * short), scaled(short)]],
    };
    // seen from the base, which turns with them, only the joints turn
    let mut workspace = PathWorkspace::default();
    workspace.set_bounds(kinematics, &turning.interval());
    let bound = workspace.relative_bound(kinematics, &kinematics.pair([0, 3]));
    let ([first, second], reach) = ([0.4, 0.4 + 0.9], 0.7 + 0.3);
    assert!((bound.speed([0.4, 0.3]) - (first + second * reach)).abs() < 1e-12);
    assert!((bound.acceleration([0.4, 0.3]) - (first * first + second * second * reach)).abs() < 1e-12);
    for (motion, at_constant_rates) in [(turning, true), (starting, false)] {
        for (frame, bound) in motion.bounds().iter().enumerate() {
            for reach in [0.0, 0.3, 2.0] {
                let [velocity, acceleration] = motion.point_motion(frame, [reach, 0.0], 0.0);
                if at_constant_rates {
                    assert!(
                        (bound.speed_within(reach) - length(motion.relative(velocity))).abs() < 1e-12,
                        "{frame} {velocity:?}"
                    );
                }
                let bound = bound.acceleration_within(reach);
                assert!((bound - length(acceleration)).abs() < 1e-4, "{frame} {reach}: {bound} {acceleration:?}");
            }
        }
    }
}

/// A target beyond the end of a stretched arm that holds it, where base and joints all turn one way, reaches the bound of its
/// speed: it is carried as far as its COM is from the end effector.
#[test]
fn the_bound_of_a_held_target_is_attained() {
    let layout = layout("dual_arm_2r");
    let (model, angles) = (registry::generic(&layout), vec![0.0, 0.0, PI, 0.0]);
    let mut tips = [[0.0; 3]; 2];
    model.end_effector_poses(&[0.0; 3], &angles, &mut tips).expect("poses");
    let state =
        RobotState { base_pose: [0.0; 3], joint_angles: angles, base_twist: [0.0; 3], joint_rates: vec![0.0; 4] };
    let held = Body { mass: 2.0, inertia: 0.3, pose: [PI, tips[1][1] - 0.4, tips[1][2]], twist: [0.0; 3] };
    let grasp = [Attachment { target: 0, arm: 1, kind: ContactKind::Rigid }];
    let assembly = Assembly::new(model, &state, &[held], &grasp).expect("an assembly");
    let (frames, targets) = (frames(&layout, ["held"]), [held]);
    let kinematics = &FrameKinematics::new(&frames, TargetMotion::Assembled(&assembly, &targets));
    let rates = vec![0.6, 0.0, 0.0, 0.0, 0.0, 0.4, 0.9];
    let middle = [0.0, 0.0, 0.0, 0.0, 0.0, PI, 0.0];
    let moved = |time: f64| middle.iter().zip(&rates).map(|(angle, rate)| angle + time * rate).collect::<Vec<_>>();
    let ends = [[moved(-0.5), rates.clone()], [moved(0.5), rates.clone()]];
    let motion = Motion { kinematics, span: [-0.5, 0.5], ends };
    let frame = frames.len() - 1;
    for reach in [0.0, 0.3] {
        let [velocity, _] = motion.point_motion(frame, [reach, 0.0], 0.0);
        let bound = motion.bounds()[frame].speed_within(reach);
        assert!((bound - length(velocity)).abs() < 1e-9, "{reach}: {bound} {velocity:?}");
    }
}

/// A body that moves freely.
fn free_body(values: &[f64; 6]) -> Body {
    let [yaw, x, y, omega, vx, vy] = *values;
    Body { mass: 1.0, inertia: 1.0, pose: [3.0 * yaw, x, y], twist: [4.0 * omega, vx, vy] }
}

fn shape(kind: u8, size: f64) -> ConvexPart {
    let corners = |radii: [f64; 2]| {
        let corner = |k: u8| {
            let (sin, cos) = (TAU * (f64::from(k) / 5.0 + 0.1 * size)).sin_cos();
            [0.2 * size + radii[0] * cos, radii[1] * sin]
        };
        (0..5).map(corner).collect::<Vec<_>>()
    };
    let outline = match kind {
        0 => Outline::Disc { center: [0.3 * size, -0.1], radius: 0.4 * size },
        1 => Outline::Capsule { ends: [[-0.5 * size, 0.1], [0.6, 0.2 * size]], radius: 0.05 },
        _ => Outline::polygon(corners([0.7 * size, 0.2])).expect("a polygon"),
    };
    ConvexPart::of(&outline).remove(0)
}

/// Two parts of freely moving bodies.
struct FreePair<'a> {
    pair: PartPair<'a>,
    bodies: [Body; 2],
}

impl<'a> FreePair<'a> {
    fn new(parts: [&'a ConvexPart; 2], bodies: [Body; 2]) -> Self {
        let of = |i: usize| bodies[i].twist[0].powi(2) * parts[i].reach;
        let speed = |i: usize| {
            let [omega, vx, vy] = bodies[i].twist;
            vx.hypot(vy) + omega.abs() * parts[i].reach
        };
        Self { pair: PartPair { parts, speed: speed(0) + speed(1), acceleration: of(0) + of(1) }, bodies }
    }

    fn at(&self, time: f64) -> Instant {
        let state = |body: &Body| {
            let Body { pose, twist, .. } = body.after(time);
            FrameState::new(pose, twist)
        };
        self.pair.at(time, self.bodies.each_ref().map(state), &mut PlacedPart::default())
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..config() })]

    /// The bound is below the distance at every time; the first contact is that of dense samples, to a depth.
    #[test]
    fn distances_stay_above_their_bounds(
        values in uniform2([-1.0..1.0_f64, -2.0..2.0, -2.0..2.0, -1.0..1.0, -2.0..2.0, -2.0..2.0]),
        kinds in uniform2(0..4_u8), sizes in uniform2(0.5..1.5_f64), depth in 0.0..0.1_f64,
    ) {
        let parts = [shape(kinds[0], sizes[0]), shape(kinds[1], sizes[1])];
        let free = FreePair::new(parts.each_ref(), values.each_ref().map(free_body));
        let times = || (-500..=500).map(|i| f64::from(i) * 1e-3);
        for time in [-0.3, 0.0, 0.2] {
            let now = free.at(time);
            prop_assert!((free.pair.bound(&now, 0.0) - now.distance).abs() < 1e-12);
            for other in times().step_by(7) {
                let bound = free.pair.bound(&now, other - time);
                prop_assert!(bound <= free.at(other).distance + 1e-12, "{} {} {}", time, other, bound);
            }
        }
        // where two instants leave no doubt the distance is on its side of a level
        let rightmost = 0.4 * values[0][3].abs() - 0.45;
        let [left, right] = [-0.5, rightmost].map(|time| free.at(time));
        let nearest = left.distance.min(right.distance);
        for level in [-depth, nearest - 0.3, nearest - depth, nearest - 1e-3, nearest + 1e-3] {
            let within = || times().filter(|time| *time <= rightmost);
            let outside = |doubt: Option<[f64; 2]>| {
                within().filter(move |time| doubt.is_none_or(|[from, to]| !(from..=to).contains(time)))
            };
            for time in outside(free.pair.doubt(&left, &right, level)) {
                prop_assert!(free.at(time).distance >= level - 1e-12, "{} {}", time, level);
            }
            for time in outside(free.pair.doubt_below(&left, &right, level)) {
                prop_assert!(free.at(time).distance <= level + 1e-12, "{} {}", time, level);
            }
        }
        // at a kink the rate is that before or after
        let [before, now, after] = [-HALF, 0.0, HALF].map(|step| free.pair.distance_and_rate(&free.at(0.1 + step)));
        let ([distance, rate], differences) = (now, [now[0] - before[0], after[0] - now[0]].map(|change| change / HALF));
        prop_assert_eq!(distance.to_bits(), free.at(0.1).distance.to_bits());
        let nearest_difference = differences.map(|difference| (difference - rate).abs()).into_iter().fold(f64::INFINITY, f64::min);
        prop_assert!(nearest_difference < 1e-2, "{} {:?}", rate, differences);
        prop_assume!(free.at(-0.5).distance > -depth);
        let mut count = 0;
        let found = free.pair.first_contact([-0.5, 0.5], depth, |_, time| { count += 1; free.at(time) }).expect("bounds");
        let sampled = times().find(|time| free.at(*time).distance < -depth - 1e-9);
        match found {
            None => prop_assert_eq!(sampled, None),
            Some([before, after]) => {
                prop_assert!(free.at(before).distance >= -depth && free.at(after).distance < -depth);
                prop_assert!(times().filter(|time| *time <= before).all(|time| free.at(time).distance >= -depth));
            }
        }
        prop_assert!(count < 400, "{} distances", count);
    }
}

/// A disc that is inside a point for less than a nanosecond is met all the same.
#[test]
fn small_discs_are_met_at_any_speed() {
    let (point, still) = (ConvexPart::point(), Body { mass: 1.0, inertia: 1.0, pose: [0.0; 3], twist: [0.0; 3] });
    for (radius, speed) in [(1e-4, 3e6), (1e-6, 3e3), (1e-8, 30.0), (1e-8, 3e3)] {
        let disc = ConvexPart::of(&Outline::Disc { center: [0.0; 2], radius }).remove(0);
        let passing = Body { pose: [0.0, -0.3 * speed, 0.5 * radius], twist: [0.0, speed, 0.0], ..still };
        let free = FreePair::new([&point, &disc], [still, passing]);
        let found = free.pair.first_contact([0.0, 1.0], 1e-9, |_, time| free.at(time)).expect("bounds");
        let [before, after] = found.unwrap_or_else(|| panic!("{radius} m at {speed} m/s"));
        assert!(before < 0.3 && after > 0.3 - radius / speed && after < 0.3 + radius / speed, "{before} {after}");
    }
}

/// On a straight line the bound is the distance, less half the bound of accelerations times the square of the time.
#[test]
fn bounds_of_distances_are_attained_on_a_line() {
    let parts = [shape(0, 1.0), shape(1, 1.0)];
    let still = Body { mass: 1.0, inertia: 1.0, pose: [0.0; 3], twist: [0.0; 3] };
    let coming = Body { pose: [0.0, 5.0, -0.2], twist: [0.0, -1.5, 0.0], ..still };
    let mut free = FreePair::new(parts.each_ref(), [still, coming]);
    let line = Body { pose: [0.0, 5.0, -0.2], ..coming };
    free.bodies[1] = line;
    let now = free.at(0.0);
    for after in [0.5, 1.0] {
        let exact = free.at(after).distance;
        assert!((free.pair.bound(&now, after) - exact).abs() < 1e-12, "{after} {exact}");
        let slower = PartPair { acceleration: 0.8, ..free.pair };
        assert!((slower.bound(&now, after) - (exact - 0.4 * after * after)).abs() < 1e-12);
    }
}

/// From rest a distance changes by the acceleration alone, and no later than that.
#[test]
fn doubts_begin_where_an_accelerated_motion_is() {
    let (parts, acceleration) = ([ConvexPart::point(), ConvexPart::point()], 0.8);
    let pair = PartPair { parts: parts.each_ref(), speed: acceleration, acceleration };
    for sign in [-1.0, 1.0] {
        let at = |time: f64| {
            let (x, rate) = (1.0 + 0.5 * sign * acceleration * time * time, sign * acceleration * time);
            let moving = FrameState::new([0.0, x, 0.0], [0.0, rate, 0.0]);
            pair.at(time, [FrameState::new([0.0; 3], [0.0; 3]), moving], &mut PlacedPart::default())
        };
        let (left, right, level) = (at(0.0), at(1.0), 1.0 + 0.1 * sign);
        let doubt = if sign < 0.0 { pair.doubt(&left, &right, level) } else { pair.doubt_below(&left, &right, level) };
        // 0.1 m is half the acceleration times the square of 0.5 s
        planar_proof::assert_close("doubt", &doubt.expect("it goes beyond"), &[0.5, 1.0], 1e-12);
    }
}

/// Where no bound excludes a contact the search ends after its most divisions, with how many that are.
#[test]
fn parts_without_a_bound_are_not_searched_for_ever() {
    let parts = [ConvexPart::point(), ConvexPart::point()];
    let still = |x: f64| Body { mass: 1.0, inertia: 1.0, pose: [0.0, x, 0.0], twist: [0.0; 3] };
    let mut free = FreePair::new(parts.each_ref(), [still(0.0), still(1.0)]);
    (free.pair.speed, free.pair.acceleration) = (1e30, 1e30);
    let found = free.pair.first_contact([0.0, 100.0], 1e-9, |_, time| free.at(time));
    assert!(matches!(found, Err(Error::NotConverged { iterations: 1_000_000, .. })), "{found:?}");
}

/// Segments on one line, and a point on the line of one, are as far apart as their ends.
#[test]
fn parts_on_one_line() {
    let segment = [[0.0, 0.0], [1.0, 0.0]];
    for (other, radii, expected) in [
        (&[[3.0, 0.0]][..], 0.0, 2.0),
        (&[[-0.5, 0.0]], 0.2, 0.3),
        (&[[1.5, 0.0], [4.0, 0.0]], 0.0, 0.5),
        (&[[-1.0, 0.0], [-3.0, 0.0]], 0.25, 0.75),
        (&[[0.5, 0.0]], 0.25, -0.25),
    ] {
        for found in [separation_of(&segment, other, radii), separation_of(other, &segment, radii)] {
            assert!((found.distance - expected).abs() < 1e-15, "{other:?}: {}", found.distance);
        }
    }
}

/// What is kept of some times is that of these times, asked in any order, of the frames between two, and of one interval.
#[test]
fn states_are_those_of_their_time() {
    let frames = straight_arm();
    let kinematics = &FrameKinematics::new(&frames, TargetMotion::Free(&[]));
    let motion = |rate: f64| Motion {
        kinematics,
        span: [0.0, 200.0],
        ends: [[vec![0.0; 5], vec![0.0; 5]], [vec![0.0, 0.0, 0.0, rate, -1.5], vec![0.1, 0.0, 0.0, 0.3, rate]]],
    };
    let mut workspace = PathWorkspace::default();
    for motion in [motion(2.0), motion(0.5)] {
        workspace.set_bounds(kinematics, &motion.interval());
        let times = (0..=200).chain([0, 199, 5, 200, 5, 130, 5]).map(f64::from);
        for (time, frames) in times.flat_map(|time| [[0, 3], [1, 3], [3, 0]].map(|frames| (time, frames))) {
            let states = motion.states(time);
            let [[_, ax, ay], [_, bx, by]] = frames.map(|frame: usize| states[frame].pose);
            let found = workspace.origin_distance(kinematics, &motion.interval(), &kinematics.pair(frames), time);
            // rounding: the distance is found in the frame that carries both
            assert!((found - (ax - bx).hypot(ay - by)).abs() < 1e-14, "{time}: {frames:?}");
        }
    }
}

/// The bound of a point over the edge of a rod that turns: right in first order, below the distance in second order by
/// what the motion needs, whether the point moves along the rod or is far from it.
#[test]
fn bounds_with_a_normal_that_turns() {
    let rod = ConvexPart::of(&Outline::Capsule { ends: [[-0.2, 0.0], [0.2, 0.0]], radius: 0.0 }).remove(0);
    let point = ConvexPart::point();
    let body = |pose, twist| Body { mass: 1.0, inertia: 1.0, pose, twist };
    for (distance, rate, speed) in [(0.01, 1.0, 10.0), (1.0, 1.0, 0.0), (0.5, -2.0, 1.0), (-0.05, 0.3, 0.1)] {
        let turning = body([0.0; 3], [rate, 0.0, 0.0]);
        let passing = body([0.0, 0.0, distance], [0.0, speed, 0.0]);
        for swap in [false, true] {
            let mut free = FreePair::new([&rod, &point], [turning, passing]);
            if swap {
                free = FreePair::new([&point, &rod], [passing, turning]);
            }
            let now = free.at(0.0);
            for after in [-1e-2, -1e-3, 1e-3, 1e-2] {
                let (bound, exact) = (free.pair.bound(&now, after), free.at(after).distance);
                let curvature = (exact - bound) / (after * after);
                let largest = 4.0 * (speed + rate.abs()) * rate.abs();
                assert!(curvature > -1e-9 && curvature < largest, "{distance} {rate} {speed} {after}: {curvature}");
            }
        }
    }
}
