//! `planar-capture run` with several scenarios, with one from the standard input, and with summaries as its product.

use crate::{command, said};
use assert_cmd::Command;
use planar_proof::file;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// An approach under this name.
fn approach(name: &str) -> String {
    let text = fs::read_to_string(file("scenarios/redysim_single_arm_3r.toml")).expect("a scenario");
    let text = text.replacen("duration = 20.0", "duration = 20.0\nstep = 0.005", 1);
    text.replacen("redysim_single_arm_3r", name, 1)
}

struct Files {
    folder: TempDir,
}

impl Files {
    fn new() -> Self {
        Self { folder: TempDir::new().expect("a folder") }
    }

    fn write(&self, name: &str, text: &str) -> String {
        let path = self.path(name);
        fs::write(&path, text).expect("written");
        path.display().to_string()
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Runs scenarios into the folder `results`.
    fn run(&self, scenarios: &[&str], more: &[&str]) -> (i32, String, String) {
        let out = self.path("results").display().to_string();
        said(&[&["run", "--out", &out], more, scenarios].concat())
    }

    fn has(&self, path: &str) -> bool {
        self.path("results").join(path).exists()
    }
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn summary(folder: &Path) -> Value {
    json(&fs::read_to_string(folder.join("summary.json")).expect("a summary"))
}

#[test]
fn each_scenario_has_its_folder() {
    let files = Files::new();
    let [a, b] = ["a", "b"].map(|name| files.write(&format!("{name}.toml"), &approach(name)));
    let (code, out, err) = files.run(&[&a, &b], &[]);
    assert_eq!(code, 0, "{err}");
    assert!(files.has("a/a.csv") && files.has("b/summary.json") && !files.has("summary.json"));
    assert!(out.contains("a on single_arm_3r") && out.contains("\n\nb on single_arm_3r"), "{out}");
    assert!(err.contains("a: dynamics: generated") && err.contains("b: dynamics: generated"), "{err}");
    let (code, _, err) = files.run(&[&a, &b], &["-q"]);
    assert_eq!((code, err.as_str()), (0, ""), "they replace their own results");
}

/// Nothing is computed where a file is wrong or a folder is occupied, and all that is wrong is said.
#[test]
fn all_scenarios_are_checked_before_the_first_is_computed() {
    let files = Files::new();
    let good = files.write("good.toml", &approach("good"));
    let bad = files.write("bad.toml", &approach("bad").replace("joint_angles", "joint_angle"));
    let worse = files.write("worse.toml", &approach("worse").replace("duration = 20.0", "duration = -0.5"));
    let (code, out, err) = files.run(&[&good, &bad, &worse, "missing.toml"], &[]);
    assert_eq!((code, out.as_str()), (2, ""), "{err}");
    for part in ["bad.toml:", "`initial.joint_angle`", "worse.toml:", "`approach.duration`", "missing.toml"] {
        assert!(err.contains(part), "no {part} in {err}");
    }
    assert!(!files.has("good"));

    fs::create_dir_all(files.path("results/second")).expect("a folder");
    fs::write(files.path("results/second/letter.txt"), "mine").expect("written");
    let second = files.write("second.toml", &approach("second"));
    let (code, out, err) = files.run(&[&good, &second], &[]);
    assert_eq!((code, out.as_str()), (2, ""), "{err}");
    assert!(err.contains("letter.txt") && !files.has("good"), "{err}");

    let twin = files.write("twin.toml", &approach("Good"));
    let (code, _, err) = files.run(&[&good, &twin], &[]);
    assert_eq!(code, 2);
    assert!(err.contains("two scenarios are named `good`"), "{err}");
}

/// A folder that holds one run takes no others beside it, unless they are to replace that.
#[cfg(feature = "figures")] // of which its folder has one
#[test]
fn a_folder_that_holds_one_run_takes_no_others() {
    let files = Files::new();
    let [a, b, c] = ["a", "b", "c"].map(|name| files.write(&format!("{name}.toml"), &approach(name)));
    assert_eq!(files.run(&[&c], &["--figures", "-q"]).0, 0);
    fs::write(files.path("results/notes.txt"), "mine").expect("written");
    let (code, out, err) = files.run(&[&a, &b], &[]);
    assert_eq!((code, out.as_str()), (2, ""), "{err}");
    let said = "results holds the results of `c`, not those of several scenarios, and a folder holds one run";
    assert!(err.contains(said) && err.contains("--force") && !files.has("a"), "{err}");
    assert_eq!(err.lines().count(), 1, "said once: {err}");
    assert!(files.has("c.csv") && files.has("summary.json") && files.has("figures"));

    // nothing is written, and so nothing replaced, where a scenario cannot be read
    let (code, _, err) = files.run(&[&a, "missing.toml"], &["--force"]);
    assert!(code == 2 && files.has("c.csv"), "{err}");

    // no run lists a file that is not in its folder
    let summary = files.path("results/summary.json");
    let text = fs::read_to_string(&summary).expect("a summary").replacen("\"c.csv\"", "\"c.csv\", \"../c.toml\"", 1);
    fs::write(&summary, &text).expect("written");
    let (code, _, err) = files.run(&[&a, &b], &["--force", "-q"]);
    assert_eq!(code, 0, "{err}");
    assert!(text.contains("../c.toml") && files.path("c.toml").exists());
    assert!(files.has("a/summary.json") && files.has("b/b.csv") && files.has("notes.txt"));
    assert!(!files.has("c.csv") && !files.has("summary.json") && !files.has("figures"));
    assert_eq!(files.run(&[&a, &b], &["-q"]).0, 0, "they replace their own results");
}

#[test]
fn the_exit_code_is_the_worst() {
    let files = Files::new();
    let good = files.write("good.toml", &approach("good"));
    // the audit objects
    let poor = files.write("poor.toml", &approach("poor").replace("step = 0.005", "step = 0.2"));
    let (code, out, err) = files.run(&[&poor, &good], &[]);
    assert_eq!(code, 1, "{err}");
    assert!(err.contains("poor: audit: ") && !err.contains("good: audit: "), "{err}");
    assert!(err.contains("over its bound") && err.contains("poor: [approach] is integrated by `rk4`"), "{err}");
    assert!(err.contains("steps of 0.2 s: `integrator = \"adaptive\"` would do\n"), "the motion is lost: {err}");
    assert!(out.contains("good on ") && files.has("good/summary.json") && files.has("poor/summary.json"));
    assert_eq!(files.run(&[&good, &poor], &[]).0, 1);
}

#[test]
fn summaries_are_printed_as_json() {
    let files = Files::new();
    let [a, b] = ["a", "b"].map(|name| files.write(&format!("{name}.toml"), &approach(name)));
    let (code, out, _) = files.run(&[&a], &["--format", "json"]);
    assert_eq!(code, 0);
    let written = fs::read_to_string(files.path("results/summary.json")).expect("a summary");
    assert_eq!(out, written, "byte by byte");
    fs::remove_dir_all(files.path("results")).expect("removed");
    let (code, out, _) = files.run(&[&a, &b], &["--format", "json"]);
    assert_eq!(code, 0);
    let expected = Value::from(["a", "b"].map(|name| summary(&files.path("results").join(name))).to_vec());
    assert_eq!(json(&out), expected);
}

/// The layout is found from the working folder, and the name of the results is the scenario's.
#[test]
fn a_scenario_can_come_from_the_standard_input() {
    let files = Files::new();
    let layout = fs::read_to_string(file("codegen/layouts/single_arm_3r.toml")).expect("a layout");
    files.write("mine.toml", &layout.replace("\"single_arm_3r\"", "\"mine\""));
    let text = approach("piped").replace("\"single_arm_3r\"", "\"./mine.toml\"");
    let run = |text: &str| {
        let mut run = Command::from_std(command());
        let run = run.current_dir(files.folder.path()).args(["run", "-", "-q"]).write_stdin(text.to_owned());
        planar_proof::said(run.output().expect("it runs"))
    };
    let (code, out, err) = run(&text);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.contains("piped on mine"), "{out}");
    let summary = summary(&files.path("results/piped"));
    assert_eq!(summary["run"]["scenario_toml"], *text);
    assert!(summary["run"]["command"].as_str().is_some_and(|command| command.ends_with("run - -q")), "{summary}");
    let (code, _, err) = run(&text.replace("duration", "durations"));
    assert_eq!(code, 2);
    assert!(err.contains("standard input:") && err.contains("did you mean `duration`"), "{err}");
    let (code, _, err) = run("name = \"\u{0}");
    assert_eq!(code, 2);
    assert!(err.contains("standard input"), "{err}");
}

#[test]
fn verbose_runs_say_what_they_read_and_write() {
    let files = Files::new();
    let a = files.write("a.toml", &approach("a"));
    for flag in ["-v", "--verbose"] {
        let (code, out, err) = files.run(&[&a], &[flag]);
        assert_eq!(code, 0, "{err}");
        assert!(!out.contains("sha256"), "{out}");
        let size = fs::metadata(files.path("results/a.csv")).expect("a file").len();
        let size = format!("a.csv: {size} bytes");
        for part in
            ["a.toml, sha256 ", "single_arm_3r.toml (shipped), sha256 ", "approach: 4000 steps", "computed in ", &size]
        {
            assert!(err.contains(part), "no {part} in {err}");
        }
        // of each its own, as in the summary
        let run = &summary(&files.path("results"))["run"];
        for (file, key) in [("a.toml", "scenario_sha256"), ("single_arm_3r.toml (shipped)", "layout_sha256")] {
            let hash = run[key].as_str().expect("a hash");
            assert!(err.contains(&format!("{file}, sha256 {}", &hash[..12])), "{key} {hash} in {err}");
        }
    }
    let (code, _, err) = files.run(&[&a], &["-v", "-q"]);
    assert_eq!(code, 2);
    assert!(err.contains("cannot be used with"), "{err}");
}
