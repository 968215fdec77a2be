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
use crate::simulate::bodies::{BodyList, BodySums, with_bodies};
use crate::simulate::body_tree::{BodyTree, LANES, Lanes};
use crate::simulate::system::Body;
use crate::state::{State, StateVector, split};

/// Arm of the linear momenta, in the extent of robot and bodies, that is at least the scale of angular momentum: where all
/// move along one line through the origin there is none, and its rounding is an error of no meaning.
const LEAST_ARM: f64 = 1e-4;

/// Largest drift of the centre of mass, the integral of the momentum drift, in a phase that passes the audit.
pub const CENTER_OF_MASS_BOUND: f64 = 1e-9;

/// Violations of the conservation laws in a phase, relative to the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ConservationErrors {
    /// Largest change of momentum, less the external impulse, over the largest Σ m|v|, or the same for the angular
    /// momentum about the inertial origin over the largest Σ |Iω| + m|r × v|, or a ten-thousandth of the largest
    /// Σ m|v| times the largest extent where that is larger: the larger of the two; 0 where nothing moves.
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
#[derive(Clone)]
pub struct ConservationAudit<'a> {
    model: &'a AnyModel<f64>,
    bodies: BodyList,
    tree: BodyTree,
    start: BodySums,
    pending: Pending,
    linear: Ratio,
    angular: Ratio,
    energy: Ratio,
    motion: Ratio,
}

/// Instants that are checked together.
#[derive(Clone)]
struct Pending {
    count: usize,
    /// One row per coordinate; the others are as the first.
    positions: Vec<Lanes>,
    rates: Vec<Lanes>,
    inputs: [AccumulatedInput; LANES],
}

impl Pending {
    /// Adds an instant, if there are as many coordinates.
    fn push(&mut self, positions: &[f64], rates: &[f64], input: &AccumulatedInput) -> Result<(), Error> {
        let lane = self.count;
        for (rows, numbers) in [(&mut self.positions, positions), (&mut self.rates, rates)] {
            if rows.len() != numbers.len() {
                let (expected, found) = (rows.len(), numbers.len());
                return Err(Error::Length { quantity: "audited coordinates", expected, found });
            }
            for (row, number) in rows.iter_mut().zip(numbers) {
                if lane == 0 {
                    *row = [*number; LANES];
                }
                row[lane] = *number;
            }
        }
        self.inputs[lane] = *input;
        self.count += 1;
        Ok(())
    }

    /// The same by its parts: base, joints, bodies beside the robot.
    fn push_parts(&mut self, state: &State<'_, f64>, beside: &[Body], input: &AccumulatedInput) -> Result<(), Error> {
        let State { base_pose, joint_angles, base_twist, joint_rates } = *state;
        let [poses, twists] = [0, 1].map(|i| beside.iter().flat_map(move |body| [body.pose, body.twist][i]));
        let positions: Vec<f64> = base_pose.into_iter().chain(joint_angles.iter().copied()).chain(poses).collect();
        let rates: Vec<f64> = base_twist.into_iter().chain(joint_rates.iter().copied()).chain(twists).collect();
        self.push(&positions, &rates, input)
    }
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
    /// Starts at a state, from which the input is counted. Bodies are the same ones in every state.
    ///
    /// # Errors
    /// Those of the model.
    pub fn new(model: &'a AnyModel<f64>, state: &State<'_, f64>, beside: &[Body]) -> Result<Self, Error> {
        let (bodies, mut tree) = (BodyList::new(model)?, BodyTree::new(model, beside)?);
        let rows = vec![[0.0; LANES]; tree.coordinates()];
        let inputs = [AccumulatedInput::default(); LANES];
        let mut pending = Pending { count: 0, positions: rows.clone(), rates: rows, inputs };
        pending.push_parts(state, beside, &AccumulatedInput::default())?;
        let start = tree.sums(&pending.positions, &pending.rates).at(0);
        let none = Ratio::default();
        Ok(Self { model, bodies, tree, start, pending, linear: none, angular: none, energy: none, motion: none })
    }

    /// Checks one state after the input since the start, with the next ones.
    ///
    /// # Errors
    /// [`Error::Length`] for a state of another robot or with other bodies, [`Error::NotFinite`] where the motion of this state
    /// or of one before it is not finite.
    pub fn record(&mut self, state: &State<'_, f64>, beside: &[Body], input: &AccumulatedInput) -> Result<(), Error> {
        self.pending.push_parts(state, beside, input)?;
        self.check_when_full()
    }

    /// The same for an integrated vector of the robot with these bodies.
    ///
    /// # Errors
    /// As [`record`](Self::record), and [`Error::StateVector`].
    pub fn record_vector(&mut self, x: &[f64], input: &AccumulatedInput) -> Result<(), Error> {
        let StateVector { positions, rates, .. } = split(x)?;
        self.pending.push(positions, rates, input)?;
        self.check_when_full()
    }

    fn check_when_full(&mut self) -> Result<(), Error> {
        if self.pending.count == LANES { self.check() } else { Ok(()) }
    }

    /// Checks the instants that are pending.
    fn check(&mut self) -> Result<(), Error> {
        let Self { tree, start, pending, linear, angular, energy, motion, .. } = self;
        let count = std::mem::take(&mut pending.count);
        let sums = tree.sums(&pending.positions, &pending.rates);
        let (before, center, mass) = (start.momentum(), start.center_of_mass(), start.mass);
        let velocity = before.linear_momentum.map(|momentum| momentum / mass);
        for (lane, input) in pending.inputs.iter().take(count).enumerate() {
            let sum = sums.at(lane);
            let (now, [of_angular, of_linear]) = (sum.momentum(), sum.momentum_sizes);
            let [x, y] = sum.center_of_mass();
            let numbers = [now.kinetic_energy, of_angular, of_linear, x, y];
            if let Some(index) = numbers.iter().position(|number| !number.is_finite()) {
                return Err(Error::NotFinite { quantity: "audited motion", index, value: numbers[index] });
            }
            let [l, px, py] = input.impulse;
            let [x0, y0] = before.linear_momentum;
            let [x1, y1] = now.linear_momentum;
            linear.record(length([x1 - x0 - px, y1 - y0 - py]), of_linear);
            angular.record(now.angular_momentum - before.angular_momentum - l, of_angular);
            energy.record(now.kinetic_energy - before.kinetic_energy - input.work, now.kinetic_energy);
            let [along_x, along_y] = velocity.map(|velocity| velocity * input.time);
            motion.record(length([x - center[0] - along_x, y - center[1] - along_y]), sums.extent[lane]);
        }
        Ok(())
    }

    /// Momentum and energy of robot and bodies together.
    ///
    /// # Errors
    /// Those of the model.
    pub fn momentum(&self, state: &State<'_, f64>, beside: &[Body]) -> Result<Momentum<f64>, Error> {
        Ok(with_bodies(self.model.momentum(state)?, beside.iter().copied()))
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

    /// The errors so far; NaN where a motion was not finite.
    #[must_use]
    pub fn drift(&self) -> ConservationErrors {
        let mut all = self.clone();
        if all.pending.count > 0 && all.check().is_err() {
            let none = f64::NAN;
            return ConservationErrors { momentum_drift: none, energy_error: none, center_of_mass_drift: none };
        }
        all.angular.record(0.0, LEAST_ARM * all.motion.scale * all.linear.scale);
        ConservationErrors {
            momentum_drift: Real::maximum(all.linear.value(), all.angular.value()),
            energy_error: all.energy.value(),
            center_of_mass_drift: all.motion.value(),
        }
    }
}

/// Of a vector whose square is within the range of numbers.
fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}
