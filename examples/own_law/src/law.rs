//! The laws of the approach and of the motion after the capture.

use crate::encoder::{Encoders, Measured};
use planar_capture::control::{EstimatedState, ProportionalDerivative};
use planar_capture::format::NumberRule;
use planar_capture::laws::{
    LawConstructor, PostCaptureLaw, PostCaptureTask, RegisteredLaw, Run, TrackingLaw, TrackingTask,
};
use planar_capture::scenario::{LawFormat, LawNumber};
use planar_capture::simulate::{Phase, PhaseError};
use planar_capture::trajectory::ConstantSetpoint;

/// The name of the first in scenarios, the keys of their `[approach.law]`, and how it is made of these.
pub const ENCODER_CONTROL: RegisteredLaw = RegisteredLaw {
    format: LawFormat {
        name: "encoder_control",
        doc: "PD control of the joints by encoders that are late by a sample and noisy",
        numbers: &[
            RESOLUTION,
            number("proportional_gain", NumberRule::non_negative("a proportional gain", "N m/rad"), 49.0),
            number("derivative_gain", NumberRule::non_negative("a derivative gain", "N m s/rad"), 14.0),
            FILTER_TIME,
        ],
    },
    make: LawConstructor::Tracking(|numbers| {
        Box::new(EncoderControl {
            encoders: Encoders { resolution: numbers["resolution"], delay: 1, seed: 2017 },
            proportional_gain: numbers["proportional_gain"],
            derivative_gain: numbers["derivative_gain"],
            filter_time: numbers["filter_time"],
        })
    }),
};

/// The same of the second, whose numbers are in `[post_impact.law]`.
pub const ENCODER_DAMPING: RegisteredLaw = RegisteredLaw {
    format: LawFormat {
        name: "encoder_damping",
        doc: "damping of the joint rates by the same encoders",
        numbers: &[
            RESOLUTION,
            number("derivative_gain", NumberRule::non_negative("a derivative gain", "N m s/rad"), 7.0),
            FILTER_TIME,
        ],
    },
    make: LawConstructor::PostCapture(|numbers| {
        Box::new(EncoderDamping {
            encoders: Encoders { resolution: numbers["resolution"], delay: 1, seed: 2018 },
            derivative_gain: numbers["derivative_gain"],
            filter_time: numbers["filter_time"],
        })
    }),
};

const RESOLUTION: LawNumber = number("resolution", NumberRule::positive("a resolution of the encoders", "rad"), 1e-4);
const FILTER_TIME: LawNumber =
    number("filter_time", NumberRule::positive("a time constant of the filter of the rates", "s"), 0.05);

const fn number(key: &'static str, rule: NumberRule, default: f64) -> LawNumber {
    LawNumber { key, rule, default: Some(default) }
}

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
        ENCODER_CONTROL.format.name
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

/// Damping of the joint rates by encoders.
#[derive(Clone, Copy, Debug)]
pub struct EncoderDamping {
    /// What is measured.
    pub encoders: Encoders,
    /// Of every joint, N m s/rad.
    pub derivative_gain: f64,
    /// Time constant of the filter of the rates, s.
    pub filter_time: f64,
}

impl PostCaptureLaw for EncoderDamping {
    fn name(&self) -> &'static str {
        ENCODER_DAMPING.format.name
    }

    fn control(&self, task: &PostCaptureTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        let joints = task.model.joints();
        run(&mut EstimatedState {
            estimator: Measured::new(self.encoders, self.filter_time),
            law: ProportionalDerivative {
                trajectory: ConstantSetpoint { angles: task.angles },
                proportional_gain: &vec![0.0; joints],
                derivative_gain: &vec![self.derivative_gain; joints],
            },
        })
    }
}
