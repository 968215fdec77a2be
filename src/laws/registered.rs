//! Control laws of a program of one's own, which its scenarios name.

use super::{Laws, PostCaptureLaw, TrackingLaw};
use crate::scenario::{LawFormat, LawNumbers, Scenario};

/// A law that scenarios name, by `tracking = "NAME"` in `[approach]` or `control = "NAME"` in `[post_impact]`; the numbers of
/// the table `law` beside it are handed to its constructor.
///
/// ```
/// use planar_capture::format::NumberRule;
/// use planar_capture::laws::{LawConstructor, RegisteredLaw, Run, TrackingLaw, TrackingTask};
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
///     make: LawConstructor::Tracking(|numbers: &LawNumbers| Box::new(Limp { damping: numbers["damping"] })),
/// };
/// // planar_capture::cli::main_with_laws(&[], &[LIMP])
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RegisteredLaw {
    /// Its name and its numbers.
    pub format: LawFormat,
    /// Makes it of its numbers, all of which keep their rules.
    pub make: LawConstructor,
}

/// Makes a law for one of the phases.
#[derive(Clone, Copy, Debug)]
pub enum LawConstructor {
    /// For the approach: `approach.tracking` names it.
    Tracking(fn(&LawNumbers) -> Box<dyn TrackingLaw>),
    /// For the motion after the capture: `post_impact.control` names it.
    PostCapture(fn(&LawNumbers) -> Box<dyn PostCaptureLaw>),
}

/// The laws of a program's own that a scenario names; `None` where it names a shipped one.
#[derive(Default)]
pub struct NamedLaws {
    tracking: Option<Box<dyn TrackingLaw>>,
    post_capture: Option<Box<dyn PostCaptureLaw>>,
}

impl NamedLaws {
    /// Those that the scenario names, made of its numbers. One that is not among these laws is left out.
    #[must_use]
    pub fn of<'s>(scenario: &'s Scenario, laws: &[RegisteredLaw]) -> Self {
        let mut named = Self::default();
        let [tracking, post_capture] = scenario.own_laws();
        for RegisteredLaw { format, make } in laws {
            let numbers =
                |of: Option<(&str, &'s LawNumbers)>| of.filter(|(name, _)| *name == format.name).map(|(_, n)| n);
            match make {
                LawConstructor::Tracking(make) => named.tracking = numbers(tracking).map(make).or(named.tracking),
                LawConstructor::PostCapture(make) => {
                    named.post_capture = numbers(post_capture).map(make).or(named.post_capture);
                }
            }
        }
        named
    }

    /// To be handed to [`study_with`](crate::capture::study_with).
    #[must_use]
    pub fn laws(&self) -> Laws<'_> {
        Laws { tracking: self.tracking.as_deref(), post_capture: self.post_capture.as_deref() }
    }
}

#[cfg(test)]
mod tests {
    use super::{LawConstructor, NamedLaws, RegisteredLaw};
    use crate::laws::{PostCaptureLaw, PostCaptureTask, Run, TrackingLaw, TrackingTask};
    use crate::scenario::fixture::two_discs;
    use crate::scenario::{LawFormat, LawNumbers, PostCaptureControl, Tracking};
    use crate::simulate::{Phase, PhaseError};

    struct Named(&'static str);

    impl TrackingLaw for Named {
        fn name(&self) -> &'static str {
            self.0
        }

        fn track(&self, _: &TrackingTask<'_>, _: Run<'_>) -> Result<Phase, PhaseError> {
            unreachable!("it only has a name")
        }
    }

    impl PostCaptureLaw for Named {
        fn name(&self) -> &'static str {
            self.0
        }

        fn control(&self, _: &PostCaptureTask<'_>, _: Run<'_>) -> Result<Phase, PhaseError> {
            unreachable!("it only has a name")
        }
    }

    /// Of several laws for a phase that is made which the scenario names for it, in whatever order they are.
    #[test]
    fn the_law_of_each_phase_is_the_named_one() {
        let law = |name, make| RegisteredLaw { format: LawFormat { name, doc: "", numbers: &[] }, make };
        let mut laws = [
            law("one", LawConstructor::Tracking(|_| Box::new(Named("first")))),
            law("two", LawConstructor::Tracking(|_| Box::new(Named("second")))),
            law("one", LawConstructor::PostCapture(|_| Box::new(Named("third")))),
            law("two", LawConstructor::PostCapture(|_| Box::new(Named("fourth")))),
        ];
        let mut scenario = two_discs("duration = 0.5\n");
        let mut check =
            |laws: &[RegisteredLaw], [tracking, control]: [&'static str; 2], expected: [Option<&str>; 2]| {
                let numbers = LawNumbers::default();
                scenario.approach.tracking = Tracking::Own { name: tracking, numbers: numbers.clone() };
                scenario.post_impact.as_mut().expect("a phase").control =
                    PostCaptureControl::Own { name: control, numbers };
                let named = NamedLaws::of(&scenario, laws);
                let found = named.laws();
                let of_phases = [found.tracking.map(TrackingLaw::name), found.post_capture.map(PostCaptureLaw::name)];
                assert_eq!(of_phases, expected, "{tracking} {control}");
            };
        for _ in 0..2 {
            check(&laws, ["one", "two"], [Some("first"), Some("fourth")]);
            check(&laws, ["two", "one"], [Some("second"), Some("third")]);
            check(&laws, ["two", "three"], [Some("second"), None]);
            laws.reverse();
        }
    }
}
