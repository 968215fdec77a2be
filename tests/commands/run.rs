//! `planar-capture run`: results, messages, exit codes.

use crate::command;
use planar_proof::{assert_close, file, numbers, said, tolerance};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// Runs a scenario text from a folder of its own; (exit code, stdout, stderr, folder).
fn run_text(text: &str) -> (i32, String, String, TempDir) {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("scenario.toml");
    fs::write(&path, text).expect("written");
    let (code, out, err) = run_file(&path, &folder.path().join("results"));
    (code, out, err, folder)
}

fn run_file(path: &Path, results: &Path) -> (i32, String, String) {
    let mut command = command();
    command.args(["run", "--dynamics", "generated"]).arg(path).arg("--out").arg(results);
    said(command.output().expect("it runs"))
}

fn paper() -> String {
    fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("the scenario")
}

#[test]
fn the_papers_study_prints_its_table_and_writes_its_files() {
    let (code, out, err, folder) = run_text(&paper());
    assert_eq!((code, err.as_str()), (0, ""), "{err}");
    for expected in
        ["case1", "case2", "case3", "as printed", "0.0873", "0.0131", "exact", "momentum drift", "missed by"]
    {
        assert!(out.contains(expected), "no `{expected}` in\n{out}");
    }
    let results = folder.path().join("results");
    let mut names: Vec<_> =
        fs::read_dir(&results).expect("results").map(|e| e.expect("an entry").file_name()).collect();
    names.sort();
    assert_eq!(names, ["case1.csv", "case2.csv", "case3.csv", "summary.json"]);

    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(results.join("summary.json")).expect("a summary")).expect("JSON");
    assert_eq!(summary["scenario"], "raina_shah_2017");
    assert_eq!(summary["dynamics"], "generated");
    assert_eq!(summary["layout"]["name"], "dual_arm_3r");
    let keys =
        |value: &serde_json::Value| -> Vec<String> { value.as_object().expect("an object").keys().cloned().collect() };
    assert_eq!(keys(&summary), ["scenario", "layout", "dynamics", "run", "cases", "files"]);
    assert_eq!(summary["files"], serde_json::json!(["case1.csv", "case2.csv", "case3.csv", "summary.json"]));
    assert_eq!(keys(&summary["cases"][0]), ["name", "approach", "clearance", "impact", "post_impact"]);
    assert_eq!(
        keys(&summary["cases"][0]["impact"]["exact"]),
        [
            "joint_rates_after",
            "base_twist_after",
            "target_twists_after",
            "impulses",
            "impulse_magnitudes",
            "momentum_jump",
            "kinetic_energy_before",
            "kinetic_energy_after"
        ]
    );

    let mut csv = csv::Reader::from_path(results.join("case1.csv")).expect("CSV");
    let header = csv.headers().expect("a header").clone();
    assert!(header.iter().filter(|name| *name != "phase").all(|name| name.ends_with(']')), "units in {header:?}");
    let rows: Vec<csv::StringRecord> = csv.records().map(|row| row.expect("a row")).collect();
    // 20 s and 50 s, every 0.05 s, both ends of both phases
    assert_eq!(rows.len(), 401 + 1001);
    let value = |row: &csv::StringRecord, name: &str| -> f64 {
        let place = header.iter().position(|h| h == name).unwrap_or_else(|| panic!("no column {name}"));
        row[place].parse().expect("a number")
    };
    assert_eq!((value(&rows[400], "time [s]"), value(&rows[401], "time [s]")), (20.0, 20.0));
    assert_eq!((&rows[400][1], &rows[401][1]), ("approach", "post_impact"));
    let case = &summary["cases"][0];
    for (phase, row) in [("approach", &rows[400]), ("post_impact", &rows[1401])] {
        assert_eq!(motion(&case[phase]), motion_of(&header, row), "the CSV's {phase} ends where the summary's does");
    }
    let (end, start) = (&rows[400], &rows[401]);
    for (row, column, wanted) in [
        // from rest, by the joints alone; the targets keep theirs
        (end, "joint_work [J]", value(end, "kinetic_energy [J]") - value(&rows[0], "kinetic_energy [J]")),
        (end, "kinetic_energy [J]", case["impact"]["exact"]["kinetic_energy_before"].as_f64().expect("a number")),
        (start, "kinetic_energy [J]", case["impact"]["exact"]["kinetic_energy_after"].as_f64().expect("a number")),
        (start, "joint_work [J]", 0.0),
        (start, "arm1_joint1_torque [N m]", 0.0),
        (start, "linear_momentum_x [N s]", value(&rows[1401], "linear_momentum_x [N s]")),
        (start, "linear_momentum_y [N s]", value(&rows[1401], "linear_momentum_y [N s]")),
        (start, "angular_momentum [N m s]", value(&rows[1401], "angular_momentum [N m s]")),
    ] {
        assert_close(column, &[value(row, column)], &[wanted], tolerance::TIME_SERIES);
    }
}

