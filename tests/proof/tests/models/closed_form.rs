//! The two-link free-floating robot against a hand derivation: barycentric vectors, as in E. Papadopoulos and S.
//! Dubowsky, *Dynamic Singularities in Free-Floating Space Manipulators*, ASME J. Dyn. Syst. Meas. Control 115 (1993),
//! planar example.
//!
//! With the system's COM at rest, T = ½ Σ `D_ij` `ω_i` `ω_j` over the absolute rates of base and links, and the end
//! effector is a e₀ + b e₁ + c e₂ from the COM, with the directions e of the bodies. Zero angular momentum eliminates
//! `ω_0`.

use planar_capture::generated::single_arm_2r::{Model, Parameters};
use planar_proof::sample::{config, sample};
use planar_proof::{assert_close, tolerance};
use proptest::prelude::*;

/// (generalized inertia, generalized Jacobian's rows [ω, vx, vy]) of the robot with COMs on the links' axes.
#[allow(clippy::many_single_char_names, reason = "the names of the cited paper")]
fn by_hand(p: &Parameters<f64>, yaw: f64, theta: [f64; 2]) -> ([[f64; 2]; 2], [[f64; 2]; 3]) {
    let (m0, m1, m2) = (p.base_mass, p.arm1_link1_mass, p.arm1_link2_mass);
    let m = m0 + m1 + m2;
    let r0 = p.arm1_mount_x; // base COM to joint 1
    let (l1, r1) = (p.arm1_link1_com_x, p.arm1_link1_length - p.arm1_link1_com_x); // joint 1 to COM 1 to joint 2
    let (l2, r2) = (p.arm1_link2_com_x, p.arm1_link2_length - p.arm1_link2_com_x); // joint 2 to COM 2 to end effector
    let d00 = p.base_inertia + m0 * (m1 + m2) / m * r0 * r0;
    let d11 = p.arm1_link1_inertia + (m0 * m1 * l1 * l1 + m1 * m2 * r1 * r1 + m0 * m2 * (l1 + r1).powi(2)) / m;
    let d22 = p.arm1_link2_inertia + m2 * (m0 + m1) / m * l2 * l2;
    let d01 = m0 * r0 / m * (m1 * l1 + m2 * (l1 + r1)) * theta[0].cos();
    let d02 = m0 * m2 / m * r0 * l2 * (theta[0] + theta[1]).cos();
    let d12 = m2 * l2 / m * (m0 * (l1 + r1) + m1 * r1) * theta[1].cos();
    let (s0, s1, s2) = (d00 + d01 + d02, d01 + d11 + d12, d02 + d12 + d22);
    let d = s0 + s1 + s2;
    // ω_0 = −[(s1 + s2) θ̇_1 + s2 θ̇_2] / d
    let base = [-(s1 + s2) / d, -s2 / d];
    let links = [d11 + 2.0 * d12 + d22, d12 + d22, d22];
    let inertia = [
        [links[0] - (s1 + s2).powi(2) / d, links[1] - (s1 + s2) * s2 / d],
        [links[1] - (s1 + s2) * s2 / d, links[2] - s2 * s2 / d],
    ];
    let (a, b, c) = (m0 * r0 / m, (m0 * (l1 + r1) + m1 * r1) / m, l2 * (m0 + m1) / m + r2);
    let angles = [yaw, yaw + theta[0], yaw + theta[0] + theta[1]];
    let arms = [a, b, c];
    let mut jacobian = [[0.0; 2]; 3];
    for joint in 0..2 {
        // joint k turns the links from k on, and the base with all of them
        jacobian[0][joint] = 1.0 + base[joint];
        for (body, (angle, arm)) in angles.iter().zip(arms).enumerate() {
            let rate = base[joint] + if body > joint { 1.0 } else { 0.0 };
            jacobian[1][joint] -= rate * arm * angle.sin();
            jacobian[2][joint] += rate * arm * angle.cos();
        }
    }
    (inertia, jacobian)
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn two_link_robot_agrees_with_the_hand_derivation(s in sample(1, 2), scale in 0.2..5.0_f64) {
        let default = Parameters::<f64>::default();
        let parameters = Parameters {
            base_mass: default.base_mass * scale,
            arm1_link1_length: 0.9,
            arm1_link1_com_x: 0.3,
            arm1_link2_com_x: 0.45,
            arm1_link2_mass: 4.0 / scale,
            ..default
        };
        let angles = [s.joint_angles[0], s.joint_angles[1]];
        let (inertia, jacobian) = by_hand(&parameters, s.base_pose[0], angles);
        let found = Model::new(parameters).reduced_dynamics(&s.base_pose, &angles, &[0.0; 3], &[0.0; 2]);
        let size = inertia.as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let bound = 10.0 * tolerance::IDENTITY;
        assert_close("I", found.generalized_inertia.as_flattened(), inertia.as_flattened(), bound * size);
        assert_close("J", found.generalized_jacobian.as_flattened(), jacobian.as_flattened(), bound);
    }
}
