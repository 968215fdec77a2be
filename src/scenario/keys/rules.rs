//! Numbers, vectors and texts that several tables have.

use crate::format::{NumberRule, Shape};
use std::f64::consts::PI;

/// Two turns; a larger angle is taken for one in degrees.
pub(crate) const LARGEST_ANGLE: f64 = 4.0 * PI;
/// rad/s; a faster body turns more often in a second than its angle has digits to show.
const LARGEST_RATE: f64 = 1e9;
/// That of light, m/s: no body of mechanics is faster.
const LARGEST_VELOCITY: f64 = 299_792_458.0;

const X: NumberRule = NumberRule::any("x", "m");
const Y: NumberRule = NumberRule::any("y", "m");
const YAW: NumberRule = NumberRule::any("yaw", "rad");
const OMEGA: NumberRule = NumberRule::any("ω", "rad/s").at_most(LARGEST_RATE);
const VX: NumberRule = NumberRule::any("vx", "m/s").at_most(LARGEST_VELOCITY);
const VY: NumberRule = NumberRule::any("vy", "m/s").at_most(LARGEST_VELOCITY);

pub(super) const JOINT_ANGLE: Shape = Shape::Number(NumberRule::any("a joint angle", "rad").not_degrees(LARGEST_ANGLE));
pub(super) const JOINT_RATE: Shape = Shape::Number(NumberRule::any("a joint rate", "rad/s").at_most(LARGEST_RATE));
pub(super) const POSITION: Shape = Shape::Vector(&[X, Y]);
/// Of the base.
pub(super) const POSE: Shape = Shape::Vector(&[YAW.not_degrees(LARGEST_ANGLE), X, Y]);
pub(super) const TWIST: Shape = Shape::Vector(&[OMEGA, VX, VY]);
/// Of an end effector: a pose, a position, or anywhere.
pub(super) const GOAL: Shape = Shape::OneOf(&[&[YAW, X, Y], &[X, Y], &[]]);
/// Of an end effector: a twist, a velocity at any angular rate, or any.
pub(super) const TWIST_GOAL: Shape = Shape::OneOf(&[&[OMEGA, VX, VY], &[VX, VY], &[]]);
