//! The proof of a graph: derived from a layout, interpreted, and compared with the generic implementation.
//!
//! # Example
//! ```
//! use planar_build::graph;
//! use planar_build::prove::{GenerateError, prove};
//! use planar_layout::layout::Layout;
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
//! let layout = Layout::read(format!("{folder}/layouts/dual_arm_3r.toml").as_ref())?;
//! let text = std::fs::read_to_string(format!("{folder}/graphs/dual_arm_3r.json"))?;
//! // 13 regimes of states, three states each
//! assert_eq!(prove(&layout, &graph::read(&text, &layout)?)?.states, 39);
//! // a graph in which the half of the kinetic energy, ½ v · p, is another number is refused
//! let wrong = text.replace(r#""mul", 0.5,"#, r#""mul", 0.6,"#);
//! let refused = prove(&layout, &graph::read(&wrong, &layout)?);
//! assert!(matches!(refused, Err(GenerateError::Disagreement { output, .. }) if output == "kinetic_energy"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod derivation;
mod derivatives;
pub mod evaluation;
pub mod generic;
mod generic_results;
mod impact_results;
mod interpreter;
pub mod owned;
mod perturbed;
mod pivots;
pub mod quantities;
pub mod rigid_capture;
pub mod sampling;
mod vectors;

pub use derivation::{DerivationError, derive, derive_by, home, package_hash};

use crate::evaluator::Evaluator;
use crate::format::{FunctionResult, Given, PIVOT, ReferenceState};
use crate::graph::{self, Graph, GraphError};
use crate::prove::sampling::{REGIMES, Regime, RegimeSample, balanced};
use derivatives::with_derivatives;
use impact_results::EXACT;
use interpreter::{Arguments, interpret, interpret_loops};
use planar_dynamics::error::Error;
use planar_layout::layout::Layout;
use planar_layout::structure::{Structure, parameters};
use serde_json::json;
use std::fmt;
use vectors::{direction, reference_state};

/// States of each regime that a graph is proved at.
const SAMPLES: u64 = 3;

/// There is no code for a layout.
#[derive(Debug, thiserror::Error)]
pub enum GenerateError {
    /// The graph is not of the format, not the layout's, or does not follow it.
    #[error("the graph cannot be used: {0}")]
    Graph(#[from] GraphError),
    /// The generic implementation has no answer: a robot without inertia somewhere.
    #[error(
        "the generic implementation has no answer for a state of this robot ({regime}, {index}): {source}; masses, moments \
         of inertia (kg, kg m²) and lengths (m) of its bodies are too far apart for 16 digits"
    )]
    NoReference {
        /// Where the state was drawn from.
        regime: &'static str,
        /// Which one.
        index: u64,
        /// What is wrong with it.
        source: Error,
    },
    /// The graph and the generic implementation differ.
    #[error(
        "derived and generic dynamics disagree: {function}, {output} is off by {error:.1e} times what is allowed \
         (state {index} of regime {regime}); this is a fault of the derivation, please report it with the layout"
    )]
    Disagreement {
        /// The function.
        function: String,
        /// Which of its results.
        output: String,
        /// Over what is allowed.
        error: f64,
        /// Where the state was drawn from.
        regime: &'static str,
        /// Which one.
        index: u64,
    },
}

/// The result of a proof.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proof {
    /// Number of states.
    pub states: u64,
    /// Number of results compared at each of them.
    pub results: usize,
    /// Largest difference over what is allowed: at most 1.
    pub worst: f64,
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { states, results, worst } = self;
        write!(
            f,
            "{results} results agree with the generic implementation at {states} states (largest difference {worst:.0e} of \
             the rounding bound)"
        )
    }
}

/// A graph with its proof.
#[derive(Clone, Debug)]
pub struct Proved {
    /// The graph, with reference vectors.
    pub graph: Graph,
    /// The same as text, as it is to be kept.
    pub text: String,
    /// The result of its proof.
    pub proof: Proof,
    /// Why modules made from it are for double precision alone, where single precision does not hold the robot.
    pub double_alone: Option<String>,
}

