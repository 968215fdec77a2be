//! Steps in which the robot turns far: contacts, distances and the estimated error of the path are those of short steps.

use crate::Silent;
use planar_capture::capture::{Study, study};
use planar_capture::outline::Outline;
use planar_capture::registry;
use planar_capture::scenario::Scenario;
use planar_proof::{file, tolerance};

fn parse(text: &str) -> Scenario {
    Scenario::parse(text, "long_steps.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

fn run(scenario: &Scenario) -> Study {
    let model = registry::generated(&scenario.layout).expect("generated code");
    study(scenario, &|| model.clone_box(), 5.0, &mut Silent).unwrap_or_else(|e| panic!("{e}"))
}

/// A turn per second, past a ball that the end effector meets in the second turn.
fn spinning(integrator: &str, step: f64) -> Scenario {
    parse(&format!(
        "name = \"spin\"\nlayout = \"single_arm_3r\"\n[initial]\njoint_angles = [0.0, 1.0, 0.5]\n\
         base_twist = [6.283185307179586, 0.0, 0.0]\n[approach]\nduration = 4.0\nstep = {step}\n\
         trajectory = \"cycloidal\"\nfinal_joint_angles = [0.0, 1.0, 0.5]\ntracking = \"computed_torque\"\n\
         integrator = \"{integrator}\"\n[contact]\ndetection = \"event\"\n[[target]]\nname = \"ball\"\narm = \"arm1\"\n\
         mass = 10.0\ninertia = 1.0\nradius = 0.1\nkind = \"bounce\"\nposition = [-1.5, -1.5]\n\
         [post_impact]\nduration = 1.0\nintegrator = \"adaptive\"\n"
    ))
}

#[test]
fn a_turn_per_step_misses_no_contact() {
    let met = |integrator: &str, step: f64| {
        let result = run(&spinning(integrator, step));
        let case = &result.cases[0];
        let (_, time) = case.approach.as_ref().expect("an approach").event.expect("the ball is met");
        let impulse =
            case.capture.as_ref().expect("a capture").impact.exact.impulse_magnitudes()[0].expect("a contact");
        (time, impulse)
    };
    let (expected, impulse) = met("rk4", 0.001);
    assert!(impulse > 10.0);
    for (integrator, step) in
        [("adaptive", 4.0), ("adaptive", 2.0), ("adaptive", 1.0), ("adaptive", 0.3), ("gauss_legendre", 0.1)]
    {
        let found = met(integrator, step);
        let difference = [found.0 - expected, (found.1 - impulse) / impulse];
        // gauss_legendre: its own error at a tenth of a turn per step
        assert!(difference.iter().all(|d| d.abs() < tolerance::LONG_STEPS), "{integrator}, {step} s: {difference:?}");
    }
}

/// An arm that oscillates five times a second, close to the base once in each swing.
#[test]
fn distances_within_long_steps_are_those_of_short_ones() {
    let swinging = |integrator: &str, step: f64| {
        let mut scenario = parse(&format!(
            "name = \"swing\"\nlayout = \"single_arm_3r\"\n[initial]\njoint_angles = [1.2, 1.0, 0.5]\n\
             joint_rates = [-1.0, 2.0, 4.0]\n[approach]\nduration = 4.0\nstep = {step}\ntrajectory = \"cycloidal\"\n\
             final_joint_angles = [1.2, 1.0, 0.5]\ntracking = \"pd\"\nproportional_gain = 200.0\nderivative_gain = 1.0\n\
             integrator = \"{integrator}\"\n[clearance]\non_overlap = \"fail\"\n"
        ));
        scenario.layout.base.outline = Some(Outline::rectangle([0.0; 2], [1.0, 1.0], 0.0));
        for link in &mut scenario.layout.arms[0].links {
            link.outline = Some(Outline::Capsule { ends: [[0.0; 2], [link.length, 0.0]], radius: 0.05 });
        }
        let result = run(&scenario);
        assert_eq!(result.audit_failures(), Vec::<String>::new(), "{integrator}, {step} s");
        let least = result.cases[0].clearance.least.as_ref().expect("a pair").clone();
        (least.distance, least.time)
    };
    let expected = swinging("rk4", 0.001);
    for (integrator, step) in [("adaptive", 2.0), ("adaptive", 0.25), ("adaptive", 0.01), ("gauss_legendre", 0.025)] {
        let (distance, time) = swinging(integrator, step);
        let context = format!("{integrator}, {step} s: {distance} m at {time} s, not {expected:?}");
        assert!((distance - expected.0).abs() < tolerance::CLEARANCE && (time - expected.1).abs() < 1e-3, "{context}");
    }
}

/// A joint is beyond its limit between two steps: the violation is that of short steps, whatever the steps are.
#[test]
fn a_violation_between_steps_is_seen() {
    let found = |step: f64| {
        let result = run(&parse(&format!(
            "name = \"limits\"\nlayout = \"single_arm_3r\"\n[initial]\njoint_angles = [0.0, 0.5, 0.0]\n\
             joint_rates = [0.8, 0.0, 0.0]\n[limits]\njoint_angles = [-1.0, 1.0]\n[approach]\n\
             duration = 10.0\nstep = {step}\ntrajectory = \"quintic\"\nfinal_joint_angles = [0.0, 0.5, 0.0]\n\
             final_joint_rates = [0.0, 0.0, 0.0]\ntracking = \"exact\"\n"
        )));
        let violations = result.approach.limit_violations.expect("there are limits");
        let angle = violations.joint_angle.expect("an angle beyond its limit");
        [angle.time, angle.value]
    };
    // the quintic's angle is largest at a third of the time: 8 (1/3)(1 − 1/3)³(1 + 3/3)
    let largest = 8.0 / 3.0 * (2.0_f64 / 3.0).powi(3) * 2.0;
    for step in [0.005, 0.5, 5.0, 10.0] {
        let [time, angle] = found(step);
        assert!((time - 10.0 / 3.0).abs() < 1e-4, "{step}: {time}");
        assert!((angle - largest).abs() < 1e-9, "{step}: {angle}");
    }
}

/// Actuators at their limits are seen within a step of adaptive integration, whose length says nothing of the motion.
#[test]
fn saturation_within_a_step_is_seen() {
    let found = |step: f64| {
        let text = format!(
            "name = \"saturated\"\nlayout = \"single_arm_3r\"\n[initial]\njoint_angles = [0.0, 0.5, 0.0]\n[approach]\n\
             duration = 10.0\nstep = {step}\ntrajectory = \"cycloidal\"\nfinal_joint_angles = [2.0, 0.5, 0.0]\n\
             tracking = \"computed_torque\"\ntorque_limits = 1.0\nintegrator = \"adaptive\"\n"
        );
        run(&parse(&text)).approach.saturation.joints
    };
    let wanted = found(0.005);
    assert!(wanted[0] > 1.0, "{wanted:?}");
    for step in [0.5, 10.0] {
        let joints = found(step);
        let close = joints.iter().zip(&wanted).all(|(found, wanted)| (found - wanted).abs() < 0.03 * wanted + 0.05);
        assert!(close, "{step}: {joints:?}, and {wanted:?} with short steps");
    }
}

/// From rest to rest in one step: the errors are relative to the motion within it.
#[test]
fn one_step_from_rest_to_rest_passes_the_audit() {
    let moved = |step: f64| {
        run(&parse(&format!(
            "name = \"rest\"\nlayout = \"single_arm_3r\"\n[initial]\njoint_angles = [0.0, 1.0, 0.5]\n[approach]\n\
             duration = 20.0\nstep = {step}\ntrajectory = \"cycloidal\"\nfinal_joint_angles = [0.6, -0.4, 0.9]\n\
             tracking = \"exact\"\nintegrator = \"adaptive\"\n"
        )))
    };
    for step in [20.0, 10.0, 4.0] {
        let study = moved(step);
        assert_eq!(study.audit_failures(), Vec::<String>::new(), "{step} s");
        let drift = study.approach.drift;
        let errors = [drift.momentum_drift, drift.energy_error];
        assert!(errors.iter().all(|error| *error < tolerance::LONG_STEPS), "{step} s: {errors:?}");
    }
}
