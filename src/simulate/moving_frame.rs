//! The frame that a phase is integrated in: one that moves with the centre of mass where that goes far.
//!
//! Mechanics is the same in every frame that moves uniformly; rounding is not. Beside a velocity V of all bodies their
//! relative velocities v have the digits that `ε V / v` leaves, and the momentum of constraints and of canonical variables
//! drifts with every step.

use crate::dynamics::Momentum;
use crate::error::Error;
use crate::simulate::bodies::{BodyList, BodySums};
use crate::simulate::system::System;
use crate::state::{Coordinates, State, StateVector, coordinates_mut, split_mut};

/// A frame whose axes are the inertial ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct MovingFrame {
    /// Its origin at the start of a phase, m.
    pub origin: [f64; 2],
    /// Of its origin, m/s.
    pub velocity: [f64; 2],
    joints: usize,
}

/// Kinetic energy of the motion with the centre of mass, over that relative to it, from which the frame moves: ten times
/// the speeds. Below, nothing is gained, and steps that conserve the angular momentum about a fixed point to rounding
/// would do so about one that moves with the errors of the centre of mass.
const FAST: f64 = 100.0;

impl MovingFrame {
    /// Of the centre of mass of robot and bodies at `x`, where it is far faster than they are relative to it and goes
    /// farther than the robot reaches; else the inertial frame.
    pub(crate) fn of(system: &System<'_>, x: &[f64], duration: f64) -> Result<Self, Error> {
        let joints = system.model.joints();
        let bodies = system.bodies_at(x)?;
        let mut list = BodyList::new(system.model)?;
        let sums = BodySums::new(list.at(system.model, &State::from_vector(x, joints)?, &bodies)?);
        let Momentum { linear_momentum, kinetic_energy, .. } = sums.momentum();
        let velocity @ [vx, vy] = linear_momentum.map(|momentum| momentum / sums.mass);
        let of_center = 0.5 * sums.mass * (vx * vx + vy * vy);
        let is_near = libm::hypot(vx, vy) * duration <= system.reach;
        if is_near || of_center <= FAST * (kinetic_energy - of_center) {
            return Ok(Self { joints, ..Self::default() });
        }
        Ok(Self { origin: sums.center_of_mass(), velocity, joints })
    }

    /// Whether it is another than the inertial frame.
    #[allow(clippy::float_cmp, reason = "numbers that are copied")]
    pub(crate) fn is_moving(&self) -> bool {
        self.velocity != [0.0; 2]
    }

    /// Moves an integrated vector from the inertial frame to this one.
    pub(crate) fn enter(&self, time: f64, x: &mut [f64]) -> Result<(), Error> {
        self.add([-1.0, -time], -1.0, x)
    }

    /// Moves an integrated vector from this frame to the inertial one.
    pub(crate) fn leave(&self, time: f64, x: &mut [f64]) -> Result<(), Error> {
        self.add([1.0, time], 1.0, x)
    }

    /// Moves d/dt of an integrated vector from this frame to the inertial one.
    pub(crate) fn leave_rate(&self, rate: &mut [f64]) -> Result<(), Error> {
        self.add([0.0, 1.0], 0.0, rate)
    }

    /// By how much positions in the inertial frame are rounded, m.
    pub(crate) fn rounding(&self, time: f64) -> f64 {
        let [x, y] = [0, 1].map(|i: usize| self.origin[i] + self.velocity[i] * time);
        f64::EPSILON * libm::hypot(x, y)
    }

    /// Adds so many origins and velocities to each place, and so many velocities to each linear velocity.
    fn add(&self, [origins, velocities]: [f64; 2], to_velocities: f64, x: &mut [f64]) -> Result<(), Error> {
        if !self.is_moving() {
            return Ok(());
        }
        let to_place = |i: usize| origins * self.origin[i] + velocities * self.velocity[i];
        let StateVector { positions, rates, .. } = split_mut(x)?;
        for (half, by) in [(positions, [0, 1].map(to_place)), (rates, self.velocity.map(|v| to_velocities * v))] {
            let Coordinates { base, bodies, .. } = coordinates_mut(half, self.joints)?;
            for [_, x, y] in std::iter::once(base).chain(bodies) {
                *x += by[0];
                *y += by[1];
            }
        }
        Ok(())
    }
}
