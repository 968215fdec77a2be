//! Sizes and derivation time of a robot's graph and module.

use crate::{Problem, REPEATS, shape::Shape};
use planar_capture::build::Module;
use planar_capture::build::pipeline::arithmetic;
use planar_capture::generate::{complete, derive};
use planar_capture::python_package::PYTHON_PACKAGE;
use serde_json::Value;
use std::time::Instant;

/// Graph and modules of a layout.
#[derive(Debug)]
pub struct Derivation {
    /// Layout to graph, Python's start included, s; the fastest of several.
    pub seconds: f64,
    /// Size of the graph's text.
    pub graph_bytes: usize,
    /// A module for inclusion, with the library.
    pub item: String,
    /// A standalone module.
    pub standalone: String,
    graph: Value,
}

impl Derivation {
    /// Derives, proves and renders a robot.
    pub fn of(shape: Shape) -> Result<Self, Problem> {
        let layout = shape.layout();
        let (mut seconds, mut text) = (f64::INFINITY, String::new());
        for _ in 0..REPEATS {
            let start = Instant::now();
            text = derive(&layout, &[], PYTHON_PACKAGE, &mut |_| {})?;
            seconds = seconds.min(start.elapsed().as_secs_f64());
        }
        let proved = complete(&text, &layout)?.graph;
        let render = |standalone| {
            let module = Module {
                standalone,
                item: !standalone,
                arithmetic: arithmetic(),
                source: "the scaling benchmark",
                command: "cargo run",
            };
            module.render(&proved)
        };
        let (item, standalone) = (render(false)?, render(true)?);
        let graph = serde_json::from_str(&text)?;
        Ok(Self { seconds, graph_bytes: text.len(), item, standalone, graph })
    }

    /// Multiplications, additions and divisions of a function, the configuration's included.
    pub fn flops(&self, function: &str) -> u32 {
        self.count(function, "flops")
    }

    /// Operations of one kind of a function.
    pub fn count(&self, function: &str, kind: &str) -> u32 {
        let counts = self.functions().find(|f| f["name"] == function).map(|f| &f["operations"][kind]);
        counts.and_then(Value::as_u64).and_then(|count| count.try_into().ok()).unwrap_or(0)
    }

    /// Statements of the longest function.
    pub fn longest(&self) -> usize {
        self.functions().filter_map(|f| f["statements"].as_array()).map(Vec::len).max().unwrap_or(0)
    }

    fn functions(&self) -> impl Iterator<Item = &Value> {
        let families = self.graph["families"].as_array().into_iter().flatten();
        families.filter_map(|family| family["functions"].as_array()).flatten()
    }
}
