//! A case as an MCAP file for Foxglove and Rerun.
//!
//! | topic | schema | messages |
//! |---|---|---|
//! | `/tf` | `foxglove.FrameTransforms`: all [frames](crate::frames) | every row of the time series |
//! | `/scene` | `foxglove.SceneUpdate`: base, links and targets, each fixed in its frame | at 0 |
//! | `/outlines/FRAME` | `foxglove.PointCloud`: the same as points, for viewers that draw no scenes (Rerun) | at 0 |
//! | `/impulses` | `foxglove.SceneUpdate`: an arrow per contact, shown for a few seconds | every impact |
//! | `/state`, `/tips`, `/momentum`, `/energy`, `/targets` | the columns of the time series, by [group](crate::output::time_series::Column::group) | every row |
//! | `/impact` | impulses, momentum jump and kinetic energies of the exact impact | every impact |
//! | `/log` | `foxglove.Log`: the phase that begins | start of each phase |
//!
//! Messages are protobuf. The metadata of a channel of numbers has the unit of each field; a metadata record
//! `planar_capture` has the origin of the file. `log_time` counts from 0 at the start of the approach, in nanoseconds;
//! the rows before and after an impact have the same.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::mcap::write_mcap;
//! use planar_capture::output::run_manifest::RunManifest;
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let (scenario, source) = Scenario::read_with_source(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let manifest = RunManifest::new(&scenario, source, "planar-capture run".to_owned());
//! let mut recording = Vec::new();
//! write_mcap(&scenario, &study, &study.cases[0], &manifest, &mut recording)?;
//! // a file of this format begins and ends with the same bytes
//! assert!(recording.starts_with(b"\x89MCAP0\r\n") && recording.ends_with(b"\x89MCAP0\r\n"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod impacts;
mod point_cloud;
mod recording;
mod scalar_channel;
mod scene_entities;
mod transforms;

use crate::capture::{CaseResult, Study};
use crate::output::run_manifest::RunManifest;
use crate::output::scene::visuals;
use crate::output::time_series::{Columns, TimeSeriesRow, all_rows, provenance};
use crate::scenario::Scenario;
use foxglove::messages::{Log, log::Level};
use impacts::ImpactChannels;
use recording::Recording;
use scalar_channel::ScalarChannel;
use std::io::{self, Write};

/// Writes one case as MCAP.
///
/// # Errors
/// Those of the writer.
pub fn write_mcap(
    scenario: &Scenario,
    study: &Study,
    case: &CaseResult,
    manifest: &RunManifest,
    to: impl Write,
) -> io::Result<()> {
    let mut recording = Recording::new(to)?;
    recording.metadata("planar_capture", provenance(scenario, case, manifest))?;
    let (frames, visuals) = (scenario.frames(), visuals(scenario));
    let scene = recording.channel("/scene")?;
    recording.log(&scene, 0.0, &scene_entities::solids(&visuals))?;
    for visual in &visuals {
        let outline = recording.channel(&format!("/outlines/{}", visual.frame))?;
        recording.log(&outline, 0.0, &point_cloud::outline(visual))?;
    }
    let (log, tf) = (recording.channel("/log")?, recording.channel("/tf")?);
    let columns = Columns::of(scenario, case);
    let groups = column_groups(&mut recording, &columns)?;
    let arms = &scenario.layout.arms;
    let impacts = case.capture.as_ref().map(|_| ImpactChannels::new(&mut recording, arms)).transpose()?;
    let mut events = crate::output::impacts::impacts(study, case).into_iter().peekable();
    let (mut phase, mut values) = ("", Vec::new());
    for row in all_rows(study, case) {
        let row = row?;
        if row.phase != phase {
            phase = row.phase;
            recording.log(&log, row.time, &phase_begins(&row))?;
        }
        if let (Some(impacts), "post_impact") = (&impacts, phase) {
            while let Some(event) = events.next_if(|event| event.time <= row.time) {
                impacts.log(&mut recording, &event)?;
            }
        }
        recording.log(&tf, row.time, &transforms::transforms(&frames, &row))?;
        columns.values(&row, &mut values);
        for (channel, places) in &groups {
            channel.log(&mut recording, row.time, places.iter().map(|place| values[*place]))?;
        }
    }
    recording.finish()
}

/// A channel for each group of columns, with their places.
fn column_groups(recording: &mut Recording<'_>, columns: &Columns) -> io::Result<Vec<(ScalarChannel, Vec<usize>)>> {
    let mut groups: Vec<(&str, Vec<_>)> = Vec::new();
    for (place, column) in columns.list().iter().enumerate() {
        match groups.iter_mut().find(|(group, _)| *group == column.group) {
            Some((_, members)) => members.push(place),
            None => groups.push((column.group, vec![place])),
        }
    }
    let channel = |(group, places): (&str, Vec<usize>)| {
        let columns = places.iter().map(|place| &columns.list()[*place]);
        let fields: Vec<_> = columns.map(|column| (column.name.as_str(), column.unit)).collect();
        Ok((ScalarChannel::new(recording, group, &fields)?, places))
    };
    groups.into_iter().map(channel).collect()
}

fn phase_begins(row: &TimeSeriesRow<'_>) -> Log {
    Log {
        timestamp: Some(recording::timestamp(row.time)),
        level: Level::Info.into(),
        message: format!("{} begins", row.phase),
        name: "planar-capture".to_owned(),
        ..Log::default()
    }
}
