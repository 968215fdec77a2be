//! `generate --derivatives`: generated derivatives against dual numbers, their proof, and their options in commands.

use crate::command;
use crate::generate::{self, LAYOUT, generate, outcome, without_python};
use planar_capture::build::graph;
use planar_capture::build::{command as command_line, options, render_to, verify};
use planar_capture::generate::{GenerateError, prove};
use planar_capture::layout::Layout;
use planar_proof::{file, tolerance};
use serde_json::Value;
use std::fs;
use std::process::Command;

const ALL: [&str; 3] = ["--derivatives", "--directional", "momentum:parameters"];

/// One to three arms (the unseen layout: three, with a wheel and bent links): matrices and directional derivatives of a module, compiled alone, against dual
/// numbers through the functions of the same module.
#[test]
fn generated_derivatives_equal_dual_numbers() {
    if without_python() {
        return;
    }
    let folder = generate::folder();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("main.rs"), include_str!("derivatives/dual_numbers.rs")).expect("written");
    for layout in ["single_arm_3r", "dual_arm_2r", "dual_arm_3r", "held_out.toml"] {
        let (code, _, err) =
            outcome(generate(folder.path(), &[&[layout, "--out", "robot.rs", "--standalone"], &ALL[..]].concat()));
        assert_eq!(code, 0, "{layout}: {err}");
        let text = fs::read_to_string(at("robot.rs")).expect("a module");
        assert!(
            text.contains("--standalone --derivatives --directional momentum:parameters\n"),
            "the header's command"
        );
        let mut compile = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
        compile.args(["--edition", "2024", "-o"]).arg(at("check")).arg(at("main.rs"));
        let (code, _, err) = outcome(compile);
        assert_eq!(code, 0, "{layout}: {err}");
        let mut check = Command::new(at("check"));
        check.arg(format!("{:e}", tolerance::DERIVATIVE));
        let (code, out, err) = outcome(check);
        println!("{layout}: {out}");
        assert_eq!(code, 0, "{layout}: {err}");
    }
}

/// A graph with derivatives is proved with them, rendered without Python, and remembers its options.
#[test]
fn derivatives_are_proved_and_rendered_from_a_graph() {
    if without_python() {
        return;
    }
    let folder = generate::folder();
    let at = |name: &str| folder.path().join(name);
    let arguments = [&["held_out.toml", "--out", "held_out.json"], &ALL[..]].concat();
    let (code, out, err) = outcome(generate(folder.path(), &arguments));
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("results agree with the generic implementation"), "{out}");
    render_to(folder.path(), folder.path()).expect("it is rendered");
    let module = fs::read_to_string(at("held_out.rs")).expect("a module");
    assert!(module.contains("pub fn forward_dynamics_derivatives("));
    fs::write(at("held_out.toml"), generate::other_structure()).expect("written");
    let stale = render_to(folder.path(), folder.path()).expect_err("stale").to_string();
    assert!(stale.contains("--derivatives --directional momentum:parameters"), "{stale}");
    fs::write(at("held_out.toml"), LAYOUT).expect("written");

    // each of the faults below is a proof: of a smaller layout
    let small = file("codegen/layouts/single_arm_2r.toml");
    fs::copy(small, at("single_arm_2r.toml")).expect("copied");
    let arguments = [&["single_arm_2r.toml", "--out", "single_arm_2r.json"], &ALL[..]].concat();
    let (code, _, err) = outcome(generate(folder.path(), &arguments));
    assert_eq!(code, 0, "{err}");
    let layout = Layout::read(&at("single_arm_2r.toml")).expect("a layout");
    let text = fs::read_to_string(at("single_arm_2r.json")).expect("a graph");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    let read = |graph: &Value| graph::read(&graph.to_string(), &layout).unwrap_or_else(|e| panic!("{e}"));
    assert!(prove(&layout, &read(&whole)).is_ok());
    let families = whole["families"].as_array().expect("families");
    for (place, family) in families.iter().enumerate().filter(|(_, family)| family.to_string().contains("derivative")) {
        let text = family.to_string();
        let (mut found, mut tried) = (0, 0);
        let step = text.matches("\"add\",").count() / 12;
        for (position, operation) in text.match_indices("\"add\",").step_by(step) {
            let changed = format!("{}\"sub\",{}", &text[..position], &text[position + operation.len()..]);
            let mut wrong = whole.clone();
            wrong["families"][place] = serde_json::from_str(&changed).expect("JSON");
            tried += 1;
            found += usize::from(matches!(prove(&layout, &read(&wrong)), Err(GenerateError::Disagreement { .. })));
        }
        // some operations go into a smallest pivot alone
        assert!(tried > 10 && found >= tried * 3 / 4, "{}: {found} of {tried} found", family["name"]);
    }
    for (right, wrong, problem) in [
        ("\"by\":[\"contacts\"]", "\"by\":[\"contact\"]", "no input"),
        ("\"by\":[\"contacts\"]", "\"by\":[\"base_pose\"]", "another number of elements"),
        ("\"function\":\"exact_impact\",\"outputs\"", "\"function\":\"impact\",\"outputs\"", "which is no function"),
        ("\"--derivatives\"", "\"--derivatives\\n\"", "is no option"),
    ] {
        let compact = whole.to_string();
        assert!(compact.contains(right), "{right}");
        let error = graph::read(&compact.replace(right, wrong), &layout).err().map(|error| error.to_string());
        assert!(error.as_ref().is_some_and(|error| error.contains(problem)), "{wrong}: {error:?}");
    }
}

