//! The states at which the module is compared, by integers and products alone.

use crate::raw::Raw;
#[cfg(feature = "single")]
use std::f32::consts::PI;
#[cfg(not(feature = "single"))]
use std::f64::consts::PI;
use std::{array, iter};
use wasm::{ARMS, Captured, JOINTS, Real, RobotState};

/// The first states have angles within ±π; then come those of [`NEAR`], and of [`FAR`] too.
pub const FIRST_NEAR: u32 = 800;
const FIRST_FAR: u32 = 900;
/// Angles at which something could go wrong, rad.
const NEAR: [Real; 8] = [0.0, -0.0, PI, -PI, PI / 2.0, -PI / 2.0, 1e3, -1e3];
/// Far angles, rad.
const FAR: [Real; 4] = [1e6, -1e30, Real::MAX, Real::MIN];

/// What the functions take.
pub struct Inputs {
    pub state: RobotState,
    pub torques: [Real; JOINTS],
    pub desired_angles: [Real; JOINTS],
    pub desired_rates: [Real; JOINTS],
    pub captured: [Captured; ARMS],
}

impl Inputs {
    /// Those of a state.
    pub fn new(index: u32) -> Self {
        let mut random = Random(index.wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995);
        let mut some = |size: Real| random.within(size);
        let state = RobotState {
            base_pose: [some(PI), some(2.0), some(2.0)],
            joint_angles: array::from_fn(|_| some(PI)),
            base_twist: array::from_fn(|_| some(0.5)),
            joint_rates: array::from_fn(|_| some(1.0)),
        };
        let mut inputs = Self {
            state,
            torques: array::from_fn(|_| some(10.0)),
            desired_angles: array::from_fn(|_| some(PI)),
            desired_rates: array::from_fn(|_| some(0.1)),
            captured: array::from_fn(|_| Captured {
                mass: 10.0 + some(9.0),
                inertia: 1.0 + some(0.9),
                contact: [some(0.5), some(0.5)],
                twist: array::from_fn(|_| some(0.3)),
            }),
        };
        if index % 10 == 9 {
            inputs.captured[0] = Captured::default();
        }
        if index >= FIRST_NEAR {
            let state = &mut inputs.state;
            for angle in iter::once(&mut state.base_pose[0]).chain(&mut state.joint_angles) {
                let far = index >= FIRST_FAR && random.next().is_multiple_of(2);
                *angle = if far { FAR[random.next() as usize % 4] } else { NEAR[random.next() as usize % 8] };
            }
        }
        inputs
    }

    /// Writes them, in this order.
    pub fn put(&self, file: &mut Raw) {
        file.put_state(&self.state);
        file.put(&self.torques);
        file.put(&self.desired_angles);
        file.put(&self.desired_rates);
        for Captured { mass, inertia, contact, twist } in &self.captured {
            file.put(&[*mass, *inertia]);
            file.put(contact);
            file.put(twist);
        }
    }
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

    /// A number of 16 bits within ±size.
    fn within(&mut self, size: Real) -> Real {
        let bits = u16::try_from(self.next() >> 16).unwrap_or_default();
        size * (Real::from(bits) / 32_768.0 - 1.0)
    }
}
