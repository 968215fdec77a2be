//! Scenarios, and their studies.

use crate::control::Callable;
use crate::failure::{Failure, of_graph, of_report, with_remedy};
use crate::study::{Part, Study};
use planar_capture::capture::{Silent, StudyError, study_with};
use planar_capture::check::{law_report, study_report};
use planar_capture::engine::Choice;
use planar_capture::laws::{Laws, PostCaptureLaw, TrackingLaw};
use planar_capture::layout::Layout;
use planar_capture::output::run_manifest::RunManifest;
use planar_capture::registry::{Robots, SHIPPED};
use planar_capture::scenario::variation::{KeyPath, Refused, Variation, VariedValue};
use planar_capture::scenario::{Actuation, LawFormats, Scenario as Read, ScenarioSource, Source, Variant};
use planar_capture::simulate::Timing;
use pyo3::prelude::{FromPyObject, Py, PyAny, PyErr, PyResult, Python, pyclass, pymethods};
use std::path::PathBuf;

/// A value of a scenario.
#[derive(FromPyObject)]
enum Value {
    // before numbers, which Python's truth values are, too
    Flag(bool),
    Number(f64),
    Text(String),
}

impl From<Value> for VariedValue {
    fn from(value: Value) -> Self {
        match value {
            Value::Flag(flag) => Self::Flag(flag),
            Value::Number(number) => Self::Number(number),
            Value::Text(text) => Self::Text(text),
        }
    }
}

/// A scenario.
#[pyclass(frozen, module = "planar_capture._native")]
pub struct Scenario {
    scenario: Read,
    source: ScenarioSource,
}

/// What computes a layout, by the name of an engine or `auto`; with a warning where a graph cannot be used.
pub fn choose(dynamics: &str, layout: &Layout) -> PyResult<(Choice, Option<String>)> {
    let choice = match dynamics {
        "auto" => {
            let (choice, unusable) = Choice::fastest(layout, Robots::SHIPPED);
            return Ok((choice, unusable.as_ref().map(with_remedy)));
        }
        "generated" => Choice::generated(layout, Robots::SHIPPED).map_err(|error| Failure::Input.with(error)),
        "graph" => Choice::graph(layout).map_err(|error| of_graph(&error)),
        "generic" => Ok(Choice::generic()),
        other => {
            let known = "expected auto, generated, graph or generic";
            Err(Failure::Input.with(format!("dynamics is `{other}`, {known}")))
        }
    };
    Ok((choice?, None))
}

/// After the name of a file, of which a text with other values was made.
const WITH: &str = ", with other values";

/// Why values are refused, by their keys: a user has not seen the text that has them.
fn of_values(refused: Refused, keys: &[(KeyPath, VariedValue)]) -> String {
    let shown = |(path, value): &(KeyPath, VariedValue)| format!("`{path}` = {value}");
    match refused {
        Refused::Keys(unusable) => {
            let lines = unusable.into_iter().map(|of| format!("key {}: {}", shown(&keys[of.key]), of.why));
            lines.collect::<Vec<_>>().join("\n")
        }
        Refused::Together(why) => {
            format!("keys {}: together, {why}", keys.iter().map(shown).collect::<Vec<_>>().join(", "))
        }
        Refused::Without(why) => format!("the case alone has no scenario: {why}"),
    }
}

impl Scenario {
    /// Holds the torques of the laws that are given for this long, s.
    fn sampled(scenario: &Read, sample_time: Option<f64>, [approach, after]: [bool; 2]) -> PyResult<Read> {
        let mut scenario = scenario.clone();
        let set = |table: &str, timing: Timing, actuation: &mut Actuation| -> PyResult<()> {
            let step = timing.step_length();
            let Some(time) = sample_time else {
                return match actuation.steps_per_sample {
                    Some(_) => Ok(()),
                    None => Err(Failure::Input.with(format!(
                        "a controller in Python is called once per sample, and `{table}` has no `sample_time`: give it \
                         there, or call run(…, sample_time=…) with a multiple of the step, {step:?} s"
                    ))),
                };
            };
            let other = || {
                Failure::Input.with(format!(
                    "sample_time is {time:?} s, expected a multiple of the step of `{table}`, {step:?} s"
                ))
            };
            actuation.steps_per_sample = Some(timing.whole_steps(time).ok_or_else(other)?);
            Ok(())
        };
        if approach {
            let approach = &mut scenario.approach;
            set("approach", Timing::of_steps(approach.duration, approach.step), &mut approach.actuation)?;
        }
        if let Some(phase) = scenario.post_impact.as_mut().filter(|_| after) {
            set("post_impact", Timing::of_steps(phase.duration, phase.step), &mut phase.actuation)?;
        }
        Ok(scenario)
    }

    /// A study without a result: where one of the laws broke it down, as the law's; else at its key in the scenario.
    fn without_result(&self, error: &StudyError, scenario: &Read, variant: Option<&Variant>, laws: Laws<'_>) -> PyErr {
        let report = law_report(error, scenario, laws)
            .unwrap_or_else(|| study_report(error, scenario, variant, &self.source.scenario));
        let failure = if error.is_breakdown() { Failure::Computation } else { Failure::Input };
        failure.with(report.render(false))
    }
}

