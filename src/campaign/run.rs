//! Computes the files of a sweep that are missing, on several threads.
//!
//! Threads take cases in order, whatever file these are in: there are never more open files than threads. Whoever computes
//! the last case of a file writes it.
//!
//! # Example
//! ```
//! use planar_capture::campaign::Campaign;
//! use planar_capture::campaign::run::{Plan, Shard, Tally, run};
//! use planar_capture::engine::Choice;
//! use planar_capture::registry::{Robots, SHIPPED};
//!
//! let text = r#"
//! name = "masses"
//! scenario = "redysim_single_arm_3r.toml"
//! cases = 3
//! seed = 1
//! block = 2
//! vary = [{ key = "layout.base.mass", distribution = { normal = { mean = 500.0, std = 10.0 } } }]
//! "#;
//! let campaign = Campaign::parse(text, "masses.toml", "scenarios".as_ref(), SHIPPED)?;
//! let folder = tempfile::tempdir()?;
//! // the second of two processes has the second file, with the third case alone
//! let shard = Shard::new(2, 2).expect("one of two");
//! let plan = Plan::new(&campaign, folder.path(), shard)?;
//! assert_eq!((plan.blocks.as_slice(), plan.cases), (&[1][..], 1));
//! let (choice, _) = Choice::fastest(&campaign.general_layout(), Robots::SHIPPED);
//! let tally = Tally::default();
//! run(&campaign, &choice, folder.path(), &plan, 1, &tally)?;
//! assert_eq!(tally.counts().next(), Some(("done", 1)));
//! // what is there is not computed again
//! assert_eq!(Plan::new(&campaign, folder.path(), shard)?.present, 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use super::block_file::Damage;
use super::block_file::{self, CASES, DIGESTS, Found, SERIES, TIMING};
use super::manifest::{Origin, origin};
use super::outputs::{Output, outputs};
use super::reader::Campaign;
use super::row::{CaseRunner, Row, Status};
use super::sweep::Draw;
use crate::engine::Choice;
use crate::output::atomic_file::{StagedFile, create_folder};
use crate::output::output_error::OutputError;
use crate::output::time_series::write_csv;
use std::collections::HashMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

/// A part of the files: those whose number is I − 1 modulo N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 1.
    number: u64,
    /// How many there are.
    of: u64,
}

impl Shard {
    /// All files.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// The one of this number, from 1, of so many; `None` where there is no such one.
    #[must_use]
    pub fn new(number: u64, of: u64) -> Option<Self> {
        (1..=of).contains(&number).then_some(Self { number, of })
    }
}

/// What has been done so far; threads write it, and the display reads it.
#[derive(Debug, Default)]
pub struct Tally {
    /// Cases that are computed.
    pub computed: AtomicU64,
    /// By status, in the order of [`Status::ALL`].
    pub by_status: [AtomicU64; Status::ALL.len()],
    /// Set to end early.
    pub is_interrupted: AtomicBool,
}

impl Tally {
    /// The names of all statuses, and how many cases have each.
    pub fn counts(&self) -> impl Iterator<Item = (&'static str, u64)> {
        let all = Status::ALL.iter().zip(&self.by_status);
        all.map(|((name, _), count)| (*name, count.load(Ordering::Relaxed)))
    }
}

/// What a run is to do.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Files that are missing, in order.
    pub blocks: Vec<u64>,
    /// Their cases.
    pub cases: u64,
    /// Cases in files that are there.
    pub present: u64,
    /// Files that are missing because what is there is not what was written.
    pub damaged: Vec<Damage>,
}

impl Plan {
    /// The files of a shard that are missing in a folder, have not all of their cases, or are damaged.
    ///
    /// # Errors
    /// [`OutputError`].
    pub fn new(campaign: &Campaign, folder: &Path, shard: Shard) -> Result<Self, OutputError> {
        for inner in [CASES, DIGESTS, TIMING, SERIES] {
            if inner != SERIES || !campaign.sweep.collect.series.is_empty() {
                create_folder(&folder.join(inner))?;
            }
        }
        let sweep = &campaign.sweep;
        let origin = origin(campaign);
        let (mut blocks, mut present, mut damaged) = (Vec::new(), 0, Vec::new());
        for block in (0..sweep.blocks()).filter(|block| block % shard.of == shard.number - 1) {
            match block_file::find(folder, block, &origin, sweep.cases_of(block)) {
                Ok(Found::Whole) => {
                    present += sweep.count_of(block);
                    continue;
                }
                Ok(Found::Fewer | Found::Nothing) => {}
                Err(damage) => damaged.push(damage),
            }
            blocks.push(block);
        }
        let cases = blocks.iter().map(|block| sweep.count_of(*block)).sum();
        Ok(Self { blocks, cases, present, damaged })
    }
}

