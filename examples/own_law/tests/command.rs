//! The laws through the command line: named by a scenario, with their numbers, in a sweep of these, and refused where they are
//! wrong.

use std::fs;
use std::path::Path;
use std::process::Command;

/// Exit code, standard output and standard error.
fn said(arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_own-law")).args(arguments).output().expect("it runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (output.status.code().expect("a code"), text(output.stdout), text(output.stderr))
}

fn folder(name: &str) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).expect("a folder");
    folder.display().to_string()
}

fn scenario() -> String {
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/scenario.toml")).expect("the scenario");
    text.replace("duration = 10.0", "duration = 1.0")
}

fn written(folder: &str, name: &str, text: &str) -> String {
    let path = format!("{folder}/{name}");
    fs::write(&path, text).expect("written");
    path
}

/// The summary of a run of this text.
fn run(name: &str, text: &str) -> String {
    let folder = folder(name);
    let (out, file) = (format!("{folder}/out"), written(&folder, "scenario.toml", text));
    let (code, _, err) = said(&["run", &file, "--out", &out, "--force", "-q"]);
    assert_eq!(code, 0, "{err}");
    fs::read_to_string(format!("{out}/summary.json")).expect("a summary")
}

#[test]
fn a_scenario_names_the_law_and_gives_its_numbers() {
    let found = run("named", &scenario());
    assert!(found.contains("\"name\": \"encoder_control\"") && found.contains("\"filter_time\": 0.05"), "{found}");
    let stiff = run("stiff", &scenario().replace("proportional_gain = 49.0", "proportional_gain = 60.0"));
    let end = |summary: &str| {
        summary.lines().skip_while(|line| line.trim() != "\"joint_angles\": [").nth(1).map(str::to_owned)
    };
    assert!(end(&found).is_some() && end(&found) != end(&stiff));
    let set = "[[case]]\nname = \"stiff\"\nset = { \"approach.law.proportional_gain\" = 60.0 }\n[post_impact]";
    let set = run("set", &scenario().replace("[post_impact]", set));
    assert_eq!(end(&set), end(&stiff));
}

/// The largest joint rate at the end of the motion after the capture, rad/s.
fn rate_at_the_end(summary: &str) -> f64 {
    let value = summary.split("\"largest_joint_rate\": ").nth(1).and_then(|rest| rest.split(',').next());
    value.and_then(|value| value.parse().ok()).expect("a number")
}

#[test]
fn a_scenario_names_the_law_after_the_capture() {
    let weak = run("weak", &scenario());
    assert!(weak.contains("\"name\": \"encoder_damping\"") && weak.contains("\"derivative_gain\": 7.0"), "{weak}");
    let more = scenario().replace("derivative_gain = 7.0", "derivative_gain = 28.0");
    let strong = run("strong", &more);
    assert!(rate_at_the_end(&strong) < 0.8 * rate_at_the_end(&weak));
    let set = "[[case]]\nname = \"strong\"\nset = { \"post_impact.law.derivative_gain\" = 28.0 }\n[post_impact]";
    let set = run("set_afterwards", &scenario().replace("[post_impact]", set));
    assert_eq!(rate_at_the_end(&set).to_bits(), rate_at_the_end(&strong).to_bits());
    // encoders without noise and delay to speak of damp as the shipped law does
    let fine = scenario().replace("\n[post_impact.law]", "\n[post_impact.law]\nresolution = 1e-12\nfilter_time = 1e-9");
    let shipped = scenario();
    let shipped = shipped.split("[post_impact]").next().expect("a scenario").to_owned()
        + "[post_impact]\nduration = 1.0\ncontrol = \"damping\"\nderivative_gain = 7.0\n";
    let [fine, shipped] = [("fine", fine), ("shipped", shipped)].map(|(name, text)| rate_at_the_end(&run(name, &text)));
    // rates are late by a sample and half of one, 0.03 s, where 7 N m s/rad damp some 10 kg m²
    assert!((fine - shipped).abs() < 0.03 * shipped, "{fine} {shipped}");
}

