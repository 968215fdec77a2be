//! The generic implementation: identities of mechanics, on layouts without generated code.

use planar_capture::dynamics::Model;
use planar_capture::layout::{Arm, Base, Layout, Link};
use planar_capture::owned::CloneModel;
use planar_capture::registry::generic;
use planar_capture::sampling::{Regime, RegimeSample};
use planar_capture::target::Target;
use planar_proof::{assert_close, tolerance};

const SEED: u64 = 20_261_121;

/// Four arms, of four, one, two and three links: off-axis COMs, mount angles, two arms on one mount, links of length
/// zero inside and at the end.
fn layout() -> Layout {
    let link = |length: f64, mass: f64, com: [f64; 2]| Link { length, mass, inertia: 0.1 * mass, com, outline: None };
    let arm = |name: &str, mount, mount_angle, links| Arm { name: name.to_owned(), mount, mount_angle, links };
    Layout {
        name: "four_arms".to_owned(),
        base: Base { mass: 120.0, inertia: 15.0, outline: None },
        arms: vec![
            arm(
                "left",
                [0.4, 0.3],
                0.7,
                vec![
                    link(0.9, 6.0, [0.4, 0.1]),
                    link(0.0, 1.5, [0.05, -0.02]),
                    link(0.7, 4.0, [0.3, 0.0]),
                    link(0.2, 1.0, [0.1, 0.03]),
                ],
            ),
            arm("wheel", [0.0, -0.2], 0.0, vec![link(0.0, 5.0, [0.0, 0.0])]),
            arm("right", [-0.5, 0.0], -2.5, vec![link(0.8, 3.0, [0.5, -0.1]), link(0.6, 2.0, [0.2, 0.2])]),
            arm(
                "second",
                [-0.5, 0.0],
                1.1,
                vec![link(0.3, 2.0, [0.1, 0.0]), link(0.4, 2.0, [0.2, 0.0]), link(0.0, 0.5, [0.0, 0.1])],
            ),
        ],
    }
}

fn samples() -> impl Iterator<Item = (Box<dyn CloneModel>, RegimeSample)> {
    let layout = layout();
    (0..50).map(move |index| {
        let sample = Regime::MixedMasses.sample(&layout, SEED, index);
        (generic(&sample.layout), sample)
    })
}

fn mass_matrix(model: &dyn Model<f64>, base_pose: &[f64; 3], joint_angles: &[f64]) -> Vec<f64> {
    let mut matrix = vec![0.0; (3 + model.joints()).pow(2)];
    model.mass_matrix(base_pose, joint_angles, &mut matrix).expect("M");
    matrix
}