/// The benchmark's graph is what its layout gives.
#[test]
fn the_measured_derivatives_are_fresh() {
    if without_python() {
        return;
    }
    let layouts = file("benches/evaluation/layouts");
    let shipped = fs::read_to_string(file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    assert_eq!(fs::read_to_string(layouts.join("dual_arm_3r.toml")).expect("its copy"), shipped);
    let arguments = ["dual_arm_3r", "--out", "dual_arm_3r.json", "--derivatives=forward_dynamics", "--check"];
    let (code, _, err) = outcome(generate(&layouts, &arguments));
    assert_eq!(code, 0, "{err}");
}

/// Without the options a module has none of it.
#[test]
fn derivatives_are_made_where_they_are_asked_for() {
    for (name, _) in planar_capture::registry::SHIPPED {
        let text = fs::read_to_string(file(&format!("codegen/graphs/{name}.json"))).expect("a graph");
        assert!(!text.contains("derivative") && !text.contains("\"options\""), "{name}");
    }
}

#[test]
fn options_are_checked_and_kept() {
    let words = ["--standalone", "--derivatives", "--directional", "momentum,full_impact:parameters"];
    let line = command_line("a b.toml", "a.rs", &words);
    assert_eq!(options(&line), words);
    assert_eq!(options(&command_line::<&str>("a.toml", "a.rs", &[])), [""; 0]);

    let folder = generate::folder();
    let run = |more: &[&str]| {
        let mut command = command();
        command.args(["generate", "held_out.toml", "--out", "robot.rs"]).args(more).current_dir(folder.path());
        outcome(command)
    };
    let (code, _, err) = run(&["--directional", "momentum; rm"]);
    assert!(code == 2 && err.contains("expected names of functions"), "{err}");
    if without_python() {
        return;
    }
    let (code, _, err) =
        outcome(generate(folder.path(), &["held_out.toml", "--out", "robot.rs", "--directional", "momenta"]));
    assert!(
        code == 2
            && err.contains("held_out.toml: --directional: no function `momenta`")
            && err.contains("reduced_dynamics, "),
        "{err}"
    );
    assert!(!folder.path().join("robot.rs").exists());
    // the command that mends a module has its options
    let (code, _, err) =
        outcome(generate(folder.path(), &["held_out.toml", "--out", "robot.rs", "--directional", "momentum"]));
    assert_eq!(code, 0, "{err}");
    fs::write(folder.path().join("held_out.toml"), LAYOUT.replace("33.0", "34.0")).expect("written");
    let stale = verify(folder.path().join("robot.rs"), folder.path().join("held_out.toml")).expect_err("stale");
    assert!(stale.to_string().contains("--directional momentum"), "{stale}");
}