#[pymethods]
impl Scenario {
    /// From a file.
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        let (scenario, source) = Read::read_with_source(&path, SHIPPED).map_err(of_report)?;
        Ok(Self { scenario, source })
    }

    /// From a TOML text, which is called `file` in messages; paths in it are relative to the working folder.
    #[staticmethod]
    fn parse(text: &str, file: &str) -> PyResult<Self> {
        let (scenario, source) = Read::read_stream(text.as_bytes(), file, SHIPPED).map_err(of_report)?;
        Ok(Self { scenario, source })
    }

    /// The scenario of one case, by default the only one, with these values at keys of sweeps.
    fn with_values(&self, values: Vec<(String, Value)>, case: Option<&str>) -> PyResult<Self> {
        let names = self.scenario.case_names();
        let case = match (case, &names[..]) {
            (Some(case), names) if names.contains(&case) => case,
            (None, [only]) => only,
            (found, names) => {
                let found = found.map_or("case is missing".to_owned(), |case| format!("case is `{case}`"));
                let message = format!("{found}, expected one of the scenario's cases, {}", names.join(", "));
                return Err(Failure::Input.with(message));
            }
        };
        // a case with values of its own is a scenario with these
        let own = self.scenario.variant(case);
        let own = own.map(|own| (&own.scenario, own.sources([&self.source.scenario, &self.source.layout])));
        let (scenario, source) = own.as_ref().map_or((&self.scenario, &self.source), |(own, source)| (*own, source));
        let keys = values.into_iter().map(|(key, value)| {
            let path = KeyPath::parse(&key).map_err(|why| Failure::Input.with(format!("key `{key}`: {why}")))?;
            Ok((path, value.into()))
        });
        let keys: Vec<(KeyPath, VariedValue)> = keys.collect::<PyResult<_>>()?;
        let (scenario, texts) = Variation::apply(scenario, source, case, &LawFormats::default(), &keys)
            .map_err(|refused| Failure::Input.with(of_values(refused, &keys)))?;
        // what is wrong later is shown in this text, which is not that of the file
        let with = |text, of: &Source| Source { text, file: format!("{}{WITH}", of.file.trim_end_matches(WITH)) };
        let source = ScenarioSource {
            scenario: with(texts.scenario, &source.scenario),
            layout: with(texts.layout, &source.layout),
        };
        Ok(Self { scenario, source })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.scenario.name
    }

    #[getter]
    fn text(&self) -> &str {
        &self.source.scenario.text
    }

    #[getter]
    fn layout(&self) -> String {
        self.scenario.layout.to_toml()
    }

    #[getter]
    fn cases(&self) -> Vec<&str> {
        self.scenario.case_names()
    }

    #[getter]
    fn targets(&self) -> Vec<&str> {
        self.scenario.targets.iter().map(|target| target.name.as_str()).collect()
    }

    #[getter]
    fn joints(&self) -> usize {
        self.scenario.layout.joints()
    }

    /// Computes the study.
    #[allow(clippy::too_many_arguments, reason = "keyword arguments for the one caller in Python")]
    fn run(
        &self,
        py: Python<'_>,
        control: Option<Py<PyAny>>,
        post_capture: Option<Py<PyAny>>,
        sample: f64,
        sample_time: Option<f64>,
        dynamics: &str,
        command: String,
    ) -> PyResult<Study> {
        if !(sample.is_finite() && sample > 0.0) {
            return Err(Failure::Input.with(format!("sample is {sample:?}, expected a time greater than 0 s")));
        }
        let [control, post_capture] = [control, post_capture].map(|law| law.map(Callable::new));
        let of_python = [control.is_some(), post_capture.is_some()];
        let (of_scenario, warning) = choose(dynamics, &self.scenario.layout)?;
        let mut warnings: Vec<String> = warning.into_iter().collect();
        let mut chosen = Vec::new();
        for (scenario, variant) in self.scenario.parts() {
            let choice = if variant.is_some() {
                let (choice, warning) = choose(dynamics, &scenario.layout)?;
                warnings.extend(warning.filter(|warning| !warnings.contains(warning)));
                choice
            } else {
                of_scenario.clone()
            };
            chosen.push((Self::sampled(scenario, sample_time, of_python)?, variant, choice));
        }
        let laws = || Laws {
            tracking: control.as_ref().map(|law| law as &dyn TrackingLaw),
            post_capture: post_capture.as_ref().map(|law| law as &dyn PostCaptureLaw),
        };
        let mut parts = Vec::new();
        for (scenario, variant, choice) in chosen {
            let study = py.detach(|| {
                let model = choice.model(&scenario.layout);
                study_with(&scenario, &|| model.clone_box(), laws(), sample, &mut Silent)
            });
            // a law may end a study that has a result all the same, where a search takes another way around it
            if let Some(raised) = [&control, &post_capture].into_iter().flatten().find_map(Callable::raised) {
                return Err(raised);
            }
            let computed = study.map_err(|error| self.without_result(&error, &scenario, variant, laws()))?;
            parts.push(Part { scenario, computed, engine: choice.engine });
        }
        let scenario = self.scenario.clone();
        let manifest = RunManifest::new(&scenario, self.source.clone(), command);
        let warning = (!warnings.is_empty()).then(|| warnings.join("\n"));
        Ok(Study { scenario, parts, manifest, engine: of_scenario.engine, warning })
    }
}
