//! Identities of mechanics, for every shipped layout at random states.
//!
//! A state that fails is shrunk and printed as `planar-capture eval LAYOUT STATES.json` reads it.

use planar_capture::scalar::Dual;
use planar_capture::target::Target;
use planar_proof::for_every_layout;
use planar_proof::sample::RandomState;

mod impact;
mod inertia;
mod motion;

#[test]
fn every_shipped_layout_is_here() {
    macro_rules! names {
        ($($layout:ident)*) => {
            [$(stringify!($layout)),*]
        };
    }
    macro_rules! listed {
        ($($layout:ident)*) => {
            const LISTED: &[&str] = &names!($($layout)*);
        };
    }
    for_every_layout!(listed);
    let shipped: Vec<&str> = planar_capture::registry::SHIPPED.iter().map(|(name, _)| *name).collect();
    assert_eq!(LISTED.len(), shipped.len());
    assert!(shipped.iter().all(|name| LISTED.contains(name)), "{shipped:?} are shipped, {LISTED:?} are tested");
}

/// Fails unless two numbers agree relative to a scale.
#[track_caller]
fn close(what: &str, found: f64, expected: f64, scale: f64, tolerance: f64) {
    let difference = (found - expected).abs();
    assert!(
        difference <= tolerance * scale,
        "{what}: {found:e} and {expected:e} differ by {:e} of {scale:e}, bound {tolerance:e}",
        difference / scale
    );
}

/// Base pose, joint angles, base twist, joint rates.
type Inputs<const J: usize> = ([f64; 3], [f64; J], [f64; 3], [f64; J]);

fn inputs<const J: usize>(s: &RandomState) -> Inputs<J> {
    let array = |v: &[f64]| -> [f64; J] { v.try_into().expect("as many as joints") };
    (s.base_pose, array(&s.joint_angles), s.base_twist, array(&s.joint_rates))
}

/// v, with the base twist first.
fn velocity<const N: usize>(s: &RandomState) -> [f64; N] {
    let all: Vec<f64> = s.base_twist.iter().chain(&s.joint_rates).copied().collect();
    all.try_into().expect("as many as coordinates")
}

/// The configuration moving with v: values and rates as dual numbers.
fn moving<const J: usize>(s: &RandomState, v: &[f64]) -> ([Dual; 3], [Dual; J]) {
    let (pose, angles, ..) = inputs::<J>(s);
    (std::array::from_fn(|i| Dual(pose[i], v[i])), std::array::from_fn(|i| Dual(angles[i], v[3 + i])))
}

/// One target per arm.
fn targets<const A: usize>(s: &RandomState) -> [Target<f64>; A] {
    std::array::from_fn(|arm| {
        let ([mass, inertia, rx, ry], twist) = s.targets[arm];
        Target { mass, inertia, contact: [rx, ry], twist }
    })
}
