//! Scenarios from TOML. Every reader notes all that is wrong with its table, so that one report shows it all.

mod actuation;
mod approach;
mod capture;
mod case;
mod case_set;
mod clearance;
mod integration;
mod joints;
mod limits;
mod magnitude;
mod own_law;
mod post_impact;
mod target;

use crate::diagnostic::{DocumentKind, Report, Table, Value, every, read_text, read_text_from};
use crate::frames::{FrameMotion, frames};
use crate::layout::Layout;
use crate::owned::RobotState;
use crate::scenario::{ClearanceRules, FORMAT, Known, Scenario, ScenarioSource, Source, Tracking};
use joints::Joints;
use magnitude::check_distance;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The most steps that one phase may take; more would run for days and fill the disk.
const MOST_STEPS: f64 = 1e8;

impl Scenario {
    /// Reads a scenario file and the layout that it names.
    ///
    /// A layout that ends in `.toml` or contains a `/` is a path relative to the scenario file;
    /// any other is the name of a `shipped` one, given as pairs of name and TOML text, or beside control laws of one's own as
    /// [`Known`].
    ///
    /// # Errors
    /// All that is wrong with the scenario and with the layout file.
    pub fn read<'k>(path: &Path, shipped: impl Into<Known<'k>>) -> Result<Self, Report> {
        Self::read_with_source(path, shipped).map(|(scenario, _)| scenario)
    }

    /// As [`read`](Self::read), with the texts that scenario and layout were read from.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn read_with_source<'k>(path: &Path, shipped: impl Into<Known<'k>>) -> Result<(Self, ScenarioSource), Report> {
        let text = read_text(path, "TOML")?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::from_text(text, path.display().to_string(), folder, shipped)
    }

    /// As [`read_with_source`](Self::read_with_source), from a stream, of this name in messages; a path to a layout is
    /// relative to the working folder.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn read_stream<'k>(
        stream: impl Read,
        name: &str,
        shipped: impl Into<Known<'k>>,
    ) -> Result<(Self, ScenarioSource), Report> {
        let text = read_text_from(stream, name, "TOML")?;
        Self::from_text(text, name.to_owned(), Path::new(""), shipped)
    }

    fn from_text<'k>(
        text: String,
        file: String,
        folder: &Path,
        shipped: impl Into<Known<'k>>,
    ) -> Result<(Self, ScenarioSource), Report> {
        let (scenario, layout) = Self::parse_with_source(&text, &file, folder, shipped)?;
        Ok((scenario, ScenarioSource { scenario: Source { text, file }, layout }))
    }

    /// Reads a scenario from TOML text; `file` is the name that problems are reported under, and
    /// a path to a layout is relative to `folder`.
    ///
    /// # Errors
    /// All that is wrong with the content and with the layout file.
    pub fn parse<'k>(text: &str, file: &str, folder: &Path, shipped: impl Into<Known<'k>>) -> Result<Self, Report> {
        Self::parse_with_source(text, file, folder, shipped).map(|(scenario, _)| scenario)
    }

    /// As [`parse`](Self::parse), with the text that the layout was read from.
    pub(crate) fn parse_with_source<'k>(
        text: &str,
        file: &str,
        folder: &Path,
        shipped: impl Into<Known<'k>>,
    ) -> Result<(Self, Source), Report> {
        let known = shipped.into();
        let read = |root: &Table<'_>| {
            let name = root.file_name("name");
            let (layout, source) =
                root.require("layout").and_then(|value| find_layout(&value, folder, &known.layouts)).unzip();
            let joints = Joints { layout: layout.as_ref() };

            let initial_table = root.table("initial");
            let initial = initial_table.as_ref().and_then(|table| initial_state(table, &joints));
            let start = initial.as_ref().map(|initial| initial.joint_angles.as_slice());
            let approach = root
                .table("approach")
                .and_then(|table| approach::approach(&table, &joints, start, &known.laws.tracking));
            let limits = root.read_or("limits", Vec::new(), |value| limits::joint_limits(&value.table()?, &joints));
            if let (Some(table), Some(initial)) = (&initial_table, &initial) {
                if let Some(value) = table.get("base_pose") {
                    let [_, x, y] = initial.base_pose;
                    check_distance(&value, [x, y], layout.as_ref());
                }
                let from_rest = approach.as_ref().is_some_and(|approach| {
                    approach.tracking == Tracking::InverseDynamics && approach.trajectory.properties().starts_at_rest
                });
                if from_rest && initial.joint_rates.iter().any(|rate| *rate != 0.0) {
                    let why = "exact tracking starts from rest, expected zeros, `tracking = \"pd\"` or \
                               `trajectory = \"quintic\"`";
                    table.reject_keys(&["joint_rates"], why);
                }
                limits::check_initial(table, initial, limits.as_deref().unwrap_or_default());
            }
            let capture = capture::capture(root, layout.as_ref(), name, &known.laws.post_capture)?;
            let clearance = root.read_or("clearance", ClearanceRules::default(), |value| {
                let targets = capture.targets.iter().map(|target| target.name.as_str());
                let bodies = frames(layout.as_ref()?, targets).into_iter();
                let names: Vec<_> = bodies.filter(|f| f.motion != FrameMotion::Fixed).map(|f| f.name).collect();
                clearance::clearance(&value.table()?, &names)
            });
            let mut scenario = Self {
                name: name?.to_owned(),
                layout: layout?,
                initial: initial?,
                joint_limits: limits?,
                approach: approach?,
                targets: capture.targets,
                contact: capture.contact,
                clearance: clearance?,
                cases: capture.cases,
                variants: Vec::new(),
                post_impact: capture.post_impact,
            };
            let layout = source?;
            if !capture.sets.is_empty() {
                let scenario_source = Source { text: text.to_owned(), file: file.to_owned() };
                let source = ScenarioSource { scenario: scenario_source, layout: layout.clone() };
                let variants = capture.sets.iter().map(|set| set.variant(&scenario, &source, &known.laws));
                scenario.variants = every(variants)?;
                scenario.cases.retain(|case| !capture.sets.iter().any(|set| set.index == case.index));
            }
            Some((scenario, layout))
        };
        DocumentKind::Scenario.read(text, file, &FORMAT, read)
    }
}

