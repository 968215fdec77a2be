//! Inputs and results of the own test of a module in C.

use super::super::input;
use super::super::loops;
use super::super::needed::needed;
use crate::format::{Family, Function, Graph, PIVOT, ReferenceState, Statement, Variable};
use serde_json::{Value, json};
use std::collections::HashSet;

/// The tables, and where the results of an impact are in theirs.
pub fn self_test(graph: &Graph, states: &[ReferenceState]) -> Value {
    let numbers = |values: &[f64]| values.iter().map(|number| format!("(real){number:?}")).collect::<Vec<_>>();
    let inputs = graph.inputs.iter().map(|input| {
        let values = states.iter().map(|state| {
            let given = state.inputs.iter().find(|given| given.name == input.name);
            numbers(given.map_or(&[], |given| &given.values))
        });
        json!({
            "name": input.name,
            "length": input.shape.iter().product::<usize>(),
            "values": values.collect::<Vec<_>>(),
        })
    });
    let functions = graph.functions_of_families().map(|(family, function)| {
        let (pivot, stored): (Vec<&Variable>, Vec<&Variable>) = function.outputs.iter().partition(|o| o.name == PIVOT);
        let mut places = Vec::new();
        let mut length = 0;
        for output in &stored {
            places.push(length);
            length += output.elements.len();
        }
        let states = states.iter().map(|state| {
            let expected = |outputs: &[&Variable]| {
                let of = |output: &&Variable| {
                    let mut expected = state.expected.iter();
                    expected.find(|expected| expected.function == function.name && expected.output == output.name)
                };
                let expected: Vec<_> = outputs.iter().filter_map(of).collect();
                let values: Vec<f64> = expected.iter().flat_map(|expected| &expected.values).copied().collect();
                let sizes = expected.iter().flat_map(|expected| &expected.sizes);
                let sizes: Vec<_> = sizes.map(|size| format!("(real){size:.1e}")).collect();
                (numbers(&values), sizes)
            };
            let ((values, sizes), (pivot, of_pivot)) = (expected(&stored), expected(&pivot));
            let pivot = [pivot, of_pivot].concat();
            json!({"values": values, "sizes": sizes, "pivot": pivot})
        });
        json!({
            "name": function.name,
            "inputs": function.inputs,
            "infinite": infinite(graph, family, function),
            "has_pivot": function.has_pivot(),
            // relative to itself, the one element of a matrix is always 1
            "can_be_singular": function.pivot().is_some_and(|pivot| pivot.name().is_some()),
            "places": places,
            "length": length,
            "states": states.collect::<Vec<_>>(),
        })
    });
    let place = |name: &str| {
        let mut functions = graph.functions();
        let outputs = &functions.find(|function| function.name == "full_impact")?.outputs;
        let before = outputs.iter().position(|output| output.name == name)?;
        Some(outputs[..before].iter().map(|output| output.elements.len()).sum::<usize>())
    };
    let impact = || {
        Some(json!({
            "matrix": place("impact_matrix")?,
            "momentum": place("impact_momentum")?,
            "base_twist": place("base_twist_after")?,
            "joint_rates": place("joint_rates_after")?,
        }))
    };
    let functions: Vec<Value> = functions.collect();
    let longest = functions.iter().filter_map(|function| function["length"].as_u64()).max();
    json!({
        "parameters": states.iter().map(|state| numbers(&state.parameters)).collect::<Vec<_>>(),
        "inputs": inputs.collect::<Vec<_>>(),
        "functions": functions,
        "impact": impact(),
        "states": states.len(),
        "longest": longest,
        "longest_input": graph.inputs.iter().map(|input| input.shape.iter().product::<usize>()).max(),
    })
}

