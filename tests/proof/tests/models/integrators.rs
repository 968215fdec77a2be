//! A step of an integrator does not depend on the unit of time, and where it converges does not depend on the state's
//! size.
#![allow(clippy::float_cmp, reason = "steps by powers of two do not round")]

use planar_capture::control::{BaseTorque, Control};
use planar_capture::dynamics;
use planar_capture::error::Error;
use planar_capture::formulation::derivative;
use planar_capture::generated::dual_arm_3r::{JOINTS, Model, Parameters};
use planar_capture::integrate::{Adaptive, GaussLegendre, RungeKutta4, SemiImplicitEuler};
use planar_capture::state::{State, vector_length};
use proptest::prelude::*;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// ẋ = f(t, x).
type Derivative<'a> = &'a mut dyn FnMut(f64, &[f64], &mut [f64]) -> Result<(), Error>;

type Step = fn(f64, f64, &mut [f64], Derivative<'_>) -> Result<(), Error>;

fn runge_kutta(time: f64, step: f64, x: &mut [f64], f: Derivative<'_>) -> Result<(), Error> {
    RungeKutta4::new(&mut vec![f64::NAN; 3 * x.len()])?.step(time, step, x, f)
}

fn gauss_legendre(time: f64, step: f64, x: &mut [f64], f: Derivative<'_>) -> Result<(), Error> {
    GaussLegendre::new(&mut vec![f64::NAN; GaussLegendre::<f64>::WORKSPACE * x.len()])?.step(time, step, x, f)
}

/// With slopes `λ f(λ t, x)` a step of `step / λ` at `time / λ` gives the same numbers; λ is a power of two, so that
/// nothing rounds.
fn in_units(step: Step, lambda: f64, stiffness: f64, x: [f64; 2]) -> Result<[f64; 2], Error> {
    let mut x = x;
    let mut slope = |time: f64, x: &[f64], rate: &mut [f64]| {
        rate[0] = lambda * (x[1] - stiffness * x[0]);
        rate[1] = lambda * ((lambda * time).cos() - x[0] * x[0]);
        Ok(())
    };
    step(0.75 / lambda, 0.125 / lambda, &mut x, &mut slope).map(|()| x)
}

proptest! {
    #[test]
    fn the_unit_of_time_is_arbitrary(x in prop::array::uniform2(-2.0..2.0_f64)) {
        for step in [runge_kutta as Step, gauss_legendre] {
            let expected = in_units(step, 1.0, 3.0, x);
            for exponent in [-60, -30, 30, 60] {
                prop_assert_eq!(&in_units(step, 2.0_f64.powi(exponent), 3.0, x), &expected);
            }
            prop_assert!(expected.is_ok());
        }
    }
}

/// Where the stages do not contract, they do not in any unit of time.
#[test]
fn a_step_that_is_too_long_is_refused_in_every_unit_of_time() {
    for exponent in [-60, 0, 60] {
        let found = in_units(gauss_legendre, 2.0_f64.powi(exponent), 100.0, [1.0, 0.5]);
        assert!(matches!(found, Err(Error::NotConverged { .. })), "{exponent}: {found:?}");
    }
}

/// A derivative that rounds differently each time: the change of the stages does not become zero, and is compared with
/// the size of the step where the state itself is zero.
#[test]
fn stages_converge_from_the_origin() {
    let mut calls = 0_u32;
    let mut x = [0.0];
    let mut noisy = |_: f64, x: &[f64], rate: &mut [f64]| {
        calls += 1;
        rate[0] = 1.0 + x[0] * x[0] + f64::from(calls % 7) * f64::EPSILON;
        Ok(())
    };
    gauss_legendre(0.0, 0.1, &mut x, &mut noisy).expect("a step");
    assert!((x[0] - 0.1_f64.tan()).abs() < 1e-9 && calls < 100, "{x:?} after {calls} calls");
}

/// A semi-implicit step is its two parts: the positions move with the new rates.
#[test]
fn a_semi_implicit_step_is_its_two_parts() {
    // a position, a rate, three works
    let mut force = |time: f64, x: &[f64], rate: &mut [f64]| {
        rate.copy_from_slice(&[f64::NAN, time - 2.0 * x[0], 1.0, 2.0, 3.0]);
        Ok(())
    };
    let (mut whole, mut parts) = ([1.0, 0.5, 0.0, 0.0, 0.0], [1.0, 0.5, 0.0, 0.0, 0.0]);
    let mut workspace = [f64::NAN; 5];
    let mut euler = SemiImplicitEuler::new(&mut workspace);
    euler.step(3.0, 0.25, &mut whole, &mut force).expect("a step");
    euler.update_rates(3.0, 0.25, &mut parts, &mut force).expect("rates");
    assert_eq!(parts, [1.0, 0.75, 0.25, 0.5, 0.75]);
    SemiImplicitEuler::update_positions(0.25, &mut parts).expect("positions");
    assert_eq!((whole, whole[0]), (parts, 1.1875));
}

/// An error of the derivative ends an adaptive step, at its start or later, and is the one that is returned.
#[test]
fn errors_of_a_derivative_are_returned() {
    for last in [-1.0, 0.3] {
        let mut calls_after = 0;
        let mut failing = |time: f64, x: &[f64], rate: &mut [f64]| {
            rate.copy_from_slice(x);
            if time <= last {
                return Ok(());
            }
            calls_after += 1;
            Err(Error::StateVector { found: 7 })
        };
        let mut solver = Adaptive::new(1e-9);
        let mut x = [1.0];
        let mut reached = solver.start(0.0, 1.0, &[1.0], &mut failing).map(|()| 0.0);
        while let Ok(from @ ..1.0) = reached {
            reached = solver.advance([from, 1.0], &mut x, &mut failing);
        }
        assert_eq!(reached, Err(Error::StateVector { found: 7 }), "{last}");
        assert_eq!(calls_after, 1, "the derivative is not asked again");
    }
}

/// Torques that depend on time and state, and one on the base; none for rates that are not finite.
struct Swaying {
    base: Option<BaseTorque<f64>>,
}

impl<M: dynamics::Model<f64> + ?Sized> Control<f64, M> for Swaying {
    fn joint_torques(&mut self, time: f64, _: &M, state: &State<'_, f64>, torques: &mut [f64]) -> Result<(), Error> {
        for (torque, (angle, rate)) in torques.iter_mut().zip(state.joint_angles.iter().zip(state.joint_rates)) {
            if !rate.is_finite() {
                return Err(Error::NotFinite { quantity: "rates of the law", index: 0, value: *rate });
            }
            *torque = time.cos() - 3.0 * angle - 0.5 * rate;
        }
        Ok(())
    }

    fn base_torque(&self) -> Option<BaseTorque<f64>> {
        self.base
    }
}

/// With and without a base torque and a free body; the first numbers are zeros of both signs.
#[test]
fn a_step_of_a_robot_has_the_bits_of_a_step() {
    let model = Model::<f64>::default();
    let torque = Some(BaseTorque { torque: 2.5, saturated: false });
    for (bodies, base) in [(0, None), (0, torque), (1, None), (1, torque)] {
        let length = vector_length(JOINTS) + 6 * bodies;
        let mut x: Vec<f64> = (0_u32..).map(|k| (f64::from(k) * 0.7).sin()).take(length).collect();
        (x[0], x[1], x[length / 2]) = (-0.0, 0.0, -0.0);
        let (mut expected, mut torques) = (x.clone(), [[f64::NAN; JOINTS]; 2]);
        let (mut workspace, mut other) = (vec![f64::NAN; 3 * length], vec![f64::NAN; 3 * length]);
        for step in 0..20 {
            let time = 0.01 * f64::from(step);
            let (mut law, [of_step, of_robot]) = (Swaying { base }, torques.each_mut());
            let mut robot = RungeKutta4::new(&mut workspace).expect("a workspace");
            robot.robot_step(&model, &mut law, time, 0.01, &mut x, of_robot).expect("a regular state");
            let mut general = RungeKutta4::new(&mut other).expect("a workspace");
            let slopes = |t, x: &[f64], rate: &mut [f64]| derivative(&model, &mut law, t, x, rate, of_step);
            general.step(time, 0.01, &mut expected, slopes).expect("a regular state");
        }
        let bits = |x: &[f64]| x.iter().map(|number| number.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&x), bits(&expected));
        assert_eq!(torques[0], torques[1]);
        let (before, mut short) = (x.clone(), RungeKutta4::new(&mut other[3..]).expect("another length"));
        assert!(short.robot_step(&model, &mut Swaying { base }, 0.0, 0.01, &mut x, &mut torques[0]).is_err());
        assert_eq!(x, before);
    }
}

