//! `generate --fmu`: what is written where, with and without a compiler, and refusals. What the FMU computes is tested by
//! `tests/fmu.py` with another importer.

use crate::generate::{folder, generate, outcome, without_python};
use std::fs;
use std::path::Path;

/// Generates the FMU of the folder's layout with a C compiler of this name.
fn written(folder: &Path, out: &str, compiler: &str, options: &[&str]) -> (i32, String, String) {
    let mut command = generate(folder, &[&["held_out.toml", "--fmu", "--out", out][..], options].concat());
    command.env("CC", compiler);
    outcome(command)
}

#[test]
fn an_fmu_without_a_compiler_has_sources_alone_and_always_the_same_bytes() {
    if without_python() {
        return;
    }
    let folder = folder();
    let path = folder.path().join("robot.fmu");
    let (code, out, err) = written(folder.path(), "robot.fmu", "no-such-compiler", &[]);
    assert!(code == 0 && out.contains("9 degrees of freedom, sources only"), "{out}{err}");
    let message = "robot.fmu: no binary, the FMU holds sources only: there is no C compiler `no-such-compiler`";
    assert!(err.contains(message), "{err}");
    let first = fs::read(&path).expect("an FMU");
    let has = |text: &str| first.windows(text.len()).any(|part| part == text.as_bytes());
    for file in
        ["modelDescription.xml", "sources/buildDescription.xml", "sources/held_out.c", "sources/fmi3Functions.h"]
    {
        assert!(has(file), "{file}");
    }
    // the licence of FMI's headers, and a name that XML has to escape
    assert!(has("Redistribution and use in source and binary forms") && has("left &quot;hand&quot;_joint1_angle"));
    assert!(!has("binaries/"), "no binary");
    // over its own file
    assert_eq!(written(folder.path(), "robot.fmu", "no-such-compiler", &[]).0, 0);
    assert!(fs::read(&path).expect("an FMU") == first, "other bytes from the same layout");

    let fresh = (0, "robot.fmu: fresh\n".to_owned(), String::new());
    assert_eq!(written(folder.path(), "robot.fmu", "no-such-compiler", &["--check"]), fresh);
    let mut changed = first.clone();
    let place = first.windows(13).position(|part| part == b"ROBOT_TOKEN \"").expect("a token") + 13;
    changed[place] ^= 1;
    fs::write(&path, &changed).expect("written");
    let (code, _, err) = written(folder.path(), "robot.fmu", "no-such-compiler", &["--check"]);
    let mend = "planar-capture generate held_out.toml --out robot.fmu --fmu";
    assert!(code == 1 && err.contains(mend), "{err}");
    fs::remove_file(&path).expect("removed");
    let (code, _, err) = written(folder.path(), "robot.fmu", "no-such-compiler", &["--check"]);
    assert!(code == 1 && err.contains("does not exist"), "{err}");

    // a compiler that fails; then one that works, where there is one: binaries are not compared
    let (code, out, err) = written(folder.path(), "robot.fmu", "false", &[]);
    assert!(code == 0 && out.contains("sources only") && err.contains("`false` failed: no message"), "{out}{err}");
    assert!(fs::read(&path).expect("an FMU") == first, "other bytes from the same layout");
    if !crate::c::without("cc") {
        let (code, out, err) = written(folder.path(), "robot.fmu", "cc", &[]);
        assert!(code == 0 && out.contains("sources and binaries/") && err.is_empty(), "{out}{err}");
        assert_eq!(written(folder.path(), "robot.fmu", "cc", &["--check"]), fresh);
    }
    let left: Vec<_> =
        fs::read_dir(folder.path()).expect("a folder").map(|entry| entry.expect("one").file_name()).collect();
    assert_eq!(left.len(), 2, "{left:?}");
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
