//! Random contacts of a layout's end effectors: any kinds on any arms, several arms on one target included.

use super::body::Body;
use super::impact::{Contact, Kind};
use super::system::System;
use crate::sample::{RandomState, sample};
use planar_layout::layout::Layout;
use proptest::collection::vec;
use proptest::prelude::*;

/// A contact of an arm's end effector with a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedContact {
    /// Index of the arm.
    pub arm: usize,
    /// Index into the scene's targets.
    pub target: usize,
    /// From the target's COM to the end effector, inertial axes.
    pub offset: [f64; 2],
    /// Its law.
    pub kind: Kind,
}

/// A robot and its targets at an impact; the targets of the random state are not used.
#[derive(Clone, Debug)]
pub struct Scene {
    /// State of the robot.
    pub state: RandomState,
    /// Targets in contact.
    pub targets: Vec<Body>,
    /// At most one per arm, in arm order.
    pub planned: Vec<PlannedContact>,
}

impl Scene {
    /// Robot and targets as bodies; target i is body 1 + joints + i.
    pub fn system(&self, layout: &Layout) -> System {
        let s = &self.state;
        let mut all = System::new(layout, s.base_pose, &s.joint_angles, s.base_twist, &s.joint_rates);
        all.bodies.extend(&self.targets);
        all
    }

    /// The contacts between them.
    pub fn contacts(&self, all: &System) -> Vec<Contact> {
        let contact = |c: &PlannedContact| Contact::new(all, c.arm, 1 + all.joints.len() + c.target, c.kind);
        self.planned.iter().map(contact).collect()
    }
}

/// Random choices of one arm.
#[derive(Clone, Copy, Debug)]
struct Draw {
    has_contact: bool,
    /// Shares the target of the last arm before it that has one.
    shares_target: bool,
    kind: u8,
    /// Direction of the normal, rad.
    direction: f64,
    /// The normal is reversed where the contact would separate.
    approaches: bool,
    restitution: f64,
}

fn draw() -> impl Strategy<Value = Draw> {
    let restitution = prop_oneof![Just(0.0), Just(1.0), 0.0..1.0_f64];
    (prop::bool::weighted(0.8), any::<bool>(), 0..4_u8, -3.2..3.2_f64, prop::bool::weighted(0.8), restitution).prop_map(
        |(has_contact, shares_target, kind, direction, approaches, restitution)| Draw {
            has_contact,
            shares_target,
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
        .prop_filter("a contact", |(_, draws, _)| draws.iter().any(|draw| draw.has_contact))
        .prop_map(move |(state, draws, yaws)| scene(&layout, state, &draws, &yaws))
}

fn scene(layout: &Layout, state: RandomState, draws: &[Draw], yaws: &[f64]) -> Scene {
    let mut scene = Scene { state, targets: vec![], planned: vec![] };
    let robot = scene.system(layout);
    for (arm, draw) in draws.iter().enumerate().filter(|(_, draw)| draw.has_contact) {
        let end_effector = robot.end_effector(arm);
        if !draw.shares_target || scene.targets.is_empty() {
            let ([mass, inertia, rx, ry], twist) = scene.state.targets[arm];
            let pose = [yaws[arm], end_effector.x - rx, end_effector.y - ry];
            scene.targets.push(Body { mass, inertia, pose, twist });
        }
        let target = scene.targets.len() - 1;
        let offset = (end_effector - scene.targets[target].com()).into();
        let (sin, cos) = draw.direction.sin_cos();
        let kind = match draw.kind {
            0 => Kind::Rigid,
            1 => Kind::Pin,
            _ => Kind::Bounce { normal: [cos, sin], restitution: draw.restitution },
        };
        scene.planned.push(PlannedContact { arm, target, offset, kind });
    }
    let all = scene.system(layout);
    let velocities: Vec<_> = scene.contacts(&all).iter().map(|contact| contact.normal_velocity(&all)).collect();
    for ((contact, velocity), draw) in
        scene.planned.iter_mut().zip(velocities).zip(draws.iter().filter(|d| d.has_contact))
    {
        if let (Kind::Bounce { normal, .. }, Some(velocity)) = (&mut contact.kind, velocity)
            && draw.approaches
            && velocity > 0.0
        {
            *normal = normal.map(|n| -n);
        }
    }
    scene
}
