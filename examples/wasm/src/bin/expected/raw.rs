//! Numbers as bytes.

use wasm::{Real, RobotState};

/// Numbers, little-endian, without anything between them.
#[derive(Default)]
pub struct Raw(pub Vec<u8>);

impl Raw {
    /// Appends numbers.
    pub fn put(&mut self, numbers: &[Real]) {
        self.0.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    }

    /// Appends a state, in the order of its fields.
    pub fn put_state(&mut self, state: &RobotState) {
        self.put(&state.base_pose);
        self.put(&state.joint_angles);
        self.put(&state.base_twist);
        self.put(&state.joint_rates);
    }
}
