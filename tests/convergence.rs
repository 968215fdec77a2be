//! Integrators converge with their orders, keep what they promise to keep, and agree with each other, in full and in
//! reduced coordinates.

mod support;

use planar_capture::control::{Control, Free, ProportionalDerivative};
use planar_capture::dynamics::Model;
use planar_capture::event::NoEvents;
use planar_capture::models;
use planar_capture::scenario::{Coordinates, Integration, Scheme};
use planar_capture::simulate::{Motion, Phase, Timing, simulate};
use planar_capture::system::System;
use planar_capture::trajectory::{Cycloidal, Ends};
use support::{assert_close, difference, scenario, tolerance};

const FULL: Coordinates = Coordinates::Full;
const REDUCED: Coordinates = Coordinates::Reduced;
const ADAPTIVE: Scheme = Scheme::Adaptive { tolerance: 1e-13 };

fn model() -> Box<dyn Model<f64>> {
    models::generated(&scenario("raina_shah_2017").layout).expect("the paper's robot")
}

/// Both arms swing, the base tumbles and drifts away.
fn tumbling() -> Motion {
    Motion {
        base_pose: [0.3, 1.0, -2.0],
        joint_angles: vec![0.7, -1.5, 1.0, 2.4, 1.5, -1.0],
        base_twist: [0.2, 0.05, -0.03],
        joint_rates: vec![0.5, -0.8, 0.6, -0.4, 0.9, 0.7],
    }
}

fn run(law: &mut dyn Control<f64>, duration: f64, step: f64, scheme: Scheme, coordinates: Coordinates) -> Phase {
    let model = model();
    let timing = Timing { duration, step, sample: duration / 8.0, integration: Integration { scheme, coordinates } };
    simulate(&System::alone(&*model), law, &tumbling(), &timing, &mut NoEvents, &mut || ()).expect("a phase")
}

/// Under a law that knows of time, angles and rates.
fn swing(duration: f64, step: f64, scheme: Scheme, coordinates: Coordinates) -> Phase {
    let start = tumbling();
    let ends = Ends { initial_angles: &start.joint_angles, final_angles: &[0.2, -0.5, 0.4, 2.0, 1.0, 0.1], duration };
    let (stiffness, damping) = ([2.0; 6], [1.5; 6]);
    let trajectory = Cycloidal { ends };
    let mut law = ProportionalDerivative { trajectory, proportional_gain: &stiffness, derivative_gain: &damping };
    run(&mut law, duration, step, scheme, coordinates)
}

fn values(motion: &Motion) -> Vec<f64> {
    [&motion.base_pose[..], &motion.joint_angles, &motion.base_twist, &motion.joint_rates].concat()
}

fn error(phase: &Phase, reference: &Phase) -> f64 {
    let [found, wanted] = [phase, reference].map(|phase| values(&phase.end().expect("an end").motion));
    difference(&found, &wanted)
}

#[test]
fn orders_of_convergence() {
    let reference = swing(2.0, 0.05, ADAPTIVE, FULL);
    for (scheme, coordinates, order, steps) in [
        (Scheme::RungeKutta4, FULL, 4.0, [40.0, 80.0, 160.0]),
        (Scheme::RungeKutta4, REDUCED, 4.0, [40.0, 80.0, 160.0]),
        (Scheme::SemiImplicitEuler, FULL, 1.0, [1000.0, 2000.0, 4000.0]),
        (Scheme::SemiImplicitEuler, REDUCED, 1.0, [1000.0, 2000.0, 4000.0]),
        (Scheme::GaussLegendre, FULL, 6.0, [20.0, 40.0, 80.0]),
    ] {
        let errors = steps.map(|steps| error(&swing(2.0, 2.0 / steps, scheme, coordinates), &reference));
        for pair in errors.windows(2) {
            let found = (pair[0] / pair[1]).log2();
            println!("{scheme:?} {coordinates:?} {found} {errors:?}");
        }
    }
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        for coordinates in [FULL, REDUCED] {
            let phase = swing(2.0, 0.05, Scheme::Adaptive { tolerance }, coordinates);
            println!("{tolerance} {coordinates:?} {:e} {:?}", error(&phase, &reference), phase.drift);
        }
    }
}

#[test]
fn long() {
    for (scheme, step) in [
        (Scheme::RungeKutta4, 0.05),
        (Scheme::RungeKutta4, 0.02),
        (Scheme::GaussLegendre, 0.1),
        (Scheme::GaussLegendre, 0.2),
        (Scheme::GaussLegendre, 0.4),
        (Scheme::Adaptive { tolerance: 1e-10 }, 0.5),
    ] {
        let start = std::time::Instant::now();
        let phase = run(&mut Free, 200.0, step, scheme, FULL);
        println!("{scheme:?} {step} {:?} {:?}", phase.drift, start.elapsed());
    }
}
