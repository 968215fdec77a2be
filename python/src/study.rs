//! The results of a study.

use crate::failure::{Failure, of_output};
use numpy::{IntoPyArray, PyArray1};
use planar_capture::capture::{CaseResult, Study as Computed};
use planar_capture::engine::Engine;
use planar_capture::output::atomic_file::StagedFile;
use planar_capture::output::console::table_of_parts;
use planar_capture::output::html_report::write_report;
use planar_capture::output::run_manifest::RunManifest;
use planar_capture::output::study_part::StudyPart;
use planar_capture::output::summary::summary_of_parts;
use planar_capture::output::time_series::{Columns, all_rows, write_csv};
use planar_capture::scenario::{Scenario, Variant};
use pyo3::prelude::{Bound, PyResult, Python, pyclass, pymethods};
use std::borrow::Cow;
use std::path::PathBuf;

/// A column of a time series: name, unit, values.
type Column<'py> = (String, &'static str, Bound<'py, PyArray1<f64>>);

/// The study of the cases that share an approach, or of a case with values of its own.
pub struct Part {
    /// With the values of its cases.
    pub scenario: Scenario,
    pub computed: Computed,
    pub engine: Engine,
}

/// The results of a study.
#[pyclass(frozen, module = "planar_capture._native")]
pub struct Study {
    pub scenario: Scenario,
    /// At least one.
    pub parts: Vec<Part>,
    pub manifest: RunManifest,
    /// Of the scenario.
    pub engine: Engine,
    pub warning: Option<String>,
}

impl Study {
    fn case(&self, name: &str) -> PyResult<(&Part, &CaseResult)> {
        let missing = || Failure::Input.with(format!("there is no case `{name}`"));
        let mut cases = self.parts.iter().flat_map(|part| part.computed.cases.iter().map(move |case| (part, case)));
        cases.find(|(_, case)| case.name == name).ok_or_else(missing)
    }

    /// The part that a case is in alone, or all of them.
    fn parts_with(&self, case: Option<&str>) -> PyResult<Vec<StudyPart<'_>>> {
        let mut parts = self.study_parts();
        if let Some(name) = case {
            self.case(name)?;
            parts.retain(|part| part.study.cases.iter().any(|case| case.name == name));
        }
        Ok(parts)
    }

    fn study_parts(&self) -> Vec<StudyPart<'_>> {
        let each = self.parts.iter().map(|part| StudyPart {
            scenario: &part.scenario,
            variant: self.variant(part),
            dynamics: part.engine.name(),
            study: Cow::Borrowed(&part.computed),
            manifest: self.manifest_of(part),
        });
        each.collect()
    }

    /// The case of a part, where it has values of its own.
    fn variant(&self, part: &Part) -> Option<&Variant> {
        self.scenario.variant(&part.scenario.cases.first()?.name)
    }

    fn manifest_of(&self, part: &Part) -> RunManifest {
        self.manifest.of_part(self.variant(part))
    }
}

#[pymethods]
impl Study {
    #[getter]
    fn cases(&self) -> Vec<&str> {
        self.scenario.case_names()
    }

    /// Why a graph that is there was not used.
    #[getter]
    fn warning(&self) -> Option<&str> {
        self.warning.as_deref()
    }

    /// What the audit objects to.
    #[getter]
    fn audit_failures(&self) -> Vec<String> {
        self.study_parts().iter().flat_map(StudyPart::audit_failures).collect()
    }

    /// The text of summary.json.
    fn summary(&self) -> PyResult<String> {
        let summary = summary_of_parts(&self.scenario, self.engine.name(), &self.study_parts(), &self.manifest);
        summary.map(|summary| summary.to_string()).map_err(|error| Failure::Computation.with(error))
    }

    /// The table that the command prints.
    fn table(&self) -> String {
        table_of_parts(&self.study_parts())
    }

    /// The phase of each row of a case, and its columns.
    fn series<'py>(&self, py: Python<'py>, case: &str) -> PyResult<(Vec<&'static str>, Vec<Column<'py>>)> {
        let (part, case) = self.case(case)?;
        let columns = Columns::of(&part.scenario, case);
        let (mut phases, mut times, mut values) = (Vec::new(), Vec::new(), Vec::new());
        let mut series = vec![Vec::new(); columns.list().len()];
        for row in all_rows(&part.computed, case) {
            let row = row?;
            phases.push(row.phase);
            times.push(row.time);
            columns.values(&row, &mut values);
            series.iter_mut().zip(&values).for_each(|(series, value)| series.push(*value));
        }
        let named = columns.list().iter().map(|column| (column.name.clone(), column.unit));
        let columns = named.zip(series).map(|((name, unit), values)| (name, unit, values));
        let all = std::iter::once(("t".to_owned(), "s", times)).chain(columns);
        Ok((phases, all.map(|(name, unit, values)| (name, unit, values.into_pyarray(py))).collect()))
    }

    /// The report on all cases as HTML.
    fn html(&self) -> PyResult<String> {
        let mut page = Vec::new();
        write_report(&self.scenario, &self.study_parts(), &self.manifest, &mut page)?;
        Ok(String::from_utf8_lossy(&page).into_owned())
    }

    /// Writes the report on all cases, or on one and those that share its approach, to a file, whole or not at all.
    fn write_html(&self, path: PathBuf, case: Option<&str>) -> PyResult<()> {
        let parts = self.parts_with(case)?;
        let staged = StagedFile::new(&path, |to| write_report(&self.scenario, &parts, &self.manifest, to));
        staged.and_then(StagedFile::commit).map_err(of_output)
    }

    /// Writes the time series of a case to a CSV file, whole or not at all.
    fn write_csv(&self, case: &str, path: PathBuf) -> PyResult<()> {
        let (part, case) = self.case(case)?;
        let staged = StagedFile::new(&path, |to| write_csv(&part.scenario, &part.computed, case, to));
        staged.and_then(StagedFile::commit).map_err(of_output)
    }
}