#[test]
fn lists_checks_and_schemas_know_the_laws() {
    let (code, out, err) = said(&["list"]);
    assert!(code == 0 && out.contains("encoder_control") && out.contains("filter_time = 0.05 s"), "{out}{err}");
    let (_, out, _) = said(&["schema", "scenario"]);
    assert!(out.contains("\"encoder_control\"") && out.contains("\"encoder_damping\""));
    let choices = |key: &str| out.split(&format!("\"{key}\": {{")).nth(1).and_then(|rest| rest.split(']').next());
    assert!(choices("control").is_some_and(|names| names.contains("damping") && !names.contains("encoder_control")));
    let file = written(&folder("check"), "scenario.toml", &scenario());
    let (code, out, err) = said(&["check", &file]);
    assert!(code == 0 && out.contains("encoder_control, a law of this program, resolution 0.0001"), "{out}{err}");
    assert!(out.contains("encoder_damping, a law of this program, resolution 0.0001"), "{out}{err}");
    let out = format!("{}/moving.svg", folder("check"));
    let _ = fs::remove_file(&out);
    let (code, _, err) = said(&["animate", &file, "--out", &out, "--seconds", "1", "-q"]);
    assert_eq!(code, 0, "{err}");
}

#[test]
fn what_is_wrong_is_refused() {
    for (wrong, right, words) in [
        ("\"encoder_control\"\nsample", "\"encoder_contro\"\nsample", "did you mean `encoder_control`?"),
        (
            "\"encoder_control\"\nsample",
            "\"fuzzy\"\nsample",
            "`computed_torque`, `resolved_motion_rate` or `encoder_control`",
        ),
        (
            "resolution = 1e-4",
            "resolution = 0",
            "`approach.law.resolution` is 0, expected a resolution of the encoders in rad greater than 0",
        ),
        ("resolution = 1e-4", "resolutio = 1e-4", "did you mean `resolution`?"),
        ("\"encoder_control\"\nsample", "\"pd\"\nsample", "only `tracking` with the name of a law"),
        ("sample_time", "pose_gain = 1.0\nsample_time", "the numbers of a law of one's own are in `[approach.law]`"),
        (
            "sample_time",
            "proportional_gain = 1.0\nsample_time",
            "the numbers of a law of one's own are in `[approach.law]`",
        ),
        ("\"encoder_damping\"", "\"encoder_control\"", "`stabilise` or `encoder_damping`"),
        ("\"encoder_damping\"", "\"damping\"", "only `control` with the name of a law"),
        (
            "derivative_gain = 7.0",
            "derivative_gain = -7.0",
            "`post_impact.law.derivative_gain` is -7.0, expected a derivative gain in N m s/rad of 0 or more",
        ),
        (
            "control = \"encoder_damping\"",
            "control = \"encoder_damping\"\nbase_gain = 1.0",
            "the numbers of a law of one's own are in `[post_impact.law]`",
        ),
    ] {
        let text = scenario();
        assert!(text.contains(wrong), "{wrong}");
        let file = written(&folder("wrong"), "scenario.toml", &text.replacen(wrong, right, 1));
        let (code, _, err) = said(&["check", &file]);
        assert!(code == 2 && err.contains(words), "{right}: {err}");
    }
}

/// The numbers of the law vary as any others of the scenario.
#[test]
fn a_sweep_varies_the_numbers() {
    let folder = folder("sweep");
    written(&folder, "scenario.toml", &scenario());
    let sweep = "name = \"gains\"\nscenario = \"scenario.toml\"\nsampling = \"grid\"\nseed = 1\n\
                 [[vary]]\nkey = \"approach.law.proportional_gain\"\ndistribution = { choice = [49.0, 60.0] }\n\
                 [collect]\nseries = [0, 1]\n";
    let (out, file) = (format!("{folder}/out"), written(&folder, "sweep.toml", sweep));
    let _ = fs::remove_dir_all(&out);
    let (code, said_out, err) = said(&["sweep", &file, "--out", &out, "-q"]);
    assert_eq!(code, 0, "{said_out}{err}");
    let last = |case: u32| {
        let rows = fs::read_to_string(format!("{out}/series/{case:06}.csv")).expect("rows");
        rows.lines().next_back().expect("a row").to_owned()
    };
    let series = [0, 1].map(last);
    assert!(series[0] != series[1] && series.iter().all(|row| row.split(',').count() > 20), "{series:?}");
    // the second case is the scenario with the other gain
    let stiff = scenario().replace("proportional_gain = 49.0", "proportional_gain = 60.0");
    let (own, file) = (format!("{folder}/own"), written(&folder, "stiff.toml", &stiff));
    let (code, _, err) = said(&["run", &file, "--out", &own, "--force", "-q"]);
    assert_eq!(code, 0, "{err}");
    let rows = fs::read_to_string(format!("{own}/encoder_control.csv")).expect("rows");
    assert_eq!(rows.lines().next_back(), Some(&*series[1]));
}
