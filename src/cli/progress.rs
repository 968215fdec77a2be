//! A bar on a terminal, nothing elsewhere.

use indicatif::{ProgressBar, ProgressStyle};
use planar_capture::capture::Observer;
use std::time::Duration;

/// Steps between two looks at the bar.
const STRIDE: u64 = 256;

/// Shows the part of a study that is running.
pub struct Progress {
    bar: ProgressBar,
    steps: u64,
}

impl Progress {
    /// A bar that shows once something begins.
    pub fn new() -> Self {
        Self { bar: ProgressBar::no_length(), steps: 0 }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Observer for Progress {
    fn begin(&mut self, part: &str, steps: u64) {
        let known = "{msg:>22} {bar:40} {percent:>3} % {eta}";
        let template = if steps > 0 { known } else { "{msg:>22} {spinner} {pos} steps" };
        if let Ok(style) = ProgressStyle::with_template(template) {
            self.bar.set_style(style);
        }
        self.bar.set_message(part.to_owned());
        self.bar.reset();
        if steps > 0 {
            self.bar.set_length(steps);
        } else {
            self.bar.unset_length();
        }
        self.bar.enable_steady_tick(Duration::from_millis(100));
        self.steps = 0;
    }

    fn step(&mut self) {
        self.steps += 1;
        if self.steps.is_multiple_of(STRIDE) {
            self.bar.set_position(self.steps);
        }
    }
}
