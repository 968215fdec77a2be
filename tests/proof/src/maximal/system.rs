//! A robot and its targets as free bodies, and the way back to joint angles.

use super::body::Body;
use super::constraint::{BodyPoint, Tie};
use nalgebra::{DVector, Rotation2, Vector2};
use planar_layout::layout::Layout;

/// A revolute joint: its tie's first body is the child, the second the parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// That the joint's two points coincide.
    pub tie: Tie,
    /// Yaw of the child less that of the parent at joint angle 0.
    pub zero: f64,
}

/// Base, links arm by arm, targets; and what ties them.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// The base, the link that joint 0 moves, that of joint 1, …, then the targets.
    pub bodies: Vec<Body>,
    /// Arm by arm.
    pub joints: Vec<Joint>,
    /// The tip of each arm.
    pub tips: Vec<BodyPoint>,
    /// Captures that hold.
    pub held: Vec<Tie>,
}

impl System {
    /// The robot of a layout: forward kinematics by composing poses, and the twists by v + ω × r from body to body.
    pub fn new(layout: &Layout, base_pose: [f64; 3], angles: &[f64], base_twist: [f64; 3], rates: &[f64]) -> Self {
        let base = Body { mass: layout.base.mass, inertia: layout.base.inertia, pose: base_pose, twist: base_twist };
        let mut all = Self { bodies: vec![base], joints: vec![], tips: vec![], held: vec![] };
        let mut moved = angles.iter().zip(rates);
        for arm in &layout.arms {
            let (mut seat, mut zero) = (BodyPoint { body: 0, at: Vector2::from(arm.mount) }, arm.mount_angle);
            for link in &arm.links {
                let (angle, rate) = moved.next().expect("an angle and a rate per joint");
                let parent = all.bodies[seat.body];
                let arrow = parent.turned(seat.at);
                let (joint, velocity) = (parent.com() + arrow, parent.velocity(arrow));
                let mut child = Body {
                    mass: link.mass,
                    inertia: link.inertia,
                    pose: [parent.pose[0] + zero + angle, joint.x, joint.y],
                    twist: [parent.twist[0] + rate, velocity.x, velocity.y],
                };
                // so far pose and twist of its joint; now of its COM
                let arrow = child.turned(Vector2::from(link.com));
                let velocity = child.velocity(arrow);
                child.pose = [child.pose[0], joint.x + arrow.x, joint.y + arrow.y];
                child.twist = [child.twist[0], velocity.x, velocity.y];
                let body = all.add(child);
                let root = BodyPoint { body, at: -Vector2::from(link.com) };
                all.joints.push(Joint { tie: Tie { a: root, b: seat, angle: None }, zero });
                seat = BodyPoint { body, at: Vector2::new(link.length, 0.0) - Vector2::from(link.com) };
                zero = 0.0;
            }
            all.tips.push(seat);
        }
        assert!(moved.next().is_none(), "an angle and a rate per joint");
        all
    }

    /// Adds a body, a target, and returns its index.
    pub fn add(&mut self, body: Body) -> usize {
        self.bodies.push(body);
        self.bodies.len() - 1
    }

    /// Where a place is, inertial frame.
    pub fn position(&self, place: &BodyPoint) -> Vector2<f64> {
        let body = &self.bodies[place.body];
        body.com() + body.turned(place.at)
    }

    /// How a place moves.
    pub fn velocity(&self, place: &BodyPoint) -> Vector2<f64> {
        let body = &self.bodies[place.body];
        body.velocity(body.turned(place.at))
    }

    /// The place of a body that is now at `point`, inertial frame.
    pub fn place(&self, body: usize, point: Vector2<f64>) -> BodyPoint {
        let at = Rotation2::new(-self.bodies[body].pose[0]) * (point - self.bodies[body].com());
        BodyPoint { body, at }
    }

    /// Every constraint: joints, then what is held.
    pub fn ties(&self) -> impl Iterator<Item = &Tie> {
        self.joints.iter().map(|joint| &joint.tie).chain(&self.held)
    }

    /// Relative joint angles.
    pub fn joint_angles(&self) -> Vec<f64> {
        self.between_bodies(|body| body.pose[0]).iter().zip(&self.joints).map(|(yaw, j)| yaw - j.zero).collect()
    }

    /// Joint rates.
    pub fn joint_rates(&self) -> Vec<f64> {
        self.between_bodies(|body| body.twist[0])
    }

    /// A quantity of each joint's child less that of its parent.
    fn between_bodies(&self, of: impl Fn(&Body) -> f64) -> Vec<f64> {
        self.joints.iter().map(|j| of(&self.bodies[j.tie.a.body]) - of(&self.bodies[j.tie.b.body])).collect()
    }

    /// Everything's kinetic energy, J.
    pub fn kinetic_energy(&self) -> f64 {
        self.bodies.iter().map(Body::kinetic_energy).sum()
    }

    /// Everything's momentum [l, px, py] about the inertial origin.
    pub fn momentum(&self) -> [f64; 3] {
        std::array::from_fn(|i| self.bodies.iter().map(|body| body.momentum()[i]).sum())
    }

    /// Σ |I ω| + m |r × v|, Σ m |v|: what rounding of the momentum is measured by.
    pub fn momentum_scale(&self) -> [f64; 2] {
        let linear = self.bodies.iter().map(|b| b.mass * b.twist[1].hypot(b.twist[2])).sum();
        let about = |b: &Body| (b.inertia * b.twist[0]).abs() + (b.momentum()[0] - b.inertia * b.twist[0]).abs();
        [self.bodies.iter().map(about).sum(), linear]
    }

    /// Base twist, joint rates and targets' twists: with the positions, the twists of all bodies.
    pub fn velocities(&self) -> Vec<f64> {
        let targets = self.bodies[1 + self.joints.len()..].iter().flat_map(|body| body.twist);
        self.bodies[0].twist.into_iter().chain(self.joint_rates()).chain(targets).collect()
    }

    /// All twists, one after the other.
    pub fn twists(&self) -> DVector<f64> {
        DVector::from_iterator(3 * self.bodies.len(), self.bodies.iter().flat_map(|body| body.twist))
    }

    /// The same with other twists.
    pub fn set_twists(&mut self, twists: &DVector<f64>) {
        for (body, twist) in self.bodies.iter_mut().zip(twists.as_slice().chunks_exact(3)) {
            body.twist.copy_from_slice(twist);
        }
    }

    /// The diagonal of the mass matrix: inertia, mass, mass of each body.
    pub fn masses(&self) -> DVector<f64> {
        let three = |body: &Body| [body.inertia, body.mass, body.mass];
        DVector::from_iterator(3 * self.bodies.len(), self.bodies.iter().flat_map(three))
    }
}
