//! Progress of a sweep on the standard error, with rate and time left: a bar on a terminal, elsewhere a line now and then.

use crate::campaign::run::Tally;
use crate::cli::progress::Display;
use crate::cli::terminal::note;
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

const TICK: Duration = Duration::from_millis(200);

/// Shows a tally until it is finished.
pub struct Progress {
    /// The thread ends where the sender is dropped.
    thread: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Of so many cases.
    pub fn new(display: Display, cases: u64, tally: &Arc<Tally>) -> Self {
        if display.quiet || cases == 0 {
            return Self { thread: None };
        }
        let bar = ProgressBar::new(cases);
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} cases, {per_sec}, {eta} left{msg}");
        bar.set_style(style.expect("a valid template"));
        let interval = if bar.is_hidden() { display.progress.max(TICK) } else { TICK };
        let (sender, receiver) = mpsc::channel();
        let (tally, begin) = (Arc::clone(tally), Instant::now());
        let thread = thread::spawn(move || {
            while receiver.recv_timeout(interval) == Err(RecvTimeoutError::Timeout) {
                let computed = tally.computed.load(Ordering::Relaxed);
                if bar.is_hidden() {
                    note(line(computed, cases, begin.elapsed().as_secs_f64()));
                } else {
                    if tally.is_interrupted.load(Ordering::Relaxed) {
                        bar.set_message(", ending");
                    }
                    bar.set_position(computed);
                }
            }
            bar.finish_and_clear();
        });
        Self { thread: Some((sender, thread)) }
    }

    /// Removes the bar.
    pub fn finish(self) {
        if let Some((sender, thread)) = self.thread {
            drop(sender);
            let _ = thread.join(); // it prints and waits: there is no result
        }
    }
}

#[allow(clippy::cast_precision_loss, reason = "shown with few digits")]
fn line(computed: u64, cases: u64, elapsed: f64) -> String {
    let rate = computed as f64 / elapsed;
    let left = match computed {
        0 => "unknown time".to_owned(),
        _ => format!("{:.0} s", (cases - computed) as f64 / rate),
    };
    format!("{computed} of {cases} cases, {rate:.1} per second, {left} left")
}
