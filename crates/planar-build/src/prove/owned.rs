//! States and models on the heap, for the evaluation of one state here and for simulations in the root; the core
//! borrows both.
//!
//! # Example
//! ```
//! use planar_build::prove::generic::Generic;
//! use planar_build::prove::owned::CloneModel;
//! use planar_dynamics::target::Target;
//! use planar_layout::layout::Layout;
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
//! let layout = Layout::read(format!("{folder}/layouts/dual_arm_3r.toml").as_ref())?;
//! let robot: Box<dyn CloneModel> = Box::new(Generic::new(&layout));
//! let target = Target { mass: 20.0, inertia: 3.0, contact: [-0.3, 0.0], twist: [0.0; 3] };
//! let mut holding = robot.clone_box();
//! holding.merge(&[0.0; 3], &[0.5; 6], &[Some(target), None])?;
//! // the last link of the first arm becomes heavier, in the copy alone
//! let (mut before, mut after) = ([[0.0; 2]; 7], [[0.0; 2]; 7]);
//! robot.body_inertias(&mut before)?;
//! holding.body_inertias(&mut after)?;
//! assert_eq!((before[3][0], after[3][0]), (10.0, 30.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
