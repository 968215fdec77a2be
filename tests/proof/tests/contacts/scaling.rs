//! Impacts are homogeneous in the velocities: with all of them scaled, velocities and impulses after it are, bit by bit
//! for a power of two.

use crate::product::{both_models, solve_impact, targets_and_contacts};
use crate::scaled_velocities;
use planar_capture::body::Body;
use planar_capture::error::Error;
use planar_proof::layout;
use planar_proof::maximal::random::{Scene, random_contacts};
use planar_proof::sample::config;
use proptest::prelude::*;

/// Velocities and impulses after an impact, those of a repeated first contact too.
fn impact(scene: &Scene, scale: f64) -> Vec<Result<Vec<f64>, Error>> {
    let (bodies, mut contacts) = targets_and_contacts(scene);
    let bodies: Vec<_> = bodies.iter().map(|b| Body { twist: b.twist.map(|v| v * scale), ..*b }).collect();
    contacts.push(contacts[0]);
    let state = scaled_velocities(scene.state.clone(), scale);
    let mut results = Vec::new();
    for model in both_models(&layout("triple_arm_3r")) {
        for contacts in [&contacts[..], &contacts[..contacts.len() - 1]] {
            let found = solve_impact(&*model, &state.state(), &bodies, contacts);
            results.push(found.map(|found| [&found.velocities()[..], found.impulses.as_flattened()].concat()));
        }
    }
    results
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn impacts_are_homogeneous(scene in random_contacts(layout("triple_arm_3r"))) {
        let expected = impact(&scene, 1.0);
        for exponent in [-80, -20, 20, 80] {
            let scale = 2.0_f64.powi(exponent);
            let found = impact(&scene, scale).into_iter().map(|result| {
                result.map(|numbers| numbers.iter().map(|number| number / scale).collect::<Vec<_>>())
            });
            for (found, expected) in found.zip(&expected) {
                match (&found, expected) {
                    (Ok(found), Ok(expected)) => prop_assert_eq!(found, expected),
                    (Err(Error::Singular { .. }), Err(Error::Singular { .. })) => {}
                    _ => prop_assert!(false, "{:?} {:?}", found, expected),
                }
            }
        }
    }
}
