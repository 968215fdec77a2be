//! CasADi's C code of the paper's robot.

use crate::runge_kutta::Vector;
use crate::states::State;

type Function = unsafe extern "C" fn(
    *const *const f64,
    *mut *mut f64,
    *mut std::ffi::c_longlong,
    *mut f64,
    std::ffi::c_int,
) -> std::ffi::c_int;

macro_rules! functions {
    ($($name:ident)*) => {
        unsafe extern "C" {
            $(fn $name(
                arguments: *const *const f64,
                results: *mut *mut f64,
                integers: *mut std::ffi::c_longlong,
                work: *mut f64,
                memory: std::ffi::c_int,
            ) -> std::ffi::c_int;)*
        }
    };
}

functions!(
    casadi_forward_dynamics casadi_forward_dynamics_derivatives casadi_reduced_dynamics casadi_reduced_impact
    casadi_full_impact
);

/// Largest number of results, of elements of one result, and of elements of all.
const RESULTS: usize = 6;
const ELEMENTS: usize = 81;

/// The results of a function, one after the other.
pub struct Results([[f64; ELEMENTS]; RESULTS]);

impl Default for Results {
    fn default() -> Self {
        Self([[0.0; ELEMENTS]; RESULTS])
    }
}

impl Results {
    #[inline]
    fn places(&mut self) -> [*mut f64; RESULTS] {
        self.0.each_mut().map(|result| result.as_mut_ptr())
    }

    /// The first elements of a result.
    pub fn of(&self, result: usize, count: usize) -> &[f64] {
        &self.0[result][..count]
    }
}

#[inline]
fn call<const N: usize, const R: usize>(function: Function, arguments: [*const f64; N], mut places: [*mut f64; R]) {
    // CasADi's functions read as many elements of each argument as it has, and write as many to each place as the result has, no
    // more than `ELEMENTS`; expanded functions need no work space
    unsafe {
        function(arguments.as_ptr(), places.as_mut_ptr(), std::ptr::null_mut(), std::ptr::null_mut(), 0);
    }
}

/// The arguments of forward dynamics and of its derivatives.
#[inline]
fn motion_and_torques(s: &State) -> [*const f64; 5] {
    [s.base_pose.as_ptr(), s.joint_angles.as_ptr(), s.base_twist.as_ptr(), s.joint_rates.as_ptr(), s.torques.as_ptr()]
}

/// Accelerations of base and joints, smallest pivot.
#[inline]
pub fn forward_dynamics(s: &State, results: &mut Results) {
    call(casadi_forward_dynamics, motion_and_torques(s), results.places());
}

/// Accelerations of base and joints, from a vector and to an array where they are: what a loop around C would call.
#[inline]
pub fn accelerations(x: &Vector, torques: &[f64; 6]) -> [f64; 9] {
    let (mut found, mut pivot) = ([0.0; 9], 0.0);
    let (base, joints) = found.split_at_mut(3);
    let arguments = [x.as_ptr(), x[3..].as_ptr(), x[9..].as_ptr(), x[12..].as_ptr(), torques.as_ptr()];
    call(casadi_forward_dynamics, arguments, [base.as_mut_ptr(), joints.as_mut_ptr(), &raw mut pivot]);
    found
}

/// Accelerations of base and joints, and their derivatives by position, velocity and forces.
#[inline]
pub fn derivatives(s: &State, results: &mut Results) {
    call(casadi_forward_dynamics_derivatives, motion_and_torques(s), results.places());
}

/// Generalized inertia, bias, Jacobian, smallest pivot.
#[inline]
pub fn reduced_dynamics(s: &State, results: &mut Results) {
    let arguments = [s.base_pose.as_ptr(), s.joint_angles.as_ptr(), s.base_twist.as_ptr(), s.joint_rates.as_ptr()];
    call(casadi_reduced_dynamics, arguments, results.places());
}

/// G, H, joint rates after, smallest pivot.
#[inline]
pub fn reduced_impact(s: &State, results: &mut Results) {
    let arguments = [
        s.base_pose.as_ptr(),
        s.joint_angles.as_ptr(),
        s.joint_rates.as_ptr(),
        s.masses.as_ptr(),
        s.inertias.as_ptr(),
        s.contacts.as_flattened().as_ptr(),
        s.twists.as_flattened().as_ptr(),
    ];
    call(casadi_reduced_impact, arguments, results.places());
}

/// G, H, base twist and joint rates after, smallest pivot.
#[inline]
pub fn full_impact(s: &State, results: &mut Results) {
    let arguments = [
        s.base_pose.as_ptr(),
        s.joint_angles.as_ptr(),
        s.base_twist.as_ptr(),
        s.joint_rates.as_ptr(),
        s.masses.as_ptr(),
        s.inertias.as_ptr(),
        s.contacts.as_flattened().as_ptr(),
        s.twists.as_flattened().as_ptr(),
    ];
    call(casadi_full_impact, arguments, results.places());
}
