//! Why a function has no result, as two numbers in registers: an [`Error`] is built of them where it is used. For generated
//! code alone.
//!
//! A controller's frame is what counts where memory is scarce: neither an error nor what it would be found in is in it
//! until there is one. Functions that find one are out of line and small. Results are then set to zero.

#![allow(improper_ctypes_definitions, reason = "Rust alone calls these functions")]

use crate::error::Error;
use crate::scalar::Real;
use crate::target::Target;
use crate::validate::{first_not_finite, is_regular, pivot_limit};

macro_rules! names {
    ($($name:ident $text:literal)*) => {
        /// What may be out of order: numbers, then matrices.
        #[derive(Clone, Copy, Debug)]
        #[repr(u8)]
        enum Name { $($name),* }

        const TEXTS: &[&str] = &[$($text),*];
    };
}

names! {
    Result "the result"
    Parameters "parameters"
    BasePose "base_pose"
    JointAngles "joint_angles"
    BaseTwist "base_twist"
    JointRates "joint_rates"
    JointTorques "joint_torques"
    BaseWrench "base_wrench"
    EndEffectorWrenches "end_effector_wrenches"
    TargetMassAndInertia "target mass and inertia"
    TargetContact "target contact"
    TargetTwist "target twist"
    BaseAcceleration "base_acceleration"
    JointAccelerations "joint_accelerations"
    GeneralizedInertia "generalized_inertia"
    GeneralizedBias "generalized_bias"
    GeneralizedJacobian "generalized_jacobian"
    BaseTwistAfter "base_twist_after"
    JointRatesAfter "joint_rates_after"
    ArticulatedMass "the articulated mass of the base"
    BaseInertia "the base inertia"
    ImpactMatrix "the impact matrix G in full coordinates"
}

/// The first of a function's numbers that is out of order: its name and place in one number, and the number itself. By the
/// convention of C both come back in registers, whatever the scalar is; by that of Rust, no more than two words do.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Objection<T>(T, T);

/// The name of what is no objection.
const _: () = assert!(Name::Result as u8 == 0);

impl<T: Real> Objection<T> {
    const NONE: Self = Self(T::ZERO, T::ZERO);

    /// As many places as single precision has, with 256 names.
    fn new(name: Name, index: usize, value: T) -> Self {
        let index = u32::try_from(index).unwrap_or(u32::MAX).min(0xffff);
        Self(T::from_word(index << 8 | name as u32), value)
    }

    /// This, else what another check finds.
    #[must_use]
    #[inline]
    pub fn or(self, other: impl FnOnce() -> Self) -> Self {
        if self.0 == Self::NONE.0 { other() } else { self }
    }

    /// This, unless its number is none, as a pivot is of parameters that are none, too.
    #[must_use]
    #[inline]
    pub fn unless_of_parameters(self, parameters: impl FnOnce() -> Self) -> Self {
        if self.1.is_finite() { self } else { parameters().or(|| self) }
    }

    /// As an error.
    #[allow(clippy::inline_always, reason = "where nobody looks at it, nothing of it remains")]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it was a word")]
    #[inline(always)]
    #[must_use]
    pub fn error(self) -> Error {
        let Self(word, value) = self;
        let (word, value) = (word.to_f64() as u32, value.to_f64());
        let (name, index) = (word & 0xff, (word >> 8) as usize);
        let text = TEXTS.get(name as usize).copied().unwrap_or_default();
        if name >= Name::ArticulatedMass as u32 {
            Error::Singular { what: text, pivot: value, limit: pivot_limit::<T>().to_f64() }
        } else {
            Error::NotFinite { quantity: text, index, value }
        }
    }
}

/// The first number that is NaN or infinite.
#[cold]
#[inline(never)]
extern "C" fn not_finite<T: Real>(name: Name, values: &[T]) -> Objection<T> {
    first_not_finite(values).map_or(Objection::NONE, |(index, value)| Objection::new(name, index, value))
}

/// A pivot that is not regular.
fn singular<T: Real>(name: Name, smallest: T) -> Objection<T> {
    if is_regular(smallest) { Objection::NONE } else { Objection::new(name, 0, smallest) }
}

/// To the base's pose or twist. Numbers one by one are in registers; what is borrowed would be in memory, though there is
/// nothing wrong with it.
#[cold]
#[inline(never)]
pub extern "C" fn to_base<T: Real>(yaw: T, x: T, y: T, omega: T, vx: T, vy: T) -> Objection<T> {
    not_finite(Name::BasePose, &[yaw, x, y]).or(|| not_finite(Name::BaseTwist, &[omega, vx, vy]))
}

