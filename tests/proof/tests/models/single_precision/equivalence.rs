//! Every quantity of every layout and regime in `f32` against the generic implementation in `f64`, which gets the same
//! numbers: those of the sample, rounded to `f32`. The bounds are those of `f64` in rounding units.

use super::MODELS;
use planar_capture::dynamics::Model;
use planar_capture::error::Error;
use planar_capture::evaluation::{EvaluationInput, evaluate_all};
use planar_capture::impact::{self, PaperImpactWorkspace, RigidImpactOutput};
use planar_capture::quantities::{differences, natural_sizes};
use planar_capture::quantity::Quantity;
use planar_capture::registry::generic;
use planar_capture::sampling::{REGIMES, Regime, RegimeSample};
use planar_capture::scalar::Real;
use planar_proof::layout;
use planar_proof::tolerance::{REFUSED_CONDITION, SAYS_SOMETHING, equivalence};
use std::collections::BTreeSet;

/// States of each regime and layout.
const SAMPLES: u64 = 40;
const SEED: u64 = 20_261_123;

/// The same with numbers that `f32` has.
fn rounded(sample: &RegimeSample) -> RegimeSample {
    #[allow(clippy::cast_possible_truncation, reason = "that is what it does")]
    let one = |x: &mut f64| *x = f64::from(*x as f32);
    let mut layout = sample.layout.clone();
    one(&mut layout.base.mass);
    one(&mut layout.base.inertia);
    for arm in &mut layout.arms {
        arm.mount.iter_mut().for_each(one);
        one(&mut arm.mount_angle);
        for link in &mut arm.links {
            [&mut link.mass, &mut link.inertia, &mut link.length].into_iter().for_each(one);
            link.com.iter_mut().for_each(one);
        }
    }
    RegimeSample { layout, instant: sample.instant.rounded::<f32>().rounded() }
}

/// The largest condition of what a state is solved with.
fn condition(sample: &RegimeSample) -> f64 {
    let values = evaluate_all(&*generic(&sample.layout), &sample.instant).expect("answers");
    natural_sizes(sample, &values).values().fold(1.0, |most, size| Real::maximum(most, size.condition))
}

/// Every quantity is within its bound; an error is a system that is singular in `f32`.
#[test]
fn single_precision_agrees_with_the_generic_implementation() {
    for (name, model) in MODELS {
        let layout = layout(name);
        let (mut seen, mut compared, mut telling) = (BTreeSet::new(), 0, 0);
        for (regime, index) in REGIMES.into_iter().flat_map(|regime| (0..SAMPLES).map(move |index| (regime, index))) {
            let at = || format!("{name}, seed {SEED}, regime `{}`, state {index}", regime.name());
            let sample = rounded(&regime.sample(&layout, SEED, index));
            match differences(&*model(&sample.layout), &*generic(&sample.layout), &sample) {
                Ok(all) => {
                    for difference in all {
                        let bound = equivalence(difference.quantity).bound::<f32>(difference.condition);
                        let (quantity, error) = (difference.quantity.row().name, difference.error);
                        assert!(error <= bound, "{}: {quantity} is off by {error:e}, bound {bound:e}", at());
                        compared += 1;
                        if bound <= SAYS_SOMETHING {
                            telling += 1;
                            seen.insert(difference.quantity);
                        }
                    }
                }
                Err([Some(Error::Singular { what, .. }), None]) => {
                    let condition = condition(&sample);
                    assert!(condition >= REFUSED_CONDITION, "{}: {what} is refused at {condition:e}", at());
                }
                Err(errors) => panic!("{}: {errors:?}", at()),
            }
        }
        let missing: Vec<_> = Quantity::ALL.iter().filter(|quantity| !seen.contains(quantity)).collect();
        assert!(missing.is_empty(), "{name}: never compared: {missing:?}");
        assert!(10 * telling > 8 * compared, "{name}: {telling} of {compared} comparisons say something");
    }
}

