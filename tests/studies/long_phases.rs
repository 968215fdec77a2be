//! Phases with more samples than are kept in memory: the time series have all of them, figures and report a part.

use crate::{Silent, data_of, report, scenario};
use planar_capture::capture::{CaseResult, Study, study};
use planar_capture::output::console::table;
use planar_capture::output::time_series::write_csv;
use planar_capture::registry;
use planar_capture::scenario::Scenario;
use planar_capture::simulate::Phase;
use planar_capture::simulate::sample_list::MOST_IN_MEMORY;
use std::collections::HashSet;

/// The first case of a scenario with steps of 5 ms and phases of these lengths, in s.
fn long(name: &str, [approach, post_impact]: [f64; 2]) -> Scenario {
    let mut scenario = scenario(name);
    scenario.cases.truncate(1);
    scenario.approach.duration = approach;
    if let Some(after) = &mut scenario.post_impact {
        after.duration = post_impact;
    }
    scenario
}

fn run(scenario: &Scenario, sample: f64) -> Study {
    let model = registry::generated(&scenario.layout).expect("generated code");
    study(scenario, &|| model.clone_box(), sample, &mut Silent).unwrap_or_else(|error| panic!("{error}"))
}

fn csv(scenario: &Scenario, study: &Study) -> Vec<String> {
    let mut text = Vec::new();
    write_csv(scenario, study, &study.cases[0], &mut text).expect("written");
    String::from_utf8(text).expect("UTF-8").lines().map(str::to_owned).collect()
}

fn post_impact(case: &CaseResult) -> &Phase {
    &case.capture.as_ref().expect("a capture").post_impact
}

/// Bit by bit: what is read back from the file is what a run that samples a tenth of it keeps in memory.
#[test]
fn every_sample_of_a_long_phase_is_in_its_time_series() {
    let scenario = long("raina_shah_2017", [60.0, 120.0]);
    let [fine, coarse] = [0.005, 0.05].map(|sample| run(&scenario, sample));
    for (phase, all) in [(&fine.approach, 12_001), (post_impact(&fine.cases[0]), 24_001)] {
        assert_eq!(phase.sample_count(), all);
        let kept = phase.samples.len();
        assert!((MOST_IN_MEMORY / 2..=MOST_IN_MEMORY + 1).contains(&kept), "{kept} are in memory");
    }
    assert_eq!(fine.approach.end(), coarse.approach.end());
    let [fine_rows, coarse_rows] = [&fine, &coarse].map(|study| csv(&scenario, study));
    assert_eq!((fine_rows.len(), coarse_rows.len()), (1 + 12_001 + 24_001, 1 + 1201 + 2401));
    let (approach, after) = fine_rows[1..].split_at(12_001);
    let every_tenth = approach.iter().step_by(10).chain(after.iter().step_by(10));
    for (fine, coarse) in every_tenth.zip(&coarse_rows[1..]) {
        assert_eq!(fine, coarse);
    }
    let said = table(&scenario, &fine);
    assert!(said.contains("approach: figures and report show 6001 of 12001 samples"), "{said}");
    assert!(!table(&scenario, &coarse).contains("figures and report show"), "they show all");
    let approach = &data_of(&report(&scenario, &fine))["parts"][0]["approach"];
    assert_eq!(approach["samples"], 12_001, "the page says how many of them it shows");
    assert_eq!(approach["time"].as_array().map(Vec::len), Some(6001));
}

/// Away from the inertial origin, which a study is not computed about, stored samples have the same positions.
#[test]
fn stored_samples_are_in_the_inertial_frame() {
    let mut scenario = long("raina_shah_2017", [60.0, 60.0]);
    scenario.initial.base_pose = [0.3, 100.0, -50.0];
    let [fine, coarse] = [0.005, 0.05].map(|sample| run(&scenario, sample));
    assert!(fine.approach.sample_count() > fine.approach.samples.len());
    let [fine_rows, coarse_rows] = [&fine, &coarse].map(|study| csv(&scenario, study));
    let (approach, after) = fine_rows[1..].split_at(12_001);
    for (fine, coarse) in approach.iter().step_by(10).chain(after.iter().step_by(10)).zip(&coarse_rows[1..]) {
        assert_eq!(fine, coarse);
    }
}

/// A base torque, and parts of the motion between impacts, of which some are short and some long.
#[test]
fn parts_between_impacts_are_joined() {
    for (name, lengths) in [("elastic_rebound", [20.0, 80.0]), ("stabilised_capture", [20.0, 60.0])] {
        let scenario = long(name, lengths);
        let [fine, coarse] = [0.005, 0.05].map(|sample| run(&scenario, sample));
        let after = post_impact(&fine.cases[0]);
        assert!(after.sample_count() > after.samples.len(), "{name}: some are stored");
        let fine_rows: HashSet<String> = csv(&scenario, &fine).into_iter().collect();
        for row in csv(&scenario, &coarse) {
            assert!(fine_rows.contains(&row), "{name}: {row}");
        }
        let rows = csv(&scenario, &fine);
        assert_eq!(rows.len(), 1 + fine.cases[0].approach(&fine).sample_count() + after.sample_count(), "{name}");
        let times = rows[1..].iter().map(|row| row.split(',').next().expect("a time").parse().expect("a number"));
        let times: Vec<f64> = times.collect();
        assert!(times.is_sorted(), "{name}");
    }
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_has_all_rows() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    let scenario = long("raina_shah_2017", [60.0, 1.0]);
    let study = run(&scenario, 0.005);
    let mut file = tempfile::tempfile().expect("a file");
    planar_capture::output::time_series::write_parquet(
        &scenario,
        &study,
        &study.cases[0],
        &crate::manifest(&scenario),
        &mut file,
    )
    .expect("written");
    let reader = SerializedFileReader::new(file).expect("Parquet");
    assert_eq!(reader.metadata().file_metadata().num_rows(), 12_001 + 201);
}

#[cfg(feature = "mcap")]
#[test]
fn mcap_has_all_rows() {
    let scenario = long("raina_shah_2017", [60.0, 1.0]);
    let study = run(&scenario, 0.005);
    let mut bytes = Vec::new();
    planar_capture::output::mcap::write_mcap(
        &scenario,
        &study,
        &study.cases[0],
        &crate::manifest(&scenario),
        &mut bytes,
    )
    .expect("written");
    let messages = mcap::MessageStream::new(&bytes).expect("MCAP");
    let rows = messages.filter(|message| message.as_ref().expect("a message").channel.topic == "/state");
    assert_eq!(rows.count(), 12_001 + 201);
}
