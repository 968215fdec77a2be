//! Contacts and closed loops in maximal coordinates: an independent reference.
//!
//! Each body (base, link, target) is a free planar rigid body with its own pose and twist; each joint and each capture is
//! a constraint between two bodies. The only code shared with the product is the layout: no reduced coordinates, no
//! Jacobian of an arm, no recursion, no pivoting integrator, no Runge–Kutta method.
//!
//! [`body`] · [`constraint`] · [`system`] of bodies, and its joint angles · [`kkt_system`] · [`complementarity`] by
//! enumeration · [`impact`] · [`motion`] · [`random`] contacts

pub mod body;
pub mod complementarity;
pub mod constraint;
pub mod impact;
pub mod kkt_system;
pub mod motion;
pub mod random;
pub mod system;
