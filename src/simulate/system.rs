//! The system of one phase: a robot, rigid bodies beside it, and the constraints between them.
//!
//! # Example
//! ```
//! use planar_capture::control::ZeroTorque;
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::simulate::system::{Body, System};
//! use planar_capture::state::State;
//!
//! let robot = Model::<f64>::default();
//! let ball = [Body { mass: 2.0, inertia: 0.1, pose: [0.0, 5.0, 0.0], twist: [0.5, -0.1, 0.0] }];
//! let system = System { bodies: &ball, ..System::alone(&robot) };
//! let (joint_angles, joint_rates) = (&[0.0; 3][..], &[0.0; 3][..]);
//! let x = system.vector(&State { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates })?;
//! // positions of the base, three joints and the ball, as many rates, and three numbers of the actuators
//! assert_eq!(x.len(), 2 * (3 + 3 + 3) + 3);
//! let (mut rate, mut torques) = (vec![0.0; x.len()], [0.0; 3]);
//! system.derivative(&mut ZeroTorque, 0.0, &x, &mut rate, &mut torques)?;
//! assert_eq!(rate[6..9], [0.5, -0.1, 0.0]); // the ball moves with its twist
//! # Ok::<(), planar_capture::error::Error>(())
//! ```

use crate::contact::{ConstraintSolver, ConstraintWorkspace, Contact, LoopConstraint};
use crate::control::Control;
use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::formulation::derivative;
use crate::simulate::limits::JointLimits;
use crate::state::{State, StateVector, coordinates, coordinates_mut, split, split_mut, vector_length};

/// A rigid body beside the robot.
pub type Body = crate::body::Body<f64>;

/// A robot and the bodies beside it at the start of a phase.
#[derive(Clone, Copy)]
pub struct System<'a> {
    /// The robot.
    pub model: &'a AnyModel<f64>,
    /// The bodies beside it, free but for the constraints.
    pub bodies: &'a [Body],
    /// Constraints between end effectors and bodies, or between two end effectors.
    pub constraints: &'a [LoopConstraint<f64>],
    /// Ranges of the joints, one per joint, which are checked and not enforced; empty where there are none.
    pub joint_limits: &'a [JointLimits],
    /// The largest distance of a point of a body from a joint that moves it or from its own COM, m: how exact angles on
    /// the path have to be.
    pub reach: f64,
    /// The estimated error of the robot's positions (rad, m) and rates at the start: that of the motion before. Empty where
    /// there is none.
    pub start_error: [&'a [f64]; 2],
}

impl<'a> System<'a> {
    /// A robot alone, of a reach of 1 m.
    #[must_use]
    pub fn alone(model: &'a AnyModel<f64>) -> Self {
        Self { model, bodies: &[], constraints: &[], joint_limits: &[], reach: 1.0, start_error: [&[]; 2] }
    }

    /// The number of bodies and constraints beside the robot: 0 where it moves alone.
    pub(crate) fn beside(&self) -> usize {
        self.bodies.len() + self.constraints.len()
    }

    /// The integrated vector at the start, from the robot's state.
    ///
    /// # Errors
    /// [`Error::Length`] where the state is another robot's.
    pub fn vector(&self, state: &State<'_, f64>) -> Result<Vec<f64>, Error> {
        let joints = self.model.joints();
        let mut x = vec![0.0; vector_length(joints) + 6 * self.bodies.len()];
        state.write(&mut x)?;
        let StateVector { positions, rates, .. } = split_mut(&mut x)?;
        let (positions, rates) = (coordinates_mut(positions, joints)?, coordinates_mut(rates, joints)?);
        for ((pose, twist), body) in positions.bodies.iter_mut().zip(rates.bodies).zip(self.bodies) {
            (*pose, *twist) = (body.pose, body.twist);
        }
        Ok(x)
    }

    /// The bodies at an integrated vector.
    ///
    /// # Errors
    /// [`Error::StateVector`], [`Error::Length`] where the vector is another system's.
    pub fn bodies_at(&self, x: &[f64]) -> Result<Vec<Body>, Error> {
        let joints = self.model.joints();
        let StateVector { positions, rates, .. } = split(x)?;
        let (positions, rates) = (coordinates(positions, joints)?, coordinates(rates, joints)?);
        let each = self.bodies.iter().zip(positions.bodies).zip(rates.bodies);
        Ok(each.map(|((body, pose), twist)| Body { pose: *pose, twist: *twist, ..*body }).collect())
    }

    /// d/dt of the integrated vector under a control law, whose torques are written to `torques`.
    ///
    /// # Errors
    /// Those of model and law; [`Error::Singular`] where constraints depend on each other.
    pub fn derivative(
        &self,
        control: &mut dyn Control<f64>,
        time: f64,
        x: &[f64],
        rate: &mut [f64],
        torques: &mut [f64],
    ) -> Result<(), Error> {
        derivative(self.model, control, time, x, rate, torques)?;
        self.with_constraints(|solver, workspace| solver.constrain(x, rate, workspace))
    }

    /// Projects the vector onto the constraints, from which rounding and step error have moved it.
    ///
    /// # Errors
    /// As [`System::derivative`].
    pub fn restore(&self, x: &mut [f64]) -> Result<(), Error> {
        self.with_constraints(|solver, workspace| solver.project(x, workspace))
    }

    /// The largest error of a constraint, of a yaw (rad) or a coordinate (m), and of its rate; zeros without
    /// constraints.
    ///
    /// # Errors
    /// Those of the model.
    pub fn constraint_errors(&self, x: &[f64]) -> Result<[f64; 2], Error> {
        self.with_constraints(|solver, workspace| solver.errors(x, workspace))
    }

    /// Runs the solver in its working space; the default where there are no constraints.
    fn with_constraints<R: Default>(
        &self,
        run: impl FnOnce(&ConstraintSolver<'_, f64, AnyModel<f64>>, &mut ConstraintWorkspace<'_, f64>) -> Result<R, Error>,
    ) -> Result<R, Error> {
        if self.constraints.is_empty() {
            return Ok(R::default());
        }
        let solver = ConstraintSolver { model: self.model, bodies: self.bodies, constraints: self.constraints };
        let (joints, arms) = (self.model.joints(), self.model.arms());
        let mut workspace = ConstraintWorkspace {
            contacts: &mut vec![Contact::any(); self.constraints.len()],
            numbers: &mut vec![0.0; solver.workspace_length()],
            forces: &mut vec![0.0; solver.rows()],
            jacobian: &mut vec![0.0; 3 * arms * (3 + joints)],
            end_effectors: &mut vec![[0.0; 3]; arms],
        };
        run(&solver, &mut workspace)
    }
}
