//! Trajectories satisfy their end conditions, and their rates are the derivatives of their angles.

use planar_capture::integrate::RungeKutta4;
use planar_capture::scalar::Dual;
use planar_capture::trajectory::{
    ConstantSetpoint, Cycloidal, DesiredJoint, EndEffectorPath, PointToPoint, Quartic, QuarticAsPrinted, Quintic,
    Trajectory, TrajectoryKind, quintic,
};
use planar_proof::{assert_close, tolerance};

const FROM: [f64; 3] = [0.698, -1.5, 0.3];
const TO: [f64; 3] = [-0.524, -1.5, 2.0]; // the second joint does not move
const RATES: [f64; 3] = [0.014, -0.12, 0.09];
const DURATION: f64 = 20.0;

fn motion() -> PointToPoint<'static, f64> {
    PointToPoint { initial_angles: &FROM, final_angles: &TO, duration: DURATION }
}

/// Starts at rest, ends with these rates and without acceleration, and is differentiable in between.
fn check(trajectory: &impl Trajectory<f64>, final_rates: &[f64; 3]) {
    check_from(trajectory, &[0.0; 3], final_rates);
}

fn check_from(trajectory: &impl Trajectory<f64>, initial_rates: &[f64; 3], final_rates: &[f64; 3]) {
    for joint in 0..3 {
        let at = |time| trajectory.joint(joint, time).expect("a joint");
        let (start, end) = (at(0.0), at(DURATION));
        assert_close(
            "start",
            &[start.angle, start.rate, start.acceleration],
            &[FROM[joint], initial_rates[joint], 0.0],
            0.0,
        );
        let found = [end.angle, end.rate, end.acceleration];
        assert_close("end", &found, &[TO[joint], final_rates[joint], 0.0], 10.0 * tolerance::POLYNOMIAL);
        for i in 1..20 {
            let (time, h) = (f64::from(i), 1e-5);
            let (before, now, after) = (at(time - h), at(time), at(time + h));
            let rate = (after.angle - before.angle) / (2.0 * h);
            let acceleration = (after.rate - before.rate) / (2.0 * h);
            let found = [now.rate, now.acceleration];
            assert_close("derivatives", &found, &[rate, acceleration], tolerance::DIFFERENCE_QUOTIENT);
        }
        assert_eq!(at(-1.0), start, "before the start it stands");
        assert_eq!(at(DURATION + 1.0), end, "after the end it stays there");
    }
    assert_eq!(trajectory.joint(3, 0.0), None);
}

/// A trajectory of one's own, which names one joint at a time.
struct OneByOne<R>(R);

impl<R: Trajectory<f64>> Trajectory<f64> for OneByOne<R> {
    fn joint(&self, joint: usize, time: f64) -> Option<DesiredJoint<f64>> {
        self.0.joint(joint, time)
    }
}

/// What joints have in common, computed once, changes no bit; and those that a trajectory lacks are not left out.
#[test]
fn motions_of_all_joints_are_those_of_each() {
    fn check(trajectory: &impl Trajectory<f64>) {
        for time in [-1.0, 0.0, 3.7, 11.0, DURATION, DURATION + 1.0] {
            for count in 0..=3 {
                let mut motions = Vec::new();
                let all = trajectory.each_joint(time, 0..count, |joint, desired| motions.push((joint, desired)));
                assert_eq!(all, Some(()));
                let expected = |joint| (joint, trajectory.joint(joint, time).expect("a joint"));
                assert_eq!(motions, (0..count).map(expected).collect::<Vec<_>>());
            }
            assert_eq!(trajectory.each_joint(time, 0..4, |_, _| ()), None);
        }
    }
    for kind in TrajectoryKind::ALL {
        let trajectory = kind.trajectory(motion(), &[0.1, 0.03, -0.2], &RATES);
        check(&trajectory);
        check(&OneByOne(trajectory));
    }
    check(&ConstantSetpoint { angles: &FROM });
    // initial and final angles, or rates, of fewer joints
    let long = [1.0; 4];
    for initial_angles in [&FROM[..], &long] {
        for final_angles in [&TO[..], &long] {
            for final_rates in [&RATES[..], &long] {
                if [initial_angles, final_angles, final_rates] != [&long; 3] {
                    let motion = PointToPoint { initial_angles, final_angles, duration: DURATION };
                    check(&Quartic { motion, final_rates });
                    check(&Quintic { motion, initial_rates: &long, final_rates });
                    check(&Quintic { motion, initial_rates: final_rates, final_rates: &long });
                }
            }
        }
    }
}

#[test]
fn quartic_reaches_its_end_rates() {
    check(&Quartic { motion: motion(), final_rates: &RATES }, &RATES);
}

/// The printed eq. (7) reaches θ̇(T)/T.
#[test]
fn printed_quartic_reaches_a_twentieth() {
    check(&QuarticAsPrinted { motion: motion(), final_rates: &RATES }, &RATES.map(|rate| rate / DURATION));
}

#[test]
fn cycloidal_ends_at_rest() {
    check(&Cycloidal { motion: motion() }, &[0.0; 3]);
}

