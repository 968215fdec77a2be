//! Graphs as files: read, and compared with the layout that they were derived from.

pub use crate::format::Graph;

use crate::renderer::camel_case;
use planar_layout::layout::Layout;
use serde::Deserialize;
use serde_json::Value;
use std::fmt::Debug;

/// The format of the graphs that are read.
const FORMAT: u64 = 2;

/// Why a graph cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GraphError {
    /// It is not of the format, or does not follow it.
    #[error("{0}")]
    Format(String),
    /// It was derived from another layout.
    #[error("it is stale: it was derived from a layout with sha256 {found}, the layout has {wanted}")]
    Stale {
        /// The graph's.
        found: String,
        /// The layout's.
        wanted: String,
    },
    /// It has the layout's hash, but another name, arm or number.
    #[error("{what} is {found}, the layout has {wanted}")]
    Differs {
        /// What differs.
        what: String,
        /// The graph's.
        found: String,
        /// The layout's.
        wanted: String,
    },
}

/// Parses a graph and compares it with a layout: hash, names, number of links and the defaults of all parameters.
///
/// # Errors
/// [`GraphError`].
pub fn read(text: &str, layout: &Layout) -> Result<Graph, GraphError> {
    let Header { format } = parse(text)?;
    if format != FORMAT {
        return Err(GraphError::Format(format!("it has format {format}, this version reads format {FORMAT}")));
    }
    let graph: Graph = parse(text)?;
    let (found, wanted) = (&graph.layout.sha256, layout.sha256());
    if *found != wanted {
        return Err(GraphError::Stale { found: found.clone(), wanted });
    }
    equal("name", &graph.layout.name, &layout.name)?;
    let found: Vec<_> = graph.layout.arms.iter().map(|arm| (&arm.name, arm.links)).collect();
    equal("arms", &found, &layout.arms.iter().map(|arm| (&arm.name, arm.links.len())).collect())?;
    for function in graph.families.iter().flat_map(|family| &family.functions) {
        let declared = |name: &&String| graph.inputs.iter().any(|input| input.name == **name);
        if let Some(input) = function.inputs.iter().find(|name| !declared(name)) {
            return Err(GraphError::Format(format!("input `{input}` of `{}` is not declared", function.name)));
        }
        if function.outputs.is_empty() {
            return Err(GraphError::Format(format!("`{}` has no output", function.name)));
        }
    }
    let parameters = layout.parameters();
    for parameter in &graph.parameters {
        let (name, kind) = (&parameter.name, camel_case(&parameter.quantity));
        let place = (parameter.arm.unwrap_or(0), parameter.link.unwrap_or(0));
        let value = parameters.iter().find(|(k, a, l, _)| format!("{k:?}") == kind && (*a, *l) == place);
        let unknown = || GraphError::Format(format!("parameter `{name}` is no parameter of the layout"));
        let (.., value) = value.ok_or_else(unknown)?;
        equal(&format!("the default of `{name}`"), &parameter.default, value)?;
    }
    Ok(graph)
}

/// The part that graphs of every format have.
#[derive(Deserialize)]
struct Header {
    #[serde(default)]
    format: Value,
}

fn parse<'a, T: Deserialize<'a>>(text: &'a str) -> Result<T, GraphError> {
    let problem = |e: serde_json::Error| if e.is_data() { e.to_string() } else { format!("not JSON: {e}") };
    serde_json::from_str(text).map_err(|e| GraphError::Format(problem(e)))
}

fn equal<T: PartialEq + Debug>(what: &str, found: &T, wanted: &T) -> Result<(), GraphError> {
    if found == wanted {
        return Ok(());
    }
    Err(GraphError::Differs { what: what.to_owned(), found: format!("{found:?}"), wanted: format!("{wanted:?}") })
}