/// Proves the graph that was derived from a layout, and adds reference vectors to it: results of the generic
/// implementation that a module made from it compares its own with.
///
/// # Errors
/// [`GenerateError`].
pub fn complete(graph_text: &str, layout: &Layout) -> Result<Proved, GenerateError> {
    let mut graph = graph::read(graph_text, layout)?;
    if graph.self_test.is_some() {
        return Err(GraphError::Format("it has reference vectors already, which this adds".to_owned()).into());
    }
    let proof = prove(layout, &graph)?;
    let structure = graph::structure(&graph)?;
    let samples =
        [(Regime::Moving.name(), Regime::Moving.sample(layout, 0, 0)), ("balanced", balanced(layout, &structure))];
    let (mut states, mut double_alone): (Vec<ReferenceState>, _) = (Vec::new(), None);
    for (regime, sample) in samples {
        let direction = direction(layout, 0);
        let reference = reference(sample, (&graph, &structure), &direction, (regime, 0))?;
        largest_error(&graph, &reference, (regime, 0))?;
        let state = reference.of_own_test(&graph).map_err(GraphError::Format)?;
        double_alone = double_alone.or_else(|| state.double_alone.clone());
        states.push(state);
    }
    // a state a line, after what the derivation wrote
    let lines: Vec<String> = states.iter().map(|state| json!(state).to_string()).collect();
    let lines = lines.join(",\n  ");
    let end = graph_text.trim_end().strip_suffix('}').unwrap_or(graph_text).trim_end();
    let text = format!("{end},\n \"self_test\": [\n  {lines}\n ]\n}}\n");
    graph.self_test = Some(states);
    Ok(Proved { graph, text, proof, double_alone })
}

/// Compares the results of a graph, which is interpreted, with the generic implementation: every result of every
/// function at states of every regime, with the layout's own numbers and with others. Derivatives are compared with dual
/// numbers through the graph's own functions, which are compared themselves. Pivots, which the generic implementation
/// does not have, are to show what is not a number.
///
/// # Errors
/// [`GenerateError`], with the first result that differs by more than is allowed.
pub fn prove(layout: &Layout, graph: &Graph) -> Result<Proof, GenerateError> {
    // that all functions are there, with their inputs and outputs in order
    let evaluator = Evaluator::new(graph)?;
    let structure = evaluator.structure();
    let mut proof = Proof { states: 0, results: 0, worst: 0.0 };
    for regime in REGIMES {
        for index in 0..SAMPLES {
            let state = sampled(layout, (graph, structure), regime, index)?;
            proof.worst = proof.worst.max(largest_error(graph, &state, (regime.name(), index))?);
            proof.states += 1;
            proof.results = state.expected.len();
        }
    }
    let state = sampled(layout, (graph, structure), Regime::Moving, 0)?;
    pivots::check(graph, structure, Arguments::of(&state))?;
    Ok(proof)
}

/// The largest difference of a result of the graph, which is interpreted, from the generic implementation's, over what is
/// allowed; `place` is the regime and the index of the state.
fn largest_error(graph: &Graph, state: &ReferenceState, place: (&'static str, u64)) -> Result<f64, GenerateError> {
    let arguments = Arguments::of(state);
    let mut found = interpret(graph, arguments).map_err(GraphError::Format)?;
    found.retain(|found| found.output != PIVOT);
    if found.len() != state.expected.len() {
        let problem = "it has other results than the generic implementation";
        return Err(GraphError::Format(problem.to_owned()).into());
    }
    let in_loops = interpret_loops(graph, arguments).map_err(GraphError::Format)?;
    found.extend(in_loops.into_iter().filter(|found| found.output != PIVOT));
    let mut worst: f64 = 0.0;
    for found in found {
        let error = state.expected(&found).map_or(f64::INFINITY, |expected| expected.error(&found));
        if error > 1.0 {
            let (FunctionResult { function, output, .. }, (regime, index)) = (found, place);
            return Err(GenerateError::Disagreement { function, output, error, regime, index });
        }
        worst = worst.max(error);
    }
    Ok(worst)
}

/// [`reference`] of a sample of a regime.
fn sampled(
    layout: &Layout,
    graph: (&Graph, &Structure),
    regime: Regime,
    index: u64,
) -> Result<ReferenceState, GenerateError> {
    let direction = direction(layout, index);
    reference(regime.sample(layout, 0, index), graph, &direction, (regime.name(), index))
}

/// The results of the generic implementation, and what derivatives of these the graph has, along a direction.
fn reference(
    sample: RegimeSample,
    (graph, structure): (&Graph, &Structure),
    direction: &[Given],
    (regime, index): (&'static str, u64),
) -> Result<ReferenceState, GenerateError> {
    let failed = |source| GenerateError::NoReference { regime, index, source };
    let parameters = parameters(structure, &sample.layout)
        .map_err(|_| GraphError::Format("its structure is not the layout's".to_owned()))?;
    let has_impact_results = graph.functions().any(|function| function.name == EXACT);
    let reference = reference_state(sample, parameters, has_impact_results).map_err(failed)?;
    Ok(with_derivatives(graph, reference, direction).map_err(GraphError::Format)?)
}
