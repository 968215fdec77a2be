//! Statements of the graph as Rust: how each name is reached from one function's body.

use super::json::{list, names, size, text};
use serde_json::Value;
use std::collections::BTreeSet;

/// Names that are fields of the model.
pub struct Known<'a> {
    pub parameters: BTreeSet<&'a str>,
    pub constants: BTreeSet<&'a str>,
}

impl<'a> Known<'a> {
    pub fn of(graph: &'a Value) -> Result<Self, String> {
        let parameters = names(&graph["parameters"])?.collect();
        let constants = names(&graph["constants"]["values"])?.collect();
        Ok(Self { parameters, constants })
    }
}

/// Statements of a block.
const BLOCK: usize = 500;

/// How a name is reached in one function body.
pub struct Scope<'a> {
    pub known: &'a Known<'a>,
    /// Values of the configuration stage.
    pub staged: BTreeSet<String>,
    /// Whether the constants are fields, not yet locals.
    pub constants: bool,
}

impl Scope<'_> {
    fn operand(&self, operand: &Value) -> Result<String, String> {
        if let Some(number) = operand.as_f64() {
            return Ok(match number {
                0.0 => "T::ZERO".to_owned(),
                1.0 => "T::ONE".to_owned(),
                _ => format!("T::constant({number:?})"),
            });
        }
        let name = text(operand)?;
        Ok(if self.known.parameters.contains(name) {
            format!("parameters.{name}")
        } else if self.constants && self.known.constants.contains(name) {
            format!("constants.{name}")
        } else if self.staged.contains(name) {
            format!("self.{name}")
        } else {
            name.to_owned()
        })
    }

    /// One `let` per statement, in blocks of [`BLOCK`] where there are more. `used` are the names that anybody uses,
    /// `results` those that are used after the statements.
    ///
    /// Each `let` opens a scope inside the one before it; a compiler that follows thousands of them runs out of stack.
    /// The scopes of a block end with it, and only what is used later leaves it.
    pub fn blocks(
        &self,
        lines: &Value,
        used: &BTreeSet<String>,
        results: &BTreeSet<String>,
    ) -> Result<Vec<String>, String> {
        let lines = list(lines)?;
        if lines.len() <= BLOCK {
            return self.statements(lines, used);
        }
        let mut later = results.clone();
        let mut blocks = Vec::new();
        // from the last, so that what is used later is known
        for block in lines.chunks(BLOCK).rev() {
            let leaving: Vec<&str> = block.iter().flat_map(targets).filter(|name| later.contains(*name)).collect();
            let leaving = leaving.join(", ");
            let inside = self.statements(block, used)?.join("\n");
            blocks.push(format!("let [{leaving}] = {{ {inside} [{leaving}] }};"));
            collect_uses(block, &mut later)?;
        }
        blocks.reverse();
        Ok(blocks)
    }

    /// One `let` per statement. A sine or cosine that nobody uses is not bound.
    fn statements(&self, lines: &[Value], used: &BTreeSet<String>) -> Result<Vec<String>, String> {
        lines
            .iter()
            .map(|line| {
                let [target, operation, arguments @ ..] = list(line)?.as_slice() else {
                    return Err(format!("{line} is not a statement"));
                };
                let arguments = arguments.iter().map(|a| self.operand(a)).collect::<Result<Vec<_>, _>>()?;
                let target = match target {
                    Value::Array(pair) => {
                        let bound =
                            |v: &Value| text(v).map(|n| if used.contains(n) { n.to_owned() } else { "_".to_owned() });
                        let bound = pair.iter().map(bound).collect::<Result<Vec<_>, _>>()?;
                        format!("({})", bound.join(", "))
                    }
                    single => text(single)?.to_owned(),
                };
                Ok(format!("let {target} = {};", expression(text(operation)?, &arguments)?))
            })
            .collect()
    }

    /// Elements as a nested array literal of the output's shape.
    pub fn array(&self, output: &Value) -> Result<String, String> {
        let elements = list(&output["elements"])?.iter().map(|e| self.operand(e)).collect::<Result<Vec<_>, _>>()?;
        Ok(match list(&output["shape"])?.as_slice() {
            [] => elements.concat(),
            [_] => format!("[{}]", elements.join(", ")),
            [_, columns, ..] => {
                let rows = elements.chunks(size(columns)?.max(1)).map(|row| format!("[{}]", row.join(", ")));
                format!("[{}]", rows.collect::<Vec<_>>().join(", "))
            }
        })
    }
}

fn expression(operation: &str, arguments: &[String]) -> Result<String, String> {
    Ok(match (operation, arguments) {
        ("add", [a, b]) => format!("{a} + {b}"),
        ("sub", [a, b]) => format!("{a} - {b}"),
        ("mul", [a, b]) => format!("{a} * {b}"),
        ("div", [a, b]) => format!("{a} / {b}"),
        ("neg", [a]) => format!("-{a}"),
        ("copy", [a]) => a.clone(),
        // not as methods: a lint of clippy's follows the receiver of a method with an argument through all its
        // assignments, again at every use, which takes hours for long functions
        ("min", [a, b]) => format!("T::minimum({a}, {b})"),
        ("atan2", [y, x]) => format!("T::atan2({y}, {x})"),
        ("sqrt", [a]) => format!("{a}.sqrt()"),
        ("sin_cos", [a]) => format!("{a}.sin_cos()"),
        _ => return Err(format!("operation `{operation}` with {} arguments is unknown", arguments.len())),
    })
}

/// Binds the model's fields where a body uses them.
pub fn prelude(lines: &[String], path: &str) -> Vec<String> {
    ["parameters", "constants"]
        .iter()
        .filter(|field| lines.iter().any(|line| line.contains(&format!("{field}."))))
        .map(|field| format!("let {field} = &{path}{field};"))
        .collect()
}

/// Names that a statement gives values to.
fn targets(line: &Value) -> Vec<&str> {
    match &line[0] {
        Value::Array(pair) => pair.iter().filter_map(Value::as_str).collect(),
        single => single.as_str().into_iter().collect(),
    }
}

/// Adds the names that statements use.
pub fn collect_uses(lines: &[Value], used: &mut BTreeSet<String>) -> Result<(), String> {
    for line in lines {
        used.extend(list(line)?.iter().skip(2).filter_map(|a| a.as_str().map(str::to_owned)));
    }
    Ok(())
}

pub fn array_type(shape: &Value, scalar: &str) -> Result<String, String> {
    Ok(list(shape)?.iter().rev().fold(scalar.to_owned(), |inner, n| format!("[{inner}; {n}]")))
}

/// `joint_rates` as `JointRates`.
pub fn camel(name: &str) -> String {
    name.split('_')
        .map(|word| {
            let mut letters = word.chars();
            letters.next().map_or_else(String::new, |first| first.to_ascii_uppercase().to_string() + letters.as_str())
        })
        .collect()
}
