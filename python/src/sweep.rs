//! Sweeps, as the command computes them.

use crate::failure::{Failure, of_output, of_report};
use crate::scenario::choose;
use planar_capture::campaign::Campaign;
use planar_capture::campaign::manifest::{ManifestError, claim};
use planar_capture::campaign::report::{ReportError, statuses_of_block, write_report};
use planar_capture::campaign::run::{Plan, Shard, Tally, run};
use planar_capture::engine::Choice;
use planar_capture::output::atomic_file::create_folder;
use planar_capture::output::result_folder::existing_folder;
use planar_capture::registry::SHIPPED;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::{Py, PyAny, PyAnyMethods, PyErr, PyResult, Python, pyfunction};
use std::ffi::CString;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// Between two looks at signals and progress.
const TICK: Duration = Duration::from_millis(50);

/// A sweep whose files a folder takes.
struct Claimed {
    campaign: Campaign,
    choice: Choice,
    folder: PathBuf,
}

impl Claimed {
    fn new(path: &Path, out: Option<PathBuf>, dynamics: &str) -> PyResult<Self> {
        let campaign = Campaign::read(path, SHIPPED).map_err(of_report)?;
        let folder = out.unwrap_or_else(|| Path::new("results").join(&campaign.sweep.name));
        let (choice, _) = choose(dynamics, &campaign.general_layout())?;
        existing_folder(&folder).map_err(|error| Failure::Output.with(error))?;
        create_folder(&folder).map_err(of_output)?;
        claim(&folder, &campaign, choice.engine).map_err(|error| match error {
            ManifestError::Output(error) => of_output(error),
            other => Failure::Input.with(other),
        })?;
        Ok(Self { campaign, choice, folder })
    }
}

/// What a sweep was and became: its name, folder, number of cases, computed ones by status, those that were there before.
type Outcome = (String, PathBuf, u64, Vec<(&'static str, u64)>, u64);

/// Computes the files of a sweep that are missing. `progress` is called with the numbers of computed cases and of those
/// to compute.
///
/// An exception in this thread, as Ctrl-C is one, ends it within a case of each thread.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "keyword arguments for the one caller in Python")]
pub fn sweep(
    py: Python<'_>,
    path: PathBuf,
    out: Option<PathBuf>,
    threads: Option<usize>,
    shard: Option<(u64, u64)>,
    dynamics: &str,
    report: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Outcome> {
    let Claimed { campaign, choice, folder } = Claimed::new(&path, out, dynamics)?;
    let shard = match shard {
        None => Shard::WHOLE,
        Some((number, of)) => Shard::new(number, of).ok_or_else(|| {
            Failure::Input
                .with(format!("shard is ({number}, {of}), expected (I, N) with 1 ≤ I ≤ N, for example (2, 8)"))
        })?,
    };
    let plan = Plan::new(&campaign, &folder, shard).map_err(of_output)?;
    warn(py, &plan)?;
    let tally = Tally::default();
    let threads = threads.unwrap_or_else(|| thread::available_parallelism().map_or(1, NonZero::get));
    let (written, shown) = py.detach(|| {
        let (sender, receiver) = mpsc::channel();
        thread::scope(|scope| {
            let (campaign, choice, folder, plan, tally) = (&campaign, &choice, &folder, &plan, &tally);
            let work = scope.spawn(move || {
                let written = run(campaign, choice, folder, plan, threads, tally);
                drop(sender);
                written
            });
            let mut shown: PyResult<()> = Ok(());
            while receiver.recv_timeout(TICK) == Err::<(), _>(RecvTimeoutError::Timeout) && shown.is_ok() {
                shown = Python::attach(|py| show(py, progress.as_ref(), tally, plan.cases));
            }
            if shown.is_err() {
                tally.is_interrupted.store(true, Ordering::Relaxed);
            }
            (work.join(), shown)
        })
    });
    shown?;
    written
        .map_err(|_| Failure::Computation.with("a thread of the sweep panicked: please report it"))?
        .map_err(of_output)?;
    show(py, progress.as_ref(), &tally, plan.cases)?;
    if report {
        write_report(&campaign, &path, &folder, &[]).map_err(of_sweep_report)?;
    }
    Ok((campaign.sweep.name.clone(), folder, campaign.sweep.cases, tally.counts().collect(), plan.present))
}

/// A warning for each file that is damaged.
fn warn(py: Python<'_>, plan: &Plan) -> PyResult<()> {
    plan.damaged.iter().try_for_each(|damage| {
        let message = CString::new(format!("{damage}: its cases are computed again"))?;
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &message, 2)
    })
}

/// What is to be done of a sweep: its name, folder and numbers of cases and of files, the numbers of files that are
/// missing, from 0, and that of their cases.
type ToDo = (String, PathBuf, u64, u64, Vec<u64>, u64);

/// What is to be done of a sweep, whose folder it is then.
#[pyfunction]
pub fn sweep_plan(py: Python<'_>, path: PathBuf, out: Option<PathBuf>, dynamics: &str) -> PyResult<ToDo> {
    let Claimed { campaign, folder, .. } = Claimed::new(&path, out, dynamics)?;
    let plan = Plan::new(&campaign, &folder, Shard::WHOLE).map_err(of_output)?;
    warn(py, &plan)?;
    let sweep = campaign.sweep;
    Ok((sweep.name.clone(), folder, sweep.cases, sweep.blocks(), plan.blocks, plan.cases))
}

/// Writes the report on all files of a sweep that are in a folder; returns its path.
#[pyfunction]
pub fn sweep_report(path: PathBuf, folder: PathBuf) -> PyResult<PathBuf> {
    let campaign = Campaign::read(&path, SHIPPED).map_err(of_report)?;
    write_report(&campaign, &path, &folder, &[]).map_err(of_sweep_report)
}

/// How many cases of a file of a sweep have each status.
#[pyfunction]
pub fn sweep_statuses(folder: PathBuf, block: u64) -> PyResult<Vec<(&'static str, usize)>> {
    statuses_of_block(&folder, block).map_err(|error| Failure::Input.with(error))
}

fn show(py: Python<'_>, progress: Option<&Py<PyAny>>, tally: &Tally, cases: u64) -> Result<(), PyErr> {
    py.check_signals()?;
    if let Some(progress) = progress {
        progress.bind(py).call1((tally.computed.load(Ordering::Relaxed), cases))?;
    }
    Ok(())
}

/// Of results that cannot be read, or of a report that cannot be written.
fn of_sweep_report(error: ReportError) -> PyErr {
    match error {
        ReportError::Unreadable(error) => Failure::Input.with(error),
        ReportError::Output(error) => of_output(error),
    }
}
