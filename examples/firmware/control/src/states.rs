//! The states at which the functions are compared and measured: the same on host and board, by integers.

use crate::Real;
use crate::dual_arm_3r::{ARMS, JOINTS};
use crate::mission::{INITIAL_ANGLES, STEP, TARGET_INERTIA, TARGET_MASS};
#[cfg(not(feature = "double"))]
use core::f32::consts::PI;
#[cfg(feature = "double")]
use core::f64::consts::PI;

/// How many there are.
pub const STATES: u16 = 1000;
/// The first states have any angle within ±π, the next hundred those of [`NEAR`], the last hundred those of [`FAR`] too.
pub const FIRST_NEAR: u16 = 800;
/// The first state with far angles, which are reduced in integers.
pub const FIRST_FAR: u16 = 900;
/// Angles at which something could go wrong, rad.
const NEAR: [Real; 8] = [0.0, -0.0, PI, -PI, PI / 2.0, -PI / 2.0, 1e3, -1e3];
/// Far angles, rad.
const FAR: [Real; 4] = [1e6, -1e30, Real::MAX, Real::MIN];

/// What all functions take. In C it is `inputs` of functions.h.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Inputs {
    /// rad, m.
    pub base_pose: [Real; 3],
    /// rad.
    pub joint_angles: [Real; JOINTS],
    /// rad/s, m/s.
    pub base_twist: [Real; 3],
    /// rad/s.
    pub joint_rates: [Real; JOINTS],
    /// N m.
    pub joint_torques: [Real; JOINTS],
    /// rad.
    pub desired_angles: [Real; JOINTS],
    /// rad/s.
    pub desired_rates: [Real; JOINTS],
    /// kg.
    pub target_masses: [Real; ARMS],
    /// kg m².
    pub target_inertias: [Real; ARMS],
    /// m.
    pub contacts: [[Real; 2]; ARMS],
    /// rad/s, m/s.
    pub target_twists: [[Real; 3]; ARMS],
    /// s.
    pub step: Real,
}

/// The inputs of a state, from 0.
#[must_use]
pub fn inputs(state: u16) -> Inputs {
    let mut random = Random(u32::from(state).wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995);
    let mut some = |size: Real| random.within(size);
    let mut inputs = Inputs {
        base_pose: [some(PI), some(2.0), some(2.0)],
        joint_angles: [0.0; JOINTS].map(|_| some(PI)),
        base_twist: [0.0; 3].map(|_| some(0.5)),
        joint_rates: [0.0; JOINTS].map(|_| some(1.0)),
        joint_torques: [0.0; JOINTS].map(|_| some(10.0)),
        desired_angles: INITIAL_ANGLES,
        desired_rates: [0.0; JOINTS].map(|_| some(0.1)),
        target_masses: [0.0; ARMS].map(|_| TARGET_MASS + some(9.0)),
        target_inertias: [0.0; ARMS].map(|_| TARGET_INERTIA + some(0.9)),
        contacts: [[0.0; 2]; ARMS].map(|contact| contact.map(|_| some(0.5))),
        target_twists: [[0.0; 3]; ARMS].map(|twist| twist.map(|_| some(0.3))),
        step: STEP,
    };
    if state >= FIRST_NEAR {
        for angle in core::iter::once(&mut inputs.base_pose[0]).chain(&mut inputs.joint_angles) {
            let far = state >= FIRST_FAR && random.next().is_multiple_of(2);
            let angles: &[Real] = if far { &FAR } else { &NEAR };
            *angle = angles.get(random.next() as usize % angles.len()).copied().unwrap_or_default();
        }
    }
    inputs
}

/// Marsaglia's xorshift.
struct Random(u32);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    /// A number of 24 bits within ±size.
    fn within(&mut self, size: Real) -> Real {
        let unit = (self.next() >> 8) as Real / 8_388_608.0 - 1.0;
        size * unit
    }
}
