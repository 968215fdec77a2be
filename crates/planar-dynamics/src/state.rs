//! A robot's state as structures and as the vector that is integrated, and the forces on the robot.
//!
//! # Example
//! ```
//! use planar_dynamics::state::{State, split, vector_length};
//!
//! // a robot with one joint
//! let (joint_angles, joint_rates) = (&[0.5], &[0.2]);
//! let state = State { base_pose: [0.1, 1.0, 2.0], joint_angles, base_twist: [0.0, 0.3, 0.4], joint_rates };
//! let mut vector = [0.0; vector_length(1)];
//! state.write(&mut vector)?;
//! assert_eq!(vector, [0.1, 1.0, 2.0, 0.5, 0.0, 0.3, 0.4, 0.2, 0.0, 0.0, 0.0]);
//! assert_eq!(split(&vector)?.rates, [0.0, 0.3, 0.4, 0.2]);
//! assert_eq!(State::from_vector(&vector, 1)?, state);
//! # Ok::<(), planar_dynamics::error::Error>(())
//! ```

use crate::error::Error;
use crate::linear::copy;
use crate::scalar::Scalar;

/// Positions and velocities of a robot; J holds one number per joint: an array, a vector or a slice.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RobotState<T, J> {
    /// [yaw, x, y] of the base COM, inertial frame; rad, m.
    pub base_pose: [T; 3],
    /// Relative joint angles, arm by arm; rad.
    pub joint_angles: J,
    /// [ω, vx, vy] of the base COM, inertial axes; rad/s, m/s.
    pub base_twist: [T; 3],
    /// Joint rates, arm by arm; rad/s.
    pub joint_rates: J,
}

/// A view of a robot's state, the argument of every function of a model.
pub type State<'a, T> = RobotState<T, &'a [T]>;

impl<T: Copy, J> RobotState<T, J> {
    /// A view of this state.
    #[must_use]
    pub fn view(&self) -> State<'_, T>
    where
        J: AsRef<[T]>,
    {
        State {
            base_pose: self.base_pose,
            joint_angles: self.joint_angles.as_ref(),
            base_twist: self.base_twist,
            joint_rates: self.joint_rates.as_ref(),
        }
    }

    /// A copy of a viewed state.
    #[must_use]
    pub fn from_view<'a>(state: &State<'a, T>) -> Self
    where
        J: From<&'a [T]>,
    {
        Self {
            base_pose: state.base_pose,
            joint_angles: state.joint_angles.into(),
            base_twist: state.base_twist,
            joint_rates: state.joint_rates.into(),
        }
    }
}

/// Forces on the robot; a force that is `None` costs no operations.
#[derive(Clone, Copy, Debug)]
pub struct Forces<'a, T> {
    /// Joint torques, arm by arm; N m.
    pub joint_torques: &'a [T],
    /// [n, fx, fy] on the base at its COM, inertial axes; N m, N.
    pub base_wrench: Option<[T; 3]>,
    /// [n, fx, fy] on the robot at each end effector, inertial axes; N m, N.
    pub end_effector_wrenches: Option<&'a [[T; 3]]>,
}

impl<'a, T> Forces<'a, T> {
    /// Joint torques alone.
    pub fn torques(joint_torques: &'a [T]) -> Self {
        Self { joint_torques, base_wrench: None, end_effector_wrenches: None }
    }
}

/// Number of entries of the integrated vector of a robot alone: `[base_pose, joint_angles, base_twist, joint_rates,
/// work]`; the last is an [`ActuatorWork`].
///
/// Each free body adds 6 entries: its pose after the joint angles, its twist after the joint rates. The
/// vector without its last three entries is therefore always one half of positions and one of their rates.
#[must_use]
pub const fn vector_length(joints: usize) -> usize {
    2 * (3 + joints) + 3
}

/// The parts of an integrated vector: the halves H and the last three entries W, both as views.
#[derive(Clone, Copy, Debug)]
pub struct StateVector<H, W> {
    /// Of the base, the joints and the free bodies.
    pub positions: H,
    /// Of the positions.
    pub rates: H,
    /// Of the actuators.
    pub work: W,
}

/// The parts of an integrated vector.
///
/// # Errors
/// [`Error::StateVector`] unless the vector is two halves of the same length and three entries.
#[inline]
pub fn split<T>(vector: &[T]) -> Result<StateVector<&[T], &[T; 3]>, Error> {
    let wrong = Error::StateVector { found: vector.len() };
    let parts = vector.split_last_chunk::<3>().filter(|(halves, _)| halves.len().is_multiple_of(2));
    let (halves, work) = parts.ok_or(wrong)?;
    let (positions, rates) = halves.split_at_checked(halves.len() / 2).ok_or(wrong)?;
    Ok(StateVector { positions, rates, work })
}

