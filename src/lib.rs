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

#[cfg(feature = "std")]
pub mod approach;
#[cfg(feature = "std")]
pub mod audit;
#[cfg(feature = "std")]
pub mod capture;
#[cfg(feature = "std")]
pub mod compare;
#[cfg(feature = "std")]
pub mod design;
#[cfg(feature = "std")]
pub mod diagnostic;
#[cfg(feature = "std")]
pub mod evaluation;
#[cfg(feature = "std")]
pub mod generic;
#[cfg(feature = "std")]
pub mod layout;
#[cfg(feature = "std")]
pub mod models;
#[cfg(feature = "std")]
pub mod output;
#[cfg(feature = "std")]
pub mod record;
#[cfg(feature = "std")]
pub mod scenario;
#[cfg(feature = "std")]
pub mod simulate;
#[cfg(feature = "std")]
pub mod states;
#[cfg(feature = "std")]
pub mod study;
#[cfg(feature = "std")]
pub mod summary;
#[cfg(feature = "std")]
pub mod table;
