//! Warnings about gains: joints too stiff for the time step or for the sample time.

use super::number::short;
use super::pose::reduced;
use super::warning;
use crate::diagnostic::Warning;
use crate::scenario::{PostCaptureControl, Scenario, Tracking};
use nalgebra::{Cholesky, DMatrix, DVector};

/// Longest step, in times of the fastest mode. The paper's study fails its audit from 0.3 on; beyond 2.8 Runge–Kutta
/// steps of fourth order are unstable.
const MAX_STEP: f64 = 0.5;
/// The recommended step, in times of the fastest mode: it keeps well within the audit's bounds.
const RECOMMENDED_STEP: f64 = 0.2;

pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    let of_law = |law: &ClosedLoop| {
        // adaptive steps are as short as the motion needs
        let step = law.long_step().filter(|_| !law.is_adaptive);
        step.into_iter().chain(law.long_sample_time())
    };
    closed_loops(scenario).iter().flat_map(of_law).collect()
}

/// What helps where a phase, `approach` or `post_impact`, breaks down: for gains that are too high for its step or its
/// sample time, what they and the robot's inertia make of the joints, and what would do.
pub(super) fn help_with_gains(scenario: &Scenario, phase: &str) -> Option<String> {
    let law = closed_loops(scenario).into_iter().find(|law| law.phase == phase)?;
    let Warning { why, help, .. } = law.long_step().or_else(|| law.long_sample_time())?;
    let remedy = format!("{why}: {help}");
    Some(match &scenario.approach.tracking {
        Tracking::ProportionalDerivative { proportional_gain, derivative_gain } if phase == "approach" => {
            let [stiffness, damping] = [proportional_gain, derivative_gain].map(|gains| short(largest(gains)));
            format!(
                "{remedy} than `proportional_gain` = {stiffness} N m/rad and `derivative_gain` = {damping} N m s/rad; or \
                 `tracking = \"computed_torque\"`, whose gains are in 1/s² and 1/s, for a robot of any size"
            )
        }
        _ => remedy,
    })
}

fn closed_loops(scenario: &Scenario) -> Vec<ClosedLoop> {
    let Scenario { approach, .. } = scenario;
    let before = fastest_mode(scenario).map(|rate| ClosedLoop {
        phase: "approach",
        step: approach.step,
        steps_per_sample: approach.actuation.steps_per_sample,
        is_adaptive: approach.integration.integrator.properties().is_adaptive,
        rate,
    });
    let after = scenario.post_impact.as_ref().and_then(|after| {
        let (step, steps_per_sample) = (after.step, after.actuation.steps_per_sample);
        let is_adaptive = after.integration.integrator.properties().is_adaptive;
        let rate = fastest_mode_afterwards(scenario)?;
        Some(ClosedLoop { phase: "post_impact", step, steps_per_sample, is_adaptive, rate })
    });
    before.into_iter().chain(after).collect()
}

/// The rate of the fastest mode of the joints under the tracking law, 1/s. Under computed torque, and resolved motion
/// rate control away from singular poses, the gains give it. Under PD control it is that of
///
/// `I θ̈ = −Kd θ̇ − Kp θ` with the generalized inertia I at the initial or the final pose: the largest of the damping
/// rates, eigenvalues of I⁻¹ Kd, and the natural frequencies, square roots of those of I⁻¹ Kp.
pub(super) fn fastest_mode(scenario: &Scenario) -> Option<f64> {
    let (proportional_gain, derivative_gain) = match &scenario.approach.tracking {
        Tracking::InverseDynamics | Tracking::Own { .. } => return None,
        Tracking::ResolvedMotionRate { pose_gain, rate_gain, .. } => return Some(pose_gain.max(*rate_gain)),
        Tracking::ProportionalDerivative { proportional_gain, derivative_gain } => (proportional_gain, derivative_gain),
        Tracking::ComputedTorque { proportional_gain, derivative_gain } => {
            return Some(largest(derivative_gain).max(largest(proportional_gain).sqrt()));
        }
    };
    let poses = [&scenario.initial.joint_angles, &scenario.approach.final_joint_angles];
    poses.into_iter().filter_map(|angles| mode(scenario, angles, proportional_gain, derivative_gain)).reduce(f64::max)
}

