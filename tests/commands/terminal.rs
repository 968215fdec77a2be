//! What is printed for people: at most 100 columns, no empty one, and nothing of the paper beside another robot.

use crate::said;
use planar_proof::file;
use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use tempfile::TempDir;

/// The most characters of a line.
const WIDTH: usize = 100;

/// The files in a folder of this repository with this extension.
fn files(folder: &str, extension: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(file(folder)).expect("a folder").map(|entry| entry.expect("an entry").path());
    let found: Vec<_> = entries.filter(|path| path.extension().is_some_and(|found| found == extension)).collect();
    assert!(found.len() > 5, "{found:?}");
    found
}

fn assert_narrow(what: &str, text: &str) {
    for line in text.lines() {
        assert!(line.chars().count() <= WIDTH, "{what}: {} characters in\n{line}", line.chars().count());
        assert_eq!(line.trim_end(), line, "{what}: spaces at the end");
    }
}

/// What a run of a scenario prints.
fn printed(scenario: &str) -> String {
    let folder = TempDir::new().expect("a folder");
    let (code, out, err) = said(&["run", scenario, "--quiet", "--out", &folder.path().display().to_string()]);
    assert_eq!((code, err.as_str()), (0, ""), "{scenario}");
    // the last line has the folder's name
    out.lines().filter(|line| !line.starts_with("Results in ")).flat_map(|line| [line, "\n"]).collect()
}

/// A scenario whose motion after the impact is over soon, in a file of its own.
fn shortened(path: &str, folder: &Path) -> String {
    let text = fs::read_to_string(path).expect("a scenario");
    let short = match text.split_once("[post_impact]") {
        Some((head, after)) => {
            let (before, rest) = after.split_once("duration = ").expect("a duration");
            let (_, rest) = rest.split_once('\n').expect("a line");
            format!("{head}[post_impact]{before}duration = 5.0\n{rest}")
        }
        None => text,
    };
    let path = folder.join(Path::new(path).file_name().expect("a name"));
    fs::write(&path, short).expect("written");
    path.display().to_string()
}

#[test]
fn no_line_is_longer_than_100_characters() {
    let scenarios = files("scenarios", "toml");
    let folder = TempDir::new().expect("a folder");
    let folder = folder.path();
    thread::scope(|scope| {
        for half in scenarios.chunks(scenarios.len().div_ceil(2)) {
            scope.spawn(move || {
                for path in half {
                    let path = path.display().to_string();
                    let text = printed(&shortened(&path, folder));
                    assert_narrow(&path, &text);
                    assert!(!text.contains("-0.0000 ") && !text.contains("-0.000000"), "zero has no sign:\n{text}");
                    let (code, out, err) = said(&["check", &path]);
                    assert_eq!((code, err.as_str()), (0, ""), "{path}");
                    assert_narrow(&path, &out);
                }
            });
        }
    });
    for path in files("codegen/layouts", "toml") {
        let path = path.display().to_string();
        assert_narrow(&path, &said(&["check", &path]).1);
    }
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().display().to_string();
    let (_, out, _) = said(&["compare", "asymmetric_wheel", "--samples", "2", "--out", &out]);
    assert!(out.contains("capture.target_twists_after"), "{out}");
    for line in out.lines().filter(|line| !line.starts_with("Worst states in ")) {
        assert_narrow("compare", line);
    }
}

#[test]
fn targets_are_named_and_columns_have_values() {
    let printed = |name: &str| printed(&file(&format!("scenarios/{name}.toml")).display().to_string());
    let row = |text: &str, first: &str| -> Vec<String> {
        let line = text.lines().find(|line| line.trim_start().starts_with(first));
        line.unwrap_or_else(|| panic!("no `{first}` in\n{text}")).split_whitespace().map(str::to_owned).collect()
    };
    let rebound = printed("elastic_rebound");
    assert_eq!(row(&rebound, "case      arm").join(" "), "case arm target kind exact at [s] mean force [N]");
    assert_eq!(row(&rebound, "too_late  arm1")[..4], ["too_late", "arm1", "ball", "bounce"]);
    let panel = printed("large_target");
    assert!(panel.contains("panel: hit\n") && !panel.contains("missed by 0.0000"), "{panel}");
    assert_eq!(row(&panel, "case           arm").join(" "), "case arm target kind exact mean force [N]");
}

/// The column of printed impulses is of the paper's robot, under any name, and of no other.
#[test]
fn nothing_of_the_paper_stands_beside_another_robot() {
    let folder = TempDir::new().expect("a folder");
    let layout = fs::read_to_string(file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    let scenario = fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
    let short = scenario.replace("duration = 50.0", "duration = 0.5");
    for (base, expected) in [("mass = 500.0", true), ("mass = 501.0", false)] {
        let mine = layout.replace("\"dual_arm_3r\"", "\"mine\"").replacen("mass = 500.0", base, 1);
        fs::write(folder.path().join("mine.toml"), mine).expect("written");
        let path = folder.path().join("scenario.toml");
        fs::write(&path, short.replace("\"dual_arm_3r\"", "\"mine.toml\"")).expect("written");
        let text = printed(&path.display().to_string());
        assert!(text.contains("paper eqs."), "{text}");
        for of_the_paper in ["as printed", "Table 5", "0.0873", "0.0131"] {
            assert_eq!(text.contains(of_the_paper), expected, "{base}: {of_the_paper}\n{text}");
        }
    }
}
