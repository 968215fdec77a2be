//! Power and momentum balance, conservation laws and order of integration of the motion.

use planar_capture::control::ZeroTorque;
use planar_capture::dynamics::Model;
use planar_capture::formulation::derivative;
use planar_capture::integrate::RungeKutta4;
use planar_capture::state::{State, vector_length};
use planar_proof::sample::RandomState;

/// Free motion for `steps` of `step` seconds; the state is `[pose, angles, twist, rates, work]`.
fn integrate_to_contact(model: &dyn Model<f64>, x: &mut [f64], step: f64, steps: u32) {
    let mut workspace = vec![0.0; 3 * x.len()];
    let mut torques = vec![0.0; model.joints()];
    let mut integrator = RungeKutta4::new(&mut workspace).expect("a workspace");
    for _ in 0..steps {
        integrator
            .step(0.0, step, x, |t, x, rate| derivative(model, &mut ZeroTorque, t, x, rate, &mut torques))
            .expect("a step");
    }
}

/// The sample's state as an integrated vector.
fn vector(sample: &RandomState) -> Vec<f64> {
    let mut x = vec![0.0; vector_length(sample.joint_angles.len())];
    State {
        base_pose: sample.base_pose,
        joint_angles: &sample.joint_angles,
        base_twist: sample.base_twist,
        joint_rates: &sample.joint_rates,
    }
    .write(&mut x)
    .expect("room");
    x
}

