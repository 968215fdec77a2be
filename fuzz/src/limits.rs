//! Bounds on the time of an input, and on the memory of one and of all.

use cap::Cap;
use std::alloc::System;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Bytes above which the process has no more memory.
const MOST: usize = 4 << 30;

/// Bytes that all threads together may have at a time: some hundred times the largest input for each.
const MOST_AT_A_TIME: usize = 256 << 20;

/// Bytes by which memory may have grown when all inputs have been run: what libraries keep.
const GROWTH: usize = 8 << 20;

/// Time after which an input hangs; of the processor's, where it can be told, for others may use the processor too. An arm
/// that a scenario turns 3,000 times through its own base, in three cases, takes 100 s, for 12,000 overlaps of each.
const HANG: Duration = Duration::from_mins(10);

/// How much longer an input may take where it waits for the processor.
const WAITING: u32 = 4;

/// Inputs after which libraries keep what they keep.
const WARM: u64 = 2000;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, MOST);

/// The bounds of a run.
pub struct Limits {
    threads: Vec<Thread>,
    started: Instant,
    /// Bytes after the first inputs.
    warm: OnceLock<usize>,
    /// The longest time of an input, ms, and its index in 48 bits.
    slowest: AtomicU64,
}

/// What one thread runs.
#[derive(Default)]
struct Thread {
    /// When its input began in ms since the start; 0 between inputs.
    begun: AtomicU64,
    index: AtomicU64,
    /// Its folder in `/proc`, where there is one.
    folder: OnceLock<Option<PathBuf>>,
}

impl Thread {
    /// How long it has run, where the system tells.
    fn processor_time(&self) -> Option<Duration> {
        processor_time(self.folder.get()?.as_deref()?)
    }
}

/// How long the thread of a folder in `/proc` has run.
pub fn processor_time(thread: &Path) -> Option<Duration> {
    let times = std::fs::read_to_string(thread.join("schedstat")).ok()?;
    times.split(' ').next()?.parse().ok().map(Duration::from_nanos)
}

impl Limits {
    /// Of a number of threads.
    pub fn new(threads: usize) -> Self {
        let threads = (0..threads).map(|_| Thread::default()).collect();
        Self { threads, started: Instant::now(), warm: OnceLock::new(), slowest: AtomicU64::new(0) }
    }

    /// An input begins; called by its thread.
    pub fn begin(&self, thread: usize, index: u64) {
        let Thread { begun, index: input, folder } = &self.threads[thread];
        folder.get_or_init(|| std::fs::read_link("/proc/thread-self").ok().map(|link| Path::new("/proc").join(link)));
        input.store(index, Ordering::Relaxed);
        begun.store(self.milliseconds().max(1), Ordering::Relaxed);
    }

    /// An input ends.
    pub fn end(&self, thread: usize) {
        let Thread { begun: time, index, .. } = &self.threads[thread];
        let time = self.milliseconds().saturating_sub(time.swap(0, Ordering::Relaxed)).min(u64::from(u16::MAX));
        self.slowest.fetch_max((time << 48) | (index.load(Ordering::Relaxed) & ((1 << 48) - 1)), Ordering::Relaxed);
    }

    /// The longest time of an input, ms, and its index.
    pub fn slowest(&self) -> (u64, u64) {
        let slowest = self.slowest.load(Ordering::Relaxed);
        (slowest >> 48, slowest & ((1 << 48) - 1))
    }

    /// Whether the memory of inputs so far was within bounds.
    pub fn memory(&self, index: u64) -> Result<(), String> {
        if index >= WARM {
            self.warm.get_or_init(|| ALLOCATOR.allocated());
        }
        let most = ALLOCATOR.max_allocated();
        if most > MOST_AT_A_TIME {
            return Err(format!("{most} bytes were in use at a time, at most {MOST_AT_A_TIME} are expected"));
        }
        Ok(())
    }

    /// Whether memory has grown since the first inputs.
    pub fn growth(&self, inputs: u64) -> Result<(), String> {
        let (now, warm) = (ALLOCATOR.allocated(), self.warm.get().copied().unwrap_or(usize::MAX));
        if now > warm.saturating_add(GROWTH) {
            return Err(format!("{inputs} inputs have left {} bytes allocated", now - warm));
        }
        Ok(())
    }

    /// Ends the process when an input hangs, until all have been run.
    pub fn watch(&self, target: &str, finished: &AtomicBool) {
        // when the input that a thread runs began, and the thread's processor time when that was first seen
        let mut seen = vec![(0, None); self.threads.len()];
        while !finished.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(50));
            for (thread, seen) in self.threads.iter().zip(&mut seen) {
                let (begun, index) = (thread.begun.load(Ordering::Relaxed), thread.index.load(Ordering::Relaxed));
                if begun == 0 || begun != seen.0 {
                    *seen = (begun, thread.processor_time());
                    continue;
                }
                let elapsed = Duration::from_millis(self.milliseconds().saturating_sub(begun));
                let run = seen.1.zip(thread.processor_time()).map_or(elapsed, |(start, now)| now.saturating_sub(start));
                if run > HANG || elapsed > WAITING * HANG {
                    eprintln!("fuzz: {target}: input {index} hangs");
                    std::process::exit(1);
                }
            }
        }
    }

    fn milliseconds(&self) -> u64 {
        milliseconds(self.started.elapsed())
    }
}

fn milliseconds(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}

/// Inputs per second.
pub fn rate(inputs: u64, time: Duration) -> u64 {
    inputs.saturating_mul(1000) / milliseconds(time).max(1)
}
