//! `generate --fmu`: what is written where, with and without a compiler, and refusals. What the FMU computes is tested by
//! `tests/fmu.py` with another importer.

use crate::generate::{folder, generate, outcome, without_python};
use planar_capture::build::graph;
use planar_capture::capture::Silent;
use planar_capture::fmu::{Fmu, Origin};
use planar_capture::layout::Layout;
use planar_capture::output::time_series::Columns;
use planar_capture::registry::{SHIPPED, generated};
use planar_capture::scenario::Scenario;
use planar_proof::file;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// An arm with a name that XML has to escape.
const LAYOUT: &str = r#"
name = "small"
[base]
mass = 210.0
inertia = 33.0
[[arm]]
name = "left \"hand\""
mount = [0.3, 0.0]
[[arm.link]]
length = 0.9
mass = 7.0
inertia = 0.5
"#;

/// Generates the FMU of the folder's layout with a C compiler of this name.
fn written(folder: &Path, compiler: &str, options: &[&str]) -> (i32, String, String) {
    let mut command = generate(folder, &[&["small.toml", "--fmu", "--out", "robot.fmu"][..], options].concat());
    command.env("CC", compiler);
    outcome(command)
}

#[test]
fn an_fmu_without_a_compiler_has_sources_alone_and_always_the_same_bytes() {
    if without_python() {
        return;
    }
    let folder = TempDir::new().expect("a folder");
    let (layout, path) = (folder.path().join("small.toml"), folder.path().join("robot.fmu"));
    fs::write(&layout, LAYOUT).expect("written");
    let (code, out, err) = written(folder.path(), "no-such-compiler", &[]);
    assert!(code == 0 && out.contains("4 degrees of freedom, sources only"), "{out}{err}");
    let message = "robot.fmu: no binary, the FMU holds sources only: there is no C compiler `no-such-compiler`";
    assert!(err.contains(message), "{err}");
    let first = fs::read(&path).expect("an FMU");
    let has = |text: &str| first.windows(text.len()).any(|part| part == text.as_bytes());
    for file in ["modelDescription.xml", "sources/buildDescription.xml", "sources/small.c", "sources/fmi3Functions.h"] {
        assert!(has(file), "{file}");
    }
    // the licence of FMI's headers, and the name of the arm
    assert!(has("Redistribution and use in source and binary forms") && has("left &quot;hand&quot;_joint1_angle"));
    assert!(has("<DefaultExperiment startTime=\"0\" stopTime=\"10\" stepSize=\"0.01\"/>"));
    assert!(!has("binaries/"), "no binary");
    // over its own file, with a compiler that fails
    let (code, out, err) = written(folder.path(), "false", &[]);
    assert!(code == 0 && out.contains("sources only") && err.contains("`false` failed: no message"), "{out}{err}");
    // of several messages the first error
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let elsewhere = TempDir::new().expect("a folder");
        let compiler = elsewhere.path().join("cc.sh");
        let script = "#!/bin/sh\necho 'a.c:1: warning: unused' >&2\necho 'a.c:2: error: missing' >&2\nexit 1\n";
        fs::write(&compiler, script).expect("written");
        fs::set_permissions(&compiler, fs::Permissions::from_mode(0o755)).expect("set");
        let (code, _, err) = written(folder.path(), &compiler.display().to_string(), &[]);
        assert!(code == 0 && err.contains("cc.sh` failed: a.c:2: error: missing\n"), "{err}");
    }
    assert!(fs::read(&path).expect("an FMU") == first, "other bytes from the same layout");

    // binaries are not compared
    let fresh = (0, "robot.fmu: fresh\n".to_owned(), String::new());
    if !crate::c::without("cc") {
        let (code, out, err) = written(folder.path(), "cc", &[]);
        assert!(code == 0 && out.contains("sources and binaries/") && err.is_empty(), "{out}{err}");
    }
    assert_eq!(written(folder.path(), "no-such-compiler", &["--check"]), fresh);
    fs::write(&layout, LAYOUT.replace("210.0", "211.0")).expect("written");
    let (code, _, err) = written(folder.path(), "no-such-compiler", &["--check"]);
    let mend =
        "robot.fmu is not what the layout gives; to mend: planar-capture generate small.toml --out robot.fmu --fmu";
    assert!(code == 1 && err.contains(mend), "{err}");
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2, "the layout and the FMU");
}

/// A robot may be called as a file that every FMU has, and then has files of another name.
#[test]
fn a_layout_may_have_the_name_of_a_file_of_every_fmu() {
    if without_python() || crate::c::without("cc") {
        return;
    }
    for name in ["robot", "instance"] {
        let folder = TempDir::new().expect("a folder");
        fs::write(folder.path().join("small.toml"), LAYOUT.replace("\"small\"", &format!("\"{name}\"")))
            .expect("written");
        let (code, out, err) = written(folder.path(), "cc", &[]);
        assert!(code == 0 && out.contains("sources and binaries/") && err.is_empty(), "{name}: {out}{err}");
        let bytes = fs::read(folder.path().join("robot.fmu")).expect("an FMU");
        let file = format!("sources/{name}_module.c");
        assert!(bytes.windows(file.len()).any(|part| part == file.as_bytes()), "{name}");
        assert_eq!(written(folder.path(), "cc", &["--check"]), (0, "robot.fmu: fresh\n".to_owned(), String::new()));
    }
}

