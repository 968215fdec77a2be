//! A robot and its targets as free bodies under constraints, from joint coordinates and back.

use super::body::{Body, BodyPoint};
use super::constraint::Constraint;
use nalgebra::{DVector, Rotation2, Vector2};
use planar_layout::layout::Layout;

/// A revolute joint: the constraint's a is on the child, its b on the parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The joint's two points coincide.
    pub constraint: Constraint,
    /// Yaw of the child less that of the parent at joint angle 0.
    pub zero_angle: f64,
}

/// Base, links and targets, and the constraints between them.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// The base, the child link of each joint, then the targets.
    pub bodies: Vec<Body>,
    /// Arm by arm.
    pub joints: Vec<Joint>,
    /// End effector of each arm.
    pub end_effectors: Vec<BodyPoint>,
    /// Constraints of captured targets.
    pub captures: Vec<Constraint>,
}

impl System {
    /// The robot of a layout: forward kinematics by composing poses, and the twists by v + ω × r from body to body.
    pub fn new(layout: &Layout, base_pose: [f64; 3], angles: &[f64], base_twist: [f64; 3], rates: &[f64]) -> Self {
        let base = Body { mass: layout.base.mass, inertia: layout.base.inertia, pose: base_pose, twist: base_twist };
        let mut all = Self { bodies: vec![base], joints: vec![], end_effectors: vec![], captures: vec![] };
        let mut moved = angles.iter().zip(rates);
        for arm in &layout.arms {
            let mut frame = BodyPoint { body: 0, offset: Vector2::from(arm.mount) };
            let mut zero_angle = arm.mount_angle;
            for link in &arm.links {
                let (angle, rate) = moved.next().expect("an angle and a rate per joint");
                let parent = all.bodies[frame.body];
                let (joint, velocity) = (frame.position(&all.bodies), frame.velocity(&all.bodies));
                let mut child = Body {
                    mass: link.mass,
                    inertia: link.inertia,
                    pose: [parent.pose[0] + zero_angle + angle, joint.x, joint.y],
                    twist: [parent.twist[0] + rate, velocity.x, velocity.y],
                };
                // from the joint to the COM
                let offset = child.rotated(Vector2::from(link.com));
                let velocity = child.velocity(offset);
                child.pose = [child.pose[0], joint.x + offset.x, joint.y + offset.y];
                child.twist = [child.twist[0], velocity.x, velocity.y];
                let body = all.add(child);
                let joint = BodyPoint { body, offset: -Vector2::from(link.com) };
                all.joints.push(Joint { constraint: Constraint { a: joint, b: frame, angle: None }, zero_angle });
                frame = BodyPoint { body, offset: Vector2::new(link.length, 0.0) - Vector2::from(link.com) };
                zero_angle = 0.0;
            }
            all.end_effectors.push(frame);
        }
        assert!(moved.next().is_none(), "an angle and a rate per joint");
        all
    }

    /// Adds a target and returns its index.
    pub fn add(&mut self, body: Body) -> usize {
        self.bodies.push(body);
        self.bodies.len() - 1
    }

    /// Position of an arm's end effector, inertial frame.
    pub fn end_effector(&self, arm: usize) -> Vector2<f64> {
        self.end_effectors[arm].position(&self.bodies)
    }

    /// The point of a body at a position in the inertial frame.
    pub fn body_point(&self, body: usize, position: Vector2<f64>) -> BodyPoint {
        let offset = Rotation2::new(-self.bodies[body].pose[0]) * (position - self.bodies[body].com());
        BodyPoint { body, offset }
    }

    /// All constraints: joints, then captures.
    pub fn constraints(&self) -> Vec<Constraint> {
        self.joints.iter().map(|joint| joint.constraint).chain(self.captures.iter().copied()).collect()
    }

    /// Relative joint angles.
    pub fn joint_angles(&self) -> Vec<f64> {
        self.relative(|body| body.pose[0]).iter().zip(&self.joints).map(|(yaw, joint)| yaw - joint.zero_angle).collect()
    }

    /// Joint rates.
    pub fn joint_rates(&self) -> Vec<f64> {
        self.relative(|body| body.twist[0])
    }

    /// A quantity of each joint's child less that of its parent.
    fn relative(&self, value: impl Fn(&Body) -> f64) -> Vec<f64> {
        let difference = |c: &Constraint| value(&self.bodies[c.a.body]) - value(&self.bodies[c.b.body]);
        self.joints.iter().map(|joint| difference(&joint.constraint)).collect()
    }

    /// Kinetic energy of all bodies, J.
    pub fn kinetic_energy(&self) -> f64 {
        self.bodies.iter().map(Body::kinetic_energy).sum()
    }

    /// Momentum [l, px, py] of all bodies about the inertial origin.
    pub fn momentum(&self) -> [f64; 3] {
        std::array::from_fn(|i| self.bodies.iter().map(|body| body.momentum()[i]).sum())
    }

    /// [Σ |I ω| + m |r × v|, Σ m |v|], the scale of rounding errors of the momentum.
    pub fn momentum_scale(&self) -> [f64; 2] {
        let linear = self.bodies.iter().map(|b| b.mass * b.twist[1].hypot(b.twist[2])).sum();
        let about = |b: &Body| (b.inertia * b.twist[0]).abs() + (b.momentum()[0] - b.inertia * b.twist[0]).abs();
        [self.bodies.iter().map(about).sum(), linear]
    }

    /// Base twist, joint rates and targets' twists, which determine the twists of all bodies.
    pub fn velocities(&self) -> Vec<f64> {
        let targets = self.bodies[1 + self.joints.len()..].iter().flat_map(|body| body.twist);
        self.bodies[0].twist.into_iter().chain(self.joint_rates()).chain(targets).collect()
    }

    /// Twists of all bodies.
    pub fn twists(&self) -> DVector<f64> {
        DVector::from_iterator(3 * self.bodies.len(), self.bodies.iter().flat_map(|body| body.twist))
    }

    /// Sets the twists of all bodies.
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
