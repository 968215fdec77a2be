//! Single assignments of a stage: every name has one value, before it is used.

use super::text::identifier;
use crate::format::{Operand, Operation, Statement, Targets, Variable};
use planar_layout::diagnostic::excerpt;
use std::collections::{HashMap, HashSet};

/// Names of the rendered code's own, which a value must not hide.
const OWN_NAMES: [&str; 6] = ["parameters", "constants", "model", "configuration", "core", "result"];

/// The names that a stage may use.
pub struct Known<'a> {
    pub names: HashSet<&'a str>,
    pub inputs: Inputs<'a>,
}

/// The inputs of a stage.
pub struct Inputs<'a> {
    /// All that the graph declares.
    pub declared: &'a HashMap<&'a str, &'a Variable>,
    /// Those that the stage has.
    pub names: HashSet<&'a str>,
}

impl<'a> Known<'a> {
    /// Checks the assignments of a stage in their order.
    pub fn assign(&mut self, statements: &'a [Statement]) -> Result<(), String> {
        for statement in statements {
            let Statement { targets, operation, a, b } = statement;
            self.operand(a)?;
            if !operation.is_unary() {
                self.operand(b)?;
            }
            let is_pair = matches!(targets, Targets::SinCos(..));
            if is_pair != matches!(operation, Operation::SinCos) {
                return Err(format!("{operation:?} does not assign `{}`", excerpt(&targets.names().join("`, `"))));
            }
            for name in targets.names() {
                identifier("value", name)?;
                let is_input = self.inputs.declared.contains_key(name);
                if OWN_NAMES.contains(&name) || is_input || !self.names.insert(name) {
                    return Err(format!("`{name}` is assigned, and is another value already"));
                }
            }
        }
        Ok(())
    }

    /// Checks that an operand has a value.
    pub fn operand(&self, operand: &Operand) -> Result<(), String> {
        match operand {
            Operand::Number(number) if number.is_finite() => Ok(()),
            Operand::Number(_) => Err("an operation lacks an operand".to_owned()),
            Operand::Name(name) if self.names.contains(name.as_str()) || self.inputs.have(name) => Ok(()),
            Operand::Name(name) => Err(format!("`{}` is used, and has no value there", excerpt(name))),
        }
    }

    /// Checks that the values that later stages read are there.
    pub fn require(&self, values: &[&str]) -> Result<(), String> {
        let missing = values.iter().find(|name| !self.names.contains(*name));
        missing.map_or(Ok(()), |name| Err(format!("`{}` is read later, and has no value", excerpt(name))))
    }
}

impl Inputs<'_> {
    /// Whether this is an element of one of them, `joint_angles[1]`.
    fn have(&self, element: &str) -> bool {
        let Some((name, places)) = element.split_once('[') else { return false };
        let Some(input) = self.declared.get(name) else { return false };
        let Some(places) = places.strip_suffix(']') else { return false };
        let places: Vec<&str> = places.split("][").collect();
        let is_within = |(place, size): (&&str, &usize)| {
            let number = place.parse::<usize>();
            number.is_ok_and(|number| number < *size && number.to_string() == **place)
        };
        self.names.contains(name) && places.len() == input.shape.len() && places.iter().zip(&input.shape).all(is_within)
    }
}
