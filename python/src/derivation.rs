//! The derivation of layouts whose structure no graph has.

use crate::failure::{Failure, of_output};
use crate::robot::Robot;
use planar_capture::generate::{GenerateError, Proved, complete, derive_by};
use planar_capture::graphs::{cache_path, keep};
use planar_capture::layout::Layout;
use planar_capture::python_package::PYTHON_PACKAGE;
use pyo3::prelude::{Py, PyAny, PyAnyMethods, PyErr, PyResult, Python, pyfunction};
use std::ffi::OsString;

/// Derives a layout, a TOML text, by an interpreter that has CasADi, or by one that is found, in an environment that is
/// made; proves the graph, and keeps it in the user's cache folder. `say` is called with messages.
#[pyfunction]
pub fn derive(
    py: Python<'_>,
    layout: &str,
    file: &str,
    interpreter: Option<OsString>,
    say: Option<Py<PyAny>>,
) -> PyResult<Robot> {
    let layout = Layout::parse(layout, file).map_err(crate::failure::of_report)?;
    let path = cache_path(&layout).map_err(|error| Failure::Derivation.with(error))?;
    let mut raised: Option<PyErr> = None;
    let text = py.detach(|| {
        let mut show = |line: &str| {
            let shown = Python::attach(|py| {
                py.check_signals()?;
                say.as_ref().map_or(Ok(()), |say| say.bind(py).call1((line,)).map(|_| ()))
            });
            if let Err(error) = shown {
                raised.get_or_insert(error);
            }
        };
        let text = derive_by(interpreter.as_deref(), &layout, &[], PYTHON_PACKAGE, &mut show);
        let text = text.map_err(|error| Failure::Derivation.with(error))?;
        let Proved { text, .. } = complete(&text, &layout).map_err(|error| match error {
            GenerateError::Disagreement { .. } => Failure::Computation.with(error),
            other => Failure::Derivation.with(other),
        })?;
        Ok::<_, PyErr>(text)
    })?;
    if let Some(raised) = raised {
        return Err(raised);
    }
    keep(&path, &text).map_err(of_output)?;
    Robot::of(layout)
}
