//! x
#![cfg_attr(not(feature = "std"), no_std)]
mod check;
pub mod control;
pub mod dynamics;
pub mod error;
pub mod generated;
pub mod impact;
pub mod integrate;
#[cfg(feature = "lanes")]
pub mod lanes;
pub mod manifest;
pub mod motion;
pub mod scalar;
pub mod state;
pub mod target;
pub mod trajectory;
