//! `generate`: from a user's layout to a module that compiles alone and passes its own test, and its errors.
//!
//! `PLANAR_CAPTURE_NO_PYTHON=1` skips the tests that need Python, with a message.

use crate::command;
use crate::derivation::python;
use planar_capture::build::graph::{self, Graph, GraphError};
use planar_capture::build::{Arithmetic, Module};
use planar_capture::build::{render_to, verify};
use planar_capture::generate::{GenerateError, Proved, complete, prove};
use planar_capture::layout::Layout;
use planar_proof::{file, said};
use serde_json::Value;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// Not shipped: three arms of one, three and two links, bent COMs, a wheel inside an arm.
pub const LAYOUT: &str = r#"
name = "held_out"
[base]
mass = 210.0
inertia = 33.0
[[arm]]
name = "left \"hand\""
mount = [0.3, 0.2]
mount_angle = 0.7
[[arm.link]]
length = 0.9
mass = 7.0
inertia = 0.5
com = [0.4, -0.03]
[[arm]]
name = "long"
mount = [-0.2, 0.3]
[[arm.link]]
length = 0.6
mass = 5.0
inertia = 0.2
[[arm.link]]
length = 0.0
mass = 1.5
inertia = 0.05
[[arm.link]]
length = 0.5
mass = 2.0
inertia = 0.04
com = [0.2, 0.01]
[[arm]]
name = "short"
mount = [0.4, 0.0]
[[arm.link]]
length = 0.7
mass = 4.0
inertia = 0.2
[[arm.link]]
length = 0.3
mass = 1.0
inertia = 0.01
"#;

pub fn without_python() -> bool {
    let without = std::env::var("PLANAR_CAPTURE_NO_PYTHON").is_ok_and(|value| value == "1");
    if without {
        // straight to the stream: what the macros print is shown for failing tests only
        let _ = writeln!(std::io::stderr(), "skipped, for PLANAR_CAPTURE_NO_PYTHON=1: planar-capture generate");
    }
    without
}

/// The folder of the repository's own environments.
pub fn environments() -> String {
    let print = "from codegen import environment; print(environment.home())";
    let output = Command::new(python().expect("Python"))
        .args(["-c", print])
        .current_dir(file(""))
        .output()
        .expect("Python runs");
    String::from_utf8(output.stdout).expect("a path").trim().to_owned()
}

/// The command in a folder, with environments shared with the repository's own.
pub fn generate(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = command();
    command.arg("generate").args(arguments).current_dir(folder);
    command.env("PLANAR_CAPTURE_HOME", file("target/generate"));
    command.env("PLANAR_CAPTURE_ENVIRONMENTS", environments());
    command
}

pub fn folder() -> TempDir {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("held_out.toml"), LAYOUT).expect("written");
    folder
}

pub fn outcome(mut command: Command) -> (i32, String, String) {
    said(command.output().expect("it runs"))
}

const MERGING: &str = r#"
mod robot;
use robot::{ARMS, JOINTS, MANIFEST, Model, ParameterKind, Parameters, Status};

