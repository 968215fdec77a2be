//! When the paper's equations apply, and the momentum jump of velocities that do not conserve it.
#![allow(clippy::float_cmp, reason = "exact zeros")]

use super::{ContactResult, ImpactSolution, Velocities, balance, solve_impact};
use crate::capture::assembly::{Assembly, Attachment};
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::reduced_matrices::reduced_matrices;
use crate::contact::{ContactKind, ContactLaw};
use crate::owned::RobotState;
use crate::registry;
use crate::simulate::system::Body;
use nalgebra::DVector;
use planar_proof::{assert_close, layout, tolerance};

const PLASTIC: ContactLaw<f64> = ContactLaw::Bounce { normal: [0.6, 0.8], restitution: 0.0 };

fn state() -> RobotState {
    RobotState {
        base_pose: [0.1, 0.2, -0.3],
        joint_angles: vec![0.7, -1.6, 1.0, 2.4, 1.5, -1.1],
        base_twist: [0.05, 0.1, -0.2],
        joint_rates: vec![0.1, -0.2, 0.15, 0.05, 0.3, -0.1],
    }
}

/// Two targets, of which attachments hold some, and contacts (target, arm, law).
fn impact(held: &[Attachment], touched: &[(usize, usize, ContactLaw<f64>)]) -> ImpactSolution {
    let model = registry::generic(&layout("dual_arm_3r"));
    let state = state();
    let mut poses = [[0.0; 3]; 2];
    model.end_effector_poses(&state.base_pose, &state.joint_angles, &mut poses).expect("poses");
    let at = |arm: usize| {
        let [_, x, y] = poses[arm];
        Body { mass: 4.0, inertia: 0.5, pose: [0.2, x - 0.3, y + 0.1], twist: [0.3, -0.1, 0.2] }
    };
    let targets = [at(0), at(1)];
    let offset = |target: usize, arm: usize| {
        let [_, x, y] = targets[target].pose;
        [poses[arm][1] - x, poses[arm][2] - y]
    };
    let contact = |&(target, arm, law): &(usize, usize, ContactLaw<f64>)| ImpactContact {
        target,
        arm,
        law,
        offset: offset(target, arm),
        miss: 0.0,
    };
    let contacts: Vec<_> = touched.iter().map(contact).collect();
    let assembly = Assembly::new(model, &state, &targets, held).expect("an assembly");
    solve_impact(&assembly, &state, &targets, &contacts).expect("an impact")
}

/// The paper's equations are of rigid captures of one target each by a robot that holds none.
#[test]
fn when_the_papers_equations_apply() {
    let (rigid, pin) = (ContactLaw::Rigid, ContactLaw::Pin);
    for (contacts, applies) in [
        (&[(0, 0, rigid), (1, 1, rigid)][..], true),
        (&[(1, 0, rigid), (0, 1, rigid)], true),
        (&[(1, 1, rigid)], true),
        (&[(0, 0, pin)], false),
        (&[(0, 0, PLASTIC)], false),
        (&[(0, 0, rigid), (1, 1, pin)], false),
        (&[(0, 0, rigid), (0, 1, rigid)], false),
        (&[], false),
    ] {
        let found = impact(&[], contacts);
        assert_eq!(found.paper.is_some(), applies, "{contacts:?}");
    }
    for kind in [ContactKind::Rigid, ContactKind::Pin] {
        let held = [Attachment { target: 0, arm: 0, kind }];
        assert!(impact(&held, &[(1, 1, rigid)]).paper.is_none(), "{kind:?}");
    }
}

/// By the paper's equations each target moves with its own end effector, `J_t t_t = J θ̇`, whichever that is.
#[test]
fn the_papers_targets_move_with_their_end_effectors() {
    let rigid = ContactLaw::Rigid;
    let (_, jacobian) =
        reduced_matrices(&*registry::generic(&layout("dual_arm_3r")), &state().view()).expect("a Jacobian");
    for contacts in [&[(0, 0, rigid), (1, 1, rigid)][..], &[(1, 0, rigid), (0, 1, rigid)], &[(1, 1, rigid)]] {
        let found = impact(&[], contacts);
        let paper = found.paper.expect("rigid captures");
        let end_effectors = &jacobian * DVector::from_column_slice(&paper.joint_rates_after);
        for ContactResult { contact: ImpactContact { arm, offset: [rx, ry], .. }, .. } in found.contacts {
            let [omega, vx, vy] = paper.target_twists_after[arm].expect("a capture");
            let twist = [omega, vx - omega * ry, vy + omega * rx];
            assert_close("twist", &twist, &end_effectors.as_slice()[3 * arm..3 * arm + 3], tolerance::SAME_IMPACT);
        }
    }
}

