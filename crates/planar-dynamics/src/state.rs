//! A robot's state, and the forces on it.

use crate::error::Error;
use crate::scalar::Scalar;

/// Where the robot is and how it moves; J holds one number per joint: an array, a vector, a slice.
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// A view of a robot's state: what every function of a model takes.
pub type State<'a, T> = RobotState<T, &'a [T]>;

impl<T: Copy, J> RobotState<T, J> {
    /// The same, borrowed.
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

    /// A copy of a view.
    #[must_use]
    pub fn of<'a>(state: &State<'a, T>) -> Self
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

/// What acts on the robot. What is absent costs nothing.
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

/// Number of entries of the vector that is integrated: `[base_pose, joint_angles, base_twist, joint_rates, work]`, the
/// last an [`ActuatorWork`].
///
/// A vector may be longer by 6 for each free body beside the robot, their poses after the joint angles and their twists
/// after the joint rates: the first half are positions, the second their rates, whatever there is.
#[must_use]
pub const fn vector_length(joints: usize) -> usize {
    2 * (3 + joints) + 3
}

/// Number of positions in an integrated vector, where it is two halves and actuator work.
fn positions<T>(vector: &[T]) -> Result<usize, Error> {
    let found = vector.len();
    match found.checked_sub(3) {
        Some(both) if both.is_multiple_of(2) => Ok(both / 2),
        _ => Err(Error::StateVector { found }),
    }
}

/// An integrated vector in its parts.
#[derive(Clone, Copy, Debug)]
pub struct StateVector<'a, T> {
    /// Of base, joints and bodies beside the robot.
    pub positions: &'a [T],
    /// Of the positions.
    pub rates: &'a [T],
    /// Of the actuators.
    pub work: &'a [T; 3],
}

/// As [`StateVector`], to be changed.
#[derive(Debug)]
pub struct StateVectorMut<'a, T> {
    /// Of base, joints and bodies beside the robot.
    pub positions: &'a mut [T],
    /// Of the positions.
    pub rates: &'a mut [T],
    /// Of the actuators.
    pub work: &'a mut [T; 3],
}

/// The parts of an integrated vector.
///
/// # Errors
/// [`Error::StateVector`] where the vector is not two halves and actuator work.
pub fn split<T>(vector: &[T]) -> Result<StateVector<'_, T>, Error> {
    let (count, wrong) = (positions(vector)?, Error::StateVector { found: vector.len() });
    let (state, work) = vector.split_last_chunk::<3>().ok_or(wrong)?;
    let (positions, rates) = state.split_at_checked(count).ok_or(wrong)?;
    Ok(StateVector { positions, rates, work })
}

/// The parts of an integrated vector, to be changed.
///
/// # Errors
/// As [`split`].
pub fn split_mut<T>(vector: &mut [T]) -> Result<StateVectorMut<'_, T>, Error> {
    let (count, wrong) = (positions(vector)?, Error::StateVector { found: vector.len() });
    let (state, work) = vector.split_last_chunk_mut::<3>().ok_or(wrong)?;
    let (positions, rates) = state.split_at_mut_checked(count).ok_or(wrong)?;
    Ok(StateVectorMut { positions, rates, work })
}

/// One half of an integrated vector by what it belongs to.
#[derive(Clone, Copy, Debug)]
pub struct Coordinates<'a, T> {
    /// Of the base: a pose or a twist.
    pub base: &'a [T; 3],
    /// Of the joints.
    pub joints: &'a [T],
    /// Of the bodies beside the robot.
    pub bodies: &'a [[T; 3]],
}

impl<'a, T> Coordinates<'a, T> {
    /// The parts of a half.
    ///
    /// # Errors
    /// [`Error::Length`] where there are fewer than base and joints have, or a part of a body.
    pub fn new(half: &'a [T], joints: usize) -> Result<Self, Error> {
        let wrong = Error::Length { quantity: "half of a state vector", expected: 3 + joints, found: half.len() };
        let (base, rest) = half.split_first_chunk::<3>().ok_or(wrong)?;
        let (joints, bodies) = rest.split_at_checked(joints).ok_or(wrong)?;
        match bodies.as_chunks::<3>() {
            (bodies, []) => Ok(Self { base, joints, bodies }),
            _ => Err(wrong),
        }
    }
}