macro_rules! motion {
    ($($layout:ident)*) => {$(
        mod $layout {
            use super::{integrate_to_contact, vector};
            use planar_capture::scalar::Dual;
            use planar_proof::sample::{config, sample};
            use planar_proof::tolerance;
            use crate::identities::{close, inputs, moving, velocity};
            use planar_capture::dynamics::{MomentumAndEnergy, Kinematics};
            use planar_capture::generated::$layout::{ARMS, BODIES, JOINTS, Model, SIZE};
            use planar_capture::state::{State, vector_length};
            use proptest::prelude::*;

            proptest! {
                #![proptest_config(config())]

                /// dT/dt is the power of all forces, dp/dt their sum, dl/dt their moment about the origin.
                #[test]
                fn power_and_momentum_balance(s in sample(ARMS, JOINTS)) {
                    let (pose, angles, twist, rates) = inputs::<JOINTS>(&s);
                    let model = Model::<f64>::default();
                    let torques: [f64; JOINTS] = s.joint_torques.as_slice().try_into().expect("as many");
                    let wrenches: [[f64; 3]; ARMS] = s.end_effector_wrenches.as_slice().try_into().expect("as many");
                    let none = ([0.0; 3], [[0.0; 3]; ARMS]);
                    let free = model.forward_dynamics(&pose, &angles, &twist, &rates, &torques);
                    let based = model.forward_dynamics_with_base_wrench(&pose, &angles, &twist, &rates, &torques, &s.base_wrench);
                    let full = model.forward_dynamics_with_wrenches(
                        &pose, &angles, &twist, &rates, &torques, &s.base_wrench, &wrenches,
                    );
                    let end_effectors = model.end_effector_poses(&pose, &angles);
                    let end_effector_twists = model.end_effector_twists(&pose, &angles, &twist, &rates);
                    for (base, joints, (base_wrench, wrenches)) in [
                        (free.base_acceleration, free.joint_accelerations, none),
                        (based.base_acceleration, based.joint_accelerations, (s.base_wrench, none.1)),
                        (full.base_acceleration, full.joint_accelerations, (s.base_wrench, wrenches)),
                    ] {
                        let (dual_pose, dual_angles) = moving(&s, &velocity::<SIZE>(&s));
                        let dual_twist = std::array::from_fn(|i| Dual(twist[i], base[i]));
                        let dual_rates = std::array::from_fn(|i| Dual(rates[i], joints[i]));
                        let rate = Model::<Dual>::default().momentum(&dual_pose, &dual_angles, &dual_twist, &dual_rates);
                        let mut power: f64 = torques.iter().zip(rates).map(|(t, r)| t * r).sum();
                        let mut force = [0.0; 3];
                        let at_base = std::iter::once((base_wrench, pose, twist));
                        let at_end_effectors = (0..ARMS).map(|i| (wrenches[i], end_effectors[i], end_effector_twists[i]));
                        for ([n, fx, fy], [_, x, y], [omega, vx, vy]) in at_base.chain(at_end_effectors) {
                            power += n * omega + fx * vx + fy * vy;
                            force[0] += n + x * fy - y * fx;
                            force[1] += fx;
                            force[2] += fy;
                        }
                        let scale = 1e4; // inertial forces of these states, N and N m about the origin
                        close("dT/dt", rate.kinetic_energy.1, power, scale, tolerance::SOLVED_IDENTITY);
                        close("dl/dt", rate.angular_momentum.1, force[0], scale, tolerance::SOLVED_IDENTITY);
                        close("dpx/dt", rate.linear_momentum[0].1, force[1], scale, tolerance::SOLVED_IDENTITY);
                        close("dpy/dt", rate.linear_momentum[1].1, force[2], scale, tolerance::SOLVED_IDENTITY);
                    }
                }

                /// Without forces momentum is constant, the COM moves on a line, and reversed velocities return to the
                /// start.
                #[test]
                fn free_motion_conserves_and_reverses(s in sample(ARMS, JOINTS)) {
                    let model = Model::<f64>::default();
                    let start = vector(&s);
                    let mut x = start.clone();
                    integrate_to_contact(&model, &mut x, 2.5e-4, 1000);
                    let conserved = |x: &[f64]| {
                        let state = State::from_vector(x, JOINTS).expect("a state");
                        let momentum = MomentumAndEnergy::momentum(&model, &state).expect("momentum");
                        let (mut inertias, mut poses) = ([[0.0; 2]; BODIES], [[0.0; 3]; BODIES]);
                        planar_capture::dynamics::Robot::body_inertias(&model, &mut inertias).expect("inertias");
                        Kinematics::body_poses(&model, &state.base_pose, state.joint_angles, &mut poses).expect("poses");
                        let mass: f64 = inertias.iter().map(|[m, _]| m).sum();
                        let com = [1, 2].map(|axis: usize| {
                            inertias.iter().zip(&poses).map(|([m, _], p)| m * p[axis]).sum::<f64>() / mass
                        });
                        (momentum, com, mass)
                    };
                    let ((before, com, mass), (after, moved, _)) = (conserved(&start), conserved(&x));
                    let scale = 5e3;
                    close("l", after.angular_momentum, before.angular_momentum, scale, tolerance::INTEGRATED);
                    for axis in 0..2 {
                        close("p", after.linear_momentum[axis], before.linear_momentum[axis], scale, tolerance::INTEGRATED);
                        let line = com[axis] + 0.25 * before.linear_momentum[axis] / mass;
                        close("COM", moved[axis], line, 1.0, tolerance::INTEGRATED);
                    }
                    close("T", after.kinetic_energy, before.kinetic_energy, before.kinetic_energy, tolerance::INTEGRATED);
                    let velocities = 3 + JOINTS..2 * (3 + JOINTS);
                    x[velocities.clone()].iter_mut().for_each(|v| *v = -*v);
                    integrate_to_contact(&model, &mut x, 2.5e-4, 1000);
                    x[velocities].iter_mut().for_each(|v| *v = -*v);
                    for (now, then) in x.iter().zip(&start) {
                        close("reversed", *now, *then, 10.0, tolerance::INTEGRATED);
                    }
                }
            }

            /// A closed path of the joint angles rotates the base; the reversed path rotates it back.
            #[test]
            fn a_closed_loop_of_the_joints_turns_the_base() {
                if JOINTS < 2 {
                    return;
                }
                let model = Model::<f64>::default();
                let turn = |direction: f64| {
                    // yaw' = −(I_b⁻¹ I_bm θ̇), by Runge–Kutta in the loop's parameter
                    let rate = |phase: f64, yaw: f64| {
                        let mut angles = [0.4; JOINTS];
                        let mut rates = [0.0; JOINTS];
                        angles[0] += phase.cos();
                        angles[1] += phase.sin();
                        rates[0] = -phase.sin() * direction;
                        rates[1] = phase.cos() * direction;
                        let m = model.mass_matrix(&[yaw, 0.0, 0.0], &angles);
                        let base = nalgebra::Matrix3::from_fn(|i, j| m[i][j]);
                        let coupling = nalgebra::Vector3::from_fn(|i, _| {
                            rates.iter().enumerate().map(|(k, r)| m[i][3 + k] * r).sum::<f64>()
                        });
                        -base.lu().solve(&coupling).expect("positive definite")[0]
                    };
                    let steps = 400;
                    let h = std::f64::consts::TAU / f64::from(steps);
                    let mut yaw = 0.0;
                    for i in 0..steps {
                        let t = direction * h * f64::from(i);
                        let d = direction * h;
                        let k1 = rate(t, yaw);
                        let k2 = rate(t + d / 2.0, yaw + h / 2.0 * k1);
                        let k3 = rate(t + d / 2.0, yaw + h / 2.0 * k2);
                        let k4 = rate(t + d, yaw + h * k3);
                        yaw += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
                    }
                    yaw
                };
                let (left, right) = (turn(1.0), turn(-1.0));
                assert!(left.abs() > 1e-5, "the base turned by {left} rad only");
                close("there and back", left + right, 0.0, left.abs(), 1e-6);
            }

            /// Halving the step divides the error of free motion by sixteen.
            #[test]
            fn runge_kutta_has_order_four_on_the_robot() {
                let model = Model::<f64>::default();
                let mut start = vec![0.0; vector_length(JOINTS)];
                for (i, x) in start.iter_mut().enumerate() {
                    *x = (1.0 + f64::from(u8::try_from(i).expect("small")) * 0.7).sin();
                }
                let end = |steps: u32| {
                    let mut x = start.clone();
                    integrate_to_contact(&model, &mut x, 0.5 / f64::from(steps), steps);
                    x
                };
                let difference = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                let (coarse, fine, finest) = (end(64), end(128), end(256));
                let order = (difference(&coarse, &fine) / difference(&fine, &finest)).log2();
                assert!((order - 4.0).abs() < 0.3, "observed order {order}");
            }
        }
    )*};
}

planar_proof::for_every_layout!(motion);