fn main() {
    let (mut robot, before) = (Model::<f64>::default(), Model::<f64>::default());
    let merge = |robot: &mut Model<f64>, masses: [f64; ARMS]| {
        robot.merge(&[0.0; 3], &[0.1; JOINTS], &masses, &[0.5; ARMS], &[[0.2, 0.1]; ARMS])
    };
    let mut masses = [1.0; ARMS];
    masses[ARMS - 1] = f64::NAN;
    assert_eq!(merge(&mut robot, masses), Err(Status::NotFinite));
    assert!(robot == before);
    assert_eq!(merge(&mut robot, [1.0; ARMS]), Ok(()));
    assert!(robot != before);

    // the last link of an arm that holds nothing stays as it is, and one without mass is singular as it is everywhere
    let nothing = |robot: &mut Model<f64>| robot.merge(&[0.0; 3], &[0.1; JOINTS], &[0.0; ARMS], &[0.0; ARMS], &[[f64::NAN; 2]; ARMS]);
    let mut robot = before;
    assert_eq!(nothing(&mut robot), Ok(()));
    assert!(robot == before);
    for kind in [ParameterKind::LinkMass, ParameterKind::LinkInertia] {
        let mut numbers = before.parameters().to_array();
        numbers[MANIFEST.position(kind, ARMS - 1, MANIFEST.links[ARMS - 1] - 1).unwrap()] = 0.0;
        assert_eq!(nothing(&mut Model::new(Parameters::from_array(numbers))), Err(Status::Singular), "{kind:?}");
    }

    // what is wrong with a robot, at every function that says it
    let numbers = before.parameters().to_array();
    for (place, parameter) in MANIFEST.parameters.iter().enumerate() {
        for (number, status) in [(f64::NAN, Status::NotFinite), (f64::INFINITY, Status::NotFinite), (0.0, Status::Singular)] {
            if place > 1 && number == 0.0 {
                continue; // masses and moments of inertia are between lengths
            }
            let mut numbers = numbers;
            numbers[place] = number;
            let mut robot = Model::new(Parameters::from_array(numbers));
            assert_eq!(merge(&mut robot, [1.0; ARMS]), Err(status));
            let step = robot.rk4_step(&[0.0; 3], &[0.1; JOINTS], &[0.0; 3], &[0.1; JOINTS], &[0.0; JOINTS], 0.001);
            // on the length of a last link no motion depends
            let is_end = parameter.kind == ParameterKind::LinkLength && parameter.link + 1 == MANIFEST.links[parameter.arm];
            assert!(step.map(drop) == Err(status) || is_end);
        }
    }
}
"#;

#[test]
fn a_standalone_module_compiles_alone_and_passes_its_own_test() {
    if without_python() {
        return;
    }
    let folder = folder();
    let arguments = ["held_out.toml", "--out", "robot.rs", "--standalone"];
    let mut seeded = generate(folder.path(), &arguments);
    seeded.env("PYTHONHASHSEED", "1");
    let (code, out, err) = outcome(seeded);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("held_out, 9 degrees of freedom") && out.contains("agree"), "{out}");
    let robot = folder.path().join("robot.rs");
    let text = fs::read_to_string(&robot).expect("a module");
    for forbidden in ["unsafe", "std::", "planar_capture", "planar_dynamics", "serde", ".unwrap()", "panic!"] {
        assert!(!text.contains(forbidden), "`{forbidden}` in a standalone module");
    }

    // the same bytes with another hash seed, for --check and for a second file
    let check: Vec<&str> = arguments.into_iter().chain(["--check"]).collect();
    let mut other = generate(folder.path(), &check);
    other.env("PYTHONHASHSEED", "2");
    assert_eq!(outcome(other), (0, "robot.rs: fresh\n".to_owned(), String::new()));

    let binary = folder.path().join("robot_test");
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut compile = Command::new(rustc);
    compile.args(["--edition", "2024", "--test", "-D", "warnings", "-o"]).arg(&binary).arg(&robot);
    let (code, _, err) = outcome(compile);
    assert_eq!(code, 0, "{err}");
    let (code, out, _) = outcome(Command::new(&binary));
    assert!(code == 0 && out.contains("2 passed"), "{out}");

    // a robot that cannot be merged is as before
    let merging = folder.path().join("merging.rs");
    fs::write(&merging, MERGING).expect("written");
    let mut compile = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    compile.args(["--edition", "2024", "-A", "dead_code", "-o"]).arg(&binary).arg(&merging);
    let (code, _, err) = outcome(compile);
    assert_eq!(code, 0, "{err}");
    let (code, _, err) = outcome(Command::new(&binary));
    assert_eq!(code, 0, "{err}");

    // a number that is off by 1e-9, a pivot that says nothing, a manifest that says something else
    let pivot =
        text.lines().find(|line| line.trim_start().starts_with("smallest_pivot: smallest_pivot + ")).expect("a pivot");
    for (right, wrong) in [
        ("base_mass: T::constant(210.0)", "base_mass: T::constant(210.00000021)"),
        (pivot, "smallest_pivot: T::constant(0.5),"),
        ("default: 210.0", "default: 211.0"),
    ] {
        assert!(text.contains(right));
        fs::write(&robot, text.replace(right, wrong)).expect("written");
        let mut compile = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
        compile.args(["--edition", "2024", "--test", "-o"]).arg(&binary).arg(&robot);
        assert_eq!(outcome(compile).0, 0);
        let (code, out, _) = outcome(Command::new(&binary));
        assert!(code != 0 && out.contains("reference_vectors_in_double_precision"), "{wrong}: {out}");
    }

    // a module that was changed, or whose layout was, is found without Python
    let layout = folder.path().join("held_out.toml");
    let gone = verify(folder.path().join("gone.rs"), &layout).expect_err("it is not there").to_string();
    assert!(gone.contains("gone.rs") && gone.contains("to make it: planar-capture generate "), "{gone}");
    let other = verify(&layout, &layout).expect_err("a layout").to_string();
    assert!(other.contains("move it away, then planar-capture generate "), "{other}");
    let message = verify(&robot, &layout).expect_err("it was changed").to_string();
    assert!(message.contains("was changed") && message.contains("--standalone"), "{message}");
    let (code, _, err) = outcome(generate(folder.path(), &check));
    assert!(code == 1 && err.contains("to mend: planar-capture generate held_out.toml --out robot.rs"), "{err}");
    fs::write(&robot, text.replace('\n', "\r\n")).expect("written");
    assert_eq!(verify(&robot, &layout), Ok(()), "line ends are the checkout's");
    fs::write(&robot, &text).expect("written");
    assert_eq!(verify(&robot, &layout), Ok(()));
    fs::write(&layout, LAYOUT.replace("210.0", "211.0")).expect("written");
    let message = verify(&robot, &layout).expect_err("it is of another layout").to_string();
    assert!(message.contains("another layout") && message.contains("planar-capture generate"), "{message}");
}

