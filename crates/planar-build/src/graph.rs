//! Graphs as files: read, and compared with the layout that they were derived from.

use crate::renderer::camel;
use crate::renderer::json::{list, text};
use planar_layout::layout::Layout;
use serde_json::{Value, json};

/// The format of the graphs that are read.
const FORMAT: u64 = 2;

/// Why a graph cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GraphError {
    /// It is not of the format, or does not follow it.
    #[error("{0}")]
    Format(String),
    /// It was derived from another layout.
    #[error("it was derived from a layout with sha256 {found}, the layout has {wanted}")]
    Stale {
        /// The graph's.
        found: String,
        /// The layout's.
        wanted: String,
    },
    /// It says that it is of the layout, but has another name, arm or number.
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

impl From<String> for GraphError {
    fn from(problem: String) -> Self {
        Self::Format(problem)
    }
}

/// Parses a graph and compares it with a layout: hash, names, number of links and the defaults of all parameters.
///
/// # Errors
/// [`GraphError`].
pub fn read(graph_text: &str, layout: &Layout) -> Result<Value, GraphError> {
    let graph: Value = serde_json::from_str(graph_text).map_err(|e| format!("not JSON: {e}"))?;
    if graph["format"] != json!(FORMAT) {
        return Err(format!("it has format {}, this version reads format {FORMAT}", graph["format"]).into());
    }
    let (found, wanted) = (text(&graph["layout"]["sha256"])?, layout.sha256());
    if found != wanted {
        return Err(GraphError::Stale { found: found.to_owned(), wanted });
    }
    let arms: Vec<Value> = layout.arms.iter().map(|arm| json!({"name": arm.name, "links": arm.links.len()})).collect();
    same("name", &graph["layout"]["name"], &json!(layout.name))?;
    same("arms", &graph["layout"]["arms"], &json!(arms))?;
    let parameters = layout.parameters();
    for parameter in list(&graph["parameters"])? {
        let name = text(&parameter["name"])?;
        let place = |key: &str| parameter[key].as_u64().and_then(|place| usize::try_from(place).ok()).unwrap_or(0);
        let (arm, link) = (place("arm"), place("link"));
        let kind = camel(text(&parameter["quantity"])?);
        let value = parameters.iter().find(|(k, a, l, _)| format!("{k:?}") == kind && (*a, *l) == (arm, link));
        let (.., value) = value.ok_or_else(|| format!("parameter `{name}` is no parameter of the layout"))?;
        same(&format!("the default of `{name}`"), &parameter["default"], &json!(value))?;
    }
    Ok(graph)
}

fn same(what: &str, found: &Value, wanted: &Value) -> Result<(), GraphError> {
    let numbers = found.as_f64().zip(wanted.as_f64());
    if found == wanted || numbers.is_some_and(|(found, wanted)| (found + 0.0).to_bits() == (wanted + 0.0).to_bits()) {
        return Ok(());
    }
    Err(GraphError::Differs { what: what.to_owned(), found: found.to_string(), wanted: wanted.to_string() })
}
