//! `new`: a crate of one's own, its files and refusals. `.ci/new` builds one.

use crate::generate::LAYOUT;
use crate::said;
use planar_build::pipeline;
use planar_capture::build::sources;
use planar_capture::capture::{Silent, study};
use planar_capture::engine::Choice;
use planar_capture::layout::Layout;
use planar_capture::own_crate::{Dependency, OwnCrate, check_name, renamed};
use planar_capture::registry::{CompiledRobot, Robots, SHIPPED};
use planar_capture::scenario::Scenario;
use planar_proof::file;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Paths of all files below a folder.
fn files(folder: &Path) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.insert(path);
            }
        }
    }
    found
}

fn new(folder: &Path, options: &[&str]) -> (i32, String, String) {
    said(&[&["new", folder.to_str().expect("UTF-8")], options].concat())
}

/// All that the crate needs is in its folder: no file names another one by an absolute path.
#[test]
fn a_crate_stands_alone() {
    let parent = TempDir::new().expect("a folder");
    let folder = parent.path().join("my_study");
    fs::create_dir(&folder).expect("an empty folder");
    let (code, out, err) = new(&folder, &[]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("the robot `my_study`, 9 degrees of freedom") && out.contains("cargo run"), "{out}");
    assert_eq!(fs::read_dir(parent.path()).expect("a folder").count(), 1, "nothing is left beside it");

    let (all, vendor) = (files(&folder), folder.join("vendor/planar-capture"));
    let own: Vec<_> = all.iter().filter(|path| !path.starts_with(&vendor)).collect();
    let own: Vec<_> =
        own.iter().map(|path| path.strip_prefix(&folder).expect("below").to_str().expect("UTF-8")).collect();
    let wanted = [
        ".gitignore",
        "Cargo.lock",
        "Cargo.toml",
        "README.md",
        "build.rs",
        "layouts/my_study.json",
        "layouts/my_study.toml",
        "scenarios/first.toml",
        "src/law.rs",
        "src/main.rs",
        "src/tests.rs",
    ];
    assert_eq!(own, wanted);
    let here = file("");
    let here = here.to_str().expect("UTF-8").trim_end_matches('/');
    for path in &all {
        let text = fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert!(!text.contains(here), "{}", path.display());
        assert!(path.starts_with(&vendor) || !text.contains("{{"), "{}: left to be filled", path.display());
        let name = path.file_name().expect("a name").to_str().expect("UTF-8");
        assert!(name != "tests.rs" || !path.starts_with(&vendor), "{}: a test", path.display());
    }

    // the sources are those of this workspace, and what its build reads is there
    for source in sources(&file("")).expect("the workspace") {
        let (carried, text) = (vendor.join(&source), fs::read_to_string(file(&source)).expect("text"));
        let found = fs::read_to_string(&carried).unwrap_or_else(|e| panic!("{source}: {e}"));
        assert!(found == text || source.ends_with("Cargo.toml"), "{source}: not as it is here");
    }
    for name in
        ["LICENSE-MIT", "build.rs", "crates/planar-build/templates/module.rs.tera", "src/own_crate/templates/main.txt"]
    {
        assert!(vendor.join(name).is_file(), "{name}");
    }
    for folder in ["src", "crates/planar-build/src", "crates/planar-dynamics/src", "crates/planar-layout/src"] {
        for source in files(&file(folder)) {
            let path = vendor.join(source.strip_prefix(file("")).expect("below"));
            assert!(path.is_file() || source.ends_with("tests.rs"), "{}", source.display());
        }
    }
    for folder in ["codegen/layouts", "codegen/graphs", "codegen/structures"] {
        for (from, to) in files(&file(folder)).into_iter().zip(files(&vendor.join(folder))) {
            assert_eq!(from.file_name(), to.file_name(), "{folder}");
            assert_eq!(fs::read(&from).expect("a file"), fs::read(&to).expect("a file"), "{folder}");
        }
        assert_eq!(files(&file(folder)).len(), files(&vendor.join(folder)).len(), "{folder}");
    }
    for manifest in all.iter().filter(|path| path.ends_with("Cargo.toml") && path.starts_with(&vendor)) {
        let text = fs::read_to_string(manifest).expect("a manifest");
        assert!(!text.contains("planar-proof =") && !text.contains("dev-dependencies"), "{}", manifest.display());
    }
    let out = TempDir::new().expect("a folder");
    pipeline::render_all(&vendor.join("codegen"), out.path(), &|_| true).unwrap_or_else(|e| panic!("{e}"));
    planar_capture::build::render_to(folder.join("layouts"), out.path()).expect("its robot");

    let (code, _, err) = said(&["check", folder.join("layouts/my_study.toml").to_str().expect("UTF-8")]);
    assert_eq!(code, 0, "{err}");
    let (code, _, err) = new(&folder, &[]);
    assert!(code == 2 && err.contains("my_study is not empty: name a folder that is absent or empty"), "{err}");
}

