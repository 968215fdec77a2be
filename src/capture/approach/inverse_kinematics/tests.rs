//! Steps of inverse kinematics: damped least squares, residuals per reach, and trials that fail.

use super::*;
use crate::owned::RobotState;
use crate::registry;
use crate::trajectory::TrajectoryKind;
use planar_proof::{assert_close, file, sample::config, tolerance};
use proptest::array::{uniform3, uniform6};
use proptest::prelude::*;

const TEXT: &str = r#"
name = "two"
layout = "dual_arm_2r"
[initial]
joint_angles = [0.6, -1.2, 2.5, 1.2]
[approach]
duration = 10.0
trajectory = "cycloidal"
final_joint_angles = [0.6, -1.2, 2.5, 1.2]
tracking = "exact"
"#;

fn scenario() -> Scenario {
    Scenario::parse(TEXT, "two.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

/// Whether x solves `(JᵀJ + λ²) x = Jᵀe` with `λ = 10⁻³ σ₁`, but for its length; σ by the eigenvalues of `J Jᵀ`.
fn check_step(jacobian: &DMatrix<f64>, errors: &DVector<f64>) {
    let (change, margin) = damped_step(jacobian.clone(), errors);
    let squares = (jacobian * jacobian.transpose()).symmetric_eigenvalues();
    let damping = 1e-6 * squares.max();
    let joints = jacobian.ncols();
    let normal = jacobian.transpose() * jacobian + DMatrix::identity(joints, joints) * damping;
    let free = normal.lu().solve(&(jacobian.transpose() * errors)).expect("a damped matrix is regular");
    let expected = if free.amax() > 0.5 { &free * (0.5 / free.amax()) } else { free };
    assert_close("step", change.as_slice(), expected.as_slice(), tolerance::SOLVED_IDENTITY);
    let ratio = (squares.min() / squares.max()).sqrt();
    assert_close("margin", &[margin], &[ratio], tolerance::SOLVED_IDENTITY);
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn steps_solve_the_damped_normal_equations(entries in uniform6(-1.0..1.0_f64), errors in uniform3(-1.0..1.0_f64), scale in 0.1..10.0_f64) {
        // two equations for three joints; what is smaller has an eigenvalue without digits
        let jacobian = scale * DMatrix::from_row_slice(2, 3, &entries);
        prop_assume!((&jacobian * jacobian.transpose()).determinant() > 1e-2 * scale.powi(4));
        for size in [0.01, 1.0, 100.0] {
            check_step(&jacobian, &(size * DVector::from_column_slice(&errors[..2])));
        }
    }
}

/// What helps depends on how far it came.
#[test]
fn advice_is_that_of_the_residual() {
    let said = |residual, last| {
        let history = vec![0.1, residual, last];
        InverseKinematicsError::NotConverged { iterations: 3, residual, history, singularity_margin: 0.1 }.to_string()
    };
    for (residual, last, advice) in [
        (1e-3, 1e-3, "may be out of reach"),
        (2e-6, 2e-6, "may be out of reach"),
        (1e-3, f64::NAN, "diverged"),
        (1e-10, 1e-10, "nearly reached"),
        (1e-10, f64::NAN, "nearly reached"),
    ] {
        let found = said(residual, last);
        let each = ["may be out of reach", "diverged", "nearly reached"];
        let given: Vec<_> = each.into_iter().filter(|words| found.contains(words)).collect();
        assert_eq!(given, [advice], "{found}");
    }
}

#[test]
fn nothing_to_move_is_no_step() {
    let (change, margin) = damped_step(DMatrix::zeros(2, 3), &DVector::from_element(2, 1.0));
    assert_eq!((change, margin.to_bits()), (DVector::zeros(3), 0));
}

/// The residual is the largest error: rad, and m per m of reach; m for arms without one.
#[test]
fn residuals_are_relative_to_the_reach() {
    let mut scenario = scenario();
    let model = registry::generic(&scenario.layout);
    let (poses, joint_angles) = (vec![[0.3, 1.0, -2.0], [-0.7, 0.4, 0.9]], scenario.initial.joint_angles.clone());
    let state = RobotState { base_pose: [0.0; 3], base_twist: [0.0; 3], joint_rates: vec![0.0; 4], joint_angles };
    let end = ApproachEnd { time: 1.0, state, end_effector_twists: vec![[0.0; 3]; 2], end_effector_poses: poses };
    let residual = |scenario: &Scenario, goals: &[EndEffectorGoal]| {
        let trial = Trial { scenario: scenario.clone(), rates: vec![0.0; 4] };
        trial.step(&*model, goals, &end).expect("a step").residual
    };
    let off = |yaw: f64| [EndEffectorGoal::Pose([0.3 + yaw, 1.3, -2.4]), EndEffectorGoal::Position([0.4, 0.8])];
    let reach = scenario.layout.arms[0].reach();
    assert!((reach - 1.0).abs() > 0.1, "a reach of 1 m shows nothing");
    for (yaw, expected) in [(0.001, 0.4 / reach), (1.5, 1.5)] {
        assert_close("residual", &[residual(&scenario, &off(yaw))], &[expected], tolerance::POLYNOMIAL);
    }
    for link in &mut scenario.layout.arms[0].links {
        link.length = 0.0;
    }
    assert_close("residual", &[residual(&scenario, &off(0.001))], &[0.4], tolerance::POLYNOMIAL);
}

/// Where a trial fails, its step is halved, up to the most; where the first fails, its error is that of the design.
#[test]
fn trials_that_fail() {
    let mut scenario = scenario();
    // accelerations that are no numbers, but for joints that stay
    scenario.approach.duration = 1e-158;
    let model = registry::generic(&scenario.layout);
    let goals = [EndEffectorGoal::Position([0.5, 0.5]), EndEffectorGoal::Any];
    let search =
        |scenario: &Scenario| inverse_kinematics(&*model, scenario, &goals, 1.0, &mut || ()).expect_err("no end");
    let error = search(&scenario);
    let InverseKinematicsError::NotConverged { iterations, residual, history, .. } = &error else { panic!("{error}") };
    assert_eq!((*iterations, history.len()), (2 + 12, 2 + 12), "{history:?}");
    assert!(
        history[1..].iter().all(|residual| residual.is_infinite()) && residual.to_bits() == history[0].to_bits(),
        "{history:?}"
    );
    scenario.approach.final_joint_angles[0] += 0.5;
    let error = search(&scenario);
    assert!(matches!(error, InverseKinematicsError::Rates(TerminalRatesError::PhaseError(_))), "{error}");
}

/// Goals that the first approach reaches, which ends at rest: with the terminal rates of the wanted twists the base turns
/// otherwise, and the same joint angles miss them.
#[test]
fn goals_are_reached_with_the_terminal_rates_that_are_returned() {
    let mut scenario = scenario();
    scenario.approach.trajectory = TrajectoryKind::Quintic;
    scenario.approach.final_joint_angles = vec![0.9, -0.8, 2.2, 0.9];
    let wanted = vec![[None, Some(-0.05), Some(0.1)], [None, Some(0.08), Some(0.04)]];
    scenario.approach.end = FinalRates::EndEffectorTwists(wanted.clone());
    let model = registry::generic(&scenario.layout);
    let end = |scenario: &Scenario, rates: &[f64]| {
        ApproachTracking::new(scenario, 1.0).exact_end(&*model, rates).expect("an end")
    };
    let positions = |end: &ApproachEnd| end.end_effector_poses.iter().flat_map(|pose| [pose[1], pose[2]]).collect();
    let reached: Vec<f64> = positions(&end(&scenario, &[0.0; 4]));
    let goals: Vec<_> = reached.chunks_exact(2).map(|at| EndEffectorGoal::Position([at[0], at[1]])).collect();
    let found = inverse_kinematics(&*model, &scenario, &goals, 1.0, &mut || ()).expect("joint angles");
    scenario.approach.final_joint_angles = found.joint_angles;
    let found = end(&scenario, &found.rates.joint_rates);
    let again: Vec<f64> = positions(&found);
    assert_close("positions", &again, &reached, tolerance::REACHED);
    let velocities: Vec<f64> = found.end_effector_twists.iter().flat_map(|twist| [twist[1], twist[2]]).collect();
    let wanted: Vec<f64> = wanted.into_iter().flatten().flatten().collect();
    assert_close("velocities", &velocities, &wanted, tolerance::REACHED);
}

#[test]
fn long_lists_of_residuals_are_shortened() {
    assert_eq!(shortened(&[0.5]), "5.0e-1");
    assert_eq!(shortened(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), "1.0e0, 2.0e0, 3.0e0, 4.0e0, 5.0e0, 6.0e0");
    assert_eq!(shortened(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]), "1.0e0, 2.0e0, 3.0e0, …, 5.0e0, 6.0e0, 7.0e0");
}

/// The terminal rates of a design of angles, and their margin, are those of the design of rates alone for these angles: of both
/// arms, of which one has a pose to reach.
#[test]
fn rates_are_those_of_their_own_design() {
    let text = TEXT.replace("cycloidal", "quartic") + "final_end_effector_twists = [[0.05, 0.0], [0.0, -0.05]]\n";
    let mut scenario = Scenario::parse(&text, "two.toml", &file("scenarios"), registry::SHIPPED).expect("a scenario");
    let model = registry::generic(&scenario.layout);
    let FinalRates::EndEffectorTwists(twists) = scenario.approach.end.clone() else { panic!("twists") };
    let start = ApproachTracking::new(&scenario, 1.0).exact_end(&*model, &[0.0; 4]).expect("an end");
    let [[_, x, y], _] = start.end_effector_poses[..] else { panic!("two arms") };
    let goals = [EndEffectorGoal::Position([x - 0.1, y + 0.1]), EndEffectorGoal::Any];
    let mut ticks = 0;
    let found = inverse_kinematics(&*model, &scenario, &goals, 1.0, &mut || ticks += 1).expect("angles");
    assert_eq!((found.iterations, found.rates.iterations), (ticks, ticks));
    scenario.approach.final_joint_angles.clone_from(&found.joint_angles);
    let approach = ApproachTracking::new(&scenario, 1.0);
    let alone = crate::capture::approach::terminal_rates::terminal_rates(&*model, &approach, &twists, &mut || ());
    let alone = alone.expect("rates");
    assert_close("rates", &found.rates.joint_rates, &alone.joint_rates, 1e-9);
    assert_close("margin", &[found.rates.singularity_margin], &[alone.singularity_margin], 1e-9);
}
