//! Instances in as many parts as there are threads.

use std::num::NonZero;
use std::thread::available_parallelism;

/// So many instances take several times as long as starting a thread.
const LEAST: usize = 2048;

/// The blocks that a batch is computed in.
const BLOCK: usize = 64;

/// The number of instances of each part but the last: whole blocks.
pub fn chunk(instances: usize, threads: Option<usize>, least: usize) -> usize {
    if instances <= least {
        // to ask for the number of processors takes as long as computing some
        return least.next_multiple_of(BLOCK);
    }
    let threads = threads.unwrap_or_else(|| available_parallelism().map_or(1, NonZero::get));
    instances.div_ceil(threads.max(1)).max(least).next_multiple_of(BLOCK)
}

/// As [`chunk`], of a batch.
pub fn chunk_of_batch(instances: usize, threads: Option<usize>) -> usize {
    chunk(instances, threads, LEAST)
}

/// The parts of an array that has so many elements for each instance.
pub fn parts(numbers: &[f64], elements: usize, chunk: usize) -> impl Iterator<Item = &[f64]> {
    numbers.chunks(elements * chunk)
}

/// The same of an array that is written.
pub fn parts_mut(numbers: &mut [f64], elements: usize, chunk: usize) -> impl Iterator<Item = &mut [f64]> {
    numbers.chunks_mut(elements * chunk)
}
