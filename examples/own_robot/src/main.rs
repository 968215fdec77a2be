//! Your own robot captures a piece of debris: approach, rigid impact, free motion of the merged system.
//!
//! Only the printing needs an operating system; model and integrator do not allocate.

use planar_capture::control::{Control, ProportionalDerivative, ZeroTorque};
use planar_capture::dynamics::{Kinematics, Merge, MomentumAndEnergy};
use planar_capture::error::Error;
use planar_capture::impact::{self, RigidImpactOutput};
use planar_capture::integrate::RungeKutta4;
use planar_capture::state::{State, vector_length};
use planar_capture::target::Target;
use planar_capture::trajectory::{Cycloidal, PointToPoint};
use std::process::ExitCode;

planar_capture::include_layout!("inspector");
use inspector::{ARMS, JOINTS, MANIFEST, Model};

/// Length of the state vector: pose, angles, twist, rates, work of the torques.
const LENGTH: usize = vector_length(JOINTS);
/// Time step, s.
const STEP: f64 = 0.005;
/// Bound on the drift of the angular momentum, which is rounding alone, N m s.
const DRIFT: f64 = 1e-9;

/// Joint angles at the start and at the contact, in the order of `MANIFEST.coordinates`, rad.
const FOLDED: [f64; JOINTS] = [1.2, -2.2, 1.5, 0.4, 0.0, 0.0];
const REACHED: [f64; JOINTS] = [0.5, -0.8, 0.6, 0.1, 0.3, -0.4];

/// Turns once in 20 s; its contact point is at its edge.
const DEBRIS: Target<f64> = Target { mass: 4.0, inertia: 0.2, contact: [-0.3, 0.05], twist: [0.314, -0.02, 0.01] };

fn main() -> ExitCode {
    match capture() {
        Ok(drift) if drift < DRIFT => ExitCode::SUCCESS,
        Ok(drift) => {
            eprintln!("momentum drifts by {drift:e} N m s");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Approach, impact and free motion. Returns the difference between the angular momentum at the end and that of the debris
/// before the impact, N m s.
fn capture() -> Result<f64, Error> {
    let mut robot = Model::<f64>::default();
    let mut x = [0.0; LENGTH];
    State { base_pose: [0.0; 3], joint_angles: &FOLDED, base_twist: [0.0; 3], joint_rates: &[0.0; JOINTS] }
        .write(&mut x)?;

    let motion = PointToPoint { initial_angles: &FOLDED, final_angles: &REACHED, duration: 20.0 };
    let mut law = ProportionalDerivative {
        trajectory: Cycloidal { motion },
        proportional_gain: &[30.0, 20.0, 8.0, 1.0, 8.0, 1.0],
        derivative_gain: &[20.0, 12.0, 4.0, 0.4, 5.0, 0.5],
    };
    run(&robot, &mut law, 20.0, &mut x)?;
    report("at the contact", &x);

    let targets: [Option<Target<f64>>; ARMS] = [Some(DEBRIS), None];
    let (mut joint_rates, mut twists, mut impulses) = ([0.0; JOINTS], [[0.0; 3]; ARMS], [[0.0; 3]; ARMS]);
    let mut after =
        RigidImpactOutput { joint_rates: &mut joint_rates, target_twists: &mut twists, impulses: &mut impulses };
    let before = x;
    let state = state(&before)?;
    let mut end_effectors = [[0.0; 3]; ARMS];
    Kinematics::end_effector_poses(&robot, &state.base_pose, state.joint_angles, &mut end_effectors)?;
    let before_impact = debris_momentum(end_effectors[0]);
    let base_twist = impact::exact(&robot, &state, &targets, &mut after)?;
    let [n, fx, fy] = impulses[0];
    println!("impulse on the gripper: {n:.4} N m s, [{fx:.4}, {fy:.4}] N s");
    robot.merge(&state.base_pose, state.joint_angles, &targets)?;
    State { base_twist, joint_rates: &joint_rates, ..state }.write(&mut x)?;
    report("after the impact", &x);

    run(&robot, &mut ZeroTorque, 10.0, &mut x)?;
    report("10 s later", &x);
    let drift = (MomentumAndEnergy::momentum(&robot, &self::state(&x)?)?.angular_momentum - before_impact).abs();
    println!("angular momentum: {before_impact:.6} N m s of the debris before the impact, drift {drift:.1e} N m s");
    Ok(drift)
}

/// Angular momentum of the debris about the inertial origin with its contact point at the end effector, N m s.
fn debris_momentum([_, end_effector_x, end_effector_y]: [f64; 3]) -> f64 {
    let Target { mass, inertia, contact, twist } = DEBRIS;
    let [x, y] = [end_effector_x - contact[0], end_effector_y - contact[1]];
    inertia * twist[0] + mass * (x * twist[2] - y * twist[1])
}

fn run(
    robot: &Model<f64>,
    law: &mut impl Control<f64, Model<f64>>,
    duration: f64,
    x: &mut [f64; LENGTH],
) -> Result<(), Error> {
    let (mut workspace, mut torques) = ([0.0; 3 * LENGTH], [0.0; JOINTS]);
    let mut integrator = RungeKutta4::new(&mut workspace)?;
    let mut time = 0.0;
    while time < duration {
        integrator.robot_step(robot, law, time, STEP, x, &mut torques)?;
        time += STEP;
    }
    Ok(())
}

fn state(x: &[f64; LENGTH]) -> Result<State<'_, f64>, Error> {
    State::from_vector(x, JOINTS)
}

/// Prints the coordinates with their names and units from the manifest.
fn report(when: &str, x: &[f64; LENGTH]) {
    println!("{when}:");
    for (coordinate, value) in MANIFEST.coordinates.iter().zip(x) {
        println!("    {:<16} {value:>9.4} {}", coordinate.name, coordinate.unit);
    }
}

#[cfg(test)]
mod tests {
    use super::{DRIFT, capture};

    #[test]
    fn angular_momentum_is_conserved() {
        let drift = capture().expect("the robot is far from singular");
        assert!(drift < DRIFT, "{drift:e} N m s");
    }
}
