//! A capture at 1 kHz, in three ways that a firmware can take: by the library ([`library`]), by a module that stands alone
//! ([`standalone`]), and in C ([`c`]). Each is an example by itself; [`route`] has what is measured of them.
#![no_std]

pub mod c;
#[rustfmt::skip]
mod dual_arm_3r;
pub mod library;
pub mod mission;
pub mod route;
pub mod standalone;
pub mod states;
pub mod vectors;

/// The scalar: what the board's processor has in hardware.
#[cfg(not(feature = "double"))]
pub type Real = f32;
/// The scalar: what the board's processor has in hardware.
#[cfg(feature = "double")]
pub type Real = f64;
