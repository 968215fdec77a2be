//! Sample times of control laws, in steps of their phase.

use crate::simulate::{ROUNDING, Timing};

impl Timing {
    /// Of these s, by steps of at most `step` s.
    #[must_use]
    pub fn of_steps(duration: f64, step: f64) -> Self {
        Self { duration, step, sample: step, ..Self::default() }
    }

    /// The length of its equal steps, s; at most `step`.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "at most 1e8 steps are read")]
    pub fn step_length(&self) -> f64 {
        self.duration / self.steps() as f64
    }

    /// With steps of the length of its equal ones, as a law needs that holds its torques for so many of them.
    #[must_use]
    pub(crate) fn held(self, steps_per_sample: Option<u32>) -> Self {
        Self { step: if steps_per_sample.is_some() { self.step_length() } else { self.step }, ..self }
    }

    /// How many steps a time has, at least one; `None` for another number of them than a whole one.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number of that range")]
    pub fn whole_steps(&self, time: f64) -> Option<u32> {
        let steps = time / self.step_length();
        let whole = steps.round();
        let is_whole = (1.0..=f64::from(u32::MAX)).contains(&whole) && (steps - whole).abs() <= ROUNDING;
        is_whole.then_some(whole as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::Timing;

    #[test]
    fn times_are_whole_numbers_of_the_equal_steps() {
        // 0.3 s does not divide 1 s: four steps of 0.25 s
        let timing = Timing::of_steps(1.0, 0.3);
        assert_eq!(timing.step_length().to_bits(), 0.25_f64.to_bits());
        assert_eq!([0.5, 0.25, 7.0].map(|time| timing.whole_steps(time)), [Some(2), Some(1), Some(28)]);
        assert_eq!([0.3, 0.6, 0.0, -0.25, 1e300, f64::NAN].map(|time| timing.whole_steps(time)), [None; 6]);
        // decimal fractions: 0.3 / 0.1 is less than 3
        assert_eq!(Timing::of_steps(50.0, 0.1).whole_steps(0.3), Some(3));
    }
}
