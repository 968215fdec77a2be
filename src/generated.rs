//! Models rendered from the graphs in `codegen/graphs`, one module per layout.
//!
//! Each has inherent functions over arrays, without a failing path, and the traits of [`crate::dynamics`].

include!(concat!(env!("OUT_DIR"), "/index.rs"));
