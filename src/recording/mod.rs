//! A case as an MCAP file, which Foxglove and Rerun open: what moves, and the numbers beside it.
//!
//! | topic | schema | when |
//! |---|---|---|
//! | `/tf` | `foxglove.FrameTransforms` | every row of the time series |
//! | `/scene` | `foxglove.SceneUpdate`: base, links, targets, each fixed in its frame | at 0 |
//! | `/outlines/FRAME` | `foxglove.PointCloud`: the same as points, for viewers that draw no scenes (Rerun) | at 0 |
//! | `/impulses` | `foxglove.SceneUpdate`: an arrow per contact, shown for a while | at the impact |
//! | `/state`, `/tips`, `/momentum`, `/energy` | the time series' columns, by [group](crate::record::Column::group) | every row |
//! | `/impact` | what the exact impact did | at the impact |
//! | `/log` | `foxglove.Log`: which phase begins | at its start |
//!
//! Everything is protobuf. The metadata of a channel of numbers gives the unit of each field; a record `planar_capture`
//! says what the file comes from. Time is `log_time`, from 0 at the start of the approach, to the nearest nanosecond;
//! the two rows at the impact have the same.

mod body;
mod channel;
mod frames;
mod impact;
mod points;
mod scalars;
mod scene;

use crate::record::{Column, Row, columns, provenance, rows};
use crate::scenario::Scenario;
use crate::study::{CaseResult, Study};
use channel::Recording;
use foxglove::messages::{Log, log::Level};
use impact::Impact;
use scalars::Scalars;
use std::io::{self, Write};

/// Writes one case as MCAP.
///
/// # Errors
/// What the writer says.
pub fn write_mcap(scenario: &Scenario, study: &Study, result: &CaseResult, mut to: impl Write) -> io::Result<()> {
    let mut recording = Recording::new()?;
    recording.metadata("planar_capture", provenance(scenario, result))?;
    let bodies = body::bodies(scenario);
    let scene = recording.channel("/scene")?;
    recording.log(scene, 0.0, &scene::solids(&bodies))?;
    for body in &bodies {
        let outline = recording.channel(&format!("/outlines/{}", body.frame))?;
        recording.log(outline, 0.0, &points::outline(body))?;
    }
    let (log, transforms) = (recording.channel("/log")?, recording.channel("/tf")?);
    let mut series = series(&mut recording, scenario, result)?;
    let mut phase = "";
    for row in rows(study, result) {
        if row.phase != phase {
            phase = row.phase;
            recording.log(log, row.time, &begins(&row))?;
            if let (Some(captured), "post_impact") = (&result.capture, phase) {
                Impact { scenario, captured, tips: &row.sample.end_effector_poses }.write(&mut recording, row.time)?;
            }
        }
        recording.log(transforms, row.time, &frames::transforms(scenario, &row))?;
        for series in &mut series {
            series.log(&mut recording, &row)?;
        }
    }
    to.write_all(&recording.finish()?)
}

/// The columns of one group, as a channel.
struct Series {
    scalars: Scalars,
    columns: Vec<Column>,
}

impl Series {
    fn log(&mut self, recording: &mut Recording, row: &Row<'_>) -> io::Result<()> {
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

fn begins(row: &Row<'_>) -> Log {
    Log {
        timestamp: Some(channel::timestamp(row.time)),
        level: Level::Info.into(),
        message: format!("{} begins", row.phase),
        name: "planar-capture".to_owned(),
        ..Log::default()
    }
}