/// The lists of a phase of the summary, in the order of the time series.
fn motion(phase: &serde_json::Value) -> Vec<f64> {
    let keys = ["base_pose", "joint_angles", "base_twist", "joint_rates", "end_effector_poses", "end_effector_twists"];
    keys.iter().flat_map(|key| numbers(&phase[*key])).collect()
}

/// The same of a row of the time series, found by the names of the columns: end effectors in the approach only.
fn motion_of(header: &csv::StringRecord, row: &csv::StringRecord) -> Vec<f64> {
    let pose = ["yaw [rad]", "x [m]", "y [m]"];
    let twist = ["omega [rad/s]", "vx [m/s]", "vy [m/s]"];
    let joints = |part: &str| -> Vec<String> {
        ["arm1", "arm2"].iter().flat_map(|arm| (1..=3).map(move |k| format!("{arm}_joint{k}_{part}"))).collect()
    };
    let of = |body: &str, parts: [&str; 3]| parts.map(|part| format!("{body}_{part}"));
    let mut names =
        [of("base", pose).to_vec(), joints("angle [rad]"), of("base", twist).to_vec(), joints("rate [rad/s]")].concat();
    if &row[1] == "approach" {
        names.extend(["arm1_tip", "arm2_tip"].iter().flat_map(|tip| of(tip, pose)));
        names.extend(["arm1_tip", "arm2_tip"].iter().flat_map(|tip| of(tip, twist)));
    }
    let value = |name: &String| {
        let place = header.iter().position(|h| h == name).unwrap_or_else(|| panic!("no column {name}"));
        row[place].parse().expect("a number")
    };
    names.iter().map(value).collect()
}