/// A robot that single precision does not hold is said to be one; its modules are right in double precision.
#[test]
fn a_robot_beyond_single_precision_is_for_double_precision_alone() {
    if without_python() {
        return;
    }
    let folder = folder();
    let lines = LAYOUT.lines().map(|line| match line.strip_prefix("mass = ").or(line.strip_prefix("inertia = ")) {
        Some(_) => format!("{line}e20\n"),
        None => format!("{line}\n"),
    });
    fs::write(folder.path().join("held_out.toml"), lines.collect::<String>()).expect("written");
    let wanted = "warning: single precision does not hold this robot: ";
    let (code, _, err) = outcome(generate(folder.path(), &["held_out.toml", "--standalone", "--out", "robot.rs"]));
    assert!(code == 0 && err.contains(wanted), "{code}: {err}");
    let binary = folder.path().join("robot_test");
    let mut compile = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    compile
        .args(["--edition", "2024", "--test", "-D", "warnings", "-o"])
        .arg(&binary)
        .arg(folder.path().join("robot.rs"));
    let (code, _, err) = outcome(compile);
    assert_eq!(code, 0, "{err}");
    let (code, out, _) = outcome(Command::new(&binary));
    assert!(code == 0 && out.contains("1 passed"), "{out}");
    fs::write(folder.path().join("held_out.toml"), LAYOUT).expect("written");
    let (code, _, err) = outcome(generate(folder.path(), &["held_out.toml", "--out", "other.rs"]));
    assert!(code == 0 && !err.contains(wanted), "{code}: {err}");
}

