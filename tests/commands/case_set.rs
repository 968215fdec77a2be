//! Cases with values of their own, `set`: the bits of a scenario with these values, files, refusals.

use crate::said;
use planar_proof::file;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

const SET: &str = r#"set = { "layout.base.mass" = 480.0, "approach.duration" = 12.0, "target.target1.mass" = 12.5 }"#;

/// The paper's scenario, with a short motion afterwards.
fn scenario() -> String {
    let text = fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
    text.replace("duration = 50.0", "duration = 1.0")
}

/// Its second case with values of its own.
fn with_set() -> String {
    scenario().replace("name = \"case2\"\n", &format!("name = \"heavy\"\n{SET}\n"))
}

struct Place(TempDir);

impl Place {
    fn new() -> Self {
        Self(TempDir::new().expect("a folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) -> String {
        fs::write(self.path(name), text).expect("written");
        self.path(name).display().to_string()
    }

    /// Runs a scenario into a folder, and returns its summary.
    fn run(&self, scenario: &str, out: &str, more: &[&str]) -> Value {
        let path = self.path(out).display().to_string();
        let (code, _, err) = said(&[&["run", scenario, "--out", &path, "-q"], more].concat());
        assert_eq!(code, 0, "{err}");
        let text = fs::read_to_string(self.path(out).join("summary.json")).expect("a summary");
        serde_json::from_str(&text).expect("JSON")
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<_> = entries.map(|name| name.into_string().expect("UTF-8")).collect();
    names.sort();
    names
}

#[test]
fn a_case_with_values_has_the_bits_of_a_scenario_with_them() {
    let place = Place::new();
    let layout = fs::read_to_string(file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    place.write("changed_layout.toml", &layout.replace("mass = 500.0", "mass = 480.0"));
    let set = place.write("set.toml", &with_set());
    let by_hand = scenario().replace("\"case2\"", "\"heavy\"").replace("\"dual_arm_3r\"", "\"./changed_layout.toml\"");
    let by_hand = by_hand.replace("duration = 20.0", "duration = 12.0").replacen("mass = 10.0", "mass = 12.5", 1);
    let by_hand = place.write("by_hand.toml", &by_hand);
    let common = place.write("common.toml", &scenario());

    let found = place.run(&set, "set", &[]);
    let [wanted, others] = [(&by_hand, "by_hand"), (&common, "common")].map(|(file, out)| place.run(file, out, &[]));
    let bytes = |out: &str, name: &str| fs::read(place.path(out).join(name)).expect("a file");
    assert_eq!(bytes("set", "heavy.csv"), bytes("by_hand", "heavy.csv"));
    let mut own = found["cases"][1].clone();
    let [values, run] = ["set", "run"].map(|key| own.as_object_mut().and_then(|own| own.remove(key)).expect(key));
    assert_eq!(own, wanted["cases"][1]);
    assert_eq!(values.to_string(), r#"{"approach.duration":12.0,"layout.base.mass":480.0,"target.target1.mass":12.5}"#);
    assert_eq!(run["layout_sha256"], wanted["layout"]["sha256"]);
    assert_eq!((&run["dynamics"], &run["steps"]["approach"]), (&"generated".into(), &2400.into()));
    // the others are as without it
    for (i, name) in [(0, "case1"), (2, "case3")] {
        assert_eq!(found["cases"][i], others["cases"][i], "{name}");
        let csv = format!("{name}.csv");
        assert_eq!(bytes("set", &csv), bytes("common", &csv));
    }
    assert_eq!(found["layout"], others["layout"]);
}

#[test]
fn files_have_the_name_of_the_case() {
    let place = Place::new();
    let set = place.write("set.toml", &with_set());
    let common = ["case1.csv", "case3.csv"];
    let mut flags = vec!["--report"];
    if cfg!(feature = "figures") {
        flags.push("--figures=approach_base");
    }
    place.run(&set, "out", &flags);
    let found = names(&place.path("out"));
    let wanted = [&common[..], &["heavy.csv", "report.html", "summary.json"]].concat();
    assert_eq!(found.iter().filter(|name| *name != "figures").collect::<Vec<_>>(), wanted);
    if cfg!(feature = "figures") {
        assert_eq!(names(&place.path("out/figures")).last().map(String::as_str), Some("heavy"));
        assert!(place.path("out/figures/heavy/approach_base.svg").is_file());
    }
    // they are of the run, which the next one replaces
    place.run(&set, "out", &[]);
    assert_eq!(names(&place.path("out")), [&common[..], &["heavy.csv", "summary.json"]].concat());
}

/// The data of the report in a folder.
fn report_data(folder: &Path) -> Value {
    let page = fs::read_to_string(folder.join("report.html")).expect("a report");
    let (_, rest) = page.split_once("id=\"data\">").expect("data");
    serde_json::from_str(rest.split_once("</script>").expect("an end").0).expect("JSON")
}

/// One report has all cases in the order of the file, each with robot, targets, approach and audit of its own part.
#[test]
fn the_report_has_all_cases() {
    let place = Place::new();
    let heavier = SET.replace("12.5 }", "12.5, \"target.target2.radius\" = 0.3 }");
    let summary = place.run(&place.write("set.toml", &with_set().replace(SET, &heavier)), "out", &["--report"]);
    let data = report_data(&place.path("out"));
    let cases = data["cases"].as_array().expect("cases");
    assert_eq!(cases.iter().map(|case| &case["name"]).collect::<Vec<_>>(), ["case1", "heavy", "case3"]);
    assert_eq!(cases.iter().map(|case| &case["part"]).collect::<Vec<_>>(), [0, 1, 0]);
    let said =
        "approach.duration = 12.0, layout.base.mass = 480.0, target.target1.mass = 12.5, target.target2.radius = 0.3";
    assert_eq!(cases[1]["set"], said);
    assert!(cases[0]["set"].is_null() && cases[2]["set"].is_null());
    let parts = data["parts"].as_array().expect("parts");
    let of = |path: &str| parts.iter().map(|part| part.pointer(path).expect(path).clone()).collect::<Vec<_>>();
    assert_eq!(of("/layout/base/mass"), [500.0, 480.0]);
    assert_eq!(of("/targets/0/mass"), [10.0, 12.5]);
    assert_eq!(of("/targets/1/radius")[1], 0.3);
    assert_eq!(of("/approach/duration"), [20.0, 12.0]);
    assert_eq!(of("/run/layout_sha256")[1], summary["cases"][1]["run"]["layout_sha256"]);
    assert!(of("/run/layout_toml")[1].as_str().is_some_and(|text| text.contains("480.0")));
    // its motion is that of its own study
    assert_eq!(cases[1]["impacts"][0]["exact"], summary["cases"][1]["impact"]["exact"]);
}

/// `-v` says of each case with values of its own what it is computed of, and nothing of others that are not computed.
#[test]
fn verbose_runs_say_what_a_case_of_its_own_is_computed_of() {
    let place = Place::new();
    let (set, out) = (place.write("set.toml", &with_set()), place.path("out").display().to_string());
    for (chosen, of_others) in [(&["--case", "heavy"][..], false), (&[], true)] {
        let (code, _, err) = said(&[&["run", &set, "--out", &out, "-v"], chosen].concat());
        assert_eq!(code, 0, "{err}");
        let text = fs::read_to_string(place.path("out").join("summary.json")).expect("a summary");
        let summary: Value = serde_json::from_str(&text).expect("JSON");
        let own = summary["cases"].as_array().expect("cases").iter().find(|case| case["name"] == "heavy").expect("it");
        let hash = &own["run"]["layout_sha256"].as_str().expect("a hash")[..12];
        let of_it: Vec<_> = err.lines().filter(|line| line.contains("case `heavy`: ")).collect();
        assert!(of_it.iter().any(|line| line.contains("robot: ") && line.ends_with(hash)), "{err}");
        assert!(of_it.iter().any(|line| line.contains("approach: 2400 steps")), "{err}");
        assert_eq!(err.contains("approach: 4000 steps"), of_others, "{err}");
    }
}

/// `--case` chooses among cases with values of their own as among the others.
#[test]
fn chosen_cases_are_run_alone() {
    let place = Place::new();
    let set = place.write("set.toml", &with_set());
    for (chosen, wanted) in [
        (&["case3"][..], &["case3.csv", "summary.json"][..]),
        (&["heavy"], &["heavy.csv", "summary.json"]),
        (&["heavy", "case1"], &["case1.csv", "heavy.csv", "summary.json"]),
    ] {
        let more: Vec<_> = chosen.iter().flat_map(|name| ["--case", name]).collect();
        let summary = place.run(&set, "out", &more);
        assert_eq!(names(&place.path("out")), wanted, "{chosen:?}");
        assert_eq!(summary["cases"].as_array().map(Vec::len), Some(chosen.len()), "{chosen:?}");
    }
}

/// Without another case there is no other approach, and no figures of one.
#[test]
fn every_case_may_have_values() {
    let place = Place::new();
    let mut text = scenario();
    for (i, name) in ["case1", "case2", "case3"].iter().enumerate() {
        let set = format!("name = \"{name}\"\nset = {{ \"approach.duration\" = {}.0 }}\n", 10 + i);
        text = text.replace(&format!("name = \"{name}\"\n"), &set);
    }
    let summary = place.run(&place.write("all.toml", &text), "out", &["--report"]);
    let durations: Vec<_> = (0..3).map(|i| summary["cases"][i]["approach"]["duration"].as_f64()).collect();
    assert_eq!(durations, [Some(10.0), Some(11.0), Some(12.0)]);
    let cases = report_data(&place.path("out"))["cases"].clone();
    assert_eq!((0..3).map(|i| cases[i]["part"].as_u64()).collect::<Vec<_>>(), [Some(0), Some(1), Some(2)]);
}

/// A value may need other code than the scenario's layout.
#[test]
fn a_case_may_have_other_structural_zeros() {
    let place = Place::new();
    let set = with_set().replace("\"layout.base.mass\" = 480.0", "\"layout.arm.arm1.link[0].com[1]\" = 0.05");
    let scenario = place.write("set.toml", &set);
    let out = place.path("out").display().to_string();
    let (code, _, err) = said(&["run", &scenario, "--out", &out]);
    assert_eq!(code, 0, "{err}");
    assert!(err.contains("\ncase `heavy`: dynamics: graph"), "{err}");
    let (code, _, err) = said(&["run", &scenario, "--out", &out, "--dynamics", "generated"]);
    assert!(code == 2 && err.contains("com[1]"), "{err}");
}

#[test]
fn check_animation_and_sweeps_know_the_case() {
    let place = Place::new();
    let set = place.write("set.toml", &with_set());
    let (code, out, err) = said(&["check", &set]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("3 cases") && out.contains("its own approach, with approach.duration = 12.0,"), "{out}");
    // what is unusual is so at `set`
    let unusual =
        place.write("unusual.toml", &with_set().replace("\"approach.duration\" = 12.0", "\"approach.duration\" = 0.5"));
    let (code, _, err) = said(&["check", &unusual]);
    assert_eq!(code, 0, "{err}");
    assert!(err.contains("`case[1].set` is") && err.contains("with these values, `approach.duration`: joint"), "{err}");

    let animate = |case: &str| said(&["animate", &set, "--case", case, "--seconds", "1", "-q"]);
    let (code, svg, err) = animate("heavy");
    assert!(code == 0 && svg.starts_with("<svg"), "{err}");
    let (code, _, err) = animate("none");
    assert!(code == 2 && err.contains("expected one of `case1`, `heavy`, `case3`"), "{err}");
}

#[cfg(feature = "sweep")]
#[test]
fn a_sweep_of_the_case_begins_with_its_values() {
    let place = Place::new();
    place.write("scenario.toml", &with_set());
    let sweep = r#"
        name = "small"
        scenario = "scenario.toml"
        case = "heavy"
        cases = 1
        seed = 1
        [[vary]]
        key = "case.heavy.target_twists.target1[0]"
        distribution = { choice = [0.0] }
        [[vary]]
        key = "approach.duration"
        distribution = { choice = [12.0] }
    "#;
    let file = place.write("sweep.toml", sweep);
    let out = place.path("sweep").display().to_string();
    let (code, _, err) = said(&["sweep", &file, "--out", &out, "--replay", "0", "-q"]);
    assert_eq!(code, 0, "{err}");
    let replayed = place.path("sweep/replay/000000/results/heavy.csv");
    place.run(&place.path("scenario.toml").display().to_string(), "run", &[]);
    assert_eq!(fs::read(replayed).expect("a file"), fs::read(place.path("run/heavy.csv")).expect("a file"));

    let wrong = sweep.replace("\"approach.duration\"", "\"case.heavy.set.'approach.duration'\"");
    let (code, _, err) = said(&["sweep", &place.write("wrong.toml", &wrong), "--out", &out]);
    assert!(code == 2 && err.contains("varies at its own path, expected `approach.duration`"), "{err}");
}

/// What stops at the values of a case is said at these.
#[test]
fn an_impossible_case_is_shown_at_its_values() {
    let place = Place::new();
    let text = with_set().replace("final_end_effector_twists", "final_end_effector_poses = [[2.0, -1.5], []]\n#");
    let text =
        text.replace("trajectory = \"quartic\"", "trajectory = \"quintic\"\nfinal_joint_rates = [0, 0, 0, 0, 0, 0]");
    let text = text.replace("\"target.target1.mass\" = 12.5", "\"approach.final_end_effector_poses[0][0]\" = 90.0");
    let out = place.path("out").display().to_string();
    let scenario = place.write("far.toml", &text);
    for arguments in [&["run", &scenario, "--out", &out, "-q"][..], &["check", &scenario]] {
        let (code, _, err) = said(arguments);
        assert_eq!(code, 2, "{err}");
        let place = "with these values, `approach.final_end_effector_poses[0]`";
        assert!(err.contains("`case[1].set` is {") && err.contains(place), "{err}");
    }
    assert!(!Path::new(&out).join("summary.json").exists());
}

/// What is wrong with the scenario itself is said once, where it stands, and not again for a case with values of its own.
#[test]
fn what_is_wrong_without_them_is_said_once() {
    let place = Place::new();
    let scenario =
        place.write("misspelt.toml", &with_set().replace("tracking = \"pd\"", "sampel_time = 0.1\ntracking = \"pd\""));
    let (code, _, err) = said(&["check", &scenario]);
    assert_eq!(code, 2, "{err}");
    assert_eq!(err.matches("sampel_time").count(), 2, "the key and its line: {err}");
    assert!(err.contains("unknown key") && !err.contains("set"), "{err}");
}

/// What the values of a case have no part in is said once.
#[test]
fn what_is_wrong_without_the_values_too_is_said_once() {
    let place = Place::new();
    let text = fs::read_to_string(file("scenarios/spinning_target.toml")).expect("a scenario");
    // the reach is another one, and the pose out of it with either; a pose of the case's own is another problem
    for (set, times) in [
        ("\"target.disc.mass\" = 20.0", 1),
        ("\"layout.base.mass\" = 90.0", 1),
        ("\"layout.arm.arm1.link[0].length\" = 0.9", 1),
        ("\"approach.final_end_effector_poses[0][0]\" = 8.8", 2),
    ] {
        let own = text.replace("name = \"rigid\"", &format!("name = \"rigid\"\nset = {{ {set} }}"));
        let path = place.write("far.toml", &own.replace("[[2.2, -0.9]]", "[[9.9, -0.9]]"));
        let (code, out, err) = said(&["check", &path]);
        assert_eq!((code, err.matches("is out of reach").count()), (2, times), "{set}: {out}{err}");
        assert!(!out.contains("no warnings"), "{set}: {out}");
    }
    // a warning
    for (set, times) in [("\"layout.base.mass\" = 90.0", 1), ("\"target.disc.mass\" = 900.0", 2)] {
        let own = text.replace("name = \"rigid\"", &format!("name = \"rigid\"\nset = {{ {set} }}"));
        let path = place.write("heavy.toml", &own.replacen("mass = ", "mass = 5", 1));
        let (code, out, err) = said(&["check", &path]);
        assert_eq!((code, err.matches("heavier than the robot").count()), (0, times), "{set}: {out}{err}");
    }
}