/// The first motion of every robot keeps the audit, whatever its arms.
#[test]
fn first_scenarios_pass_their_audit() {
    for (name, text) in SHIPPED.iter().copied().chain([("held_out", LAYOUT)]) {
        let layout = Layout::parse(text, name).expect("a layout");
        let dependency = Dependency::Version("1".to_owned());
        let parts = OwnCrate { layout: &layout, layout_text: text, graph: "", dependency: &dependency };
        let (_, scenario) = parts.files().into_iter().find(|(path, _)| path == "scenarios/first.toml").expect("there");
        let scenario = scenario.replace(&format!("../layouts/{name}.toml"), name);
        let scenario = Scenario::parse(&scenario, "first.toml", Path::new(""), &[(name, text)]);
        let scenario = scenario.unwrap_or_else(|report| panic!("{name}: {report}"));
        // the first joint of an arm against the others, and every second arm mirrored
        let mut turns = scenario.approach.final_joint_angles.iter().zip(&scenario.initial.joint_angles);
        for (i, arm) in layout.arms.iter().enumerate() {
            let side = if i % 2 == 0 { 1.0 } else { -1.0 };
            for k in 0..arm.links.len() {
                let (end, start) = turns.next().expect("an angle for each joint");
                let expected = side * if k == 0 { -0.3 } else { 0.4 };
                // three digits are written
                assert!((end - start - expected).abs() < 2e-3, "{name}, arm {i}, joint {k}: {start} to {end}");
            }
        }
        let (choice, _) = Choice::fastest(&layout, Robots::SHIPPED);
        let model = choice.model(&layout);
        let study =
            study(&scenario, &|| model.clone_box(), 0.05, &mut Silent).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(study.audit_failures(), Vec::<String>::new(), "{name}");
    }
}