/// After its end, at which 2π rounded has a sine, a motion is held without any acceleration, which a law that follows it exactly
/// would integrate twice.
#[test]
fn held_ends_have_no_acceleration() {
    let rest = [0.0; 3];
    let (cycloidal, quintic) =
        (Cycloidal { motion: motion() }, Quintic { motion: motion(), initial_rates: &rest, final_rates: &rest });
    for joint in 0..3 {
        for time in [DURATION, DURATION + 1e-9, 3.0 * DURATION] {
            for held in [cycloidal.joint(joint, time), quintic.joint(joint, time)] {
                let held = held.expect("a joint");
                assert_close("at rest", &[held.rate, held.acceleration], &[0.0; 2], 0.0);
            }
        }
    }
}

#[test]
fn quintic_goes_from_its_first_rates_to_its_last() {
    let initial_rates = [0.1, 0.03, -0.2];
    check_from(
        &Quintic { motion: motion(), initial_rates: &initial_rates, final_rates: &RATES },
        &initial_rates,
        &RATES,
    );
}

/// From rest, the quintic and eq. (6) satisfy the same six conditions.
#[test]
fn quintic_from_rest_is_eq_6() {
    let quartic = Quartic { motion: motion(), final_rates: &RATES };
    let quintic = Quintic { motion: motion(), initial_rates: &[0.0; 3], final_rates: &RATES };
    for (joint, i) in (0..3).flat_map(|joint| (0..=10).map(move |i| (joint, i))) {
        let time = f64::from(i) * DURATION / 10.0;
        let [a, b] = [quartic.joint(joint, time), quintic.joint(joint, time)].map(|d| d.expect("a joint"));
        let values = |d: DesiredJoint<f64>| [d.angle, d.rate, d.acceleration];
        assert_close("eq. (6)", &values(a), &values(b), tolerance::POLYNOMIAL);
    }
}

/// Rate and acceleration are the derivatives of angle and rate, to rounding.
#[test]
fn dual_numbers_differentiate_the_quintic() {
    let c = |x: f64| Dual(x, 0.0);
    for i in 0..=20 {
        let tau = Dual(f64::from(i) / 20.0, 1.0 / DURATION);
        let found = quintic([c(0.698), c(-0.524)], [c(0.1), c(-0.2)], c(DURATION), tau);
        assert_close("rate", &[found.rate.0], &[found.angle.1], tolerance::DUAL);
        assert_close("acceleration", &[found.acceleration.0], &[found.rate.1], tolerance::DUAL);
    }
}

/// Eqs. (6) and (7) letter by letter, with the dimensionless s and with the printed one.
#[test]
fn quartic_is_the_polynomial_of_eq_6() {
    for joint in [0, 2] {
        let change = TO[joint] - FROM[joint];
        let literal = |s: f64, tau: f64| {
            let (a, b, c) = (3.0 * (-4.0 * s + 10.0), 4.0 * (7.0 * s - 15.0), 5.0 * (-3.0 * s + 6.0));
            change / DURATION * (a * tau.powi(2) + b * tau.powi(3) + c * tau.powi(4))
        };
        for i in 0..=10 {
            let tau = f64::from(i) / 10.0;
            let corrected = literal(DURATION * RATES[joint] / change, tau);
            let printed = literal(RATES[joint] / change, tau);
            let time = tau * DURATION;
            let rate = |found: Option<DesiredJoint<f64>>| found.expect("a joint").rate;
            let quartic = rate(Quartic { motion: motion(), final_rates: &RATES }.joint(joint, time));
            let as_printed = rate(QuarticAsPrinted { motion: motion(), final_rates: &RATES }.joint(joint, time));
            assert_close("eq. (6)", &[quartic, as_printed], &[corrected, printed], 10.0 * tolerance::POLYNOMIAL);
        }
    }
}

/// Halving the step of a fourth-order method divides the error by sixteen.
#[test]
fn runge_kutta_has_order_four() {
    let error = |steps: u32| {
        let mut workspace = [0.0; 6];
        let mut integrator = RungeKutta4::new(&mut workspace).expect("a workspace for two");
        let mut x = [1.0_f64, 0.0];
        let h = 2.0 / f64::from(steps);
        for i in 0..steps {
            let f = |t: f64, x: &[f64], rate: &mut [f64]| {
                rate[0] = x[1];
                rate[1] = -x[0] * (1.0 + 0.1 * t); // an Airy-like oscillator that depends on time
                Ok(())
            };
            integrator.step(f64::from(i) * h, h, &mut x, f).expect("a step");
        }
        x[0]
    };
    let (coarse, fine, finest) = (error(20), error(40), error(80));
    let order = ((coarse - fine) / (fine - finest)).abs().log2();
    assert!((order - 4.0).abs() < 0.15, "observed order {order}");
}

/// Each component of an end effector path is that polynomial, and is constant after its end.
#[test]
fn end_effector_paths_are_quintics() {
    let (twists, start) = ([[0.1, -0.2, 0.3]; 2], [[-0.1, 0.0, 0.2]; 2]);
    let path = EndEffectorPath {
        initial_poses: &[TO, FROM],
        initial_twists: &start,
        final_poses: &[FROM, TO],
        final_twists: &twists,
        duration: DURATION,
    };
    for i in -1..=21 {
        let time = f64::from(i);
        let found = path.end_effector(1, time).expect("a tip");
        for part in 0..3 {
            let tau = (time / DURATION).clamp(0.0, 1.0);
            let expected = quintic([FROM[part], TO[part]], [start[1][part], twists[1][part]], DURATION, tau);
            let found = [found.pose[part], found.twist[part], found.acceleration[part]];
            assert_close("tip", &found, &[expected.angle, expected.rate, expected.acceleration], 0.0);
        }
    }
    assert_eq!(path.end_effector(2, 0.0), None);
}
