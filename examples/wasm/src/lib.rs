//! The paper's robot as a WebAssembly module: plain functions over numbers in linear memory, without a runtime.
//!
//! A reference is an address to the caller, who lays out the memory from `__heap_base` on, as robot.mjs does. A function that
//! can be without a result says so by `false`: a number is not finite, or a system of equations singular.
#![cfg_attr(target_arch = "wasm32", no_std)]

mod control;
#[cfg(feature = "lanes")]
mod lanes;
mod robot;

pub use control::control_step;
#[cfg(feature = "lanes")]
pub use lanes::{Lanes, Robots, States, forward_dynamics_of_lanes, lanes, new_robots, robots_bytes};
pub use planar_capture::generated::dual_arm_3r::{ARMS, JOINTS, PARAMETERS, SIZE};
pub use robot::{
    Captured, Robot, RobotState, default_parameters, exact_impact, forward_dynamics, merge, new_robot, robot_bytes,
};

/// The scalar.
#[cfg(not(feature = "single"))]
pub type Real = f64;
/// The scalar.
#[cfg(feature = "single")]
pub type Real = f32;

#[cfg(target_arch = "wasm32")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
