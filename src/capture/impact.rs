//! One impact by the exact and by the paper's equations, (10) to (17), with the balance of momentum and energy.
//!
//! # Example
//! ```
//! use planar_capture::capture::{assembly::Assembly, contact_at_time::ImpactContact, impact::solve_impact};
//! use planar_capture::contact::ContactLaw;
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::owned::RobotState;
//! use planar_capture::simulate::system::Body;
//!
//! // a stretched arm along x, at rest, takes hold of a target that comes along the same line
//! let (joint_angles, joint_rates) = (vec![0.0; 3], vec![0.0; 3]);
//! let state = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates };
//! let target = Body { mass: 10.0, inertia: 1.0, pose: [0.0, 4.0, 0.0], twist: [0.0, -0.2, 0.0] };
//! let contact = ImpactContact { target: 0, arm: 0, law: ContactLaw::Rigid, offset: [-0.5, 0.0], miss: 0.0 };
//! let assembly = Assembly::new(Box::new(Model::<f64>::default()), &state, &[target], &[])?;
//! let found = solve_impact(&assembly, &state, &[target], &[contact])?;
//! // 530 kg and 10 kg go on together
//! let [_, velocity, _] = found.target_twists[0];
//! assert!((velocity + 0.2 * 10.0 / 540.0).abs() < 1e-12);
//! assert!((found.contacts[0].impulse[1] - 530.0 * velocity).abs() < 1e-9);
//! # Ok::<(), planar_capture::error::Error>(())
//! ```

use crate::capture::assembly::{Assembly, TargetPlacement};
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::contact_response::{ContactResponse, response};
use crate::contact::{
    self, Contact, ContactPartner, DelassusMatrix, balance_length, balance_momentum, bilateral_rows, workspace_length,
};
use crate::dynamics::{AnyModel, Momentum};
use crate::error::Error;
use crate::impact::{self, PaperImpactWorkspace, RigidImpactOutput};
use crate::owned::RobotState;
use crate::scalar::Real;
use crate::simulate::bodies::{BodySums, bodies, with_bodies};
use crate::simulate::system::Body;
use crate::state::State;
use crate::target::Target;

/// The impact by both models.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ImpactSolution {
    /// In full coordinates.
    pub exact: ImpactResult,
    /// By the paper's literal equations, for rigid captures of one target per arm; `None` for other contacts.
    pub paper: Option<ImpactResult>,
    /// [ω, vx, vy] of every target after it, by the exact equations.
    pub target_twists: Vec<[f64; 3]>,
    /// The contacts one by one.
    pub contacts: Vec<ContactResult>,
}

/// One contact, by the exact equations.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ContactResult {
    /// Target, arm, contact point and law.
    pub contact: ImpactContact,
    /// [n, fx, fy] on the robot at the end effector; N m s, N s.
    pub impulse: [f64; 3],
    /// Inertia and relative velocity at the contact.
    pub response: ContactResponse,
}

/// The result of an impact. Lists per arm have `None` for an arm without contact.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ImpactResult {
    /// rad/s.
    pub joint_rates_after: Vec<f64>,
    /// [ω, vx, vy] of the base COM; rad/s, m/s.
    pub base_twist_after: [f64; 3],
    /// [ω, vx, vy] of each target's COM.
    pub target_twists_after: Vec<Option<[f64; 3]>>,
    /// [n, fx, fy] on the robot at each end effector; N m s, N s.
    pub impulses: Vec<Option<[f64; 3]>>,
    /// [l, px, py] after less before, robot and targets together, about the inertial origin.
    pub momentum_jump: [f64; 3],
    /// The larger of linear and angular jump, relative to the sum of the bodies' momenta.
    pub relative_momentum_jump: f64,
    /// With the targets, J.
    pub kinetic_energy_before: f64,
    /// With the targets, J.
    pub kinetic_energy_after: f64,
}

impl ImpactResult {
    /// Magnitude of [fx, fy] per arm, N s.
    #[must_use]
    pub fn impulse_magnitudes(&self) -> Vec<Option<f64>> {
        self.impulses.iter().map(|impulse| impulse.map(|[_, fx, fy]| libm::hypot(fx, fy))).collect()
    }
}

