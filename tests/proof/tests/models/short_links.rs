//! Short links with next to no inertia between two joints: what is not refused is right to 1e-6.

use crate::evaluator;
use planar_capture::dynamics::ForwardDynamics;
use planar_capture::layout::Layout;
use planar_capture::registry::generic;
use planar_capture::state::{Forces, State};
use planar_proof::{file, tolerance};

/// Joint accelerations of the evaluated graph, which has no factorisation of the whole robot, against those of the generic
/// implementation, which has: their difference grows as the inertia beside a joint falls, and is refused before it is seen.
#[test]
fn links_that_are_not_refused_are_resolved() {
    let mut layout = Layout::read(&file("codegen/structures/general_1x3.toml")).expect("a layout");
    let evaluator = evaluator("structures", "general_1x3");
    let (mut accepted, mut largest) = (0, 0.0_f64);
    for short in [0, 1] {
        let whole = layout.arms[0].links[short].clone();
        for exponent in 0..32 {
            let length = 10.0_f64.powf(-0.25 * f64::from(exponent));
            let link = &mut layout.arms[0].links[short];
            (link.length, link.com) = (length, [0.5 * length, 0.1 * length]);
            link.inertia = link.mass * length * length / 12.0;
            let Ok(layout) = Layout::parse(&layout.to_toml(), "short") else { continue };
            accepted += 1;
            let model = evaluator.model(&layout).expect("its structure");
            let generic = generic(&layout);
            for turn in 0..8 {
                let angle = 0.4 + 0.7 * f64::from(turn);
                let state = State {
                    base_pose: [0.3, 0.0, 0.0],
                    joint_angles: &[angle, 2.0 - angle, 0.5 * angle],
                    base_twist: [0.1, -0.2, 0.3],
                    joint_rates: &[0.2, -0.3, 0.4],
                };
                let (mut found, mut expected) = ([0.0; 3], [0.0; 3]);
                let forces = Forces::torques(&[0.3, -0.2, 0.1]);
                model.forward_dynamics(&state, &forces, &mut found).expect("accelerations");
                generic.forward_dynamics(&state, &forces, &mut expected).expect("accelerations");
                let norm = |values: &[f64; 3]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
                let difference: [f64; 3] = std::array::from_fn(|i| found[i] - expected[i]);
                largest = largest.max(norm(&difference) / norm(&expected));
            }
        }
        layout.arms[0].links[short] = whole;
    }
    assert!((24..60).contains(&accepted), "{accepted} of 64 links");
    assert!(largest < tolerance::UNRESOLVED_LINK, "{largest:e}");
    // robots that fold lose far more at the same ratio of inertias, which is what they are refused by
    assert!(largest > 1e-5 * tolerance::UNRESOLVED_LINK, "{largest:e}: links are refused that are resolved");
}
