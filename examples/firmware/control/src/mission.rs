//! The numbers of the mission: the paper's configurations, targets and gains, in less time.
//!
//! Another layout with more joints repeats them.

use crate::Real;
use crate::dual_arm_3r::{ARMS, JOINTS, SIZE};

/// Period of the loop, s.
pub const STEP: Real = 0.001;
/// Steps of the approach.
pub const APPROACH_STEPS: u16 = 2000;
/// Steps after the impact.
pub const POST_IMPACT_STEPS: u16 = 1000;
/// s.
pub const DURATION: Real = 2.0;
/// Of every joint, N m/rad.
pub const PROPORTIONAL_GAIN: Real = 49.0;
/// Of every joint, N m s/rad.
pub const DERIVATIVE_GAIN: Real = 14.0;

/// Angles at the start, rad.
pub const INITIAL_ANGLES: [Real; JOINTS] = repeated([0.698, -1.571, 1.047, 2.444, 1.571, -1.047]);
/// Angles at the contact, rad.
pub const FINAL_ANGLES: [Real; JOINTS] = repeated([-0.524, -1.393, -0.035, 2.618, -1.393, -0.035]);
/// Rates at the contact, rad/s.
pub const FINAL_RATES: [Real; JOINTS] = repeated([-0.05, 0.02, 0.03, -0.05, 0.02, 0.03]);

/// Of each target, kg.
pub const TARGET_MASS: Real = 10.0;
/// Of each target, kg m².
pub const TARGET_INERTIA: Real = 1.0;
/// From the COM of an arm's target to its contact point, m.
pub const CONTACTS: [[Real; 2]; ARMS] = {
    let (mut contacts, mut arm) = ([[0.0, 0.5]; ARMS], 1);
    while arm < ARMS {
        contacts[arm][1] = -0.5;
        arm += 2;
    }
    contacts
};
/// Of each target before the impact; rad/s, m/s.
pub const TARGET_TWIST: [Real; 3] = [0.2, 0.0, 0.0];

/// What a mission gives: \[pose, angles, twist, rates\] at the contact, after the impact and at the end, with the impulses
/// before the last.
pub type Record = [Real; 6 * SIZE + 3 * ARMS];

const fn repeated(numbers: [Real; 6]) -> [Real; JOINTS] {
    let (mut all, mut joint) = ([0.0; JOINTS], 0);
    while joint < JOINTS {
        all[joint] = numbers[joint % 6];
        joint += 1;
    }
    all
}

/// Writes numbers one after the other.
#[derive(Debug)]
pub struct Writer<'a>(pub &'a mut [Real]);

impl Writer<'_> {
    /// Writes these.
    pub fn put(&mut self, numbers: &[Real]) {
        let room = core::mem::take(&mut self.0);
        if let Some((place, rest)) = room.split_at_mut_checked(numbers.len()) {
            place.copy_from_slice(numbers);
            self.0 = rest;
        }
    }
}
