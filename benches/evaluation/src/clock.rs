//! How evaluations are timed.

use rustix::time::{ClockId, clock_gettime};
use std::hint::black_box;

/// Least time of a measurement, s.
const LEAST: f64 = 0.02;

/// Times evaluations.
pub trait Clock {
    /// Times `evaluate` at all states, again and again; one call of it is so many evaluations.
    fn each<S>(&mut self, name: &str, evaluations: u32, states: &[S], evaluate: impl FnMut(&S));
}

/// By the processor time of this thread: names, and nanoseconds per evaluation.
#[derive(Debug, Default)]
pub struct ThreadTime(pub Vec<(String, f64)>);

impl Clock for ThreadTime {
    fn each<S>(&mut self, name: &str, evaluations: u32, states: &[S], mut evaluate: impl FnMut(&S)) {
        let mut pass = || states.iter().for_each(|state| evaluate(black_box(state)));
        pass();
        let mut passes = 1_u32;
        loop {
            let start = seconds();
            (0..passes).for_each(|_| pass());
            let time = seconds() - start;
            if time >= LEAST {
                #[allow(clippy::cast_precision_loss, reason = "thousands")]
                let calls = f64::from(passes) * states.len() as f64;
                return self.0.push((name.to_owned(), time * 1e9 / (calls * f64::from(evaluations))));
            }
            passes *= 2;
        }
    }
}

#[allow(clippy::cast_precision_loss, reason = "nanoseconds of minutes")]
fn seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