/// As [`Coordinates`], to be changed.
#[derive(Debug)]
pub struct CoordinatesMut<'a, T> {
    /// Of the base: a pose or a twist, or its rate.
    pub base: &'a mut [T; 3],
    /// Of the joints.
    pub joints: &'a mut [T],
    /// Of the bodies beside the robot.
    pub bodies: &'a mut [[T; 3]],
}

impl<'a, T> CoordinatesMut<'a, T> {
    /// The parts of a half.
    ///
    /// # Errors
    /// As [`Coordinates::new`].
    pub fn new(half: &'a mut [T], joints: usize) -> Result<Self, Error> {
        let wrong = Error::Length { quantity: "half of a state vector", expected: 3 + joints, found: half.len() };
        let (base, rest) = half.split_first_chunk_mut::<3>().ok_or(wrong)?;
        let (joints, bodies) = rest.split_at_mut_checked(joints).ok_or(wrong)?;
        match bodies.as_chunks_mut::<3>() {
            (bodies, []) => Ok(Self { base, joints, bodies }),
            _ => Err(wrong),
        }
    }
}

/// What the actuators have done, integrated beside the state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ActuatorWork<T> {
    /// Work of the joint torques, J.
    pub joint_work: T,
    /// Work of the base torque, J.
    pub base_work: T,
    /// Angular momentum that the base torque gave the robot, N m s.
    pub base_impulse: T,
}

impl<T: Scalar> ActuatorWork<T> {
    /// Both together, of phases that follow each other.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            joint_work: self.joint_work + other.joint_work,
            base_work: self.base_work + other.base_work,
            base_impulse: self.base_impulse + other.base_impulse,
        }
    }

    /// Of all actuators together, J.
    #[must_use]
    pub fn total(&self) -> T {
        self.joint_work + self.base_work
    }

    /// The last three entries of an integrated vector.
    ///
    /// # Errors
    /// [`Error::StateVector`] where there are not so many.
    pub fn from_vector(vector: &[T]) -> Result<Self, Error> {
        let wrong = Error::StateVector { found: vector.len() };
        let [joint_work, base_work, base_impulse] = *vector.last_chunk::<3>().ok_or(wrong)?;
        Ok(Self { joint_work, base_work, base_impulse })
    }
}

impl<'a, T: Copy> State<'a, T> {
    /// The state in an integrated vector, see [`vector_length`].
    ///
    /// # Errors
    /// [`Error::StateVector`], [`Error::Length`] where the vector is no state of a robot with so many joints.
    pub fn from_vector(vector: &'a [T], joints: usize) -> Result<Self, Error> {
        let StateVector { positions, rates, .. } = split(vector)?;
        let (positions, rates) = (Coordinates::new(positions, joints)?, Coordinates::new(rates, joints)?);
        Ok(Self {
            base_pose: *positions.base,
            joint_angles: positions.joints,
            base_twist: *rates.base,
            joint_rates: rates.joints,
        })
    }

    /// Writes the state to its places in an integrated vector; the other entries keep their values.
    ///
    /// # Errors
    /// [`Error::StateVector`] where the vector is not two halves and actuator work.
    pub fn write(&self, vector: &mut [T]) -> Result<(), Error> {
        let StateVectorMut { positions, rates, .. } = split_mut(vector)?;
        let of_positions = self.base_pose.iter().chain(self.joint_angles);
        let of_rates = self.base_twist.iter().chain(self.joint_rates);
        for (place, value) in positions.iter_mut().zip(of_positions).chain(rates.iter_mut().zip(of_rates)) {
            *place = *value;
        }
        Ok(())
    }
}
