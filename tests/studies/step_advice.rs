//! What the program advises where a phase is beyond the bounds of the audit.

use crate::path_error::free;
use crate::{run, scenario};
use planar_capture::capture::step_advice::step_advice;
use planar_capture::scenario::Scenario;
use planar_capture::simulate::stepper::Integrator;

/// The only advice, with what is advised.
fn advised(scenario: &Scenario, key: &str) -> (String, f64) {
    let advice = step_advice(scenario, &run(scenario));
    let [sentence] = &advice[..] else { panic!("{advice:?}") };
    let value = sentence.split(&format!("`{key} = ")).nth(1).and_then(|rest| rest.split('`').next());
    (sentence.clone(), value.and_then(|value| value.parse().ok()).unwrap_or_else(|| panic!("{sentence}")))
}

/// With the advised step or tolerance the audit has nothing to say, and neither has the advice.
#[test]
fn what_is_advised_keeps_the_bounds() {
    for (integrator, step, rates) in [
        (Integrator::RungeKutta4, 0.05, [2.0, -3.0, 4.0]),
        (Integrator::RungeKutta4, 0.02, [2.0, -3.0, 4.0]),
        (Integrator::GaussLegendre, 0.2, [2.0, -3.0, 4.0]),
        (Integrator::Adaptive { tolerance: 1e-5 }, 0.01, [2.0, -3.0, 4.0]),
    ] {
        let of = |integrator, step| free(rates, 5.0, step, integrator);
        let given = of(integrator, step);
        assert!(!run(&given).audit_failures().is_empty(), "{integrator:?} {step}");
        let is_adaptive = integrator.properties().is_adaptive;
        let (sentence, value) = advised(&given, if is_adaptive { "tolerance" } else { "step" });
        assert!(sentence.contains(integrator.properties().name) && sentence.starts_with("[approach]"), "{sentence}");
        assert_eq!(sentence.contains("or `integrator = \"adaptive\"`"), !is_adaptive, "{sentence}");
        let better =
            if is_adaptive { of(Integrator::Adaptive { tolerance: value }, step) } else { of(integrator, value) };
        let study = run(&better);
        assert_eq!(study.audit_failures(), Vec::<String>::new(), "{sentence}");
        assert_eq!(step_advice(&better, &study), Vec::<String>::new());
        // not a small part of what would do
        assert!(value > 0.003 * if is_adaptive { 1e-7 } else { step }, "{sentence}");
    }
}

/// An integrator of order 1 would take more steps than anyone has time for.
#[test]
fn no_step_that_takes_too_long_is_advised() {
    let given = free([0.6, -0.8, 0.5], 5.0, 0.005, Integrator::SemiImplicitEuler);
    let advice = step_advice(&given, &run(&given));
    let wanted =
        "[approach] is integrated by `semi_implicit_euler` with steps of 0.005 s: `integrator = \"adaptive\"` would do";
    assert_eq!(advice, [wanted]);
    let better = free([0.6, -0.8, 0.5], 5.0, 0.005, Integrator::Adaptive { tolerance: Integrator::DEFAULT_TOLERANCE });
    assert_eq!(run(&better).audit_failures(), Vec::<String>::new());
}

/// Each phase has its own advice, by its own errors; a joint at its limit makes the order of fixed steps 1.
#[test]
fn advice_is_that_of_the_phase() {
    let scenario = scenario("raina_shah_2017");
    let mut study = run(&scenario);
    assert_eq!(step_advice(&scenario, &study), Vec::<String>::new());
    // 16 times the share of the bound that is aimed at: half the step, with order 4
    let captured = study.cases[1].capture.as_mut().expect("a capture");
    captured.post_impact.path_error = 8e-4;
    let [of_order_4] = &step_advice(&scenario, &study)[..] else { panic!("no advice") };
    assert!(of_order_4.starts_with("[post_impact]"), "{of_order_4}");
    assert!(of_order_4.contains("by `rk4` with steps of 0.005 s: `step = 0.002`"), "{of_order_4}");
    for (joints, base) in [(vec![0.1, 0.0], 0.0), (vec![0.0, 0.1], 0.0), (vec![0.0, 0.0], 0.1)] {
        let saturation = &mut study.cases[1].capture.as_mut().expect("a capture").post_impact.saturation;
        (saturation.joints, saturation.base) = (joints, base);
        let [of_order_1] = &step_advice(&scenario, &study)[..] else { panic!("no advice") };
        assert!(of_order_1.contains("`step = 0.0003`") && !of_order_1.contains("adaptive"), "{of_order_1}");
    }
    // more steps than anyone takes
    study.cases[1].capture.as_mut().expect("a capture").post_impact.path_error = 800.0;
    let [of_many] = &step_advice(&scenario, &study)[..] else { panic!("no advice") };
    assert!(
        of_many.contains("far shorter, or `integrator = \"adaptive\"`") && !of_many.contains("step ="),
        "{of_many}"
    );
    // what no number says has no advice
    study.cases[1].capture.as_mut().expect("a capture").post_impact.path_error = f64::NAN;
    assert_eq!(step_advice(&scenario, &study), Vec::<String>::new());
}

/// An approach without contacts is part of no case with contact detection, and neither the audit's matter nor the advice's.
#[test]
fn an_approach_that_no_case_has_is_not_advised_on() {
    let scenario = scenario("elastic_rebound");
    let mut study = run(&scenario);
    assert!(study.cases.iter().all(|case| case.approach.is_some()));
    study.approach.path_error = 1.0;
    assert_eq!((study.audit_failures(), step_advice(&scenario, &study)), (Vec::new(), Vec::new()));
    study.cases[0].approach.as_mut().expect("its own").path_error = 1.0;
    assert_eq!((study.audit_failures().len(), step_advice(&scenario, &study).len()), (1, 1));
}

/// From an error r times its bound follow the tolerance times 1/(2 r), and the step times that where the order is 1, as long as
/// the phase has a million steps at most.
#[test]
fn what_is_advised_is_half_of_what_keeps_the_bound() {
    let mut scenario = scenario("raina_shah_2017");
    let mut study = run(&scenario);
    for (integrator, ratio, advised) in [
        (Integrator::Adaptive { tolerance: 1e-8 }, 8.0, "tolerance = 6e-10`"),
        (Integrator::Adaptive { tolerance: 1e-8 }, 4e5, "tolerance = 1e-14`"),
        (Integrator::Adaptive { tolerance: 1e-8 }, 6e5, "even the smallest, 1e-14, would not do"),
        (Integrator::SemiImplicitEuler, 40.0, "`step = 0.00006`"),
        (Integrator::SemiImplicitEuler, 60.0, "steps of 0.005 s: `integrator = \"adaptive\"` would do"),
    ] {
        scenario.post_impact.as_mut().expect("a phase").integration.integrator = integrator;
        study.cases[0].capture.as_mut().expect("a capture").post_impact.path_error = ratio * 1e-4;
        let [advice] = &step_advice(&scenario, &study)[..] else { panic!("no advice") };
        assert!(advice.starts_with("[post_impact]") && advice.contains(advised), "{advice}");
    }
}
