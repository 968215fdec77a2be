//! Robots of strange masses: the evaluated graph agrees with the generic implementation within what rounding explains.

use crate::evaluator;
use planar_capture::layout::Layout;
use planar_capture::quantities::differences;
use planar_capture::registry::generic;
use planar_capture::sampling::REGIMES;
use planar_proof::file;

const SAMPLES: u64 = 40;
const SEED: u64 = 11;

/// Evaluates the graph of a structure with other numbers, everywhere within the bounds of `compare`.
fn agrees(structure: &str, change: impl FnOnce(&mut Layout)) {
    let mut layout = Layout::read(&file(&format!("codegen/structures/{structure}.toml"))).expect("a layout");
    let evaluator = evaluator("structures", structure);
    change(&mut layout);
    let layout = Layout::parse(&layout.to_toml(), "strange").expect("no layout that is refused");
    let mut compared = 0;
    for regime in REGIMES {
        for index in 0..SAMPLES {
            let sample = regime.sample(&layout, SEED, index);
            let model = evaluator.model(&sample.layout).expect("its structure");
            let Ok(all) = differences(&model, &*generic(&sample.layout), &sample) else { continue };
            compared += 1;
            for difference in all {
                let (quantity, ratio) = (difference.quantity.row().name, difference.ratio());
                let regime = regime.name();
                assert!(
                    ratio <= 1.0,
                    "{quantity} is off by {ratio} × its bound: {regime}, state {index}: {difference:?}"
                );
            }
        }
    }
    let states = REGIMES.len() * usize::try_from(SAMPLES).expect("few");
    assert!(10 * compared >= 9 * states, "{compared} of {states} states had results");
}

/// Forward dynamics balances the base at the first mount, where its inertia is I + m |mount|²: what is left of I, and the
/// acceleration of the COM, a small difference of accelerations there, are right to rounding times the ratios.
#[test]
fn a_heavy_base_of_a_small_radius_of_gyration() {
    for (mass, inertia) in [(3e5, 9.0), (3e5, 9e4), (3e7, 1e-2), (3e9, 1e6)] {
        agrees("general_1x3", |layout| (layout.base.mass, layout.base.inertia) = (mass, inertia));
    }
}

/// A heavy inner link beside a base of grams: the base follows it, so that the generalized Jacobian of the other arm has
/// entries that are larger than its lengths and masses let expect.
#[test]
fn a_heavy_link_on_a_light_base() {
    agrees("general_2x3", |layout| {
        (layout.base.mass, layout.base.inertia) = (1.3e-3, 1.6e-6);
        let inertias =
            [[(6e-3, 3.6e-7), (483.0, 1.1e-3), (1.6e-4, 6e-9)], [(0.07, 1.6e-4), (3e-4, 1e-8), (3e-4, 1e-8)]];
        for (arm, inertias) in layout.arms.iter_mut().zip(inertias) {
            arm.mount = arm.mount.map(|length| 0.1 * length);
            for (link, (mass, inertia)) in arm.links.iter_mut().zip(inertias) {
                (link.length, link.com) = (0.1 * link.length, link.com.map(|length| 0.1 * length));
                (link.mass, link.inertia) = (mass, inertia);
            }
        }
    });
}
