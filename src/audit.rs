//! What must not change while the robot moves, watched in every run.

use crate::dynamics::{Model, Momentum};
use crate::error::Error;
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
    pub fn new(model: &'a dyn Model<f64>, state: &State<'_, f64>) -> Result<Self, Error> {
        let bodies = model.joints() + 1;
        let mut inertias = vec![[0.0; 2]; bodies];
        model.body_inertias(&mut inertias)?;
        let start = model.momentum(state)?;
        let none = Ratio::default();
        let (mut poses, twists) = (vec![[0.0; 3]; bodies], vec![[0.0; 3]; bodies]);
        model.body_poses(&state.base_pose, state.joint_angles, &mut poses)?;
        let center = center_of_mass(&inertias, &poses);
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
        audit.record(state, &Done::default())?;
        Ok(audit)
    }

    /// Looks at one state, this having been done to the robot since the start.
    ///
    /// # Errors
    /// What the model says of the state.
    pub fn record(&mut self, state: &State<'_, f64>, done: &Done) -> Result<Momentum<f64>, Error> {
        let now = self.model.momentum(state)?;
        self.model.body_poses(&state.base_pose, state.joint_angles, &mut self.poses)?;
        self.model.body_twists(state, &mut self.twists)?;
        let (mut linear, mut angular) = (0.0, 0.0);
        for ([mass, inertia], ([_, x, y], [omega, vx, vy])) in
            self.inertias.iter().zip(self.poses.iter().zip(&self.twists))
        {
            linear += mass * vx.hypot(*vy);
            angular += (inertia * omega).abs() + mass * (x * vy - y * vx).abs();
        }
        let [l, px, py] = done.impulse;
        let [x0, y0] = self.start.linear_momentum;
        let [x1, y1] = now.linear_momentum;
        self.linear.record((x1 - x0 - px).hypot(y1 - y0 - py), linear);
        self.angular.record(now.angular_momentum - self.start.angular_momentum - l, angular);
        self.energy.record(now.kinetic_energy - self.start.kinetic_energy - done.work, now.kinetic_energy);
        let mass: f64 = self.inertias.iter().map(|[mass, _]| mass).sum();
        let [x, y] = center_of_mass(&self.inertias, &self.poses);
        let [from_x, from_y] = self.center;
        let [along_x, along_y] = [x0, y0].map(|momentum| momentum / mass * done.time);
        let extent = self.poses.iter().fold(0.0, |most: f64, [_, to_x, to_y]| most.max((to_x - x).hypot(to_y - y)));
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

/// [x, y] of the bodies together, from their masses and poses.
fn center_of_mass(inertias: &[[f64; 2]], poses: &[[f64; 3]]) -> [f64; 2] {
    let (mut mass, mut moments) = (0.0, [0.0; 2]);
    for ([part, _], [_, x, y]) in inertias.iter().zip(poses) {
        mass += part;
        moments = [moments[0] + part * x, moments[1] + part * y];
    }
    moments.map(|moment| moment / mass)
}
