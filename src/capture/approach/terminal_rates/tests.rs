//! Design of end rates: of robots with momentum, of slow ends, at rest, and where the Jacobian gives less than is wanted.

use super::*;
use crate::owned::{CloneModel, RobotState};
use crate::registry;
use crate::scenario::{FinalRates, Scenario};
use nalgebra::DMatrix;
use planar_proof::{assert_close, file, layout, sample::config, tolerance};
use proptest::array::{uniform3, uniform4};
use proptest::prelude::*;

fn model() -> Box<dyn CloneModel> {
    registry::generic(&layout("dual_arm_2r"))
}

/// A state and its end effectors.
fn end(model: &AnyModel<f64>, state: RobotState) -> ApproachEnd {
    let mut twists = vec![[0.0; 3]; model.arms()];
    model.end_effector_twists(&state.view(), &mut twists).expect("twists");
    ApproachEnd { time: 1.0, state, end_effector_poses: Vec::new(), end_effector_twists: twists }
}

fn state(joint_angles: [f64; 4], base_twist: [f64; 3], joint_rates: [f64; 4]) -> RobotState {
    let (joint_angles, joint_rates) = (joint_angles.to_vec(), joint_rates.to_vec());
    RobotState { base_pose: [0.3, -1.0, 2.0], joint_angles, base_twist, joint_rates }
}

proptest! {
    #![proptest_config(config())]

    /// The rates of a moving robot are those that its end effectors' twists have: by a base twist and rates that are
    /// drawn, and by no others with the same momentum.
    #[test]
    fn rates_of_a_twist_are_those_that_it_has(
        bends in uniform4(0.5..1.5_f64),
        twist in uniform3(-0.5..0.5_f64),
        rates in uniform4(-1.0..1.0_f64),
    ) {
        let model = model();
        let [a, b, c, d] = bends;
        let end = end(&*model, state([a, -b, c + 1.5, d], twist, rates));
        let goals: Vec<_> = end.end_effector_twists.iter().map(|twist| [None, Some(twist[1]), Some(twist[2])]).collect();
        let (found, margin) = rates_for(&*model, &end, &goals).expect("rates");
        prop_assume!(margin > 0.02);
        assert_close("rates", &found, &rates, tolerance::SOLVED_IDENTITY);
        // singular values by another way: the eigenvalues of J Jᵀ
        let (_, jacobian) = reduced_matrices(&*model, &end.state.view()).expect("a Jacobian");
        let linear = jacobian.select_rows(&[1, 2, 4, 5]);
        let squares = (&linear * linear.transpose()).symmetric_eigenvalues();
        assert_close("margin", &[margin], &[(squares.min() / squares.max()).sqrt()], tolerance::SOLVED_IDENTITY);
    }
}

/// Three numbers for an arm of two joints are too many, however small they are; the miss is that of least squares.
#[test]
fn what_is_out_of_reach_is_so_at_every_size() {
    let model = model();
    let end = end(&*model, state([0.6, -1.2, 2.5, 1.2], [0.0; 3], [0.0; 4]));
    let (_, jacobian) = reduced_matrices(&*model, &end.state.view()).expect("a Jacobian");
    let projection = DMatrix::identity(6, 6) - &jacobian * jacobian.clone().pseudo_inverse(1e-12).expect("an inverse");
    for size in [1e-9, 1.0, 1e9] {
        let goals = [[0.3, 0.1, -0.2], [-0.1, 0.2, 0.4]].map(|goal: [f64; 3]| goal.map(|value| size * value));
        let error = rates_for(&*model, &end, &goals.map(|goal| goal.map(Some))).expect_err("too many");
        let TerminalRatesError::Unreachable { rows, columns, miss, .. } = error else { panic!("{error}") };
        let expected = (&projection * DVector::from_column_slice(goals.as_flattened())).amax() / size;
        assert_eq!((rows, columns), (6, 4));
        assert_close("miss", &[miss / size], &[expected], tolerance::SOLVED_IDENTITY);
    }
}

/// Twists that rates give but for a ten-millionth of them are out of reach; rounding is not.
#[test]
fn a_small_miss_is_a_miss() {
    let model = model();
    let end = end(&*model, state([0.6, -1.2, 2.5, 1.2], [0.0; 3], [0.0; 4]));
    let (_, jacobian) = reduced_matrices(&*model, &end.state.view()).expect("a Jacobian");
    let projection = DMatrix::identity(6, 6) - &jacobian * jacobian.clone().pseudo_inverse(1e-12).expect("an inverse");
    let (reached, beside) =
        (&jacobian * DVector::from_element(4, 1.0), projection.column(0) / projection.column(0).amax());
    let design = |miss: f64| {
        let wanted = &reached + &beside * miss * reached.amax();
        let goals: Vec<[_; 3]> =
            wanted.as_slice().chunks(3).map(|goal| std::array::from_fn(|i| Some(goal[i]))).collect();
        rates_for(&*model, &end, &goals)
    };
    assert_close("rates", &design(1e-13).expect("rounding").0, &[1.0; 4], tolerance::SOLVED_IDENTITY);
    assert!(matches!(design(1e-7), Err(TerminalRatesError::Unreachable { .. })), "{:?}", design(1e-7));
}

