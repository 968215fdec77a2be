//! What a program has of its own: robots, and the control laws that its scenarios name.
//!
//! # Example
//! ```
//! use planar_capture::laws::{LawConstructor, NamedLaws, RegisteredLaw, TrackingLaw};
//! use planar_capture::program::Program;
//! use planar_capture::registry::Robots;
//! use planar_capture::scenario::{LawFormat, Scenario, Tracking};
//!
//! const AHEAD: RegisteredLaw = RegisteredLaw {
//!     format: LawFormat { name: "ahead", doc: "torques of inverse dynamics alone", numbers: &[] },
//!     make: LawConstructor::Tracking(|_| Box::new(Tracking::InverseDynamics)),
//! };
//! let program = Program { robots: Robots::SHIPPED, laws: &[AHEAD] };
//! assert_eq!(program.repeated_law(), None);
//! let text = r#"
//! name = "elbow"
//! layout = "single_arm_2r"
//! initial = { joint_angles = [0.0, 0.0] }
//! approach = { duration = 1.0, trajectory = "cycloidal", final_joint_angles = [0.5, -0.5], tracking = "ahead" }
//! "#;
//! let scenario = Scenario::parse(text, "elbow.toml", "".as_ref(), program.known())?;
//! let named = NamedLaws::of(&scenario, program.laws);
//! assert_eq!(named.laws().tracking.map(TrackingLaw::name), Some("exact"));
//! # Ok::<(), planar_capture::diagnostic::Report>(())
//! ```

use crate::laws::{LawConstructor, RegisteredLaw};
use crate::registry::Robots;
use crate::scenario::{Known, LawFormats, PostCaptureControl, Tracking};

/// What the commands of a program know by name.
#[derive(Clone, Copy, Debug, Default)]
pub struct Program<'a> {
    /// Its robots, and the shipped ones.
    pub robots: Robots<'a>,
    /// Its control laws, beside the shipped ones.
    pub laws: &'a [RegisteredLaw],
}

impl Program<'_> {
    /// What its scenarios can name.
    #[must_use]
    pub fn known(self) -> Known<'static> {
        Known { layouts: self.robots.layouts(), laws: self.law_formats() }
    }

    /// Its control laws, by the phase that they control.
    #[must_use]
    pub fn law_formats(self) -> LawFormats {
        let mut formats = LawFormats::default();
        for RegisteredLaw { format, make } in self.laws {
            match make {
                LawConstructor::Tracking(_) => formats.tracking.push(*format),
                LawConstructor::PostCapture(_) => formats.post_capture.push(*format),
            }
        }
        formats
    }

    /// The name of a law that another one of its phase has, too, this program's or a shipped one.
    #[must_use]
    pub fn repeated_law(self) -> Option<&'static str> {
        let LawFormats { tracking, post_capture } = self.law_formats();
        let shipped: Vec<_> = Tracking::LAWS.iter().map(Tracking::name).collect();
        let shipped_after: Vec<_> = PostCaptureControl::LAWS.iter().map(PostCaptureControl::name).collect();
        [(tracking, shipped), (post_capture, shipped_after)].into_iter().find_map(|(own, shipped)| {
            let names: Vec<_> = own.iter().map(|law| law.name).collect();
            let mut each = names.iter().enumerate();
            each.find(|(i, name)| shipped.contains(name) || names[..*i].contains(name)).map(|(_, name)| *name)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::LawFormat;

    #[test]
    fn a_law_has_a_name_of_its_own() {
        let law = |name, make| RegisteredLaw { format: LawFormat { name, doc: "of a test", numbers: &[] }, make };
        let before = |name| law(name, LawConstructor::Tracking(|_| unreachable!("no scenario names it")));
        let after = |name| law(name, LawConstructor::PostCapture(|_| unreachable!("no scenario names it")));
        let repeated = |laws: &[RegisteredLaw]| Program { laws, ..Program::default() }.repeated_law();
        assert_eq!(repeated(&[before("mine"), before("yours")]), None);
        assert_eq!(repeated(&[before("mine"), before("mine")]), Some("mine"));
        assert_eq!(repeated(&[before("mine"), before("pd")]), Some("pd"));
        // phases have names of their own
        assert_eq!(repeated(&[before("mine"), after("mine"), after("pd"), before("hold")]), None);
        assert_eq!(repeated(&[after("mine"), before("yours"), after("mine")]), Some("mine"));
        assert_eq!(repeated(&[after("damping")]), Some("damping"));
    }
}
