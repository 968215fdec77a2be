use super::rounded_down;

#[test]
fn one_digit_is_kept_and_nothing_grows() {
    for (value, kept) in [(0.0123, 0.01), (0.0099, 0.009), (1.0, 1.0), (4e-11, 4e-11), (0.3, 0.3), (25.9, 20.0)] {
        assert_eq!(rounded_down(value).to_bits(), f64::to_bits(kept), "{value}");
    }
}