/// The option is in the module's header, and part of what `--check` compares; the arithmetic of pairs is that of modules which build
/// scripts render, with the same bits.
#[test]
fn pairs_are_for_modules_that_use_the_core() {
    for arguments in [
        &["dual_arm_2r", "--pairs", "--standalone", "--out", "robot.rs"][..],
        &["dual_arm_2r", "--pairs", "--out", "dual_arm_2r.json"],
        &["dual_arm_2r", "--pairs", "--language", "c", "--out", "robot.c"],
        &["dual_arm_2r", "--pairs", "--fmu", "--out", "robot.fmu"],
    ] {
        let folder = folder();
        let (code, out, err) = outcome(generate(folder.path(), arguments));
        assert!(code == 2 && out.is_empty() && err.contains("--pairs is for a module in Rust"), "{arguments:?}: {err}");
        assert!(!folder.path().join(arguments[arguments.len() - 1]).exists(), "{arguments:?}");
    }
    if without_python() {
        return;
    }
    let folder = folder();
    let with = ["dual_arm_2r", "--out", "robot.rs", "--pairs"];
    let (code, _, err) = outcome(generate(folder.path(), &with));
    assert!(code == 0 && !err.contains("in pairs"), "{code}: {err}");
    let text = fs::read_to_string(folder.path().join("robot.rs")).expect("written");
    assert!(text.contains("Pair::new(") && text.contains(" dual_arm_2r --out robot.rs --pairs\n"), "{text:.900}");
    let check = |arguments: &[&str]| outcome(generate(folder.path(), &[arguments, &["--check"]].concat()));
    assert_eq!(check(&with).0, 0);
    let (code, _, err) = check(&with[..3]);
    assert!(code == 1 && err.starts_with("robot.rs is not what the layout gives"), "{err}");
    let (code, _, err) = outcome(generate(folder.path(), &["single_arm_2r", "--out", "alone.rs", "--pairs"]));
    assert!(code == 0 && err.contains("no two arms have as many links"), "{code}: {err}");
}

/// Source and header are written, named in messages, found stale, and not written over what was not generated.
#[test]
fn a_module_in_c_has_a_header() {
    if without_python() {
        return;
    }
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let run = |arguments: &[&str]| outcome(generate(folder.path(), arguments));
    let options = ["--derivatives", "--directional", "momentum,full_impact:parameters"];
    let arguments = [&["held_out.toml", "--language", "c", "--out", "held_out.c"][..], &options].concat();
    let (code, out, err) = run(&arguments);
    assert_eq!(code, 0, "{err}");
    assert!(out.starts_with("held_out.c, held_out.h: held_out, 9 degrees of freedom"), "{out}");
    let [source, header] = ["held_out.c", "held_out.h"].map(|name| fs::read_to_string(at(name)).expect("a file"));
    let command =
        "//     planar-capture generate held_out.toml --out held_out.c --language c --derivatives --directional ";
    assert!(source.contains(command) && header.contains(command), "{source:.400}");
    assert!(source.contains("#include \"held_out.h\"") && header.contains("int held_out_exact_impact_derivatives("));
    let check = [&arguments[..], &["--check"]].concat();
    assert_eq!(run(&check), (0, "held_out.c, held_out.h: fresh\n".to_owned(), String::new()));
    for name in ["held_out.c", "held_out.h"] {
        assert_eq!(verify(at(name), at("held_out.toml")), Ok(()));
    }

    // it compiles, with its derivatives and a name in quotation marks, and passes its own test
    if !crate::c::without("cc") {
        let main = "#include \"held_out.h\"\nint main(void) { return held_out_self_test() == 0 ? 0 : 1; }\n";
        fs::write(at("main.c"), main).expect("written");
        for precision in ["-UNOTHING", "-DHELD_OUT_FLOAT"] {
            let mut compile = Command::new("cc");
            compile.args(["-std=c99", precision, "-o", "main", "main.c", "held_out.c"]).args(crate::c::WARNINGS);
            let (code, _, err) = outcome({
                compile.current_dir(folder.path());
                compile
            });
            assert_eq!(code, 0, "{err}");
            assert_eq!(outcome(Command::new(at("main"))).0, 0, "{precision}");
        }
    }

    let hash = "// sha256 of the text below this header ";
    fs::write(at("held_out.h"), header.replace("#define", "# define")).expect("written");
    let (code, _, err) = run(&check);
    assert!(code == 1 && err.starts_with("held_out.h is not what the layout gives; to mend: "), "{err}");
    let problem = verify(at("held_out.h"), at("held_out.toml")).expect_err("changed").to_string();
    assert!(
        header.contains(hash) && problem.contains("--language c --derivatives --directional momentum"),
        "{problem}"
    );
    fs::remove_file(at("held_out.h")).expect("removed");
    let (code, _, err) = run(&check);
    assert!(code == 1 && err.starts_with("held_out.h does not exist"), "{err}");
    fs::write(at("held_out.h"), "int mine;\n").expect("written");
    let (code, _, err) = run(&arguments);
    assert!(code == 2 && err.contains("held_out.h already exists and was not generated"), "{err}");
    for (arguments, message) in [
        (&["held_out.toml", "--out", "robot.c"][..], "--language c"),
        (&["held_out.toml", "--language", "c", "--out", "robot.rs"], "`.c`"),
        (&["held_out.toml", "--language", "c", "--out", "robot.json"], "`.c`"),
        (&["held_out.toml", "--language", "c", "--out", "robot.c", "--standalone"], "--standalone"),
        (&["held_out.toml", "--language", "c", "--out", "my robot.c"], "cannot be included"),
        (&["held_out.toml", "--language", "fortran", "--out", "robot.c"], "rust, c"),
    ] {
        let (code, out, err) = run(arguments);
        assert!(code == 2 && out.is_empty() && err.contains(message), "{arguments:?}: {err}");
    }
    assert!(!at("robot.c").exists() && !at("my robot.c").exists());
}

