//! What adaptive steps integrate.

use crate::error::Error;

/// A motion ẋ = f(t, x). A function of t and x that writes f to its last argument is one.
pub trait Motion {
    /// Writes f(t, x) to `rate`.
    ///
    /// # Errors
    /// Those of f, which end the step.
    fn derivative(&mut self, time: f64, x: &[f64], rate: &mut [f64]) -> Result<(), Error>;

    /// Before a step may change the x that it starts from; says whether it did.
    ///
    /// # Errors
    /// Where there is no x to start from.
    fn restore(&mut self, _x: &mut [f64]) -> Result<bool, Error> {
        Ok(false)
    }
}

impl<F: FnMut(f64, &[f64], &mut [f64]) -> Result<(), Error>> Motion for F {
    fn derivative(&mut self, time: f64, x: &[f64], rate: &mut [f64]) -> Result<(), Error> {
        self(time, x, rate)
    }
}
