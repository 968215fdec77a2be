//! Whole studies in memory: the paper's, from its scenario to the samples of all phases.

use crate::Problem;
use crate::clock::Clock;
use crate::measure::consume;
use planar_capture::capture::{Silent, Study, StudyError, study};
use planar_capture::registry;
use planar_capture::scenario::{FinalRates, Scenario};
use std::path::Path;

/// Times studies: as it is shipped, by fixed steps; by adaptive ones; and of the latter one case alone, whose end rates are given.
pub fn all(clock: &mut impl Clock) -> Result<(), Problem> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let text = std::fs::read_to_string(folder.join("raina_shah_2017.toml"))?;
    let scenario = |text: &str| {
        let parsed = Scenario::parse(text, "raina_shah_2017.toml", &folder, registry::SHIPPED);
        parsed.map_err(|report| report.to_string())
    };
    let shipped = scenario(&text)?;
    let lines = text.lines().filter(|line| !line.starts_with("integrator")).collect::<Vec<_>>().join("\n");
    let adaptive = |step: &str| scenario(&lines.replace("step = 0.005", step));
    let mut one = adaptive("step = 0.5")?;
    one.cases.truncate(1);
    one.approach.end = FinalRates::JointRates(run(&one, 0.5)?.terminal_rates.ok_or("no end rates")?.joint_rates);
    let adaptive = adaptive("step = 0.05")?;
    for (name, scenario, sample) in
        [("study, fixed steps", &shipped, 0.05), ("study, adaptive", &adaptive, 0.05), ("study, one case", &one, 0.5)]
    {
        clock.each(name, 1, &[()], |()| consume(run(scenario, sample).expect("the shipped study has results")));
    }
    Ok(())
}

/// Without files, samples so many seconds apart.
fn run(scenario: &Scenario, sample: f64) -> Result<Study, StudyError> {
    let model = registry::generated(&scenario.layout).expect("compiled code of the paper's robot");
    study(scenario, &|| model.clone_box(), sample, &mut Silent)
}
