//! Models rendered from the graphs in `codegen/graphs`, one module per layout.
//!
//! Each has inherent functions over arrays, without a failing path, and the traits of [`crate::dynamics`].
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model, Parameters};
//!
//! let paper = Model::<f64>::default();
//! let heavier = Model::new(Parameters { base_mass: 600.0, ..*paper.parameters() });
//! let [light, heavy] = [&paper, &heavier].map(|robot| {
//!     let at_rest = [0.0; JOINTS];
//!     robot.momentum(&[0.0; 3], &at_rest, &[0.0, 0.1, 0.0], &at_rest).linear_momentum[0]
//! });
//! // 560 kg and 660 kg at 0.1 m/s
//! assert!((light - 56.0).abs() < 1e-12 && (heavy - 66.0).abs() < 1e-12);
//! ```

include!(concat!(env!("OUT_DIR"), "/index.rs"));
