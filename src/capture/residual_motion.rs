//! The residual motion of robot and captured targets at the end of the post-impact phase.
//!
//! # Example
//! ```
//! use planar_capture::capture::residual_motion::ResidualMotion;
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::owned::RobotState;
//!
//! // joints that do not move: the whole turns as one rigid body, at the rate of its base
//! let (joint_angles, joint_rates) = (vec![0.4, -0.9, 0.3], vec![0.0; 3]);
//! let state = RobotState { base_pose: [0.2, 3.0, -1.0], joint_angles, base_twist: [0.1, 0.0, 0.0], joint_rates };
//! let found = ResidualMotion::of(&Model::<f64>::default(), &[], "none", &state, &[false; 3])?;
//! assert!((found.rigid_rate - 0.1).abs() < 1e-12);
//! assert!((found.momentum[0] - found.inertia * 0.1).abs() < 1e-9);
//! # Ok::<(), planar_capture::error::Error>(())
//! ```

use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::owned::RobotState;
use crate::scalar::Real;
use crate::simulate::bodies::{BodySums, bodies, inertia_about, with_bodies};
use crate::simulate::system::Body;

/// Momentum and rates of robot and captured targets together.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ResidualMotion {
    /// Name of the control law, as in a scenario.
    pub control: &'static str,
    /// [l, px, py], l about the COM of the whole; N m s, N s.
    pub momentum: [f64; 3],
    /// [vx, vy] of the COM of the whole, m/s, which no joint torque changes.
    pub velocity: [f64; 2],
    /// Of the whole about its COM, kg m².
    pub inertia: f64,
    /// l/I: the rate of the whole as one rigid body, rad/s.
    pub rigid_rate: f64,
    /// ω of the base, rad/s.
    pub base_rate: f64,
    /// The largest absolute rate of the joints without wheels, rad/s.
    pub largest_joint_rate: f64,
    /// The rates of the wheels, rad/s; empty without wheels.
    pub wheel_rates: Vec<f64>,
}

impl ResidualMotion {
    /// Of the robot with merged targets and the bodies `held` beside it, under the law of this name; `wheels` says which
    /// joints turn wheels.
    ///
    /// # Errors
    /// Those of the model.
    pub fn of(
        model: &AnyModel<f64>,
        held: &[Body],
        control: &'static str,
        state: &RobotState,
        wheels: &[bool],
    ) -> Result<Self, Error> {
        let bodies = bodies(model, &state.view(), held)?;
        let total = with_bodies(model.momentum(&state.view())?, held.iter().copied());
        let sums = BodySums::new(bodies.iter().copied());
        let (center, mass) = (sums.center_of_mass(), sums.mass);
        let inertia = inertia_about(&bodies, center);
        let [px, py] = total.linear_momentum;
        let angular = total.angular_momentum - (center[0] * py - center[1] * px);
        let joints = || state.joint_rates.iter().zip(wheels);
        let [base_rate, ..] = state.base_twist;
        Ok(Self {
            control,
            momentum: [angular, px, py],
            velocity: [px / mass, py / mass],
            inertia,
            rigid_rate: angular / inertia,
            base_rate,
            largest_joint_rate: joints()
                .filter(|(_, wheel)| !**wheel)
                .fold(0.0, |most: f64, (rate, _)| Real::maximum(most, rate.abs())),
            wheel_rates: joints().filter(|(_, wheel)| **wheel).map(|(rate, _)| *rate).collect(),
        })
    }
}

#[cfg(test)]
mod tests;
