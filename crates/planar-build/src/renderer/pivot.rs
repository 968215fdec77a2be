//! What the pivots of a module in Rust show besides the system that is solved: parameters of which it may be singular where
//! the pivot is not, and inputs that are infinite or none.
//!
//! Pivots inside the arms are bounded by the parameters where masses and moments of inertia are above 0, and are then not
//! among those that a pivot is the smallest of.

use super::input;
use super::syntax::{Place, Syntax};
use crate::format::{Family, Function, Graph, Operand, PIVOT, Variable};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::slice;

/// The constant that is added to every pivot, 0 or NaN, and the method of the parameters that it is computed by.
const REGULARITY: &str = "regularity";

/// The line that computes the constant from the parameters.
pub fn regularity() -> String {
    Syntax::Rust.assignment(REGULARITY, &format!("parameters.{REGULARITY}()"))
}

/// The constant as a field of the model.
pub fn field() -> Value {
    json!({"name": REGULARITY, "description": "NaN where a mass or moment of inertia is 0 or infinite, else 0", "unit": "1"})
}

/// The pivot of a function: the lines that it needs, and its value, with the constant. Where inputs are to show, an element
/// of the results that is not finite makes it no number. There are enough of them that these and the pivot depend on all
/// parameters and inputs that a result does.
pub struct Pivot {
    pub lines: Vec<String>,
    pub value: String,
}

impl Pivot {
    /// Of a function that has one; `text` is that of an element of an output.
    pub fn of(
        graph: &Graph,
        family: &Family,
        function: &Function,
        text: &dyn Fn(&Variable, usize) -> String,
    ) -> Option<Self> {
        let pivot = function.outputs.iter().find(|output| output.name == PIVOT)?;
        let inputs = Inputs::of(graph, family, function);
        let mut covered = inputs.of_elements(&pivot.elements);
        let mut shown = Vec::new();
        for output in function.outputs.iter().rev() {
            for (index, element) in output.elements.iter().enumerate() {
                if covered.extend(&inputs.of_elements(slice::from_ref(element))) {
                    shown.push(text(output, index));
                }
            }
        }
        let (mut system, mut lines) = (text(pivot, 0), Vec::new());
        if !shown.is_empty() {
            let shown = format!("unless_finite({system}, &[{}])", shown.join(", "));
            let either = format!("if SHOWS_INPUTS {{ {shown} }} else {{ {system} }}");
            lines.push(Syntax::Rust.assignment(PIVOT, &either));
            PIVOT.clone_into(&mut system);
        }
        Some(Self { lines, value: format!("{system} + {}", Syntax::Rust.field(Place::Constants, REGULARITY)) })
    }
}

/// A set of parameters and elements of inputs, a bit each.
#[derive(Clone, Default)]
struct Set(Vec<u64>);

impl Set {
    fn of(index: usize) -> Self {
        let mut words = vec![0; index / 64 + 1];
        words[index / 64] = 1 << (index % 64);
        Self(words)
    }

    /// Adds the elements of another; whether there were any that it had not.
    fn extend(&mut self, other: &Self) -> bool {
        self.0.resize(self.0.len().max(other.0.len()), 0);
        let mut has_new = false;
        for (word, more) in self.0.iter_mut().zip(&other.0) {
            has_new |= more & !*word != 0;
            *word |= more;
        }
        has_new
    }
}

/// The parameters and elements of inputs that each value depends on.
struct Inputs(HashMap<String, Set>);

impl Inputs {
    fn of(graph: &Graph, family: &Family, function: &Function) -> Self {
        let inputs = function.inputs.iter().map(|name| input(graph, name));
        let elements = inputs.flat_map(|input| (0..input.shape.iter().product()).map(|index| input.element(index)));
        let names = graph.parameters.iter().map(|parameter| parameter.name.clone()).chain(elements);
        let mut all = Self(names.enumerate().map(|(index, name)| (name, Set::of(index))).collect());
        let stages = [&graph.constants.statements, &family.configuration.statements, &function.statements];
        for statement in stages.into_iter().flatten() {
            let set = all.of_elements([&statement.a, &statement.b]);
            all.0.extend(statement.targets.names().into_iter().map(|name| (name.to_owned(), set.clone())));
        }
        all
    }

    fn of_elements<'a>(&self, operands: impl IntoIterator<Item = &'a Operand>) -> Set {
        let mut union = Set::default();
        operands.into_iter().filter_map(|operand| self.0.get(operand.name()?)).for_each(|set| _ = union.extend(set));
        union
    }
}
