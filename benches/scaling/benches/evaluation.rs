//! Time per call of forward dynamics and of the paper's impact, generated and generic, by the same traits at the same
//! states in the same runs.
//!
//! `cargo run --release` in this folder derives the robots and runs this benchmark, which alone has no robots.

use criterion::Criterion;
use planar_capture::generic::Generic;
use planar_capture::layout::Layout;
use planar_capture::owned::CloneModel;
use planar_capture::sampling::Regime;
use planar_capture::state::Forces;
use std::error::Error;
use std::hint::black_box;
use std::time::Duration;

mod robots {
    include!(env!("SCALING_INDEX"));
}

/// A layout with its generated code.
struct Robot {
    name: &'static str,
    /// TOML.
    layout: &'static str,
    model: fn() -> Box<dyn CloneModel>,
}

/// Number of states, evaluated in turn.
const STATES: u64 = 16;

fn main() -> Result<(), Box<dyn Error>> {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .sample_size(50)
        .without_plots()
        .configure_from_args();
    for robot in robots::ROBOTS {
        let layout = Layout::parse(robot.layout, robot.name).map_err(|report| report.to_string())?;
        measure(&mut criterion, robot.name, "generated", (robot.model)().as_ref(), &layout)?;
        measure(&mut criterion, robot.name, "generic", &Generic::new(&layout), &layout)?;
    }
    criterion.final_summary();
    Ok(())
}

fn measure(
    criterion: &mut Criterion,
    robot: &str,
    implementation: &str,
    model: &dyn CloneModel,
    layout: &Layout,
) -> Result<(), Box<dyn Error>> {
    let states: Vec<_> = (0..STATES).map(|index| Regime::Moving.sample(layout, 1, index).instant).collect();
    let joints = layout.joints();
    let (mut accelerations, mut after) = (vec![0.0; joints], vec![0.0; joints]);
    let (mut matrix, mut momentum) = (vec![0.0; joints * joints], vec![0.0; joints]);
    for instant in &states {
        // errors would be fast and must not be timed
        let (state, forces) = (instant.state.view(), Forces::torques(&instant.joint_torques));
        model.forward_dynamics(&state, &forces, &mut accelerations)?;
        model.reduced_impact(&state, &instant.targets, &mut matrix, &mut momentum, &mut after)?;
    }
    let mut states = states.iter().cycle();
    let mut group = criterion.benchmark_group(robot);
    group.bench_function(implementation, |bencher| {
        bencher.iter(|| {
            let instant = states.next()?;
            let forces = Forces::torques(&instant.joint_torques);
            let base = model.forward_dynamics(&black_box(instant.state.view()), &forces, &mut accelerations);
            black_box(&accelerations);
            base.ok()
        });
    });
    group.bench_function(format!("{implementation} impact"), |bencher| {
        bencher.iter(|| {
            let instant = states.next()?;
            let (state, targets) = (black_box(instant.state.view()), &instant.targets);
            let done = model.reduced_impact(&state, targets, &mut matrix, &mut momentum, &mut after);
            black_box((&matrix, &momentum, &after));
            done.ok()
        });
    });
    Ok(())
}
