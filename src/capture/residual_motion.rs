//! What is left of the motion when a robot has settled after a capture.

use crate::dynamics::Model;
use crate::error::Error;
use crate::owned::RobotState;
use crate::scenario::PostCaptureControl;
use crate::simulate::bodies::{bodies, center_of_mass, inertia_about, with_bodies};
use crate::simulate::system::Body;

/// The motion that remains, robot and targets as one.
#[derive(Clone, Debug, PartialEq)]
pub struct ResidualMotion {
    /// The law, as in a scenario.
    pub control: &'static str,
    /// [l, px, py], l about the COM of the whole; N m s, N s.
    pub momentum: [f64; 3],
    /// [vx, vy] of the COM of the whole, m/s: no joint and no wheel changes it.
    pub velocity: [f64; 2],
    /// Of the whole about its COM, kg m².
    pub inertia: f64,
    /// l/I: the rate of the whole turning as one rigid body, rad/s.
    pub rigid_rate: f64,
    /// ω of the base, rad/s.
    pub base_rate: f64,
    /// The largest size of the rates of the joints that turn no wheel, rad/s.
    pub largest_joint_rate: f64,
    /// The rates of the wheels, rad/s; empty without wheels.
    pub wheel_rates: Vec<f64>,
}

impl ResidualMotion {
    /// Of the robot with what it holds, its links' and the bodies `held` beside them; `wheels` says which joints turn
    /// wheels.
    ///
    /// # Errors
    /// What the model says of the state.
    pub fn of(
        model: &dyn Model<f64>,
        held: &[Body],
        control: &PostCaptureControl,
        motion: &RobotState,
        wheels: &[bool],
    ) -> Result<Self, Error> {
        let bodies = bodies(model, &motion.view(), held)?;
        let total = with_bodies(model.momentum(&motion.view())?, held);
        let (center, mass) = center_of_mass(&bodies);
        let inertia = inertia_about(&bodies, center);
        let [px, py] = total.linear_momentum;
        let angular = total.angular_momentum - (center[0] * py - center[1] * px);
        let joints = || motion.joint_rates.iter().zip(wheels);
        let [base_rate, ..] = motion.base_twist;
        Ok(Self {
            control: control.name(),
            momentum: [angular, px, py],
            velocity: [px / mass, py / mass],
            inertia,
            rigid_rate: angular / inertia,
            base_rate,
            largest_joint_rate: joints()
                .filter(|(_, wheel)| !**wheel)
                .fold(0.0, |most, (rate, _)| rate.abs().max(most)),
            wheel_rates: joints().filter(|(_, wheel)| **wheel).map(|(rate, _)| *rate).collect(),
        })
    }
}
