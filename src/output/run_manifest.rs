//! The manifest of a run: what it was made of, by which program and command. All files of a run share it.
//!
//! # Example
//! ```
//! use planar_capture::output::run_manifest::RunManifest;
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/raina_shah_2017.toml";
//! let (scenario, source) = Scenario::read_with_source(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let manifest = RunManifest::new(&scenario, source, format!("planar-capture run {path}"));
//! // 20 s, then 50 s, by steps of 5 ms
//! let phases: Vec<_> = manifest.phases.iter().map(|phase| (phase.integrator, phase.steps)).collect();
//! assert_eq!(phases, [("rk4", 4_000), ("rk4", 10_000)]);
//! assert_eq!(manifest.to_json()["steps"]["post_impact"], 10_000);
//! ```

use crate::layout::sha256;
use crate::scenario::{LawNumbers, Scenario, ScenarioSource, Variant};
use crate::simulate::Timing;
use crate::simulate::stepper::Integration;
use serde_json::{Map, Value, json};

/// The cargo features of this build, sorted; set by the build script.
const FEATURES: &str = env!("PLANAR_CAPTURE_FEATURES");

/// Origin of the results of one run. It has no time and no machine in it: equal runs have equal manifests.
#[derive(Clone, Debug, PartialEq)]
pub struct RunManifest {
    /// As the user typed it.
    pub command: String,
    /// TOML text of the scenario.
    pub scenario_toml: String,
    /// TOML text of its layout.
    pub layout_toml: String,
    /// Content hash of the layout.
    pub layout_sha256: String,
    /// Of each phase that the scenario has.
    pub phases: Vec<PhaseManifest>,
    /// Control laws of the program's own.
    pub laws: Vec<LawManifest>,
}

/// A control law of the program's own.
#[derive(Clone, Debug, PartialEq)]
pub struct LawManifest {
    /// `approach` or `post_impact`.
    pub phase: &'static str,
    /// As in the scenario.
    pub name: &'static str,
    /// Given or default.
    pub numbers: LawNumbers,
}

/// How one phase is integrated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PhaseManifest {
    /// `approach` or `post_impact`.
    pub phase: &'static str,
    /// The integrator's name.
    pub integrator: &'static str,
    /// Number of steps, or with adaptive steps of audits, of a phase that no contact ends.
    pub steps: u64,
}

impl PhaseManifest {
    fn new(phase: &'static str, [duration, step]: [f64; 2], integration: Integration) -> Self {
        let steps = Timing { duration, step, ..Timing::default() }.steps();
        Self { phase, integrator: integration.integrator.properties().name, steps }
    }
}

fn laws(scenario: &Scenario) -> Vec<LawManifest> {
    let laws = ["approach", "post_impact"].into_iter().zip(scenario.own_laws());
    let law = |(phase, law): (_, Option<(_, &LawNumbers)>)| {
        law.map(|(name, numbers)| LawManifest { phase, name, numbers: numbers.clone() })
    };
    laws.filter_map(law).collect()
}

fn phases(scenario: &Scenario) -> Vec<PhaseManifest> {
    let approach = &scenario.approach;
    let before = PhaseManifest::new("approach", [approach.duration, approach.step], approach.integration);
    let after = scenario.post_impact.as_ref();
    let after = after.map(|after| PhaseManifest::new("post_impact", [after.duration, after.step], after.integration));
    std::iter::once(before).chain(after).collect()
}

impl RunManifest {
    /// Of a scenario, the texts that it was read from, and the command that runs it.
    #[must_use]
    pub fn new(scenario: &Scenario, source: ScenarioSource, command: String) -> Self {
        Self {
            command,
            scenario_toml: source.scenario.text,
            layout_toml: source.layout.text,
            layout_sha256: scenario.layout.sha256(),
            phases: phases(scenario),
            laws: laws(scenario),
        }
    }

    /// That of a part of the same run: of a case with values of its own, with its layout and its phases.
    #[must_use]
    pub fn of_part(&self, variant: Option<&Variant>) -> Self {
        let Some(Variant { scenario, texts: [_, layout], .. }) = variant else { return self.clone() };
        Self {
            layout_toml: layout.clone(),
            layout_sha256: scenario.layout.sha256(),
            phases: phases(scenario),
            laws: laws(scenario),
            ..self.clone()
        }
    }

    /// What a case with values of its own has in the summary: how it was computed, where others may have it otherwise.
    #[must_use]
    pub fn to_json_of_case(&self, dynamics: &str) -> Value {
        let mut value = self.to_json();
        if let Value::Object(entries) = &mut value {
            entries.retain(|key, _| ["layout_sha256", "integrator", "steps", "laws"].contains(&key.as_str()));
        }
        value["dynamics"] = json!(dynamics);
        value
    }

    /// Hash of the scenario's text.
    #[must_use]
    pub fn scenario_sha256(&self) -> String {
        sha256(&self.scenario_toml)
    }

    /// Its keys and values.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let of_phases = |value: &dyn Fn(&PhaseManifest) -> Value| -> Map<String, Value> {
            self.phases.iter().map(|phase| (phase.phase.to_owned(), value(phase))).collect()
        };
        let mut value = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "command": self.command,
            "scenario_sha256": self.scenario_sha256(),
            "layout_sha256": self.layout_sha256,
            "integrator": of_phases(&|phase| json!(phase.integrator)),
            "steps": of_phases(&|phase| json!(phase.steps)),
            "features": FEATURES.split_terminator(',').collect::<Vec<_>>(),
            "scenario_toml": self.scenario_toml,
            "layout_toml": self.layout_toml,
        });
        for LawManifest { phase, name, numbers } in &self.laws {
            let numbers: Map<String, Value> =
                numbers.iter().map(|(key, number)| (key.to_owned(), json!(number))).collect();
            value["laws"][phase] = json!({"name": name, "numbers": numbers});
        }
        value
    }

    /// The same for the metadata of a file, as texts; what is no text is JSON.
    #[must_use]
    pub fn entries(&self) -> Vec<(String, String)> {
        let Value::Object(entries) = self.to_json() else { return Vec::new() };
        let text = |value: Value| match value {
            Value::String(text) => text,
            other => other.to_string(),
        };
        entries.into_iter().map(|(key, value)| (key, text(value))).collect()
    }
}
