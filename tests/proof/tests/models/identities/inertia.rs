//! Mass matrix, bias, Jacobians and their reduced forms are consistent.

macro_rules! inertia {
    ($($layout:ident)*) => {$(
        mod $layout {
            use planar_capture::scalar::Dual;
            use planar_proof::sample::{config, sample};
            use planar_proof::tolerance;
            use crate::identities::{close, inputs, moving, velocity};
            use nalgebra::{DMatrix, DVector};
            use planar_capture::generated::$layout::{ARMS, BODIES, JOINTS, Model, Parameters, SIZE};
            use proptest::prelude::*;

            proptest! {
                #![proptest_config(config())]

                /// M is symmetric and positive definite, ½ vᵀ M v = T, and M v is the vector of momenta.
                #[test]
                fn mass_matrix_is_that_of_the_kinetic_energy(s in sample(ARMS, JOINTS)) {
                    let (pose, angles, twist, rates) = inputs::<JOINTS>(&s);
                    let model = Model::<f64>::default();
                    let m = DMatrix::from_fn(SIZE, SIZE, |i, j| model.mass_matrix(&pose, &angles)[i][j]);
                    prop_assert!(m == m.transpose(), "symmetric to the last bit");
                    prop_assert!(m.clone().cholesky().is_some(), "positive definite");
                    let v = DVector::from_column_slice(&velocity::<SIZE>(&s));
                    let conserved = model.momentum(&pose, &angles, &twist, &rates);
                    let energy = conserved.kinetic_energy;
                    close("½vᵀMv = T", 0.5 * v.dot(&(&m * &v)), energy, energy, tolerance::IDENTITY);
                    let momentum = &m * &v;
                    let scale = m.abs().row_sum().max() * 2.0;
                    close("px", momentum[1], conserved.linear_momentum[0], scale, tolerance::IDENTITY);
                    close("py", momentum[2], conserved.linear_momentum[1], scale, tolerance::IDENTITY);
                    let [_, x, y] = pose;
                    let about_origin = momentum[0] + x * momentum[2] - y * momentum[1];
                    close("l", about_origin, conserved.angular_momentum, 10.0 * scale, tolerance::IDENTITY);
                }

                /// bias = Christoffel(M) v, and vᵀ(Ṁ v − 2 bias) = 0, with the derivatives of M by dual numbers.
                #[test]
                fn bias_is_christoffel_of_the_mass_matrix(s in sample(ARMS, JOINTS)) {
                    let (pose, angles, twist, rates) = inputs::<JOINTS>(&s);
                    let v = velocity::<SIZE>(&s);
                    let dual = Model::<Dual>::default();
                    // ∂M/∂q_k
                    let slope: Vec<_> = (0..SIZE)
                        .map(|k| {
                            let mut direction = [0.0; SIZE];
                            direction[k] = 1.0;
                            let (pose, angles) = moving(&s, &direction);
                            dual.mass_matrix(&pose, &angles).map(|row| row.map(|d| d.1))
                        })
                        .collect();
                    let bias = Model::<f64>::default().bias(&pose, &angles, &twist, &rates);
                    let mut power = 0.0;
                    let mut scale = 1e-3;
                    for i in 0..SIZE {
                        let mut expected = 0.0;
                        let mut size = 0.0_f64;
                        for j in 0..SIZE {
                            for k in 0..SIZE {
                                let term = (slope[k][i][j] - 0.5 * slope[i][j][k]) * v[j] * v[k];
                                expected += term;
                                size += term.abs();
                                power += slope[k][i][j] * v[i] * v[j] * v[k];
                                scale += (slope[k][i][j] * v[i] * v[j] * v[k]).abs();
                            }
                        }
                        close("bias", bias[i], expected, size + 1e-3, tolerance::IDENTITY);
                        power -= 2.0 * bias[i] * v[i];
                    }
                    close("vᵀ(Ṁ v − 2 bias)", power, 0.0, scale, tolerance::IDENTITY);
                }

                /// d(pose)/dt = twist for end effectors and bodies, and the Jacobian gives the same twists.
                #[test]
                fn twists_are_the_rates_of_poses(s in sample(ARMS, JOINTS)) {
                    let (pose, angles, twist, rates) = inputs::<JOINTS>(&s);
                    let v = velocity::<SIZE>(&s);
                    let model = Model::<f64>::default();
                    let (dual_pose, dual_angles) = moving(&s, &v);
                    let dual = Model::<Dual>::default();
                    let twists = model.end_effector_twists(&pose, &angles, &twist, &rates);
                    let jacobian = model.end_effector_jacobian(&pose, &angles);
                    let scale = 50.0;
                    for (i, row) in jacobian.iter().enumerate() {
                        let by_jacobian: f64 = row.iter().zip(v).map(|(j, v)| j * v).sum();
                        close("J_e v", by_jacobian, twists[i / 3][i % 3], scale, tolerance::IDENTITY);
                    }
                    for (pose, twist) in dual.end_effector_poses(&dual_pose, &dual_angles).iter().zip(twists) {
                        (0..3).for_each(|i| close("end effector", pose[i].1, twist[i], scale, tolerance::IDENTITY));
                    }
                    let bodies = model.body_twists(&pose, &angles, &twist, &rates);
                    for (pose, twist) in dual.body_poses(&dual_pose, &dual_angles).iter().zip(bodies) {
                        (0..3).for_each(|i| close("body", pose[i].1, twist[i], scale, tolerance::IDENTITY));
                    }
                    let mut inertias = [[0.0; 2]; BODIES];
                    planar_capture::dynamics::Robot::body_inertias(&model, &mut inertias).expect("inertias");
                    let energy: f64 = inertias.iter().zip(bodies).map(|([m, i], [w, x, y])| 0.5 * (i * w * w + m * (x * x + y * y))).sum();
                    let expected = model.momentum(&pose, &angles, &twist, &rates).kinetic_energy;
                    close("T of the bodies", energy, expected, expected, tolerance::IDENTITY);
                }

                /// I, c and J follow from the full equations by elimination of the base.
                #[test]
                fn reduced_dynamics_is_the_eliminated_base(s in sample(ARMS, JOINTS)) {
                    let (pose, angles, twist, rates) = inputs::<JOINTS>(&s);
                    let model = Model::<f64>::default();
                    let m = DMatrix::from_fn(SIZE, SIZE, |i, j| model.mass_matrix(&pose, &angles)[i][j]);
                    let h = DVector::from_column_slice(&model.bias(&pose, &angles, &twist, &rates));
                    let je = model.end_effector_jacobian(&pose, &angles);
                    let je = DMatrix::from_fn(3 * ARMS, SIZE, |i, j| je[i][j]);
                    let base = m.view((0, 0), (3, 3)).into_owned().cholesky().expect("positive definite");
                    let coupling = m.view((0, 3), (3, JOINTS)).into_owned();
                    let solved = base.solve(&coupling);
                    let inertia = m.view((3, 3), (JOINTS, JOINTS)) - coupling.transpose() * &solved;
                    let bias = h.rows(3, JOINTS) - solved.transpose() * h.rows(0, 3);
                    let jacobian = je.view((0, 3), (3 * ARMS, JOINTS)) - je.view((0, 0), (3 * ARMS, 3)) * &solved;
                    let found = model.reduced_dynamics(&pose, &angles, &twist, &rates);
                    let scale = (m.amax(), h.amax() + 1e-3, je.amax());
                    for i in 0..JOINTS {
                        close("c", found.generalized_bias[i], bias[i], scale.1, tolerance::SOLVED_IDENTITY);
                        for j in 0..JOINTS {
                            close("I", found.generalized_inertia[i][j], inertia[(i, j)], scale.0, tolerance::IDENTITY);
                        }
                        for row in 0..3 * ARMS {
                            close("J", found.generalized_jacobian[row][i], jacobian[(row, i)], scale.2, tolerance::SOLVED_IDENTITY);
                        }
                    }
                    let alone = model.generalized_jacobian(&pose, &angles).generalized_jacobian;
                    prop_assert!(alone == found.generalized_jacobian, "the Jacobian alone is the same code");
                    prop_assert!(found.smallest_pivot > 0.0 && found.smallest_pivot <= 1.0);
                }

                /// With increasing base mass, J → J_me: the difference decreases as 1/mass.
                #[test]
                fn generalized_jacobian_tends_to_that_of_a_fixed_base(s in sample(ARMS, JOINTS)) {
                    let (pose, angles, ..) = inputs::<JOINTS>(&s);
                    let distance = |factor: f64| {
                        let mut parameters = Parameters::<f64>::default();
                        parameters.base_mass *= factor;
                        parameters.base_inertia *= factor;
                        let model = Model::new(parameters);
                        let j = model.generalized_jacobian(&pose, &angles).generalized_jacobian;
                        let je = model.end_effector_jacobian(&pose, &angles);
                        let entries = (0..3 * ARMS).flat_map(|i| (0..JOINTS).map(move |k| (i, k)));
                        entries.map(|(i, k)| (j[i][k] - je[i][3 + k]).powi(2)).sum::<f64>().sqrt()
                    };
                    let slope = (distance(1e6) / distance(1e4)).log10() / 2.0;
                    close("slope", slope, -1.0, 1.0, 0.02);
                }
            }
        }
    )*};
}

planar_proof::for_every_layout!(inertia);
