//! The tests that generated modules have of themselves.

use crate::generate::shipped;
use planar_capture::build::graph::Graph;
use planar_capture::build::{Arithmetic, Module};
use planar_capture::generate::complete;
use planar_capture::registry::SHIPPED;
use planar_proof::said;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

fn standalone(graph: &Graph) -> String {
    let module = Module { standalone: true, item: false, arithmetic: Arithmetic::default(), source: "a", command: "b" };
    module.render(graph).unwrap_or_else(|e| panic!("{e}"))
}

/// Compiles a source with its tests, and runs them: exit code, standard output, standard error.
fn run_tests(source: &Path, binary: &Path) -> (i32, String, String) {
    let mut compile = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    compile.args(["--edition", "2024", "--test", "--cap-lints", "allow", "-o"]).arg(binary).arg(source);
    let (code, _, err) = said(compile.output().expect("it runs"));
    assert_eq!(code, 0, "{err}");
    said(Command::new(binary).output().expect("it runs"))
}

/// The module of every shipped layout passes its own test alone, in both precisions.
#[test]
fn modules_of_shipped_layouts_pass_their_own_tests_in_both_precisions() {
    let folder = TempDir::new().expect("a folder");
    let mut modules = String::new();
    for (name, _) in SHIPPED {
        let (layout, text) = shipped(name);
        let graph = complete(&text, &layout).unwrap_or_else(|e| panic!("{e}")).graph;
        fs::write(folder.path().join(format!("{name}.rs")), standalone(&graph)).expect("written");
        modules.extend(["mod ", name, ";\n"]);
    }
    let source = folder.path().join("modules.rs");
    fs::write(&source, modules).expect("written");
    let (code, out, _) = run_tests(&source, &folder.path().join("modules"));
    assert!(code == 0 && out.contains(&format!("{} passed", 2 * SHIPPED.len())), "{out}");
}

/// With another sine of `f32`, the test in single precision fails, and no other.
#[test]
fn a_modules_own_test_sees_a_wrong_sine() {
    let (layout, text) = shipped("single_arm_2r");
    let text = standalone(&complete(&text, &layout).unwrap_or_else(|e| panic!("{e}")).graph);
    let (right, wrong) = ("8.332_161e-3", "8.1e-3");
    assert!(text.contains(right));
    let folder = TempDir::new().expect("a folder");
    let source = folder.path().join("robot.rs");
    fs::write(&source, text.replace(right, wrong)).expect("written");
    let (code, out, _) = run_tests(&source, &folder.path().join("robot_test"));
    let says = |precision, result| out.contains(&format!("reference_vectors_in_{precision}_precision ... {result}"));
    assert!(code != 0 && says("single", "FAILED") && says("double", "ok"), "{out}");
}

/// A module whose parameters are not those of its manifest, or that exchanges two of them, fails its own test: one that
/// starts from the defaults would not see it.
#[test]
fn a_modules_own_test_sees_its_parameters() {
    let (layout, text) = shipped("single_arm_2r");
    let graph = complete(&text, &layout).unwrap_or_else(|e| panic!("{e}")).graph;
    let text = standalone(&graph);
    let mass = format!("default: {:?}", layout.base.mass);
    let folder = TempDir::new().expect("a folder");
    let passes = |text: &str| {
        let (source, binary) = (folder.path().join("robot.rs"), folder.path().join("robot_test"));
        fs::write(&source, text).expect("written");
        run_tests(&source, &binary).0 == 0
    };
    assert!(passes(&text));
    for (right, wrong) in [
        (mass.as_str(), "default: 1.5"),
        ("self.base_mass, self.base_inertia", "self.base_inertia, self.base_mass"),
        ("base_mass, base_inertia,", "base_inertia, base_mass,"),
    ] {
        assert!(text.contains(right), "`{right}`");
        assert!(!passes(&text.replacen(right, wrong, 1)), "`{wrong}`");
    }
}
