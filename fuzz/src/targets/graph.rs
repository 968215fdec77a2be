//! Graphs: one that is read renders to Rust.

use super::{Target, file, promised, refused};
use planar_capture::build::{Arithmetic, Module, graph};
use planar_capture::generate::prove;
use planar_capture::layout::Layout;
use serde_json::{Value, json};

/// The layouts of the seeds: one arm, and two of one structure, which are computed in pairs.
const LAYOUTS: [&str; 2] = ["single_arm_2r", "dual_arm_2r"];

pub fn target() -> Target {
    let seeds = LAYOUTS.iter().flat_map(|name| {
        let whole: Value = serde_json::from_str(&file(&format!("codegen/graphs/{name}.json"))).expect("JSON");
        let families = whole["families"].as_array().expect("families");
        let parts: Vec<Value> = families.iter().map(|family| part(&whole, family)).collect();
        let mut texts: Vec<String> = parts.iter().map(Value::to_string).collect();
        // the whole graph takes long, and its parts are enough to read
        texts.sort_by_key(String::len);
        texts.truncate(3);
        let impact = parts.into_iter().find(|part| part["families"][0]["name"] == "impact").expect("an impact");
        texts.push(in_loops(impact).to_string());
        texts
    });
    Target { name: "graph", share: 4, seeds: seeds.collect(), read }
}

/// The same impact in loops, from matrices of any of its values.
fn in_loops(mut graph: Value) -> Value {
    let function = &mut graph["families"][0]["functions"][0];
    let outputs = function["outputs"].as_array().expect("outputs").iter();
    let elements = outputs.clone().flat_map(|output| output["elements"].as_array().expect("elements"));
    let mut elements = elements.cloned().collect::<Vec<_>>().into_iter().cycle();
    let joints = outputs.clone().nth(1).and_then(|output| output["shape"][0].as_u64()).expect("H");
    let arms = joints / 2;
    let shapes = [("generalized_inertia", [joints, joints]), ("generalized_jacobian", [3 * arms, joints])];
    let matrices = shapes.map(|(name, [rows, columns])| {
        let elements: Vec<Value> = (0..rows * columns).filter_map(|_| elements.next()).collect();
        json!({"name": name, "shape": [rows, columns], "unit": "1", "description": "a matrix", "elements": elements})
    });
    function["matrices"] = json!(matrices);
    graph
}

/// A graph of one function, the first of a family, with the reference vectors of one state.
fn part(whole: &Value, family: &Value) -> Value {
    let mut family = family.clone();
    let functions = family["functions"].as_array_mut().expect("functions");
    functions.truncate(1);
    let (function, output) = (functions[0]["name"].clone(), functions[0]["outputs"][0]["name"].clone());
    let mut graph = whole.clone();
    graph["families"] = json!([family]);
    let inputs = graph["inputs"].as_array().expect("inputs").iter().map(|input| {
        let sizes = input["shape"].as_array().expect("a shape").iter().filter_map(Value::as_u64);
        let values: Vec<f64> = (0..sizes.product::<u64>()).map(|_| 0.5).collect();
        json!({"name": input["name"], "values": values})
    });
    let inputs: Vec<Value> = inputs.collect();
    let expected = json!([{"function": function, "output": output, "values": [0.5], "sizes": [1.0]}]);
    let parameters = vec![1.0; graph["parameters"].as_array().expect("parameters").len()];
    graph["self_test"] = json!([{"parameters": parameters, "inputs": inputs, "expected": expected}]);
    graph
}

fn read(bytes: &[u8]) -> Result<bool, String> {
    thread_local! {
        static OF: [Layout; 2] = LAYOUTS.map(|name| {
            Layout::parse(&file(&format!("codegen/layouts/{name}.toml")), "layout").expect("a layout")
        });
    }
    let text = String::from_utf8_lossy(bytes);
    OF.with(|[single, dual]| {
        let layout = if text.contains(&dual.sha256()) { dual } else { single };
        let graph = match graph::read(&text, layout) {
            Ok(graph) => graph,
            Err(error) => return refused(&error),
        };
        let arithmetic = Arithmetic { is_fused: text.len() % 4 > 1, is_paired: text.len() % 2 == 1 };
        let module = Module { standalone: false, item: true, arithmetic, source: "graph.json", command: "make" };
        let module = module.render(&graph).map_err(|error| format!("it does not render: {error}"))?;
        let parsed = syn::parse_file(&module).map_err(|error| format!("its module is no Rust: {error}"))?;
        promised(parsed.items.len() == 1, "a graph renders to one module")?;
        // a part has other results than its layout's whole graph
        if text.len().is_multiple_of(64) {
            promised(prove(layout, &graph).is_err(), "a part of a graph is not proved")?;
        }
        Ok(true)
    })
}
