//! Inputs and results of the own test of a module in C.

use crate::format::{Graph, ReferenceState, Variable};
use serde_json::{Value, json};

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
    let functions = graph.functions();
    let functions = functions.map(|function| {
        let stored: Vec<&Variable> = function.outputs.iter().filter(|o| o.name != "smallest_pivot").collect();
        let mut places = Vec::new();
        let mut length = 0;
        for output in &stored {
            places.push(length);
            length += output.elements.len();
        }
        let states = states.iter().map(|state| {
            let expected = stored.iter().map(|output| {
                let mut expected = state.expected.iter();
                expected.find(|expected| expected.function == function.name && expected.output == output.name)
            });
            let expected: Vec<_> = expected.flatten().collect();
            let values: Vec<f64> = expected.iter().flat_map(|expected| &expected.values).copied().collect();
            let sizes = expected.iter().flat_map(|expected| &expected.sizes);
            json!({
                "values": numbers(&values),
                "sizes": sizes.map(|size| format!("(real){size:.1e}")).collect::<Vec<_>>(),
            })
        });
        json!({
            "name": function.name,
            "inputs": function.inputs,
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
        "inputs": inputs.collect::<Vec<_>>(),
        "functions": functions,
        "impact": impact(),
        "states": states.len(),
        "longest": longest,
    })
}
