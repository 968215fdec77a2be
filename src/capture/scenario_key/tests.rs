//! The keys of errors that no scenario of the tests has.

use super::*;
use crate::registry;
use crate::scenario::LawNumbers;
use planar_proof::file;

fn scenario() -> Scenario {
    let target = |name: &str, arm: &str, turn: f64| {
        format!(
            "[[target]]\nname = \"{name}\"\narm = \"{arm}\"\nmass = 1.0\ninertia = 1.0\nradius = 0.5\nposition = [9.0, 9.0]\n\
             twist = [{turn:?}, 0.0, 0.0]\n"
        )
    };
    let text = format!(
        "name = \"it\"\nlayout = \"dual_arm_2r\"\n[initial]\njoint_angles = [0.1, 0.1, 0.1, 0.1]\n[approach]\nduration = 1.0\nstep = 0.125\n\
         trajectory = \"cycloidal\"\nfinal_joint_angles = [0.2, 0.1, 0.1, 0.1]\ntracking = \"exact\"\n[contact]\n\
         detection = \"event\"\n{}{}[post_impact]\nduration = 1.0\nstep = 0.25\n",
        target("slow", "arm1", 0.5),
        target("fast", "arm2", -2.0)
    );
    Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

fn path(error: &StudyError) -> String {
    error.key(&scenario()).path
}

/// Coordinates that a phase cannot have, a tolerance that it does not reach, with adaptive steps the gain that makes them
/// short, else the tolerance, and with others their length; of the approach and after
/// the impact.
#[test]
fn phases_that_stop() {
    let tolerance = Error::Tolerance { tolerance: 1e-9, step: 1e-12 };
    for (source, integrator, expected) in [
        (Error::UnsupportedBodies { count: 1 }, Integrator::RungeKutta4, "coordinates"),
        (tolerance, Integrator::Adaptive { tolerance: 1e-9 }, "tolerance"),
        (Error::StateVector { found: 2 }, Integrator::RungeKutta4, "step"),
        (Error::StateVector { found: 2 }, Integrator::Adaptive { tolerance: 1e-9 }, "tolerance"),
    ] {
        let mut scenario = scenario();
        scenario.approach.integration.integrator = integrator;
        scenario.post_impact.as_mut().expect("a phase").integration.integrator = integrator;
        let stopped = PhaseError { time: 0.5, source };
        let key = StudyError::Approach(stopped).key(&scenario).path;
        assert_eq!(key, format!("approach.{expected}"));
        let after = StudyError::PostImpact { case: "it".to_owned(), source: stopped }.key(&scenario).path;
        assert_eq!(after, format!("post_impact.{expected}"));
    }
}

/// The gain with the shorter time constants.
#[test]
fn gains_that_make_adaptive_steps_short() {
    let mut scenario = scenario();
    let integrator = Integrator::Adaptive { tolerance: 1e-9 };
    scenario.approach.integration.integrator = integrator;
    scenario.post_impact.as_mut().expect("a phase").integration.integrator = integrator;
    let source = PhaseError { time: 0.5, source: Error::Steps { step: 1e-9, needed: 1e9, most: 1e7 } };
    let gains = |value: f64| vec![value; 4];
    for (proportional, derivative, expected) in [(49.0, 14.0, "derivative_gain"), (1e6, 14.0, "proportional_gain")] {
        let (proportional_gain, derivative_gain) = (gains(proportional), gains(derivative));
        let after = scenario.post_impact.as_mut().expect("a phase");
        after.control = PostCaptureControl::Hold {
            proportional_gain: proportional_gain.clone(),
            derivative_gain: derivative_gain.clone(),
        };
        scenario.approach.tracking = Tracking::ProportionalDerivative { proportional_gain, derivative_gain };
        let found = [StudyError::Approach(source), StudyError::PostImpact { case: "it".to_owned(), source }];
        let found = found.map(|error| error.key(&scenario).path);
        assert_eq!(found, [format!("approach.{expected}"), format!("post_impact.{expected}")]);
    }
    let law = |pose_gain, rate_gain| Tracking::ResolvedMotionRate { pose_gain, rate_gain, singularity_threshold: 0.1 };
    for (tracking, expected) in [(law(1.0, 2.0), "approach.rate_gain"), (law(3.0, 2.0), "approach.pose_gain")] {
        scenario.approach.tracking = tracking;
        assert_eq!(StudyError::Approach(source).key(&scenario).path, expected);
    }
    for (base_gain, expected) in [(1.0, "post_impact.derivative_gain"), (9.0, "post_impact.base_gain")] {
        scenario.post_impact.as_mut().expect("a phase").control =
            PostCaptureControl::Stabilise { derivative_gain: gains(2.0), base_gain, base_torque_limit: None };
        let error = StudyError::PostImpact { case: "it".to_owned(), source };
        assert_eq!(error.key(&scenario).path, expected);
    }
    // the gains of a law of the program's own have no keys: it is what is named
    let numbers = LawNumbers::default();
    scenario.approach.tracking = Tracking::Own { name: "late", numbers: numbers.clone() };
    scenario.post_impact.as_mut().expect("a phase").control = PostCaptureControl::Own { name: "soft", numbers };
    let found = [StudyError::Approach(source), StudyError::PostImpact { case: "it".to_owned(), source }];
    let found = found.map(|error| error.key(&scenario)).map(|key| (key.path, key.value));
    let expected = [("approach.tracking", "late"), ("post_impact.control", "soft")];
    assert_eq!(found, expected.map(|(path, value)| (path.to_owned(), value.to_owned())));
}

/// A rough path has the step of its own phase.
#[test]
fn rough_paths() {
    let key = |table: &'static str| {
        StudyError::RoughPath { case: "it".to_owned(), table, time: 0.5, path_error: 0.1 }.key(&scenario())
    };
    let found = ["approach", "post_impact"].map(key);
    assert_eq!(found.each_ref().map(|key| key.path.as_str()), ["approach.step", "post_impact.step"]);
    assert_eq!(found.each_ref().map(|key| key.value.as_str()), ["0.125", "0.25"]);
}

