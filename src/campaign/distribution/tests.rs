use super::{Distribution, Kind};
use crate::scenario::variation::VariedValue;

/// `scipy.stats`: `norm`, `truncnorm`, `lognorm`, `uniform`, `triang`.
#[test]
#[allow(clippy::unreadable_literal, reason = "as scipy writes them")]
fn quantiles_are_those_of_scipy() {
    let cases = [
        (Kind::Normal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, f64::INFINITY], 0.001, 3.8195353876643736),
        (Kind::Normal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, f64::INFINITY], 0.25, 8.651020499607837),
        (Kind::Normal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, f64::INFINITY], 0.5, 10.0),
        (Kind::Normal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, f64::INFINITY], 0.9, 12.5631031310892),
        (Kind::Normal { mean: 10.0, std: 2.0 }, [9.0, 14.0], 0.001, 9.003796996426784),
        (Kind::Normal { mean: 10.0, std: 2.0 }, [9.0, 14.0], 0.25, 9.878180895845235),
        (Kind::Normal { mean: 10.0, std: 2.0 }, [9.0, 14.0], 0.5, 10.732408708744018),
        (Kind::Normal { mean: 10.0, std: 2.0 }, [9.0, 14.0], 0.9, 12.686180639076753),
        (Kind::Normal { mean: 0.0, std: 1.0 }, [8.5, f64::INFINITY], 0.001, 8.500116139370292),
        (Kind::Normal { mean: 0.0, std: 1.0 }, [8.5, f64::INFINITY], 0.25, 8.533331071146787),
        (Kind::Normal { mean: 0.0, std: 1.0 }, [8.5, f64::INFINITY], 0.5, 8.580094356783988),
        (Kind::Normal { mean: 0.0, std: 1.0 }, [8.5, f64::INFINITY], 0.9, 8.763315136652597),
        (Kind::LogNormal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, f64::INFINITY], 0.001, 5.3173673967908),
        (Kind::LogNormal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, f64::INFINITY], 0.25, 8.579685880089245),
        (Kind::LogNormal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, f64::INFINITY], 0.5, 9.8058067569092),
        (Kind::LogNormal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, f64::INFINITY], 0.9, 12.63885789754227),
        (Kind::LogNormal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, 11.0], 0.001, 5.216582363873637),
        (Kind::LogNormal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, 11.0], 0.25, 8.178683025238506),
        (Kind::LogNormal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, 11.0], 0.5, 9.131743150853719),
        (Kind::LogNormal { mean: 10.0, std: 2.0 }, [f64::NEG_INFINITY, 11.0], 0.9, 10.567703307245305),
        (Kind::Uniform { min: -1.0, max: 3.0 }, [0.0, f64::INFINITY], 0.001, 0.003),
        (Kind::Uniform { min: -1.0, max: 3.0 }, [0.0, f64::INFINITY], 0.25, 0.75),
        (Kind::Uniform { min: -1.0, max: 3.0 }, [0.0, f64::INFINITY], 0.5, 1.5),
        (Kind::Uniform { min: -1.0, max: 3.0 }, [0.0, f64::INFINITY], 0.9, 2.7),
        (
            Kind::Triangular { min: 1.0, mode: 2.0, max: 5.0 },
            [f64::NEG_INFINITY, f64::INFINITY],
            0.001,
            1.0632455532033676,
        ),
        (Kind::Triangular { min: 1.0, mode: 2.0, max: 5.0 }, [f64::NEG_INFINITY, f64::INFINITY], 0.25, 2.0),
        (
            Kind::Triangular { min: 1.0, mode: 2.0, max: 5.0 },
            [f64::NEG_INFINITY, f64::INFINITY],
            0.5,
            2.550510257216822,
        ),
        (
            Kind::Triangular { min: 1.0, mode: 2.0, max: 5.0 },
            [f64::NEG_INFINITY, f64::INFINITY],
            0.9,
            3.904554884989668,
        ),
        (Kind::Triangular { min: 1.0, mode: 2.0, max: 5.0 }, [1.5, 4.0], 0.001, 1.5034050721503178),
        (Kind::Triangular { min: 1.0, mode: 2.0, max: 5.0 }, [1.5, 4.0], 0.25, 2.052543469362101),
        (Kind::Triangular { min: 1.0, mode: 2.0, max: 5.0 }, [1.5, 4.0], 0.5, 2.5251262658470837),
        (Kind::Triangular { min: 1.0, mode: 2.0, max: 5.0 }, [1.5, 4.0], 0.9, 3.576975052924229),
    ];
    for (kind, bounds, u, expected) in cases {
        let distribution = Distribution { kind, bounds };
        let found = distribution.quantile(u).number().expect("a number");
        assert!((found - expected).abs() <= 1e-13 * expected.abs().max(1.0), "{distribution:?}, {u}: {found}");
    }
}

