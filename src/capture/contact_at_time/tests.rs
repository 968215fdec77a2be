//! A target that two arms hold where the approach ends: its place, what each arm misses, and the normals of bounces.

use super::*;
use crate::contact::ContactKind;
use crate::registry;
use crate::scenario::fixture::two_discs;
use planar_proof::{assert_close, file, tolerance};

/// A box of 2 m by 1 m, turned by 0.3 rad, which both arms of a robot touch at the middles of two sides.
fn scenario(kind: &str) -> (Scenario, [[f64; 2]; 2]) {
    touched(kind, 0.3, [[1.0, 0.0], [0.0, -0.5]])
}

/// The same at another yaw, touched at these points of the box.
fn touched(kind: &str, yaw: f64, points: [[f64; 2]; 2]) -> (Scenario, [[f64; 2]; 2]) {
    let points = points.map(|point| rotated(point, yaw));
    let [[ax, ay], [bx, by]] = points;
    let text = format!(
        "name = \"it\"\nlayout = \"dual_arm_2r\"\n[initial]\njoint_angles = [0.1, 0.1, 0.1, 0.1]\n[approach]\nduration = 1.0\n\
         trajectory = \"cycloidal\"\nfinal_joint_angles = [0.2, 0.1, 0.1, 0.1]\ntracking = \"exact\"\n[[target]]\nname = \"box\"\n\
         arm = [\"arm1\", \"arm2\"]\nkind = \"{kind}\"\nmass = 2.0\ninertia = 1.0\nyaw = {yaw}\ntwist = [0.1, 0.2, 0.3]\n\
         polygon = [[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]]\n\
         contact = [[{ax}, {ay}], [{bx}, {by}]]\n[post_impact]\nduration = 1.0\nstep = 0.1\n"
    );
    let scenario = Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED);
    (scenario.unwrap_or_else(|e| panic!("{e}")), points)
}

/// End effectors that are [0.2, −0.1] m too far apart: the target is in the middle, and each arm misses half of that.
#[test]
fn a_target_is_in_the_middle_of_its_end_effectors() {
    let (scenario, points) = scenario("rigid");
    let at = [3.0, -2.0];
    let off = [[0.1, -0.05], [-0.1, 0.05]];
    let end_effectors =
        [0, 1].map(|i: usize| [9.0, at[0] + points[i][0] + off[i][0], at[1] + points[i][1] + off[i][1]]);
    let (bodies, contacts) = contact_at_time(&scenario, &scenario.cases[0], &end_effectors);
    let [Body { pose, twist, mass, .. }] = bodies[..] else { panic!("{bodies:?}") };
    assert_close("pose", &pose, &[0.3, at[0], at[1]], tolerance::POLYNOMIAL);
    assert_eq!((twist, mass.to_bits()), ([0.1, 0.2, 0.3], f64::to_bits(2.0)));
    for (i, contact) in contacts.iter().enumerate() {
        assert_eq!(
            (contact.target, contact.arm, contact.law),
            (0, i, ContactLaw::new(ContactKind::Rigid, || [0.0; 2], 0.0))
        );
        let offset = [points[i][0] + off[i][0], points[i][1] + off[i][1]];
        assert_close("offset", &contact.offset, &offset, tolerance::POLYNOMIAL);
        assert_close("miss", &[contact.miss], &[0.1_f64.hypot(0.05)], tolerance::POLYNOMIAL);
    }
    assert_eq!(contacts.len(), 2);
}

/// The normal of a bounce is that of the outline, turned with the target.
#[test]
fn normals_turn_with_the_target() {
    let (scenario, points) = scenario("bounce");
    let end_effectors = points.map(|[x, y]| [0.0, x, y]);
    let (_, contacts) = contact_at_time(&scenario, &scenario.cases[0], &end_effectors);
    for (contact, side) in contacts.iter().zip([[1.0, 0.0], [0.0, -1.0]]) {
        let (normal, _) = contact.law.bounce().expect("a bounce");
        assert_close("normal", &normal, &rotated(side, 0.3), tolerance::POLYNOMIAL);
    }
    assert_eq!(contacts.len(), 2);
}

/// Near a corner another side is nearest to the point that is not turned into the axes of the target.
#[test]
fn normals_near_corners_are_of_the_side_that_is_touched() {
    for yaw in [0.4, 0.6, 0.8, 1.0, 1.2] {
        let (scenario, points) = touched("bounce", yaw, [[1.0, 0.48], [0.98, -0.5]]);
        let (_, contacts) = contact_at_time(&scenario, &scenario.cases[0], &points.map(|[x, y]| [0.0, x, y]));
        for (contact, side) in contacts.iter().zip([[1.0, 0.0], [0.0, -1.0]]) {
            let (normal, _) = contact.law.bounce().expect("a bounce");
            assert_close("normal", &normal, &rotated(side, yaw), tolerance::POLYNOMIAL);
        }
        assert_eq!(contacts.len(), 2);
    }
}

/// A target is where the arms put it whose grasps close, or all where none does.
#[test]
fn grasps_that_fail_do_not_place_the_target() {
    let (mut scenario, points) = scenario("rigid");
    let off = [[0.1, -0.05], [-0.1, 0.05]];
    let end_effectors = [0, 1].map(|i: usize| [0.0, points[i][0] + off[i][0], points[i][1] + off[i][1]]);
    let rigid = Some(ContactKind::Rigid);
    for (kinds, place) in [([rigid, None], off[0]), ([None, rigid], off[1]), ([None, None], [0.0; 2])] {
        scenario.cases[0].kinds[0] = kinds.to_vec();
        let (bodies, contacts) = contact_at_time(&scenario, &scenario.cases[0], &end_effectors);
        assert_close("place", &bodies[0].pose[1..], &place, tolerance::POLYNOMIAL);
        assert_eq!(contacts.len(), kinds.iter().flatten().count());
        assert!(contacts.iter().all(|contact| contact.miss < tolerance::POLYNOMIAL), "{contacts:?}");
    }
}

/// Each of two targets bounces with its own restitution.
#[test]
fn a_bounce_has_the_restitution_of_its_target() {
    let mut scenario = two_discs("duration = 1.0\nstep = 0.1\n");
    let case = &mut scenario.cases[0];
    case.kinds = vec![vec![Some(ContactKind::Bounce)]; 2];
    case.restitutions = vec![0.2, 0.9];
    let (_, contacts) = contact_at_time(&scenario, &scenario.cases[0], &[[0.0; 3], [0.0, 3.0, 0.0]]);
    let of = |contact: &ImpactContact| (contact.target, contact.law.bounce().expect("a bounce").1);
    assert_eq!(contacts.iter().map(of).collect::<Vec<_>>(), [(0, 0.2), (1, 0.9)]);
}
