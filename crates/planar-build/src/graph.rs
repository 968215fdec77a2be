//! Graphs as files: read, and compared with the layout that they were derived from.
//!
//! # Example
//! ```
//! use planar_build::graph::{GraphError, read, structure};
//! use planar_layout::layout::Layout;
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
//! let layout = Layout::read(format!("{folder}/layouts/dual_arm_3r.toml").as_ref())?;
//! let text = std::fs::read_to_string(format!("{folder}/graphs/dual_arm_3r.json"))?;
//! let graph = structure(&read(&text, &layout)?)?;
//! assert_eq!((graph.links, graph.parameters.len()), (vec![3, 3], 30));
//! // the graph is not that of a heavier base
//! let mut heavier = layout;
//! heavier.base.mass = 600.0;
//! assert!(matches!(read(&text, &heavier), Err(GraphError::Stale { .. })));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use crate::format::Graph;

use crate::format::Parameter;
use crate::renderer::camel_case;
use crate::soundness;
use planar_dynamics::manifest::ParameterKind;
use planar_layout::diagnostic::{excerpt, printable};
use planar_layout::layout::Layout;
use planar_layout::structure::{Mismatch, Structure, parameters};
use serde::Deserialize;
use serde_json::Value;
use std::collections::HashMap;
use std::fmt::Debug;

/// The format of the graphs that are read.
pub const FORMAT: u64 = 3;

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
    /// It was derived from a layout of another structure.
    #[error("it is stale: it was derived from a layout of another structure: {0}")]
    Structure(String),
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

/// Parses a graph and compares it with a layout: hash, names, number of links and the defaults of all parameters. Names
/// in it are identifiers, texts end no comment and no literal, and every value is assigned once, before it is used.
///
/// # Errors
/// [`GraphError`].
pub fn read(text: &str, layout: &Layout) -> Result<Graph, GraphError> {
    let graph = parse_format(text)?;
    let (found, wanted) = (&graph.layout.sha256, layout.sha256());
    if *found != wanted {
        return Err(GraphError::Stale { found: excerpt(found), wanted });
    }
    equal("name", &graph.layout.name, &layout.name)?;
    let found: Vec<_> = graph.layout.arms.iter().map(|arm| (&arm.name, arm.links)).collect();
    equal("arms", &found, &layout.arms.iter().map(|arm| (&arm.name, arm.links.len())).collect())?;
    soundness::check(&graph).map_err(GraphError::Format)?;
    compare_parameters(&graph, layout)?;
    Ok(graph)
}

/// Parses a graph and compares its structure with a layout's, from which it takes names and defaults: what was derived
/// for one layout holds for all of its structure. It is checked as by [`read`].
///
/// # Errors
/// [`GraphError`].
pub(crate) fn read_for(text: &str, layout: &Layout) -> Result<Graph, GraphError> {
    let mut graph = parse_format(text)?;
    let values = parameters(&structure(&graph)?, layout).map_err(|mismatch| match mismatch {
        Mismatch::Links => GraphError::Structure("the layout has other arms or links".to_owned()),
        Mismatch::Zeros(found) => {
            GraphError::Structure(found.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))
        }
    })?;
    for (parameter, value) in graph.parameters.iter_mut().zip(values) {
        parameter.default = value;
        // "… of arm 1 (NAME)"
        let arms = parameter.arm.and_then(|arm| Some((&graph.layout.arms.get(arm)?.name, &layout.arms.get(arm)?.name)));
        if let Some((of, name)) =
            arms.and_then(|(old, name)| Some((parameter.description.strip_suffix(&format!("({old})"))?, name)))
        {
            parameter.description = format!("{of}({name})");
        }
    }
    graph.layout.name.clone_from(&layout.name);
    graph.layout.sha256 = layout.sha256();
    for (arm, of) in graph.layout.arms.iter_mut().zip(&layout.arms) {
        arm.name.clone_from(&of.name);
    }
    soundness::check(&graph).map_err(GraphError::Format)?;
    Ok(graph)
}

/// Parses the graph of a structure, to be evaluated for any layout of it.
///
/// # Errors
/// [`GraphError::Format`].
pub fn read_any(text: &str) -> Result<Graph, GraphError> {
    let graph = parse_format(text)?;
    soundness::check(&graph).map_err(GraphError::Format)?;
    Ok(graph)
}

fn parse_format(text: &str) -> Result<Graph, GraphError> {
    let Header { format } = parse(text)?;
    if format != FORMAT {
        return Err(GraphError::Format(format!("it has format {format}, this version reads format {FORMAT}")));
    }
    parse(text)
}

