//! Rigid targets far heavier than the robot: what the audit says of their momentum, and that it helps.

use crate::run;
use planar_capture::capture::Study;
use planar_capture::registry;
use planar_capture::scenario::Scenario;
use planar_proof::{assert_close, file, tolerance};

const REDUCED: &str = "coordinates = \"reduced\"";
const CURE: &str = "`post_impact.coordinates = \"reduced\"` conserves the momentum";
const NO_DIGITS: &str = "beyond 1e5 times double precision does not resolve the momentum";

/// The robot of the paper, of 560 kg, takes hold of a disc that turns at `spin`.
fn holding(ratio: f64, [mass, inertia]: [f64; 2], spin: f64, [post_impact, more]: [&str; 2]) -> Scenario {
    let text = format!(
        "name = \"it\"\nlayout = \"dual_arm_3r\"\n[initial]\njoint_angles = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047]\n\
         [approach]\nduration = 20.0\ntrajectory = \"quartic\"\n\
         final_joint_angles = [-0.524, -1.393, -0.035, 2.618, -1.393, -0.035]\n\
         final_end_effector_twists = [[0.0, -0.1, 0.0], [0.0, 0.1, 0.0]]\n\
         [[target]]\nname = \"heavy\"\narm = \"arm1\"\ncontact = [0.0, 0.5]\nradius = 0.5\ntwist = [{spin}, 0.0, 0.0]\n\
         mass = {}\ninertia = {}\n{more}[post_impact]\nduration = 50.0\n{post_impact}\n",
        ratio * mass,
        ratio * inertia
    );
    Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

fn failures(scenario: &Scenario) -> Vec<String> {
    run(scenario).audit_failures()
}

/// As heavy as the robot, times a ratio.
const BODY: [f64; 2] = [560.0, 56.0];

/// Up to 1e5 times the robot's mass the audit names the coordinates that conserve the momentum, and they do.
#[test]
fn the_named_coordinates_conserve_the_momentum() {
    for (ratio, spin) in [(1e3, 0.02), (1e4, 0.02), (1e4, 0.0), (9e4, 0.02), (9e4, 0.0)] {
        let found = failures(&holding(ratio, BODY, spin, ["", ""]));
        assert!(
            matches!(found.as_slice(), [one] if one.contains("post-impact: momentum drift") && one.contains(CURE)),
            "{ratio} {spin}: {found:?}"
        );
        assert_eq!(failures(&holding(ratio, BODY, spin, [REDUCED, ""])), Vec::<String>::new(), "{ratio} {spin}");
    }
}

/// Of a target beyond that the audit says that nothing helps where it is all but at rest: nothing does. Of one that moves, the
/// momentum is conserved.
#[test]
fn heavier_targets_are_beyond_double_precision() {
    let heavier = [1e6, 1e7, 1e8];
    for ratio in heavier {
        for (coordinates, is_named) in [("", true), (REDUCED, false)] {
            let found = failures(&holding(ratio, BODY, 0.0, [coordinates, ""]));
            let [one] = found.as_slice() else { panic!("{ratio} {coordinates}: {found:?}") };
            assert!(one.contains(NO_DIGITS) && one.contains("times its mass,"), "{one}");
            assert_eq!(one.contains("`post_impact.coordinates = \"reduced\"` does up to there"), is_named, "{one}");
        }
        let smaller = failures(&holding(ratio, BODY, 0.0, ["tolerance = 1e-13", ""]));
        assert!(smaller.iter().any(|one| one.contains(NO_DIGITS)), "{ratio}: {smaller:?}");
    }
    let end = |ratio| {
        let study = run(&holding(ratio, BODY, 0.0, ["", ""]));
        study.cases[0].capture.as_ref().expect("a capture").post_impact.end().state.joint_angles.clone()
    };
    assert_close("moved alike", &end(1e5), &end(1e7), tolerance::HEAVY_TARGETS);
    let of_inertia = failures(&holding(1.0, [1.0, 1e11], 0.0, ["", ""]));
    assert!(
        matches!(of_inertia.as_slice(), [one] if one.contains(NO_DIGITS) && one.contains("times its mass · reach²,")),
        "{of_inertia:?}"
    );
}

/// Targets that are free, or in a closed loop, need full coordinates; of a target that is not heavy nothing is said.
#[test]
fn what_does_not_help_is_not_named() {
    let free = "[[target]]\nname = \"free\"\narm = \"arm2\"\nmass = 1.0\ninertia = 1.0\ncontact = [0.0, -0.5]\nradius = 0.5\n\
                kind = \"none\"\n";
    let study = run(&holding(1e4, BODY, 0.0, ["", free]));
    let smaller = run(&holding(1e4, BODY, 0.0, ["tolerance = 1e-12", free]));
    let [drift, less] = [&study, &smaller]
        .map(|study| study.cases[0].capture.as_ref().expect("a capture").post_impact.drift.momentum_drift);
    assert!(less < 0.1 * drift, "{drift} {less}");
    let found = study.audit_failures();
    let [one] = found.as_slice() else { panic!("{found:?}") };
    assert!(one.contains("a smaller `post_impact.tolerance` makes it less") && !one.contains(REDUCED), "{one}");
    let drifting = |ratio: f64| {
        let mut study: Study = run(&holding(ratio, BODY, 0.1, ["", ""]));
        study.cases[0].capture.as_mut().expect("a capture").post_impact.drift.momentum_drift = 1e-8;
        study.audit_failures()
    };
    assert_eq!(drifting(1.0), ["it, post-impact: momentum drift 1.00e-8 is over its bound 1e-9"]);
}