#[test]
fn other_sources_of_the_dependency() {
    let parent = TempDir::new().expect("a folder");
    let manifest = |name: &str, options: &[&str]| {
        let folder = parent.path().join(name);
        let (code, _, err) = new(&folder, options);
        assert_eq!(code, 0, "{err}");
        assert!(!folder.join("vendor").exists() && !folder.join("Cargo.lock").exists(), "{name}");
        fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest")
    };
    let git = manifest("of_git", &["--git", "https://example.org/\"a\""]);
    assert_eq!(git.matches(r#"planar-capture = { git = 'https://example.org/"a"', "#).count(), 2, "{git}");
    let version = manifest("of_version", &["--version", "0.1", "--layout", "single_arm_3r"]);
    assert_eq!(version.matches(r#"planar-capture = { version = "0.1", default-features = false, "#).count(), 2);
    let here = file("");
    let path = manifest("of_path", &["--path", here.to_str().expect("UTF-8")]);
    assert!(path.contains(here.to_str().expect("UTF-8").trim_end_matches('/')), "{path}");

    // relative to where the command runs, in the manifest relative to the crate
    let mut command = crate::command();
    command.current_dir(file("src")).args(["new", "--path", "..", "--name", "relative"]);
    let folder = parent.path().join("below/relative");
    let (code, _, err) = planar_proof::said(command.arg(&folder).output().expect("it runs"));
    assert_eq!(code, 0, "{err}");
    let text = fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
    let start = text.find("path = \"").expect("a path") + "path = \"".len();
    let path = &text[start..start + text[start..].find('"').expect("its end")];
    assert!(path.starts_with("../"), "{path}");
    assert_eq!(folder.join(path).canonicalize().expect("a folder"), file("").canonicalize().expect("a folder"));
}

/// Each says what would be right, and leaves nothing.
#[test]
fn refusals() {
    let parent = TempDir::new().expect("a folder");
    let at = |name: &str| parent.path().join(name);
    for (folder, options, message) in [
        ("My-Study", &[][..], "`--name my_study` would do"),
        ("loop", &[], "`--name loop_robot` would do"),
        ("_arm_", &[], "`--name arm` would do"),
        ("test", &[], "`--name test_robot` would do"),
        ("2r", &[], "`--name robot_2r` would do"),
        ("study", &["--name", "böse"], "no name for a crate"),
        ("study", &["--layout", "dual_arm_4r"], "did you mean `dual_arm_3r`?"),
        ("study", &["--layout", "none.toml"], "none.toml"),
        ("study", &["--path", "nowhere"], "--path nowhere: there is no Cargo.toml of planar-capture"),
        ("study", &["--git", "a", "--version", "1"], "cannot be used with"),
    ] {
        let (code, out, err) = new(&at(folder), options);
        assert!(code == 2 && out.is_empty() && err.contains(message), "{folder} {options:?}: {code} {err}");
        assert_eq!(fs::read_dir(parent.path()).expect("a folder").count(), 0, "{folder} {options:?}");
    }
    fs::write(at("file"), "kept").expect("written");
    let (code, _, err) = new(&at("file"), &[]);
    assert!(code == 2 && err.contains("is not a folder"), "{err}");
    let (code, _, err) = new(&at("file/below"), &[]);
    assert!(code == 2 && err.contains("is not a folder"), "{err}");
    assert_eq!(fs::read_to_string(at("file")).expect("there"), "kept");
    for name in ["planar_capture", "std", "mod", "", "_", "a b"] {
        assert!(check_name(name).is_err(), "{name}");
    }
    assert_eq!(check_name("my_study_2"), Ok(()));
}

/// Comments stay; other keys `name` are others' names.
#[test]
fn a_layout_is_renamed_in_its_text() {
    let text = format!("# of mine\n{}", LAYOUT.replace("\"short\"", "\"held_out\""));
    let layout = Layout::parse(&text, "a").expect("a layout");
    let found = renamed(&text, &layout, "other");
    assert_eq!(found, text.replacen("\"held_out\"", "\"other\"", 1));
    // written in another way
    let quoted = text.replacen("\"held_out\"", "'held_out'", 1);
    let found = Layout::parse(&renamed(&quoted, &layout, "other"), "a").expect("a layout");
    assert_eq!(found, Layout { name: "other".to_owned(), ..layout });
}

/// A graph holds for all numbers of its structure: none is derived.
#[test]
fn a_robot_of_a_shipped_structure_needs_no_python() {
    let parent = TempDir::new().expect("a folder");
    let (_, text) = SHIPPED.iter().find(|(name, _)| *name == "single_arm_2r").expect("shipped");
    let layout = Layout::parse(text, "it").expect("a layout");
    let mut heavy = Layout { name: "heavy".to_owned(), ..layout };
    heavy.base.mass *= 2.0;
    let source = parent.path().join("heavy.toml");
    fs::write(&source, heavy.to_toml()).expect("written");
    let folder = parent.path().join("mine");
    let mut command = crate::command();
    command.env("PATH", "").args(["new", "--layout"]).arg(&source).arg(&folder);
    let (code, _, err) = planar_proof::said(command.output().expect("it runs"));
    assert_eq!(code, 0, "{err}");
    let layout = Layout::read(&folder.join("layouts/mine.toml")).expect("a layout");
    assert_eq!(layout, Layout { name: "mine".to_owned(), ..heavy });
    planar_capture::build::render_to(folder.join("layouts"), parent.path()).expect("it is rendered");
}

/// A program's own robots are known by their names, and their code comes first.
#[test]
fn own_robots_are_found() {
    let text = SHIPPED[0].1.replacen("name = \"", "name = \"own_", 1);
    let name = format!("own_{}", SHIPPED[0].0);
    let layout = Layout::parse(&text, "own").expect("a layout");
    let (name, text): (&'static str, &'static str) = (name.leak(), text.leak());
    let code = Robots::SHIPPED.code(&layout).expect("its structure");
    let own = [CompiledRobot { name, layout: text, code }];
    let robots = Robots::with(&own);
    assert_eq!(robots.layouts()[0], (name, text));
    assert_eq!(robots.layouts().len(), SHIPPED.len() + 1);
    assert_eq!(Robots::SHIPPED.layouts(), SHIPPED);
    let scenario = Scenario::parse(
        &format!(
            "name = \"it\"\nlayout = \"{name}\"\n[initial]\njoint_angles = {0:?}\n[approach]\nduration = 1.0\n\
             trajectory = \"cycloidal\"\nfinal_joint_angles = {0:?}\n",
            vec![0.5; layout.joints()]
        ),
        "it.toml",
        Path::new(""),
        &robots.layouts(),
    );
    assert_eq!(scenario.expect("a scenario").layout, layout);
    let mut other = code;
    // what tells it from the shipped one
    let manifest = Box::leak(Box::new(planar_capture::manifest::Manifest { name: "own code", ..*code.manifest }));
    other.manifest = manifest;
    let own = [CompiledRobot { name, layout: text, code: other }];
    let choice = Choice::generated(&layout, Robots::with(&own)).expect("its code");
    assert_eq!(choice.origin, "compiled code of `own code`");
    let (choice, _) = Choice::fastest(&layout, Robots::with(&own));
    assert_eq!(choice.origin, "compiled code of `own code`");
}