/// The same after the impact, at the final joint angles: the rate of the robot alone, an upper bound for robot and
/// targets together, whose kinetic energy ½ θ̇ᵀ I θ̇ is larger for the same joint rates.
pub(super) fn fastest_mode_afterwards(scenario: &Scenario) -> Option<f64> {
    let angles = &scenario.approach.final_joint_angles;
    match &scenario.post_impact.as_ref()?.control {
        PostCaptureControl::None | PostCaptureControl::Own { .. } => None,
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

fn largest(gains: &[f64]) -> f64 {
    gains.iter().copied().fold(0.0, f64::max)
}

/// The fastest mode of PD control at rest in a pose.
fn mode(scenario: &Scenario, angles: &[f64], proportional_gain: &[f64], derivative_gain: &[f64]) -> Option<f64> {
    let (inertia, _) = reduced(&scenario.layout, angles)?;
    let factor = Cholesky::new(inertia)?;
    let damping = largest_eigenvalue(&factor, derivative_gain)?;
    Some(damping.max(largest_eigenvalue(&factor, proportional_gain)?.sqrt()))
}

/// The largest eigenvalue of `I⁻¹ diag(gains)`, with I = L Lᵀ: that of the symmetric `L⁻¹ diag(gains) L⁻ᵀ`.
fn largest_eigenvalue(factor: &Cholesky<f64, nalgebra::Dyn>, gains: &[f64]) -> Option<f64> {
    let half = factor
        .l()
        .solve_lower_triangular(&DMatrix::from_diagonal(&DVector::from_column_slice(gains).map(f64::sqrt)))?;
    let values = half.try_svd(false, false, f64::EPSILON, 1000)?.singular_values;
    Some(values.max().powi(2))
}

/// The joints under the control law of one phase.
struct ClosedLoop {
    phase: &'static str,
    /// s.
    step: f64,
    steps_per_sample: Option<u32>,
    /// Whether `step` is that of audits and rows alone.
    is_adaptive: bool,
    /// Of the fastest mode, 1/s.
    rate: f64,
}

impl ClosedLoop {
    fn long_step(&self) -> Option<Warning> {
        let Self { phase, step, rate, .. } = self;
        (step * rate > MAX_STEP).then(|| {
            if self.is_adaptive {
                let why = format!(
                    "the fastest joint motion under these gains decays or swings within {} s, which adaptive steps cannot \
                     follow to the end",
                    short(1.0 / rate)
                );
                return warning(format!("{phase}.integrator"), why, "use smaller gains");
            }
            let why = format!(
                "a step of {} s, while the fastest joint motion under these gains decays or swings within {} s",
                short(*step),
                short(1.0 / rate)
            );
            let help = format!("a step of {} s or less resolves it; or smaller gains", short(RECOMMENDED_STEP / rate));
            warning(format!("{phase}.step"), why, help)
        })
    }

    fn long_sample_time(&self) -> Option<Warning> {
        let Self { phase, step, rate, .. } = self;
        let sample_time = f64::from(self.steps_per_sample?) * step;
        (sample_time * rate > MAX_STEP && step * rate <= MAX_STEP).then(|| {
            let why = format!(
                "torques are held for {} s, while the fastest joint motion under these gains decays or swings within {} s",
                short(sample_time),
                short(1.0 / rate)
            );
            let longest = short(RECOMMENDED_STEP / rate);
            let help = format!("a sample time of {longest} s or less keeps up with it; or smaller gains");
            warning(format!("{phase}.sample_time"), why, help)
        })
    }
}
