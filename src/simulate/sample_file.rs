//! All samples of a long phase in a temporary file, so that memory does not grow with the duration.
//!
//! The file has no name: it is gone when the process ends, however it ends. A disk that is full is reported by those who
//! read the samples.

use crate::dynamics::Momentum;
use crate::owned::RobotState;
use crate::simulate::Sample;
use crate::simulate::knots::{again, in_folder, temporary_file};
use crate::simulate::system::Body;
use crate::state::ActuatorWork;
use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::sync::{Mutex, PoisonError};

/// Bytes that are read at a time.
const BUFFER: usize = 1 << 16;

/// Numbers of a sample that do not depend on the robot: time, base, momentum, work, base torque and whether there is one.
const FIXED: usize = 1 + 6 + 4 + 3 + 2;

/// Lengths of the lists of a sample; all samples of a file have the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Lengths {
    joints: usize,
    arms: usize,
    bodies: usize,
    targets: usize,
}

impl Lengths {
    fn of(sample: &Sample, targets: &[Body]) -> Self {
        Self {
            joints: sample.joint_torques.len(),
            arms: sample.end_effector_poses.len(),
            bodies: sample.bodies.len(),
            targets: targets.len(),
        }
    }

    /// Bytes of a record.
    fn bytes(self) -> usize {
        8 * (FIXED + 3 * self.joints + 6 * self.arms + 8 * (self.bodies + self.targets))
    }
}

/// Writes the samples of a phase, in order of time, each with the targets at its time or with none.
#[derive(Debug)]
pub(crate) struct SampleWriter {
    lengths: Lengths,
    to: io::Result<BufWriter<File>>,
    count: usize,
}

impl SampleWriter {
    /// For samples like this one.
    pub(crate) fn new(like: &Sample, targets: &[Body]) -> Self {
        let to = temporary_file().map(|file| BufWriter::with_capacity(BUFFER, file));
        Self { lengths: Lengths::of(like, targets), to, count: 0 }
    }

    /// Adds a sample.
    pub(crate) fn push(&mut self, sample: &Sample, targets: &[Body]) {
        debug_assert_eq!(self.lengths, Lengths::of(sample, targets));
        self.count += 1;
        if let Ok(to) = &mut self.to
            && let Err(error) = to.write_all(&record(sample, targets))
        {
            self.to = Err(in_folder(&error));
        }
    }

    /// Ends the file.
    pub(crate) fn finish(self) -> SampleFile {
        let Self { lengths, to, count } = self;
        let file = to.and_then(|to| to.into_inner().map_err(|error| in_folder(error.error())));
        SampleFile { lengths, file: file.map(Mutex::new), count }
    }
}

/// The samples of a phase in a file.
#[derive(Debug)]
pub struct SampleFile {
    lengths: Lengths,
    /// Or why it could not be written.
    file: io::Result<Mutex<File>>,
    count: usize,
}

impl SampleFile {
    /// The number of samples.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// The samples in order, each with its targets.
    pub(crate) fn samples(&self) -> impl Iterator<Item = io::Result<(Sample, Vec<Body>)>> {
        let size = self.lengths.bytes();
        let in_buffer = (BUFFER / size).max(1);
        (0..self.count).step_by(in_buffer).flat_map(move |first| {
            let count = in_buffer.min(self.count - first);
            let (bytes, failed) = match self.read(first * size, count * size) {
                Ok(bytes) => (bytes, None),
                Err(error) => (Vec::new(), Some(Err(error))),
            };
            let samples = (0..bytes.len() / size).map(move |i| Ok(sample(&bytes[i * size..][..size], self.lengths)));
            samples.chain(failed)
        })
    }

    fn read(&self, from: usize, length: usize) -> io::Result<Vec<u8>> {
        let file = self.file.as_ref().map_err(again)?;
        let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
        let mut bytes = vec![0; length];
        file.seek(SeekFrom::Start(from as u64))?;
        file.read_exact(&mut bytes)?;
        Ok(bytes)
    }
}

/// The numbers of a sample and its targets.
fn record(sample: &Sample, targets: &[Body]) -> Vec<u8> {
    let Sample { time, state, joint_torques, end_effector_poses, end_effector_twists, momentum, work, .. } = sample;
    let Momentum { linear_momentum: [px, py], angular_momentum, kinetic_energy } = *momentum;
    let torque = [sample.base_torque.unwrap_or_default(), f64::from(u8::from(sample.base_torque.is_some()))];
    let of_body = |body: &Body| {
        let [[yaw, x, y], [omega, vx, vy]] = [body.pose, body.twist];
        [body.mass, body.inertia, yaw, x, y, omega, vx, vy]
    };
    let numbers = [*time]
        .into_iter()
        .chain(state.base_pose)
        .chain(state.base_twist)
        .chain([px, py, angular_momentum, kinetic_energy])
        .chain([work.joint_work, work.base_work, work.base_impulse])
        .chain(torque)
        .chain(state.joint_angles.iter().copied())
        .chain(state.joint_rates.iter().copied())
        .chain(joint_torques.iter().copied())
        .chain(end_effector_poses.iter().flatten().copied())
        .chain(end_effector_twists.iter().flatten().copied())
        .chain(sample.bodies.iter().chain(targets).flat_map(of_body));
    numbers.flat_map(f64::to_le_bytes).collect()
}

/// The sample and the targets of a [`record`] of these lengths.
fn sample(record: &[u8], lengths: Lengths) -> (Sample, Vec<Body>) {
    let mut numbers = record.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes));
    // a record has as many numbers as its lengths say
    let mut next = move || numbers.next().unwrap_or(f64::NAN);
    let time = next();
    let [base_pose, base_twist] = [(); 2].map(|()| triple(&mut next));
    let linear_momentum = [next(), next()];
    let momentum = Momentum { linear_momentum, angular_momentum: next(), kinetic_energy: next() };
    let work = ActuatorWork { joint_work: next(), base_work: next(), base_impulse: next() };
    let (torque, has_torque) = (next(), next() > 0.0);
    let Lengths { joints, arms, bodies, targets } = lengths;
    let [joint_angles, joint_rates, joint_torques] = [(); 3].map(|()| (0..joints).map(|_| next()).collect::<Vec<_>>());
    let [end_effector_poses, end_effector_twists] =
        [(); 2].map(|()| (0..arms).map(|_| triple(&mut next)).collect::<Vec<_>>());
    let mut body = || Body { mass: next(), inertia: next(), pose: triple(&mut next), twist: triple(&mut next) };
    let bodies = (0..bodies).map(|_| body()).collect();
    let targets = (0..targets).map(|_| body()).collect();
    let state = RobotState { joint_angles, base_pose, base_twist, joint_rates };
    let base_torque = has_torque.then_some(torque);
    let sample = Sample {
        time,
        state,
        joint_torques,
        end_effector_poses,
        end_effector_twists,
        momentum,
        work,
        base_torque,
        bodies,
    };
    (sample, targets)
}

fn triple(next: &mut impl FnMut() -> f64) -> [f64; 3] {
    [next(), next(), next()]
}
