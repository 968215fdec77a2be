//! Rust for any layout: derived, proved against the generic implementation, rendered as a module for another crate.

mod derivation;
pub mod evaluation;
pub mod generic;
mod interpreter;
pub mod owned;
pub mod quantities;
pub mod sampling;
mod vectors;

pub use derivation::{DerivationError, derive};

use crate::prove::sampling::{REGIMES, Regime};
use crate::renderer::{self, Form};
use interpreter::interpret;
use planar_dynamics::error::Error;
use planar_layout::layout::Layout;
use serde_json::Value;
use vectors::Vectors;

/// States of each regime that a graph is proved at.
const SAMPLES: u64 = 3;

/// States whose results a module carries for its own test.
const CARRIED: u64 = 2;

/// There is no code for a layout.
#[derive(Debug, thiserror::Error)]
pub enum GenerateError {
    /// The graph is not of the format, or does not follow it.
    #[error("the graph cannot be used: {0}")]
    Graph(String),
    /// The graph is of another layout.
    #[error("the graph was derived from a layout with sha256 {found}, the layout has {wanted}")]
    Stale {
        /// The graph's.
        found: String,
        /// The layout's.
        wanted: String,
    },
    /// The generic implementation has no answer: a robot without inertia somewhere.
    #[error("the generic implementation has no answer for a state of this robot ({regime}, {index}): {source}")]
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

/// What a graph was found to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proof {
    /// Number of states.
    pub states: u64,
    /// Number of results compared at each of them.
    pub results: usize,
    /// Largest difference over what is allowed: at most 1.
    pub worst: f64,
}

/// Parses a graph and compares its layout with this one.
///
/// # Errors
/// [`GenerateError::Graph`], [`GenerateError::Stale`].
pub fn read_graph(text: &str, layout: &Layout) -> Result<Value, GenerateError> {
    let graph = renderer::read(text).map_err(GenerateError::Graph)?;
    let found = renderer::layout_hash(&graph).map_err(GenerateError::Graph)?;
    let wanted = layout.sha256();
    if found == wanted { Ok(graph) } else { Err(GenerateError::Stale { found: found.to_owned(), wanted }) }
}

/// Compares a graph, computed as it stands, with the generic implementation: every result of every function at states of
/// every regime that leaves the layout's numbers as they are.
///
/// # Errors
/// [`GenerateError`], with the first result that is off.
pub fn prove(layout: &Layout, graph: &Value) -> Result<Proof, GenerateError> {
    let mut proof = Proof { states: 0, results: 0, worst: 0.0 };
    for regime in REGIMES.into_iter().filter(|regime| regime.keeps_layout()) {
        for index in 0..SAMPLES {
            let vectors = at(layout, regime, index)?;
            let found = interpret(graph, &vectors.inputs()).map_err(GenerateError::Graph)?;
            let found = || found.iter().filter(|found| found.output != "smallest_pivot");
            if found().count() != vectors.expected.len() {
                return Err(GenerateError::Graph("it has other results than the generic implementation".to_owned()));
            }
            for (found, expected) in found().zip(&vectors.expected) {
                let same = found.function == expected.function && found.output == expected.output;
                let error = if same { expected.error(found) } else { f64::INFINITY };
                if error > 1.0 {
                    let (function, output) = (found.function.clone(), found.output.clone());
                    return Err(GenerateError::Disagreement { function, output, error, regime: regime.name(), index });
                }
                proof.worst = proof.worst.max(error);
            }
            proof.states += 1;
            proof.results = vectors.expected.len();
        }
    }
    Ok(proof)
}

/// A module for another crate.
#[derive(Clone, Copy, Debug)]
pub struct Module<'a> {
    /// Whether it carries what it needs, or depends on this crate's core.
    pub standalone: bool,
    /// Whether the text is an item `pub mod NAME { … }`, for `include!`, or a file of its own.
    pub item: bool,
    /// What it is made from, for its header.
    pub source: &'a str,
    /// The command that makes it again, for its header.
    pub command: &'a str,
}

impl Module<'_> {
    /// The module's text, with reference vectors by the generic implementation. The same graph and the same
    /// choices give the same bytes on every machine.
    ///
    /// # Errors
    /// [`GenerateError`].
    pub fn render(&self, layout: &Layout, graph: &Value) -> Result<String, GenerateError> {
        let vectors = (0..CARRIED).map(|index| {
            let vectors = at(layout, Regime::Moving, index)?;
            let found = interpret(graph, &vectors.inputs()).map_err(GenerateError::Graph)?;
            Ok(vectors.to_json(&found))
        });
        let vectors = Value::Array(vectors.collect::<Result<_, GenerateError>>()?);
        let form = Form {
            standalone: self.standalone,
            item: self.item,
            source: self.source,
            command: self.command,
            self_test: Some(&vectors),
        };
        renderer::render(graph, &form).map_err(GenerateError::Graph)
    }
}

/// The command that generates a file from a layout, as it can be typed.
#[must_use]
pub fn command(layout: &str, out: &str, standalone: bool) -> String {
    let option = if standalone { " --standalone" } else { "" };
    format!("planar-capture generate {} --out {}{option}", quoted(layout), quoted(out))
}

/// A path as one word of a command line.
#[must_use]
pub fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./\\:".contains(c) || !c.is_ascii();
    if !path.is_empty() && path.chars().all(plain) {
        path.to_owned()
    } else {
        format!("'{}'", path.replace('\'', "'\\''"))
    }
}

fn at(layout: &Layout, regime: Regime, index: u64) -> Result<Vectors, GenerateError> {
    let failed = |source| GenerateError::NoReference { regime: regime.name(), index, source };
    Vectors::new(layout, regime, index).map_err(failed)
}
