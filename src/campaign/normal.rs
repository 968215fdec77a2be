//! The standard normal distribution, by `libm` alone: the same bits everywhere.

use std::f64::consts::FRAC_1_SQRT_2;

/// Φ(z), the probability of a value below z.
#[must_use]
pub fn cumulative(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Φ⁻¹(p) for 0 < p < 1, to some 1e-15 of it.
///
/// Wichura (1988), *Algorithm AS 241: The percentage points of the normal distribution*, PPND16: rational functions in
/// the middle and in both tails.
#[must_use]
pub fn quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(&MIDDLE, 0.180_625 - q * q);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    let r = libm::sqrt(-libm::log(tail));
    let z = if r <= 5.0 { ratio(&TAIL, r - 1.6) } else { ratio(&FAR_TAIL, r - 5.0) };
    if q < 0.0 { -z } else { z }
}

/// Numerator and denominator of a rational function, the coefficients of x⁰ first.
type Ratio = [[f64; 8]; 2];

fn ratio(coefficients: &Ratio, x: f64) -> f64 {
    let [numerator, denominator] =
        coefficients.each_ref().map(|terms| terms.iter().rev().fold(0.0, |sum, term| sum * x + term));
    numerator / denominator
}

#[rustfmt::skip]
const MIDDLE: Ratio = [
    [
        3.387_132_872_796_366_5, 1.331_416_678_917_843_8e2, 1.971_590_950_306_551_3e3, 1.373_169_376_550_946e4,
        4.592_195_393_154_987e4, 6.726_577_092_700_87e4, 3.343_057_558_358_813e4, 2.509_080_928_730_122_7e3,
    ],
    [
        1.0, 4.231_333_070_160_091e1, 6.871_870_074_920_579e2, 5.394_196_021_424_751e3,
        2.121_379_430_158_659_7e4, 3.930_789_580_009_271e4, 2.872_908_573_572_194_3e4, 5.226_495_278_852_854e3,
    ],
];

#[rustfmt::skip]
const TAIL: Ratio = [
    [
        1.423_437_110_749_683_5, 4.630_337_846_156_546, 5.769_497_221_460_691, 3.647_848_324_763_204_5,
        1.270_458_252_452_368_4, 2.417_807_251_774_506e-1, 2.272_384_498_926_918_4e-2, 7.745_450_142_783_414e-4,
    ],
    [
        1.0, 2.053_191_626_637_759, 1.676_384_830_183_803_8, 6.897_673_349_851e-1,
        1.481_039_764_274_800_8e-1, 1.519_866_656_361_645_7e-2, 5.475_938_084_995_345e-4, 1.050_750_071_644_416_9e-9,
    ],
];

#[rustfmt::skip]
const FAR_TAIL: Ratio = [
    [
        6.657_904_643_501_103, 5.463_784_911_164_114, 1.784_826_539_917_291_3, 2.965_605_718_285_048_7e-1,
        2.653_218_952_657_612_4e-2, 1.242_660_947_388_078_4e-3, 2.711_555_568_743_487_6e-5, 2.010_334_399_292_288_1e-7,
    ],
    [
        1.0, 5.998_322_065_558_88e-1, 1.369_298_809_227_358e-1, 1.487_536_129_085_061_5e-2,
        7.868_691_311_456_133e-4, 1.846_318_317_510_054_8e-5, 1.421_511_758_316_446e-7, 2.044_263_103_389_939_8e-15,
    ],
];

#[cfg(test)]
mod tests {
    use super::{cumulative, quantile};

    /// `scipy.special.ndtri`.
    #[test]
    fn quantiles_are_those_of_scipy() {
        const EXPECTED: &[(f64, f64)] = &[
            (1e-300, -37.047_096_299_361_2),
            (1e-17, -8.493_793_224_109_599),
            (1e-09, -5.997_807_015_007_686_5),
            (0.001, -3.090_232_306_167_813),
            (0.02425, -1.972_961_051_311_885),
            (0.075, -1.439_531_470_938_456_3),
            (0.0751, -1.438_825_392_752_540_3),
            (0.3, -0.524_400_512_708_040_9),
            (0.5, 0.0),
            (0.6, 0.253_347_103_135_799_7),
            (0.925, 1.439_531_470_938_456_3),
            (0.99, 2.326_347_874_040_840_8),
            (0.999_999, 4.753_424_308_817_087),
        ];
        for &(p, z) in EXPECTED {
            assert!((quantile(p) - z).abs() <= 1e-15 * z.abs().max(1.0), "{p}: {:e}", quantile(p) - z);
        }
    }

    #[test]
    fn quantiles_invert_the_cumulative_distribution() {
        for k in 1..2000 {
            let p = f64::from(k) / 2000.0;
            assert!((cumulative(quantile(p)) - p).abs() <= 4e-16, "{p}");
        }
        let far = quantile(1e-300);
        assert!((cumulative(far) / 1e-300 - 1.0).abs() < 1e-12, "{far}");
    }
}