/// The inputs of a function, of which each element that results depend on is infinite in one call.
fn infinite(graph: &Graph, family: &Family, function: &Function) -> Value {
    let (configuration, results) = (&family.configuration, loops::names(&function.outputs));
    let stages =
        [(&configuration.sections[..], &configuration.statements[..]), (&function.sections, &function.statements)];
    let (_, statements) = needed(&stages, &results);
    let read: HashSet<&str> = statements.iter().flat_map(Statement::reads).chain(results).collect();
    let inputs = function.inputs.iter().map(|name| {
        let (input, length) = (input(graph, name), input(graph, name).shape.iter().product::<usize>());
        let elements = (0..length).filter(|index| read.contains(input.element(*index).as_str()));
        json!({"name": name, "length": length, "elements": elements.collect::<Vec<_>>()})
    });
    inputs.collect()
}

#[cfg(test)]
mod tests {
    use super::self_test;
    use crate::format::{FunctionResult, Given, Graph, ReferenceState};
    use serde_json::{Value, json};

    /// A graph with one function of one input, which has two results and a pivot.
    fn graph() -> Graph {
        let variable = |name: &str, shape: &[usize], elements: &[&str]| json!({"name": name, "shape": shape, "unit": "", "description": "", "elements": elements});
        let function = json!({
            "name": "f", "description": "", "equation": "", "source": "", "inputs": ["q"], "sections": [], "statements": [],
            "outputs": [variable("smallest_pivot", &[], &["p"]), variable("a", &[2], &["x", "y"]), variable("b", &[1], &["z"])],
            "operations": {},
        });
        let value = json!({
            "casadi": "", "inputs": [variable("q", &[2], &[])], "parameters": [], "self_test": null,
            "layout": {"name": "it", "sha256": "", "needs_distinct_mounts": false, "arms": []},
            "constants": {"statements": [], "values": [], "operations": {}},
            "families": [{"name": "all", "description": "", "functions": [function],
                          "configuration": {"sections": [], "statements": [], "values": [], "operations": {}}}],
        });
        serde_json::from_value(value).expect("a graph")
    }

    fn state(factor: f64) -> ReferenceState {
        let result = |output: &str, values: &[f64], sizes: &[f64]| FunctionResult {
            function: "f".to_owned(),
            output: output.to_owned(),
            values: values.iter().map(|value| factor * value).collect(),
            sizes: sizes.iter().map(|size| factor * size).collect(),
        };
        let inputs = vec![Given { name: "q".to_owned(), values: vec![factor, -0.5] }];
        // in another order than the graph has them
        let expected = vec![
            result("b", &[7.5], &[40.0]),
            result("smallest_pivot", &[0.5], &[8.0]),
            result("a", &[0.25, -3.0], &[2.0, 16.0]),
        ];
        ReferenceState { parameters: vec![3.0 * factor], inputs, expected, double_alone: None }
    }

    /// What the module in C compares with: the values, and the errors that a proof allows, neither more nor less.
    #[test]
    fn tables_have_the_values_and_the_allowed_errors_of_the_proof() {
        let factors = [1.0, 0.125];
        let test = self_test(&graph(), &factors.map(state));
        let numbers = |list: &Value| -> Vec<f64> {
            let texts = list.as_array().expect("a list").iter().map(|text| text.as_str().expect("a text"));
            texts.map(|text| text.strip_prefix("(real)").expect("a cast").parse().expect("a number")).collect()
        };
        let function = &test["functions"][0];
        for (i, factor) in factors.into_iter().enumerate() {
            let times = |list: &[f64]| list.iter().map(|number| factor * number).collect::<Vec<_>>();
            let state = &function["states"][i];
            assert_eq!(numbers(&test["parameters"][i]), [3.0 * factor]);
            assert_eq!(numbers(&test["inputs"][0]["values"][i]), [factor, -0.5]);
            assert_eq!(numbers(&state["values"]), times(&[0.25, -3.0, 7.5]), "in the order of the graph");
            assert_eq!(numbers(&state["sizes"]), times(&[2.0, 16.0, 40.0]));
            assert_eq!(numbers(&state["pivot"]), times(&[0.5, 8.0]), "value and size");
        }
        assert_eq!(
            (&function["places"], &function["length"], &test["longest"]),
            (&json!([0, 2]), &json!(3), &json!(3))
        );
        assert_eq!((&test["states"], &test["impact"]), (&json!(2), &Value::Null));
    }
}
