//! States and models on the heap, for the evaluation of one state here and for simulations in the root; the core
//! borrows both.

use planar_dynamics::dynamics::Model;
use planar_dynamics::state;

/// A robot's state with its joints' numbers on the heap.
pub type RobotState = state::RobotState<f64, Vec<f64>>;

/// A [`Model`] on the heap whose copy has its numbers as they are now.
pub trait CloneModel: Model<f64> {
    /// The copy.
    fn clone_box(&self) -> Box<dyn CloneModel>;
}

impl<M: Model<f64> + Clone + 'static> CloneModel for M {
    fn clone_box(&self) -> Box<dyn CloneModel> {
        Box::new(self.clone())
    }
}
