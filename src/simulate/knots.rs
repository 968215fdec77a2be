//! The knots of a path: the latest in memory, those before them in a temporary file without a name, so that memory does
//! not grow with the duration.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::sync::{Arc, Mutex, PoisonError};

/// With more numbers than these in memory, all but the last knot go to the file.
const MOST_IN_MEMORY: usize = 1 << 16;

/// Knots in order of time: each a time and the state then, all of one length.
#[derive(Clone, Debug, Default)]
pub(super) struct Knots {
    in_memory: Vec<f64>,
    /// How many numbers are in the file.
    stored: usize,
    /// Or why it could not be written, which those who read the knots report.
    file: Option<Arc<Mutex<io::Result<File>>>>,
}

/// Equal where they share the file.
impl PartialEq for Knots {
    fn eq(&self, other: &Self) -> bool {
        let file = |knots: &Self| knots.file.as_ref().map(Arc::as_ptr);
        self.in_memory == other.in_memory && file(self) == file(other)
    }
}

impl Knots {
    /// With memory for so many numbers, as far as they would be in memory.
    pub(super) fn expecting(numbers: usize) -> Self {
        Self { in_memory: Vec::with_capacity(numbers.min(MOST_IN_MEMORY)), ..Self::default() }
    }

    /// Adds a knot.
    pub(super) fn push(&mut self, time: f64, state: &[f64]) {
        if self.in_memory.len() > MOST_IN_MEMORY {
            self.store(self.in_memory.len() - (1 + state.len()));
        }
        self.in_memory.push(time);
        self.in_memory.extend_from_slice(state);
    }

    /// The last knot, of this many numbers.
    pub(super) fn last(&self, length: usize) -> Option<(f64, &[f64])> {
        let start = self.in_memory.len().checked_sub(length)?;
        let (time, state) = self.in_memory[start..].split_first()?;
        Some((*time, state))
    }

    /// Calls `visit` with this many knots and the next one, from which the next visit goes on; each knot of `length` numbers.
    /// Fewer come where there are no more, in memory or in a block of the file.
    pub(super) fn try_for_each_window<E: From<io::Error>>(
        &self,
        length: usize,
        count: usize,
        mut visit: impl FnMut(&[f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut visit_all = |knots: &[f64]| {
            let last = (knots.len() / length).saturating_sub(1);
            let starts = (0..last).step_by(count);
            starts.into_iter().try_for_each(|from| visit(&knots[length * from..length * (last.min(from + count) + 1)]))
        };
        if self.stored == 0 {
            return visit_all(&self.in_memory);
        }
        let mut window = Vec::new();
        let block = MOST_IN_MEMORY.next_multiple_of(length);
        for from in (0..self.stored).step_by(block) {
            self.read(from, block.min(self.stored - from), &mut window)?;
            visit_all(&window)?;
            window.drain(..window.len() - length);
        }
        window.extend_from_slice(&self.in_memory);
        visit_all(&window)
    }

    /// Moves the first `count` numbers in memory to the file.
    fn store(&mut self, count: usize) {
        let file = self.file.get_or_insert_with(|| Arc::new(Mutex::new(temporary_file())));
        let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
        let bytes: Vec<u8> = self.in_memory.drain(..count).flat_map(f64::to_le_bytes).collect();
        self.stored += count;
        if let Ok(to) = &mut *file
            && let Err(error) = to.write_all(&bytes)
        {
            *file = Err(in_folder(&error));
        }
    }

    /// Adds numbers of the file to a list.
    fn read(&self, from: usize, count: usize, to: &mut Vec<f64>) -> io::Result<()> {
        let Some(file) = &self.file else { return Ok(()) };
        let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
        let file = file.as_mut().map_err(|error| again(error))?;
        let mut bytes = vec![0; 8 * count];
        file.seek(SeekFrom::Start(8 * from as u64))?;
        file.read_exact(&mut bytes)?;
        to.extend(bytes.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)));
        Ok(())
    }
}

/// A file without a name.
pub(super) fn temporary_file() -> io::Result<File> {
    tempfile::tempfile().map_err(|error| in_folder(&error))
}

/// An error of a temporary file, with the folder that the system has for these.
pub(super) fn in_folder(error: &io::Error) -> io::Error {
    let folder = std::env::temp_dir();
    let text = format!("{error}: the folder for temporary files is {} (`TMPDIR`)", folder.display());
    io::Error::new(error.kind(), text)
}

/// The same error once more.
pub(super) fn again(error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the number of numbers of a knot is.
    fn check_stored<const N: usize>(count: u32) {
        let mut knots = Knots::default();
        let knot = |i: u32| -> [f64; N] {
            std::array::from_fn(|k| f64::from(i) + f64::from(i * 7).sin() * [0.0, 1.0, 2.0, 3.0, 4.0][k])
        };
        for i in 0..count {
            let numbers = knot(i);
            knots.push(numbers[0], &numbers[1..]);
            assert_eq!(knots.last(N), Some((numbers[0], &numbers[1..])));
        }
        assert!(knots.in_memory.len() <= MOST_IN_MEMORY + N && knots.stored > 0);
        for window in [1, 7] {
            let mut seen = 0;
            let visited = knots.try_for_each_window(N, window, |knots| {
                assert!((2..=window + 1).contains(&(knots.len() / N)), "{}", knots.len());
                assert_eq!(knots[..N], knot(seen));
                for found in knots.chunks_exact(N).skip(1) {
                    seen += 1;
                    assert_eq!(found, knot(seen));
                }
                io::Result::Ok(())
            });
            visited.expect("a file");
            assert_eq!(seen, count - 1);
        }
    }

    #[test]
    fn knots_in_the_file_are_those_that_were_added() {
        check_stored::<3>(50_000);
        check_stored::<5>(30_000);
    }

    /// Paths are the same where their numbers in memory are, and the file of the others.
    #[test]
    fn knots_are_equal_where_they_share_the_file() {
        let short = |value: f64| {
            let mut knots = Knots::default();
            knots.push(0.0, &[value, 1.0]);
            knots
        };
        assert_eq!(short(1.0), short(1.0));
        assert_ne!(short(1.0), short(2.0));
        let mut long = short(1.0);
        for _ in 0..30_000 {
            long.push(1.0, &[2.0, 3.0]);
        }
        assert!(long.file.is_some());
        assert_eq!(long, long.clone());
        let (mut other, mut without) = (long.clone(), long.clone());
        other.file = Some(Arc::new(Mutex::new(temporary_file())));
        without.file = None;
        assert_ne!(long, other);
        assert_ne!(long, without);
        let mut more = long.clone();
        more.push(2.0, &[3.0, 4.0]);
        assert_ne!(long, more);
    }
}
