//! One phase in time: fixed Runge–Kutta steps under a control law, audited at every step.

use crate::audit::{Audit, Done, Drift};
use crate::control::Control;
use crate::dynamics::Model;
use crate::error::Error;
use crate::integrate::RungeKutta4;
use crate::limits::Excesses;
use crate::motion::derivative;
use crate::state::{Effort, State, vector_length};

/// Where the robot is and how it moves, owned.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// [yaw, x, y] of the base COM, inertial frame; rad, m.
    pub base_pose: [f64; 3],
    /// rad.
    pub joint_angles: Vec<f64>,
    /// [ω, vx, vy] of the base COM, inertial axes; rad/s, m/s.
    pub base_twist: [f64; 3],
    /// rad/s.
    pub joint_rates: Vec<f64>,
}

impl Motion {
    /// The same, borrowed.
    #[must_use]
    pub fn state(&self) -> State<'_, f64> {
        State {
            base_pose: self.base_pose,
            joint_angles: &self.joint_angles,
            base_twist: self.base_twist,
            joint_rates: &self.joint_rates,
        }
    }

    /// A copy of a view.
    #[must_use]
    pub fn of(state: &State<'_, f64>) -> Self {
        Self {
            base_pose: state.base_pose,
            joint_angles: state.joint_angles.to_vec(),
            base_twist: state.base_twist,
            joint_rates: state.joint_rates.to_vec(),
        }
    }
}

/// Everything that is known of one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Since the start of the phase, s.
    pub time: f64,
    /// Where and how fast.
    pub motion: Motion,
    /// N m.
    pub joint_torques: Vec<f64>,
    /// [yaw, x, y] of each tip; rad, m.
    pub end_effector_poses: Vec<[f64; 3]>,
    /// [ω, vx, vy] of each tip; rad/s, m/s.
    pub end_effector_twists: Vec<[f64; 3]>,
    /// N s, inertial axes.
    pub linear_momentum: [f64; 2],
    /// About the inertial origin, N m s.
    pub angular_momentum: f64,
    /// J.
    pub kinetic_energy: f64,
    /// Work of the joint torques since the start of the phase, J.
    pub work: f64,
    /// On the base, N m; `None` where there is no such actuator.
    pub base_torque: Option<f64>,
    /// Work of the base torque since the start of the phase, J.
    pub base_work: f64,
    /// Angular momentum that the base torque gave the robot since the start of the phase, N m s.
    pub base_impulse: f64,
}

/// How one phase is cut into steps and samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// s.
    pub duration: f64,
    /// Wanted step, s; the nearest that divides the duration is taken.
    pub step: f64,
    /// Time between samples, s, at least one step; the last instant is always sampled.
    pub sample: f64,
}

impl Timing {
    /// Number of steps.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 1e8 steps are read")]
    pub fn steps(&self) -> u64 {
        (self.duration / self.step - 1e-9).ceil().max(1.0) as u64
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "at most 1e8 steps are read"
    )]
    fn stride(&self) -> u64 {
        let step = self.duration / self.steps() as f64;
        (self.sample / step).round().max(1.0) as u64
    }
}

/// A phase that was run.
#[derive(Clone, Debug, PartialEq)]
pub struct Phase {
    /// s.
    pub duration: f64,
    /// The first, one per sampling time, and the last.
    pub samples: Vec<Sample>,
    /// The audit of every step.
    pub drift: Drift,
    /// How long the actuators were at their limits.
    pub saturation: Saturation,
    /// Of a law that inverts the generalized Jacobian: its smallest singular value over its largest, the smallest on the way.
    pub singularity_margin: Option<f64>,
    /// Joints beyond their limits; `None` where there are no limits.
    pub excesses: Option<Excesses>,
}

/// How long actuators were at their limits, by what they gave when each step began.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Saturation {
    /// One per joint, s; empty where the law has no limits.
    pub joints: Vec<f64>,
    /// s; 0 without a base torque.
    pub base: f64,
}