/// Cases that are not in the files of a folder, whichever shard has them: those of files that are not there or not of this
/// sweep, and those that a file of a sweep with fewer cases has not. Only what files say of themselves is read, not their rows.
#[must_use]
pub fn missing(campaign: &Campaign, folder: &Path) -> u64 {
    let sweep = &campaign.sweep;
    let origin = origin(campaign);
    let absent = |block| {
        let cases = sweep.cases_of(block);
        let there = block_file::cases_said(folder, block, &origin).map_or(0..0, |[first, last]| first..last + 1);
        sweep.count_of(block) - there.end.min(cases.end).saturating_sub(there.start.max(cases.start))
    };
    (0..sweep.blocks()).map(absent).sum()
}

/// The rows of files that are not complete.
#[derive(Default)]
struct Queue {
    /// The next file of the plan, and the next case in it.
    next: (usize, u64),
    open: HashMap<u64, Vec<Row>>,
    failure: Option<OutputError>,
}

/// Computes the files of a plan; ends early where the tally says so, after the cases that are under way.
///
/// # Errors
/// [`OutputError`], after the cases that are under way.
pub fn run(
    campaign: &Campaign,
    choice: &Choice,
    folder: &Path,
    plan: &Plan,
    threads: usize,
    tally: &Tally,
) -> Result<(), OutputError> {
    let outputs = outputs(&campaign.scenario, &campaign.sweep.collect.outputs);
    let origin = origin(campaign);
    let queue = Mutex::new(Queue::default());
    thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(|| {
                let (outputs, origin, queue) = (&outputs[..], &origin, &queue);
                let worker = Worker { campaign, choice, folder, plan, tally, outputs, origin, queue };
                worker.work();
            });
        }
    });
    queue.into_inner().unwrap_or_else(PoisonError::into_inner).failure.map_or(Ok(()), Err)
}

struct Worker<'a> {
    campaign: &'a Campaign,
    choice: &'a Choice,
    folder: &'a Path,
    plan: &'a Plan,
    tally: &'a Tally,
    outputs: &'a [Output],
    origin: &'a Origin,
    queue: &'a Mutex<Queue>,
}

impl Worker<'_> {
    fn work(&self) {
        let sweep = &self.campaign.sweep;
        let runner = CaseRunner {
            draw: Draw::new(sweep),
            variation: &self.campaign.variation,
            choice: self.choice,
            laws: &self.campaign.laws,
            outputs: self.outputs,
        };
        while !self.tally.is_interrupted.load(Ordering::Relaxed) {
            let Some((block, case)) = self.take() else { return };
            let done = self.compute(&runner, case).and_then(|row| self.add(block, row));
            if let Err(failure) = done {
                self.lock().failure.get_or_insert(failure);
                return;
            }
        }
    }

    fn lock(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next file and case; `None` where there is none, or no file can be written.
    fn take(&self) -> Option<(u64, u64)> {
        let mut queue = self.lock();
        if queue.failure.is_some() {
            return None;
        }
        let (place, offset) = queue.next;
        let block = *self.plan.blocks.get(place)?;
        let cases = self.campaign.sweep.cases_of(block);
        let case = cases.start + offset;
        queue.next = if case + 1 < cases.end { (place, offset + 1) } else { (place + 1, 0) };
        Some((block, case))
    }

    fn compute(&self, runner: &CaseRunner<'_>, case: u64) -> Result<Row, OutputError> {
        let collect = &self.campaign.sweep.collect;
        if collect.series.binary_search(&case).is_err() {
            // rows that nobody reads
            return Ok(runner.run(case, f64::INFINITY, &mut |_, _, _| {}));
        }
        let path = self.folder.join(SERIES).join(format!("{case:06}.csv"));
        let mut written = Ok(());
        let row = runner.run(case, collect.sample, &mut |scenario, study, result| {
            written = StagedFile::new(&path, |to| write_csv(scenario, study, result, to)).and_then(StagedFile::commit);
        });
        written.map(|()| row)
    }

    /// Adds a row to its file, and writes that if it is the last one.
    fn add(&self, block: u64, row: Row) -> Result<(), OutputError> {
        let of_status = Status::ALL.iter().zip(&self.tally.by_status).find(|((_, status), _)| *status == row.status);
        if let Some((_, count)) = of_status {
            count.fetch_add(1, Ordering::Relaxed);
        }
        self.tally.computed.fetch_add(1, Ordering::Relaxed);
        let sweep = &self.campaign.sweep;
        let complete = {
            let mut queue = self.lock();
            let rows = queue.open.entry(block).or_default();
            rows.push(row);
            if rows.len() as u64 == sweep.count_of(block) { queue.open.remove(&block) } else { None }
        };
        let Some(mut rows) = complete else { return Ok(()) };
        rows.sort_by_key(|row| row.case);
        block_file::write((self.folder, block), sweep, self.origin, self.outputs, &rows)
    }
}
