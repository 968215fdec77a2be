//! Conserved quantities, body by body.

use super::kinematics::twist;
use super::{Configuration, Generic, velocity};
use planar_dynamics::check::finite;
use planar_dynamics::dynamics::{Conserved, Momentum};
use planar_dynamics::error::Error;
use planar_dynamics::state::State;

impl Conserved<f64> for Generic {
    /// p = Σ m v, l = Σ I ω + r × m v about the inertial origin, T = ½ Σ I ω² + m v².
    fn momentum(&self, state: &State<'_, f64>) -> Result<Momentum<f64>, Error> {
        self.check_state(state)?;
        let at = Configuration::new(self, &state.base_pose, state.joint_angles)?;
        let velocity = velocity(&state.base_twist, state.joint_rates);
        let mut total = Momentum { linear_momentum: [0.0; 2], angular_momentum: 0.0, kinetic_energy: 0.0 };
        for (i, body) in self.bodies.iter().enumerate() {
            let (_, com) = at.body(i);
            let (x, y) = (state.base_pose[1] + com.x, state.base_pose[2] + com.y);
            let [omega, vx, vy] = twist(&at.body_jacobian(i), &velocity);
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
