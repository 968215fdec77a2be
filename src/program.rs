//! What a program has of its own: robots, and the control laws that its scenarios name.
//!
//! # Example
//! ```
//! use planar_capture::laws::RegisteredLaw;
//! use planar_capture::program::Program;
//! use planar_capture::registry::Robots;
//! use planar_capture::scenario::{LawFormat, Scenario, Tracking};
//!
//! const AHEAD: RegisteredLaw = RegisteredLaw {
//!     format: LawFormat { name: "ahead", doc: "torques of inverse dynamics alone", numbers: &[] },
//!     make: |_| Box::new(Tracking::InverseDynamics),
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
//! assert!(RegisteredLaw::of(&scenario, program.laws).is_some_and(|law| law.name() == "exact"));
//! # Ok::<(), planar_capture::diagnostic::Report>(())
//! ```

use crate::laws::RegisteredLaw;
use crate::registry::Robots;
use crate::scenario::{Known, Tracking};

/// What the commands of a program know by name.
#[derive(Clone, Copy, Debug, Default)]
pub struct Program<'a> {
    /// Its robots, and the shipped ones.
    pub robots: Robots<'a>,
    /// Its tracking laws, beside the shipped ones.
    pub laws: &'a [RegisteredLaw],
}

impl Program<'_> {
    /// What its scenarios can name.
    #[must_use]
    pub fn known(self) -> Known<'static> {
        Known { layouts: self.robots.layouts(), laws: self.laws.iter().map(|law| law.format).collect() }
    }

    /// The name of a law that another one has, too, this program's or a shipped one.
    #[must_use]
    pub fn repeated_law(self) -> Option<&'static str> {
        let names: Vec<_> = self.laws.iter().map(|law| law.format.name).collect();
        let is_shipped = |name: &str| Tracking::LAWS.iter().any(|law| law.name() == name);
        let mut each = names.iter().enumerate();
        each.find(|(i, name)| is_shipped(name) || names[..*i].contains(name)).map(|(_, name)| *name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::LawFormat;

    #[test]
    fn a_law_has_a_name_of_its_own() {
        let law = |name| RegisteredLaw {
            format: LawFormat { name, doc: "of a test", numbers: &[] },
            make: |_| unreachable!("no scenario names it"),
        };
        let repeated =
            |names: [&'static str; 2]| Program { laws: &names.map(law), ..Program::default() }.repeated_law();
        assert_eq!(repeated(["mine", "yours"]), None);
        assert_eq!(repeated(["mine", "mine"]), Some("mine"));
        assert_eq!(repeated(["mine", "pd"]), Some("pd"));
    }
}
