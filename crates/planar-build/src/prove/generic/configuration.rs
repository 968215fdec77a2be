//! Poses, Jacobians and twists of all bodies and end effectors at one configuration or state.

use super::{Generic, length, velocity};
use nalgebra::{DMatrix, DVector, Rotation2, Vector2, Vector3};
use planar_dynamics::error::Error;
use planar_dynamics::state::State;
use planar_dynamics::validate::{finite_configuration, finite_state};

/// The robot at one configuration. Positions count from the base COM, in inertial axes, so that a robot far from the
/// origin loses no digits; distances along an arm are sums of what lies between, so that short links beside long ones
/// lose none either.
#[derive(Clone, Debug)]
pub struct Configuration<'a> {
    pub(super) robot: &'a Generic,
    /// [x, y] of the base COM, inertial frame, m.
    base_position: [f64; 2],
    /// Direction of each body's frame, rad.
    yaws: Vec<f64>,
    /// From the origin of the frame before it to that of each body, at its joint.
    offsets: Vec<Vector2<f64>>,
}

impl<'a> Configuration<'a> {
    /// Frames from the base outwards.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    pub fn new(robot: &'a Generic, base_pose: &[f64; 3], joint_angles: &[f64]) -> Result<Self, Error> {
        finite_configuration(base_pose, joint_angles)?;
        length("joint_angles", robot.bodies.len() - 1, joint_angles.len())?;
        let [yaw, x, y] = *base_pose;
        let mut at = Self { robot, base_position: [x, y], yaws: vec![yaw], offsets: vec![Vector2::zeros()] };
        for (body, joint_angle) in robot.bodies.iter().skip(1).zip(joint_angles) {
            let Some(frame) = &body.joint else { continue };
            at.offsets.push(at.in_inertial_axes(frame.body, &frame.position));
            at.yaws.push(at.yaws[frame.body] + frame.angle + joint_angle);
        }
        Ok(at)
    }

    fn in_inertial_axes(&self, body: usize, vector: &[f64; 2]) -> Vector2<f64> {
        Rotation2::new(self.yaws[body]) * Vector2::from(*vector)
    }

    /// The vectors that lead from the origin of a link's frame to a point given in a body's frame, outermost first, each
    /// with the body that it turns with. The link is the body, or before it; 0 is the base.
    fn segments(&self, link: usize, body: usize, position: &[f64; 2]) -> impl Iterator<Item = (usize, Vector2<f64>)> {
        let between = self.chain(body).take_while(move |other| *other != link);
        let offset =
            |other: usize| self.robot.bodies[other].joint.as_ref().map(|frame| (frame.body, self.offsets[other]));
        std::iter::once((body, self.in_inertial_axes(body, position))).chain(between.filter_map(offset))
    }

    /// From the origin of a link's frame to a point given in a body's frame.
    fn arm(&self, link: usize, body: usize, position: &[f64; 2]) -> Vector2<f64> {
        self.segments(link, body, position).fold(Vector2::zeros(), |sum, (_, segment)| sum + segment)
    }

    /// Direction and COM of a body.
    fn body(&self, body: usize) -> (f64, Vector2<f64>) {
        (self.yaws[body], self.arm(0, body, &self.robot.bodies[body].com))
    }

    /// Direction and position of an arm's end effector.
    pub fn end_effector(&self, arm: usize) -> (f64, Vector2<f64>) {
        let frame = &self.robot.end_effectors[arm];
        (self.yaws[frame.body] + frame.angle, self.arm(0, frame.body, &frame.position))
    }

    /// [yaw, x, y] in the inertial frame, of a direction and a position.
    fn pose(&self, (yaw, position): (f64, Vector2<f64>)) -> [f64; 3] {
        let [x, y] = self.base_position;
        [yaw, x + position.x, y + position.y]
    }

    /// The links between a body and the base, the body first.
    fn chain(&self, body: usize) -> impl Iterator<Item = usize> {
        let parent = |link: &usize| self.robot.bodies[*link].joint.as_ref().map(|frame| frame.body);
        std::iter::successors(Some(body), parent).take_while(|link| *link > 0)
    }

    /// B (3 × size): the twist of a body at a point of it is B v.
    ///
    /// A rotation at rate 1 about a joint at p moves the point r by (r − p) turned by a right angle; the base turns
    /// about its COM.
    fn jacobian(&self, body: usize, position: &[f64; 2]) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(3, self.robot.bodies.len() + 2);
        jacobian.set_column(0, &turning(&self.arm(0, body, position)));
        jacobian[(1, 1)] = 1.0;
        jacobian[(2, 2)] = 1.0;
        for link in self.chain(body) {
            jacobian.set_column(2 + link, &turning(&self.arm(link, body, position)));
        }
        jacobian
    }

    /// [yaw, x, y] of every body's COM.
    pub fn body_poses(&self) -> Vec<[f64; 3]> {
        (0..self.robot.bodies.len()).map(|body| self.pose(self.body(body))).collect()
    }

    /// [yaw, x, y] of every end effector.
    pub fn end_effector_poses(&self) -> Vec<[f64; 3]> {
        (0..self.robot.end_effectors.len()).map(|arm| self.pose(self.end_effector(arm))).collect()
    }

    /// `B_i`, at the body's COM.
    pub fn body_jacobian(&self, body: usize) -> DMatrix<f64> {
        self.jacobian(body, &self.robot.bodies[body].com)
    }

    /// `[J_be J_me]` of one arm.
    pub fn arm_jacobian(&self, arm: usize) -> DMatrix<f64> {
        let frame = &self.robot.end_effectors[arm];
        self.jacobian(frame.body, &frame.position)
    }

    /// `[J_be J_me]` of all arms, one under the other.
    pub fn end_effector_jacobian(&self) -> DMatrix<f64> {
        let arms = self.robot.end_effectors.len();
        let mut jacobian = DMatrix::zeros(3 * arms, self.robot.size());
        for arm in 0..arms {
            jacobian.rows_mut(3 * arm, 3).copy_from(&self.arm_jacobian(arm));
        }
        jacobian
    }

    /// ω of a body's frame.
    fn yaw_rate(&self, body: usize, velocity: &DVector<f64>) -> f64 {
        self.chain(body).fold(velocity[0], |sum, link| sum + velocity[2 + link])
    }

    /// The rate of [`arm`](Self::arm) to a body's COM: each vector turns with its body.
    fn arm_rate(&self, link: usize, body: usize, velocity: &DVector<f64>) -> Vector2<f64> {
        let segments = self.segments(link, body, &self.robot.bodies[body].com);
        segments.fold(Vector2::zeros(), |sum, (k, segment)| sum + self.yaw_rate(k, velocity) * quarter_turn(&segment))
    }

    /// `Ḃ_i v`: differentiating the columns of `B_i`, each column's arm r − p changes at the rate ṙ − ṗ.
    pub fn body_jacobian_rate_times(&self, body: usize, velocity: &DVector<f64>) -> Vector3<f64> {
        let mut linear = velocity[0] * quarter_turn(&self.arm_rate(0, body, velocity));
        for link in self.chain(body) {
            linear += velocity[2 + link] * quarter_turn(&self.arm_rate(link, body, velocity));
        }
        Vector3::new(0.0, linear.x, linear.y)
    }
}

