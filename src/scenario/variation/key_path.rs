//! Paths of values that vary: [`find_key`] has their notation.

use crate::format::{Shape, ShapeAt, Step};
use crate::scenario::{KeyFile, find_key};
use std::fmt::{self, Display, Formatter};

/// What no case can have another one of.
const FIXED: [&str; 2] = ["name", "layout"];

/// The path of a single value of a scenario or of its layout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeyPath {
    /// The file that has it.
    pub file: KeyFile,
    /// From that file's root, at least one.
    pub steps: Vec<Step>,
}

impl KeyPath {
    /// Reads a path.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (file, place) = find_key(text).map_err(|error| error.why)?;
        match (place.steps.last(), place.shape) {
            (Some(Step::Key(last)), _) if FIXED.contains(&last.as_str()) => Err(format!("a `{last}` cannot vary")),
            (_, ShapeAt::Whole(shape)) if !shape.is_scalar() => Err(match shape {
                Shape::Table(_) | Shape::Tables(_) | Shape::ByName(..) => {
                    "it is a table, expected `.` and a key in it".to_owned()
                }
                _ => format!("it is {}, expected one element of it: `{text}[0]`", shape.wanted()),
            }),
            _ => match &place.steps[..] {
                [Step::Key(first), _, Step::Key(set), Step::Key(key)] if first == "case" && set == "set" => {
                    Err(format!("what a case sets varies at its own path, expected `{key}`"))
                }
                _ => Ok(Self { file, steps: place.steps }),
            },
        }
    }

    /// The names on it, those of keys and of tables.
    #[must_use]
    pub fn names(&self) -> Vec<&str> {
        let names = self.steps.iter().filter_map(|step| match step {
            Step::Key(name) | Step::Named(name) => Some(name.as_str()),
            Step::Index(_) => None,
        });
        names.collect()
    }
}

impl Display for KeyPath {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut point = "";
        if self.file == KeyFile::Layout {
            f.write_str("layout")?;
            point = ".";
        }
        for step in &self.steps {
            match step {
                Step::Index(_) => write!(f, "{step}")?,
                Step::Key(_) | Step::Named(_) => write!(f, "{point}{step}")?,
            }
            point = ".";
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::KeyPath;

    #[test]
    fn paths_are_read_and_shown() {
        for path in [
            "approach.duration",
            "approach.proportional_gain",
            "target.\"my.t\".mass",
            "layout.arm.arm1.link[0].com[1]",
            "case.a-1.target_twists.x[2]",
        ] {
            assert_eq!(KeyPath::parse(path).expect("a path").to_string(), path);
        }
        assert_eq!(KeyPath::parse("target.'t'.mass").expect("a path").to_string(), "target.t.mass");
    }

    #[test]
    fn paths_that_lead_to_no_single_value_are_refused() {
        for (path, why) in [
            ("", "expected a key"),
            ("approach.dration", "did you mean `approach.duration`?"),
            ("base.mass", "did you mean `layout.base.mass`?"),
            ("name.mass", "which has no keys"),
            ("approach", "it is a table"),
            ("target.t", "it is a table"),
            ("case.c.target_twists", "it is a table"),
            ("initial.joint_angles", "expected one element of it: `initial.joint_angles[0]`"),
            ("initial.base_pose", "expected one element"),
            ("target.t.name", "a `name` cannot vary"),
            ("layout", "a `layout` cannot vary"),
            ("case.c.set.\"layout.base.mass\"", "expected `layout.base.mass`"),
        ] {
            let error = KeyPath::parse(path).expect_err(path);
            assert!(error.contains(why), "{path}: {error}");
        }
    }
}
