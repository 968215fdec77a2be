//! Progress of simulations and derivations on the standard error: bars on a terminal, elsewhere a line now and then.

use super::terminal::note;
use indicatif::{ProgressBar, ProgressStyle};
use planar_capture::capture::Observer;
use std::time::{Duration, Instant};

/// Steps between two looks at the clock.
const STRIDE: u64 = 256;
const TICK: Duration = Duration::from_millis(100);

/// How a long command shows that it goes on.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct Display {
    /// Show no progress.
    #[arg(short, long)]
    quiet: bool,
    /// Seconds between two lines of progress where the standard error is no terminal.
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = seconds)]
    progress: Duration,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let value: f64 = text.parse().map_err(|_| "expected a number of seconds".to_owned())?;
    Duration::try_from_secs_f64(value).map_err(|_| "expected a time of at least 0 s".to_owned())
}

/// Shows the running part of a study.
pub struct Progress {
    bar: ProgressBar,
    /// Between lines; `None` where there is a bar, or nothing is wanted.
    interval: Option<Duration>,
    part: String,
    steps: u64,
    of: u64,
    begin: Instant,
    /// Of the last line, or the begin.
    shown: Instant,
}

impl Progress {
    /// It appears with the first part.
    pub fn new(display: Display) -> Self {
        let bar = if display.quiet { ProgressBar::hidden() } else { ProgressBar::no_length() };
        let interval = (bar.is_hidden() && !display.quiet).then_some(display.progress);
        let begin = Instant::now();
        Self { bar, interval, part: String::new(), steps: 0, of: 0, begin, shown: begin }
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn line(&self) -> String {
        let Self { part, steps, of, begin, .. } = self;
        let elapsed = begin.elapsed().as_secs();
        match of {
            0 => format!("{part}: {steps} steps, {elapsed} s"),
            of => format!("{part}: {} %, {elapsed} s", 100 * steps / of),
        }
    }
}

impl Observer for Progress {
    fn begin(&mut self, part: &str, steps: u64) {
        let known = "{msg:>22} {bar:40} {percent:>3} % {eta}";
        set_template(&self.bar, if steps > 0 { known } else { "{msg:>22} {spinner} {pos} steps" });
        self.bar.set_message(part.to_owned());
        self.bar.reset();
        if steps > 0 {
            self.bar.set_length(steps);
        } else {
            self.bar.unset_length();
        }
        self.bar.enable_steady_tick(TICK);
        part.clone_into(&mut self.part);
        (self.steps, self.of) = (0, steps);
    }

    fn step(&mut self) {
        self.steps += 1;
        if !self.steps.is_multiple_of(STRIDE) {
            return;
        }
        self.bar.set_position(self.steps);
        if self.interval.is_some_and(|interval| self.shown.elapsed() >= interval) {
            note(self.line());
            self.shown = Instant::now();
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
