//! What moves in one phase: a robot, and the free bodies that it holds or may meet.

use crate::control::Control;
use crate::dynamics::Model;
use crate::error::Error;
use crate::motion::derivative;
use crate::state::{State, halves, vector_length};

/// A rigid body beside the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// kg.
    pub mass: f64,
    /// About its COM, kg m².
    pub inertia: f64,
    /// [yaw, x, y] of its COM, inertial frame; rad, m.
    pub pose: [f64; 3],
    /// [ω, vx, vy] of its COM, inertial axes; rad/s, m/s.
    pub twist: [f64; 3],
}

/// A robot and free bodies, as they are when a phase begins.
#[derive(Clone, Copy)]
pub struct System<'a> {
    /// The robot.
    pub model: &'a dyn Model<f64>,
    /// The bodies beside it.
    pub bodies: &'a [Body],
}

impl<'a> System<'a> {
    /// A robot alone.
    #[must_use]
    pub fn alone(model: &'a dyn Model<f64>) -> Self {
        Self { model, bodies: &[] }
    }

    /// The integrated vector at the start, from the robot's state.
    #[must_use]
    pub fn vector(&self, state: &State<'_, f64>) -> Vec<f64> {
        let joints = self.model.joints();
        let mut x = vec![0.0; vector_length(joints) + 6 * self.bodies.len()];
        state.write(&mut x);
        let half = 3 + joints + 3 * self.bodies.len();
        for (i, body) in self.bodies.iter().enumerate() {
            let place = 3 + joints + 3 * i;
            for (start, values) in [(place, body.pose), (half + place, body.twist)] {
                if let Some(entries) = x.get_mut(start..start + 3) {
                    entries.copy_from_slice(&values);
                }
            }
        }
        x
    }

    /// The bodies at an integrated vector.
    #[must_use]
    pub fn bodies_at(&self, x: &[f64]) -> Vec<Body> {
        let skip = 3 + self.model.joints();
        let part = |half: &[f64], i: usize| {
            half.get(skip + 3 * i..).and_then(|rest| rest.first_chunk::<3>()).copied().unwrap_or_default()
        };
        let (positions, rates) = halves(x).unwrap_or_default();
        let each = self.bodies.iter().enumerate();
        each.map(|(i, body)| Body { pose: part(positions, i), twist: part(rates, i), ..*body }).collect()
    }

    /// d/dt of the integrated vector under a control law; `torques` is left with its torques.
    ///
    /// # Errors
    /// What model and law say.
    pub fn derivative(
        &self,
        control: &mut dyn Control<f64>,
        time: f64,
        x: &[f64],
        rate: &mut [f64],
        torques: &mut [f64],
    ) -> Result<(), Error> {
        derivative(self.model, control, time, x, rate, torques)
    }

    /// After a step: puts the vector back onto what holds the bodies, where rounding and the step took it off.
    ///
    /// # Errors
    /// What the model says.
    pub fn restore(&self, _x: &mut [f64]) -> Result<(), Error> {
        Ok(())
    }
}
