//! A scenario that unit tests share.

use super::Scenario;
use crate::registry;
use planar_proof::file;

/// The paper's robot at rest, with a disc that turns at each end effector, which it holds after a second; the keys of the motion after
/// that follow.
pub(crate) fn two_discs(post_impact: &str) -> Scenario {
    let angles = "[0.698, -1.571, 1.047, 2.444, 1.571, -1.047]";
    let target = |i: u32, y: f64| {
        format!(
            "[[target]]\nname = \"t{i}\"\narm = \"arm{i}\"\nmass = 10.0\ninertia = 1.0\ncontact = [0.0, {y}]\n\
             radius = 0.5\ntwist = [0.2, 0.0, 0.0]\n"
        )
    };
    let text = format!(
        "name = \"it\"\nlayout = \"dual_arm_3r\"\n[initial]\njoint_angles = {angles}\n[approach]\nduration = 1.0\n\
         trajectory = \"cycloidal\"\ntracking = \"exact\"\nfinal_joint_angles = {angles}\n{}{}[post_impact]\n\
         {post_impact}",
        target(1, 0.5),
        target(2, -0.5)
    );
    Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}
