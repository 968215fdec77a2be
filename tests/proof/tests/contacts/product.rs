//! The product's impacts, from the reference's scenes.

use planar_capture::body::Body;
use planar_capture::contact::{self, Contact, ContactPartner, DelassusMatrix, ImpactOutput, workspace_length};
use planar_capture::dynamics::Model;
use planar_capture::error::Error;
use planar_capture::layout::Layout;
use planar_capture::owned::CloneModel;
use planar_capture::registry;
use planar_capture::scalar::Real;
use planar_capture::state::State;
use planar_proof::maximal;
use planar_proof::maximal::impact::Kind;
use planar_proof::maximal::random::{PlannedContact, Scene};
use planar_proof::{assert_close, tolerance};

/// Result of an impact by the product.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome<T> {
    pub base_twist: [T; 3],
    pub joint_rates: Vec<T>,
    pub body_twists: Vec<[T; 3]>,
    pub impulses: Vec<[T; 3]>,
}

impl<T: Real> Outcome<T> {
    /// Base, joints, bodies: as [`System::velocities`](planar_proof::maximal::system::System::velocities).
    pub fn velocities(&self) -> Vec<f64> {
        let all = self.base_twist.iter().chain(&self.joint_rates).chain(self.body_twists.as_flattened());
        all.map(|value| value.to_f64()).collect()
    }
}

/// Both models of a layout, generic alone where no code of it is generated.
pub fn both_models(layout: &Layout) -> Vec<Box<dyn CloneModel>> {
    registry::generated(layout).into_iter().chain([registry::generic(layout)]).collect()
}

pub fn law(kind: Kind) -> contact::ContactLaw<f64> {
    match kind {
        Kind::Rigid => contact::ContactLaw::Rigid,
        Kind::Pin => contact::ContactLaw::Pin,
        Kind::Bounce { normal, restitution } => contact::ContactLaw::Bounce { normal, restitution },
    }
}

/// A body of the reference as one of the product.
pub fn body(body: &maximal::body::Body) -> Body<f64> {
    let maximal::body::Body { mass, inertia, pose, twist } = *body;
    Body { mass, inertia, pose, twist }
}

/// The scene's targets and contacts.
pub fn targets_and_contacts(scene: &Scene) -> (Vec<Body<f64>>, Vec<Contact<f64>>) {
    let contact = |planned: &PlannedContact| Contact {
        arm: planned.arm,
        partner: ContactPartner::Body(planned.target),
        offset: planned.offset,
        law: law(planned.kind),
    };
    (scene.targets.iter().map(body).collect(), scene.planned.iter().map(contact).collect())
}

/// All contacts at once, by [`contact::impact`], which [`contact::balance_momentum`] has to confirm.
pub fn solve_impact<T: Real>(
    model: &dyn Model<T>,
    state: &State<'_, T>,
    bodies: &[Body<T>],
    contacts: &[Contact<T>],
) -> Result<Outcome<T>, Error> {
    let length = workspace_length(model.joints(), model.arms(), bodies.len(), DelassusMatrix::count(contacts));
    let mut numbers = vec![T::constant(f64::NAN); length];
    let rows = DelassusMatrix::new(model, &state.base_pose, state.joint_angles, bodies, contacts, &mut numbers)?;
    let mut found = Outcome {
        base_twist: [T::ZERO; 3],
        joint_rates: vec![T::ZERO; model.joints()],
        body_twists: vec![[T::ZERO; 3]; bodies.len()],
        impulses: vec![[T::ZERO; 3]; contacts.len()],
    };
    let mut after = ImpactOutput {
        joint_rates: &mut found.joint_rates,
        body_twists: &mut found.body_twists,
        impulses: &mut found.impulses,
    };
    found.base_twist = contact::impact(model, state, bodies, rows, &mut after)?;
    let mut balanced = found.clone();
    let mut after = ImpactOutput {
        joint_rates: &mut balanced.joint_rates,
        body_twists: &mut balanced.body_twists,
        impulses: &mut balanced.impulses,
    };
    let rows = contact::bilateral_rows(contacts);
    let mut numbers =
        vec![T::constant(f64::NAN); contact::balance_length(model.joints(), model.arms(), bodies.len(), rows)];
    balanced.base_twist = contact::balance_momentum(model, state, bodies, contacts, &mut numbers, &mut after)?;
    let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let same = |what, found: &[f64], balanced: &[f64]| {
        assert_close(what, balanced, found, tolerance::SAME_BALANCE * T::EPSILON.to_f64() * largest(found));
    };
    let impulses = |outcome: &Outcome<T>| -> Vec<f64> {
        outcome.impulses.as_flattened().iter().map(|value| value.to_f64()).collect()
    };
    same("velocities", &found.velocities(), &balanced.velocities());
    same("impulses", &impulses(&found), &impulses(&balanced));
    Ok(found)
}