/// The printed table has the summary's numbers, each in its column.
#[test]
fn the_table_is_the_summary() {
    let (_, out, _, folder) = run_text(&paper());
    let text = fs::read_to_string(folder.path().join("results/summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let rows = |first: &str, second: &str| -> Vec<Vec<String>> {
        let words = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        out.lines().map(words).filter(|row| row.len() > 3 && row[0] == first && row[1] == second).collect()
    };
    for (case, value) in ["case1", "case2", "case3"].iter().zip(summary["cases"].as_array().expect("cases")) {
        for (arm, name) in ["arm1", "arm2"].iter().enumerate() {
            let of = |model: &str| value["impact"][model]["impulse_magnitudes"][arm].as_f64().expect("an impulse");
            let printed = if *case == "case2" { "0.0131" } else { "0.0873" };
            let target = format!("target{}", arm + 1);
            let wanted = [format!("{:.5}", of("exact")), format!("{:.5}", of("paper")), printed.to_owned()];
            assert_eq!(
                rows(case, name),
                [[&[(*case).to_owned(), (*name).to_owned(), target, "rigid".to_owned()], &wanted[..]].concat()]
            );
        }
        for model in ["exact", "paper"] {
            let impact = &value["impact"][model];
            let energy = |when: &str| format!("{:.6}", impact[format!("kinetic_energy_{when}")].as_f64().expect("J"));
            let jump = impact["momentum_jump"].as_array().expect("a jump").iter();
            // with two digits, whether with a power of ten or without
            let two_digits = |value: f64| format!("{value:.1e}");
            let jump: Vec<String> = jump.map(|j| two_digits(j.as_f64().expect("a number"))).collect();
            let wanted = [(*case).to_owned(), model.to_owned(), energy("before"), energy("after")];
            let found = rows(case, model);
            assert_eq!((found.len(), &found[0][..4]), (1, &wanted[..]));
            let shown = found[0][4..].iter().map(|text| two_digits(text.parse().expect("a number")));
            assert_eq!(shown.collect::<Vec<_>>(), jump);
        }
        let after = &value["post_impact"];
        let short = |key: &str| format!("{:.1e}", after[key].as_f64().expect("a number"));
        let wanted = [
            (*case).to_owned(),
            "50".to_owned(),
            short("momentum_drift"),
            short("energy_error"),
            short("center_of_mass_drift"),
        ];
        assert_eq!(rows(case, "50"), [wanted]);
    }
    let approach = &summary["cases"][0]["approach"];
    let pose: Vec<f64> =
        approach["base_pose"].as_array().expect("a pose").iter().filter_map(serde_json::Value::as_f64).collect();
    assert!(out.contains(&format!("yaw {:.6} rad, x {:.6} m, y {:.6} m", pose[0], pose[1], pose[2])), "{out}");
}

#[test]
fn an_approach_alone_has_no_impact() {
    let folder = TempDir::new().expect("a folder");
    let (code, out, err) = run_file(&file("scenarios/redysim_single_arm_3r.toml"), folder.path());
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(!out.contains("impact"), "{out}");
    let text = fs::read_to_string(folder.path().join("summary.json")).expect("a summary");
    assert!(text.contains("\"approach\"") && !text.contains("impact"), "{text}");
    assert!(folder.path().join("redysim_single_arm_3r.csv").exists());
}

/// A layout file in the scenario's folder, with other parameters, runs on the generated code of its structure.
#[test]
fn numbers_of_a_users_layout_are_parameters() {
    let folder = TempDir::new().expect("a folder");
    let layout = fs::read_to_string(file("codegen/layouts/single_arm_3r.toml")).expect("a layout");
    fs::write(folder.path().join("mine.toml"), layout.replace("500.0", "5.0e9").replace("83.61", "1.0e9"))
        .expect("written");
    let scenario = fs::read_to_string(file("scenarios/redysim_single_arm_3r.toml")).expect("a scenario");
    let path = folder.path().join("scenario.toml");
    fs::write(&path, scenario.replace("\"single_arm_3r\"", "\"mine.toml\"")).expect("written");
    let (code, _, err) = run_file(&path, &folder.path().join("results"));
    assert_eq!((code, err.as_str()), (0, ""));
    let text = fs::read_to_string(folder.path().join("results/summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let yaw = summary["cases"][0]["approach"]["base_pose"][0].as_f64().expect("a yaw");
    assert!(yaw.abs() < 1e-6, "a base of a million tons hardly turns, not by {yaw}");
}

/// (what is wrong, the change to the paper's scenario, what the message says besides file and line)
const WRONG: &[(&str, &str, &str, &[&str])] = &[
    ("broken TOML", "duration = 20.0", "duration = = 20.0", &["scenario.toml:15:"]),
    (
        "unknown key",
        "derivative_gain",
        "derivativ_gain",
        &["`approach.derivativ_gain`", "did you mean `derivative_gain`"],
    ),
    ("negative mass", "mass = 10.0", "mass = -10.0", &["`target[0].mass`", "-10", "kg"]),
    ("NaN", "duration = 20.0", "duration = nan", &["`approach.duration`", "nan", "finite"]),
    ("unknown layout", "\"dual_arm_3r\"", "\"dual_arm_4r\"", &["dual_arm_4r", "dual_arm_3r", "single_arm_3r"]),
    ("too few angles", "1.571, -1.047]", "1.571]", &["`initial.joint_angles`", "6"]),
    ("unknown arm", "arm = \"arm2\"", "arm = \"arm3\"", &["`target[1].arm`", "arm3", "`arm2`"]),
    ("degrees", "joint_angles = [0.698", "joint_angles = [40.0", &["joint_angles", "degrees"]),
];

#[test]
fn bad_input_is_exit_code_2_and_a_message_that_helps() {
    for (what, from, to, hints) in WRONG {
        let text = paper();
        assert!(text.contains(from), "{what}");
        let (code, out, err, folder) = run_text(&text.replacen(from, to, 1));
        assert_eq!((code, out.as_str()), (2, ""), "{what}: {err}");
        assert!(err.contains("scenario.toml:"), "{what}: no file and line in\n{err}");
        assert!(err.lines().count() <= 40, "{what}: more than a screen\n{err}");
        for hint in *hints {
            assert!(err.contains(hint), "{what}: no `{hint}` in\n{err}");
        }
        assert!(!folder.path().join("results").exists(), "{what}: something was written");
    }
}

#[test]
fn files_that_cannot_be_read_or_written() {
    let folder = TempDir::new().expect("a folder");
    let (code, _, err) = run_file(&file("scenarios/raina_shah_2071.toml"), folder.path());
    assert_eq!(code, 2);
    assert!(err.contains("raina_shah_2071.toml") && err.contains("raina_shah_2017.toml"), "{err}");

    let (code, _, err) = run_file(folder.path(), &folder.path().join("results"));
    assert!(code == 2 && err.contains("is a folder, expected a TOML file"), "{err}");

    let occupied = folder.path().join("occupied");
    fs::write(&occupied, "a file, not a folder").expect("written");
    let (code, _, err) = run_file(&file("scenarios/raina_shah_2017.toml"), &occupied);
    assert_eq!(code, 2);
    assert!(err.contains("occupied"), "{err}");
}

/// A file that cannot take its place leaves the results of an earlier run as they were.
#[test]
fn results_are_of_one_run() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    fs::create_dir_all(results.join("summary.json")).expect("a folder in the summary's place");
    fs::write(results.join("case1.csv"), "of an earlier run").expect("written");
    let (code, _, err) = run_file(&file("scenarios/raina_shah_2017.toml"), &results);
    assert_eq!(code, 2);
    assert!(err.contains("summary.json"), "{err}");
    assert_eq!(fs::read_to_string(results.join("case1.csv")).expect("a file"), "of an earlier run");
    assert_eq!(fs::read_dir(&results).expect("a folder").count(), 2, "temporary files are gone");
}

/// Without generated code of its structure, a layout is refused where that is asked for, and computed by its graph else.
#[test]
fn a_structure_without_code_is_computed_by_its_graph() {
    let folder = TempDir::new().expect("a folder");
    let layout = fs::read_to_string(file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    let raised = layout.replace("\"dual_arm_3r\"", "\"raised\"").replacen("[0.5, 0.0]", "[0.5, 0.25]", 1);
    fs::write(folder.path().join("raised.toml"), raised).expect("written");
    let path = folder.path().join("scenario.toml");
    fs::write(&path, paper().replace("\"dual_arm_3r\"", "\"raised.toml\"")).expect("written");
    let results = folder.path().join("results");
    let (code, _, err) = run_file(&path, &results);
    assert_eq!(code, 2);
    assert!(err.contains("scenario.toml: no generated code") && err.contains("planar-capture new"), "{err}");
    assert!(err.contains("`arm[0].mount[1]` is 0.25") && err.contains("Nearest is `dual_arm_3r`"), "{err}");
    let mut command = command();
    command.env("PLANAR_CAPTURE_HOME", folder.path()).arg("run").arg(&path).arg("--out").arg(&results);
    let (code, _, err) = said(command.output().expect("it runs"));
    assert_eq!(code, 0, "{err}");
    let summary = fs::read_to_string(results.join("summary.json")).expect("a summary");
    assert!(summary.contains("\"dynamics\": \"graph\""), "{summary}");
}

#[test]
fn a_twist_out_of_reach_is_refused_with_its_numbers() {
    // both elbows straight: the final pose is singular
    let text =
        paper().replace("[-0.524, -1.393, -0.035, 2.618, -1.393, -0.035]", "[-0.524, 0.0, 0.0, 2.618, 0.0, 0.0]");
    let (code, _, err, _) = run_text(&text);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("close to singular") && err.contains("final_joint_angles"), "{err}");
    // a straight arm cannot move its end effector along itself
    let text = fs::read_to_string(file("scenarios/redysim_single_arm_3r.toml")).expect("a scenario");
    let wanted = "trajectory = \"quartic\"\nfinal_end_effector_twists = [[0.0, 5.0, 0.0]]";
    let straight = "final_joint_angles = [0.0, 0.0, 0.0]";
    let text = text.replace("trajectory = \"cycloidal\"", wanted);
    let start = text.find("final_joint_angles").expect("angles");
    let end = start + text[start..].find('\n').expect("a line");
    let (code, _, err, _) = run_text(&text.replace(&text[start..end], straight));
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("out of reach") && err.contains("singular values"), "{err}");
    // nor by a thousandth of the velocity across
    let heavy = include_str!("../../codegen/layouts/single_arm_3r.toml");
    let heavy = heavy.replacen("mass = ", "mass = 1e9 # ", 1).replacen("inertia = ", "inertia = 1e9 # ", 1);
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("heavy.toml"), heavy).expect("written");
    let text = text.replace(&text[start..end], straight).replace("[[0.0, 5.0, 0.0]]", "[[0.0, 5e-5, 0.1]]");
    let layout = format!("layout = \"{}\"", folder.path().join("heavy.toml").display());
    let (code, _, err, _) = run_text(&text.replace("layout = \"single_arm_3r\"", &layout));
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("out of reach"), "{err}");
}