/// The state at the start; joint angles must be given, all else is zero by default.
fn initial_state(table: &Table<'_>, joints: &Joints<'_>) -> Option<RobotState> {
    let joint_angles = table.require_as("joint_angles", &joints.one_each()).and_then(|value| joints.numbers(&value));
    let base_pose = table.vector("base_pose");
    let base_twist = table.vector("base_twist");
    let joint_rates = table.read_or("joint_rates", joints.repeat(0.0), |value| joints.numbers(value));
    Some(RobotState {
        joint_angles: joint_angles?,
        base_pose: base_pose?,
        base_twist: base_twist?,
        joint_rates: joint_rates?,
    })
}

/// `duration` and `step` of a phase, with a number of steps that can be simulated.
fn duration_and_step(table: &Table<'_>) -> Option<(f64, f64)> {
    let duration = table.number("duration");
    let step = table.number("step");
    let (duration, step) = (duration?, step?);
    let steps = duration / step;
    let why = if steps < 1.0 {
        format!("the step, {step:?} s, must not be longer than the duration, {duration:?} s")
    } else if steps > MOST_STEPS {
        let least = duration / MOST_STEPS;
        format!("{duration:?} s would take {steps:.3e} steps, expected at most 1e8 (step >= {least:?} s)")
    } else {
        return Some((duration, step));
    };
    if let Some(value) = table.get("step").or_else(|| table.get("duration")) {
        value.reject(&why);
    }
    None
}

/// The layout that a scenario names, and the text that it was read from.
fn find_layout(value: &Value<'_>, folder: &Path, shipped: &[(&str, &str)]) -> Option<(Layout, Source)> {
    let name = value.text()?;
    let source = if Layout::is_path(name) {
        // collecting the components drops `./`
        let path: PathBuf = folder.join(name).components().collect();
        read_text(&path, "TOML").map(|text| Source { text, file: path.display().to_string() })
    } else if let Some((_, text)) = shipped.iter().find(|(shipped, _)| *shipped == name) {
        Ok(Source { text: (*text).to_owned(), file: format!("{name}.toml (shipped)") })
    } else {
        let names: Vec<_> = shipped.iter().map(|(name, _)| *name).collect();
        value.expected_one_of(&names, Some("or a path, which ends in `.toml` or contains a `/`"));
        return None;
    };
    let layout = source.and_then(|source| Ok((Layout::parse(&source.text, &source.file)?, source)));
    layout.map_err(|report| value.adopt(report)).ok()
}