/// To forward dynamics of a base whose numbers are finite: to an input, else to the pivot, else to a result.
///
/// Numbers of the base one by one, as those of [`to_base`].
#[cold]
#[inline(never)]
#[allow(clippy::too_many_arguments, reason = "see above")]
pub extern "C" fn to_accelerations<T: Real, const N: usize>(
    joint_angles: &[T; N],
    joint_rates: &[T; N],
    joint_torques: &[T; N],
    joint_accelerations: &mut [T; N],
    wrenches: &[&[T]],
    smallest_pivot: T,
    alpha: T,
    ax: T,
    ay: T,
) -> Objection<T> {
    let inputs = [&joint_angles[..], joint_rates, joint_torques];
    let objection = to_accelerations_of(inputs, wrenches, smallest_pivot, &[alpha, ax, ay], joint_accelerations);
    *joint_accelerations = [T::ZERO; N];
    objection
}

/// As [`to_accelerations`], of slices that stay as they are.
#[inline]
pub fn to_accelerations_of<T: Real>(
    [joint_angles, joint_rates, joint_torques]: [&[T]; 3],
    wrenches: &[&[T]],
    smallest_pivot: T,
    base_acceleration: &[T; 3],
    joint_accelerations: &[T],
) -> Objection<T> {
    let wrench = |index: usize| wrenches.get(index).copied().unwrap_or_default();
    not_finite(Name::JointAngles, joint_angles)
        .or(|| not_finite(Name::JointRates, joint_rates))
        .or(|| not_finite(Name::JointTorques, joint_torques))
        .or(|| not_finite(Name::BaseWrench, wrench(0)))
        .or(|| not_finite(Name::EndEffectorWrenches, wrench(1)))
        .or(|| singular(Name::ArticulatedMass, smallest_pivot))
        .or(|| not_finite(Name::BaseAcceleration, base_acceleration))
        .or(|| not_finite(Name::JointAccelerations, joint_accelerations))
}

/// To the parameters of a model.
#[cold]
#[inline(never)]
pub extern "C" fn to_parameters<T: Real>(parameters: &[T]) -> Objection<T> {
    not_finite(Name::Parameters, parameters)
}

/// To angles and rates.
///
/// This and the functions below are called one after the other, by a caller that has a frame anyway: arguments beyond four
/// would be in that frame, and what one function passes on to others in its own.
#[cold]
#[inline(never)]
pub extern "C" fn to_joints<T: Real, const N: usize>(joint_angles: &[T; N], joint_rates: &[T; N]) -> Objection<T> {
    not_finite(Name::JointAngles, joint_angles).or(|| not_finite(Name::JointRates, joint_rates))
}

/// To the pivot of reduced dynamics.
#[inline]
pub fn to_base_inertia<T: Real>(smallest_pivot: T) -> Objection<T> {
    singular(Name::BaseInertia, smallest_pivot)
}

/// To the results of reduced dynamics.
#[cold]
#[inline(never)]
pub extern "C" fn to_reduced_dynamics<T: Real, const N: usize, const R: usize>(
    generalized_inertia: &[[T; N]; N],
    generalized_bias: &[T; N],
    generalized_jacobian: &[[T; N]; R],
) -> Objection<T> {
    not_finite(Name::GeneralizedInertia, generalized_inertia.as_flattened())
        .or(|| not_finite(Name::GeneralizedBias, generalized_bias))
        .or(|| not_finite(Name::GeneralizedJacobian, generalized_jacobian.as_flattened()))
}

/// To the targets of an impact.
#[cold]
#[inline(never)]
pub extern "C" fn to_targets<T: Real, const N: usize>(targets: &[Option<Target<T>>; N]) -> Objection<T> {
    targets.iter().flatten().fold(Objection::NONE, |found, target| {
        found
            .or(|| not_finite(Name::TargetMassAndInertia, &[target.mass, target.inertia]))
            .or(|| not_finite(Name::TargetContact, &target.contact))
            .or(|| not_finite(Name::TargetTwist, &target.twist))
    })
}

/// To the pivot of an impact.
#[inline]
pub fn to_impact_matrix<T: Real>(smallest_pivot: T) -> Objection<T> {
    singular(Name::ImpactMatrix, smallest_pivot)
}

/// To the velocities after an impact; of the base one by one, as those of [`to_base`].
#[cold]
#[inline(never)]
pub extern "C" fn to_velocities_after<T: Real, const N: usize>(
    joint_rates_after: &[T; N],
    omega: T,
    vx: T,
    vy: T,
) -> Objection<T> {
    not_finite(Name::BaseTwistAfter, &[omega, vx, vy]).or(|| not_finite(Name::JointRatesAfter, joint_rates_after))
}