/// Limits of an integrator are reported with a remedy: as invalid input where it never applies, as a stopped study
/// where a step fails.
#[test]
fn integrators_say_what_they_cannot_do() {
    let held = fs::read_to_string(file("scenarios/large_target.toml")).expect("the scenario");
    let held = held.replacen("[post_impact]", "[post_impact]\ncoordinates = \"reduced\"", 1);
    let (code, _, err, _) = run_text(&held);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("they are for a robot alone") && !err.contains("shorter step"), "{err}");
    let stiff = paper().replacen("step = 0.005", "step = 0.5", 1).replacen("\"rk4\"", "\"gauss_legendre\"", 1);
    let (code, _, err, _) = run_text(&stiff);
    assert_eq!(code, 1, "{err}");
    assert!(err.contains("do not converge") && err.contains("a shorter step, or smaller gains"), "{err}");
}

/// The paper's gains break a robot of a hundredth of its masses: the message has the gains, their time and a step.
#[test]
fn gains_that_break_a_small_robot_are_named() {
    let folder = TempDir::new().expect("a folder");
    let layout = fs::read_to_string(file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    let small = layout.replace("mass = 500.0", "mass = 5.0").replace("inertia = 83.61", "inertia = 0.8361");
    let small = small.replace("mass = 10.0", "mass = 0.1").replace("inertia = 1.05", "inertia = 0.0105");
    fs::write(folder.path().join("small.toml"), small).expect("written");
    let path = folder.path().join("scenario.toml");
    fs::write(&path, paper().replace("\"dual_arm_3r\"", "\"small.toml\"")).expect("written");
    let (code, _, err) = run_file(&path, &folder.path().join("results"));
    assert_eq!(code, 1, "{err}");
    for part in
        ["approach.step", "is not a finite number", "`proportional_gain` = 49", "`derivative_gain` = 14", "or less"]
    {
        assert!(err.contains(part), "no {part} in: {err}");
    }
}

/// Steps that are far too long: the audit objects, and the exit code says so.
#[test]
fn the_audit_decides_the_exit_code() {
    let (code, out, err, folder) = run_text(&paper().replace("step = 0.005", "step = 0.05"));
    assert_eq!(code, 1, "{out}{err}");
    assert!(
        err.contains("audit: approach: momentum drift")
            && err.contains("[approach] is integrated by `rk4` with steps of 0.05 s: `step = 0.01`"),
        "{err}"
    );
    assert!(folder.path().join("results/summary.json").exists(), "the numbers are there to be looked at");
}

/// A case with values of its own counts as the others do: one that alone is too fast for a joint decides, be it the first or the last.
#[test]
fn every_case_decides_the_exit_code() {
    let limited = paper().replace("duration = 50.0", "duration = 1.0") + "\n[limits]\njoint_rates = 0.25\n";
    let (code, out, err, _) = run_text(&limited);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    for name in ["case1", "case3"] {
        let named = format!("name = \"{name}\"\n");
        assert_eq!(limited.matches(&named).count(), 1);
        let fast = format!("{named}set = {{ \"approach.duration\" = 8.0 }}\n");
        let (code, out, err, _) = run_text(&limited.replace(&named, &fast));
        assert_eq!(code, 1, "{out}{err}");
        let objections: Vec<_> = err.lines().filter(|line| line.contains(" rad/s at ")).collect();
        assert!(!objections.is_empty() && objections.iter().all(|line| line.contains(name)), "{err}");
    }
}

#[test]
fn usage_errors_are_exit_code_2() {
    for arguments in [&["run"][..], &["rum", "x.toml"], &["run", "x", "--dynamics", "magic"]] {
        let output = command().args(arguments).output().expect("it runs");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    for time in ["-1", "0", "nan", "inf", "soon"] {
        let output = command().args(["run", "x.toml", &format!("--sample={time}")]).output().expect("it runs");
        let (code, _, err) = said(output);
        let wanted = if time == "soon" { "expected a number of seconds" } else { "expected a time greater than 0 s" };
        assert!(code == 2 && err.contains(wanted), "{time}: {err}");
    }
}

#[test]
fn rows_that_cannot_be_as_close_as_asked_are_noted() {
    let text = paper().replace("duration = 20.0", "duration = 0.5").replace("duration = 50.0", "duration = 0.5");
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("scenario.toml");
    fs::write(&path, text).expect("written");
    let noted = |sample: &str| {
        let mut command = command();
        command.arg("run").arg(&path).args(["--sample", sample]).arg("--out").arg(folder.path().join("results"));
        said(command.output().expect("it runs"))
    };
    let (code, _, err) = noted("0.001");
    assert!(err.contains("warning: --sample 0.001 s is shorter than the scenario's step of 0.005 s"), "{err}");
    let (code_without, _, err) = noted("0.005");
    assert!(!err.contains("--sample"), "{err}");
    assert_eq!(code, code_without);
    // the longer step of either phase
    let text = fs::read_to_string(&path).expect("the scenario");
    let places: Vec<usize> = text.match_indices("step = 0.005").map(|(place, _)| place).collect();
    assert_eq!(places.len(), 2, "one for each phase");
    for place in places {
        let (before, after) = text.split_at(place);
        fs::write(&path, format!("{before}{}", after.replacen("0.005", "0.01", 1))).expect("written");
        // shorter than one of them, and than both
        for sample in ["0.006", "0.001"] {
            let (_, _, err) = noted(sample);
            let warning = format!("warning: --sample {sample} s is shorter than the scenario's step of 0.01 s");
            assert!(err.contains(&warning), "{err}");
        }
    }
}

/// The page needs no other files; `report_browser.py` opens it in a browser.
#[test]
fn a_report_is_one_file_without_a_network() {
    let folder = TempDir::new().expect("a folder");
    let text =
        paper().replace("name = \"target1\"", "name = \"</script><b>\"").replace("target1 =", "\"</script><b>\" =");
    let path = folder.path().join("scenario.toml");
    fs::write(&path, text).expect("written");
    let results = folder.path().join("results");
    let output = command().arg("run").arg(&path).arg("--out").arg(&results).arg("--report").output().expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let page = fs::read_to_string(results.join("report.html")).expect("a page");
    assert!(page.starts_with("<!doctype html>") && page.trim_end().ends_with("</html>"));
    for left in ["<!--title-->", "/*data*/", "/*scene.js*/", "/*uplot.js*/", "/*page.css*/"] {
        assert!(!page.contains(left), "`{left}` was not filled in");
    }
    for outside in [" src=", "@import", "fetch(", "XMLHttpRequest", "WebSocket(", "url(http"] {
        assert!(!page.contains(outside), "`{outside}` reaches out of the page");
    }
    assert!(page.contains("default-src 'none'") && page.contains("The MIT License"));
    let (_, rest) = page.split_once("id=\"data\">").expect("data");
    let (data, _) = rest.split_once("</script>").expect("an end");
    let data: serde_json::Value = serde_json::from_str(data).expect("JSON");
    assert_eq!(data["cases"].as_array().map(Vec::len), Some(3));
    let part = &data["parts"][0];
    assert_eq!(part["targets"][0]["name"], "</script><b>");
    assert_eq!(part["approach"]["time"].as_array().map(Vec::len), Some(401));
    assert_eq!(part["approach"]["joint_angles"].as_array().map(Vec::len), Some(6));
    let momentum = &data["cases"][0]["targets_alone"]["momentum"];
    assert!(momentum[0].as_f64().is_some_and(|l| (l - 0.4).abs() < 1e-12), "{momentum}");
}

/// Arms that touch nothing have `null` in lists per arm, which is no number out of range.
#[test]
fn impacts_of_one_arm_of_two_are_written() {
    let folder = TempDir::new().expect("a folder");
    let (code, _, err) = run_file(&file("scenarios/elastic_rebound.toml"), &folder.path().join("results"));
    assert_eq!((code, err.as_str()), (0, ""), "{err}");
    let summary = fs::read(folder.path().join("results/summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_slice(&summary).expect("JSON");
    let twists = summary["cases"][0]["impact"]["exact"]["target_twists_after"].as_array().expect("one per arm");
    assert_eq!(twists.iter().filter(|twist| twist.is_null()).count(), 1, "{twists:?}");
}

/// The impact is that of `eval` from the state before it, with links a billion times lighter than their targets too.
#[test]
fn light_last_links_lose_no_digits_of_an_impact() {
    let folder = TempDir::new().expect("a folder");
    let layout = fs::read_to_string(file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    let heads: Vec<_> = layout.split("[[arm.link]]").collect();
    let light = |link: &str| link.replace("mass = 10.0", "mass = 1e-8").replace("inertia = 1.05", "inertia = 1.05e-9");
    let links =
        heads.iter().enumerate().map(|(i, text)| if i % 3 == 0 && i > 0 { light(text) } else { (*text).to_owned() });
    let light = links.collect::<Vec<_>>().join("[[arm.link]]");
    assert_eq!(light.matches("1e-8").count(), 2);
    fs::write(folder.path().join("dual_arm_3r.toml"), light).expect("written");
    let text = paper()
        .replace("\"dual_arm_3r\"", "\"dual_arm_3r.toml\"")
        .replace("\"pd\"", "\"computed_torque\"")
        .replace("gain = 49.0", "gain = 4.0")
        .replace("gain = 14.0", "gain = 4.0");
    let path = folder.path().join("scenario.toml");
    fs::write(&path, text).expect("written");
    let results = folder.path().join("results");
    let (code, _, err) = run_file(&path, &results);
    assert_eq!((code, err.as_str()), (0, ""));
    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(results.join("summary.json")).expect("a summary")).expect("JSON");
    for (case, spins) in summary["cases"].as_array().expect("cases").iter().zip([[0.2, 0.2], [0.0, 0.0], [0.2, -0.2]]) {
        let target = |contact: f64, spin: f64| serde_json::json!({"mass": 10.0, "inertia": 1.0, "contact": [0.0, contact], "twist": [spin, 0.0, 0.0]});
        let mut state = serde_json::json!({"targets": [target(0.5, spins[0]), target(-0.5, spins[1])]});
        for key in ["base_pose", "base_twist", "joint_angles", "joint_rates"] {
            state[key] = case["approach"][key].clone();
        }
        let mut eval = assert_cmd::Command::from_std(command());
        let output = eval.arg("eval").arg(folder.path().join("dual_arm_3r.toml")).arg("-");
        let output = output.write_stdin(serde_json::json!([state]).to_string()).output().expect("it runs");
        let expected: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        for key in ["joint_rates_after", "base_twist_after", "target_twists_after", "impulses"] {
            let [found, expected] = [&case["impact"]["exact"][key], &expected[0]["capture"][key]].map(numbers);
            let largest = expected.iter().fold(0.0, |most: f64, part| most.max(part.abs()));
            assert_close(key, &found, &expected, tolerance::CAPTURE * largest);
        }
    }
}