/// Rest is a twist as any other, also for a wheel that moves no end effector.
#[test]
fn rest_at_the_end() {
    let model = model();
    let goals = [[Some(0.0); 3]; 2];
    let at_rest = end(&*model, state([0.6, -1.2, 2.5, 1.2], [0.0; 3], [0.0; 4]));
    let (rates, margin) = rates_for(&*model, &at_rest, &goals).expect("rates");
    assert!(rates == [0.0; 4] && margin > 0.01, "{rates:?} {margin}");

    let mut wheel = layout("single_arm_2r");
    wheel.arms[0].mount = [0.0; 2];
    wheel.arms[0].links.truncate(1);
    let link = &mut wheel.arms[0].links[0];
    (link.length, link.com) = (0.0, [0.0; 2]);
    let wheel = registry::generic(&wheel);
    let resting = RobotState { joint_angles: vec![0.7], joint_rates: vec![0.0], ..at_rest.state };
    let (rates, margin) = rates_for(&*wheel, &end(&*wheel, resting), &[[None, Some(0.0), Some(0.0)]]).expect("rates");
    assert!(rates == [0.0] && margin.to_bits() == 0, "{rates:?} {margin}");
}

fn scenario(keys: &str) -> Scenario {
    let text = format!(
        "name = \"it\"\nlayout = \"single_arm_2r\"\n[initial]\njoint_angles = [0.6, -1.2]\n[approach]\ntracking = \"exact\"\n\
         trajectory = \"quintic\"\nfinal_joint_angles = [0.4, -0.8]\n{keys}\n"
    );
    Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

/// What is found of an approach of 10 s with these goals.
fn design(goals: [f64; 3]) -> Result<TerminalRates, TerminalRatesError> {
    let scenario = scenario("duration = 10.0\nfinal_joint_rates = [0.0, 0.0]");
    let model = registry::generic(&scenario.layout);
    terminal_rates(&*model, &ApproachTracking::new(&scenario, 1.0), &[goals.map(Some)], &mut || ())
}

/// Two joints give two of three numbers, which two depends on the yaw of the base: what is in reach at first is not when
/// the base has turned by the rates for it. What never was is another error, and so are an approach without an end and
/// rates without one.
#[test]
fn designs_without_rates() {
    let scenario = scenario("duration = 10.0\nfinal_joint_rates = [0.0, 0.0]");
    let robot = registry::generic(&scenario.layout);
    let tracking = ApproachTracking::new(&scenario, 1.0);
    let end = tracking.exact_end(&*robot, &[0.0; 2]).expect("an end");
    let (_, jacobian) = reduced_matrices(&*robot, &end.state.view()).expect("a Jacobian");
    let twist = &jacobian * DVector::from_column_slice(&[0.2, -0.3]);
    let goals = [twist[0], twist[1], twist[2]];
    let (rates, margin) = rates_for(&*robot, &end, &[goals.map(Some)]).expect("in reach");
    assert_close("rates", &rates, &[0.2, -0.3], tolerance::SOLVED_IDENTITY);
    match design(goals) {
        // the angles, and with them the singular values, are those of the first iteration
        Err(TerminalRatesError::Diverged { iteration: 2, largest_rate, singularity_margin, source: None }) => {
            assert_close("margin", &[singularity_margin, largest_rate], &[margin, 0.3], tolerance::SOLVED_IDENTITY);
        }
        other => panic!("{other:?}"),
    }
    let unreachable = design([twist[0] + 1.0, twist[1], twist[2]]);
    assert!(matches!(unreachable, Err(TerminalRatesError::Unreachable { rows: 3, columns: 2, .. })), "{unreachable:?}");
    let absurd = design(goals.map(|goal| 1e200 * goal));
    let Err(TerminalRatesError::Diverged { iteration: 2, source: Some(_), .. }) = absurd else { panic!("{absurd:?}") };

    let mut short = scenario.clone();
    short.approach.duration = 1e-158;
    let short = terminal_rates(&*robot, &ApproachTracking::new(&short, 1.0), &[goals.map(Some)], &mut || ());
    assert!(matches!(short, Err(TerminalRatesError::PhaseError(_))), "{short:?}");
}

/// From rest, the same motion in a part of the time has as many times the twists and rates: as many digits at every size.
#[test]
fn the_design_has_no_unit_of_time() {
    let robot = registry::generic(&layout("single_arm_2r"));
    let design = |speed: f64| {
        let [duration, x, y] = [10.0 / speed, 0.3 * speed, 0.1 * speed];
        let scenario = scenario(&format!("duration = {duration}\nfinal_end_effector_twists = [[{x}, {y}]]"));
        let FinalRates::EndEffectorTwists(goals) = &scenario.approach.end else { panic!("twists") };
        let found = terminal_rates(&*robot, &ApproachTracking::new(&scenario, 1.0), goals, &mut || ());
        found.expect("rates").joint_rates.iter().map(|rate| rate / speed).collect::<Vec<_>>()
    };
    let rates = design(1.0);
    for speed in [1.0 / 1024.0, 1024.0] {
        assert_close("rates", &design(speed), &rates, tolerance::REACHED);
    }
}

/// What a design says that it took is how often it computed the end of an approach.
#[test]
fn iterations_are_ends_of_approaches() {
    let text = "name = \"it\"\nlayout = \"dual_arm_2r\"\n[initial]\njoint_angles = [0.6, -1.2, 2.5, 1.2]\n[approach]\n\
                duration = 10.0\ntrajectory = \"quartic\"\nfinal_joint_angles = [0.3, -0.9, 2.7, 1.0]\n\
                final_end_effector_twists = [[0.05, 0.0], [0.0, -0.05]]\ntracking = \"exact\"\n";
    let scenario = Scenario::parse(text, "it.toml", "".as_ref(), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"));
    let FinalRates::EndEffectorTwists(goals) = &scenario.approach.end else { panic!("twists") };
    let mut ticks = 0;
    let approach = ApproachTracking::new(&scenario, 1.0);
    let found = terminal_rates(&*model(), &approach, goals, &mut || ticks += 1).expect("rates");
    assert!(ticks > 1 && found.iterations == ticks, "{} {ticks}", found.iterations);
}
