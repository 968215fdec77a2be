//! Models that evaluate graphs: the bits of the code that is rendered from them.

use crate::evaluator;
use planar_capture::build::graph;
use planar_capture::evaluation::evaluate_all;
use planar_capture::generate;
use planar_capture::layout::Layout;
use planar_capture::owned::CloneModel;
use planar_capture::quantity::Quantity;
use planar_capture::registry;
use planar_capture::sampling::REGIMES;
use planar_proof::file;
use serde_json::Value;
use std::fs;

/// Samples of each regime.
const SAMPLES: u64 = 20;

/// The bits of every quantity, or the error.
fn bits(
    model: &dyn CloneModel,
    instant: &planar_capture::evaluation::EvaluationInput,
) -> Result<Vec<Vec<u64>>, String> {
    let values = evaluate_all(model, instant).map_err(|error| format!("{error:?}"))?;
    let of =
        |quantity: &Quantity| values.get(*quantity).unwrap_or_default().iter().map(|value| value.to_bits()).collect();
    Ok(Quantity::ALL.iter().map(of).collect())
}

#[cfg(not(feature = "fused"))]
#[test]
fn graphs_have_the_bits_of_their_code() {
    for name in registry::GENERATED {
        let evaluator = evaluator("graphs", name);
        let text = fs::read_to_string(file(&format!("codegen/layouts/{name}.toml"))).expect("a layout");
        let layout = Layout::parse(&text, name).expect("a layout");
        for regime in REGIMES {
            for index in 0..SAMPLES {
                let sample = regime.sample(&layout, 14, index);
                let code = registry::generated(&sample.layout).expect("its code");
                let graph = evaluator.model(&sample.layout).expect("its structure");
                let (code, graph) = (bits(&*code, &sample.instant), bits(&graph, &sample.instant));
                for (quantity, (code, graph)) in Quantity::ALL
                    .iter()
                    .zip(code.as_deref().unwrap_or_default().iter().zip(graph.as_deref().unwrap_or_default()))
                {
                    assert_eq!(code, graph, "{name}, {quantity:?}, {regime:?} {index}");
                }
                assert_eq!(code, graph, "{name}, {regime:?} {index}");
            }
        }
    }
}

/// Those that are rendered, and those that are evaluated for every layout of their structure.
fn carried() -> impl Iterator<Item = (Layout, String)> {
    [("layouts", "graphs"), ("structures", "structures")].into_iter().flat_map(|(layouts, graphs)| {
        let files = fs::read_dir(file(&format!("codegen/{layouts}"))).expect("a folder");
        let layouts = files
            .map(|entry| entry.expect("a file").path())
            .filter(|path| path.extension().is_some_and(|e| e == "toml"));
        layouts.map(move |path| {
            let layout = Layout::read(&path).expect("a layout");
            let graph = fs::read_to_string(file(&format!("codegen/{graphs}/{}.json", layout.name))).expect("a graph");
            (layout, graph)
        })
    })
}

#[test]
fn all_graphs_are_proved() {
    let mut count = 0;
    for (layout, text) in carried() {
        let graph = graph::read(&text, &layout).expect("the layout's");
        let proof = generate::prove(&layout, &graph).unwrap_or_else(|error| panic!("{}: {error}", layout.name));
        assert!(proof.worst <= 1.0 && proof.states > 30, "{}: {proof:?}", layout.name);
        count += 1;
    }
    assert!(count >= 13, "{count}");
}

/// The text of the first graph with a change that only other numbers, or no numbers, tell from the right one.
#[test]
fn graphs_that_are_right_for_one_robot_alone_are_not_proved() {
    let layout = Layout::read(&file("codegen/layouts/single_arm_2r.toml")).expect("a layout");
    let text = fs::read_to_string(file("codegen/graphs/single_arm_2r.json")).expect("a graph");
    let problem = |change: &dyn Fn(&mut Value)| {
        let mut graph: Value = serde_json::from_str(&text).expect("JSON");
        change(&mut graph);
        let graph = graph::read(&graph.to_string(), &layout).expect("sound");
        generate::prove(&layout, &graph).expect_err("a fault").to_string()
    };
    let functions = |graph: &mut Value, change: &dyn Fn(&mut Value)| {
        let families = graph["families"].as_array_mut().expect("families").iter_mut();
        families.flat_map(|family| family["functions"].as_array_mut().expect("functions")).for_each(change);
    };
    let number = |graph: &mut Value| {
        let mass = graph["parameters"][0]["default"].clone();
        for family in graph["families"].as_array_mut().expect("families") {
            for statement in family["configuration"]["statements"].as_array_mut().expect("statements") {
                for operand in statement.as_array_mut().expect("a statement").iter_mut().skip(2) {
                    if *operand == "base_mass" {
                        *operand = mass.clone();
                    }
                }
            }
        }
    };
    let text = problem(&number);
    assert!(text.contains("disagree"), "the base's mass as a number: {text}");
    let pivot = |value: f64| {
        problem(&|graph| {
            functions(graph, &|function| {
                for output in function["outputs"].as_array_mut().expect("outputs") {
                    if output["name"] == "smallest_pivot" {
                        output["elements"][0] = value.into();
                    }
                }
            });
        })
    };
    let text = problem(&|graph| {
        functions(graph, &|function| function["outputs"].as_array_mut().expect("outputs").reverse());
    });
    assert!(text.contains("it has the outputs"), "{text}");
    assert!(pivot(0.5).contains("does not show that the parameter"), "{}", pivot(0.5));
    assert!(pivot(2.0).contains("is 2e0 at a regular state"), "{}", pivot(2.0));
    assert!(pivot(0.0).contains("is 0e0 at a regular state"), "{}", pivot(0.0));
}
