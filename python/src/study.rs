//! The results of a study.

use crate::failure::{Failure, of_output};
use numpy::{IntoPyArray, PyArray1};
use planar_capture::capture::{CaseResult, Study as Computed};
use planar_capture::engine::Engine;
use planar_capture::output::atomic_file::StagedFile;
use planar_capture::output::console::table;
use planar_capture::output::html_report::write_report;
use planar_capture::output::run_manifest::RunManifest;
use planar_capture::output::summary::summary;
use planar_capture::output::time_series::{all_rows, columns, write_csv};
use planar_capture::scenario::Scenario;
use pyo3::prelude::{Bound, PyResult, Python, pyclass, pymethods};
use std::path::PathBuf;

/// A column of a time series: name, unit, values.
type Column<'py> = (String, &'static str, Bound<'py, PyArray1<f64>>);

/// The results of a study.
#[pyclass(frozen, module = "planar_capture._native")]
pub struct Study {
    pub scenario: Scenario,
    pub computed: Computed,
    pub manifest: RunManifest,
    pub engine: Engine,
    pub warning: Option<String>,
}

impl Study {
    fn case(&self, name: &str) -> PyResult<&CaseResult> {
        let missing = || Failure::Input.with(format!("there is no case `{name}`"));
        self.computed.cases.iter().find(|case| case.name == name).ok_or_else(missing)
    }
}

#[pymethods]
impl Study {
    #[getter]
    fn cases(&self) -> Vec<&str> {
        self.computed.cases.iter().map(|case| case.name.as_str()).collect()
    }

    /// Why a graph that is there was not used.
    #[getter]
    fn warning(&self) -> Option<&str> {
        self.warning.as_deref()
    }

    /// What the audit objects to.
    #[getter]
    fn audit_failures(&self) -> Vec<String> {
        self.computed.audit_failures()
    }

    /// The text of summary.json.
    fn summary(&self) -> PyResult<String> {
        let summary = summary(&self.scenario, self.engine.name(), &self.computed, &self.manifest);
        summary.map(|summary| summary.to_string()).map_err(|error| Failure::Computation.with(error))
    }

    /// The table that the command prints.
    fn table(&self) -> String {
        table(&self.scenario, &self.computed)
    }

    /// The phase of each row of a case, and its columns.
    fn series<'py>(&self, py: Python<'py>, case: &str) -> PyResult<(Vec<&'static str>, Vec<Column<'py>>)> {
        let case = self.case(case)?;
        let columns = columns(&self.scenario, case);
        let (mut phases, mut times) = (Vec::new(), Vec::new());
        let mut values = vec![Vec::new(); columns.len()];
        for row in all_rows(&self.computed, case) {
            let row = row?;
            phases.push(row.phase);
            times.push(row.time);
            values.iter_mut().zip(&columns).for_each(|(values, column)| values.push(column.value(&row)));
        }
        let columns = columns.into_iter().zip(values).map(|(column, values)| (column.name, column.unit, values));
        let all = std::iter::once(("t".to_owned(), "s", times)).chain(columns);
        Ok((phases, all.map(|(name, unit, values)| (name, unit, values.into_pyarray(py))).collect()))
    }

    /// The report as HTML.
    fn html(&self) -> PyResult<String> {
        let mut page = Vec::new();
        write_report(&self.scenario, &self.computed, &self.manifest, &mut page)?;
        Ok(String::from_utf8_lossy(&page).into_owned())
    }

    /// Writes the report to a file, whole or not at all.
    fn write_html(&self, path: PathBuf) -> PyResult<()> {
        let staged = StagedFile::new(&path, |to| write_report(&self.scenario, &self.computed, &self.manifest, to));
        staged.and_then(StagedFile::commit).map_err(of_output)
    }

    /// Writes the time series of a case to a CSV file, whole or not at all.
    fn write_csv(&self, case: &str, path: PathBuf) -> PyResult<()> {
        let case = self.case(case)?;
        let staged = StagedFile::new(&path, |to| write_csv(&self.scenario, &self.computed, case, to));
        staged.and_then(StagedFile::commit).map_err(of_output)
    }
}
