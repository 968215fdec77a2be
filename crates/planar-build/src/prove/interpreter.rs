//! A graph computed in `f64` as it stands, without being compiled: what the rendered code will say.

use crate::renderer::json::{list, size, text};
use planar_dynamics::scalar::Scalar;
use serde_json::Value;
use std::collections::HashMap;

/// One result of one function.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The function.
    pub function: String,
    /// Which of its results.
    pub output: String,
    /// Row-major.
    pub values: Vec<f64>,
}

/// Every result of every function, in the graph's order, with the layout's own numbers; `inputs` holds the elements of
/// each input, row-major, by the input's name.
///
/// # Errors
/// A graph that does not follow its own format: where.
pub fn interpret(graph: &Value, inputs: &[(&str, Vec<f64>)]) -> Result<Vec<Found>, String> {
    let mut known = Known::default();
    for input in list(&graph["inputs"])? {
        let name = text(&input["name"])?;
        let values = inputs.iter().find(|(input, _)| *input == name).map(|(_, values)| values);
        let values = values.ok_or_else(|| format!("input `{name}` has no value"))?;
        let element = |i: usize| match list(&input["shape"])?.as_slice() {
            [_] => Ok::<_, String>(format!("{name}[{i}]")),
            [_, columns] => size(columns).map(|n| format!("{name}[{}][{}]", i / n.max(1), i % n.max(1))),
            other => Err(format!("input `{name}` has {} dimensions", other.len())),
        };
        for (i, value) in values.iter().enumerate() {
            known.own.insert(element(i)?, *value);
        }
    }
    for parameter in list(&graph["parameters"])? {
        let default = parameter["default"].as_f64().ok_or("a parameter without a default")?;
        known.set(&parameter["name"], default)?;
    }
    known.run(&graph["constants"]["statements"])?;
    let mut found = Vec::new();
    for family in list(&graph["families"])? {
        let mut of_family = known.inside();
        of_family.run(&family["configuration"]["statements"])?;
        for function in list(&family["functions"])? {
            let mut call = of_family.inside();
            call.run(&function["statements"])?;
            for output in list(&function["outputs"])? {
                let values = list(&output["elements"])?.iter().map(|e| call.get(e)).collect::<Result<_, _>>()?;
                let (function, output) = (text(&function["name"])?.to_owned(), text(&output["name"])?.to_owned());
                found.push(Found { function, output, values });
            }
        }
    }
    Ok(found)
}

/// Names that have a value, in a stage and in those before it.
#[derive(Default)]
struct Known<'a> {
    before: Option<&'a Known<'a>>,
    own: HashMap<String, f64>,
}

impl Known<'_> {
    /// The next stage.
    fn inside(&self) -> Known<'_> {
        Known { before: Some(self), own: HashMap::new() }
    }

    fn find(&self, name: &str) -> Option<f64> {
        self.own.get(name).copied().or_else(|| self.before?.find(name))
    }

    fn set(&mut self, name: &Value, value: f64) -> Result<(), String> {
        self.own.insert(text(name)?.to_owned(), value);
        Ok(())
    }

    fn get(&self, operand: &Value) -> Result<f64, String> {
        match operand.as_f64() {
            Some(number) => Ok(number),
            None => self.find(text(operand)?).ok_or_else(|| format!("{operand} is used before it is known")),
        }
    }

    fn run(&mut self, statements: &Value) -> Result<(), String> {
        for line in list(statements)? {
            let [target, operation, arguments @ ..] = list(line)?.as_slice() else {
                return Err(format!("{line} is not a statement"));
            };
            let arguments = arguments.iter().map(|a| self.get(a)).collect::<Result<Vec<_>, _>>()?;
            let value = match (text(operation)?, arguments.as_slice()) {
                ("add", [a, b]) => a + b,
                ("sub", [a, b]) => a - b,
                ("mul", [a, b]) => a * b,
                ("div", [a, b]) => a / b,
                ("neg", [a]) => -a,
                ("copy", [a]) => *a,
                ("min", [a, b]) => Scalar::minimum(*a, *b),
                ("atan2", [y, x]) => Scalar::atan2(*y, *x),
                ("sqrt", [a]) => Scalar::sqrt(*a),
                ("sin_cos", [angle]) => {
                    let [sine, cosine] = list(target)?.as_slice() else {
                        return Err(format!("{line} has not two results"));
                    };
                    let (s, c) = Scalar::sin_cos(*angle);
                    self.set(sine, s)?;
                    self.set(cosine, c)?;
                    continue;
                }
                (operation, arguments) => {
                    return Err(format!("operation `{operation}` with {} arguments is unknown", arguments.len()));
                }
            };
            self.set(target, value)?;
        }
        Ok(())
    }
}