/// Solves an impact on an assembly; `before` and `targets` are the states before it.
///
/// # Errors
/// Those of the model; [`Error::Singular`] where contacts depend on each other.
pub fn solve_impact(
    assembly: &Assembly,
    before: &RobotState,
    targets: &[Body],
    contacts: &[ImpactContact],
) -> Result<ImpactSolution, Error> {
    let model = &*assembly.model;
    let exact = by_contacts(assembly, before, targets, contacts)?;
    let literal = rigid_by_arm(assembly, targets, contacts).filter(|_| !contacts.is_empty());
    let paper =
        literal.map(|by_arm| by_equations_of_the_paper(model, before, targets, contacts, &by_arm)).transpose()?;
    let each = contacts.iter().zip(&exact.impulses).map(|(contact, impulse)| {
        let response = response(model, before, &targets[contact.target], contact)?;
        Ok(ContactResult { contact: *contact, impulse: *impulse, response })
    });
    let results = each.collect::<Result<_, Error>>()?;
    let result = |velocities: &Velocities| balance(assembly, before, targets, contacts, velocities);
    let paper = paper.as_ref().map(result).transpose()?;
    let target_twists = exact.targets.clone();
    Ok(ImpactSolution { exact: result(&exact)?, paper, target_twists, contacts: results })
}

/// Velocities after an impact, of all targets, and one impulse per contact.
struct Velocities {
    base_twist: [f64; 3],
    joint_rates: Vec<f64>,
    targets: Vec<[f64; 3]>,
    impulses: Vec<[f64; 3]>,
}

/// The targets by arm, where each contact is rigid and the only one of its target, and no target is held yet.
fn rigid_by_arm(assembly: &Assembly, targets: &[Body], contacts: &[ImpactContact]) -> Option<Vec<Option<Target<f64>>>> {
    if assembly.places.iter().any(|place| matches!(place, TargetPlacement::Merged { .. }))
        || !assembly.constraints.is_empty()
    {
        return None;
    }
    let mut by_arm = vec![None; assembly.model.arms()];
    for contact in contacts {
        let alone = contacts.iter().filter(|other| other.target == contact.target).count() == 1;
        if !alone || !contact.law.kind().holds_yaw() {
            return None;
        }
        let Body { mass, inertia, twist, .. } = targets[contact.target];
        by_arm[contact.arm] = Some(Target { mass, inertia, contact: contact.offset, twist });
    }
    Some(by_arm)
}

/// The rigid capture by the paper's reduced equations, (10) to (17).
fn by_equations_of_the_paper(
    model: &AnyModel<f64>,
    before: &RobotState,
    targets: &[Body],
    contacts: &[ImpactContact],
    by_arm: &[Option<Target<f64>>],
) -> Result<Velocities, Error> {
    let (joints, arms) = (model.joints(), model.arms());
    let size = 3 + joints;
    let mut joint_rates = vec![0.0; joints];
    let mut target_twists = vec![[0.0; 3]; arms];
    let mut impulses = vec![[0.0; 3]; arms];
    let mut after =
        RigidImpactOutput { joint_rates: &mut joint_rates, target_twists: &mut target_twists, impulses: &mut impulses };
    let mut workspace = PaperImpactWorkspace {
        impact_matrix: &mut vec![0.0; joints * joints],
        impact_momentum: &mut vec![0.0; joints],
        jacobian: &mut vec![0.0; 3 * arms * joints],
        mass_matrix: &mut vec![0.0; size * size],
    };
    let base_twist = impact::paper(model, &before.view(), by_arm, &mut workspace, &mut after)?;
    let arm_of = |i: usize| contacts.iter().find(|contact| contact.target == i).map(|contact| contact.arm);
    let of_targets = targets.iter().enumerate();
    Ok(Velocities {
        base_twist,
        targets: of_targets.map(|(i, target)| arm_of(i).map_or(target.twist, |arm| target_twists[arm])).collect(),
        impulses: contacts.iter().map(|contact| impulses[contact.arm]).collect(),
        joint_rates,
    })
}

