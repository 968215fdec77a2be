//! The integrated vector in the form of the crate `differential-equations`, with its sums of stages in one loop without
//! checks of every index, and without the products by zeros, of which tableaux are full.

use differential_equations::traits::State;

/// The entries of an integrated vector.
#[derive(Clone, Debug)]
pub(super) struct Entries(pub(super) Vec<f64>);

impl State<f64> for Entries {
    fn len(&self) -> usize {
        self.0.len()
    }

    fn get_component(&self, index: usize) -> f64 {
        self.0[index]
    }

    fn set_component(&mut self, index: usize, value: f64) {
        self.0[index] = value;
    }

    fn map_components_mut<F: FnMut(usize, &mut f64)>(&mut self, mut change: F) {
        self.0.iter_mut().enumerate().for_each(|(i, entry)| change(i, entry));
    }

    fn zeros_like(&self) -> Self {
        Self(vec![0.0; self.0.len()])
    }

    fn zeros() -> Self {
        Self(Vec::new())
    }

    fn mul_add_assign(&mut self, factor: f64, other: &Self) {
        self.add_scaled(factor, other);
    }

    fn scale_mut(&mut self, factor: f64) {
        self.0.iter_mut().for_each(|entry| *entry *= factor);
    }

    fn add_scaled(&mut self, factor: f64, other: &Self) -> &mut Self {
        if factor != 0.0 {
            self.0.iter_mut().zip(&other.0).for_each(|(entry, other)| *entry += factor * other);
        }
        self
    }
}
