//! The law of the approach.

use crate::encoder::{Encoders, Measured};
use planar_capture::control::{EstimatedState, ProportionalDerivative};
use planar_capture::laws::{Run, TrackingLaw, TrackingTask};
use planar_capture::simulate::{Phase, PhaseError};

/// PD control of the joints by encoders.
#[derive(Clone, Copy, Debug)]
pub struct EncoderControl {
    /// What is measured.
    pub encoders: Encoders,
    /// Of every joint, N m/rad.
    pub proportional_gain: f64,
    /// Of every joint, N m s/rad.
    pub derivative_gain: f64,
    /// Time constant of the filter of the rates, s.
    pub filter_time: f64,
}

impl TrackingLaw for EncoderControl {
    fn name(&self) -> &'static str {
        "encoder_control"
    }

    fn track(&self, task: &TrackingTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        let joints = task.model.joints();
        run(&mut EstimatedState {
            estimator: Measured::new(self.encoders, self.filter_time),
            law: ProportionalDerivative {
                // any `Trajectory` may stand here
                trajectory: task.trajectory,
                proportional_gain: &vec![self.proportional_gain; joints],
                derivative_gain: &vec![self.derivative_gain; joints],
            },
        })
    }
}
