//! Polynomials of degree 5 are continued, and stages moved onto them.

use super::{Continuation, NODES};
use crate::integrate::pair::{ALL_STAGES, BLOCK, PAIR, STAGES, combine};

/// x = Σ cᵢ tⁱ and ẋ.
fn polynomial(time: f64) -> [f64; 2] {
    let coefficients = [0.3, -0.7, 0.5, 1.1, -0.4, 0.25];
    let value = coefficients.iter().rev().fold(0.0, |sum, c| sum * time + c);
    let rate =
        (1..6).rev().fold(0.0, |sum, i| sum * time + f64::from(i) * coefficients[usize::try_from(i).expect("small")]);
    [value, rate]
}

#[test]
fn nodes_are_those_of_the_pair() {
    for (stage, node) in NODES {
        assert!((PAIR.nodes[stage] - node).abs() < 1e-15, "{stage}");
    }
}

/// Whatever the lengths of the two steps are, every stage is on the polynomial, which without the correction the first
/// few are not.
#[test]
fn stages_are_on_a_polynomial() {
    let start = 0.2;
    for [length, next] in [[0.5, 0.5], [0.3, 0.9], [0.8, 0.1]] {
        let stages_of = |from: f64, length: f64| -> Vec<[f64; BLOCK]> {
            PAIR.nodes.iter().map(|node| [polynomial(from + node * length)[1]; BLOCK]).collect()
        };
        let mut continuation = Continuation::default();
        continuation.reset(1);
        let before = stages_of(start, length);
        continuation.follow(length, &before, &before[STAGES..=STAGES]);
        let from = start + length;
        let stages = stages_of(from, next);
        let mut missed = 0;
        for stage in 1..ALL_STAGES {
            let mut at = vec![[0.0; BLOCK]];
            combine(&[[polynomial(from)[0]; BLOCK]], next, &PAIR.rows[stage], &stages, &mut at);
            let expected = polynomial(from + PAIR.nodes[stage] * next)[0];
            missed += usize::from((at[0][0] - expected).abs() > 1e-9);
            if let Some((_, defects)) = PAIR.defects.iter().find(|(of, _)| *of == stage) {
                continuation.correct(next, defects, &mut at);
            }
            assert!(at[0].iter().all(|x| (x - expected).abs() < 1e-13), "{stage}: {:e}", at[0][0] - expected);
        }
        assert!((4..8).contains(&missed), "{missed}");
    }
}

/// Nothing is continued at the start.
#[test]
fn the_first_step_is_not_corrected() {
    let mut continuation = Continuation::default();
    continuation.reset(1);
    let mut at = vec![[1.0; BLOCK]];
    continuation.correct(0.5, &[1.0; 4], &mut at);
    assert_eq!(at, [[1.0; BLOCK]]);
}
