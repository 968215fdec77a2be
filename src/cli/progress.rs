//! Progress bars of simulations and derivations, drawn on terminals only.

use indicatif::{ProgressBar, ProgressStyle};
use planar_capture::capture::Observer;
use std::time::Duration;

/// Steps between two updates of the bar.
const STRIDE: u64 = 256;
const TICK: Duration = Duration::from_millis(100);

/// Shows the running part of a study.
pub struct Progress {
    bar: ProgressBar,
    steps: u64,
}

impl Progress {
    /// A bar that appears with the first part.
    pub fn new() -> Self {
        Self { bar: ProgressBar::no_length(), steps: 0 }
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
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
        self.steps = 0;
    }

    fn step(&mut self) {
        self.steps += 1;
        if self.steps.is_multiple_of(STRIDE) {
            self.bar.set_position(self.steps);
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
