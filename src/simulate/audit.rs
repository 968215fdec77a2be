//! What must not change while the robot moves, watched in every run.

use crate::dynamics::{Model, Momentum};
use crate::error::Error;
use crate::simulate::system::Body;
use crate::state::State;

/// How far a phase strayed from the conservation laws, relative to what moved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// Largest change of momentum, less the impulse from outside, over the largest Σ m|v|, or the same for the angular
    /// momentum about the inertial origin over the largest Σ |Iω| + m|r × v|: the larger of the two; 0 where nothing moves.
    pub momentum_drift: f64,
    /// Largest |E(t) − E(0) − work of joint torques and base torque| over the largest kinetic energy; 0 where nothing moves.
    pub energy_error: f64,
    /// Largest |c(t) − c(0) − p t/m| of the centre of mass c of all bodies, p/m being its velocity at the start, over the
    /// largest distance of a body's COM from it.
    pub center_of_mass_drift: f64,
}

impl Drift {
    /// The worse of all, number by number.
    #[must_use]
    pub fn worse(&self, other: &Self) -> Self {
        Self {
            momentum_drift: self.momentum_drift.max(other.momentum_drift),
            energy_error: self.energy_error.max(other.energy_error),
            center_of_mass_drift: self.center_of_mass_drift.max(other.center_of_mass_drift),
        }
    }
}

/// What was done to the robot since the start of a phase. No force from outside is among it: the centre of mass goes its way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Done {
    /// How long it is since the start, s.
    pub time: f64,
    /// By joint torques and from outside, J.
    pub work: f64,
    /// From outside: [l, px, py], angular momentum about the inertial origin; N m s, N s.
    pub impulse: [f64; 3],
}

/// Watches one phase.
pub struct Audit<'a> {
    model: &'a dyn Model<f64>,
    inertias: Vec<[f64; 2]>,
    poses: Vec<[f64; 3]>,
    twists: Vec<[f64; 3]>,
    start: Momentum<f64>,
    center: [f64; 2],
    linear: Ratio,
    angular: Ratio,
    energy: Ratio,
    motion: Ratio,
}

/// The largest deviation over the largest scale.
#[derive(Clone, Copy, Debug, Default)]
struct Ratio {
    deviation: f64,
    scale: f64,
}

impl Ratio {
    fn record(&mut self, deviation: f64, scale: f64) {
        self.deviation = self.deviation.max(deviation.abs());
        self.scale = self.scale.max(scale);
    }

    fn value(self) -> f64 {
        if self.scale > 0.0 { self.deviation / self.scale } else { 0.0 }
    }
}

impl<'a> Audit<'a> {
    /// Starts watching at a state; work is counted from here.
    ///
    /// # Errors
    /// What the model says of the state.
    pub fn new(model: &'a dyn Model<f64>, state: &State<'_, f64>, beside: &[Body]) -> Result<Self, Error> {
        let bodies = model.joints() + 1;
        let mut inertias = vec![[0.0; 2]; bodies];
        model.body_inertias(&mut inertias)?;
        let start = with_bodies(model.momentum(state)?, beside);
        let none = Ratio::default();
        let (mut poses, twists) = (vec![[0.0; 3]; bodies], vec![[0.0; 3]; bodies]);
        model.body_poses(&state.base_pose, state.joint_angles, &mut poses)?;
        let (center, _) = center_of_mass(masses(&inertias, &poses, beside));
        let mut audit = Self {
            model,
            inertias,
            poses,
            twists,
            start,
            center,
            linear: none,
            angular: none,
            energy: none,
            motion: none,
        };
        audit.record(state, beside, &Done::default())?;
        Ok(audit)
    }

    /// Looks at one state, this having been done to the robot since the start. Momentum and energy are of the robot and the
    /// bodies beside it together.
    ///
    /// # Errors
    /// What the model says of the state.
    pub fn record(&mut self, state: &State<'_, f64>, beside: &[Body], done: &Done) -> Result<Momentum<f64>, Error> {
        let now = with_bodies(self.model.momentum(state)?, beside);
        self.model.body_poses(&state.base_pose, state.joint_angles, &mut self.poses)?;
        self.model.body_twists(state, &mut self.twists)?;
        let (mut linear, mut angular) = (0.0, 0.0);
        let of_robot = self.inertias.iter().zip(self.poses.iter().zip(&self.twists));
        let of_bodies = beside.iter().map(|body| (body.mass, body.inertia, body.pose, body.twist));
        let parts = of_robot.map(|([mass, inertia], (pose, twist))| (*mass, *inertia, *pose, *twist));
        for (mass, inertia, [_, x, y], [omega, vx, vy]) in parts.chain(of_bodies) {
            linear += mass * vx.hypot(vy);
            angular += (inertia * omega).abs() + mass * (x * vy - y * vx).abs();
        }
        let [l, px, py] = done.impulse;
        let [x0, y0] = self.start.linear_momentum;
        let [x1, y1] = now.linear_momentum;
        self.linear.record((x1 - x0 - px).hypot(y1 - y0 - py), linear);
        self.angular.record(now.angular_momentum - self.start.angular_momentum - l, angular);
        self.energy.record(now.kinetic_energy - self.start.kinetic_energy - done.work, now.kinetic_energy);
        let bodies = masses(&self.inertias, &self.poses, beside);
        let ([x, y], mass) = center_of_mass(bodies.clone());
        let extent = bodies.fold(0.0, |most: f64, (_, [to_x, to_y])| most.max((to_x - x).hypot(to_y - y)));
        let [from_x, from_y] = self.center;
        let [along_x, along_y] = [x0, y0].map(|momentum| momentum / mass * done.time);
        self.motion.record((x - from_x - along_x).hypot(y - from_y - along_y), extent);
        Ok(now)
    }

    /// The phase so far.
    #[must_use]
    pub fn drift(&self) -> Drift {
        Drift {
            momentum_drift: self.linear.value().max(self.angular.value()),
            energy_error: self.energy.value(),
            center_of_mass_drift: self.motion.value(),
        }
    }
}

/// Mass (kg) and place [x, y] (m) of every body of a robot, and of those beside it.
fn masses<'a>(
    inertias: &'a [[f64; 2]],
    poses: &'a [[f64; 3]],
    beside: &'a [Body],
) -> impl Iterator<Item = (f64, [f64; 2])> + Clone + 'a {
    let of_robot = inertias.iter().zip(poses).map(|([mass, _], [_, x, y])| (*mass, [*x, *y]));
    of_robot.chain(beside.iter().map(|body| (body.mass, [body.pose[1], body.pose[2]])))
}

/// [x, y] of bodies together, m, and their mass, kg.
fn center_of_mass(bodies: impl Iterator<Item = (f64, [f64; 2])>) -> ([f64; 2], f64) {
    let sums = bodies.fold(([0.0; 2], 0.0), |(moment, mass), (part, [x, y])| {
        ([moment[0] + part * x, moment[1] + part * y], mass + part)
    });
    let (moment, mass) = sums;
    (moment.map(|moment| moment / mass), mass)
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
