//! What the renderer relies on in a graph, whoever wrote it: names are identifiers, texts end no comment or literal,
//! shapes fit elements, and every value is assigned once, before it is used.

mod assignments;
mod loops;
mod text;

use crate::format::{Derivative, Family, Function, Graph, Operations, Variable};
use assignments::{Inputs, Known};
use planar_layout::diagnostic::excerpt;
use std::collections::{HashMap, HashSet};
use text::{distinct, identifier, options, text, unit, version};

type Declared<'a> = HashMap<&'a str, &'a Variable>;

/// Largest number of operations that is counted; the renderer adds some of these.
const MOST_OPERATIONS: u64 = 1 << 48;

/// Checks a graph, in time linear in its size.
///
/// # Errors
/// What is wrong with it, with the text as it can be shown.
pub fn check(graph: &Graph) -> Result<(), String> {
    version(&graph.casadi)?;
    options(&graph.options)?;
    for variable in graph.inputs.iter().chain(&graph.constants.values) {
        described(variable)?;
    }
    for input in &graph.inputs {
        size(input)?;
    }
    distinct("input", graph.inputs.iter().map(|input| input.name.as_str()))?;
    for parameter in &graph.parameters {
        identifier("parameter", &parameter.name)?;
        text("description", &parameter.description)?;
        unit(&parameter.unit)?;
    }
    let parameters = distinct("parameter", graph.parameters.iter().map(|parameter| parameter.name.as_str()))?;
    let declared: Declared<'_> = graph.inputs.iter().map(|input| (input.name.as_str(), input)).collect();
    let no_inputs = Inputs { declared: &declared, names: HashSet::new() };
    let mut constants = Known { names: parameters.clone(), inputs: no_inputs };
    constants.assign(&graph.constants.statements)?;
    let values: Vec<&str> = graph.constants.values.iter().map(|constant| constant.name.as_str()).collect();
    constants.require(&values)?;
    counts(&graph.constants.operations)?;
    distinct("family", graph.families.iter().map(|family| family.name.as_str()))?;
    let functions = || graph.functions();
    distinct("function", functions().map(|function| function.name.as_str()))?;
    let before: HashSet<&str> = parameters.iter().copied().chain(values).collect();
    graph.families.iter().try_for_each(|family| check_family(&declared, family, &before))?;
    functions().flat_map(|function| &function.outputs).try_for_each(|output| derivative(graph, output))?;
    self_test(graph)
}

/// What an output is the derivative of: results that there are, and as many of them as its shape has.
fn derivative(graph: &Graph, output: &Variable) -> Result<(), String> {
    let Some(Derivative { function, outputs, by, along }) = &output.derivative else { return Ok(()) };
    let wrong = |what: &str| Err(format!("`{}` is the derivative of {what}", output.name));
    let mut functions = graph.functions();
    let Some(function) = functions.find(|other| other.name == *function) else {
        return wrong(&format!("`{}`, which is no function", excerpt(function)));
    };
    let mut rows: usize = 0;
    for name in outputs {
        let Some(found) = function.outputs.iter().find(|other| other.name == *name && other.derivative.is_none())
        else {
            return wrong(&format!("`{}`, which is no result", excerpt(name)));
        };
        rows = rows.saturating_add(found.elements.len());
    }
    let input = |name: &str| graph.inputs.iter().find(|input| input.name == name);
    let mut columns: usize = 0;
    for name in by {
        let Some(input) = input(name) else { return wrong(&format!("something by `{}`, no input", excerpt(name))) };
        columns = columns.saturating_add(size(input)?);
    }
    for name in along {
        let wanted =
            if name == "parameters" { Some(graph.parameters.len()) } else { input(name).map(size).transpose()? };
        let found = input(&format!("{name}_direction")).map(size).transpose()?;
        if found.is_none() || found != wanted {
            return wrong(&format!("something along `{}`, no direction", excerpt(name)));
        }
    }
    if size(output)? == rows.saturating_mul(columns.max(1)) && (by.is_empty() || along.is_empty()) {
        Ok(())
    } else {
        wrong("another number of elements")
    }
}

fn check_family<'a>(declared: &'a Declared<'a>, family: &'a Family, before: &HashSet<&'a str>) -> Result<(), String> {
    identifier("family", &family.name)?;
    text("description", &family.description)?;
    let stage = &family.configuration;
    sections(&stage.sections)?;
    counts(&stage.operations)?;
    let arguments = HashSet::from(["base_pose", "joint_angles"]);
    let mut known = Known { names: before.clone(), inputs: Inputs { declared, names: arguments } };
    known.assign(&stage.statements)?;
    let values: Vec<&str> = stage.values.iter().map(String::as_str).collect();
    known.require(&values)?;
    distinct("value", values.iter().copied())?;
    let before: HashSet<&str> = before.iter().copied().chain(values).collect();
    family.functions.iter().try_for_each(|function| check_function(declared, function, &before))
}

