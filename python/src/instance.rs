//! One instance of a batch, for functions of one state.

use planar_capture::dynamics::{
    EquationsOfMotion, ForwardDynamics, Impact, Kinematics, MomentumAndEnergy, ReducedDynamics, Robot as _,
};
use planar_capture::error::Error;
use planar_capture::evaluator::GraphModel;
use planar_capture::state::{Forces, State};
use planar_capture::target::Target;

/// State, forces and targets; what a function does not have is zero.
#[derive(Default)]
pub struct Instance<'a> {
    base_pose: [f64; 3],
    joint_angles: &'a [f64],
    base_twist: [f64; 3],
    joint_rates: &'a [f64],
    joint_torques: &'a [f64],
    base_wrench: Option<[f64; 3]>,
    end_effector_wrenches: Option<&'a [[f64; 3]]>,
    target_masses: &'a [f64],
    target_inertias: &'a [f64],
    contacts: &'a [f64],
    target_twists: &'a [f64],
}

fn triple(numbers: &[f64]) -> [f64; 3] {
    let mut triple = [0.0; 3];
    triple.iter_mut().zip(numbers).for_each(|(to, from)| *to = *from);
    triple
}

impl<'a> Instance<'a> {
    /// Of the inputs of a function, by their names; `zeros` are as many as joints.
    pub fn of(inputs: impl Iterator<Item = (&'a str, &'a [f64])>, zeros: &'a [f64]) -> Self {
        let mut instance = Self { joint_angles: zeros, joint_rates: zeros, joint_torques: zeros, ..Self::default() };
        for (name, numbers) in inputs {
            match name {
                "base_pose" => instance.base_pose = triple(numbers),
                "joint_angles" => instance.joint_angles = numbers,
                "base_twist" => instance.base_twist = triple(numbers),
                "joint_rates" => instance.joint_rates = numbers,
                "joint_torques" => instance.joint_torques = numbers,
                "base_wrench" => instance.base_wrench = Some(triple(numbers)),
                "end_effector_wrenches" => instance.end_effector_wrenches = Some(numbers.as_chunks().0),
                "target_masses" => instance.target_masses = numbers,
                "target_inertias" => instance.target_inertias = numbers,
                "contacts" => instance.contacts = numbers,
                "target_twists" => instance.target_twists = numbers,
                _ => {}
            }
        }
        instance
    }

    /// Position and velocity of the robot.
    pub fn state(&self) -> State<'a, f64> {
        let &Self { base_pose, joint_angles, base_twist, joint_rates, .. } = self;
        State { base_pose, joint_angles, base_twist, joint_rates }
    }

    /// One per arm; an arm whose target has neither mass nor inertia captures nothing.
    pub fn targets(&self) -> Vec<Option<Target<f64>>> {
        let inertias = self.target_masses.iter().zip(self.target_inertias);
        let motions = self.contacts.as_chunks::<2>().0.iter().zip(self.target_twists.as_chunks::<3>().0);
        inertias
            .zip(motions)
            .map(|((mass, inertia), (contact, twist))| {
                let target = Target { mass: *mass, inertia: *inertia, contact: *contact, twist: *twist };
                (target.mass != 0.0 || target.inertia != 0.0).then_some(target)
            })
            .collect()
    }

    /// Why a function of this name has no result here; `None` where it has one.
    pub fn error(&self, model: &GraphModel, function: &str) -> Option<Error> {
        let (joints, arms) = (model.joints(), model.arms());
        let (state, vector, matrix) = (self.state(), || vec![0.0; joints], vec![0.0; joints * joints]);
        let result = match function {
            "mass_matrix" => {
                model.mass_matrix(&state.base_pose, state.joint_angles, &mut vec![0.0; (3 + joints).pow(2)])
            }
            "bias" => model.bias(&state, &mut vec![0.0; 3 + joints]),
            "end_effector_poses" => {
                model.end_effector_poses(&state.base_pose, state.joint_angles, &mut vec![[0.0; 3]; arms])
            }
            "end_effector_twists" => model.end_effector_twists(&state, &mut vec![[0.0; 3]; arms]),
            "reduced_dynamics" | "generalized_jacobian" => {
                let mut jacobian = vec![0.0; 3 * arms * joints];
                model.reduced_dynamics(&state, &mut matrix.clone(), &mut vector(), &mut jacobian)
            }
            "reduced_impact" => {
                model.reduced_impact(&state, &self.targets(), &mut matrix.clone(), &mut vector(), &mut vector())
            }
            "full_impact" | "capture" => model.full_impact(&state, &self.targets(), &mut vector()).map(|_| ()),
            name if name.starts_with("forward_dynamics") => {
                let forces = Forces {
                    joint_torques: self.joint_torques,
                    base_wrench: self.base_wrench,
                    end_effector_wrenches: self.end_effector_wrenches,
                };
                model.forward_dynamics(&state, &forces, &mut vector()).map(|_| ())
            }
            _ => model.momentum(&state).map(|_| ()),
        };
        result.err()
    }
}
