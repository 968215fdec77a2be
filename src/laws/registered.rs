//! Tracking laws of a program of one's own, which its scenarios name.

use super::TrackingLaw;
use crate::scenario::{LawFormat, LawNumbers, Scenario, Tracking};

/// A law that scenarios name by `tracking = "NAME"`; numbers of their table `[approach.law]` are handed to its constructor.
///
/// ```
/// use planar_capture::format::NumberRule;
/// use planar_capture::laws::{RegisteredLaw, Run, TrackingLaw, TrackingTask};
/// use planar_capture::scenario::{LawFormat, LawNumber, LawNumbers};
/// use planar_capture::simulate::{Phase, PhaseError};
///
/// struct Limp {
///     damping: f64,
/// }
///
/// impl TrackingLaw for Limp {
///     fn name(&self) -> &'static str {
///         LIMP.format.name
///     }
///
///     fn track(&self, task: &TrackingTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
///         let joints = task.model.joints();
///         run(&mut planar_capture::control::ProportionalDerivative {
///             trajectory: task.trajectory,
///             proportional_gain: &vec![0.0; joints],
///             derivative_gain: &vec![self.damping; joints],
///         })
///     }
/// }
///
/// const LIMP: RegisteredLaw = RegisteredLaw {
///     format: LawFormat {
///         name: "limp",
///         doc: "damped rates alone",
///         numbers: &[LawNumber {
///             key: "damping",
///             rule: NumberRule::non_negative("a damping of the rates", "N m s/rad"),
///             default: Some(14.0),
///         }],
///     },
///     make: |numbers: &LawNumbers| Box::new(Limp { damping: numbers["damping"] }),
/// };
/// // planar_capture::cli::main_with_laws(&[], &[LIMP])
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RegisteredLaw {
    /// Its name and its numbers.
    pub format: LawFormat,
    /// Makes it of its numbers, all of which keep their rules.
    pub make: fn(&LawNumbers) -> Box<dyn TrackingLaw>,
}

impl RegisteredLaw {
    /// The law that a scenario names, made of the scenario's numbers; `None` for a shipped one, and for one that is not
    /// among these.
    #[must_use]
    pub fn of(scenario: &Scenario, laws: &[Self]) -> Option<Box<dyn TrackingLaw>> {
        let Tracking::Own { name, numbers } = &scenario.approach.tracking else { return None };
        laws.iter().find(|law| law.format.name == *name).map(|law| (law.make)(numbers))
    }
}
