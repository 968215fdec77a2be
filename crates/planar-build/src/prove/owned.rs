//! States and models on the heap, for the evaluation of one state here and for simulations in the root; the core
//! borrows both.

use planar_dynamics::dynamics::Model;
use planar_dynamics::scalar::Real;
use planar_dynamics::state;

/// A robot's state with its joints' numbers on the heap.
pub type RobotState<T = f64> = state::RobotState<T, Vec<T>>;

/// A [`Model`] on the heap whose copy has its numbers as they are now.
pub trait CloneModel<T: Real = f64>: Model<T> {
    /// The copy.
    fn clone_box(&self) -> Box<dyn CloneModel<T>>;
}

impl<T: Real, M: Model<T> + Clone + 'static> CloneModel<T> for M {
    fn clone_box(&self) -> Box<dyn CloneModel<T>> {
        Box::new(self.clone())
    }
}