/// Contacts of any kind together with the existing constraints, in full coordinates.
fn by_contacts(
    assembly: &Assembly,
    before: &RobotState,
    targets: &[Body],
    contacts: &[ImpactContact],
) -> Result<Velocities, Error> {
    let model = &*assembly.model;
    let mut end_effectors = vec![[0.0; 3]; model.arms()];
    model.end_effector_poses(&before.base_pose, &before.joint_angles, &mut end_effectors)?;
    let bodies: Vec<Body> = assembly.separate(targets);
    let new = contacts.iter().map(|contact| {
        let (partner, offset) = match assembly.places[contact.target] {
            TargetPlacement::Merged { arm, .. } => {
                let ([_, x, y], [_, from_x, from_y]) = (end_effectors[contact.arm], end_effectors[arm]);
                (ContactPartner::EndEffector(arm), [x - from_x, y - from_y])
            }
            TargetPlacement::Separate(i) => (ContactPartner::Body(i), contact.offset),
        };
        Contact { arm: contact.arm, partner, offset, law: contact.law }
    });
    let held = assembly.constraint_contacts(&end_effectors, &bodies);
    let all: Vec<_> = new.chain(held).collect();
    let mut joint_rates = vec![0.0; model.joints()];
    let mut body_twists = vec![[0.0; 3]; bodies.len()];
    let mut impulses = vec![[0.0; 3]; all.len()];
    let mut after =
        contact::ImpactOutput { joint_rates: &mut joint_rates, body_twists: &mut body_twists, impulses: &mut impulses };
    if !are_independent(&all) {
        // the impulses of bounces, and whether the contacts depend on each other
        let length = workspace_length(model.joints(), model.arms(), bodies.len(), DelassusMatrix::count(&all));
        let mut numbers = vec![0.0; length];
        let rows = DelassusMatrix::new(model, &before.base_pose, &before.joint_angles, &bodies, &all, &mut numbers)?;
        contact::impact(model, &before.view(), &bodies, rows, &mut after)?;
    }
    let length = balance_length(model.joints(), model.arms(), bodies.len(), bilateral_rows(&all));
    let base_twist = balance_momentum(model, &before.view(), &bodies, &all, &mut vec![0.0; length], &mut after)?;
    let mut end_effector_twists = vec![[0.0; 3]; model.arms()];
    let moving = State { base_twist, joint_rates: &joint_rates, ..before.view() };
    model.end_effector_twists(&moving, &mut end_effector_twists)?;
    let moved: Vec<_> = bodies.iter().zip(&body_twists).map(|(body, twist)| Body { twist: *twist, ..*body }).collect();
    let after = assembly.targets(targets, &end_effectors, &end_effector_twists, &moved);
    impulses.truncate(contacts.len());
    let twists = after.iter().map(|target| target.twist).collect();
    Ok(Velocities { base_twist, joint_rates, targets: twists, impulses })
}

/// Whether the contacts are rigid or pins, each with a body of its own: their equations cannot depend on each other.
fn are_independent(contacts: &[Contact<f64>]) -> bool {
    contacts.iter().enumerate().all(|(i, contact)| {
        let is_alone = !contacts[..i].iter().any(|other| other.partner == contact.partner || other.arm == contact.arm);
        is_alone && contact.law.kind().holds() && matches!(contact.partner, ContactPartner::Body(_))
    })
}

fn balance(
    assembly: &Assembly,
    before: &RobotState,
    targets: &[Body],
    contacts: &[ImpactContact],
    velocities: &Velocities,
) -> Result<ImpactResult, Error> {
    let Velocities { base_twist, joint_rates, targets: twists, impulses } = velocities;
    let moving = State { base_twist: *base_twist, joint_rates, ..before.view() };
    let moved = targets.iter().zip(twists).map(|(target, twist)| Body { twist: *twist, ..*target });
    let (start, start_sizes) = total(assembly, &before.view(), targets)?;
    let (end, end_sizes) = total(assembly, &moving, &moved.collect::<Vec<_>>())?;
    let [px, py] = [0, 1].map(|i: usize| end.linear_momentum[i] - start.linear_momentum[i]);
    let jump = [end.angular_momentum - start.angular_momentum, px, py];
    let relative = |jump: f64, scale: f64| if scale == 0.0 { 0.0 } else { jump / scale };
    let angular = relative(jump[0].abs(), Real::maximum(start_sizes[0], end_sizes[0]));
    let linear = relative(libm::hypot(px, py), Real::maximum(start_sizes[1], end_sizes[1]));
    let per_arm = |value: &dyn Fn(usize, &ImpactContact) -> [f64; 3]| {
        let contact = |arm| contacts.iter().enumerate().find(|(_, contact)| contact.arm == arm);
        (0..assembly.model.arms()).map(|arm| contact(arm).map(|(i, contact)| value(i, contact))).collect()
    };
    Ok(ImpactResult {
        base_twist_after: *base_twist,
        target_twists_after: per_arm(&|_, contact| twists[contact.target]),
        impulses: per_arm(&|i, _| impulses[i]),
        momentum_jump: jump,
        relative_momentum_jump: Real::maximum(angular, linear),
        kinetic_energy_before: start.kinetic_energy,
        kinetic_energy_after: end.kinetic_energy,
        joint_rates_after: joint_rates.clone(),
    })
}

/// Momentum and energy of the robot with merged targets and the separate targets together, and its scales.
fn total(assembly: &Assembly, state: &State<'_, f64>, targets: &[Body]) -> Result<(Momentum<f64>, [f64; 2]), Error> {
    let separate = assembly.separate(targets);
    let sums = BodySums::new(bodies(&*assembly.model, state, &separate)?.into_iter());
    Ok((with_bodies(assembly.model.momentum(state)?, separate.iter().copied()), sums.momentum_sizes))
}

#[cfg(test)]
mod tests;
