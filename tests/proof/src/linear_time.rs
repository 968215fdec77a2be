//! Whether reading a text takes a time that is linear in its size.

use crate::tolerance;
use std::time::Duration;

/// Most runs of each text: the first ones fill caches, so the least times count.
const RUNS: usize = 20;

/// Runs `read` for a text and for one ten times as long, until the least times are those of linear time.
#[track_caller]
pub fn assert_linear_time(what: &str, text: impl Fn(usize) -> String, read: impl Fn(&str)) {
    let texts = [text(3_000), text(30_000)];
    let mut least = [f64::INFINITY; 2];
    for _ in 0..RUNS {
        for (text, least) in texts.iter().zip(&mut least) {
            let start = processor_time();
            read(text);
            *least = least.min(processor_time().saturating_sub(start).as_secs_f64());
        }
        if least[1] < tolerance::TEN_TIMES * least[0] + tolerance::SHORT_TIME {
            return;
        }
    }
    panic!("{what}: {} s, and {} s for ten times the text", least[0], least[1]);
}

/// Of this thread, which may share the processor.
#[cfg(unix)]
fn processor_time() -> Duration {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::try_from(now).expect("a time")
}

#[cfg(not(unix))]
fn processor_time() -> Duration {
    use std::sync::OnceLock;
    use std::time::Instant;

    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed()
}
