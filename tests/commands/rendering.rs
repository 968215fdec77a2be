//! From graph to Rust: reproducible text, operation counts, and errors that stop the build.

use planar_build::{Arithmetic, pipeline};
use planar_capture::{diagnostic, layout};
use planar_proof::file;
use std::fs;
use std::path::Path;

fn layouts() -> Vec<String> {
    let names = planar_capture::registry::SHIPPED.iter().map(|(name, _)| (*name).to_owned()).collect::<Vec<_>>();
    assert!(names.len() >= 7);
    names
}

fn rendered(name: &str, arithmetic: Arithmetic) -> String {
    pipeline::render_one(&file("codegen"), name, arithmetic).unwrap_or_else(|e| panic!("{e}"))
}

/// Without pairs: one statement per operation.
fn plain(name: &str) -> String {
    rendered(name, Arithmetic::default())
}

/// The library was compiled from the code rendered from the committed graph.
#[test]
fn built_code_is_the_committed_graphs() {
    for name in layouts() {
        let built = fs::read_to_string(Path::new(env!("OUT_DIR")).join(format!("{name}.rs"))).expect("built code");
        let arithmetic = Arithmetic { is_fused: cfg!(feature = "fused"), ..pipeline::arithmetic() };
        assert!(built == rendered(&name, arithmetic), "{name}: cargo build again");
        assert!(built == rendered(&name, arithmetic), "{name}: the same graph renders to another text");
        assert!(built.starts_with(&format!("// @generated from codegen/graphs/{name}.json")), "no header");
        assert!(built.contains(&format!("python -m codegen {name}")), "the header names its command");
        for forbidden in ["unsafe", "alloc::", "std::", ".unwrap()", ".expect(", "panic!", ".get("] {
            assert!(!built.contains(forbidden), "{name}: `{forbidden}` in generated code");
        }
    }
}

/// The body of a function of the rendered text, from its name to the end of its block.
fn body<'a>(text: &'a str, signature: &str) -> &'a str {
    let start = text.find(signature).unwrap_or_else(|| panic!("no `{signature}`"));
    let rest = &text[start..];
    &rest[..rest.find("\n        }\n").expect("an end")]
}

/// Binary operations of a body, counted in the rendered text.
fn operations(body: &str) -> usize {
    let binary = |line: &str| [" + ", " - ", " * ", " / "].iter().map(|op| line.matches(op).count()).sum::<usize>();
    body.lines().filter(|line| !line.trim_start().starts_with("//")).map(binary).sum()
}

/// The targets for the paper's robot, counted in the rendered text.
#[test]
fn paper_robot_is_within_its_operation_targets() {
    let text = plain("dual_arm_3r");
    let staged = |family: &str| operations(body(&text, &format!("pub fn {family}_configuration(")));
    let pairs = |family: &str| {
        let text = body(&text, &format!("pub fn {family}_configuration("));
        let batches = ["sin_cos_all([", "sin_cos_of_sums(["];
        let (_, batch) = batches.iter().find_map(|batch| text.split_once(batch)).expect("a batch");
        let (angles, _) = batch.split_once("], [").or(batch.split_once("])")).expect("its end");
        angles.split(", ").count()
    };
    let call = |family: &str, function: &str| {
        let methods = text.find(&format!("impl<T: Scalar> {family}Configuration<'_, T>")).expect("methods");
        // without that by which the pivot shows singular parameters
        operations(body(&text[methods..], &format!("fn {function}_with_pivot<"))) - 1
    };
    let forward = staged("forward_dynamics");
    assert_eq!(pairs("forward_dynamics"), 7);
    for (function, most, least) in [
        ("forward_dynamics", 341, 250),
        ("forward_dynamics_with_base_wrench", 352, 260),
        ("forward_dynamics_with_wrenches", 410, 300),
    ] {
        let total = forward + call("ForwardDynamics", function);
        assert!((least..=most).contains(&total), "{function}: {total} operations, at most {most} are wanted");
        let row = text.lines().find_map(|line| line.trim().strip_prefix(&format!("//! | [`Model::{function}`] | ")));
        let counts =
            row.expect("a row of the table").split(" | ").take(3).map(|count| count.parse::<usize>().expect("a count"));
        assert_eq!(counts.sum::<usize>(), total, "{function}: the table and the text");
    }
    let reduced = staged("reduced_dynamics") + call("ReducedDynamics", "reduced_dynamics");
    assert!((400..=560).contains(&reduced), "reduced dynamics: {reduced} operations");
    assert_eq!(pairs("reduced_dynamics"), 7);
}

