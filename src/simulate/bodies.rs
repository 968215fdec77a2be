//! Rigid bodies of a robot and beside it: momentum, centre of mass and inertia of all together.

use crate::dynamics::{AnyModel, Momentum};
use crate::error::Error;
use crate::simulate::system::Body;
use crate::state::State;

/// The bodies of a robot, and the memory for them.
#[derive(Clone, Debug)]
pub(crate) struct BodyList {
    /// Mass (kg) and inertia (kg m²) of the base and of the links, arm by arm.
    inertias: Vec<[f64; 2]>,
    poses: Vec<[f64; 3]>,
    twists: Vec<[f64; 3]>,
    bodies: Vec<Body>,
}

impl BodyList {
    /// Of a robot, whose inertias are read once.
    pub(crate) fn new(model: &AnyModel<f64>) -> Result<Self, Error> {
        let count = model.joints() + 1;
        let mut inertias = vec![[0.0; 2]; count];
        model.body_inertias(&mut inertias)?;
        Ok(Self { inertias, poses: vec![[0.0; 3]; count], twists: vec![[0.0; 3]; count], bodies: Vec::new() })
    }

    /// The base, the links arm by arm, then the bodies beside the robot, each with its pose and twist.
    pub(crate) fn at(
        &mut self,
        model: &AnyModel<f64>,
        state: &State<'_, f64>,
        beside: &[Body],
    ) -> Result<&[Body], Error> {
        let Self { inertias, poses, twists, bodies } = self;
        model.body_poses(&state.base_pose, state.joint_angles, poses)?;
        model.body_twists(state, twists)?;
        let of_robot = inertias.iter().zip(poses).zip(twists);
        let of_robot = of_robot.map(|(([mass, inertia], pose), twist)| Body {
            mass: *mass,
            inertia: *inertia,
            pose: *pose,
            twist: *twist,
        });
        bodies.clear();
        bodies.extend(of_robot.chain(beside.iter().copied()));
        Ok(bodies)
    }
}

/// [`BodyList::at`], once.
pub(crate) fn bodies(model: &AnyModel<f64>, state: &State<'_, f64>, beside: &[Body]) -> Result<Vec<Body>, Error> {
    let mut list = BodyList::new(model)?;
    list.at(model, state, beside)?;
    Ok(list.bodies)
}

/// Σ |I ω| + m |r × v| and Σ m |v|, the scales that changes of angular and linear momentum are compared with.
pub(crate) fn momentum_sizes(bodies: &[Body]) -> [f64; 2] {
    let mut sizes = [0.0; 2];
    for Body { mass, inertia, pose: [_, x, y], twist: [omega, vx, vy] } in bodies {
        sizes[0] += (inertia * omega).abs() + mass * (x * vy - y * vx).abs();
        sizes[1] += mass * (vx * vx + vy * vy).sqrt();
    }
    sizes
}

/// [x, y] of the centre of mass of bodies together, m, and their mass, kg.
pub(crate) fn center_of_mass(bodies: &[Body]) -> ([f64; 2], f64) {
    let mass: f64 = bodies.iter().map(|body| body.mass).sum();
    let along = |axis: usize| bodies.iter().map(|body| body.mass * body.pose[axis]).sum::<f64>() / mass;
    ([along(1), along(2)], mass)
}

/// The moment of inertia of bodies together about a point [x, y], kg m².
pub(crate) fn inertia_about(bodies: &[Body], [x, y]: [f64; 2]) -> f64 {
    let about = |body: &Body| body.inertia + body.mass * ((body.pose[1] - x).powi(2) + (body.pose[2] - y).powi(2));
    bodies.iter().map(about).sum()
}

/// Momentum and energy of bodies together.
pub(crate) fn total_momentum(bodies: &[Body]) -> Momentum<f64> {
    let none = Momentum { linear_momentum: [0.0; 2], angular_momentum: 0.0, kinetic_energy: 0.0 };
    with_bodies(none, bodies)
}

/// A robot's momentum and energy with those of the bodies beside it.
pub(crate) fn with_bodies(mut total: Momentum<f64>, bodies: &[Body]) -> Momentum<f64> {
    for body in bodies {
        let ([l, px, py], energy) = body.momentum();
        total.linear_momentum = [total.linear_momentum[0] + px, total.linear_momentum[1] + py];
        total.angular_momentum += l;
        total.kinetic_energy += energy;
    }
    total
}