/// As [`split`], with mutable parts.
///
/// # Errors
/// As [`split`].
#[inline]
pub fn split_mut<T>(vector: &mut [T]) -> Result<StateVector<&mut [T], &mut [T; 3]>, Error> {
    let wrong = Error::StateVector { found: vector.len() };
    let parts = vector.split_last_chunk_mut::<3>().filter(|(halves, _)| halves.len().is_multiple_of(2));
    let (halves, work) = parts.ok_or(wrong)?;
    let (positions, rates) = halves.split_at_mut_checked(halves.len() / 2).ok_or(wrong)?;
    Ok(StateVector { positions, rates, work })
}

/// The parts of one half of an integrated vector, positions or rates: views B of the base, J of the joints and F of the
/// free bodies.
#[derive(Clone, Copy, Debug)]
pub struct Coordinates<B, J, F> {
    /// A pose, a twist or its rate.
    pub base: B,
    /// One entry per joint.
    pub joints: J,
    /// A pose, a twist or its rate per body.
    pub bodies: F,
}

/// The parts of one half of an integrated vector.
///
/// # Errors
/// [`Error::Length`] unless it has 3 + joints entries and three more per body.
#[expect(clippy::type_complexity, reason = "the parts of a struct")]
#[inline]
pub fn coordinates<T>(half: &[T], joints: usize) -> Result<Coordinates<&[T; 3], &[T], &[[T; 3]]>, Error> {
    let wrong = Error::Length { quantity: "half of a state vector", expected: 3 + joints, found: half.len() };
    let (base, rest) = half.split_first_chunk::<3>().ok_or(wrong)?;
    let (joints, bodies) = rest.split_at_checked(joints).ok_or(wrong)?;
    match bodies.as_chunks::<3>() {
        (bodies, []) => Ok(Coordinates { base, joints, bodies }),
        _ => Err(wrong),
    }
}

/// As [`coordinates`], with mutable parts.
///
/// # Errors
/// As [`coordinates`].
#[expect(clippy::type_complexity, reason = "the parts of a struct")]
#[inline]
pub fn coordinates_mut<T>(
    half: &mut [T],
    joints: usize,
) -> Result<Coordinates<&mut [T; 3], &mut [T], &mut [[T; 3]]>, Error> {
    let wrong = Error::Length { quantity: "half of a state vector", expected: 3 + joints, found: half.len() };
    let (base, rest) = half.split_first_chunk_mut::<3>().ok_or(wrong)?;
    let (joints, bodies) = rest.split_at_mut_checked(joints).ok_or(wrong)?;
    match bodies.as_chunks_mut::<3>() {
        (bodies, []) => Ok(Coordinates { base, joints, bodies }),
        _ => Err(wrong),
    }
}

/// Work and angular impulse of the actuators, integrated with the state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ActuatorWork<T> {
    /// Work of the joint torques, J.
    pub joint_work: T,
    /// Work of the base torque, J.
    pub base_work: T,
    /// Time integral of the base torque: the angular momentum that it gave the robot, N m s.
    pub base_impulse: T,
}

impl<T: Scalar> ActuatorWork<T> {
    /// The sum over two consecutive phases.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            joint_work: self.joint_work + other.joint_work,
            base_work: self.base_work + other.base_work,
            base_impulse: self.base_impulse + other.base_impulse,
        }
    }

    /// Work of all actuators, J.
    #[must_use]
    pub fn total(&self) -> T {
        self.joint_work + self.base_work
    }

    /// The last three entries of an integrated vector.
    ///
    /// # Errors
    /// As [`split`].
    #[inline]
    pub fn from_vector(vector: &[T]) -> Result<Self, Error> {
        let [joint_work, base_work, base_impulse] = *split(vector)?.work;
        Ok(Self { joint_work, base_work, base_impulse })
    }
}

impl<'a, T: Copy> State<'a, T> {
    /// The state in an integrated vector, see [`vector_length`].
    ///
    /// # Errors
    /// [`Error::StateVector`], [`Error::Length`] unless the vector is a state of a robot with so many joints.
    #[inline]
    pub fn from_vector(vector: &'a [T], joints: usize) -> Result<Self, Error> {
        let StateVector { positions, rates, .. } = split(vector)?;
        let (positions, rates) = (coordinates(positions, joints)?, coordinates(rates, joints)?);
        Ok(Self {
            base_pose: *positions.base,
            joint_angles: positions.joints,
            base_twist: *rates.base,
            joint_rates: rates.joints,
        })
    }

    /// Writes the state into an integrated vector; the other entries keep their values.
    ///
    /// # Errors
    /// As [`State::from_vector`].
    pub fn write(&self, vector: &mut [T]) -> Result<(), Error> {
        let StateVector { positions, rates, .. } = split_mut(vector)?;
        let positions = coordinates_mut(positions, self.joint_angles.len())?;
        let rates = coordinates_mut(rates, self.joint_rates.len())?;
        (*positions.base, *rates.base) = (self.base_pose, self.base_twist);
        copy(self.joint_angles, positions.joints);
        copy(self.joint_rates, rates.joints);
        Ok(())
    }
}
