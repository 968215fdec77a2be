//! Coefficients against the conditions that they have to meet: orders, interpolants, stages on polynomials, stability.

use super::{DORMAND_PRINCE, Pair, SHARE, VERNER};

fn pairs() -> [(&'static str, &'static Pair); 2] {
    [("Verner", &*VERNER), ("Dormand & Prince", &*DORMAND_PRINCE)]
}

/// `Σ factor c^(q-1)` and, of a formula that integrates polynomials up to s, `s^q / q`.
fn powers(pair: &Pair, row: &[(usize, f64)], s: f64) -> impl Iterator<Item = [f64; 2]> {
    (1..=9).map(move |q| {
        let sum = row.iter().map(|(stage, factor)| factor * pair.nodes[*stage].powi(q - 1)).sum::<f64>();
        [sum, s.powi(q) / f64::from(q)]
    })
}

/// How many powers are integrated.
fn exact(pair: &Pair, row: &[(usize, f64)], s: f64) -> usize {
    powers(pair, row, s).take_while(|[found, expected]| (found - expected).abs() < 1e-11).count()
}

/// The weights of all stages at s, from 0 to 1, within a step.
fn weights_within(pair: &Pair, s: f64) -> Vec<(usize, f64)> {
    let angle = (2.0 * s - 1.0).acos();
    let polynomials = (0..).map(|k| s * (f64::from(k) * angle).cos()).zip(&pair.interpolant);
    polynomials.flat_map(|(value, row)| row.iter().map(move |(stage, factor)| (*stage, factor * value))).collect()
}

/// The end of a step integrates powers of time up to its order, its estimate of the error none of them, and the interpolant
/// those up to its own, at the end as at the other times.
#[test]
fn powers_of_time_are_integrated() {
    for ((name, pair), [order, lower, dense]) in pairs().into_iter().zip([[9, 8, 9], [8, 7, 7]]) {
        assert!(exact(pair, &pair.weights, 1.0) >= order, "{name}");
        let vanishing = powers(pair, &pair.errors, 0.0).take_while(|[found, _]| found.abs() < 1e-12).count();
        assert!(vanishing >= lower, "{name}: {vanishing}");
        for s in [0.0, 0.1, 0.5, 0.9, 1.0] {
            let weights = weights_within(pair, s);
            assert!(exact(pair, &weights, s) >= dense, "{name} {s}");
            // so much and no more between the ends
            assert!(s.fract() == 0.0 || exact(pair, &weights, s) < 9 || dense == 9, "{name} {s}");
        }
    }
    // the first power that is not left out is estimated with its share
    let share = powers(&DORMAND_PRINCE, &DORMAND_PRINCE.errors, 0.0).nth(7).expect("a power")[0];
    assert!((share / SHARE - 1.0).abs() < 1e-9, "{share}");
}

/// Rounding errors within a step are those of sums with small factors: of a linear relation between coordinates, which weights
/// that are computed first would keep, no more is lost than at its end.
#[test]
fn factors_of_interpolants_are_small() {
    for (name, pair) in pairs() {
        let factors = pair.interpolant.iter().flatten().map(|(_, factor)| factor.abs());
        let largest = factors.fold(0.0, f64::max);
        assert!(largest < 8.0, "{name}: {largest}");
    }
}

/// Stages are on polynomials of degree 5 but for the first few, whose defects are known: those are corrected, and the
/// others continue the motion.
#[test]
fn stages_after_the_first_few_are_on_polynomials() {
    for (name, pair) in pairs() {
        let defects: Vec<usize> = (0..pair.all_stages()).filter(|stage| pair.defects[*stage].is_some()).collect();
        assert!((4..8).contains(&defects.len()) && defects.iter().all(|stage| *stage < 8), "{name}: {defects:?}");
        assert!(pair.continued.iter().all(|stage| pair.defects[*stage].is_none()), "{name}");
        let nodes = pair.continued.map(|stage| pair.nodes[stage]);
        assert!(nodes.is_sorted() && nodes[0] == 0.0 && (nodes[4] - 1.0).abs() < 1e-15, "{name}: {nodes:?}");
    }
}

/// Of ẋ = z x a step of length 1 multiplies by a polynomial of z, which is no more than 1 up to here on the negative axis.
fn stable_up_to(pair: &Pair) -> f64 {
    let growth = |z: f64| {
        let mut rates: Vec<f64> = Vec::new();
        let sum = |rates: &[f64], row: &[(usize, f64)]| row.iter().map(|(stage, a)| a * rates[*stage]).sum::<f64>();
        for row in &pair.rows[..pair.stages] {
            rates.push(z * (1.0 + sum(&rates, row)));
        }
        1.0 + sum(&rates, &pair.weights)
    };
    (1..1000).map(|i| 0.01 * f64::from(i)).take_while(|z| growth(-z).abs() <= 1.0).last().expect("a stable step")
}

/// Why feedback takes the one, and nothing else does.
#[test]
fn stable_steps_are_longer_by_the_pair_for_feedback() {
    let [verner, dormand_prince] = pairs().map(|(_, pair)| stable_up_to(pair));
    assert!((verner - 4.44).abs() < 0.02 && (dormand_prince - 6.4).abs() < 0.02, "{verner} {dormand_prince}");
    assert_eq!(pairs().map(|(_, pair)| pair.stages), [16, 12]);
    assert!((VERNER.landing() - 0.64).abs() < 1e-15);
}
