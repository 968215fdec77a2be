//! From a scenario to its results: approach, capture, post-capture motion, and output files.

#[cfg(not(feature = "all_layouts"))]
compile_error!("the tests see every layout: `cargo test` in the root, without `-p`, or with `--features all_layouts`");

mod audit;
mod clearance;
mod control;
mod convergence;
mod events;
mod far_origin;
mod figures;
mod heavy_target;
mod inverse_kinematics;
mod laws;
mod long_phases;
mod long_steps;
mod maximal_coordinates;
mod outputs;
mod path_error;
mod post_capture_control;
mod redysim;
mod reported;
mod reproduction;
mod resolved_motion_rate;
mod serialized;
mod step_advice;
mod study;
mod table;

use planar_capture::capture::{Silent, Study};
use planar_capture::output::html_report::write_report;
use planar_capture::output::run_manifest::RunManifest;
use planar_capture::output::study_part::StudyPart;
use planar_capture::registry;
use planar_capture::scenario::{Scenario, ScenarioSource, Source};
use planar_proof::file;
use std::borrow::Cow;
use std::process::Command;

/// A shipped scenario.
fn scenario(name: &str) -> Scenario {
    let path = file(&format!("scenarios/{name}.toml"));
    Scenario::read(&path, registry::SHIPPED).unwrap_or_else(|report| panic!("{report}"))
}

/// Runs a scenario with generated code.
fn run(scenario: &Scenario) -> Study {
    let model = registry::generated(&scenario.layout).expect("a shipped layout has generated code");
    let study = planar_capture::capture::study(scenario, &|| model.clone_box(), 0.05, &mut Silent);
    study.unwrap_or_else(|e| panic!("{}: {e}", scenario.name))
}

/// A manifest whose scenario was read from a text of no meaning.
fn manifest(scenario: &Scenario) -> RunManifest {
    let [scenario_text, layout_text] = ["the scenario", &scenario.layout.to_toml()].map(str::to_owned);
    let source = |text| Source { text, file: "a file".to_owned() };
    let source = ScenarioSource { scenario: source(scenario_text), layout: source(layout_text) };
    RunManifest::new(scenario, source, "planar-capture run".to_owned())
}

/// The report on a study.
fn report(scenario: &Scenario, study: &Study) -> String {
    let (study, mut page) = (Cow::Borrowed(study), Vec::new());
    let part = StudyPart { scenario, variant: None, dynamics: "generated", study, manifest: manifest(scenario) };
    write_report(scenario, &[part], &manifest(scenario), &mut page).expect("written");
    String::from_utf8(page).expect("UTF-8")
}

/// What the programs of a report read.
fn data_of(page: &str) -> serde_json::Value {
    let (_, rest) = page.split_once("id=\"data\">").expect("data");
    serde_json::from_str(rest.split_once("</script>").expect("an end").0).expect("JSON")
}

/// The summary of a study.
fn summary(scenario: &Scenario, study: &Study) -> serde_json::Value {
    let summary = planar_capture::output::summary::summary(scenario, "generated", study, &manifest(scenario));
    summary.unwrap_or_else(|error| panic!("{error}"))
}

/// The product.
fn command() -> Command {
    Command::new(env!("CARGO_BIN_EXE_planar-capture"))
}