#[test]
fn a_user_graph_is_rendered_without_python() {
    if without_python() {
        return;
    }
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let (code, _, err) = outcome(generate(folder.path(), &["held_out.toml", "--out", "held_out.json"]));
    assert_eq!(code, 0, "{err}");
    let out = TempDir::new().expect("a folder");
    let render = || render_to(folder.path(), out.path()).map_err(|e| e.to_string());
    assert_eq!(render(), Ok(()));
    let module = fs::read_to_string(out.path().join("held_out.rs")).expect("a module");
    assert!(module.contains("pub mod held_out {") && module.contains("planar_capture::implement_dynamics!"));

    fs::write(at("held_out.toml"), LAYOUT.replace("33.0", "34.0")).expect("written");
    assert_eq!(render(), Ok(()), "the structure is the same");
    fs::write(at("held_out.toml"), other_structure()).expect("written");
    let stale = render().expect_err("stale");
    assert!(stale.contains("is stale") && stale.contains("planar-capture generate "), "{stale}");
    fs::remove_file(at("held_out.toml")).expect("removed");
    fs::write(at("other.toml"), LAYOUT).expect("written");
    let orphan = render().expect_err("an orphan");
    assert!(orphan.contains("held_out.json has no layout"), "{orphan}");
    fs::rename(at("held_out.json"), at("other.json")).expect("renamed");
    let name = render().expect_err("another name");
    assert!(name.contains("has to be the file's own name, \"other\""), "{name}");
    fs::remove_file(at("other.json")).expect("removed");
    let missing = render().expect_err("no graph");
    assert!(missing.contains("other.json") && missing.contains("generate it again"), "{missing}");
    fs::remove_file(at("other.toml")).expect("removed");
    let empty = render().expect_err("nothing");
    assert!(empty.contains("no layout NAME.toml"), "{empty}");
}

/// [`LAYOUT`] with a number where the derivation had an exact zero.
pub fn other_structure() -> String {
    LAYOUT.replace("[0.4, 0.0]", "[0.4, 0.1]")
}

