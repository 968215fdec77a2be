//! A robot for co-simulation: its variables in one array, and the C between that array and a module.

mod variables;

pub use variables::{CoSimulationVariable, Role};

use super::CModule;
use crate::format::Graph;
use crate::renderer::templates;
use serde_json::json;
use tera::Context;
use variables::{INTERNAL_STEP, variables};

/// Variables of a robot and the C that computes them by the functions of a module.
#[derive(Clone, Debug, PartialEq)]
pub struct CoSimulation {
    /// All variables in the order of their value references.
    pub variables: Vec<CoSimulationVariable>,
    /// `robot.c`.
    pub source: String,
    /// `robot.h`, which includes the header of the module.
    pub header: String,
}

impl CoSimulation {
    /// Variables and text for a graph, next to its module. `token`, hexadecimal digits, tells the description that belongs to
    /// them from others.
    ///
    /// # Errors
    /// A function that is missing, a template that does not render: which and where.
    pub fn render(graph: &Graph, module: &CModule<'_>, token: &str) -> Result<Self, String> {
        for needed in ["end_effector_poses", "end_effector_twists", "momentum"] {
            let mut functions = graph.functions();
            functions
                .find(|function| function.name == needed)
                .ok_or_else(|| format!("it has no function `{needed}`"))?;
        }
        let variables = variables(graph);
        let first = |role: Role| variables.iter().position(|variable| variable.role == role).unwrap_or(variables.len());
        let joints: usize = graph.layout.arms.iter().map(|arm| arm.links).sum();
        let place = |name: &str| variables.iter().position(|variable| variable.name == name);
        let context = json!({
            "name": graph.layout.name,
            "macro": graph.layout.name.to_uppercase(),
            "header": module.header,
            "token": token,
            "time": first(Role::Time),
            "internal_step": first(Role::Parameter),
            "inputs": first(Role::Input),
            "states": first(Role::State),
            "observed": first(Role::Observed),
            "variables": variables.len(),
            "step": format!("{INTERNAL_STEP:?}"),
            "parameters": graph.parameters.iter().map(|parameter| json!({
                "name": parameter.name,
                "index": place(&parameter.name),
            })).collect::<Vec<_>>(),
            "joints": joints,
            "arms": graph.layout.arms.len(),
        });
        let context = Context::from_serialize(&context).map_err(|e| e.to_string())?;
        let tera = templates()?;
        let render = |name| tera.render(name, &context).map_err(|e| format!("{e:?}"));
        Ok(Self { source: render("robot.c")?, header: render("robot.h")?, variables })
    }
}
