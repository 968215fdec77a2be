//! What the templates of Rust and C compose of a graph's functions: Runge–Kutta steps, and the last links that targets are
//! merged with.

use crate::format::Graph;
use serde_json::{Value, json};

/// The step functions, each with the function of its slope.
pub fn steps() -> Vec<Value> {
    let step = |suffix: &str, forces: &str| {
        json!({
            "name": format!("rk4_step{suffix}"),
            "function": format!("forward_dynamics{suffix}"),
            "has_wrench": !suffix.is_empty(),
            "description": format!(
                "One step of the classical Runge–Kutta method of fourth order, of `step` (s), with {forces} that are \
                 constant in it."
            ),
        })
    };
    vec![step("", "joint torques"), step("_with_base_wrench", "joint torques and a wrench on the base")]
}

/// Arm by arm: the parameters of the last link. `None` for a graph that has
/// not these parameters.
pub fn merged_links(graph: &Graph) -> Option<Vec<Value>> {
    let arms = graph.layout.arms.iter().enumerate().map(|(index, arm)| {
        let link = arm.links.checked_sub(1)?;
        let parameter = |quantity: &str| {
            let mut parameters = graph.parameters.iter();
            let found = parameters.find(|p| p.quantity == quantity && p.arm == Some(index) && p.link == Some(link));
            found.map(|found| found.name.as_str())
        };
        Some(json!({
            "index": index,
            "mass": parameter("link_mass")?,
            "inertia": parameter("link_inertia")?,
            "length": parameter("link_length")?,
            "com_x": parameter("link_com_x")?,
            "com_y": parameter("link_com_y")?,
        }))
    });
    arms.collect()
}
