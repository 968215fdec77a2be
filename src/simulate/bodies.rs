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
}

impl BodyList {
    /// Of a robot, whose inertias are read once.
    pub(crate) fn new(model: &AnyModel<f64>) -> Result<Self, Error> {
        let count = model.joints() + 1;
        let mut inertias = vec![[0.0; 2]; count];
        model.body_inertias(&mut inertias)?;
        Ok(Self { inertias, poses: vec![[0.0; 3]; count], twists: vec![[0.0; 3]; count] })
    }

    /// The base, the links arm by arm, then the bodies beside the robot, each with its pose and twist.
    pub(crate) fn at<'s>(
        &'s mut self,
        model: &AnyModel<f64>,
        state: &State<'_, f64>,
        beside: &'s [Body],
    ) -> Result<impl Iterator<Item = Body> + Clone + 's, Error> {
        let Self { inertias, poses, twists } = self;
        model.body_poses(&state.base_pose, state.joint_angles, poses)?;
        model.body_twists(state, twists)?;
        let of_robot = inertias.iter().zip(&*poses).zip(&*twists);
        let of_robot = of_robot.map(|(([mass, inertia], pose), twist)| Body {
            mass: *mass,
            inertia: *inertia,
            pose: *pose,
            twist: *twist,
        });
        Ok(of_robot.chain(beside.iter().copied()))
    }
}

/// The bodies of a robot and those beside it.
pub(crate) fn bodies(model: &AnyModel<f64>, state: &State<'_, f64>, beside: &[Body]) -> Result<Vec<Body>, Error> {
    Ok(BodyList::new(model)?.at(model, state, beside)?.collect())
}

/// Sums over bodies.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BodySums {
    /// kg.
    pub(crate) mass: f64,
    /// Σ m [x, y], kg m.
    pub(crate) first_moment: [f64; 2],
    /// [l, px, py] about the inertial origin, N m s, N s.
    pub(crate) momentum: [f64; 3],
    /// J.
    pub(crate) kinetic_energy: f64,
    /// Σ |I ω| + m |r × v| and Σ m |v|, the scales that changes of angular and linear momentum are compared with.
    pub(crate) momentum_sizes: [f64; 2],
}

impl BodySums {
    /// Of these bodies.
    pub(crate) fn new(bodies: impl Iterator<Item = Body>) -> Self {
        bodies.fold(Self::default(), |sums, body| sums.with(&body))
    }

    /// With one body more.
    #[inline]
    pub(crate) fn with(&self, body: &Body) -> Self {
        let Body { mass, inertia, pose: [_, x, y], twist: [omega, vx, vy] } = *body;
        let ([l, px, py], energy) = body.momentum();
        let ([mx, my], momentum, sizes) = (self.first_moment, self.momentum, self.momentum_sizes);
        Self {
            mass: self.mass + mass,
            first_moment: [mx + mass * x, my + mass * y],
            momentum: [momentum[0] + l, momentum[1] + px, momentum[2] + py],
            kinetic_energy: self.kinetic_energy + energy,
            momentum_sizes: [
                sizes[0] + ((inertia * omega).abs() + mass * (x * vy - y * vx).abs()),
                sizes[1] + mass * (vx * vx + vy * vy).sqrt(),
            ],
        }
    }

    /// [x, y] of the centre of mass, m.
    pub(crate) fn center_of_mass(&self) -> [f64; 2] {
        self.first_moment.map(|moment| moment / self.mass)
    }

    /// Momentum and energy.
    pub(crate) fn momentum(&self) -> Momentum<f64> {
        let [angular_momentum, px, py] = self.momentum;
        Momentum { linear_momentum: [px, py], angular_momentum, kinetic_energy: self.kinetic_energy }
    }
}

/// The moment of inertia of bodies together about a point [x, y], kg m².
pub(crate) fn inertia_about(bodies: &[Body], [x, y]: [f64; 2]) -> f64 {
    let about = |body: &Body| body.inertia + body.mass * ((body.pose[1] - x).powi(2) + (body.pose[2] - y).powi(2));
    bodies.iter().map(about).sum()
}

/// A robot's momentum and energy with those of the bodies beside it.
pub(crate) fn with_bodies(mut total: Momentum<f64>, bodies: impl IntoIterator<Item = Body>) -> Momentum<f64> {
    for body in bodies {
        let ([l, px, py], energy) = body.momentum();
        total.linear_momentum = [total.linear_momentum[0] + px, total.linear_momentum[1] + py];
        total.angular_momentum += l;
        total.kinetic_energy += energy;
    }
    total
}
