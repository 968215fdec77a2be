//! Characters that are not shown, or that reorder what is shown, in the names and texts of layouts, scenarios and graphs.

use planar_build::graph;
use planar_build::{Arithmetic, Module};
use planar_capture::diagnostic::{is_hidden, printable};
use planar_capture::layout::Layout;
use planar_capture::registry;
use planar_capture::scenario::Scenario;
use planar_proof::{file, json, layout};
use serde_json::{Value, json};
use std::fs;

/// Those that rustc refuses in literals and comments, marks and isolates, and others that show nothing.
const HIDDEN: &str = "\u{0}\u{1b}\u{7f}\u{85}\u{9b}\u{ad}\u{61c}\u{200b}\u{200e}\u{200f}\u{2028}\u{202a}\u{202b}\u{202c}\u{202d}\
                      \u{202e}\u{2060}\u{2066}\u{2067}\u{2068}\u{2069}\u{feff}\u{e0041}\u{34f}\u{115f}\u{1160}\u{17b4}\u{3164}\u{fe0f}\u{ffa0}\
                      \u{1d173}\u{e0100}\u{fffe}\u{10ffff}\u{fdd0}";

/// Checks a refusal: file, line, key, and the value, with its hidden character as an escape sequence.
#[track_caller]
fn assert_refused(report: &str, hidden: char, parts: &[&str]) {
    let escaped = hidden.escape_unicode().to_string();
    for part in parts.iter().chain([&escaped.as_str()]) {
        assert!(report.contains(part), "{hidden:?}: no `{part}` in\n{report:?}");
    }
    assert!(!report.contains(|c| c != '\n' && is_hidden(c)), "{report:?}");
}

