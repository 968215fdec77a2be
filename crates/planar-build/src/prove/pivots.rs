//! The smallest pivots of a graph, which say that there is no result.

use crate::format::{FunctionResult, Given, Graph};
use crate::graph::{self, GraphError};
use crate::prove::interpreter::{Arguments, interpret};
use planar_dynamics::manifest::ParameterKind;

const PIVOT: &str = "smallest_pivot";

/// The function whose matrix has the size of the joints.
const OF_JOINTS: &str = "reduced_impact";

/// Inputs that enter the system of equations of a function that has them.
const ENTERING: [&str; 4] = ["joint_angles", "target_masses", "target_inertias", "contacts"];

/// The input of functions whose equations have the places of end effectors.
const OF_AN_IMPACT: &str = "target_masses";

/// Checks that pivots are positive at a regular state, and no numbers where a parameter or an input that enters the
/// equations is none. The lengths of last links enter those of impacts alone.
///
/// # Errors
/// [`GraphError::Format`]: which function, and what it does not show.
pub fn check(graph: &Graph, arguments: Arguments<'_>) -> Result<(), GraphError> {
    let wrong = |function: &str, what: &str| Err(GraphError::Format(format!("`{PIVOT}` of `{function}` {what}")));
    for found in pivots(graph, arguments)? {
        let pivot = found.values.first().copied().unwrap_or(f64::NAN);
        if !(pivot > 0.0 && pivot <= 1.0 + 1e-9) {
            return wrong(
                &found.function,
                &format!("is {pivot:e} at a regular state, expected more than 0 and 1 at most"),
            );
        }
    }
    let structure = graph::structure(graph)?;
    // relative to itself the one element of a matrix is 1, whatever it is: then results alone show it
    let is_shown = |function: &str| function != OF_JOINTS || structure.links.iter().sum::<usize>() > 1;
    for (place, (kind, arm, link)) in structure.parameters.iter().enumerate() {
        let mut parameters = arguments.parameters.to_vec();
        parameters[place] = f64::NAN;
        let is_end = *kind == ParameterKind::LinkLength && link + 1 == structure.links[*arm];
        for found in pivots(graph, Arguments { parameters: &parameters, ..arguments })? {
            let shows = is_shown(&found.function)
                && (!is_end || inputs(graph, &found.function).any(|input| input == OF_AN_IMPACT));
            if shows && !found.values.iter().all(|pivot| pivot.is_nan()) {
                let name = &graph.parameters[place].name;
                return wrong(&found.function, &format!("does not show that the parameter `{name}` is not a number"));
            }
        }
    }
    for (place, given) in
        arguments.inputs.iter().enumerate().filter(|(_, given)| ENTERING.contains(&given.name.as_str()))
    {
        for element in 0..given.values.len() {
            let mut changed: Vec<Given> = arguments.inputs.to_vec();
            changed[place].values[element] = f64::NAN;
            for found in pivots(graph, Arguments { inputs: &changed, ..arguments })? {
                let has = inputs(graph, &found.function).any(|input| *input == given.name);
                let shows = has && is_shown(&found.function);
                if shows && !found.values.iter().all(|pivot| pivot.is_nan()) {
                    let what = format!("does not show that `{}[{element}]` is not a number", given.name);
                    return wrong(&found.function, &what);
                }
            }
        }
    }
    Ok(())
}

fn pivots(graph: &Graph, arguments: Arguments<'_>) -> Result<Vec<FunctionResult>, GraphError> {
    let mut found = interpret(graph, arguments).map_err(GraphError::Format)?;
    found.retain(|found| found.output == PIVOT);
    Ok(found)
}

/// The inputs of a function.
fn inputs<'a>(graph: &'a Graph, function: &'a str) -> impl Iterator<Item = &'a String> {
    let functions = graph.families.iter().flat_map(|family| &family.functions);
    functions.filter(move |other| other.name == function).flat_map(|function| &function.inputs)
}
