//! Generated and generic models: against each other, against independent numbers and derivations by hand, and the laws
//! of mechanics.

mod batch;
mod capture;
mod closed_form;
mod control;
mod coordinates;
mod equivalence;
mod far_angles;
mod float;
mod generic;
mod graph_batches;
mod graph_models;
mod identities;
mod integrators;
mod light_last_link;
mod not_a_number;
mod references;
mod refusals;
mod scalars;
mod short_links;
mod single_precision;
mod strange_masses;
mod trajectory;

use planar_capture::build::evaluator::Evaluator;
use planar_capture::build::graph;
use planar_proof::file;
use std::fs;
use std::sync::Arc;

/// The evaluator of a graph of a folder of `codegen`.
fn evaluator(folder: &str, name: &str) -> Arc<Evaluator> {
    let text = fs::read_to_string(file(&format!("codegen/{folder}/{name}.json"))).expect("a graph");
    Arc::new(Evaluator::new(&graph::read_any(&text).expect("sound")).expect("all functions"))
}