#[test]
fn names_of_arms_have_none() {
    let text = fs::read_to_string(file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    let line = text.lines().position(|line| line == "name = \"arm1\"").expect("the first arm") + 1;
    for hidden in HIDDEN.chars() {
        for written in [hidden.to_string(), format!("\\U{:08x}", u32::from(hidden))] {
            let is_toml = written.len() > 4 || !hidden.is_ascii();
            let changed = text.replacen("\"arm1\"", &format!("\"ar{written}m\""), 1);
            let report = Layout::parse(&changed, "robot.toml").expect_err("a hidden character").to_string();
            let place = format!("robot.toml:{line}:");
            if written.starts_with('\\') {
                for part in ["`arm[0].name`", &place, &written, "hidden"] {
                    assert!(report.contains(part), "{report}");
                }
            } else if is_toml {
                assert_refused(&report, hidden, &["`arm[0].name`", &place, "without hidden characters"]);
            }
        }
    }
}

#[test]
fn names_and_paths_of_scenarios_have_none() {
    let text = fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
    let parse = |text: &str| Scenario::parse(text, "study.toml", &file("scenarios"), registry::SHIPPED);
    assert!(parse(&text).is_ok());
    for (from, key) in [
        ("name = \"raina_shah_2017\"", "`name`"),
        ("layout = \"dual_arm_3r\"", "`layout`"),
        ("name = \"target1\"", "`target[0].name`"),
        ("name = \"case1\"", "`case[0].name`"),
    ] {
        let line = text.lines().position(|line| line.starts_with(from)).unwrap_or_else(|| panic!("no `{from}`")) + 1;
        for hidden in ['\u{202e}', '\u{2067}', '\u{200f}', '\u{61c}', '\u{9b}', '\u{fffe}', '\u{1ffff}', '\u{fdd0}'] {
            let changed = text.replacen(from, &from.replacen('"', &format!("\"{hidden}"), 1), 1);
            let report = parse(&changed).expect_err("a hidden character").to_string();
            assert_refused(&report, hidden, &[key, &format!("study.toml:{line}:")]);
        }
    }
}

#[test]
fn words_of_other_languages_are_names() {
    for name in ["腕", "bras gauche", "рука", "بازو", "می‌خواهم", "क्षि", "arm–1", "👩‍🚀"]
    {
        assert!(!name.contains(is_hidden), "{name}");
        let mut layout = layout("single_arm_2r");
        name.clone_into(&mut layout.arms[0].name);
        let back = Layout::parse(&layout.to_toml(), "robot.toml").unwrap_or_else(|report| panic!("{report}"));
        assert_eq!((back, printable(name).as_str()), (layout, name));
    }
}

/// The graph of a shipped layout after one change.
fn changed(pointer: &str, value: &Value) -> Result<String, String> {
    let mut graph = json("examples/own_robot/layouts/inspector.json");
    let layout = Layout::read(&file("examples/own_robot/layouts/inspector.toml")).unwrap_or_else(|r| panic!("{r}"));
    *graph.pointer_mut(pointer).unwrap_or_else(|| panic!("no {pointer}")) = value.clone();
    let graph = graph::read(&graph.to_string(), &layout).map_err(|problem| problem.to_string())?;
    Module { standalone: true, item: false, arithmetic: Arithmetic::default(), source: "a", command: "b" }
        .render(&graph)
}

/// Where a graph has text that reaches the module, and whether it is an identifier there.
const TEXTS: [(&str, bool); 19] = [
    ("/casadi", false),
    ("/inputs/0/name", true),
    ("/inputs/2/unit", false),
    ("/inputs/2/description", false),
    ("/parameters/0/name", true),
    ("/parameters/0/unit", false),
    ("/parameters/0/description", false),
    ("/constants/values/0/name", true),
    ("/constants/values/0/unit", false),
    ("/constants/values/0/description", false),
    ("/constants/statements/0/0", true),
    ("/families/0/name", true),
    ("/families/0/description", false),
    ("/families/0/configuration/sections/0/0", false),
    ("/families/0/functions/0/name", true),
    ("/families/0/functions/0/description", false),
    ("/families/0/functions/0/equation", false),
    ("/families/0/functions/0/source", false),
    ("/families/0/functions/0/outputs/0/description", false),
];

#[test]
fn text_of_a_graph_ends_no_comment_and_no_literal() {
    for (pointer, is_name) in TEXTS {
        for hostile in [
            "a\nfn stolen() {}\n//",
            "a\r\n#![feature(no_core)]",
            "a \u{202e}b",
            "```\nfn main() {}",
            "``` fn main() {}",
            "~~~ fn main() {}",
            "    std::process::exit(1)",
        ] {
            let problem = changed(pointer, &json!(hostile)).expect_err(&format!("{pointer}: {hostile:?}"));
            assert!(!problem.contains(is_hidden), "{pointer}: {problem:?}");
        }
        for literal in ["a\", unit: \"b", "a\\"] {
            let problem = changed(pointer, &json!(literal)).err();
            assert!(
                problem.is_some() || !(is_name || pointer.ends_with("unit") || pointer.ends_with("casadi")),
                "{pointer}"
            );
        }
        let names = ["fn", "Self", "T", "a b", "a;", "", "é", "r#fn", "_", "1a", "x".repeat(65).leak()];
        for name in names.into_iter().filter(|_| is_name) {
            let problem = changed(pointer, &json!(name)).expect_err(&format!("{pointer}: {name:?}"));
            assert!(problem.contains(&format!("`{}", name.get(..40).unwrap_or(name))), "{pointer}: {problem}");
        }
    }
}

/// A list in a comment is not broken into lines, of which the second would be no comment.
#[test]
fn long_comments_stay_comments() {
    let text = format!("x ({})", "pub stolen: T, ".repeat(20));
    for (pointer, is_name) in TEXTS.into_iter().filter(|(pointer, _)| !pointer.ends_with("casadi")) {
        if let (false, Ok(module)) = (is_name, changed(pointer, &json!(text))) {
            let code = module.lines().filter(|line| !line.trim_start().starts_with("//"));
            let mut code = code.map(|line| line.split("//").next().unwrap_or_default());
            assert!(!code.any(|line| line.contains("stolen") && !line.contains('"')), "{pointer}");
        }
    }
}

#[test]
fn a_graph_is_sound_or_refused() {
    for (pointer, value, hint) in [
        ("/parameters/0/default", json!(1.5), "the default of `base_mass` is 1.5"),
        ("/parameters/0/quantity", json!("mass_of_base"), "`base_mass` is no parameter of the layout"),
        ("/parameters/1/quantity", json!("base_mass"), "`base_inertia` is no parameter of the layout, or is one twice"),
        ("/parameters/1/name", json!("base_mass"), "two of the parameter `base_mass`"),
        ("/layout/name", json!("other"), "name is \"other\""),
        ("/layout/arms/0/name", json!("other"), "arms is"),
        ("/layout/sha256", json!("0"), "stale"),
        ("/constants/statements/0/2", json!("nothing"), "`nothing` is used, and has no value"),
        ("/constants/statements/0/0", json!("base_mass"), "`base_mass` is assigned, and is another value already"),
        ("/constants/statements/0/0", json!("parameters"), "`parameters` is assigned"),
        ("/constants/statements/0/0", json!(["a", "b"]), "`a`, `b`"),
        ("/constants/statements/0/1", json!("sin_cos"), "SinCos"),
        ("/constants/statements/0/3", json!("joint_angles[0]"), "`joint_angles[0]` is used"),
        ("/families/0/configuration/values/0", json!("nothing"), "`nothing` is read later"),
        ("/families/0/functions/0/inputs/0", json!("nothing"), "no input `base_pose`"),
        ("/families/0/functions/0/outputs", json!([]), "no output"),
        ("/families/0/functions/0/outputs/0/elements/0", json!("joint_angles[99]"), "`joint_angles[99]`"),
        ("/families/0/functions/0/outputs/0/elements/0", json!("joint_torques[6]"), "`joint_torques[6]`"),
        ("/families/6/functions/0/outputs/1/elements/0", json!("contacts[1][2]"), "`contacts[1][2]`"),
        ("/families/6/functions/0/outputs/1/elements/0", json!("contacts[2][1]"), "`contacts[2][1]`"),
        ("/families/0/functions/0/outputs/0/elements/0", json!("joint_angles[+0]"), "`joint_angles[+0]`"),
        ("/families/0/functions/0/outputs/0/elements", json!([]), "has 0 elements"),
        ("/families/0/functions/0/outputs/0/shape", json!([1, 1, 3]), "shape"),
        ("/families/0/functions/0/outputs/0/shape", json!([0]), "shape"),
        ("/families/0/functions/0/outputs/0/shape", json!([u64::MAX, 2]), "shape"),
        ("/families/0/functions/0/operations/mul", json!(u64::MAX), "operations"),
        ("/families/0/functions/0/sections", json!([["b", 4], ["a", 0]]), "sections"),
        ("/families/1/name", json!("forward_dynamics"), "two of the family"),
        ("/families/0/functions/1/name", json!("forward_dynamics"), "two of the function"),
        ("/self_test/0/inputs/0/name", json!("nothing"), "`nothing`"),
        ("/self_test/0/inputs/0/values", json!([1.0]), "`base_pose`"),
        ("/self_test/0/expected/0/function", json!("a\"b"), "there is none"),
        ("/self_test/0/expected/0/output", json!("nothing"), "there is none"),
    ] {
        let problem = changed(pointer, &value).expect_err(pointer);
        assert!(problem.contains(hint), "{pointer} = {value}: no `{hint}` in {problem}");
    }
    // the last elements are there
    for (pointer, last) in [
        ("/families/0/functions/0/outputs/0", "joint_torques[5]"),
        ("/families/6/functions/0/outputs/1", "contacts[1][1]"),
    ] {
        assert!(changed(&format!("{pointer}/elements/0"), &json!(last)).is_ok(), "{last}");
    }
    let mut fewer = json("codegen/graphs/dual_arm_3r.json");
    fewer["parameters"].as_array_mut().expect("parameters").remove(0);
    let problem = graph::read(&fewer.to_string(), &layout("dual_arm_3r")).expect_err("no mass").to_string();
    assert!(problem.contains("base_mass") || problem.contains("BaseMass"), "{problem}");
}

/// Names of files reach the header.
#[test]
fn the_header_of_a_module_is_a_comment() {
    let layout = Layout::read(&file("examples/own_robot/layouts/inspector.toml")).unwrap_or_else(|r| panic!("{r}"));
    let text = json("examples/own_robot/layouts/inspector.json").to_string();
    let graph = graph::read(&text, &layout).expect("a graph");
    let hostile = "a\nfn stolen() {}\u{202e}";
    let module =
        Module { standalone: true, item: false, arithmetic: Arithmetic::default(), source: hostile, command: hostile };
    let module = module.render(&graph).expect("a module");
    assert!(!module.contains(|c| c != '\n' && is_hidden(c)));
    assert!(module.lines().all(|line| !line.contains("stolen") || line.starts_with("//")), "{module:.200}");
}
