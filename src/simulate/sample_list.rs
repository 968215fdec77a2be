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

/// The largest number of samples of a phase in memory, up to a contact or its end. Figures and the report show these.
pub const MOST_IN_MEMORY: usize = 10_000;

/// Most samples for which memory is taken before they come: an event may end the phase.
const MOST_EXPECTED: usize = 1 << 10;

/// The samples so far.
#[derive(Debug, Default)]
pub(crate) struct SampleList {
    in_memory: Vec<Sample>,
    /// The first of so many samples is kept in memory, less one.
    skipped: usize,
    /// All samples so far; the last of them where it is not in memory.
    count: usize,
    last: Option<Sample>,
    file: Option<SampleWriter>,
    /// The latest, which may yet be discarded.
    latest: Option<Sample>,
}

impl SampleList {
    /// Of a phase that takes so many, if no event ends it.
    pub(crate) fn expecting(count: usize) -> Self {
        Self { in_memory: Vec::with_capacity(count.min(MOST_EXPECTED)), ..Self::default() }
    }

    /// Adds a sample.
    pub(crate) fn push(&mut self, sample: Sample) {
        if let Some(before) = self.latest.replace(sample) {
            self.keep(before);
        }
    }

    /// Discards the latest sample where it is at this time, s, or later, and not the first.
    pub(crate) fn discard_from(&mut self, time: f64) {
        self.latest.take_if(|latest| self.count > 0 && latest.time >= time);
    }

    fn keep(&mut self, sample: Sample) {
        if self.in_memory.len() == MOST_IN_MEMORY {
            self.thin();
        }
        if let Some(file) = &mut self.file {
            file.push(&sample, &[]);
        }
        let keep = self.count.is_multiple_of(self.skipped + 1);
        self.count += 1;
        if keep {
            self.in_memory.push(sample);
            self.last = None;
        } else {
            self.last = Some(sample);
        }
    }

    /// Keeps every other sample in memory, and from now on half as many.
    fn thin(&mut self) {
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
        self.skipped = 2 * self.skipped + 1;
    }

    /// The samples in memory, with the first and the last, and the file of all where these are not all.
    pub(crate) fn end(mut self) -> (Vec<Sample>, Option<SampleFile>) {
        if let Some(latest) = self.latest.take() {
            self.keep(latest);
        }
        let Self { mut in_memory, last, file, .. } = self;
        in_memory.extend(last);
        (in_memory, file.map(SampleWriter::finish))
    }
}
