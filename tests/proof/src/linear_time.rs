//! Whether reading a text takes a time that is linear in its size.

use crate::tolerance;
use std::time::Instant;

/// Most runs of each text: the processor may be shared, so the least times count.
const RUNS: usize = 20;

/// Runs `read` for a text and for one ten times as long, until the least times are those of linear time.
#[track_caller]
pub fn assert_linear_time(what: &str, text: impl Fn(usize) -> String, read: impl Fn(&str)) {
    let texts = [text(3_000), text(30_000)];
    let mut least = [f64::INFINITY; 2];
    for _ in 0..RUNS {
        for (text, least) in texts.iter().zip(&mut least) {
            let start = Instant::now();
            read(text);
            *least = least.min(start.elapsed().as_secs_f64());
        }
        if least[1] < tolerance::TEN_TIMES * least[0] + tolerance::SHORT_TIME {
            return;
        }
    }
    panic!("{what}: {} s, and {} s for ten times the text", least[0], least[1]);
}
