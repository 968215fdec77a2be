//! The smallest pivots of a graph, which say that there is no result.

use crate::format::{Function, FunctionResult, Given, Graph, PIVOT};
use crate::graph::GraphError;
use crate::prove::interpreter::{Arguments, interpret_loops, interpret_some};
use planar_dynamics::manifest::ParameterKind;
use planar_layout::structure::Structure;

/// Inputs that enter the system of equations of a function that has them.
const ENTERING: [&str; 4] = ["joint_angles", "target_masses", "target_inertias", "contacts"];

/// The input of functions whose equations have the places of end effectors.
const OF_AN_IMPACT: &str = "target_masses";

/// Checks that pivots are positive at a regular state, and no numbers where a parameter or an input that enters the
/// equations is none. The lengths of last links enter those of impacts alone.
///
/// # Errors
/// [`GraphError::Format`]: which function, and what it does not show.
pub fn check(graph: &Graph, structure: &Structure, arguments: Arguments<'_>) -> Result<(), GraphError> {
    for (function, values) in pivots(graph, arguments)? {
        let pivot = values.first().copied().unwrap_or(f64::NAN);
        if !(pivot > 0.0 && pivot <= 1.0 + 1e-9) {
            return wrong(function, &format!("is {pivot:e} at a regular state, expected more than 0 and 1 at most"));
        }
    }
    // relative to itself the one element of a matrix is 1, whatever it is: then results alone show it
    let has_one_joint = structure.links.iter().sum::<usize>() == 1;
    let is_shown = |function: &Function| {
        let is_number = function.pivot().is_some_and(|pivot| pivot.name().is_none());
        !(has_one_joint && is_number)
    };
    for (place, (kind, arm, link)) in structure.parameters.iter().enumerate() {
        let mut parameters = arguments.parameters.to_vec();
        parameters[place] = f64::NAN;
        let is_end = *kind == ParameterKind::LinkLength && link + 1 == structure.links[*arm];
        let shows = |function: &Function| is_shown(function) && (!is_end || has(function, OF_AN_IMPACT));
        let what = format!("the parameter `{}`", graph.parameters[place].name);
        require_shown(graph, Arguments { parameters: &parameters, ..arguments }, &what, &shows)?;
    }
    let entering = |(_, given): &(usize, &Given)| ENTERING.contains(&given.name.as_str());
    for (place, given) in arguments.inputs.iter().enumerate().filter(entering) {
        let shows = |function: &Function| is_shown(function) && has(function, &given.name);
        for element in 0..given.values.len() {
            let mut inputs = arguments.inputs.to_vec();
            inputs[place].values[element] = f64::NAN;
            let what = format!("`{}[{element}]`", given.name);
            require_shown(graph, Arguments { inputs: &inputs, ..arguments }, &what, &shows)?;
        }
    }
    Ok(())
}

/// Whether a function has an input.
fn has(function: &Function, input: &str) -> bool {
    function.inputs.iter().any(|name| name == input)
}

/// That the pivots of the functions that are to show it are no numbers, where something is none.
fn require_shown(
    graph: &Graph,
    arguments: Arguments<'_>,
    what: &str,
    shows: &dyn Fn(&Function) -> bool,
) -> Result<(), GraphError> {
    let mut pivots = pivots(graph, arguments)?.into_iter();
    match pivots.find(|(function, values)| shows(function) && !values.iter().all(|pivot| pivot.is_nan())) {
        None => Ok(()),
        Some((function, _)) => wrong(function, &format!("does not show that {what} is not a number")),
    }
}

fn wrong(function: &Function, what: &str) -> Result<(), GraphError> {
    Err(GraphError::Format(format!("`{PIVOT}` of `{}` {what}", function.name)))
}

/// The pivots of every function that has them.
fn pivots<'a>(graph: &'a Graph, arguments: Arguments<'_>) -> Result<Vec<(&'a Function, Vec<f64>)>, GraphError> {
    let scalar = |_: &str, _: usize, value: f64| value;
    let found = interpret_some(graph, arguments, &scalar, &Function::has_pivot).map_err(GraphError::Format)?;
    let in_loops = interpret_loops(graph, arguments).map_err(GraphError::Format)?;
    let pivots = found.into_iter().chain(in_loops).filter(|found| found.output == PIVOT);
    let of_function = |found: FunctionResult| {
        let function = graph.functions().find(|function| function.name == found.function);
        function.map(|function| (function, found.values))
    };
    Ok(pivots.filter_map(of_function).collect())
}
