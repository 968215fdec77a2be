//! Views of a robot's state and of the forces on it.

/// Where the robot is and how it moves.
#[derive(Clone, Copy, Debug)]
pub struct State<'a, T> {
    /// [yaw, x, y] of the base COM, inertial frame; rad, m.
    pub base_pose: [T; 3],
    /// Relative joint angles, arm by arm; rad.
    pub joint_angles: &'a [T],
    /// [ω, vx, vy] of the base COM, inertial axes; rad/s, m/s.
    pub base_twist: [T; 3],
    /// Joint rates, arm by arm; rad/s.
    pub joint_rates: &'a [T],
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

/// Number of entries of the vector that is integrated: pose, angles, twist, rates, [`Effort`].
#[must_use]
pub const fn vector_length(joints: usize) -> usize {
    2 * (3 + joints) + 3
}

/// What the actuators have done, integrated beside the state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort<T> {
    /// Work of the joint torques, J.
    pub joint_work: T,
    /// Work of the base torque, J.
    pub base_work: T,
    /// Angular momentum that the base torque gave the robot, N m s.
    pub base_impulse: T,
}

impl<T: Copy> Effort<T> {
    /// The last three entries of an integrated vector; `None` where there are not so many.
    pub fn from_vector(vector: &[T]) -> Option<Self> {
        let [joint_work, base_work, base_impulse] = *vector.last_chunk::<3>()?;
        Some(Self { joint_work, base_work, base_impulse })
    }
}

impl<'a, T: Copy> State<'a, T> {
    /// The state in an integrated vector `[base_pose, joint_angles, base_twist, joint_rates, …]`;
    /// `None` where the vector is too short.
    pub fn from_vector(vector: &'a [T], joints: usize) -> Option<Self> {
        let (base_pose, rest) = vector.split_first_chunk::<3>()?;
        let (joint_angles, rest) = rest.split_at_checked(joints)?;
        let (base_twist, rest) = rest.split_first_chunk::<3>()?;
        let joint_rates = rest.get(..joints)?;
        Some(Self { base_pose: *base_pose, joint_angles, base_twist: *base_twist, joint_rates })
    }

    /// Writes the state to the head of an integrated vector; entries beyond it keep their values.
    pub fn write(&self, vector: &mut [T]) {
        let values = self.base_pose.iter().chain(self.joint_angles).chain(&self.base_twist).chain(self.joint_rates);
        for (place, value) in vector.iter_mut().zip(values) {
            *place = *value;
        }
    }
}
