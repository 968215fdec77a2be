//! Control laws of a study: those that its scenario names, or one's own in their place, by
//! [`study_with`](crate::capture::study_with).
//!
//! A law is a [`Control`]: the joint torques in a state. [`TrackingLaw`] and [`PostCaptureLaw`]
//! make one for a phase, with its working space and its trajectory: any [`Trajectory`](crate::trajectory::Trajectory) may
//! take the place of the scenario's, and an [`Estimator`](crate::control::Estimator) that of the state.

mod end_effector_feedback;
mod post_capture;
mod registered;
mod tracking;

pub use end_effector_feedback::EndEffectorFeedback;
pub use post_capture::{PostCaptureLaw, PostCaptureTask};
pub use registered::{LawConstructor, NamedLaws, RegisteredLaw};
pub use tracking::{TrackingLaw, TrackingTask};

use crate::control::Control;
use crate::scenario::Scenario;
use crate::simulate::{Phase, PhaseError};

/// Simulates the phase under a law, with the torque limits and the sample time of the scenario around it.
pub type Run<'r> = &'r mut dyn FnMut(&mut dyn Control<f64>) -> Result<Phase, PhaseError>;

/// Laws in place of those that the scenario names.
#[derive(Clone, Copy, Default)]
pub struct Laws<'l> {
    /// Of the approach.
    pub tracking: Option<&'l dyn TrackingLaw>,
    /// Of the motion after the capture.
    pub post_capture: Option<&'l dyn PostCaptureLaw>,
}

/// Laws of a study that is computed about another origin than the inertial one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnLaws<'a> {
    pub laws: Laws<'a>,
    /// As it is given, with positions in the inertial frame.
    pub scenario: &'a Scenario,
    /// [x, y] of the study's origin, m.
    pub origin: [f64; 2],
}

impl std::fmt::Debug for Laws<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names = [self.tracking.map(TrackingLaw::name), self.post_capture.map(PostCaptureLaw::name)];
        f.debug_struct("Laws").field("tracking", &names[0]).field("post_capture", &names[1]).finish()
    }
}
