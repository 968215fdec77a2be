//! A case as an MCAP file, which Foxglove and Rerun open: what moves, and the numbers beside it.
//!
//! | topic | schema | when |
//! |---|---|---|
//! | `/tf` | `foxglove.FrameTransforms` | every row of the time series |
//! | `/scene` | `foxglove.SceneUpdate`: base, links, targets, each fixed in its frame | at 0 |
//! | `/outlines/FRAME` | `foxglove.PointCloud`: the same as points, for viewers that draw no scenes (Rerun) | at 0 |
//! | `/impulses` | `foxglove.SceneUpdate`: an arrow per contact, shown for a while | at each impact |
//! | `/state`, `/end effectors`, `/momentum`, `/energy` | the time series' columns, by [group](crate::output::time_series::Column::group) | every row |
//! | `/impact` | what the exact impact did | at each impact |
//! | `/log` | `foxglove.Log`: which phase begins | at its start |
//!
//! Everything is protobuf. The metadata of a channel of numbers gives the unit of each field; a record `planar_capture`
//! says what the file comes from. Time is `log_time`, from 0 at the start of the approach, to the nearest nanosecond;
//! the two rows at an impact have the same.

mod channel;
mod frames;
mod impact;
mod points;
mod scalars;
mod scene;

use crate::capture::impact::ImpactResult;
use crate::capture::{CaseResult, Study};
use crate::output::scene::frames as scene_frames;
use crate::output::time_series::{Column, TimeSeriesRow, columns, provenance, rows};
use crate::scenario::Scenario;
use channel::Recording;
use foxglove::messages::{Log, log::Level};
use impact::Impacts;
use scalars::Scalars;
use std::io::{self, Write};

/// Writes one case as MCAP.
///
/// # Errors
/// What the writer says.
pub fn write_mcap(scenario: &Scenario, study: &Study, result: &CaseResult, mut to: impl Write) -> io::Result<()> {
    let mut recording = Recording::new()?;
    recording.metadata("planar_capture", provenance(scenario, result))?;
    let (frames, bodies) = (scene_frames(scenario), crate::output::scene::bodies(scenario));
    let scene = recording.channel("/scene")?;
    recording.log(scene, 0.0, &scene::solids(&bodies))?;
    for body in &bodies {
        let outline = recording.channel(&format!("/outlines/{}", body.frame))?;
        recording.log(outline, 0.0, &points::outline(body))?;
    }
    let (log, transforms) = (recording.channel("/log")?, recording.channel("/tf")?);
    let mut series = series(&mut recording, scenario, result)?;
    let arms = &scenario.layout.arms;
    let impacts = result.capture.as_ref().map(|_| Impacts::new(&mut recording, arms)).transpose()?;
    let mut ahead = impacts_of(study, result).peekable();
    let mut phase = "";
    for row in rows(study, result) {
        if row.phase != phase {
            phase = row.phase;
            recording.log(log, row.time, &begins(&row))?;
        }
        if let (Some(impacts), "post_impact") = (&impacts, phase) {
            while let Some((time, impact)) = ahead.next_if(|(time, _)| *time <= row.time) {
                impacts.log(&mut recording, time, impact, &row.sample.end_effector_poses)?;
            }
        }
        recording.log(transforms, row.time, &frames::transforms(&frames, &row))?;
        for series in &mut series {
            series.log(&mut recording, &row)?;
        }
    }
    to.write_all(&recording.finish()?)
}

/// The exact impacts of a case, each with its time since the start of the approach, s.
fn impacts_of<'a>(study: &Study, result: &'a CaseResult) -> impl Iterator<Item = (f64, &'a ImpactResult)> {
    let start = result.approach(study).duration;
    result.capture.iter().flat_map(move |captured| {
        let further = captured.further.iter().map(move |one| (start + one.time, &one.impact.exact));
        std::iter::once((start, &captured.impact.exact)).chain(further)
    })
}

/// The columns of one group, as a channel.
struct Series {
    scalars: Scalars,
    columns: Vec<Column>,
}

impl Series {
    fn log(&mut self, recording: &mut Recording, row: &TimeSeriesRow<'_>) -> io::Result<()> {
        let values = self.columns.iter().map(|column| column.value(row));
        self.scalars.log(recording, row.time, values)
    }
}

fn series(recording: &mut Recording, scenario: &Scenario, result: &CaseResult) -> io::Result<Vec<Series>> {
    let mut groups: Vec<(&str, Vec<_>)> = Vec::new();
    for column in columns(scenario, result) {
        match groups.iter_mut().find(|(group, _)| *group == column.group) {
            Some((_, members)) => members.push(column),
            None => groups.push((column.group, vec![column])),
        }
    }
    let open = |(group, columns): (&str, Vec<Column>)| {
        let fields: Vec<_> = columns.iter().map(|column| (column.name.as_str(), column.unit)).collect();
        Ok(Series { scalars: Scalars::new(recording, group, &fields)?, columns })
    };
    groups.into_iter().map(open).collect()
}

fn begins(row: &TimeSeriesRow<'_>) -> Log {
    Log {
        timestamp: Some(channel::timestamp(row.time)),
        level: Level::Info.into(),
        message: format!("{} begins", row.phase),
        name: "planar-capture".to_owned(),
        ..Log::default()
    }
}
