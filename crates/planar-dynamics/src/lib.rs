//! The core of `planar-capture`: traits of a robot's dynamics; contacts, impacts, control laws, formulations, integrators
//! and trajectories on slices and arrays.
//!
//! It never contains: std (but for the features `batch` and `fused`), an allocation, a panic, a computation for one number type alone,
//! access to files, a parser.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![no_std]

// `core` has no fused multiply-add, and does not know the processor
#[cfg(any(feature = "batch", feature = "fused"))]
extern crate std;

#[cfg(feature = "batch")]
pub mod batch;
pub mod body;
pub mod contact;
pub mod control;
pub mod dynamics;
pub mod error;
pub mod formulation;
pub mod impact;
pub mod impact_equations;
mod implement;
pub mod integrate;
mod jacobian_rate;
#[cfg(feature = "lanes")]
pub mod lanes;
mod linear;
pub mod manifest;
mod momentum_equation;
#[cfg(feature = "nalgebra")]
pub mod nalgebra;
#[doc(hidden)]
pub mod objection;
pub mod quantity;
mod read_again;
pub mod scalar;
#[doc(hidden)]
pub mod standalone;
pub mod state;
pub mod status;
pub mod target;
pub mod trajectory;
#[doc(hidden)]
pub mod validate;