#[test]
fn values_stay_within_their_bounds() {
    let bounds = [9.5, 10.25];
    for kind in [
        Kind::Normal { mean: 10.0, std: 2.0 },
        Kind::LogNormal { mean: 10.0, std: 2.0 },
        Kind::Uniform { min: 0.0, max: 10.0 },
        Kind::Triangular { min: 0.0, mode: 1.0, max: 12.0 },
    ] {
        let distribution = Distribution { kind, bounds };
        let values = [1e-300, 0.5, 1.0 - f64::EPSILON / 2.0].map(|u| distribution.quantile(u).number());
        assert!(values.into_iter().flatten().all(|value| (9.5..=10.25).contains(&value)), "{values:?}");
        assert!(values.is_sorted(), "{values:?}");
        assert!(distribution.mass_within_bounds() > 0.01);
    }
    let outside = Distribution { kind: Kind::Uniform { min: 0.0, max: 1.0 }, bounds };
    assert!(outside.mass_within_bounds() <= 0.0);
    let far = Distribution { kind: Kind::Normal { mean: 0.0, std: 1.0 }, bounds: [30.0, 31.0] };
    assert!(far.mass_within_bounds() > 0.0, "by the tail");
}

#[test]
fn choices_are_equally_likely() {
    let values = ["a", "b", "c"].map(|name| VariedValue::Text(name.to_owned()));
    let choice = Distribution { kind: Kind::Choice(values.to_vec()), bounds: [f64::NEG_INFINITY, f64::INFINITY] };
    let found = [0.1, 0.34, 0.99, 1.0 - f64::EPSILON / 2.0].map(|u| choice.quantile(u));
    assert_eq!(found, [0, 1, 2, 2].map(|i: usize| values[i].clone()));
}

/// Of a triangular distribution the upper end alone: `12 - x` is the root of a probability that has all its digits.
#[test]
fn the_upper_end_of_a_triangular_distribution_has_its_digits() {
    let width = 1e-6;
    let kind = Kind::Triangular { min: 0.0, mode: 1.0, max: 12.0 };
    let end = Distribution { kind, bounds: [12.0 - width, f64::INFINITY] };
    for u in [0.001, 0.25, 0.5, 0.9] {
        let below = 12.0 - end.quantile(u).number().expect("a number");
        assert!((below / (width * f64::sqrt(1.0 - u)) - 1.0).abs() < 1e-8, "{u}: {below:e}");
    }
    let mass = width * width / (12.0 * 11.0);
    assert!((end.mass_within_bounds() / mass - 1.0).abs() < 1e-8, "{:e}", end.mass_within_bounds());
}

/// In words, both bounds with it, each where there is one.
#[test]
fn distributions_are_described_with_their_bounds() {
    let none = [f64::NEG_INFINITY, f64::INFINITY];
    let normal = || Kind::Normal { mean: 10.0, std: 1.5 };
    for (kind, bounds, words) in [
        (normal(), none, "normal, mean 10, standard deviation 1.5"),
        (normal(), [5.0, f64::INFINITY], "normal, mean 10, standard deviation 1.5, at least 5"),
        (normal(), [f64::NEG_INFINITY, 12.0], "normal, mean 10, standard deviation 1.5, at most 12"),
        (
            Kind::LogNormal { mean: 1.0, std: 0.2 },
            [0.5, 2.0],
            "lognormal, mean 1, standard deviation 0.2, at least 0.5, at most 2",
        ),
        (Kind::Uniform { min: -1.0, max: 3.0 }, none, "uniform from -1 to 3"),
        (Kind::Triangular { min: 1.0, mode: 2.0, max: 5.0 }, none, "triangular from 1 to 5, most likely 2"),
    ] {
        assert_eq!(Distribution { kind, bounds }.to_string(), words);
    }
}