fn check_function<'a>(
    declared: &'a Declared<'a>,
    function: &'a Function,
    before: &HashSet<&'a str>,
) -> Result<(), String> {
    let Function { name, inputs, outputs, .. } = function;
    identifier("function", name)?;
    text("description", &function.description)?;
    text("equation", &function.equation)?;
    text("source", &function.source)?;
    sections(&function.sections)?;
    counts(&function.operations)?;
    let arguments = distinct("input", inputs.iter().map(String::as_str))?;
    if let Some(missing) = ["base_pose", "joint_angles"].iter().find(|name| !arguments.contains(*name)) {
        return Err(format!("`{name}` has no input `{missing}`"));
    }
    if let Some(input) = inputs.iter().find(|name| !declared.contains_key(name.as_str())) {
        return Err(format!("input `{}` of `{name}` is not declared", excerpt(input)));
    }
    if outputs.is_empty() {
        return Err(format!("`{name}` has no output"));
    }
    let mut known = Known { names: before.clone(), inputs: Inputs { declared, names: arguments } };
    known.assign(&function.statements)?;
    distinct("output", outputs.iter().map(|output| output.name.as_str()))?;
    for output in outputs {
        described(output)?;
        let (size, found) = (size(output)?, output.elements.len());
        if size != found {
            return Err(format!("output `{}` of `{name}` has {found} elements, its shape has {size}", output.name));
        }
        output.elements.iter().try_for_each(|element| known.operand(element))?;
    }
    loops::check(declared, function, &known)
}

/// The reference vectors: of inputs and results that there are.
fn self_test(graph: &Graph) -> Result<(), String> {
    for state in graph.self_test.iter().flatten() {
        let (found, wanted) = (state.parameters.len(), graph.parameters.len());
        if found != wanted {
            return Err(format!("a state of its test has {found} parameters, the graph has {wanted}"));
        }
        let given: Vec<&str> = state.inputs.iter().map(|given| given.name.as_str()).collect();
        if given.len() != graph.inputs.len() {
            return Err("a state of its test has other inputs than the graph".to_owned());
        }
        for (given, input) in state.inputs.iter().zip(&graph.inputs) {
            if given.name != input.name || given.values.len() != size(input)? {
                let (found, wanted) = (excerpt(&given.name), &input.name);
                return Err(format!("a state of its test has `{found}`, expected `{wanted}` with {:?}", input.shape));
            }
        }
        let functions = graph.functions();
        let results = functions.flat_map(|function| function.outputs.iter().map(move |output| (function, output)));
        let is_result = |(function, output): (&str, &str)| {
            let mut results = results.clone();
            results.any(|(f, o)| f.name == function && o.name == output)
        };
        let expected = state.expected.iter().map(|expected| (expected.function.as_str(), expected.output.as_str()));
        if let Some((function, output)) = expected.clone().find(|result| !is_result(*result)) {
            return Err(format!("its test expects `{}` of `{}`: there is none", excerpt(output), excerpt(function)));
        }
        if expected.clone().collect::<HashSet<_>>().len() != expected.count() {
            return Err("its test expects a result twice".to_owned());
        }
    }
    Ok(())
}

fn described(variable: &Variable) -> Result<(), String> {
    identifier("value", &variable.name)?;
    unit(&variable.unit)?;
    text("description", &variable.description)
}

/// Sections in the order of their first statements.
fn sections(sections: &[(String, usize)]) -> Result<(), String> {
    sections.iter().try_for_each(|(name, _)| text("section", name))?;
    if sections.is_sorted_by_key(|(_, start)| start) {
        Ok(())
    } else {
        Err("its sections are not in the order of their statements".to_owned())
    }
}

/// The number of elements of a scalar, a vector or a matrix.
fn size(variable: &Variable) -> Result<usize, String> {
    let shape = &variable.shape;
    let size = shape.iter().try_fold(1_usize, |size, n| size.checked_mul(*n)).filter(|size| *size > 0);
    let size = size.filter(|_| shape.len() <= 2);
    size.ok_or_else(|| format!("`{}` has the shape {shape:?}: expected two positive sizes at most", variable.name))
}

fn counts(operations: &Operations) -> Result<(), String> {
    let too_many = operations.values().find(|count| **count > MOST_OPERATIONS);
    too_many.map_or(Ok(()), |count| Err(format!("it counts {count} operations")))
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::format::{FunctionResult, Given, Graph, ReferenceState};

    #[test]
    fn a_test_that_expects_a_result_twice_is_refused() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen/graphs/single_arm_2r.json");
        let text = std::fs::read_to_string(path).expect("a graph");
        let mut graph: Graph = serde_json::from_str(&text).expect("of its form");
        let inputs = graph.inputs.iter();
        let inputs: Vec<_> = inputs
            .map(|input| Given { name: input.name.clone(), values: vec![0.0; input.shape.iter().product()] })
            .collect();
        let mut results = Vec::new();
        for function in graph.functions() {
            results.extend(function.outputs.iter().map(|output| FunctionResult {
                function: function.name.clone(),
                output: output.name.clone(),
                values: vec![0.0; output.elements.len()],
                sizes: Vec::new(),
            }));
        }
        let parameters = vec![1.0; graph.parameters.len()];
        let state = ReferenceState { parameters, inputs, expected: results, double_alone: None };
        graph.self_test = Some(vec![state.clone()]);
        assert_eq!(check(&graph), Ok(()));
        // in the place of another, so that their number is right
        let mut twice = state.clone();
        *twice.expected.last_mut().expect("results") = state.expected[0].clone();
        graph.self_test = Some(vec![twice]);
        assert_eq!(check(&graph), Err("its test expects a result twice".to_owned()));
        let fewer = ReferenceState { parameters: state.parameters[1..].to_vec(), ..state };
        graph.self_test = Some(vec![fewer]);
        let refused = check(&graph).expect_err("a parameter is missing");
        assert!(refused.contains("parameters, the graph has"), "{refused}");
    }
}