/// Of distances that are used up: the outline of many parts, whichever of the two it is, else the twist of the target
/// that turns faster.
#[test]
fn distances_that_are_used_up() {
    let key = |bodies: [&str; 2], parts: [usize; 2]| {
        let bodies = bodies.map(str::to_owned);
        let what = Box::new(Exhausted { time: 0.5, evaluations: 9, bodies, of_pair: 9, parts });
        path(&StudyError::ClearanceExhausted { case: "it".to_owned(), what })
    };
    let both = ["targets/slow", "targets/fast"];
    assert_eq!(key(both, [1, 1]), "target[1].twist");
    assert_eq!(key(["base", "targets/slow"], [1, 1]), "target[0].twist");
    assert_eq!(key(both, [MANY_PARTS, 1]), "target[0].polygon");
    assert_eq!(key(both, [1, MANY_PARTS]), "target[1].polygon");
    assert_eq!(key(["base", "targets/slow"], [MANY_PARTS, MANY_PARTS - 1]), "target[0].twist");
    assert_eq!(key(["base", "arms/arm1/link2"], [MANY_PARTS, 1]), "approach");
}

/// Bounces that do not come to rest have the restitution of the case, where it has its own, else the target's, at its value.
#[test]
fn restitutions_of_bounces() {
    let mut scenario = scenario();
    (scenario.targets[0].restitution, scenario.targets[1].restitution) = (0.25, 0.5);
    scenario.cases[0].restitutions = vec![0.25, 0.75];
    let key = |target: &str| {
        let (case, target) = (scenario.cases[0].name.clone(), target.to_owned());
        let ScenarioKey { path, value } = StudyError::Chatter { case, impacts: 9, target, time: 0.5 }.key(&scenario);
        (path, value)
    };
    assert_eq!(key("slow"), ("target[0].restitution".to_owned(), "0.25".to_owned()));
    assert_eq!(key("fast"), ("case[0].restitutions.fast".to_owned(), "0.75".to_owned()));
}
