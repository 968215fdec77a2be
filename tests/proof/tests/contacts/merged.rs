//! Rigid contacts against the capture in full coordinates, loop constraints against merged links, and drift of loops.

use planar_capture::body::Body;
use planar_capture::contact::{
    Contact, ContactLaw, ContactPartner, DelassusMatrix, ImpactOutput, LoopConstraint, impact, workspace_length,
};
use planar_capture::control::ZeroTorque;
use planar_capture::dynamics::{Kinematics, Merge};
use planar_capture::generated::dual_arm_3r::Model;
use planar_capture::impact as rigid;
use planar_capture::owned::RobotState;
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::system::System;
use planar_capture::simulate::{Timing, simulate};
use planar_capture::state::State;
use planar_capture::target::Target;
use planar_proof::{assert_close, tolerance};

const ANGLES: [f64; 6] = [0.3, -1.2, 0.7, 2.1, 1.4, -0.6];
const RATES: [f64; 6] = [0.4, -0.2, 0.9, -0.5, 0.3, 0.8];

fn state() -> State<'static, f64> {
    State { base_pose: [0.9, 1.5, -2.5], joint_angles: &ANGLES, base_twist: [0.2, -0.3, 0.1], joint_rates: &RATES }
}

/// Base twist, joint rates, body twists and impulses after an impact.
type Outcome = ([f64; 3], [f64; 6], Vec<[f64; 3]>, Vec<[f64; 3]>);

fn solve(model: &Model<f64>, state: &State<'_, f64>, bodies: &[Body<f64>], contacts: &[Contact<f64>]) -> Outcome {
    let mut numbers = vec![0.0; workspace_length(6, 2, bodies.len(), DelassusMatrix::count(contacts))];
    let rows =
        DelassusMatrix::new(model, &state.base_pose, state.joint_angles, bodies, contacts, &mut numbers).expect("rows");
    let (mut rates, mut twists) = ([0.0; 6], vec![[0.0; 3]; bodies.len()]);
    let mut impulses = vec![[0.0; 3]; contacts.len()];
    let mut after = ImpactOutput { joint_rates: &mut rates, body_twists: &mut twists, impulses: &mut impulses };
    let base = impact(model, state, bodies, rows, &mut after).expect("an impact");
    (base, rates, twists, impulses)
}

fn end_effector_poses(state: &State<'_, f64>) -> [[f64; 3]; 2] {
    let mut poses = [[0.0; 3]; 2];
    Kinematics::end_effector_poses(&Model::<f64>::default(), &state.base_pose, state.joint_angles, &mut poses)
        .expect("poses");
    poses
}

/// Each end effector captures a body: the same as the capture in full coordinates.
#[test]
fn rigid_contacts_are_the_rigid_capture() {
    let (model, state) = (Model::<f64>::default(), state());
    let target =
        |scale: f64| Target { mass: 12.0 * scale, inertia: 3.0 * scale, contact: [0.3, -0.4], twist: [-0.7, 0.2, 0.6] };
    let targets = [Some(target(1.0)), Some(target(40.0))];
    let (mut rates, mut twists, mut impulses) = ([0.0; 6], [[0.0; 3]; 2], [[0.0; 3]; 2]);
    let mut after =
        rigid::RigidImpactOutput { joint_rates: &mut rates, target_twists: &mut twists, impulses: &mut impulses };
    let base = rigid::exact(&model, &state, &targets, &mut after).expect("an impact");

    let bodies: Vec<_> = targets
        .iter()
        .flatten()
        .map(|t| Body { mass: t.mass, inertia: t.inertia, pose: [0.0; 3], twist: t.twist })
        .collect();
    let contacts = [0, 1].map(|i| Contact {
        arm: i,
        partner: ContactPartner::Body(i),
        offset: [0.3, -0.4],
        law: ContactLaw::Rigid,
    });
    let found = solve(&model, &state, &bodies, &contacts);
    assert_close("base twist", &found.0, &base, tolerance::SAME_IMPACT);
    assert_close("joint rates", &found.1, &rates, tolerance::SAME_IMPACT);
    assert_close("target twists", found.2.as_flattened(), twists.as_flattened(), tolerance::SAME_IMPACT);
    assert_close("impulses", found.3.as_flattened(), impulses.as_flattened(), tolerance::SAME_IMPACT);
}

