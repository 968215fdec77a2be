//! The capture in C, `c/capture.c`: its calls. This is the only module that calls another language.
#![allow(unsafe_code, reason = "the compiler does not see what C does")]

use crate::Real;
use crate::dual_arm_3r::{ARMS, JOINTS, PARAMETERS, SIZE};
use crate::mission::Record;
use crate::route::{Case, Function, NAMES, Route};
use crate::states::Inputs;
use core::ffi::c_int;

/// What the functions give.
#[repr(C)]
#[derive(Debug)]
pub struct Results {
    base: [Real; 3],
    joints: [Real; JOINTS],
    generalized_inertia: [Real; JOINTS * JOINTS],
    generalized_bias: [Real; JOINTS],
    generalized_jacobian: [Real; 3 * ARMS * JOINTS],
    target_twists: [Real; 3 * ARMS],
    impulses: [Real; 3 * ARMS],
    base_pose_after: [Real; 3],
    joint_angles_after: [Real; JOINTS],
}

// SAFETY: these are the declarations of c/functions.h, whose structures are those of this crate; the functions read what
// `inputs` points to, write what `results` and `record` point to, and have static state: one thread calls them
unsafe extern "C" {
    fn control_capture(record: *mut [Real; 6 * SIZE + 3 * ARMS]) -> c_int;
    safe fn control_self_test() -> c_int;
    safe fn control_start() -> c_int;
    safe fn control_model_new() -> c_int;
    safe fn control_parameters() -> *const [Real; PARAMETERS];
    fn control_forward_dynamics(inputs: *const Inputs, results: *mut Results) -> c_int;
    fn control_reduced_dynamics(inputs: *const Inputs, results: *mut Results) -> c_int;
    fn control_exact_impact(inputs: *const Inputs, results: *mut Results) -> c_int;
    fn control_exact_impact_with_impulses(inputs: *const Inputs, results: *mut Results) -> c_int;
    fn control_pd_and_rk4_step(inputs: *const Inputs, results: *mut Results) -> c_int;
    fn control_merge(inputs: *const Inputs, results: *mut Results) -> c_int;
}

macro_rules! function {
    ($function:ident, $results:expr) => {{
        #[inline(never)]
        fn call(case: &mut Case<C>) -> bool {
            // SAFETY: both are structures of C, and live during the call
            unsafe { $function(&raw const case.inputs, &raw mut case.results) == 0 }
        }
        Function { call, results: $results }
    }};
}

/// A module in C.
#[derive(Clone, Copy, Debug)]
pub struct C;

impl Route for C {
    const NAME: &'static str = "c";
    type Parameters = ();
    type Model = ();
    type Prepared = ();
    type Results = Results;
    const FUNCTIONS: [Function<Self>; NAMES.len()] = [
        Function { call: |_| control_model_new() == 0, results: parameters },
        function!(control_forward_dynamics, velocities),
        function!(control_reduced_dynamics, |Case { results, .. }, each| {
            each(&results.generalized_inertia);
            each(&results.generalized_bias);
            each(&results.generalized_jacobian);
        }),
        function!(control_exact_impact, velocities),
        function!(control_exact_impact_with_impulses, |case, each| {
            velocities(case, each);
            each(&case.results.target_twists);
            each(&case.results.impulses);
        }),
        function!(control_pd_and_rk4_step, |case, each| {
            each(&case.results.base_pose_after);
            each(&case.results.joint_angles_after);
            velocities(case, each);
        }),
        function!(control_merge, parameters),
    ];

    fn case(inputs: &Inputs) -> Case<Self> {
        control_start();
        let results = Results {
            base: [0.0; _],
            joints: [0.0; _],
            generalized_inertia: [0.0; _],
            generalized_bias: [0.0; _],
            generalized_jacobian: [0.0; _],
            target_twists: [0.0; _],
            impulses: [0.0; _],
            base_pose_after: [0.0; _],
            joint_angles_after: [0.0; _],
        };
        Case { parameters: (), model: (), inputs: *inputs, prepared: (), results }
    }

    fn capture(record: &mut Record) -> Result<(), &'static str> {
        // SAFETY: the record has the length that C writes
        let status = unsafe { control_capture(record) };
        if status == 0 { Ok(()) } else { Err("the module in C refuses the mission") }
    }

    fn self_test() -> bool {
        control_self_test() == 0
    }
}

/// Of the robot that was made last.
fn parameters(_: &Case<C>, each: &mut dyn FnMut(&[Real])) {
    // SAFETY: C has them in a structure of so many numbers, which is static and changed by no other thread
    each(unsafe { &*control_parameters() });
}

fn velocities(case: &Case<C>, each: &mut dyn FnMut(&[Real])) {
    each(&case.results.base);
    each(&case.results.joints);
}
