//! Polynomials of degree 5 are continued, and stages moved onto them.

use super::Continuation;
use crate::integrate::blocks::{BLOCK, combine};
use crate::integrate::pair::{DORMAND_PRINCE, VERNER};

/// x = Σ cᵢ tⁱ and ẋ.
fn polynomial(time: f64) -> [f64; 2] {
    let coefficients = [0.3, -0.7, 0.5, 1.1, -0.4, 0.25];
    let value = coefficients.iter().rev().fold(0.0, |sum, c| sum * time + c);
    let rate =
        (1..6).rev().fold(0.0, |sum, i| sum * time + f64::from(i) * coefficients[usize::try_from(i).expect("small")]);
    [value, rate]
}

/// Whatever the lengths of the two steps are, and of which pair each is, every stage is on the polynomial, which without the
/// correction the first few are not.
#[test]
fn stages_are_on_a_polynomial() {
    let start = 0.2;
    for (last, pair) in [(&VERNER, &VERNER), (&DORMAND_PRINCE, &DORMAND_PRINCE), (&VERNER, &DORMAND_PRINCE)] {
        for [length, next] in [[0.5, 0.5], [0.3, 0.9], [0.8, 0.1]] {
            let stages_of = |nodes: &[f64], from: f64, length: f64| -> Vec<[f64; BLOCK]> {
                nodes.iter().map(|node| [polynomial(from + node * length)[1]; BLOCK]).collect()
            };
            let mut continuation = Continuation::default();
            continuation.reset(1);
            let before = stages_of(&last.nodes, start, length);
            continuation.follow(last, length, &before, &before[last.stages..=last.stages]);
            let from = start + length;
            let stages = stages_of(&pair.nodes, from, next);
            let mut missed = 0;
            for stage in 1..pair.all_stages() {
                let mut at = vec![[0.0; BLOCK]];
                combine(&[[polynomial(from)[0]; BLOCK]], next, &pair.rows[stage], &stages, &mut at);
                let expected = polynomial(from + pair.nodes[stage] * next)[0];
                missed += usize::from((at[0][0] - expected).abs() > 1e-9);
                if let Some(defects) = &pair.defects[stage] {
                    continuation.correct(next, defects, &mut at);
                }
                assert!(at[0].iter().all(|x| (x - expected).abs() < 3e-13), "{stage}: {:e}", at[0][0] - expected);
            }
            assert!((2..8).contains(&missed), "{missed}");
        }
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
