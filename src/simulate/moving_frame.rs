//! The frame that a phase is integrated in: one that moves with the centre of mass where that goes far.
//!
//! Mechanics is the same in every frame that moves uniformly; rounding is not. Beside a velocity V of all bodies their
//! relative velocities v have the digits that `ε V / v` leaves, and the momentum of constraints and of canonical variables
//! drifts with every step.

use crate::error::Error;
use crate::simulate::bodies::{BodyList, BodySums};
use crate::simulate::system::System;
use crate::state::{Coordinates, State, StateVector, coordinates_mut, split_mut};

/// A frame whose axes are the inertial ones, and whose origin is the inertial one at the start of a phase.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct MovingFrame {
    /// Of its origin, m/s.
    pub velocity: [f64; 2],
    joints: usize,
}

impl MovingFrame {
    /// Of the centre of mass of robot and bodies at `x`, where it goes farther than the robot reaches; else the inertial
    /// frame.
    pub(crate) fn of(system: &System<'_>, x: &[f64], duration: f64) -> Result<Self, Error> {
        let joints = system.model.joints();
        let bodies = system.bodies_at(x)?;
        let mut list = BodyList::new(system.model)?;
        let sums = BodySums::new(list.at(system.model, &State::from_vector(x, joints)?, &bodies)?);
        let velocity @ [vx, vy] = sums.momentum().linear_momentum.map(|momentum| momentum / sums.mass);
        let is_far = libm::hypot(vx, vy) * duration > system.reach;
        Ok(Self { velocity: if is_far { velocity } else { [0.0; 2] }, joints })
    }

    /// Moves an integrated vector from the inertial frame to this one.
    pub(crate) fn enter(&self, time: f64, x: &mut [f64]) -> Result<(), Error> {
        self.add(-time, -1.0, x)
    }

    /// Moves an integrated vector from this frame to the inertial one.
    pub(crate) fn leave(&self, time: f64, x: &mut [f64]) -> Result<(), Error> {
        self.add(time, 1.0, x)
    }

    /// Moves d/dt of an integrated vector from this frame to the inertial one.
    pub(crate) fn leave_rate(&self, rate: &mut [f64]) -> Result<(), Error> {
        self.add(1.0, 0.0, rate)
    }

    /// By how much positions in the inertial frame are rounded, m.
    pub(crate) fn rounding(&self, time: f64) -> f64 {
        let [vx, vy] = self.velocity;
        f64::EPSILON * libm::hypot(vx, vy) * time
    }

    /// Adds so many velocities to each place and to each linear velocity.
    fn add(&self, to_places: f64, to_velocities: f64, x: &mut [f64]) -> Result<(), Error> {
        if self.velocity == [0.0; 2] {
            return Ok(());
        }
        let StateVector { positions, rates, .. } = split_mut(x)?;
        for (half, factor) in [(positions, to_places), (rates, to_velocities)] {
            let Coordinates { base, bodies, .. } = coordinates_mut(half, self.joints)?;
            for [_, x, y] in std::iter::once(base).chain(bodies) {
                *x += factor * self.velocity[0];
                *y += factor * self.velocity[1];
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
