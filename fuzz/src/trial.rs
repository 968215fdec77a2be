//! One input: made, read, and made small where it fails.

use crate::input::{Input, strategy};
use crate::limits::processor_time;
use crate::targets::Target;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

/// Longest time of an input; of the processor's, where it can be told, and in the faster of two more runs. `check` may look
/// for a few seconds at a path of 20,000 steps.
const SLOW: Duration = Duration::from_secs(6);
const RUNS: usize = 2;

/// Most bytes of a failing input that are printed.
const SHOWN: usize = 4000;

/// Most steps of making an input small.
const STEPS: usize = 2000;

thread_local! {
    static PANIC: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Keeps the message of a panic instead of printing it.
pub fn silence_panics() {
    std::panic::set_hook(Box::new(|info| PANIC.with(|panic| *panic.borrow_mut() = Some(info.to_string()))));
}

/// The input of an index, as text.
pub fn text(target: &Target, seed: u64, index: u64) -> String {
    String::from_utf8_lossy(&tree(target, seed, index).current().bytes(target)).into_owned()
}

/// The recipe of an index.
fn tree(target: &Target, seed: u64, index: u64) -> impl ValueTree<Value = Input> + use<> {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    bytes[8..16].copy_from_slice(&index.to_le_bytes());
    for (byte, letter) in bytes[16..].iter_mut().zip(target.name.bytes()) {
        *byte = letter;
    }
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    strategy().new_tree(&mut runner).expect("a recipe")
}

/// Runs the input of an index; whether it was valid, or why it fails, with the input.
pub fn run(target: &Target, seed: u64, index: u64) -> Result<bool, String> {
    let mut tree = tree(target, seed, index);
    let mut failure = match outcome(target, &tree.current()) {
        Ok(valid) => return Ok(valid),
        Err(failure) => failure,
    };
    let mut smallest = tree.current();
    for _ in 0..STEPS {
        let is_simpler = match outcome(target, &tree.current()) {
            Err(found) => {
                (failure, smallest) = (found, tree.current());
                tree.simplify()
            }
            Ok(_) => tree.complicate(),
        };
        if !is_simpler {
            break;
        }
    }
    let input = smallest.bytes(target);
    let shown = String::from_utf8_lossy(input.get(..SHOWN).unwrap_or(&input));
    let size = input.len();
    Err(format!("{}, input {index}: {failure:.2000}\n--- the input, {size} bytes\n{shown}\n---", target.name))
}

/// Whether an input is valid, or what is wrong with the reader.
fn outcome(target: &Target, input: &Input) -> Result<bool, String> {
    let bytes = input.bytes(target);
    let timed = || {
        let start = Instant::now();
        let result = catch_unwind(AssertUnwindSafe(|| (target.read)(&bytes)));
        (result, start.elapsed())
    };
    let (result, time) = timed();
    let result = result.unwrap_or_else(|_| {
        let message = PANIC.with(|panic| panic.borrow_mut().take()).unwrap_or_default();
        Err(format!("it panics: {message}"))
    });
    if time > SLOW {
        let again = |_| {
            let processor_time = || processor_time(Path::new("/proc/thread-self"));
            let start = processor_time();
            let (_, time) = timed();
            start.zip(processor_time()).map_or(time, |(start, end)| end.saturating_sub(start))
        };
        let least = (0..RUNS).map(again).min().unwrap_or(time);
        if least > SLOW {
            return Err(format!("it takes {least:?} for {} bytes", bytes.len()));
        }
    }
    result
}
