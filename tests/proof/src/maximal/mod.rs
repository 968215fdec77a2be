//! Contacts and closed loops in maximal coordinates: an independent reference.
//!
//! Every body (base, links, targets) is a free planar rigid body, with a pose and a twist of its own; joints and
//! captures are constraints between two of them, all alike. Of the product it reads the layout and nothing else: no
//! reduced coordinates, no Jacobian of an arm, no recursion, no pivoting scheme, no Runge–Kutta method.
//!
//! [`body`] · [`system`] and back to joint angles · [`constraint`] · [`kkt_system`] ·
//! [`complementarity`] by enumeration · [`impact`] · [`motion`] · [`random`] contacts

pub mod body;
pub mod complementarity;

pub mod constraint;
pub mod impact;
pub mod kkt_system;
pub mod motion;
pub mod random;
pub mod system;
