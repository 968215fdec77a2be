//! The samples of a phase that are in a file, and all samples of a phase in order.
//!
//! # Example
//! ```
//! use planar_capture::control::ZeroTorque;
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::owned::RobotState;
//! use planar_capture::simulate::stored_samples::PhaseSample;
//! use planar_capture::simulate::{Timing, event::NoEvents, simulate, system::System};
//!
//! let robot = Model::<f64>::default();
//! let (joint_angles, joint_rates) = (vec![0.0; 3], vec![0.0; 3]);
//! let start = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0, 0.1, 0.0], joint_rates };
//! let timing = Timing { duration: 12.0, step: 1e-3, sample: 1e-3, ..Timing::default() };
//! let phase = simulate(&System::alone(&robot), &mut ZeroTorque, &start, &timing, &mut NoEvents, &mut || ())?;
//! let mut from_file = 0;
//! for sample in phase.all_samples() {
//!     let PhaseSample::Stored(sample, _) = sample? else { continue };
//!     assert!((sample.state.base_pose[1] - 0.1 * sample.time).abs() < 1e-9);
//!     from_file += 1;
//! }
//! assert_eq!(from_file, 12_001);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::simulate::sample_file::{SampleFile, SampleWriter};
use crate::simulate::system::Body;
use crate::simulate::translation::translate_bodies;
use crate::simulate::{Phase, Sample};
use crate::state::ActuatorWork;
use std::io;
use std::ops::Range;
use std::sync::Arc;

/// Samples in a file, of which a phase has a part in memory.
#[derive(Clone, Debug)]
pub struct StoredSamples {
    /// Which of the samples in memory are a part of them.
    pub(super) range: Range<usize>,
    file: Arc<SampleFile>,
    /// What is to be added to time and work of each.
    since: (f64, ActuatorWork<f64>),
    /// Position of the origin that they are about, [x, y] in m; `None` for the inertial origin.
    origin: Option<[f64; 2]>,
}

/// Equal where they share the file.
impl PartialEq for StoredSamples {
    fn eq(&self, other: &Self) -> bool {
        let of = |all: &Self| (all.range.clone(), all.since, all.origin);
        Arc::ptr_eq(&self.file, &other.file) && of(self) == of(other)
    }
}

/// One of all samples of a phase.
#[derive(Clone, Debug)]
pub enum PhaseSample<'a> {
    /// The sample of this index in memory.
    InMemory(usize, &'a Sample),
    /// A sample of the file, and the targets then where they were added.
    Stored(Box<Sample>, Vec<Body>),
}

impl StoredSamples {
    /// All samples of a phase, of which it has so many in memory.
    pub(super) fn new(file: SampleFile, in_memory: usize) -> Self {
        Self { range: 0..in_memory, file: Arc::new(file), since: (0.0, ActuatorWork::default()), origin: None }
    }

    /// The same in a phase that starts with another phase.
    pub(super) fn after(self, samples: usize, time: f64, work: &ActuatorWork<f64>) -> Self {
        let range = self.range.start + samples..self.range.end + samples;
        Self { range, since: (time + self.since.0, work.plus(&self.since.1)), ..self }
    }

    /// States the position of the origin that they are about.
    pub(super) fn translate(&mut self, origin: [f64; 2]) {
        self.origin = Some(origin);
    }

    fn samples(&self) -> impl Iterator<Item = io::Result<PhaseSample<'_>>> {
        let (since, before) = self.since;
        self.file.samples().map(move |sample| {
            let (sample, mut targets) = sample?;
            let mut sample = Sample { time: since + sample.time, work: before.plus(&sample.work), ..sample };
            if let Some(origin) = self.origin {
                sample.translate(origin);
                translate_bodies(&mut targets, origin);
            }
            Ok(PhaseSample::Stored(Box::new(sample), targets))
        })
    }

    /// The same file with targets at each sample. A file that cannot be read is left, and reports it when it is read
    /// again.
    fn with_targets(self, targets_at: &dyn Fn(&Sample) -> Vec<Body>) -> Self {
        let mut writer: Option<SampleWriter> = None;
        let add = |sample: io::Result<(Sample, Vec<Body>)>| {
            let (sample, _) = sample?;
            let targets = targets_at(&sample);
            writer.get_or_insert_with(|| SampleWriter::new(&sample, &targets)).push(&sample, &targets);
            io::Result::Ok(())
        };
        let added = self.file.samples().try_for_each(add);
        match writer.filter(|_| added.is_ok()) {
            Some(writer) => Self { file: Arc::new(writer.finish()), ..self },
            None => self,
        }
    }
}

impl Phase {
    /// All samples in order; those that are not in memory are read from the file.
    pub fn all_samples(&self) -> impl Iterator<Item = io::Result<PhaseSample<'_>>> {
        let gaps = self.stored.iter().map(Some).chain([None]);
        let mut from = 0;
        gaps.flat_map(move |stored| {
            let until = stored.map_or(self.samples.len(), |stored| stored.range.start);
            let before = (from..until).map(|i| Ok(PhaseSample::InMemory(i, &self.samples[i])));
            from = stored.map_or(until, |stored| stored.range.end);
            before.chain(stored.into_iter().flat_map(StoredSamples::samples))
        })
    }

    /// The number of all samples.
    #[must_use]
    pub fn sample_count(&self) -> usize {
        self.stored.iter().fold(self.samples.len(), |count, stored| count - stored.range.len() + stored.file.len())
    }

    /// The phase with the targets at each sample that is not in memory.
    #[must_use]
    pub(crate) fn with_targets(self, targets_at: &dyn Fn(&Sample) -> Vec<Body>) -> Self {
        let stored = self.stored.into_iter().map(|stored| stored.with_targets(targets_at)).collect();
        Self { stored, ..self }
    }
}