impl Saturation {
    /// Adds a step (s) to what is saturated as it begins.
    fn count(&mut self, control: &dyn Control<f64>, step: f64) {
        let flags = control.saturated();
        self.joints.resize(flags.len(), 0.0);
        for (time, saturated) in self.joints.iter_mut().zip(flags) {
            *time += if *saturated { step } else { 0.0 };
        }
        self.base += if control.base_torque().is_some_and(|base| base.saturated) { step } else { 0.0 };
    }
}

impl Phase {
    /// The last instant.
    #[must_use]
    pub fn end(&self) -> Option<&Sample> {
        self.samples.last()
    }
}

/// Why a phase stopped, and when.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("at t = {time} s: {source} (a shorter step may help)")]
pub struct Stopped {
    /// s, since the start of the phase.
    pub time: f64,
    /// What could not be computed.
    pub source: Error,
}

/// Runs one phase; `tick` is called once per step.
///
/// # Errors
/// The time and the reason where the model or the law has no answer (singular, not finite).
pub fn simulate(
    model: &dyn Model<f64>,
    control: &mut dyn Control<f64>,
    initial: &Motion,
    timing: &Timing,
    tick: &mut dyn FnMut(),
) -> Result<Phase, Stopped> {
    let joints = model.joints();
    let length = vector_length(joints);
    let mut x = vec![0.0; length];
    initial.state().write(&mut x);
    let mut torques = vec![0.0; joints];
    let mut workspace = vec![0.0; 3 * length];
    let at = |time| move |source| Stopped { time, source };
    let wrong_length = Error::Length { quantity: "state vector", expected: length, found: x.len() };
    let mut integrator = RungeKutta4::new(&mut workspace).ok_or(Stopped { time: 0.0, source: wrong_length })?;
    let mut audit = Audit::new(model, &initial.state()).map_err(at(0.0))?;
    let (steps, stride) = (timing.steps(), timing.stride());
    #[allow(clippy::cast_precision_loss, reason = "at most 1e8 steps are read")]
    let time_of = |step: u64| timing.duration * (step as f64 / steps as f64);
    let step = time_of(1);
    let mut samples = Vec::new();
    let mut saturation = Saturation::default();
    for i in 0..=steps {
        let time = time_of(i);
        let state = State::from_vector(&x, joints).ok_or(Stopped { time, source: wrong_length })?;
        let effort = Effort::from_vector(&x).unwrap_or_default();
        let work = effort.joint_work + effort.base_work;
        let done = Done { time, work, impulse: [effort.base_impulse, 0.0, 0.0] };
        let momentum = audit.record(&state, &done).map_err(at(time))?;
        if i < steps {
            control.begin_step(time, model, &state).map_err(at(time))?;
        }
        if i % stride == 0 || i == steps {
            control.joint_torques(time, model, &state, &mut torques).map_err(at(time))?;
            let mut sample = Sample {
                time,
                motion: Motion::of(&state),
                joint_torques: torques.clone(),
                end_effector_poses: vec![[0.0; 3]; model.arms()],
                end_effector_twists: vec![[0.0; 3]; model.arms()],
                linear_momentum: momentum.linear_momentum,
                angular_momentum: momentum.angular_momentum,
                kinetic_energy: momentum.kinetic_energy,
                work: effort.joint_work,
                base_torque: control.base_torque().map(|base| base.torque),
                base_work: effort.base_work,
                base_impulse: effort.base_impulse,
            };
            model
                .end_effector_poses(&state.base_pose, state.joint_angles, &mut sample.end_effector_poses)
                .and_then(|()| model.end_effector_twists(&state, &mut sample.end_effector_twists))
                .map_err(at(time))?;
            samples.push(sample);
        }
        if i < steps {
            let mut first = true;
            integrator
                .step(time, step, &mut x, |t, x, rate| {
                    derivative(model, control, t, x, rate, &mut torques)?;
                    if std::mem::take(&mut first) {
                        saturation.count(control, step);
                    }
                    Ok(())
                })
                .map_err(at(time))?;
            tick();
        }
    }
    Ok(Phase {
        duration: timing.duration,
        samples,
        drift: audit.drift(),
        saturation,
        singularity_margin: None,
        excesses: None,
    })
}