/// What the parameters of a graph are, by the names of [`ParameterKind`], with arm and link.
///
/// # Errors
/// A parameter that no layout has, or that is there twice.
pub fn structure(graph: &Graph) -> Result<Structure, GraphError> {
    let links: Vec<usize> = graph.layout.arms.iter().map(|arm| arm.links).collect();
    let mut parameters = Vec::with_capacity(graph.parameters.len());
    for Parameter { name, quantity, arm, link, .. } in &graph.parameters {
        let camel = camel_case(quantity);
        let kind = ParameterKind::ALL.into_iter().find(|kind| format!("{kind:?}") == camel);
        let (arm, link) = (arm.unwrap_or(0), link.unwrap_or(0));
        let place = kind.filter(|_| links.get(arm).is_some_and(|links| link < *links)).map(|kind| (kind, arm, link));
        match place {
            Some(place) if !parameters.contains(&place) => parameters.push(place),
            _ => return Err(no_parameter(name)),
        }
    }
    Ok(Structure { links, parameters, needs_distinct_mounts: graph.layout.needs_distinct_mounts })
}

fn no_parameter(name: &str) -> GraphError {
    GraphError::Format(format!("parameter `{name}` is no parameter of the layout, or is one twice"))
}

/// Compares the parameters of a graph with the numbers of its layout: each is one of them with its value as the
/// default, and those without a parameter are the exact zeros.
fn compare_parameters(graph: &Graph, layout: &Layout) -> Result<(), GraphError> {
    let mut left: HashMap<_, f64> =
        layout.parameters().into_iter().map(|(kind, arm, link, value)| ((kind, arm, link), value)).collect();
    for (parameter, place) in graph.parameters.iter().zip(structure(graph)?.parameters) {
        let name = &parameter.name;
        let value = left.remove(&place).ok_or_else(|| no_parameter(name))?;
        equal(&format!("the default of `{name}`"), &parameter.default, &value)?;
    }
    let mut numbers = layout.parameters().into_iter();
    match numbers.find(|(kind, arm, link, value)| *value != 0.0 && left.contains_key(&(*kind, *arm, *link))) {
        Some((kind, arm, link, value)) => {
            let what = format!("{kind:?} of arm {arm}, link {link}, counted from 0,");
            Err(GraphError::Differs { what, found: "no parameter".to_owned(), wanted: format!("{value:?}") })
        }
        None => Ok(()),
    }
}

/// The part that graphs of every format have.
#[derive(Deserialize)]
struct Header {
    #[serde(default)]
    format: Value,
}

fn parse<'a, T: Deserialize<'a>>(text: &'a str) -> Result<T, GraphError> {
    let problem = |e: serde_json::Error| printable(&if e.is_data() { e.to_string() } else { format!("not JSON: {e}") });
    serde_json::from_str(text).map_err(|e| GraphError::Format(problem(e)))
}

fn equal<T: PartialEq + Debug>(what: &str, found: &T, wanted: &T) -> Result<(), GraphError> {
    if found == wanted {
        return Ok(());
    }
    Err(GraphError::Differs { what: what.to_owned(), found: format!("{found:?}"), wanted: format!("{wanted:?}") })
}

#[cfg(test)]
mod tests {
    use super::{GraphError, read, read_for};
    use planar_layout::layout::Layout;
    use std::fs;

    /// A shipped layout and its graph.
    fn shipped() -> (Layout, String) {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
        let layout = Layout::read(format!("{folder}/layouts/single_arm_2r.toml").as_ref()).expect("a layout");
        (layout, fs::read_to_string(format!("{folder}/graphs/single_arm_2r.json")).expect("a graph"))
    }

    /// For another layout of its structure a graph says that one's names.
    #[test]
    fn descriptions_name_the_arms_of_the_layout() {
        let (mut layout, text) = shipped();
        let old = layout.arms[0].name.clone();
        layout.arms[0].name = "gripper".to_owned();
        let graph = read_for(&text, &layout).expect("its graph");
        let count = |name: &str| {
            let name = format!("({name})");
            graph.parameters.iter().filter(|parameter| parameter.description.ends_with(&name)).count()
        };
        // those of links have the number of their arm
        assert_eq!(count("gripper"), text.matches(&format!("({old})\"")).count());
        assert!(count("gripper") > 0 && count(&old) == 0);
    }

    /// A number of the layout that is not 0 has a parameter, whatever hash the graph has.
    #[test]
    fn numbers_without_a_parameter_are_refused() {
        let (layout, text) = shipped();
        assert!(read(&text, &layout).is_ok());
        let mut other = layout.clone();
        other.arms[0].mount[1] = 0.1;
        let text = text.replace(&layout.sha256(), &other.sha256());
        let found = read(&text, &other).map(|_| ());
        let Err(GraphError::Differs { what, found, wanted }) = found else { panic!("{found:?}") };
        assert!(what.contains("MountY of arm 0, link 0") && found == "no parameter" && wanted == "0.1", "{what}");
    }
}
