//! What single precision changes in an approach of 20 s: PD control and Runge–Kutta steps at 1 kHz, as in
//! `examples/firmware`, from rest.

use planar_dynamics::control::{Control, ProportionalDerivative, SampledControl};
use planar_dynamics::dynamics::Model;
use planar_dynamics::error::Error;
use planar_dynamics::formulation::derivative;
use planar_dynamics::integrate::RungeKutta4;
use planar_dynamics::scalar::Real;
use planar_dynamics::state::{State, vector_length};
use planar_dynamics::trajectory::{PointToPoint, Quartic};

/// Steps of 1 ms.
const STEPS: u16 = 20_000;
/// Steps from one comparison to the next.
const INTERVAL: u16 = 20;
/// s.
const STEP: f64 = 0.001;
/// Those of the paper's robot; another with more joints repeats them. rad, rad/s.
const INITIAL_ANGLES: [f64; 6] = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047];
const FINAL_ANGLES: [f64; 6] = [-0.524, -1.393, -0.035, 2.618, -1.393, -0.035];
const FINAL_RATES: [f64; 6] = [-0.05, 0.02, 0.03, -0.05, 0.02, 0.03];
/// Of every joint, N m/rad, N m s/rad.
const GAINS: [f64; 2] = [49.0, 14.0];

/// The largest differences of an approach in `f32` from the same in `f64`, and the largest angle in it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Differences {
    /// rad.
    pub joint_angles: f64,
    /// rad.
    pub base_yaw: f64,
    /// m.
    pub base_position: f64,
    /// Of the momentum, which is 0 at the start, over the bodies' momenta; the larger of linear and angular.
    pub momentum_drift: f64,
    /// The largest angle, rad, or coordinate of the base, m.
    pub position: f64,
}

/// Compares the approaches of two models of one robot.
///
/// # Errors
/// Those of the models.
pub fn compare(single: &dyn Model<f32>, double: &dyn Model<f64>) -> Result<Differences, Error> {
    let joints = double.joints();
    let (found, right) = (approach(single)?, approach(double)?);
    let mut all = Differences::default();
    let (mut drift, mut size) = ([0.0_f64; 2], [0.0_f64; 2]);
    for (found, right) in found.iter().zip(&right) {
        let (found, right) = (State::from_vector(found, joints)?, State::from_vector(right, joints)?);
        let off = |a: f64, b: f64, most: f64| Real::maximum((a - b).abs(), most);
        for (found, right) in found.joint_angles.iter().zip(right.joint_angles) {
            all.joint_angles = off(*found, *right, all.joint_angles);
        }
        all.base_yaw = off(found.base_pose[0], right.base_pose[0], all.base_yaw);
        for axis in 1..3 {
            all.base_position = off(found.base_pose[axis], right.base_pose[axis], all.base_position);
        }
        let positions = right.base_pose.iter().chain(right.joint_angles);
        all.position = positions.fold(all.position, |most, x| off(*x, 0.0, most));
        let (momentum, sizes) = momentum(double, &found)?;
        for i in 0..2 {
            drift[i] = Real::maximum(drift[i], momentum[i]);
            size[i] = Real::maximum(size[i], sizes[i]);
        }
    }
    all.momentum_drift = Real::maximum(drift[0] / size[0], drift[1] / size[1]);
    Ok(all)
}

/// Magnitudes of linear and angular momentum, and of those of all bodies together.
fn momentum(model: &dyn Model<f64>, state: &State<'_, f64>) -> Result<([f64; 2], [f64; 2]), Error> {
    let total = model.momentum(state)?;
    let bodies = model.joints() + 1;
    let (mut inertias, mut poses, mut twists) =
        (vec![[0.0; 2]; bodies], vec![[0.0; 3]; bodies], vec![[0.0; 3]; bodies]);
    model.body_inertias(&mut inertias)?;
    model.body_poses(&state.base_pose, state.joint_angles, &mut poses)?;
    model.body_twists(state, &mut twists)?;
    let mut sizes = [0.0; 2];
    for (([mass, inertia], [_, x, y]), [omega, vx, vy]) in inertias.iter().zip(&poses).zip(&twists) {
        sizes[0] += mass * vx.hypot(*vy);
        sizes[1] += (inertia * omega).abs() + mass * (x * vy - y * vx).abs();
    }
    let [px, py] = total.linear_momentum;
    Ok(([px.hypot(py), total.angular_momentum.abs()], sizes))
}

/// The states of an approach at every [`INTERVAL`]th step.
fn approach<T: Real>(model: &dyn Model<T>) -> Result<Vec<Vec<f64>>, Error> {
    let joints = model.joints();
    let repeated =
        |numbers: &[f64]| -> Vec<T> { (0..joints).map(|j| T::constant(numbers[j % numbers.len()])).collect() };
    let [initial_angles, final_angles, final_rates] =
        [INITIAL_ANGLES, FINAL_ANGLES, FINAL_RATES].map(|all| repeated(&all));
    let step = T::constant(STEP);
    let motion = PointToPoint {
        initial_angles: &initial_angles,
        final_angles: &final_angles,
        duration: T::constant(f64::from(STEPS) * STEP),
    };
    let law = ProportionalDerivative {
        trajectory: Quartic { motion, final_rates: &final_rates },
        proportional_gain: &repeated(&GAINS[..1]),
        derivative_gain: &repeated(&GAINS[1..]),
    };
    let (mut held, mut torques) = (vec![T::ZERO; joints], vec![T::ZERO; joints]);
    let mut law = SampledControl::new(law, 1, &mut held);
    let mut x = vec![T::ZERO; vector_length(joints)];
    State { base_pose: [T::ZERO; 3], joint_angles: &initial_angles, base_twist: [T::ZERO; 3], joint_rates: &torques }
        .write(&mut x)?;
    let mut workspace = vec![T::ZERO; RungeKutta4::<T>::WORKSPACE * x.len()];
    let mut integrator = RungeKutta4::new(&mut workspace)?;
    let mut states = Vec::new();
    for k in 0..STEPS {
        let time = T::constant(f64::from(k)) * step;
        law.begin_step(time, model, &State::from_vector(&x, joints)?)?;
        integrator.step(time, step, &mut x, |t, x, rate| derivative(model, &mut law, t, x, rate, &mut torques))?;
        if (k + 1) % INTERVAL == 0 {
            states.push(x.iter().map(|x| x.to_f64()).collect());
        }
    }
    Ok(states)
}