/// The jump of wrong velocities is relative to the larger sum of the bodies' momenta.
#[test]
fn relative_jumps_of_momentum() {
    let model = registry::generic(&layout("dual_arm_3r"));
    let jump = |before: f64, after: f64, turn: f64| {
        let twist = |speed: f64| [0.0, speed, 0.0];
        let state = RobotState { base_twist: twist(before), joint_rates: vec![0.0; 6], ..state() };
        let targets = [Body { mass: 4.0, inertia: 0.5, pose: [0.0, 3.0, -2.0], twist: [0.0; 3] }];
        let assembly = Assembly::new(model.clone_box(), &state, &targets, &[]).expect("an assembly");
        let velocities = Velocities {
            base_twist: twist(after),
            joint_rates: vec![0.0; 6],
            targets: vec![[turn, 0.0, 0.0]],
            impulses: Vec::new(),
        };
        balance(&assembly, &state, &targets, &[], &velocities).expect("sums").relative_momentum_jump
    };
    assert_eq!([jump(0.0, 0.0, 0.0), jump(0.5, 0.5, 0.0)], [0.0; 2]);
    // the angular momentum about the origin is in the same ratio
    for (before, after, expected) in [(0.2, 0.5, 0.6), (0.5, 0.2, 0.6), (0.0, 0.5, 1.0), (0.5, -0.5, 2.0)] {
        assert!((jump(before, after, 0.0) - expected).abs() < 1e-12, "{before} {after}");
    }
    assert!((jump(0.0, 0.0, 0.3) - 1.0).abs() < 1e-12);
}

/// An arm that touches what another one holds: the impact is that with a target of its own which both arms touch at once,
/// as the contact that holds it already has nothing to do but to go on.
#[test]
fn a_held_target_is_touched_where_it_is() {
    let (model, state) = (registry::generic(&layout("dual_arm_3r")), state());
    let (mut poses, mut twists) = ([[0.0; 3]; 2], [[0.0; 3]; 2]);
    model.end_effector_poses(&state.base_pose, &state.joint_angles, &mut poses).expect("poses");
    model.end_effector_twists(&state.view(), &mut twists).expect("twists");
    let ([_, x, y], [omega, vx, vy]) = (poses[0], twists[0]);
    let (rx, ry) = (0.8, -0.5);
    let target =
        Body { mass: 4.0, inertia: 0.5, pose: [0.2, x + rx, y + ry], twist: [omega, vx - omega * ry, vy + omega * rx] };
    let contact = |arm: usize, law| {
        let offset = [poses[arm][1] - target.pose[1], poses[arm][2] - target.pose[2]];
        ImpactContact { target: 0, arm, law, offset, miss: 0.0 }
    };
    let solved = |held: &[Attachment], contacts: &[ImpactContact]| {
        let assembly = Assembly::new(model.clone_box(), &state, &[target], held).expect("an assembly");
        solve_impact(&assembly, &state, &[target], contacts).expect("an impact")
    };
    for law in [ContactLaw::Rigid, ContactLaw::Pin] {
        let held = solved(&[Attachment { target: 0, arm: 0, kind: ContactKind::Rigid }], &[contact(1, law)]);
        let separate = solved(&[], &[contact(0, ContactLaw::Rigid), contact(1, law)]);
        let [held_twist, separate_twist] = [&held, &separate].map(|solution| solution.target_twists[0]);
        assert_close("target", &held_twist, &separate_twist, tolerance::SAME_IMPACT);
        let [held_impulse, separate_impulse] = [&held, &separate].map(|it| it.exact.impulses[1].expect("a contact"));
        assert!(held_impulse[1].hypot(held_impulse[2]) > 0.1, "{held_impulse:?}");
        assert_close("impulse", &held_impulse, &separate_impulse, tolerance::SAME_IMPACT);
        let rates = [&held, &separate].map(|solution| &solution.exact.joint_rates_after);
        assert_close("rates", rates[0], rates[1], tolerance::SAME_IMPACT);
    }
}

/// A target that nothing touches adds its energy, before and after, and has no part in a jump of the momentum, by both models.
#[test]
fn an_untouched_target_adds_its_energy() {
    let (model, state) = (registry::generic(&layout("dual_arm_3r")), state());
    let mut poses = [[0.0; 3]; 2];
    model.end_effector_poses(&state.base_pose, &state.joint_angles, &mut poses).expect("poses");
    let [_, x, y] = poses[1];
    let touched = Body { mass: 4.0, inertia: 0.5, pose: [0.2, x - 0.3, y + 0.1], twist: [0.3, -0.1, 0.2] };
    let free = Body { mass: 3.0, inertia: 0.7, pose: [0.1, 2.0, -1.0], twist: [0.9, 0.4, -0.6] };
    let solved = |targets: &[Body]| {
        let assembly = Assembly::new(model.clone_box(), &state, targets, &[]).expect("an assembly");
        let (target, offset) = (targets.len() - 1, [0.3, -0.1]);
        let contact = ImpactContact { target, arm: 1, law: ContactLaw::Rigid, offset, miss: 0.0 };
        let found = solve_impact(&assembly, &state, targets, &[contact]).expect("an impact");
        [found.exact, found.paper.expect("a rigid capture")]
    };
    let energy = 0.5 * (0.7 * 0.9 * 0.9 + 3.0 * (0.4 * 0.4 + 0.6 * 0.6));
    for (alone, both) in solved(&[touched]).into_iter().zip(solved(&[free, touched])) {
        let expected = [alone.kinetic_energy_before + energy, alone.kinetic_energy_after + energy];
        let found = [both.kinetic_energy_before, both.kinetic_energy_after];
        assert_close("energies", &found, &expected, tolerance::SAME_IMPACT);
        assert_close("jump", &both.momentum_jump, &alone.momentum_jump, tolerance::SAME_IMPACT);
    }
}
