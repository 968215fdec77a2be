//! The evaluations of `docs/performance.md` by criterion, in one build: `cargo bench --features measure` in this folder. Compares
//! with the run before; a part of a name, as in `cargo bench --features measure -- "f64, step"`, chooses.

use criterion::{BenchmarkGroup, Criterion, SamplingMode, Throughput, measurement::WallTime};
use evaluation::clock::Clock;
use evaluation::measure;
use std::hint::black_box;
use std::time::Duration;

/// One benchmark for each.
struct ByCriterion<'c>(BenchmarkGroup<'c, WallTime>);

impl Clock for ByCriterion<'_> {
    fn each<S>(&mut self, name: &str, evaluations: u32, states: &[S], mut evaluate: impl FnMut(&S)) {
        let count = u64::from(evaluations) * states.len() as u64;
        self.0.throughput(Throughput::Elements(count));
        self.0.bench_function(name, |bencher| {
            bencher.iter(|| states.iter().for_each(|state| evaluate(black_box(state))));
        });
    }
}

fn main() -> Result<(), evaluation::Problem> {
    let mut criterion = Criterion::default().without_plots().configure_from_args();
    let mut group = criterion.benchmark_group("dual_arm_3r");
    // a pass over many states, or a simulation, takes milliseconds
    group.sampling_mode(SamplingMode::Flat).sample_size(30);
    group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(600));
    let done = measure::all(&mut ByCriterion(group));
    criterion.final_summary();
    done
}