/// Other numbers and names need no other graph, the module has them; its reference vectors are those of the graph.
#[test]
fn names_and_numbers_are_the_layouts() {
    let (layout, text) = shipped("single_arm_2r");
    let folder = TempDir::new().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let Proved { text, .. } = complete(&text, &layout).unwrap_or_else(|e| panic!("{e}"));
    fs::write(at("mine.json"), text).expect("written");
    let mut mine = Layout { name: "mine".to_owned(), ..layout.clone() };
    let render = |layout: &Layout| {
        fs::write(at("mine.toml"), layout.to_toml()).expect("written");
        render_to(folder.path(), folder.path()).map_err(|e| e.to_string())?;
        Ok::<_, String>(fs::read_to_string(at("mine.rs")).expect("a module"))
    };
    let same = render(&mine).expect("the same numbers");
    assert!(same.contains("pub mod mine {"), "a name alone");
    mine.base.mass = 123.25;
    mine.arms[0].name = "crane".to_owned();
    let module = render(&mine).expect("the same structure");
    assert!(module.contains(&mine.sha256()) && !module.contains(&layout.sha256()));
    assert!(module.contains("default: 123.25 }") && module.contains("of arm 1 (crane)") && !module.contains("(arm1)"));
    assert!(module.contains("crane joint 1") && !module.contains("arm1 joint 1"), "a name of the other layout");
    // the reference vectors stay those of the robot that the graph was derived for
    let reference = format!("parameters: [{:?}, ", layout.base.mass);
    assert!(module.contains(&reference), "no `{reference}`");
    assert_eq!(fs::read_to_string(at("mine.layout")).expect("the layout"), mine.to_toml());
    mine.arms[0].mount[1] = 0.25;
    let stale = render(&mine).expect_err("another structure");
    assert!(stale.contains("is stale") && stale.contains("`arm[0].mount[1]` is 0.25"), "{stale}");
    mine.arms[0].links.pop();
    let stale = render(&mine).expect_err("another structure");
    assert!(stale.contains("other arms or links"), "{stale}");
}

/// A shipped layout with the text of its graph.
pub fn shipped(name: &str) -> (Layout, String) {
    let layout = Layout::read(&file(&format!("codegen/layouts/{name}.toml"))).expect("a layout");
    let text = fs::read_to_string(file(&format!("codegen/graphs/{name}.json"))).expect("a graph");
    (layout, text)
}

