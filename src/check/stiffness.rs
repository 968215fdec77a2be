//! Joints too stiff for the time step, or for the sample time: before the impact and after it.

use super::number::short;
use super::pose::reduced;
use crate::diagnostic::Warning;
use crate::scenario::{PostCaptureControl, Scenario, Tracking};
use nalgebra::{Cholesky, DMatrix, DVector};

/// In times of the fastest mode. The audit of the paper's study objects from 0.3 on; beyond 2.8 Runge–Kutta steps of
/// fourth order are unstable.
const COARSE: f64 = 0.5;
/// A step so long keeps the audit's bounds by far.
const FINE: f64 = 0.2;

/// What is odd about gains, steps and sample times.
pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    let Scenario { approach, .. } = scenario;
    let before = fastest_mode(scenario).map(|rate| Held {
        phase: "approach",
        step: approach.step,
        steps_per_sample: approach.actuation.steps_per_sample,
        rate,
    });
    let after = scenario.post_impact.as_ref().and_then(|after| {
        let (step, steps_per_sample) = (after.step, after.actuation.steps_per_sample);
        Some(Held { phase: "post_impact", step, steps_per_sample, rate: fastest_mode_afterwards(scenario)? })
    });
    before.iter().chain(&after).flat_map(|held| [held.coarse(), held.seldom()]).flatten().collect()
}

/// 1/s: how fast the fastest joint motion under the control law goes. Computed torque makes it that of its gains, and
/// so does resolved motion rate control away from singular poses; under PD control it is, at the initial or the final
/// pose, that of
///
/// `I θ̈ = −Kd θ̇ − Kp θ` with the generalized inertia I: the largest of the damping rates, eigenvalues of I⁻¹ Kd, and
/// the natural frequencies, roots of those of I⁻¹ Kp.
pub(super) fn fastest_mode(scenario: &Scenario) -> Option<f64> {
    let (proportional_gain, derivative_gain) = match &scenario.approach.tracking {
        Tracking::Exact => return None,
        Tracking::ResolvedMotionRate { pose_gain, rate_gain, .. } => return Some(pose_gain.max(*rate_gain)),
        Tracking::ProportionalDerivative { proportional_gain, derivative_gain } => (proportional_gain, derivative_gain),
        Tracking::ComputedTorque { proportional_gain, derivative_gain } => {
            let largest = |gains: &[f64]| gains.iter().copied().fold(0.0, f64::max);
            return Some(largest(derivative_gain).max(largest(proportional_gain).sqrt()));
        }
    };
    let poses = [&scenario.initial.joint_angles, &scenario.approach.final_joint_angles];
    poses.into_iter().filter_map(|angles| mode(scenario, angles, proportional_gain, derivative_gain)).reduce(f64::max)
}

/// The same after the impact, at the final joint angles. It is that of the robot alone, which bounds that of robot and
/// targets: with them the kinetic energy of any joint rates, ½ θ̇ᵀ I θ̇ at the best of all base twists, is larger.
pub(super) fn fastest_mode_afterwards(scenario: &Scenario) -> Option<f64> {
    let angles = &scenario.approach.final_joint_angles;
    match &scenario.post_impact.as_ref()?.control {
        PostCaptureControl::None => None,
        PostCaptureControl::Hold { proportional_gain, derivative_gain } => {
            mode(scenario, angles, proportional_gain, derivative_gain)
        }
        PostCaptureControl::Damping { derivative_gain } => {
            mode(scenario, angles, &vec![0.0; derivative_gain.len()], derivative_gain)
        }
        PostCaptureControl::Stabilise { derivative_gain, base_gain, .. } => {
            Some(derivative_gain.iter().copied().fold(*base_gain, f64::max))
        }
    }
}

/// Of PD control at rest in a pose.
fn mode(scenario: &Scenario, angles: &[f64], proportional_gain: &[f64], derivative_gain: &[f64]) -> Option<f64> {
    let (inertia, _) = reduced(&scenario.layout, angles)?;
    let factor = Cholesky::new(inertia)?;
    let damping = largest_eigenvalue(&factor, derivative_gain)?;
    Some(damping.max(largest_eigenvalue(&factor, proportional_gain)?.sqrt()))
}

/// Of `I⁻¹ diag(gains)`, with I = L Lᵀ: the same as of `L⁻¹ diag(gains) L⁻ᵀ`, which is symmetric.
fn largest_eigenvalue(factor: &Cholesky<f64, nalgebra::Dyn>, gains: &[f64]) -> Option<f64> {
    let half = factor
        .l()
        .solve_lower_triangular(&DMatrix::from_diagonal(&DVector::from_column_slice(gains).map(f64::sqrt)))?;
    let values = half.try_svd(false, false, f64::EPSILON, 1000)?.singular_values;
    Some(values.max().powi(2))
}

/// A law in one phase.
struct Held {
    phase: &'static str,
    /// s.
    step: f64,
    steps_per_sample: Option<u32>,
    /// Of the fastest mode, 1/s.
    rate: f64,
}

impl Held {
    fn coarse(&self) -> Option<Warning> {
        let Self { phase, step, rate, .. } = self;
        (step * rate > COARSE).then(|| Warning {
            key: format!("{phase}.step"),
            why: format!(
                "a step of {} s, while the fastest joint motion under these gains decays or swings within {} s",
                short(*step),
                short(1.0 / rate)
            ),
            help: format!("a step of {} s or less resolves it; or smaller gains", short(FINE / rate)),
        })
    }

    /// Torques that are held for longer than the motion that they should steer takes.
    fn seldom(&self) -> Option<Warning> {
        let Self { phase, step, rate, .. } = self;
        let sample_time = f64::from(self.steps_per_sample?) * step;
        (sample_time * rate > COARSE && step * rate <= COARSE).then(|| Warning {
            key: format!("{phase}.sample_time"),
            why: format!(
                "torques are held for {} s, while the fastest joint motion under these gains decays or swings within {} s",
                short(sample_time),
                short(1.0 / rate)
            ),
            help: format!("a sample time of {} s or less keeps up with it; or smaller gains", short(FINE / rate)),
        })
    }
}
