//! Names of equal arms.

use super::Symmetry;
use crate::format::Arm;
use crate::renderer::tests::graph;

#[test]
fn equal_arms_have_each_others_names() {
    let symmetry = Symmetry::of(&graph("dual_arm_3r"));
    for [a, b] in [
        ["joint_rates[2]", "joint_rates[5]"],
        ["contacts[0][1]", "contacts[1][1]"],
        ["arm1_link2_length", "arm2_link2_length"],
        ["arm1_link1_mass_and_added", "arm2_link1_mass_and_added"],
    ] {
        assert_eq!([symmetry.counterpart(a), symmetry.counterpart(b)], [Some(b), Some(a)]);
        assert_eq!([symmetry.is_first(a), symmetry.is_first(b)], [Some(true), Some(false)]);
    }
    for alone in ["base_twist[1]", "base_mass", "total_mass"] {
        assert_eq!(symmetry.counterpart(alone), None);
    }
    let names = ["arm1_link1_length", "base_mass", "arm1_link2_length", "arm2_link1_length", "arm2_link2_length"];
    let expected = ["arm1_link1_length", "arm2_link1_length", "base_mass", "arm1_link2_length", "arm2_link2_length"];
    assert_eq!(symmetry.side_by_side(&names), expected);
    // 3 + 3 joints, arm by arm; with the base's three before them
    assert_eq!(symmetry.elements(&[6]), [3, 4, 5, 0, 1, 2]);
    assert_eq!(symmetry.elements(&[9]), [0, 1, 2, 6, 7, 8, 3, 4, 5]);
    assert_eq!(symmetry.elements(&[2, 2]), [2, 3, 0, 1], "the second axis is not that of the arms");
    assert_eq!(symmetry.elements(&[2, 3]), [3, 4, 5, 0, 1, 2]);
    assert_eq!(symmetry.elements(&[]), [0]);
}

/// Arms of other numbers of links have no other; of three equal ones the third has none.
#[test]
fn arms_are_taken_two_by_two() {
    let of = |links: &[usize]| {
        let mut graph = graph("dual_arm_3r");
        let arm = graph.layout.arms[0].clone();
        graph.layout.arms = links.iter().map(|links| Arm { links: *links, ..arm.clone() }).collect();
        graph.parameters.retain(|parameter| parameter.arm.is_none());
        Symmetry::of(&graph).arms
    };
    assert_eq!(of(&[3, 2]), [0, 1]);
    assert_eq!(of(&[2, 2, 2]), [1, 0, 2]);
    assert_eq!(of(&[2, 1, 1, 2]), [3, 2, 1, 0]);
    assert_eq!(of(&[4, 4, 4, 4]), [1, 0, 3, 2]);
    // the mount of the first one is on an axis
    assert_eq!(Symmetry::of(&graph("triple_arm_3r")).arms, [0, 2, 1]);
}