/// The units of the variables in a description, by their names.
fn units(description: &str) -> BTreeMap<String, String> {
    let attribute = |line: &str, name: &str| {
        let (_, rest) = line.split_once(&format!(" {name}=\""))?;
        rest.split_once('"').map(|(value, _)| value.to_owned())
    };
    let variables = description.split("<Float64").skip(1);
    variables.filter_map(|text| Some((attribute(text, "name")?, attribute(text, "unit")?))).collect()
}

/// What an FMU and a time series both have is in the same unit; joules are newton metres, which have the same base units.
#[test]
fn units_are_those_of_the_time_series() {
    let path = file("scenarios/redysim_single_arm_3r.toml");
    let scenario = Scenario::read(&path, SHIPPED).unwrap_or_else(|report| panic!("{report}"));
    let text = fs::read_to_string(file("codegen/graphs/single_arm_3r.json")).expect("a graph");
    let graph = graph::read(&text, &scenario.layout).expect("its graph");
    let sha256 = scenario.layout.sha256();
    let origin = Origin { name: "robot", layout_sha256: &sha256, source: "robot.toml", command: "build" };
    let fmu = Fmu::new(&graph, &origin).expect("an FMU");
    let mut found = units(&String::from_utf8_lossy(&fmu.entries[0].content));
    let model = generated(&scenario.layout).expect("generated code");
    let study = planar_capture::capture::study(&scenario, &|| model.clone_box(), 1.0, &mut Silent).expect("a study");
    let mut both = 0;
    for column in Columns::of(&scenario, &study.cases[0]).list() {
        let Some(unit) = found.remove(&column.name) else {
            assert_eq!(column.name, "joint_work", "a column that an FMU has not");
            continue;
        };
        assert_eq!(unit, if column.unit == "J" { "N m" } else { column.unit }, "{}", column.name);
        both += 1;
    }
    // poses and twists of base and end effector, three numbers of three joints, and momentum and energy
    assert_eq!(both, 12 + 9 + 4);
    assert_eq!(found["time"], "s");
}

/// FMI 3 asks for a start value of every parameter, every input, and all else that is exact at the start, and of nothing
/// that is calculated.
#[test]
fn what_is_exact_at_the_start_has_a_value() {
    let layout = Layout::read(&file("codegen/layouts/single_arm_3r.toml")).expect("a layout");
    let text = fs::read_to_string(file("codegen/graphs/single_arm_3r.json")).expect("a graph");
    let graph = graph::read(&text, &layout).expect("its graph");
    let sha256 = layout.sha256();
    let origin = Origin { name: "robot", layout_sha256: &sha256, source: "robot.toml", command: "build" };
    let fmu = Fmu::new(&graph, &origin).expect("an FMU");
    let description = String::from_utf8_lossy(&fmu.entries[0].content);
    let (mut with, mut without) = (0, 0);
    for variable in description.split("<Float64").skip(1).filter_map(|text| text.split_once('>')) {
        let has = |attribute: &str| variable.0.contains(&format!(" {attribute}"));
        let is_exact = ["causality=\"parameter\"", "causality=\"input\"", "initial=\"exact\""].iter().any(|it| has(it));
        assert_eq!(is_exact, has("start=\""), "{}", variable.0);
        *(if is_exact { &mut with } else { &mut without }) += 1;
    }
    assert!(with > 20 && without > 5, "{with} and {without} variables");
    // the structure of the model has each output once
    let outputs = description.matches("causality=\"output\"").count();
    assert!(outputs > 20 && description.matches("<Output ").count() == outputs, "{outputs} outputs");
}

/// All are refused before anything is derived.
#[test]
fn options_that_an_fmu_has_no_use_for_and_files_that_are_not_its_own_are_refused() {
    let folder = folder();
    // an archive of somebody else, and a text
    fs::write(folder.path().join("foreign.fmu"), b"PK\x05\x06\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0").expect("written");
    fs::write(folder.path().join("text.fmu"), "a diary").expect("written");
    fs::create_dir(folder.path().join("folder.fmu")).expect("made");
    for (arguments, message) in [
        (&["--fmu", "--out", "robot.c"][..], "`--fmu` wants a file that ends in `.fmu`"),
        (&["--fmu", "--out", "robot.zip"], "`.fmu` (the FMU)"),
        (&["--out", "robot.fmu"], "write `--fmu` too"),
        (&["--language", "c", "--out", "robot.fmu"], "write `--fmu` too"),
        (&["--fmu", "--language", "c", "--out", "robot.fmu"], "--language is for modules"),
        (&["--fmu", "--standalone", "--out", "robot.fmu"], "--standalone is for modules"),
        (&["--fmu", "--derivatives", "--out", "robot.fmu"], "an FMU has no derivatives"),
        (&["--fmu", "--out", "foreign.fmu"], "already exists and was not generated"),
        (&["--fmu", "--out", "text.fmu"], "already exists and was not generated"),
        (&["--fmu", "--out", "folder.fmu"], "already exists and was not generated"),
        (&["--fmu", "--out", "none/robot.fmu"], "there is no folder none"),
    ] {
        let (code, _, err) = outcome(generate(folder.path(), &[&["held_out.toml"][..], arguments].concat()));
        assert!(code == 2 && err.contains(message), "{arguments:?}: {code} {err}");
    }
    assert_eq!(fs::read(folder.path().join("text.fmu")).expect("a text"), b"a diary");
    assert!(!folder.path().join("robot.fmu").exists());
}
