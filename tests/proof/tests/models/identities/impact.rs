//! A rigid capture, exact and after the paper, and the merged robot.

macro_rules! impact {
    ($($layout:ident)*) => {$(
        mod $layout {
            use planar_proof::sample::{config, sample};
            use planar_proof::tolerance;
            use crate::identities::{close, inputs, targets, velocity};
            use nalgebra::{DMatrix, DVector};
            use planar_capture::dynamics::Merge;
            use planar_capture::generated::$layout::{ARMS, JOINTS, MANIFEST, Model, Parameters, SIZE};
            use planar_capture::manifest::ParameterKind;
            use proptest::prelude::*;

            proptest! {
                #![proptest_config(config())]

                /// A rigid capture conserves momentum, loses energy, and its impulses are the momentum changes of both
                /// sides.
                #[test]
                fn exact_impact_is_an_inelastic_one(s in sample(ARMS, JOINTS)) {
                    let (pose, angles, twist, rates) = inputs::<JOINTS>(&s);
                    let model = Model::<f64>::default();
                    let targets = targets::<ARMS>(&s);
                    let found = model.full_impact(
                        &pose, &angles, &twist, &rates,
                        &targets.map(|t| t.mass), &targets.map(|t| t.inertia),
                        &targets.map(|t| t.contact), &targets.map(|t| t.twist),
                    );
                    let g = DMatrix::from_fn(SIZE, SIZE, |i, j| found.impact_matrix[i][j]);
                    prop_assert!(g == g.transpose() && g.clone().cholesky().is_some(), "G is symmetric positive definite");
                    let after: Vec<f64> = found.base_twist_after.into_iter().chain(found.joint_rates_after).collect();
                    let end_effectors = model.end_effector_twists(&pose, &angles, &found.base_twist_after, &found.joint_rates_after);
                    let m = DMatrix::from_fn(SIZE, SIZE, |i, j| model.mass_matrix(&pose, &angles)[i][j]);
                    let change = DVector::from_column_slice(&after) - DVector::from_column_slice(&velocity::<SIZE>(&s));
                    let je = model.end_effector_jacobian(&pose, &angles);
                    let je = DMatrix::from_fn(3 * ARMS, SIZE, |i, j| je[i][j]);
                    let mut impulses = DVector::zeros(3 * ARMS);
                    let poses = model.end_effector_poses(&pose, &angles);
                    let start = model.momentum(&pose, &angles, &twist, &rates);
                    let end = model.momentum(&pose, &angles, &found.base_twist_after, &found.joint_rates_after);
                    let mut energy = (start.kinetic_energy, end.kinetic_energy);
                    let mut jump = [
                        end.angular_momentum - start.angular_momentum,
                        end.linear_momentum[0] - start.linear_momentum[0],
                        end.linear_momentum[1] - start.linear_momentum[1],
                    ];
                    for (arm, target) in targets.iter().enumerate() {
                        let after = target.twist_from_contact(&end_effectors[arm]);
                        impulses.rows_mut(3 * arm, 3).copy_from_slice(&target.impulse(&after));
                        let place = target.position(&poses[arm]);
                        let ((before, t0), (now, t1)) = (target.momentum(&place, &target.twist), target.momentum(&place, &after));
                        jump.iter_mut().zip(now.iter().zip(before)).for_each(|(j, (now, before))| *j += now - before);
                        energy = (energy.0 + t0, energy.1 + t1);
                    }
                    let scale = 1e4;
                    for change in jump {
                        close("momentum of both", change, 0.0, scale, tolerance::SOLVED_IDENTITY);
                    }
                    // M (v_f − v_i) = J_eᵀ F̄
                    let both = &m * change - je.transpose() * impulses;
                    both.iter().for_each(|b| close("impulse", *b, 0.0, scale, tolerance::SOLVED_IDENTITY));
                    prop_assert!(energy.1 <= energy.0 * (1.0 + 1e-12), "energy grows from {} to {}", energy.0, energy.1);
                    prop_assert!(found.smallest_pivot > 0.0);
                }

                /// The paper's G is symmetric positive definite and its solution solves it.
                #[test]
                fn reduced_impact_solves_its_equations(s in sample(ARMS, JOINTS)) {
                    let (pose, angles, _, rates) = inputs::<JOINTS>(&s);
                    let targets = targets::<ARMS>(&s);
                    let found = Model::<f64>::default().reduced_impact(
                        &pose, &angles, &rates,
                        &targets.map(|t| t.mass), &targets.map(|t| t.inertia),
                        &targets.map(|t| t.contact), &targets.map(|t| t.twist),
                    );
                    let g = DMatrix::from_fn(JOINTS, JOINTS, |i, j| found.impact_matrix[i][j]);
                    prop_assert!(g == g.transpose() && g.clone().cholesky().is_some(), "G is symmetric positive definite");
                    let x = DVector::from_column_slice(&found.joint_rates_after);
                    let h = DVector::from_column_slice(&found.impact_momentum);
                    let scale = g.amax() * x.amax() + h.amax();
                    (&g * &x - &h).iter().for_each(|r| close("G x = H", *r, 0.0, scale, tolerance::IDENTITY));
                }

                /// Merging is the same as building the robot with the combined last link.
                #[test]
                fn merged_robot_is_one_built_from_scratch(s in sample(ARMS, JOINTS)) {
                    let (pose, angles, twist, rates) = inputs::<JOINTS>(&s);
                    let mut merged = Model::<f64>::default();
                    let targets = targets::<ARMS>(&s);
                    let given: Vec<_> = targets.iter().copied().map(Some).collect();
                    let poses = merged.end_effector_poses(&pose, &angles);
                    let mut values = merged.parameters().to_array();
                    for (arm, target) in targets.iter().enumerate() {
                        let link = MANIFEST.links[arm] - 1;
                        let at = |quantity| MANIFEST.position(quantity, arm, link).expect("a parameter");
                        // both COMs from the end effector, inertial axes
                        let (sin, cos) = poses[arm][0].sin_cos();
                        let (cx, cy) = (values[at(ParameterKind::LinkComX)] - values[at(ParameterKind::LinkLength)], values[at(ParameterKind::LinkComY)]);
                        let own = [cos * cx - sin * cy, sin * cx + cos * cy];
                        let other = [-target.contact[0], -target.contact[1]];
                        let mass = values[at(ParameterKind::LinkMass)];
                        let total = mass + target.mass;
                        let com = [0, 1].map(|i: usize| (mass * own[i] + target.mass * other[i]) / total);
                        let squared = |c: [f64; 2]| (c[0] - com[0]).powi(2) + (c[1] - com[1]).powi(2);
                        values[at(ParameterKind::LinkInertia)] += target.inertia + mass * squared(own) + target.mass * squared(other);
                        values[at(ParameterKind::LinkMass)] = total;
                        values[at(ParameterKind::LinkComX)] = values[at(ParameterKind::LinkLength)] + cos * com[0] + sin * com[1];
                        values[at(ParameterKind::LinkComY)] = cos * com[1] - sin * com[0];
                    }
                    Merge::merge(&mut merged, &pose, &angles, &given).expect("a merged robot");
                    let built = Model::new(Parameters::from_array(values));
                    let (a, b) = (merged.mass_matrix(&pose, &angles), built.mass_matrix(&pose, &angles));
                    let scale = a.as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                    for (a, b) in a.as_flattened().iter().zip(b.as_flattened()) {
                        close("M", *a, *b, scale, tolerance::IDENTITY);
                    }
                    let (a, b) = (merged.bias(&pose, &angles, &twist, &rates), built.bias(&pose, &angles, &twist, &rates));
                    for (a, b) in a.iter().zip(b) {
                        close("bias", *a, b, 10.0 * scale, tolerance::IDENTITY);
                    }
                }
            }
        }
    )*};
}

planar_proof::for_every_layout!(impact);