/// The robot at one state.
#[derive(Clone, Debug)]
pub struct GenericState<'a> {
    /// Its configuration.
    pub at: Configuration<'a>,
    /// v: the base twist, then the joint rates.
    pub velocity: DVector<f64>,
}

impl<'a> GenericState<'a> {
    /// Of a view.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::NotFinite`].
    pub fn new(robot: &'a Generic, state: &State<'_, f64>) -> Result<Self, Error> {
        finite_state(state)?;
        length("joint_rates", robot.bodies.len() - 1, state.joint_rates.len())?;
        let at = Configuration::new(robot, &state.base_pose, state.joint_angles)?;
        Ok(Self { at, velocity: velocity(&state.base_twist, state.joint_rates) })
    }

    /// [ω, vx, vy] of every body's COM.
    pub fn body_twists(&self) -> Vec<[f64; 3]> {
        (0..self.at.robot.bodies.len()).map(|body| self.twist(&self.at.body_jacobian(body))).collect()
    }

    /// [ω, vx, vy] of every end effector.
    pub fn end_effector_twists(&self) -> Vec<[f64; 3]> {
        (0..self.at.robot.end_effectors.len()).map(|arm| self.twist(&self.at.arm_jacobian(arm))).collect()
    }

    /// B v.
    fn twist(&self, jacobian: &DMatrix<f64>) -> [f64; 3] {
        let twist = jacobian * &self.velocity;
        [twist[0], twist[1], twist[2]]
    }
}

/// A vector turned by a right angle anticlockwise: the velocity of its head at rate 1.
fn quarter_turn(arm: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-arm.y, arm.x)
}

/// The twist at the head of `arm` when it turns about its tail at rate 1.
fn turning(arm: &Vector2<f64>) -> Vector3<f64> {
    Vector3::new(1.0, -arm.y, arm.x)
}
