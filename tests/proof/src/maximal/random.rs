//! Random contacts of a layout's tips: any mixture of kinds over any arms, two arms on one target among them.

use super::body::Body;
use super::impact::{Contact, Kind};
use super::system::System;
use crate::sample::{RandomState, sample};
use planar_layout::layout::Layout;
use proptest::collection::vec;
use proptest::prelude::*;

/// A target, where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Object {
    /// kg.
    pub mass: f64,
    /// About its COM, kg m².
    pub inertia: f64,
    /// [yaw, x, y] of its COM.
    pub pose: [f64; 3],
    /// [ω, vx, vy] of its COM.
    pub twist: [f64; 3],
}

/// An arm's tip touches a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedContact {
    /// Which.
    pub arm: usize,
    /// Index into the scene's targets.
    pub target: usize,
    /// From the target's COM to the tip, inertial axes.
    pub offset: [f64; 2],
    /// What the contact does.
    pub kind: Kind,
}

/// A robot as an impact begins, in the product's terms; the sample's own targets are not used.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The robot's state, and torques.
    pub state: RandomState,
    /// What is touched.
    pub targets: Vec<Object>,
    /// At most one per arm, in arm order.
    pub touches: Vec<PlannedContact>,
}

impl Scene {
    /// Robot and targets as bodies; target i is body 1 + joints + i.
    pub fn system(&self, layout: &Layout) -> System {
        let s = &self.state;
        let mut all = System::new(layout, s.base_pose, &s.joint_angles, s.base_twist, &s.joint_rates);
        for target in &self.targets {
            let Object { mass, inertia, pose, twist } = *target;
            all.add(Body { mass, inertia, pose, twist });
        }
        all
    }

    /// The contacts between them.
    pub fn contacts(&self, all: &System) -> Vec<Contact> {
        let of = |touch: &PlannedContact| Contact::new(all, touch.arm, 1 + all.joints.len() + touch.target, touch.kind);
        self.touches.iter().map(of).collect()
    }

    /// How many contacts are bounces.
    pub fn bounces(&self) -> usize {
        self.touches.iter().filter(|touch| matches!(touch.kind, Kind::Bounce { .. })).count()
    }
}

/// What is drawn for one arm.
#[derive(Clone, Copy, Debug)]
struct Draw {
    touches: bool,
    /// Takes the target of the arm before it that has one.
    shares: bool,
    kind: u8,
    /// Direction of the normal, rad.
    direction: f64,
    /// Turned so that the contact approaches.
    approaches: bool,
    restitution: f64,
}

fn draw() -> impl Strategy<Value = Draw> {
    let restitution = prop_oneof![Just(0.0), Just(1.0), 0.0..1.0_f64];
    (prop::bool::weighted(0.8), any::<bool>(), 0..4_u8, -3.2..3.2_f64, prop::bool::weighted(0.8), restitution).prop_map(
        |(touches, shares, kind, direction, approaches, restitution)| Draw {
            touches,
            shares,
            kind,
            direction,
            approaches,
            restitution,
        },
    )
}

/// Scenes of a layout with one contact or more.
pub fn random_contacts(layout: Layout) -> impl Strategy<Value = Scene> {
    let (arms, joints) = (layout.arms.len(), layout.joints());
    (sample(arms, joints), vec(draw(), arms), vec(-3.2..3.2_f64, arms))
        .prop_filter("a contact", |(_, draws, _)| draws.iter().any(|draw| draw.touches))
        .prop_map(move |(state, draws, yaws)| scene(&layout, state, &draws, &yaws))
}

fn scene(layout: &Layout, state: RandomState, draws: &[Draw], yaws: &[f64]) -> Scene {
    let mut scene = Scene { state, targets: vec![], touches: vec![] };
    let robot = scene.system(layout);
    for (arm, draw) in draws.iter().enumerate().filter(|(_, draw)| draw.touches) {
        let tip = robot.position(&robot.tips[arm]);
        if !draw.shares || scene.targets.is_empty() {
            let ([mass, inertia, rx, ry], twist) = scene.state.targets[arm];
            scene.targets.push(Object { mass, inertia, pose: [yaws[arm], tip.x - rx, tip.y - ry], twist });
        }
        let target = scene.targets.len() - 1;
        let [_, x, y] = scene.targets[target].pose;
        let (sin, cos) = draw.direction.sin_cos();
        let kind = match draw.kind {
            0 => Kind::Rigid,
            1 => Kind::Pin,
            _ => Kind::Bounce { normal: [cos, sin], restitution: draw.restitution },
        };
        scene.touches.push(PlannedContact { arm, target, offset: [tip.x - x, tip.y - y], kind });
    }
    let all = scene.system(layout);
    let openings: Vec<_> = scene.contacts(&all).iter().map(|contact| contact.opening(&all)).collect();
    for ((touch, opening), draw) in scene.touches.iter_mut().zip(openings).zip(draws.iter().filter(|d| d.touches)) {
        if let (Kind::Bounce { normal, .. }, Some(opening)) = (&mut touch.kind, opening)
            && draw.approaches
            && opening > 0.0
        {
            *normal = normal.map(|n| -n);
        }
    }
    scene
}