fn parsed(text: &str, layout: &Layout) -> Graph {
    graph::read(text, layout).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn every_shipped_graph_is_proved() {
    for (name, _) in planar_capture::registry::SHIPPED {
        let (layout, text) = shipped(name);
        let proof = prove(&layout, &parsed(&text, &layout)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(proof.states == 39 && proof.results == 27, "{proof:?}");
        assert!(proof.worst > 0.0 && proof.worst <= 1.0, "{name}: {} of what is allowed", proof.worst);
    }
}

/// An operation that is changed is found before anything is written, unless it goes into a smallest pivot alone.
#[test]
fn a_wrong_graph_is_not_rendered() {
    let (layout, text) = shipped("dual_arm_2r");
    let graph: Value = serde_json::from_str(&text).expect("JSON");
    let families = graph["families"].as_array().expect("families");
    for (place, family) in families.iter().enumerate() {
        let text = family.to_string();
        let (mut found, mut tried) = (0, 0);
        for (position, operation) in text.match_indices("\"add\",").step_by(17) {
            let changed = format!("{}\"sub\",{}", &text[..position], &text[position + operation.len()..]);
            let mut wrong = graph.clone();
            wrong["families"][place] = serde_json::from_str(&changed).expect("JSON");
            let wrong = parsed(&wrong.to_string(), &layout);
            tried += 1;
            found += usize::from(matches!(prove(&layout, &wrong), Err(GenerateError::Disagreement { .. })));
        }
        let all = if text.contains("smallest_pivot") { tried * 3 / 4 } else { tried };
        assert!(tried > 0 && found >= all, "{}: {found} of {tried} found", family["name"]);
    }
    let mut other = layout.clone();
    other.base.mass += 1.0;
    assert!(matches!(graph::read(&text, &other), Err(GraphError::Stale { .. })));
    assert!(matches!(graph::read("{}", &layout), Err(GraphError::Format(_))));
}

/// Rendered code has the results of a large impact from matrices, in loops: these are proved beside its assignments.
#[test]
fn a_wrong_matrix_of_loops_is_not_rendered() {
    let (layout, text) = shipped("triple_arm_3r");
    let graph: Value = serde_json::from_str(&text).expect("JSON");
    let families = graph["families"].as_array().expect("families").iter().enumerate();
    let mut functions = families.flat_map(|(family, found)| {
        let functions = found["functions"].as_array().expect("functions").iter().enumerate();
        functions.map(move |(index, function)| (family, index, function))
    });
    let (family, index, _) = functions.find(|(.., function)| function["matrices"].is_array()).expect("an impact");
    for (matrix, [one, other]) in [(0, [0, 80]), (0, [1, 9 * 8]), (1, [0, 80]), (1, [9, 18])] {
        let mut wrong = graph.clone();
        let elements = &mut wrong["families"][family]["functions"][index]["matrices"][matrix]["elements"];
        let taken = elements[one].take();
        elements[one] = std::mem::replace(&mut elements[other], taken);
        let found = prove(&layout, &parsed(&wrong.to_string(), &layout));
        let is_found =
            matches!(&found, Err(GenerateError::Disagreement { function, .. }) if function == "reduced_impact");
        assert!(is_found, "{matrix}, {one}, {other}: {found:?}");
    }
}

/// A graph without one of its results, or without a function, is not proved by the rest.
#[test]
fn a_graph_with_a_result_missing_is_not_proved() {
    let (layout, text) = shipped("single_arm_2r");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    let functions =
        |graph: &Value, family: usize| graph["families"][family]["functions"].as_array().map_or(0, Vec::len);
    for family in 0..whole["families"].as_array().expect("families").len() {
        for function in 0..functions(&whole, family) {
            let mut without_result = whole.clone();
            let outputs = without_result["families"][family]["functions"][function]["outputs"].as_array_mut();
            let outputs = outputs.expect("outputs");
            let gone = outputs.remove(0);
            let is_empty = outputs.is_empty();
            if !is_empty && gone["name"] != "smallest_pivot" {
                let found = prove(&layout, &parsed(&without_result.to_string(), &layout));
                assert!(matches!(&found, Err(GenerateError::Graph(_))), "without {gone}: {found:?}");
            }
            let mut without_function = whole.clone();
            without_function["families"][family]["functions"].as_array_mut().expect("functions").remove(function);
            let found = prove(&layout, &parsed(&without_function.to_string(), &layout));
            assert!(matches!(&found, Err(GenerateError::Graph(_))), "without a function: {found:?}");
        }
    }
}

/// The file's name is the module's.
#[test]
fn a_layout_has_the_name_of_its_file() {
    let folder = TempDir::new().expect("a folder");
    for extension in ["toml", "json"] {
        let from = match extension {
            "toml" => file("codegen/layouts/single_arm_2r.toml"),
            _ => file("codegen/graphs/single_arm_2r.json"),
        };
        fs::copy(from, folder.path().join(format!("other.{extension}"))).expect("copied");
    }
    let out = TempDir::new().expect("a folder");
    let name = render_to(folder.path(), out.path()).expect_err("another name").to_string();
    assert!(name.contains("has to be the file's own name, \"other\""), "{name}");
    assert_eq!(fs::read_dir(out.path()).expect("a folder").count(), 0);
}

#[test]
fn a_module_is_the_same_every_time() {
    let (layout, text) = shipped("dual_arm_2r");
    let graph = complete(&text, &layout).unwrap_or_else(|e| panic!("{e}")).graph;
    for [standalone, is_paired] in [[false, false], [true, false], [false, true], [true, true]] {
        let module = Module {
            standalone,
            item: false,
            arithmetic: Arithmetic { is_paired, ..Arithmetic::default() },
            source: "a",
            command: "b",
        };
        let [first, second] = [0, 1].map(|_| module.render(&graph).unwrap_or_else(|e| panic!("{e}")));
        assert!(first == second);
        // of arms in pairs standalone modules have nothing
        assert_eq!([first.contains("Pair::new("), first.contains("Pair<T>")], [is_paired && !standalone; 2]);
        assert!(!first.contains("both!"));
    }
}

/// Paths in messages are quoted as single words of the shell.
#[test]
fn paths_are_single_words() {
    use planar_capture::build::quoted;
    assert_eq!(quoted("layouts/my_robot.toml"), "layouts/my_robot.toml");
    assert_eq!(quoted("lay outs/a.toml"), "'lay outs/a.toml'");
    assert_eq!(quoted("it's"), "'it'\\''s'");
    assert_eq!(quoted(""), "''");
    let folder = TempDir::new().expect("a folder");
    let layouts = folder.path().join("lay outs");
    fs::create_dir(&layouts).expect("a folder");
    fs::write(layouts.join("held_out.toml"), LAYOUT).expect("written");
    let message = render_to(&layouts, folder.path()).expect_err("no graph").to_string();
    assert!(message.contains("lay outs/held_out.toml' --out '"), "{message}");
    assert!(message.contains(" (in "), "{message}");
}

/// Neither a URDF nor a layout overwrites an existing file.
#[test]
fn import_and_export_do_not_overwrite() {
    let folder = folder();
    let run =
        |arguments: &[&str]| said(command().args(arguments).current_dir(folder.path()).output().expect("it runs"));
    assert_eq!(run(&["export", "held_out.toml", "--out", "robot.urdf"]).0, 0);
    let (code, _, err) = run(&["export", "held_out.toml", "--out", "robot.urdf"]);
    assert!(code == 2 && err.contains("robot.urdf already exists"), "{err}");
    let (code, _, err) = run(&["import", "robot.urdf", "--out", "held_out.toml"]);
    assert!(code == 2 && err.contains("held_out.toml already exists"), "{err}");
    assert_eq!(fs::read_to_string(folder.path().join("held_out.toml")).expect("a layout"), LAYOUT);
}

#[test]
fn errors_name_a_remedy_and_write_nothing() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("mine.rs"), "fn main() {}\n").expect("written");
    let wrong = |arguments: &[&str], expected: &[&str]| {
        let (code, out, err) = outcome(generate(folder.path(), arguments));
        assert_eq!((code, out.as_str()), (2, ""), "{err}");
        for text in expected {
            assert!(err.contains(text), "no `{text}` in\n{err}");
        }
    };
    wrong(&["held_out.toml"], &["--out"]);
    wrong(&["held_out.toml", "--out", "robot.txt"], &["robot.txt", "`.rs`", "`.json`"]);
    wrong(&["held_out.toml", "--out", "mine.rs"], &["mine.rs already exists and was not generated"]);
    wrong(&["held_out.toml", "--out", "robot.json", "--standalone"], &["--standalone"]);
    wrong(&["held_out.toml", "--out", "robot.json"], &["robot.json", "held_out.json"]);
    wrong(&["held_out.toml", "--out", "no/such/robot.rs"], &["there is no folder no/such"]);
    wrong(&["held_out.toml", "--out", "/dev/zero.rs/x.rs"], &["there is no folder"]);
    wrong(&["missing.toml", "--out", "robot.rs"], &["there is no file `missing.toml`"]);
    wrong(&["dual_arm_4r", "--out", "robot.rs"], &["did you mean `dual_arm_"]);
    assert_eq!(fs::read_to_string(at("mine.rs")).expect("still there"), "fn main() {}\n");

    let mut none = generate(folder.path(), &["held_out.toml", "--out", "robot.rs"]);
    none.env("PATH", folder.path()).env_remove("PLANAR_CAPTURE_PYTHON");
    let (code, _, err) = outcome(none);
    assert!(code == 2 && err.contains("Python 3.11") && err.contains("PLANAR_CAPTURE_PYTHON"), "{err}");
    let mut missing = generate(folder.path(), &["held_out.toml", "--out", "robot.rs"]);
    missing.env("PLANAR_CAPTURE_PYTHON", "/no/python");
    let (code, _, err) = outcome(missing);
    assert!(code == 2 && err.contains("/no/python"), "{err}");
    let mut home = generate(folder.path(), &["held_out.toml", "--out", "robot.rs"]);
    home.env("PLANAR_CAPTURE_HOME", at("mine.rs"));
    let (code, _, err) = outcome(home);
    assert!(code == 2 && err.contains("PLANAR_CAPTURE_HOME"), "{err}");
    assert!(!at("robot.rs").exists());
}
