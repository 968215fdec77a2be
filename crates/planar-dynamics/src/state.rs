//! A robot's state, and the forces on it.

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
    /// [n, fx, fy] on the robot at each tip, inertial axes; N m, N.
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

/// Where the second half of an integrated vector begins.
const fn half(length: usize) -> usize {
    length.saturating_sub(3) / 2
}

/// The positions of an integrated vector and their rates; `None` where the vector is not two halves and actuator work.
pub fn halves<T>(vector: &[T]) -> Option<(&[T], &[T])> {
    let (state, _) = vector.split_last_chunk::<3>()?;
    let (positions, rates) = state.split_at_checked(half(vector.len()))?;
    (positions.len() == rates.len()).then_some((positions, rates))
}

/// Positions, rates and what follows them in an integrated vector, to be changed; `None` as [`halves`].
pub fn halves_mut<T>(vector: &mut [T]) -> Option<(&mut [T], &mut [T], &mut [T; 3])> {
    let places = half(vector.len());
    let (state, work) = vector.split_last_chunk_mut::<3>()?;
    let (positions, rates) = state.split_at_mut_checked(places)?;
    (positions.len() == rates.len()).then_some((positions, rates, work))
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

    /// The last three entries of an integrated vector; `None` where there are not so many.
    pub fn from_vector(vector: &[T]) -> Option<Self> {
        let [joint_work, base_work, base_impulse] = *vector.last_chunk::<3>()?;
        Some(Self { joint_work, base_work, base_impulse })
    }
}

impl<'a, T: Copy> State<'a, T> {
    /// The state in an integrated vector, see [`vector_length`]; `None` where the vector is too short.
    pub fn from_vector(vector: &'a [T], joints: usize) -> Option<Self> {
        let (positions, rates) = halves(vector)?;
        let (base_pose, rest) = positions.split_first_chunk::<3>()?;
        let joint_angles = rest.get(..joints)?;
        let (base_twist, rest) = rates.split_first_chunk::<3>()?;
        let joint_rates = rest.get(..joints)?;
        Some(Self { base_pose: *base_pose, joint_angles, base_twist: *base_twist, joint_rates })
    }

    /// Writes the state to its places in an integrated vector; the other entries keep their values.
    pub fn write(&self, vector: &mut [T]) {
        let Some((positions, rates)) = vector.split_at_mut_checked(half(vector.len())) else { return };
        let of_positions = self.base_pose.iter().chain(self.joint_angles);
        let of_rates = self.base_twist.iter().chain(self.joint_rates);
        for (place, value) in positions.iter_mut().zip(of_positions).chain(rates.iter_mut().zip(of_rates)) {
            *place = *value;
        }
    }
}