/// A body under a rigid loop constraint moves as one merged with the last link.
#[test]
fn a_rigid_constraint_is_a_merged_link() {
    let state = state();
    let timing = Timing { duration: 4.0, step: 0.005, sample: 4.0, ..Timing::default() };
    let contact = Contact { arm: 1, partner: ContactPartner::Body(0), offset: [0.3, -0.4], law: ContactLaw::Rigid };
    let end_effector = end_effector_poses(&state)[1];
    let body = Body {
        mass: 60.0,
        inertia: 9.0,
        pose: [0.2, end_effector[1] - 0.3, end_effector[2] + 0.4],
        twist: [0.1, 0.2, -0.3],
    };
    let model = Model::<f64>::default();
    let (base_twist, rates, twists, _) = solve(&model, &state, &[body], &[contact]);
    let start = RobotState { base_twist, joint_rates: rates.to_vec(), ..RobotState::from_view(&state) };
    let bodies = [Body { twist: twists[0], ..body }];
    let constraints = [LoopConstraint::new(&contact, &end_effector, &body.pose).expect("a constraint")];
    let system = System { bodies: &bodies, constraints: &constraints, ..System::alone(&model) };
    let constrained = simulate(&system, &mut ZeroTorque, &start, &timing, &mut NoEvents, &mut || {}).expect("a motion");

    let mut merged = model;
    let target = Target { mass: body.mass, inertia: body.inertia, contact: contact.offset, twist: body.twist };
    Merge::merge(&mut merged, &state.base_pose, &ANGLES, &[None, Some(target)]).expect("merged");
    let rigid = simulate(&System::alone(&merged), &mut ZeroTorque, &start, &timing, &mut NoEvents, &mut || {})
        .expect("a motion");
    let (a, b) = (constrained.end(), rigid.end());
    assert_close("base pose", &a.state.base_pose, &b.state.base_pose, tolerance::MERGED_MOTION);
    assert_close("joint angles", &a.state.joint_angles, &b.state.joint_angles, tolerance::MERGED_MOTION);
    assert_close("joint rates", &a.state.joint_rates, &b.state.joint_rates, tolerance::MERGED_MOTION);
}

/// Both end effectors on one body, with rigid and pinned contacts.
#[test]
fn a_loop_stays_closed() {
    let state = state();
    let both @ [left, right] = end_effector_poses(&state);
    let com = [f64::midpoint(left[1], right[1]) + 0.2, f64::midpoint(left[2], right[2])];
    let body = Body { mass: 200.0, inertia: 150.0, pose: [0.0, com[0], com[1]], twist: [0.3, 0.1, -0.2] };
    for kinds in [
        [ContactLaw::Rigid, ContactLaw::Rigid],
        [ContactLaw::Pin, ContactLaw::Rigid],
        [ContactLaw::Pin, ContactLaw::Pin],
    ] {
        let contacts: Vec<_> = both
            .iter()
            .zip(kinds)
            .enumerate()
            .map(|(arm, (pose, law))| Contact {
                arm,
                partner: ContactPartner::Body(0),
                offset: [pose[1] - com[0], pose[2] - com[1]],
                law,
            })
            .collect();
        let model = Model::<f64>::default();
        let (base_twist, rates, twists, _) = solve(&model, &state, &[body], &contacts);
        let start = RobotState { base_twist, joint_rates: rates.to_vec(), ..RobotState::from_view(&state) };
        let bodies = [Body { twist: twists[0], ..body }];
        let constraint = |(contact, pose)| LoopConstraint::new(contact, pose, &body.pose).expect("a constraint");
        let constraints: Vec<_> = contacts.iter().zip(&both).map(constraint).collect();
        let system = System { bodies: &bodies, constraints: &constraints, ..System::alone(&model) };
        let drift = |step: f64| {
            let timing = Timing { duration: 2.0, step, sample: 2.0, ..Timing::default() };
            let phase =
                simulate(&system, &mut ZeroTorque, &start, &timing, &mut NoEvents, &mut || {}).expect("a motion");
            let [open, opening] = phase.constraint_errors;
            assert!(
                open < tolerance::PROJECTED_CONSTRAINT && opening < tolerance::PROJECTED_CONSTRAINT,
                "{kinds:?}: {open} {opening}"
            );
            phase.drift
        };
        // the remaining drift is the integrator's, of order 4 in the step
        let (coarse, fine) = (drift(0.01), drift(0.005));
        for (coarse, fine) in [(coarse.momentum_drift, fine.momentum_drift), (coarse.energy_error, fine.energy_error)] {
            assert!(fine < coarse / 10.0 && fine < tolerance::CONSTRAINED_DRIFT, "{kinds:?}: {coarse:e} {fine:e}");
        }
    }
}