/// M v.
fn times(matrix: &[f64], v: &[f64]) -> Vec<f64> {
    matrix.chunks_exact(v.len()).map(|row| dot(row, v)).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Differs by no more than the tolerance times the size.
#[track_caller]
fn close(what: &str, found: f64, expected: f64, size: f64, tolerance: f64) {
    assert_close(what, &[found], &[expected], tolerance * size);
}

#[test]
fn momentum_and_energy_are_those_of_the_mass_matrix() {
    for (model, sample) in samples() {
        let state = sample.instant.state.view();
        let v = [&state.base_twist[..], state.joint_rates].concat();
        let matrix = mass_matrix(&*model, &state.base_pose, state.joint_angles);
        let product = times(&matrix, &v);
        let momentum = model.momentum(&state).expect("momentum");
        close("T", momentum.kinetic_energy, dot(&v, &product) / 2.0, momentum.kinetic_energy, tolerance::IDENTITY);
        // rows 1 and 2 of M v are the linear momentum, row 0 the angular momentum about the base COM
        let size =
            times(&matrix.iter().map(|m| m.abs()).collect::<Vec<_>>(), &v.iter().map(|v| v.abs()).collect::<Vec<_>>());
        let [px, py] = momentum.linear_momentum;
        let [_, x, y] = state.base_pose;
        close("px", px, product[1], size[1], tolerance::IDENTITY);
        close("py", py, product[2], size[2], tolerance::IDENTITY);
        let moment = x.abs() * size[2] + y.abs() * size[1];
        let about_base = momentum.angular_momentum - (x * py - y * px);
        close("l", about_base, product[0], size[0] + moment, tolerance::IDENTITY);
    }
}

#[test]
fn the_bias_does_no_work_beyond_the_change_of_the_mass_matrix() {
    // d/dt ½ vᵀ M v = 0 without forces: vᵀ (Ṁ v − 2 bias) = 0
    const STEP: f64 = 1e-5;
    for (model, sample) in samples() {
        let state = sample.instant.state.view();
        let v = [&state.base_twist[..], state.joint_rates].concat();
        let energy = |time: f64| {
            let at = |position: &f64, rate: &f64| position + time * rate;
            let angles: Vec<f64> = state.joint_angles.iter().zip(state.joint_rates).map(|(a, r)| at(a, r)).collect();
            let pose = std::array::from_fn(|i| at(&state.base_pose[i], &state.base_twist[i]));
            dot(&v, &times(&mass_matrix(&*model, &pose, &angles), &v))
        };
        let rate = (energy(STEP) - energy(-STEP)) / (2.0 * STEP);
        let mut bias = vec![0.0; v.len()];
        model.bias(&state, &mut bias).expect("bias");
        close("power", 2.0 * dot(&v, &bias), rate, energy(0.0), tolerance::MASS_MATRIX_RATE);
    }
}

#[test]
fn a_mount_angle_is_an_offset_of_the_first_joint() {
    let turned = layout();
    let mut straight = turned.clone();
    let sample = Regime::Moving.sample(&turned, SEED, 0);
    let mut angles = sample.instant.state.joint_angles.clone();
    let mut first = 0;
    for arm in &mut straight.arms {
        angles[first] += arm.mount_angle;
        arm.mount_angle = 0.0;
        first += arm.links.len();
    }
    let pose = &sample.instant.state.base_pose;
    let found = mass_matrix(&*generic(&turned), pose, &sample.instant.state.joint_angles);
    let expected = mass_matrix(&*generic(&straight), pose, &angles);
    assert_close("M", &found, &expected, tolerance::IDENTITY * expected[0]);
}

#[test]
fn a_merged_robot_moves_on_as_after_the_capture() {
    // robot and targets after the impact have the momentum and energy of the merged robot at the same velocities
    for (model, sample) in samples().filter(|(_, sample)| sample.instant.targets.iter().any(Option::is_some)) {
        let state = sample.instant.state.view();
        let targets = &sample.instant.targets;
        let mut merged = model.clone_box();
        merged.merge(&state.base_pose, state.joint_angles, targets).expect("merged");
        let found = merged.momentum(&state).expect("momentum");
        let apart = model.momentum(&state).expect("momentum");
        let (mut end_effectors, mut twists) = (vec![[0.0; 3]; model.arms()], vec![[0.0; 3]; model.arms()]);
        model.end_effector_poses(&state.base_pose, state.joint_angles, &mut end_effectors).expect("poses");
        model.end_effector_twists(&state, &mut twists).expect("twists");
        let (mut angular, mut energy) = (apart.angular_momentum, apart.kinetic_energy);
        let mut size = angular.abs();
        for ((target, end_effector), twist) in targets.iter().zip(&end_effectors).zip(&twists) {
            let Some(target) = target else { continue };
            let (momentum, kinetic) =
                target.momentum(&target.position(end_effector), &target.twist_from_contact(twist));
            angular += momentum[0];
            size += momentum[0].abs() + kinetic;
            energy += kinetic;
        }
        close("T", found.kinetic_energy, energy, energy, tolerance::IDENTITY);
        close("l", found.angular_momentum, angular, size + energy, tolerance::IDENTITY);
    }
}

#[test]
fn a_target_needs_a_link_to_hold_it() {
    let mut layout = layout();
    layout.arms[1].links.clear();
    let mut model = generic(&layout);
    let target = Target { mass: 1.0, inertia: 1.0, contact: [0.0; 2], twist: [0.0; 3] };
    let before = mass_matrix(&*model, &[0.0; 3], &[0.0; 9]);
    let error = model.merge(&[0.0; 3], &[0.0; 9], &[None, Some(target), None, None]).expect_err("no link");
    assert!(error.to_string().contains("links of an arm with a target"), "{error}");
    assert_eq!(mass_matrix(&*model, &[0.0; 3], &[0.0; 9]), before, "the model is as it was");
}