/// The paper's impact with the velocities and impulses that follow from it.
fn paper<T: Real>(model: &dyn Model<T>, instant: &EvaluationInput<T>) -> Result<[Vec<f64>; 4], Error> {
    let (arms, joints) = (model.arms(), model.joints());
    let (mut rates, mut twists, mut impulses) =
        (vec![T::ZERO; joints], vec![[T::ZERO; 3]; arms], vec![[T::ZERO; 3]; arms]);
    let mut workspace = PaperImpactWorkspace {
        impact_matrix: &mut vec![T::ZERO; joints * joints],
        impact_momentum: &mut vec![T::ZERO; joints],
        jacobian: &mut vec![T::ZERO; 3 * arms * joints],
        mass_matrix: &mut vec![T::ZERO; (3 + joints) * (3 + joints)],
    };
    let mut after = RigidImpactOutput { joint_rates: &mut rates, target_twists: &mut twists, impulses: &mut impulses };
    let base = impact::paper(model, &instant.state.view(), &instant.targets, &mut workspace, &mut after)?;
    let widened = |values: &[T]| values.iter().map(|x| x.to_f64()).collect();
    Ok([widened(&base), widened(&rates), widened(twists.as_flattened()), widened(impulses.as_flattened())])
}

/// The paper's impact; its results are of the sizes of the exact one's, and its joint rates are solved for.
#[test]
fn the_papers_impact_agrees() {
    for (name, model) in MODELS {
        let layout = layout(name);
        let mut compared = 0;
        for index in 0..SAMPLES {
            let mut sample = rounded(&Regime::Moving.sample(&layout, SEED, index));
            // eq. (17) has momenta about the origin
            sample.instant.state.base_pose = [sample.instant.state.base_pose[0], 0.0, 0.0];
            if sample.instant.targets.iter().all(Option::is_none) {
                continue;
            }
            let (single, double) = (model(&sample.layout), generic(&sample.layout));
            let values = evaluate_all(&*double, &sample.instant).expect("answers");
            let sizes = natural_sizes(&sample, &values);
            let quantity = Quantity::ImpactJointRates;
            let bound = equivalence(quantity).bound::<f32>(sizes[&quantity].condition);
            let found = paper(&*single, &sample.instant.rounded()).expect("an impact");
            let expected = paper(&*double, &sample.instant).expect("an impact");
            for ((found, expected), quantity) in found.iter().zip(&expected).zip(AFTER) {
                let each = found.iter().zip(expected).zip(&sizes[&quantity].sizes);
                for ((found, expected), size) in each {
                    let error = (found - expected).abs();
                    let quantity = quantity.row().name;
                    assert!(
                        error <= bound * size,
                        "{name}, state {index}: {quantity} by the paper is off by {error:e}"
                    );
                }
                compared += 1;
            }
        }
        assert!(compared > SAMPLES);
    }
}

/// What [`paper`] gives.
const AFTER: [Quantity; 4] =
    [Quantity::CaptureBaseTwist, Quantity::CaptureJointRates, Quantity::CaptureTargetTwists, Quantity::CaptureImpulses];

/// The bounds are not so wide that they hide a change of a hundredth; of a tenth in what is solved for, which the condition
/// magnifies.
#[test]
fn a_change_of_a_hundredth_is_seen() {
    for (name, model) in MODELS {
        let layout = layout(name);
        let sample = rounded(&Regime::Moving.sample(&layout, SEED, 0));
        for (factor, quantity) in
            [(1.01, Quantity::MassMatrix), (1.01, Quantity::LinearMomentum), (1.1, Quantity::JointAccelerations)]
        {
            let mut changed = layout.clone();
            changed.arms[0].links[0].mass *= factor;
            let all = differences(&*model(&changed), &*generic(&sample.layout), &sample).expect("answers");
            let difference = all.iter().find(|difference| difference.quantity == quantity).expect("a difference");
            let bound = equivalence(quantity).bound::<f32>(difference.condition);
            let says_something = bound < SAYS_SOMETHING / 10.0;
            assert!(difference.error > bound || !says_something, "{name}: {quantity:?} hides a factor of {factor}");
        }
    }
}