/// A number that is not finite, a step that overflows, or a base of negative inertia, for which the arms make up in some poses: a
/// step of a robot has the error of a step, whichever stage it is from, or its numbers.
#[test]
fn a_step_of_a_robot_has_the_error_of_a_step() {
    const LENGTH: usize = vector_length(JOINTS);
    let with_base_inertia = |base_inertia| Model::<f64>::new(Parameters { base_inertia, ..Parameters::default() });
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let states = (0..600).map(|_| std::array::from_fn(|_| random.random_range(-3.0..3.0)));
    let regular = Model::<f64>::default();
    let mut cases: Vec<(Model<f64>, f64, [f64; LENGTH])> = Vec::new();
    for (k, state) in states.enumerate() {
        cases.push((with_base_inertia([-4.0, -5.0, -6.0, -8.0][k % 4]), 0.5, state));
        cases.push((regular, [1e3, 1e150, 1e300][k % 3], state));
        let mut with_other = state;
        with_other[k % LENGTH] = [f64::NAN, f64::INFINITY, -1e308][k % 3];
        cases.push((regular, 1e-2, with_other));
        // a place that is beyond the largest number in the middle of a step
        let mut far = state;
        (far[1], far[JOINTS + 4]) = (1.7e308, 1e308);
        cases.push((regular, [0.1, 0.2, 0.5][k % 3], far));
    }
    let (mut done, mut singular, mut not_finite) = (0, 0, 0);
    for (model, step, start) in cases {
        let [mut found, mut expected] = [start; 2];
        let [mut of_robot, mut of_step] = [[0.0; JOINTS]; 2];
        let (mut law, mut workspace) = (Swaying { base: None }, [f64::NAN; 3 * LENGTH]);
        let mut integrator = RungeKutta4::new(&mut workspace).expect("a workspace");
        let result = integrator.robot_step(&model, &mut law, 0.3, step, &mut found, &mut of_robot);
        let slopes = |t, x: &[f64], rate: &mut [f64]| derivative(&model, &mut law, t, x, rate, &mut of_step);
        let general = integrator.step(0.3, step, &mut expected, slopes);
        // the errors have numbers that may be NaN
        assert_eq!(format!("{result:?}"), format!("{general:?}"), "{step} s from {start:?}");
        assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{step} s from {start:?}");
        match result {
            Ok(()) => done += 1,
            Err(Error::Singular { .. }) => singular += 1,
            Err(_) => not_finite += 1,
        }
    }
    assert!(done > 99 && singular > 9 && not_finite > 99, "{done} {singular} {not_finite}");
}
