//! Models that evaluate graphs: the bits of the code that is rendered from them.

use planar_capture::build::evaluator::Evaluator;
use planar_capture::build::graph;
use planar_capture::evaluation::evaluate_all;
use planar_capture::layout::Layout;
use planar_capture::owned::CloneModel;
use planar_capture::quantity::Quantity;
use planar_capture::registry;
use planar_capture::sampling::REGIMES;
use planar_proof::file;
use std::fs;
use std::sync::Arc;

/// Samples of each regime.
const SAMPLES: u64 = 20;

fn evaluator(name: &str) -> Arc<Evaluator> {
    let text = fs::read_to_string(file(&format!("codegen/graphs/{name}.json"))).expect("a graph");
    Arc::new(Evaluator::new(&graph::read_any(&text).expect("sound")).expect("all functions"))
}

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
        let evaluator = evaluator(name);
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
