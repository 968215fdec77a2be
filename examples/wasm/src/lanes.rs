//! Several robots at once, one in each lane of a vector of simd128; numbers are grouped by lanes.
#![allow(unsafe_code, reason = "the attribute that gives a function its name in the module")]

use crate::Real;
use core::mem::MaybeUninit;
use planar_capture::generated::dual_arm_3r::{JOINTS, Model, PARAMETERS, Parameters, SIZE};

/// A number of each robot.
#[cfg(not(feature = "single"))]
pub type Lanes = wide::f64x2;
/// A number of each robot.
#[cfg(feature = "single")]
pub type Lanes = wide::f32x4;

/// Robots with their numbers, opaque to the caller.
pub type Robots = Model<Lanes>;

/// Positions and velocities: pose and angles, then twist and rates.
pub type States = [Lanes; 2 * SIZE];

/// How many robots there are in a vector.
#[unsafe(no_mangle)]
pub extern "C" fn lanes() -> usize {
    size_of::<Lanes>() / size_of::<Real>()
}

/// Bytes of the robots of a vector.
#[unsafe(no_mangle)]
pub extern "C" fn robots_bytes() -> usize {
    size_of::<Robots>()
}

/// Robots of these parameters.
#[unsafe(no_mangle)]
pub extern "C" fn new_robots(parameters: &[Lanes; PARAMETERS], robots: &mut MaybeUninit<Robots>) {
    robots.write(Model::new(Parameters::from_array(*parameters)));
}

/// As `forward_dynamics`; false where a robot is singular or a number is not finite.
#[unsafe(no_mangle)]
pub extern "C" fn forward_dynamics_of_lanes(
    robots: &Robots,
    states: &States,
    joint_torques: &[Lanes; JOINTS],
    accelerations: &mut [Lanes; SIZE],
) -> bool {
    let mut state = states.iter().copied();
    let mut next = || state.next().unwrap_or(Lanes::ZERO);
    let (pose, angles) = ([(); 3].map(|()| next()), [(); JOINTS].map(|()| next()));
    let (twist, rates) = ([(); 3].map(|()| next()), [(); JOINTS].map(|()| next()));
    let found = robots.forward_dynamics(&pose, &angles, &twist, &rates, joint_torques);
    for (place, found) in accelerations.iter_mut().zip(found.base_acceleration.iter().chain(&found.joint_accelerations))
    {
        *place = *found;
    }
    let is_regular = found.smallest_pivot.to_array().iter().all(|pivot| *pivot > 8.0 * Real::EPSILON);
    let sum = accelerations.iter().fold(Lanes::ZERO, |sum, a| sum + *a * Lanes::ZERO);
    is_regular && sum.to_array().iter().all(|sum| *sum == 0.0)
}
