//! Time per call of forward dynamics, generated and generic, by the same trait at the same states in the same runs.
//!
//! `cargo run --release` in this folder derives the robots and runs this benchmark, which alone has no robots.

use criterion::Criterion;
use planar_capture::dynamics::ForwardDynamics;
use planar_capture::generic::Generic;
use planar_capture::layout::Layout;
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
    model: fn() -> Box<dyn ForwardDynamics<f64>>,
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
    model: &dyn ForwardDynamics<f64>,
    layout: &Layout,
) -> Result<(), Box<dyn Error>> {
    let states: Vec<_> = (0..STATES).map(|index| Regime::Moving.sample(layout, 1, index).instant).collect();
    let mut accelerations = vec![0.0; layout.joints()];
    for instant in &states {
        // errors would be fast and must not be timed
        let forces = Forces::torques(&instant.joint_torques);
        model.forward_dynamics(&instant.state.view(), &forces, &mut accelerations)?;
    }
    let mut states = states.iter().cycle();
    criterion.benchmark_group(robot).bench_function(implementation, |bencher| {
        bencher.iter(|| {
            let instant = states.next()?;
            let forces = Forces::torques(&instant.joint_torques);
            let base = model.forward_dynamics(&black_box(instant.state.view()), &forces, &mut accelerations);
            black_box(&accelerations);
            base.ok()
        });
    });
    Ok(())
}
