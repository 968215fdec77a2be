//! The motion of the targets during a phase.

use crate::capture::assembly::Assembly;
use crate::simulate::system::Body;

/// How the targets move during a phase.
#[derive(Clone, Copy)]
pub enum TargetMotion<'a> {
    /// All freely, from these poses at the start of the phase.
    Free(&'a [Body]),
    /// With or beside the robot of an assembly; the bodies give mass and inertia.
    Assembled(&'a Assembly, &'a [Body]),
}
