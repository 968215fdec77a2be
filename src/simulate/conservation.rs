//! Errors of the conservation laws of momentum, energy and centre of mass, checked in every run.
//!
//! # Example
//! ```
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::simulate::conservation::{AccumulatedInput, ConservationAudit};
//! use planar_capture::state::State;
//!
//! let robot = Model::<f64>::default(); // 530 kg
//! let at = |velocity: f64| {
//!     let base_twist = [0.0, velocity, 0.0];
//!     State { base_pose: [0.0; 3], joint_angles: &[0.0; 3], base_twist, joint_rates: &[0.0; 3] }
//! };
//! let mut audit = ConservationAudit::new(&robot, &at(1.0), &[])?;
//! // the work and the impulse by which it is faster
//! let input = AccumulatedInput { time: 0.0, work: 265.0 * (1.21 - 1.0), impulse: [0.0, 53.0, 0.0] };
//! audit.record(&at(1.1), &[], &input)?;
//! assert!(audit.drift().momentum_drift < 1e-12 && audit.drift().energy_error < 1e-12);
//! // the same without them
//! audit.record(&at(1.1), &[], &AccumulatedInput::default())?;
//! assert!((audit.drift().momentum_drift - 0.1 / 1.1).abs() < 1e-12);
//! # Ok::<(), planar_capture::error::Error>(())
//! ```

use crate::dynamics::{AnyModel, Momentum};
use crate::error::Error;
use crate::scalar::Real;
use crate::simulate::bodies::{BodyList, BodySums};
use crate::simulate::system::Body;
use crate::state::State;

/// Largest drift of the centre of mass, the integral of the momentum drift, in a phase that passes the audit.
pub const CENTER_OF_MASS_BOUND: f64 = 1e-9;

/// Violations of the conservation laws in a phase, relative to the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ConservationErrors {
    /// Largest change of momentum, less the external impulse, over the largest Σ m|v|, or the same for the angular
    /// momentum about the inertial origin over the largest Σ |Iω| + m|r × v|: the larger of the two; 0 where nothing
    /// moves.
    pub momentum_drift: f64,
    /// Largest |E(t) − E(0) − work of joint torques and base torque| over the largest kinetic energy; 0 where nothing
    /// moves.
    pub energy_error: f64,
    /// Largest |c(t) − c(0) − p t/m| of the centre of mass c of all bodies, p/m being its velocity at the start, over
    /// the largest distance of a body's COM from it.
    pub center_of_mass_drift: f64,
}

impl ConservationErrors {
    /// The larger of each error.
    #[must_use]
    pub fn worse(&self, other: &Self) -> Self {
        Self {
            momentum_drift: Real::maximum(self.momentum_drift, other.momentum_drift),
            energy_error: Real::maximum(self.energy_error, other.energy_error),
            center_of_mass_drift: Real::maximum(self.center_of_mass_drift, other.center_of_mass_drift),
        }
    }
}

/// The input to the robot since the start of a phase. There is no external force: the centre of mass moves uniformly.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AccumulatedInput {
    /// Since the start, s.
    pub time: f64,
    /// Of joint torques and base torque, J.
    pub work: f64,
    /// External impulse [l, px, py], l about the inertial origin; N m s, N s.
    pub impulse: [f64; 3],
}

/// The conservation errors of a phase so far.
pub struct ConservationAudit<'a> {
    model: &'a AnyModel<f64>,
    bodies: BodyList,
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
        self.deviation = Real::maximum(self.deviation, deviation.abs());
        self.scale = Real::maximum(self.scale, scale);
    }

    fn value(self) -> f64 {
        if self.scale == 0.0 { 0.0 } else { self.deviation / self.scale }
    }
}

impl<'a> ConservationAudit<'a> {
    /// Starts at a state, from which the input is counted.
    ///
    /// # Errors
    /// Those of the model.
    pub fn new(model: &'a AnyModel<f64>, state: &State<'_, f64>, beside: &[Body]) -> Result<Self, Error> {
        let mut bodies = BodyList::new(model)?;
        let sums = BodySums::new(bodies.at(model, state, beside)?);
        let (start, center) = (sums.momentum(), sums.center_of_mass());
        let none = Ratio::default();
        let mut audit = Self { model, bodies, start, center, linear: none, angular: none, energy: none, motion: none };
        audit.record(state, beside, &AccumulatedInput::default())?;
        Ok(audit)
    }

    /// Checks one state after the input since the start.
    ///
    /// # Errors
    /// Those of the model.
    pub fn record(&mut self, state: &State<'_, f64>, beside: &[Body], input: &AccumulatedInput) -> Result<(), Error> {
        let bodies = self.bodies.at(self.model, state, beside)?;
        let sums = BodySums::new(bodies.clone());
        let now = sums.momentum();
        let [angular, linear] = sums.momentum_sizes;
        let [l, px, py] = input.impulse;
        let [x0, y0] = self.start.linear_momentum;
        let [x1, y1] = now.linear_momentum;
        self.linear.record(length([x1 - x0 - px, y1 - y0 - py]), linear);
        self.energy.record(now.kinetic_energy - self.start.kinetic_energy - input.work, now.kinetic_energy);
        let [x, y] = sums.center_of_mass();
        let squares = bodies.map(|body| (body.pose[1] - x).powi(2) + (body.pose[2] - y).powi(2));
        let extent = squares.fold(0.0, |most, square| if square > most { square } else { most }).sqrt();
        let [from_x, from_y] = self.center;
        let [along_x, along_y] = [x0, y0].map(|momentum| momentum / sums.mass * input.time);
        self.motion.record(length([x - from_x - along_x, y - from_y - along_y]), extent);
        self.angular.record(now.angular_momentum - self.start.angular_momentum - l, angular);
        Ok(())
    }

    /// Momentum and energy of robot and bodies together.
    ///
    /// # Errors
    /// Those of the model.
    pub fn momentum(&mut self, state: &State<'_, f64>, beside: &[Body]) -> Result<Momentum<f64>, Error> {
        Ok(BodySums::new(self.bodies.at(self.model, state, beside)?).momentum())
    }

    /// Adds the momentum and the energy of a state between those that are checked to the scales of the errors: in a long
    /// step from rest to rest there is no other that moves.
    ///
    /// # Errors
    /// Those of the model.
    pub fn scale(&mut self, state: &State<'_, f64>, beside: &[Body]) -> Result<(), Error> {
        let sums = BodySums::new(self.bodies.at(self.model, state, beside)?);
        let [angular, linear] = sums.momentum_sizes;
        self.linear.record(0.0, linear);
        self.angular.record(0.0, angular);
        self.energy.record(0.0, sums.momentum().kinetic_energy);
        Ok(())
    }

    /// The errors so far.
    #[must_use]
    pub fn drift(&self) -> ConservationErrors {
        ConservationErrors {
            momentum_drift: Real::maximum(self.linear.value(), self.angular.value()),
            energy_error: self.energy.value(),
            center_of_mass_drift: self.motion.value(),
        }
    }
}

/// Of a vector whose square is within the range of numbers.
fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}
