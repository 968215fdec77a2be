//! `check` of sweeps: what a scenario with the values that are drawn would be warned of, or refused for.

use planar_capture::check::{CheckReport, inspect};
use planar_capture::registry::SHIPPED;
use planar_proof::file;

/// What is said of a sweep of the scenario for sweeps.
fn of_sweep(varied: &[(&str, &str)]) -> CheckReport {
    let head = "name = \"it\"\nscenario = \"capture.toml\"\ncases = 10\nseed = 1\n".to_owned();
    let keys = varied.iter().map(|(key, values)| format!("[[vary]]\nkey = \"{key}\"\ndistribution = {{ {values} }}\n"));
    let text = head + &keys.collect::<String>();
    inspect(&text, "it.toml", &file("scenarios/sweeps"), SHIPPED)
        .unwrap_or_else(|report| panic!("{report}\nin\n{text}"))
}

const MASS: &str = "target.target1.mass";
const LENGTH: &str = "layout.arm.arm1.link[0].length";
const SPIN: &str = "case.case2.target_twists.target1[0]";

#[test]
fn values_that_are_drawn_and_refused_are_warned_of() {
    for (key, values, expected) in [
        (MASS, "normal = { mean = 40.0, std = 60.0 }", "with `target.target1.mass` at -58.69 kg, below which 5 % of"),
        (LENGTH, "uniform = { min = -0.35, max = 1.5 }", "with `layout.arm.arm1.link[0].length` at -0.2575 m, below"),
        (MASS, "choice = [-1.0, 10.0, 12.0]", "with `target.target1.mass` at -1 kg, one of its values"),
    ] {
        let shown = of_sweep(&[(key, values)]).warnings.to_string();
        assert!(shown.contains("warning: `vary[0].distribution` is {") && shown.contains("it.toml:7:"), "{shown}");
        assert!(shown.contains(expected) && shown.contains("such a case has no result; `min` and `max`"), "{shown}");
    }
}

/// A warning about both ends is one, and the other keys are at their medians.
#[test]
fn unusual_values_that_are_drawn_are_warned_of_once() {
    let mass = (MASS, "normal = { mean = 10.0, std = 1.0 }");
    let quiet = of_sweep(&[mass, (SPIN, "uniform = { min = -0.5, max = 0.5 }")]);
    assert_eq!((quiet.warnings.to_string().as_str(), quiet.warnings.count()), ("", 0));
    let shown = of_sweep(&[mass, (SPIN, "uniform = { min = -30.0, max = 30.0 }")]).warnings;
    assert_eq!(shown.count(), 1, "{shown}");
    for expected in
        ["`vary[1].distribution` is", "target1[0]` at -27 rad/s, below which", "tumbles 4.297 times a second"]
    {
        assert!(shown.to_string().contains(expected), "{expected}: {shown}");
    }
    // what is so at the medians is not said of each key
    let heavy = (MASS, "uniform = { min = 800.0, max = 900.0 }");
    let shown = of_sweep(&[heavy, (SPIN, "uniform = { min = -0.5, max = 0.5 }")]).warnings;
    assert_eq!(shown.count(), 1, "{shown}");
    assert!(
        shown.to_string().contains("with all that varies at its median, `target[0].mass`: heavier than"),
        "{shown}"
    );
}

#[test]
fn warnings_of_many_keys_are_a_few() {
    let wide = "normal = { mean = 10.0, std = 60.0 }";
    let keys: Vec<String> = (1..=2)
        .flat_map(|arm| (0..3).map(move |link| format!("layout.arm.arm{arm}.link[{link}].mass")))
        .chain(["target.target1.mass".to_owned(), "target.target2.mass".to_owned()])
        .collect();
    let varied: Vec<_> = keys.iter().map(|key| (key.as_str(), wide)).collect();
    let shown = of_sweep(&varied).warnings;
    assert_eq!(shown.count(), 6, "{shown}");
    assert!(shown.to_string().contains(" more of this kind"), "{shown}");
}
