//! The samples of a phase while it runs: all of them in memory, or of a long phase all in a file and a part in memory.
//!
//! # Example
//! ```
//! use planar_capture::control::ZeroTorque;
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::owned::RobotState;
//! use planar_capture::simulate::sample_list::MOST_IN_MEMORY;
//! use planar_capture::simulate::{Timing, event::NoEvents, simulate, system::System};
//!
//! let robot = Model::<f64>::default();
//! let (joint_angles, joint_rates) = (vec![0.0; 3], vec![0.0; 3]);
//! let start = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0, 0.1, 0.0], joint_rates };
//! let timing = Timing { duration: 12.0, step: 1e-3, sample: 1e-3, ..Timing::default() };
//! let phase = simulate(&System::alone(&robot), &mut ZeroTorque, &start, &timing, &mut NoEvents, &mut || ())?;
//! // every other sample is in memory, all are in the file
//! assert_eq!((phase.sample_count(), phase.samples.len()), (12_001, 6_001));
//! assert!(phase.samples.len() <= MOST_IN_MEMORY);
//! # Ok::<(), planar_capture::simulate::PhaseError>(())
//! ```

use crate::simulate::Sample;
use crate::simulate::sample_file::{SampleFile, SampleWriter};
use std::mem;

/// The largest number of samples of a phase in memory, up to a contact or its end. Figures and the report show these.
pub const MOST_IN_MEMORY: usize = 10_000;

/// Most samples for which memory is taken before they come: an event may end the phase.
const MOST_EXPECTED: usize = 1 << 10;

/// The samples so far.
#[derive(Debug, Default)]
pub(crate) struct SampleList {
    /// The latest, which may yet be discarded, is the last of them.
    in_memory: Vec<Sample>,
    has_latest: bool,
    /// The first of so many samples is kept in memory, less one.
    skipped: usize,
    /// All samples before the latest; the last of these where it is not in memory.
    count: usize,
    last: Option<Sample>,
    file: Option<SampleWriter>,
}

impl SampleList {
    /// Of a phase that takes so many, if no event ends it.
    pub(crate) fn expecting(count: usize) -> Self {
        Self { in_memory: Vec::with_capacity(count.min(MOST_EXPECTED)), ..Self::default() }
    }

    /// Adds a sample.
    pub(crate) fn push(&mut self, sample: Sample) {
        self.keep_latest();
        self.in_memory.push(sample);
        self.has_latest = true;
    }

    /// Discards the latest sample where it is at this time, s, or later, and not the first.
    pub(crate) fn discard_from(&mut self, time: f64) {
        let is_to_go = |latest: &mut Sample| latest.time >= time;
        if self.has_latest && self.count > 0 && self.in_memory.pop_if(is_to_go).is_some() {
            self.has_latest = false;
        }
    }

    /// The latest is to stay: in memory, or as the last one.
    fn keep_latest(&mut self) {
        if !mem::take(&mut self.has_latest) {
            return;
        }
        if self.in_memory.len() > MOST_IN_MEMORY {
            self.thin();
        }
        if let (Some(file), Some(latest)) = (&mut self.file, self.in_memory.last()) {
            file.push(latest, &[]);
        }
        let stays = self.count.is_multiple_of(self.skipped + 1);
        self.last = if stays { None } else { self.in_memory.pop() };
        self.count += 1;
    }

    /// Keeps every other sample in memory before the latest, and from now on half as many.
    fn thin(&mut self) {
        let latest = self.in_memory.pop();
        if self.file.is_none() {
            let mut file = SampleWriter::new(&self.in_memory[0], &[]);
            self.in_memory.iter().for_each(|sample| file.push(sample, &[]));
            self.file = Some(file);
        }
        let mut i = 0;
        self.in_memory.retain(|_| {
            i += 1;
            i % 2 == 1
        });
        self.in_memory.extend(latest);
        self.skipped = 2 * self.skipped + 1;
    }

    /// The samples in memory, with the first and the last, and the file of all where these are not all.
    pub(crate) fn end(mut self) -> (Vec<Sample>, Option<SampleFile>) {
        self.keep_latest();
        let Self { mut in_memory, last, file, .. } = self;
        in_memory.extend(last);
        (in_memory, file.map(SampleWriter::finish))
    }
}