/// Scopes inside each other, one per `let` of a block, exhaust the compiler's stack when they are thousands.
#[test]
fn no_block_is_too_long_for_a_compiler_that_describes_its_variables() {
    let mut longest = 0;
    for name in layouts() {
        let mut open = vec![0];
        for line in plain(&name).lines().map(str::trim) {
            if line.starts_with("let ") {
                *open.last_mut().expect("a block") += 1;
            }
            if line.starts_with('}') {
                open.pop();
            }
            if line.ends_with('{') {
                open.push(0);
            }
            longest = longest.max(open.iter().sum());
        }
    }
    assert!((250..=310).contains(&longest), "{longest} variables in scope");
}

/// Documentation stands in one column with what it documents, and ends with text.
#[test]
fn documentation_is_indented_like_its_item() {
    let column = |line: &str| line.len() - line.trim_start().len();
    let is_doc = |line: &str| line.trim_start().starts_with("///");
    for name in layouts() {
        let text = plain(&name);
        for (line, next) in text.lines().zip(text.lines().skip(1)).filter(|(line, _)| is_doc(line)) {
            assert_eq!(column(line), column(next), "{name}:\n{line}\n{next}");
            assert!(is_doc(next) || line.trim() != "///", "{name}: an empty line before\n{next}");
        }
    }
}

/// A copy of `codegen/` in which something is wrong.
fn broken(change: impl Fn(&Path)) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    for part in ["layouts", "graphs"] {
        fs::create_dir(folder.path().join(part)).expect("a folder");
        for entry in fs::read_dir(file("codegen").join(part)).expect("a folder") {
            let path = entry.expect("an entry").path();
            fs::copy(&path, folder.path().join(part).join(path.file_name().expect("a name"))).expect("a copy");
        }
    }
    change(folder.path());
    let out = tempfile::tempdir().expect("a folder");
    pipeline::render_all(folder.path(), out.path(), &|_| true).expect_err("this does not build")
}

fn edit(path: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(path).expect("a file");
    assert!(text.contains(from));
    fs::write(path, text.replacen(from, to, 1)).expect("written");
}

#[test]
fn build_errors_name_a_remedy() {
    let mend = "python -m codegen dual_arm_3r";
    let stale = broken(|dir| edit(&dir.join("layouts/dual_arm_3r.toml"), "mass = 10.0", "mass = 11.0"));
    assert!(stale.contains("is stale") && stale.contains(mend), "{stale}");
    let missing = broken(|dir| fs::remove_file(dir.join("graphs/dual_arm_3r.json")).expect("removed"));
    assert!(missing.contains("dual_arm_3r.json") && missing.contains(mend), "{missing}");
    let orphan = broken(|dir| fs::remove_file(dir.join("layouts/dual_arm_3r.toml")).expect("removed"));
    assert!(orphan.contains("has no layout"), "{orphan}");
    let cut = broken(|dir| fs::write(dir.join("graphs/dual_arm_3r.json"), "{\"format\": 3").expect("written"));
    assert!(cut.contains("not JSON") && cut.contains(mend), "{cut}");
    let older = broken(|dir| edit(&dir.join("graphs/dual_arm_3r.json"), "\"format\": 3", "\"format\": 1"));
    assert!(older.contains("it has format 1, this version reads format 3; generate it again"), "{older}");
    assert!(older.contains(mend), "{older}");
    let unknown = broken(|dir| edit(&dir.join("graphs/dual_arm_3r.json"), "\"mul\", ", "\"mull\", "));
    assert!(unknown.contains("`mull`") && unknown.contains(mend), "{unknown}");
    let layout = broken(|dir| edit(&dir.join("layouts/dual_arm_3r.toml"), "inertia", "inertai"));
    assert!(layout.contains("did you mean `inertia`"), "{layout}");
}

/// A graph with the layout's hash, names and numbers, and another equation.
#[test]
fn a_graph_is_proved_before_it_is_rendered() {
    let wrong = broken(|dir| edit(&dir.join("graphs/single_arm_2r.json"), "\"sub\", ", "\"add\", "));
    assert!(wrong.contains("single_arm_2r.json") && wrong.contains("disagree"), "{wrong}");
}

/// A comment, or a default written out, makes nothing stale.
#[test]
fn a_comment_makes_nothing_stale() {
    let path = file("codegen/layouts/dual_arm_3r.toml");
    let text = fs::read_to_string(&path).expect("a layout");
    let hash = |text: &str| layout::Layout::parse(text, "test").map(|layout| layout.sha256()).expect("a layout");
    let commented = format!("# a remark\n{}", text.replace("mass = 500.0", "mass = 500 # the base"));
    assert_eq!(hash(&text), hash(&commented));
    assert_ne!(hash(&text), hash(&text.replace("500.0", "501.0")));
    assert!(diagnostic::nearest("inertai", ["mass", "inertia"]) == Some("inertia"));
}
