//! Progress of simulations and derivations on the standard error: bars on a terminal, elsewhere a line now and then.

use super::seconds::seconds;
use super::terminal::note;
use crate::capture::Observer;
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Positions of the bar in a part, where the number of its steps is known: more than it shows.
const POSITIONS: u64 = 256;
/// Steps between two positions where that is not known.
const STRIDE: u64 = 16;
const TICK: Duration = Duration::from_millis(100);

/// How a long command shows that it goes on.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct Display {
    /// Show no progress, and not which implementation computes the dynamics.
    #[arg(short, long, help_heading = "Messages")]
    pub quiet: bool,
    /// Seconds between two lines of progress where the standard error is no terminal.
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = interval, help_heading = "Messages")]
    pub progress: Duration,
}

fn interval(text: &str) -> Result<Duration, String> {
    Duration::try_from_secs_f64(seconds(text)?).map_err(|_| "expected a time of 0 s or more, at most 1e19 s".to_owned())
}

/// Shows the running part of a study.
pub struct Progress {
    /// Where it is seen: it has a thread of its own for every part.
    bar: Option<ProgressBar>,
    lines: Option<Lines>,
    steps: u64,
    /// Steps between two positions of the bar.
    stride: u64,
}

impl Progress {
    /// The bar appears with the first part, lines from now on.
    pub fn new(display: Display) -> Self {
        let bar = (!display.quiet).then(ProgressBar::no_length).filter(|bar| !bar.is_hidden());
        let lines = (bar.is_none() && !display.quiet).then(|| Lines::every(display.progress.max(TICK)));
        Self { bar, lines, steps: 0, stride: STRIDE }
    }

    /// Removes the bar.
    pub fn finish(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        self.lines = None;
    }
}

impl Observer for Progress {
    fn begin(&mut self, part: &str, steps: u64) {
        self.steps = 0;
        self.stride = if steps > 0 { steps.div_ceil(POSITIONS) } else { STRIDE };
        if let Some(bar) = &self.bar {
            let known = "{msg:>22} {bar:40} {percent:>3} % {eta}";
            set_template(bar, if steps > 0 { known } else { "{msg:>22} {spinner} {pos} steps" });
            bar.set_message(part.to_owned());
            bar.reset();
            if steps > 0 {
                bar.set_length(steps);
            } else {
                bar.unset_length();
            }
            bar.enable_steady_tick(TICK);
        }
        if let Some(lines) = &self.lines {
            lines.position.begin(part, steps);
        }
    }

    fn step(&mut self) {
        self.steps += 1;
        if let Some(bar) = self.bar.as_ref().filter(|_| self.steps.is_multiple_of(self.stride)) {
            bar.set_position(self.steps);
        }
        if let Some(lines) = &self.lines {
            lines.position.steps.store(self.steps, Ordering::Relaxed);
        }
    }
}

/// Where a study is.
#[derive(Default)]
struct Position {
    /// The running part, and how many steps it has: 0 where that is not known.
    part: Mutex<(String, u64)>,
    /// Of the running part: without a lock, which would take longer than a step.
    steps: AtomicU64,
}

impl Position {
    fn begin(&self, part: &str, of: u64) {
        let mut running = self.part.lock().unwrap_or_else(PoisonError::into_inner);
        *running = (part.to_owned(), of);
        self.steps.store(0, Ordering::Relaxed);
    }

    fn line(&self, elapsed: u64) -> String {
        let (part, of) = &*self.part.lock().unwrap_or_else(PoisonError::into_inner);
        let steps = self.steps.load(Ordering::Relaxed);
        match of {
            _ if part.is_empty() => format!("before the first step: {elapsed} s"),
            0 => format!("{part}: {steps} steps, {elapsed} s"),
            of => format!("{part}: {} %, {elapsed} s", 100 * steps / of),
        }
    }
}

/// Lines from a thread of their own: one step can take minutes.
struct Lines {
    position: Arc<Position>,
    /// The thread ends where this is dropped.
    thread: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Lines {
    fn every(interval: Duration) -> Self {
        let position = Arc::<Position>::default();
        let (sender, receiver) = mpsc::channel();
        let begin = Instant::now();
        let shared = Arc::clone(&position);
        let thread = thread::spawn(move || {
            while receiver.recv_timeout(interval) == Err(RecvTimeoutError::Timeout) {
                note(shared.line(begin.elapsed().as_secs()));
            }
        });
        Self { position, thread: Some((sender, thread)) }
    }
}

impl Drop for Lines {
    fn drop(&mut self) {
        if let Some((sender, thread)) = self.thread.take() {
            drop(sender);
            let _ = thread.join(); // it prints and waits: there is no result
        }
    }
}

/// A spinner with a message and the elapsed time.
pub fn spinner(message: &'static str) -> ProgressBar {
    let spinner = ProgressBar::new_spinner();
    set_template(&spinner, "{spinner} {msg} ({elapsed})");
    spinner.set_message(message);
    spinner.enable_steady_tick(TICK);
    spinner
}

fn set_template(bar: &ProgressBar, template: &str) {
    bar.set_style(ProgressStyle::with_template(template).expect("a valid template"));
}
