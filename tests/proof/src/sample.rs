//! Random states that shrink and are printed as input of `planar-capture eval`.

use planar_dynamics::state::State;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use serde_json::json;
use std::fmt;

/// The seed of every property test; change it to look at other states.
pub const SEED: u64 = 20_170_628;

/// Enough states to meet every regime, few enough for a debug build.
pub fn config() -> Config {
    Config { cases: 48, rng_seed: RngSeed::Fixed(SEED), failure_persistence: None, ..Config::default() }
}

/// State of a robot, forces on it, and its targets.
#[derive(Clone)]
pub struct RandomState {
    /// [yaw, x, y].
    pub base_pose: [f64; 3],
    /// Relative, rad.
    pub joint_angles: Vec<f64>,
    /// [ω, vx, vy].
    pub base_twist: [f64; 3],
    /// rad/s.
    pub joint_rates: Vec<f64>,
    /// N m.
    pub joint_torques: Vec<f64>,
    /// [n, fx, fy] at the base COM.
    pub base_wrench: [f64; 3],
    /// [n, fx, fy] at each end effector.
    pub end_effector_wrenches: Vec<[f64; 3]>,
    /// [mass, inertia, rx, ry], and the twist; one per arm.
    pub targets: Vec<([f64; 4], [f64; 3])>,
}

impl RandomState {
    /// The robot's state.
    pub fn state(&self) -> State<'_, f64> {
        State {
            base_pose: self.base_pose,
            joint_angles: &self.joint_angles,
            base_twist: self.base_twist,
            joint_rates: &self.joint_rates,
        }
    }
}

impl fmt::Debug for RandomState {
    /// A state for `planar-capture eval LAYOUT STATES.json`, to be put between `[` and `]`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let targets: Vec<_> = self
            .targets
            .iter()
            .map(|([mass, inertia, rx, ry], twist)| {
                json!({"mass": mass, "inertia": inertia, "contact": [rx, ry], "twist": twist})
            })
            .collect();
        let state = json!({
            "base_pose": self.base_pose, "joint_angles": self.joint_angles, "base_twist": self.base_twist,
            "joint_rates": self.joint_rates, "joint_torques": self.joint_torques, "base_wrench": self.base_wrench,
            "end_effector_wrenches": self.end_effector_wrenches, "targets": targets,
        });
        write!(f, "{state} (seed {SEED})")
    }
}

fn three(x: f64, y: f64) -> impl Strategy<Value = [f64; 3]> {
    [-x..x, -y..y, -y..y]
}

/// States of a robot with so many arms and joints: any pose, moderate speeds and forces, light to heavy targets.
pub fn sample(arms: usize, joints: usize) -> impl Strategy<Value = RandomState> {
    let target = (-2.0..2.0_f64, 0.05..2.0_f64, -0.6..0.6_f64, -0.6..0.6_f64).prop_map(|(log_mass, radius, rx, ry)| {
        let mass = 10.0 * 10.0_f64.powf(log_mass);
        [mass, 0.4 * mass * radius * radius, rx, ry]
    });
    (
        (three(7.0, 5.0), vec(-3.2..3.2_f64, joints), three(1.0, 1.0), vec(-1.5..1.5_f64, joints)),
        (vec(-10.0..10.0_f64, joints), three(10.0, 10.0), vec(three(10.0, 10.0), arms)),
        vec((target, three(1.0, 1.0)), arms),
    )
        .prop_map(
            |((base_pose, joint_angles, base_twist, joint_rates), (torques, base_wrench, wrenches), targets)| {
                RandomState {
                    base_pose,
                    joint_angles,
                    base_twist,
                    joint_rates,
                    joint_torques: torques,
                    base_wrench,
                    end_effector_wrenches: wrenches,
                    targets,
                }
            },
        )
}
