//! Momentum and energy of the robot and its targets, summed body by body.

use super::{Generic, GenericState};
use planar_dynamics::dynamics::{Momentum, MomentumAndEnergy};
use planar_dynamics::error::Error;
use planar_dynamics::state::State;
use planar_dynamics::validate::finite;

impl MomentumAndEnergy<f64> for Generic {
    /// p = Σ m v, l = Σ I ω + r × m v about the inertial origin, T = ½ Σ I ω² + m v².
    fn momentum(&self, state: &State<'_, f64>) -> Result<Momentum<f64>, Error> {
        let now = GenericState::new(self, state)?;
        let mut total = Momentum { linear_momentum: [0.0; 2], angular_momentum: 0.0, kinetic_energy: 0.0 };
        for ((body, [_, x, y]), [omega, vx, vy]) in self.bodies.iter().zip(now.at.body_poses()).zip(now.body_twists()) {
            total.linear_momentum[0] += body.mass * vx;
            total.linear_momentum[1] += body.mass * vy;
            total.angular_momentum += body.inertia * omega + body.mass * (x * vy - y * vx);
            total.kinetic_energy += 0.5 * (body.inertia * omega * omega + body.mass * (vx * vx + vy * vy));
        }
        finite("linear_momentum", &total.linear_momentum)?;
        finite("angular_momentum", &[total.angular_momentum])?;
        finite("kinetic_energy", &[total.kinetic_energy])?;
        Ok(total)
    }
}
