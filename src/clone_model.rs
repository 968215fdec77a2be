//! Models behind a pointer that can be copied.

use crate::dynamics::Model;

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
