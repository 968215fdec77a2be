//! Errors as exceptions of `planar_capture.errors`.

use planar_capture::diagnostic::Report;
use planar_capture::graphs::NoGraph;
use planar_capture::named_layout::NoLayout;
use planar_capture::output::output_error::OutputError;
use pyo3::prelude::{PyAnyMethods, PyErr, Python};

/// The classes of exceptions.
#[derive(Clone, Copy)]
pub enum Failure {
    /// A file, an argument or an array is not valid.
    Input,
    /// No graph has the structure of a layout.
    MissingGraph,
    /// A valid computation broke down.
    Computation,
    /// A result cannot be written.
    Output,
    /// A layout could not be derived.
    Derivation,
}

impl Failure {
    /// The exception with a message.
    pub fn with(self, message: impl ToString) -> PyErr {
        let name = match self {
            Self::Input => "InputError",
            Self::MissingGraph => "MissingGraphError",
            Self::Computation => "ComputationError",
            Self::Output => "OutputError",
            Self::Derivation => "DerivationError",
        };
        Python::attach(|py| {
            let class = py.import("planar_capture.errors").and_then(|module| module.getattr(name));
            let error = class.and_then(|class| class.call1((message.to_string(),)));
            error.map_or_else(|error| error, PyErr::from_value)
        })
    }
}

/// Of a file that is not valid.
pub fn of_report(report: Report) -> PyErr {
    Failure::Input.with(report.render(false))
}

/// Of a name or a path without a layout.
pub fn of_layout(error: NoLayout) -> PyErr {
    match error {
        NoLayout::Unreadable(report) => of_report(report),
        NoLayout::Unknown(message) => Failure::Input.with(message),
    }
}

/// Of a structure that has no graph.
pub fn of_graph(error: &NoGraph) -> PyErr {
    Failure::MissingGraph.with(with_remedy(error))
}

/// The command's message with what derives a graph here.
pub fn with_remedy(error: &NoGraph) -> String {
    format!("{error}, and so does `planar_capture.derive` in Python")
}

/// Of a file that cannot be written.
pub fn of_output(error: OutputError) -> PyErr {
    Failure::Output.with(error)
}
