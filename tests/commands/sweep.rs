//! `planar-capture sweep`: the same bytes however a sweep was computed, resumption, failed cases, refusals.

use crate::command;
#[cfg(unix)]
use crate::{make_pipe, within_a_minute};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use planar_capture::campaign::Campaign;
use planar_capture::campaign::outputs::{OutputGroup, outputs};
use planar_capture::campaign::run::{Plan, Shard, Tally, run};
use planar_capture::engine::Choice;
use planar_capture::registry::{Robots, SHIPPED};
use planar_proof::{file, said};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Twelve cases in files of four.
const SWEEP: &str = r#"
    name = "small"
    scenario = "scenario.toml"
    cases = 12
    seed = 1
    block = 4
    sampling = "SAMPLING"
    [[vary]]
    key = "target.target1.mass"
    distribution = { normal = { mean = 10.0, std = 1.0 }, min = 5.0 }
    [[vary]]
    key = "layout.arm.arm1.link[0].mass"
    distribution = { choice = [9.0, 10.0] }
    [[vary]]
    key = "approach.proportional_gain[2]"
    distribution = { uniform = { min = 40.0, max = 60.0 } }
"#;

/// The names of all groups of outputs.
fn all_groups() -> Vec<&'static str> {
    OutputGroup::ALL.iter().map(|(name, _)| *name).collect()
}

/// A folder with a scenario and a sweep.
struct Workplace(TempDir);

impl Workplace {
    fn new(sweep: &str) -> Self {
        let folder = TempDir::new().expect("a folder");
        let text = fs::read_to_string(file("scenarios/sweeps/capture.toml")).expect("the scenario");
        let short = text.replace("duration = 50.0", "duration = 2.0");
        assert_ne!(short, text);
        fs::write(folder.path().join("scenario.toml"), short).expect("written");
        let place = Self(folder);
        place.write(sweep);
        place
    }

    fn sampled(sampling: &str) -> Self {
        Self::new(&SWEEP.replace("SAMPLING", sampling))
    }

    /// With all combinations of the choices of what varies.
    fn grid(varied: &str) -> Self {
        let head = "name = \"grid\"\nscenario = \"scenario.toml\"\nseed = 1\nsampling = \"grid\"\n";
        Self::new(&format!("{head}{varied}"))
    }

    fn write(&self, sweep: &str) {
        fs::write(self.path("sweep.toml"), sweep).expect("written");
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Exit code, standard output and standard error.
    fn sweep(&self, out: &str, more: &[&str]) -> (i32, String, String) {
        let mut command = command();
        command.arg("sweep").arg(self.path("sweep.toml")).arg("--out").arg(self.path(out)).args(more);
        said(command.output().expect("it runs"))
    }

    /// The case of the summary of a replay.
    fn replayed(&self, index: u32) -> Value {
        let (code, _, err) = self.sweep("out", &["--replay", &index.to_string()]);
        assert_eq!(code, 0, "{err}");
        let summary = self.path(&format!("out/replay/{index:06}/results/summary.json"));
        let summary: Value = serde_json::from_slice(&fs::read(summary).expect("a summary")).expect("JSON");
        summary["cases"][0].clone()
    }

    fn computed(&self, out: &str, more: &[&str]) -> BTreeMap<PathBuf, Vec<u8>> {
        let (code, _, err) = self.sweep(out, more);
        assert_eq!(code, 0, "{err}");
        self.cases(out)
    }

    /// The rows of a file of cases.
    fn rows(&self, out: &str, block: usize) -> Vec<BTreeMap<String, Field>> {
        let file = fs::File::open(self.path(out).join("cases").join(FILES[block])).expect("a file");
        let reader = SerializedFileReader::new(file).expect("Parquet");
        let rows = reader.get_row_iter(None).expect("rows").map(|row| row.expect("a row"));
        rows.map(|row| row.get_column_iter().map(|(name, field)| (name.clone(), field.clone())).collect()).collect()
    }

    /// The bytes of the files of cases.
    fn cases(&self, out: &str) -> BTreeMap<PathBuf, Vec<u8>> {
        let folder = self.path(out).join("cases");
        let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
        let visible =
            entries.filter(|path| !path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.')));
        visible.map(|path| (path.file_name().expect("a name").into(), fs::read(&path).expect("a file"))).collect()
    }
}

fn times(folder: &Path) -> usize {
    fs::read_dir(folder.join("timing")).expect("a folder").count()
}

#[test]
fn bytes_do_not_depend_on_threads_shards_or_engine() {
    for sampling in ["random", "latin_hypercube", "sobol"] {
        let place = Workplace::sampled(sampling);
        let one = place.computed("one", &["--threads", "1"]);
        assert_eq!(one.keys().map(|name| name.to_string_lossy()).collect::<Vec<_>>(), FILES);
        assert_eq!(times(&place.path("one")), 3);
        assert_eq!(place.computed("two", &["--threads", "2"]), one, "{sampling}");
        for shard in ["2/3", "3/3"] {
            let (code, _, err) = place.sweep("shards", &["--shard", shard]);
            assert_eq!(code, 0, "{err}");
        }
        assert_eq!(place.cases("shards").keys().map(|name| name.to_string_lossy()).collect::<Vec<_>>(), FILES[1..]);
        assert_eq!(place.computed("shards", &["--shard", "1/3"]), one);
        assert_eq!(place.computed("graph", &["--dynamics", "graph"]), one);
        let manifest = |out: &str| fs::read_to_string(place.path(out).join("manifest.json")).expect("a manifest");
        assert_ne!(manifest("graph"), manifest("one"));
        assert_eq!(manifest("shards"), manifest("one"));
    }
}

const FILES: [&str; 3] = ["000000.parquet", "000001.parquet", "000002.parquet"];

/// glibc chooses its functions by the processor; other ones are to change nothing.
#[test]
fn bytes_do_not_depend_on_the_processors_instructions() {
    let place = Workplace::sampled("random");
    let all = place.computed("all", &[]);
    let mut command = command();
    command.env("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2");
    command.arg("sweep").arg(place.path("sweep.toml")).arg("--out").arg(place.path("few"));
    assert!(command.output().expect("it runs").status.success());
    assert_eq!(place.cases("few"), all);
}

#[test]
fn a_killed_sweep_goes_on_with_whole_files() {
    let place = Workplace::sampled("random");
    let whole = place.computed("whole", &[]);
    let mut child = command();
    child.arg("sweep").arg(place.path("sweep.toml")).arg("--out").arg(place.path("killed")).stderr(Stdio::null());
    let mut child = child.stdout(Stdio::null()).spawn().expect("it runs");
    let first = place.path("killed").join("cases").join(FILES[0]);
    let begin = Instant::now();
    while !first.exists() && begin.elapsed() < Duration::from_secs(60) {
        thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("killed");
    child.wait().expect("over");
    for (name, bytes) in place.cases("killed") {
        assert_eq!(bytes, whole[&name], "a file that is there is whole");
    }
    // neither a file of other rows nor half a file is taken for one that is done
    fs::copy(place.path("whole").join("cases").join(FILES[1]), first).expect("copied");
    let half = place.path("killed").join("cases").join(FILES[2]);
    fs::write(half, &whole[Path::new(FILES[2])][..100]).expect("written");
    assert_eq!(place.computed("killed", &[]), whole);
    assert_eq!(fs::read_dir(place.path("killed").join("cases")).expect("a folder").count(), 3, "nothing temporary");
}

/// Everything in a folder of results but times, by its path.
fn all_but_times(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let (mut files, mut folders) = (BTreeMap::new(), vec![folder.to_owned()]);
    while let Some(inner) = folders.pop() {
        for entry in fs::read_dir(inner).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.strip_prefix(folder).expect("inside").to_owned();
            if path.is_dir() {
                folders.extend((name != Path::new("timing")).then_some(path));
            } else {
                files.insert(name, fs::read(&path).expect("a file"));
            }
        }
    }
    files
}

/// Where one sweep is refused, what differs from the other is said; shards of one sweep go on together.
#[test]
fn of_two_sweeps_at_once_one_has_the_folder() {
    let place = Workplace::sampled("random");
    let text = fs::read_to_string(place.path("sweep.toml")).expect("a sweep");
    fs::write(place.path("other.toml"), text.replace("seed = 1", "seed = 2")).expect("written");
    let start = |sweep: &str, out: &str, more: &[&str]| {
        let mut command = command();
        command.arg("sweep").arg(place.path(sweep)).arg("--out").arg(place.path(out)).args(["-q", "--threads", "1"]);
        command.args(more).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it runs")
    };
    let ended = |child: std::process::Child| said(child.wait_with_output().expect("it ends"));
    let whole = ["sweep.toml", "other.toml"].map(|sweep| {
        let out = sweep.replace(".toml", "");
        assert_eq!(ended(start(sweep, &out, &[])).0, 0);
        all_but_times(&place.path(&out))
    });
    for attempt in 0..12 {
        let out = format!("both{attempt}");
        let ends = ["sweep.toml", "other.toml"].map(|sweep| start(sweep, &out, &[])).map(ended);
        let first = ends.iter().position(|(code, ..)| *code == 0).expect("one has it");
        let (code, _, err) = &ends[1 - first];
        assert!(*code == 2 && err.contains("sweep.seed: was "), "attempt {attempt}: {code} {err}");
        assert_eq!(all_but_times(&place.path(&out)), whole[first], "attempt {attempt}");
        let out = format!("shards{attempt}");
        let shards = ["1/3", "2/3", "3/3"].map(|shard| start("sweep.toml", &out, &["--shard", shard])).map(ended);
        assert_eq!(shards.each_ref().map(|(code, ..)| *code), [0; 3], "{shards:?}");
        assert_eq!(all_but_times(&place.path(&out)), whole[0], "attempt {attempt}");
    }
}

/// A file with one bit other, of other cases, of another sweep, or without its digest is not taken for what was written.
#[test]
fn damaged_and_exchanged_files_are_computed_again() {
    let place = Workplace::sampled("random");
    place.computed("out", &[]);
    let whole = all_but_times(&place.path("out"));
    place.write(&SWEEP.replace("SAMPLING", "random").replace("seed = 1", "seed = 2"));
    place.computed("other", &[]);
    place.write(&SWEEP.replace("SAMPLING", "random"));
    let in_out = |name: &str| place.path("out").join(name);
    let flip = |at: fn(usize) -> usize| {
        let mut bytes = fs::read(in_out("cases/000001.parquet")).expect("a file");
        let at = at(bytes.len());
        bytes[at] ^= 1;
        fs::write(in_out("cases/000001.parquet"), bytes).expect("written");
    };
    let copy = |from: PathBuf, to: &str| {
        fs::copy(from, in_out(to)).expect("copied");
    };
    let damages: [(&str, &dyn Fn()); 7] = [
        ("has another SHA-256", &|| flip(|_| 8)),
        ("has another SHA-256", &|| flip(|length| length / 2)),
        ("has another SHA-256", &|| flip(|length| length - 1)),
        ("has another SHA-256", &|| copy(in_out("cases/000000.parquet"), "cases/000001.parquet")),
        ("000001.sha256: ", &|| fs::remove_file(in_out("digests/000001.sha256")).expect("removed")),
        ("it has the cases 0 to 3, expected 4 to 7", &|| {
            copy(in_out("cases/000000.parquet"), "cases/000001.parquet");
            let digest = fs::read_to_string(in_out("digests/000000.sha256")).expect("a digest");
            fs::write(in_out("digests/000001.sha256"), digest.replace("000000", "000001")).expect("written");
        }),
        ("it is of another sweep, by `sweep_sha256`", &|| {
            for name in ["cases/000001.parquet", "digests/000001.sha256"] {
                copy(place.path("other").join(name), name);
            }
        }),
    ];
    for (expected, damage) in damages {
        damage();
        // a report on what there is, for a shard that the file is not of
        let (code, _, err) = place.sweep("out", &["--shard", "1/3", "--report", "-q"]);
        let is_named = err.contains("000001.parquet is damaged, ") && err.contains(expected);
        assert!(code == 2 && is_named && !in_out("report.html").exists(), "{expected}: {err}");
        let (code, out, err) = place.sweep("out", &["-q"]);
        assert!(code == 0 && out.contains("4 of 12 cases computed"), "{expected}: {out}{err}");
        assert!(err.starts_with("warning: ") && err.contains(expected) && err.lines().count() == 1, "{err}");
        assert_eq!(all_but_times(&place.path("out")), whole, "{expected}");
        let (code, out, err) = place.sweep("out", &["-q"]);
        assert!(code == 0 && out.contains("0 of 12 cases computed") && err.is_empty(), "{out}{err}");
    }
}

/// A file of the same sweep of another scenario, or of the same scenario with another robot, is not taken either.
#[test]
fn files_of_another_scenario_or_robot_are_computed_again() {
    let place = Workplace::sampled("random");
    let [scenario, robot] = ["scenario.toml", "robot.toml"].map(|name| place.path(name));
    let layout = fs::read_to_string(file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    let text = fs::read_to_string(&scenario).expect("a scenario").replace("\"dual_arm_3r\"", "\"./robot.toml\"");
    let write = |scenario_text: &str, layout_text: &str| {
        fs::write(&scenario, scenario_text).expect("written");
        fs::write(&robot, layout_text).expect("written");
    };
    write(&text, &layout);
    let whole = place.computed("out", &[]);
    for (hash, other, heavier) in [
        ("scenario_sha256", text.replace("duration = 2.0", "duration = 2.5"), layout.clone()),
        ("layout_sha256", text.clone(), layout.replace("mass = 500.0", "mass = 480.0")),
    ] {
        write(&other, &heavier);
        place.computed(hash, &[]);
        write(&text, &layout);
        for name in ["cases/000001.parquet", "digests/000001.sha256"] {
            fs::copy(place.path(hash).join(name), place.path("out").join(name)).expect("copied");
        }
        assert_ne!(place.cases("out"), whole, "another {hash}, the same bytes");
        let (code, _, err) = place.sweep("out", &["-q"]);
        assert!(code == 0 && err.contains(&format!("it is of another sweep, by `{hash}`")), "{hash}: {code} {err}");
        assert_eq!(place.cases("out"), whole, "{hash}");
    }
}

/// The sweep of this folder is refused before anything is said about what computes it.
#[test]
fn what_is_no_folder_is_refused_first() {
    let place = Workplace::sampled("random");
    fs::write(place.path("file"), "mine").expect("written");
    let mut paths = vec![place.path("file"), place.path("file").join("below")];
    paths.extend(cfg!(unix).then(|| "/dev/null".into()));
    for path in paths {
        for more in [&[][..], &["--replay", "1"]] {
            let (code, out, err) = place.sweep(&path.display().to_string(), more);
            assert_eq!((code, &*out), (2, ""), "{err}");
            assert!(err.starts_with("error: ") && err.contains("is not a folder"), "{err}");
        }
    }
    assert_eq!(fs::read_to_string(place.path("file")).expect("a file"), "mine");
}

/// Nobody writes into these pipes: whoever opens one waits for good.
#[cfg(unix)]
#[test]
fn pipes_in_place_of_files_are_not_opened() {
    let place = Workplace::sampled("random");
    place.computed("out", &[]);
    let whole = all_but_times(&place.path("out"));
    let sweep = |out: &str| {
        let mut command = command();
        command.arg("sweep").arg(place.path("sweep.toml")).arg("--out").arg(place.path(out));
        said(within_a_minute(command))
    };
    for name in ["cases/000001.parquet", "digests/000002.sha256"] {
        let path = place.path("out").join(name);
        fs::remove_file(&path).expect("removed");
        make_pipe(&path);
        let (code, _, err) = sweep("out");
        assert!(code == 0 && err.contains("it is not a regular file"), "{err}");
        assert_eq!(all_but_times(&place.path("out")), whole, "{name}");
    }
    fs::create_dir(place.path("taken")).expect("a folder");
    make_pipe(&place.path("taken/manifest.json"));
    let (code, _, err) = sweep("taken");
    assert!(code == 2 && err.contains("manifest.json is not the manifest of a sweep"), "{err}");
}

#[test]
fn cases_grow_where_the_sampling_permits_and_nothing_else_changes() {
    for (sampling, can_grow) in [("random", true), ("sobol", true), ("latin_hypercube", false)] {
        let place = Workplace::sampled(sampling);
        let text = SWEEP.replace("SAMPLING", sampling);
        place.write(&text.replace("cases = 12", "cases = 10"));
        place.computed("out", &[]);
        place.write(&text);
        let (code, _, err) = place.sweep("out", &[]);
        if can_grow {
            assert_eq!(code, 0, "{err}");
            assert!(!err.contains("damaged"), "a file of fewer cases is as it was written: {err}");
            assert_eq!(place.cases("out"), place.computed("at_once", &[]), "{sampling}");
        } else {
            assert_eq!(code, 2);
            assert!(err.contains("cases: was 10, is 12") && err.contains("only the samplings"), "{err}");
        }
        place.write(&text.replace("cases = 12", "cases = 9"));
        let (code, _, err) = place.sweep("out", &[]);
        let why = if can_grow { "cases: was 12, is 9\n  (there are files of more)" } else { "only the samplings" };
        assert!(code == 2 && err.contains(why), "fewer cases: {err}");
        // a key that is new, and one that is gone
        for (from, to, change) in [
            ("min = 5.0", "min = 5.0, max = 15.0", "max: was nothing, is 15.0"),
            (", min = 5.0", "", "min: was 5.0, is nothing"),
        ] {
            place.write(&text.replace(from, to));
            let (code, _, err) = place.sweep("out", &[]);
            assert!(code == 2 && err.contains(&format!("sweep.vary[0].distribution.{change}")), "{err}");
        }
        place.write(&text.replace("std = 1.0", "std = 1.5"));
        let (code, _, err) = place.sweep("out", &[]);
        assert_eq!(code, 2);
        assert!(err.contains("sweep.vary[0].distribution.normal.std: was 1.0, is 1.5"), "{err}");
        place.write(&format!("# a comment\n{}", if can_grow { &text } else { "" }));
        if can_grow {
            assert_eq!(place.sweep("out", &[]).0, 0, "a comment changes nothing");
            let (code, _, err) = place.sweep("out", &["--dynamics", "graph"]);
            assert!(code == 2 && err.contains(r#"engine: was "generated", is "graph""#), "{err}");
        }
    }
    let place = Workplace::sampled("random");
    fs::create_dir(place.path("taken")).expect("a folder");
    fs::write(place.path("taken").join("notes.txt"), "mine").expect("written");
    let (code, _, err) = place.sweep("taken", &[]);
    assert!(code == 2 && err.contains("notes.txt"), "{err}");
    // what a file manager leaves is hidden
    fs::create_dir(place.path("opened")).expect("a folder");
    fs::write(place.path("opened").join(".DS_Store"), "").expect("written");
    let (code, _, err) = place.sweep("opened", &[]);
    assert_eq!(code, 0, "{err}");
}

/// A grid has all combinations, those of the last key fastest, and each key its own choices.
#[test]
fn a_grid_goes_through_the_last_key_fastest() {
    let place = Workplace::grid(
        r#"
        [[vary]]
        key = "target.target1.mass"
        distribution = { choice = [10.0, 11.0] }
        [[vary]]
        key = "target.target2.mass"
        distribution = { choice = [7.0, 8.0, 9.0] }
        "#,
    );
    place.computed("out", &[]);
    let number = |row: &BTreeMap<String, Field>, key: &str| match row[key] {
        Field::Double(value) => value,
        ref other => panic!("{key} is {other}"),
    };
    let rows = place.rows("out", 0);
    let found: Vec<_> =
        rows.iter().map(|row| ["target.target1.mass", "target.target2.mass"].map(|key| number(row, key))).collect();
    assert_eq!(found, [[10.0, 7.0], [10.0, 8.0], [10.0, 9.0], [11.0, 7.0], [11.0, 8.0], [11.0, 9.0]]);
}

#[test]
fn a_failed_case_is_a_row() {
    let place = Workplace::grid(
        r#"
        [[vary]]
        key = "target.target1.mass"
        distribution = { choice = [10.0, -1.0, 11.0, 12.0] }
        "#,
    );
    let (code, out, err) = place.sweep("out", &[]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("4 of 4 cases computed: 3 done, 1 refused"), "{out}");
    let rows = place.rows("out", 0);
    let status = |row: &BTreeMap<String, Field>| row["status"].to_string();
    assert_eq!(rows.iter().map(status).collect::<Vec<_>>(), [r#""done""#, r#""refused""#, r#""done""#, r#""done""#]);
    assert!(
        rows[1]["message"].to_string().contains("`target[0].mass` is -1.0, expected a mass in kg"),
        "{:?}",
        rows[2]
    );
    assert_eq!([&rows[1]["arm1_impulse_fx"], &rows[1]["captured"]], [&Field::Null; 2], "absent, not NaN");
    assert_eq!([&rows[3]["captured"], &rows[3]["message"]], [&Field::Bool(true), &Field::Null]);
    assert_eq!(rows[3]["case"], Field::Long(3));
}

#[test]
fn a_replay_is_the_row_of_its_case() {
    // what computes a layout with a zero alone is not what computes all cases: that of the case is the first
    let zero = SWEEP.replace("link[0].mass", "link[0].com[1]").replace("[9.0, 10.0]", "[0.0, 0.0, 0.01]");
    let place = Workplace::new(&zero.replace("SAMPLING", "random"));
    place.computed("out", &[]);
    let (code, _, err) = place.sweep("out", &["--replay", "7", "--report"]);
    assert_eq!(code, 0, "{err}");
    let replay = place.path("out").join("replay").join("000007");
    for name in ["scenario.toml", "layout.toml", "results/summary.json", "results/report.html"] {
        assert!(replay.join(name).exists(), "{name}");
    }
    assert!(err.contains("target.target1.mass = "), "{err}");
    let summary = fs::read(replay.join("results/summary.json")).expect("a summary");
    let case = &serde_json::from_slice::<Value>(&summary).expect("JSON")["cases"][0];
    let row = &place.rows("out", 1)[3];
    let exact = &case["impact"]["exact"];
    for (name, value) in [
        ("arm1_impulse_fx", &exact["impulses"][0][1]),
        ("target2_after_omega", &exact["target_twists_after"][1][0]),
        ("arm2_joint3_rate_after", &exact["joint_rates_after"][5]),
        ("approach_momentum_drift", &case["approach"]["momentum_drift"]),
        ("post_impact_energy_error", &case["post_impact"]["energy_error"]),
        ("least_distance", &case["clearance"]["besides_contacts"]["least_distance"]),
    ] {
        assert_eq!(row[name], Field::Double(value.as_f64().expect("a number")), "{name}");
    }
    assert!(!place.path("out").join("report.html").exists(), "that is the report on all cases");
    let (code, _, err) = place.sweep("out", &["--report"]);
    assert_eq!(code, 0, "{err}");
    let page = fs::read_to_string(place.path("out").join("report.html")).expect("a report");
    for expected in ["12 cases: 12 done", "Rank correlations", "--replay INDEX --report"] {
        assert!(page.contains(expected), "no `{expected}` in {page}");
    }
    if cfg!(feature = "figures") {
        assert!(page.contains("arm1_impulse_magnitude"), "no output in {page}");
    }
    let (code, _, err) = place.sweep("out", &["--replay", "12"]);
    assert!(code == 2 && err.contains("expected 0 to 11"), "{err}");
}

/// The numbers of a case in its summary, by the names of a sweep's columns: all but the designed rates, which it has not.
fn numbers_of(case: &Value, positions: [[f64; 2]; 2]) -> BTreeMap<String, Option<f64>> {
    let mut found = BTreeMap::new();
    let mut one = |name: &str, value: &Value| {
        assert!(found.insert(name.to_owned(), value.as_f64()).is_none(), "{name}");
    };
    let mut vector = |owner: &str, parts: [&str; 3], values: &Value| {
        parts.iter().enumerate().for_each(|(i, part)| one(&format!("{owner}_{part}"), &values[i]));
    };
    let joints: Vec<String> =
        ["arm1", "arm2"].iter().flat_map(|arm| (1..=3).map(move |k| format!("{arm}_joint{k}"))).collect();
    let (pose, twist) = (["yaw", "x", "y"], ["omega", "vx", "vy"]);
    let (impulse, momentum) = (["n", "fx", "fy"], ["l", "px", "py"]);
    let (approach, impact, after) = (&case["approach"], &case["impact"], &case["post_impact"]);
    let exact = &impact["exact"];
    for (when, phase) in [("approach", approach), ("end", after)] {
        vector(&format!("{when}_base"), pose, &phase["base_pose"]);
        vector(&format!("{when}_base"), twist, &phase["base_twist"]);
    }
    vector("base_after", twist, &exact["base_twist_after"]);
    vector("momentum_jump", momentum, &exact["momentum_jump"]);
    for (i, arm) in ["arm1", "arm2"].iter().enumerate() {
        vector(&format!("target{}_after", i + 1), twist, &exact["target_twists_after"][i]);
        vector(&format!("{arm}_impulse"), impulse, &exact["impulses"][i]);
        vector(&format!("{arm}_paper_impulse"), impulse, &impact["paper"]["impulses"][i]);
        vector(&format!("{arm}_mean_force"), impulse, &impact["contacts"][i]["mean_force"]);
    }
    for (i, [x, y]) in positions.into_iter().enumerate() {
        let contact = &impact["contacts"][i];
        assert_eq!(contact["arm"], format!("arm{}", i + 1));
        one(&format!("arm{}_miss", i + 1), &contact["miss"]);
        one(&format!("arm{}_impulse_magnitude", i + 1), &exact["impulse_magnitudes"][i]);
        // the contact point runs from the target's COM to the end effector
        let at = |k: usize| {
            let number = |value: &Value| value.as_f64().expect("a number");
            number(&approach["end_effector_poses"][i][k + 1]) - number(&contact["offset"][k])
        };
        one(&format!("target{}_miss", i + 1), &Value::from((at(0) - x).hypot(at(1) - y)));
    }
    for (k, joint) in joints.iter().enumerate() {
        one(&format!("{joint}_rate_after"), &exact["joint_rates_after"][k]);
        for (when, phase) in [("approach", approach), ("end", after)] {
            one(&format!("{when}_{joint}_angle"), &phase["joint_angles"][k]);
            one(&format!("{when}_{joint}_rate"), &phase["joint_rates"][k]);
        }
    }
    for (when, phase) in [("approach", approach), ("post_impact", after)] {
        for part in ["momentum_drift", "energy_error", "center_of_mass_drift", "path_error"] {
            one(&format!("{when}_{part}"), &phase[part]);
        }
    }
    let (clearance, residual) = (&case["clearance"], &after["remainder"]);
    for (name, value) in [
        ("contact_time", &approach["duration"]),
        ("least_distance", &clearance["besides_contacts"]["least_distance"]),
        ("least_distance_time", &clearance["besides_contacts"]["time"]),
        ("first_overlap", &clearance["first_overlap"]),
        ("kinetic_energy_before", &exact["kinetic_energy_before"]),
        ("kinetic_energy_after", &exact["kinetic_energy_after"]),
        ("residual_rigid_rate", &residual["rigid_rate"]),
        ("residual_base_rate", &residual["base_rate"]),
        ("residual_largest_joint_rate", &residual["largest_joint_rate"]),
    ] {
        one(name, value);
    }
    // where there is none, the summary does not mention it
    one("penetration", &Value::from(after["penetration"].as_f64().unwrap_or_default()));
    one("later_impacts", &Value::from(after["impacts"].as_array().map_or(0, Vec::len)));
    found
}

/// All outputs that there are, of robot, targets and impact: the numbers of the summary of the same case.
#[test]
fn every_output_is_a_number_of_the_summary() {
    let groups = all_groups();
    let place = Workplace::new(&format!(
        "name = \"all\"\nscenario = \"scenario.toml\"\ncases = 2\nseed = 1\n[[vary]]\nkey = \"target.target1.mass\"\n\
         distribution = {{ uniform = {{ min = 8.0, max = 12.0 }} }}\n[[vary]]\nkey = \"case.case2.target_twists.target2[0]\"\n\
         distribution = {{ uniform = {{ min = 0.1, max = 0.2 }} }}\n[collect]\noutputs = {groups:?}\n"
    ));
    let scenario = fs::read_to_string(place.path("scenario.toml")).expect("a scenario");
    // damped afterwards, so that a motion is left over
    let scenario = scenario.replace("duration = 2.0", "duration = 2.0\ncontrol = \"damping\"\nderivative_gain = 14.0")
        + "\n[contact]\nduration = 0.25\n";
    fs::write(place.path("scenario.toml"), scenario).expect("written");
    place.computed("out", &[]);
    let mut expected = numbers_of(&place.replayed(1), [[2.0, -2.0], [-2.0, 2.0]]);
    let row = &place.rows("out", 0)[1];
    let others =
        ["case", "captured", "status", "message", "target.target1.mass", "case.case2.target_twists.target2[0]"];
    let is_output = |name: &&String| !others.contains(&name.as_str()) && !name.ends_with("_designed_rate");
    for name in row.keys().filter(is_output) {
        let expected = expected.remove(name).unwrap_or_else(|| panic!("{name} is no number of the summary"));
        match (&row[name], expected) {
            (Field::Null, None) => {}
            // the miss of a target is a difference of other numbers
            (Field::Double(found), Some(expected)) if name.starts_with("target") && name.ends_with("_miss") => {
                assert!((found - expected).abs() < 1e-12, "{name}: {found}, {expected}");
            }
            (Field::Double(found), Some(expected)) => assert_eq!(found.to_bits(), expected.to_bits(), "{name}"),
            (found, expected) => panic!("{name} is {found}, expected {expected:?}"),
        }
    }
    assert_eq!(expected, BTreeMap::new(), "numbers that no column has");
}

/// Of several impacts an arm has the impulse and the mean force of the first in which it makes a contact.
#[test]
fn impulses_are_those_of_the_first_impact_of_an_arm() {
    let groups = all_groups();
    let place = Workplace::new(&format!(
        "name = \"later\"\nscenario = \"scenario.toml\"\ncase = \"half\"\ncases = 1\nseed = 1\n[[vary]]\nkey = \"target.ball.mass\"\n\
         distribution = {{ uniform = {{ min = 19.0, max = 21.0 }} }}\n[collect]\noutputs = {groups:?}\n"
    ));
    fs::copy(file("scenarios/elastic_rebound.toml"), place.path("scenario.toml")).expect("copied");
    place.computed("out", &[]);
    let case = place.replayed(0);
    let later = case["post_impact"]["impacts"].as_array().expect("later impacts");
    let impacts: Vec<&Value> = std::iter::once(&case["impact"]).chain(later).collect();
    let firsts = [0, 1].map(|arm| {
        let is_made = |impact: &&Value| impact["exact"]["impulses"][arm].is_array();
        impacts.iter().position(is_made).expect("both arms meet their targets")
    });
    assert_ne!(firsts[0], firsts[1], "one after the other");
    let row = &place.rows("out", 0)[0];
    for (arm, first) in firsts.into_iter().enumerate() {
        let name = format!("arm{}", arm + 1);
        let impact = impacts[first];
        let contact = impact["contacts"].as_array().expect("contacts").iter().find(|contact| contact["arm"] == name);
        let force = &contact.expect("its contact")["mean_force"];
        let expected = [
            ("impulse_magnitude", &impact["exact"]["impulse_magnitudes"][arm]),
            ("impulse_fx", &impact["exact"]["impulses"][arm][1]),
            ("impulse_fy", &impact["exact"]["impulses"][arm][2]),
            ("mean_force_fx", &force[1]),
        ];
        for (output, expected) in expected {
            let Field::Double(found) = row[&format!("{name}_{output}")] else { panic!("{name}_{output}") };
            assert_eq!(Some(found), expected.as_f64(), "{name}_{output}");
        }
    }
}

/// The time series of a case are those that a run of it writes, with rows as far apart as the sweep wants them.
#[test]
fn time_series_are_those_of_a_run() {
    let text = SWEEP.replace("SAMPLING", "random") + "[collect]\nseries = [9, 2]\n";
    let place = Workplace::new(&text);
    place.computed("out", &[]);
    let names = |out: &str| {
        let entries =
            fs::read_dir(place.path(out).join("series")).expect("a folder").map(|entry| entry.expect("an entry"));
        let mut names: Vec<_> = entries.map(|entry| entry.file_name().into_string().expect("UTF-8")).collect();
        names.sort();
        names
    };
    assert_eq!(names("out"), ["000002.csv", "000009.csv"]);
    for case in ["2", "9"] {
        let (code, _, err) = place.sweep("out", &["--replay", case]);
        assert_eq!(code, 0, "{err}");
        let [series, run] = [format!("series/00000{case}.csv"), format!("replay/00000{case}/results/case2.csv")]
            .map(|name| fs::read_to_string(place.path("out").join(name)).expect("a time series"));
        assert!(series == run, "case {case}");
    }
    place.write(&(text + "sample = 0.5\n"));
    place.computed("coarse", &[]);
    let series = fs::read_to_string(place.path("coarse/series/000002.csv")).expect("a time series");
    let times: Vec<f64> = series.lines().skip(1).filter_map(|row| row.split(',').next()?.parse().ok()).collect();
    // 20 s and 2 s, both with both of their ends
    let expected: Vec<f64> = (0..=40).chain(40..=44).map(|i| 0.5 * f64::from(i)).collect();
    assert!(times.len() == expected.len(), "{times:?}");
    assert!(times.iter().zip(&expected).all(|(time, expected)| (time - expected).abs() < 1e-9), "{times:?}");
}

/// A case that the audit objects to is none that is done, but has its numbers; and a scenario without targets captures nothing.
#[test]
fn a_case_that_fails_its_audit_is_a_row_with_numbers() {
    let place = Workplace::grid("[[vary]]\nkey = \"approach.step\"\ndistribution = { choice = [0.005, 0.2] }\n");
    let text = fs::read_to_string(file("scenarios/redysim_single_arm_3r.toml")).expect("a scenario");
    fs::write(place.path("scenario.toml"), text.replacen("duration = 20.0", "duration = 20.0\nstep = 0.01", 1))
        .expect("written");
    let (code, out, err) = place.sweep("out", &["--report"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("2 of 2 cases computed: 1 done, 1 audit failed"), "{out}");
    let rows = place.rows("out", 0);
    assert_eq!((&rows[0]["message"], &rows[0]["captured"]), (&Field::Null, &Field::Null));
    // the objections one after the other
    let message = rows[1]["message"].to_string();
    let objections = message.matches("over its bound").count();
    assert!(objections > 1 && message.split("; ").count() == objections, "{message}");
    let drift = |row: &BTreeMap<String, Field>| match row["approach_momentum_drift"] {
        Field::Double(drift) => drift,
        ref other => panic!("{other} is no number"),
    };
    assert!(drift(&rows[0]) < 1e-9 && drift(&rows[1]) > 1e-9, "{} and {}", drift(&rows[0]), drift(&rows[1]));
    let page = fs::read_to_string(place.path("out/report.html")).expect("a report");
    assert!(page.contains("over its bound") && !page.contains("captured in"), "{page}");
}

#[test]
fn shards_and_numbers_of_cases_that_there_are_not_are_refused() {
    let place = Workplace::sampled("random");
    let (code, out, err) = place.sweep("out", &["--threads", "0"]);
    assert!(code == 2 && out.is_empty() && err.contains("expected a whole number of threads, at least 1"), "{err}");
    let twice = "[[vary]]\nkey = 'target.target1.mass'\ndistribution = { choice = [1.0] }\n".repeat(2);
    let text = format!("name = 'a'\nscenario = 'scenario.toml'\ncases = 2\nseed = 1\n{twice}");
    let report = Campaign::parse(&text, "sweep.toml", place.0.path(), SHIPPED).expect_err("a key that varies twice");
    assert!(report.to_string().contains("it varies already, there is one `vary` for a key"), "{report}");
    for shard in ["0/3", "4/3", "1/0", "1"] {
        let (code, out, err) = place.sweep("out", &["--shard", shard]);
        assert!(code == 2 && out.is_empty() && err.contains("--shard"), "{shard}: {code} {out}{err}");
    }
    let varied = "[[vary]]\nkey = \"target.target1.mass\"\ndistribution = { choice = [10.0, 11.0, 12.0] }\n";
    for (cases, is_fine) in [(2, false), (3, true), (4, false)] {
        let text = format!(
            "name = \"g\"\nscenario = \"scenario.toml\"\nseed = 1\nsampling = \"grid\"\ncases = {cases}\n{varied}"
        );
        let said = Campaign::parse(&text, "sweep.toml", place.0.path(), SHIPPED).err().map(|report| report.to_string());
        assert_eq!(said.is_none(), is_fine, "{cases}: {said:?}");
        assert!(said.is_none_or(|said| said.contains("sweep.toml:5:") && said.contains("the grid has 3 combinations")));
    }
    // two keys have one rank correlation, in whatever order they are named
    let keys = ["target.target1.mass", "approach.proportional_gain[2]"];
    let pair = |[a, b]: [&str; 2], rank: f64| format!("[[correlation]]\nkeys = ['{a}', '{b}']\nrank = {rank}\n");
    for (second, refused) in [(None, false), (Some(keys), true), (Some([keys[1], keys[0]]), true)] {
        let second = second.map_or_else(String::new, |keys| pair(keys, 0.2));
        let text = SWEEP.replace("SAMPLING", "random") + &pair(keys, 0.5) + &second;
        let said = Campaign::parse(&text, "sweep.toml", place.0.path(), SHIPPED).err().map(|report| report.to_string());
        assert_eq!(said.is_some(), refused, "{said:?}");
        assert!(said.is_none_or(|said| said.contains("two keys have one rank correlation")));
    }
}

#[test]
#[cfg(unix)]
fn an_interrupt_ends_a_sweep_within_a_case() {
    let place = Workplace::new(&SWEEP.replace("SAMPLING", "random").replace("cases = 12", "cases = 100000"));
    let mut child = command();
    child.arg("sweep").arg(place.path("sweep.toml")).arg("--out").arg(place.path("out")).stderr(Stdio::null());
    let mut child = child.stdout(Stdio::null()).spawn().expect("it runs");
    let first = place.path("out").join("cases").join(FILES[0]);
    while !first.exists() {
        thread::sleep(Duration::from_millis(5));
    }
    let killed = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(killed.expect("it runs").success());
    let begin = Instant::now();
    assert_eq!(child.wait().expect("over").code(), Some(130));
    assert!(begin.elapsed() < Duration::from_secs(20), "{:?}", begin.elapsed());
}

#[test]
fn keys_and_distributions_that_are_wrong_are_shown_with_their_lines() {
    const DISTRIBUTION: &str = "{ uniform = { min = 1.0, max = 2.0 } }";
    let wrong_keys = [
        ("target.target1.mas", "did you mean `target.target1.mass`?"),
        ("target.tarjet1.mass", "did you mean `target1`?"),
        ("base.mass", "did you mean `layout.base.mass`?"),
        ("target.target1", "it is a table"),
        ("target.target1.name", "a `name` cannot vary"),
        ("target[0].mass", "these tables have names"),
        ("layout.arm.arm1.link[9].mass", "expected `link[0]` to `link[2]`"),
        ("approach.duration[0]", "which has no elements"),
        ("approach.proportional_gain[6]", "there is no element 6"),
        ("approach..duration", "expected a key at `.duration`"),
        ("limits.joint_rates[0]", "is not given"),
        ("initial.joint_angles", "expected one element of it"),
        ("case.case1.target_twists.target1[0]", "the sweep computes the case `case2`"),
        ("post_impact.derivative_gain[0]", "is not given"),
        (
            "target.target1.twist[0]",
            "it has no effect: the case `case2` has a value of its own, `case.case2.target_twists.target1[0]`",
        ),
    ];
    let place = Workplace::sampled("random");
    for (key, expected) in wrong_keys {
        place.write(&format!(
            "name = 'a'\nscenario = 'scenario.toml'\ncases = 2\nseed = 1\n[[vary]]\nkey = '{key}'\ndistribution = {DISTRIBUTION}\n"
        ));
        let (code, _, err) = place.sweep("out", &[]);
        assert!(code == 2 && err.contains("sweep.toml:6:7") && err.contains(expected), "{key}: {err}");
    }
    let wrong_distributions = [
        ("{ normal = { mean = 1.0, std = -1.0 } }", "std"),
        ("{ normal = { mean = 1.0 } }", "missing key"),
        ("{ gauss = { mean = 1.0, std = 1.0 } }", "unknown key"),
        ("{ uniform = { min = 2.0, max = 1.0 } }", "expected a `min` below `max`"),
        ("{ uniform = { min = 1.0, max = 2.0 }, min = 3.0 }", "its bounds leave nothing of it"),
        ("{ triangular = { min = 1.0, mode = 3.0, max = 2.0 } }", "`min` ≤ `mode` ≤ `max`"),
        ("{ lognormal = { mean = -1.0, std = 1.0 } }", "greater than 0"),
        ("{ lognormal = { mean = 1e-100, std = 1e100 } }", "a `std` of 1e100 with a `mean` of 1e-100 is beyond"),
        ("{ lognormal = { mean = 1e100, std = 1e-100 }, min = 1e100 }", "a `std` of 1e-100 with a `mean` of 1e100 is"),
        ("{ choice = [] }", "at least one"),
        ("{ choice = [1.0, 'a'] }", "at least one number, or text"),
        ("{ choice = [1.0], max = 2.0 }", "a choice has no bounds"),
    ];
    for (distribution, expected) in wrong_distributions {
        place.write(&format!(
            "name = 'a'\nscenario = 'scenario.toml'\ncases = 2\nseed = 1\n[[vary]]\nkey = 'target.target1.mass'\ndistribution = {distribution}\n"
        ));
        let (code, _, err) = place.sweep("out", &[]);
        assert!(code == 2 && err.contains("sweep.toml:") && err.contains(expected), "{distribution}: {err}");
    }
    assert!(!place.path("out").exists(), "nothing was written");
}

/// A process that began with fewer cases ends after one with more: the last file keeps all of its cases.
#[test]
fn a_sweep_of_fewer_cases_that_ends_later_takes_none_away() {
    let place = Workplace::sampled("random");
    let of_cases = |cases: usize| {
        let text = SWEEP.replace("SAMPLING", "random").replace("cases = 12", &format!("cases = {cases}"));
        Campaign::parse(&text, "sweep.toml", place.0.path(), SHIPPED).expect("a sweep")
    };
    let (folder, fewer, more) = (place.path("out"), of_cases(10), of_cases(12));
    let plan = |campaign| Plan::new(campaign, &folder, Shard::WHOLE).expect("a plan");
    let compute = |campaign: &Campaign, plan: &Plan| {
        let (choice, _) = Choice::fastest(&campaign.general_layout(), Robots::SHIPPED);
        run(campaign, &choice, &folder, plan, 1, &Tally::default()).expect("files");
    };
    let slow = plan(&fewer);
    assert_eq!((slow.blocks.as_slice(), slow.cases), (&[0, 1, 2][..], 10));
    compute(&more, &plan(&more));
    let whole = place.cases("out");
    compute(&fewer, &slow);
    assert_eq!(place.cases("out"), whole);
    assert_eq!(plan(&more).present, 12);
    // and in the usual order the later one has more
    fs::remove_dir_all(&folder).expect("removed");
    compute(&fewer, &plan(&fewer));
    assert_ne!(place.cases("out"), whole);
    compute(&more, &plan(&more));
    assert_eq!(place.cases("out"), whole);
}

/// A robot at rest that a disc comes to, as far aside of the end effector as `position[0]` says, if it comes at all.
fn coming_disc(place: &Workplace) {
    let text = "name = 'disc'\nlayout = 'single_arm_2r'\n[initial]\njoint_angles = [0.4, -0.8]\n[approach]\nduration = 4.0\n\
        trajectory = 'cycloidal'\ntracking = 'exact'\nfinal_joint_angles = [0.4, -0.8]\n[contact]\ndetection = 'event'\n\
        duration = 0.25\n[[target]]\nname = 'disc'\narm = 'arm1'\nmass = 5.0\ninertia = 0.1\nradius = 0.2\n\
        position = [2.5, -3.0]\ntwist = [0.0, 0.0, 1.0]\n[post_impact]\nduration = 1.0\n";
    fs::write(place.path("scenario.toml"), text).expect("written");
}

/// Of discs that come by, those that the end effector meets are captured: in the rows, and their share on the page. Cases without
/// a result are no part of it.
#[test]
fn the_captured_share_is_that_of_the_cases_that_capture() {
    let place = Workplace::grid(
        "[[vary]]\nkey = \"target.disc.position[0]\"\ndistribution = { choice = [TIP, 9.0, NEAR, 7.0, 8.0] }\n\
         [[vary]]\nkey = \"target.disc.mass\"\ndistribution = { choice = [5.0, 6.0, -5.0] }\n",
    );
    coming_disc(&place);
    let layout = planar_proof::layout("single_arm_2r");
    let mut tip = [[0.0; 3]];
    planar_capture::registry::generic(&layout).end_effector_poses(&[0.0; 3], &[0.4, -0.8], &mut tip).expect("a pose");
    let text = fs::read_to_string(place.path("sweep.toml")).expect("a sweep");
    let [x, near] = [tip[0][1], tip[0][1] + 0.1].map(|x| format!("{x:?}"));
    place.write(&text.replace("TIP", &x).replace("NEAR", &near));
    let (code, _, err) = place.sweep("out", &["--report"]);
    assert_eq!(code, 0, "{err}");
    let rows = place.rows("out", 0);
    let captured: Vec<&Field> = rows.iter().map(|row| &row["captured"]).collect();
    let [yes, no, none] = [&Field::Bool(true), &Field::Bool(false), &Field::Null];
    assert_eq!(captured, [yes, yes, none, no, no, none, yes, yes, none, no, no, none, no, no, none]);
    let page = fs::read_to_string(place.path("out/report.html")).expect("a report");
    assert!(page.contains("captured in <b>4</b> of 10 cases with a result, 40.0\u{a0}%"), "{page}");
}

/// A design that fails and a simulation that stops are rows of their own status, with what the command would say.
#[test]
fn designs_that_fail_are_rows_with_their_messages() {
    let place = Workplace::grid(
        "[[vary]]\nkey = \"approach.final_end_effector_poses[0][0]\"\ndistribution = { choice = [2.2, 30.0] }\n",
    );
    fs::copy(file("scenarios/spinning_target.toml"), place.path("scenario.toml")).expect("copied");
    let text = fs::read_to_string(place.path("scenario.toml")).expect("a scenario");
    let one = text.replace("[[case]]\nname = \"pin\"\nkinds = { disc = \"pin\" }\n", "");
    assert_ne!(one, text);
    fs::write(place.path("scenario.toml"), &one).expect("written");
    let (code, out, err) = place.sweep("out", &[]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("2 of 2 cases computed: 1 done, 1 stopped"), "{out}");
    let rows = place.rows("out", 0);
    assert_eq!([&rows[0]["status"], &rows[1]["status"]].map(ToString::to_string), [r#""done""#, r#""stopped""#]);
    fs::write(place.path("far.toml"), one.replace("[[2.2, -0.9]]", "[[30.0, -0.9]]")).expect("written");
    let mut run = command();
    run.arg("run").arg(place.path("far.toml")).arg("--out").arg(place.path("run"));
    let (code, _, said) = said(run.output().expect("it runs"));
    let Field::Str(message) = &rows[1]["message"] else { panic!("{:?}", rows[1]["message"]) };
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(code != 0 && words(&said).contains(&words(message)), "{message}\n{said}");
}

/// A report on a part of a sweep, and the summary beside it, call it one until the rest is there.
#[test]
fn a_part_of_a_sweep_is_called_one() {
    let place = Workplace::sampled("latin_hypercube");
    let page = || fs::read_to_string(place.path("out/report.html")).expect("a report").replace("<wbr>", "");
    let (code, out, err) = place.sweep("out", &["--shard", "1/3", "--report", "-q"]);
    assert_eq!(code, 0, "{err}");
    let part = "8 of the sweep's cases are not here: statistics are of this part alone, which covers the ranges of the \
                keys less evenly than the whole Latin hypercube";
    assert!(out.contains("4 of 12 cases computed: 4 done, 8 are not there yet\n"), "{out}");
    assert!(out.contains(&format!("Of the report: {part}\n")), "{out}");
    let shown = page().replace("&apos;", "'").replace("&#39;", "'");
    assert!(shown.contains("<p>4 of 12 cases: 4 done.") && shown.contains(part), "{shown}");
    // keys have their units
    assert!(shown.contains("<td>target.target1.mass [kg]</td><td>normal, mean 10,"), "{shown}");
    assert!(shown.contains("<td>layout.arm.arm1.link[0].mass [kg]</td><td>one of 9.0, 10.0"), "{shown}");
    let (code, out, err) = place.sweep("out", &["--report", "-q"]);
    assert_eq!(code, 0, "{err}");
    assert!(!out.contains("not there") && !out.contains("part") && page().contains("<p>12 cases: 12 done."), "{out}");
}

/// Of the last file of a sweep that had fewer cases, those that it has not are not there, whoever is to compute them; and nor
/// are those of a file of another sweep.
#[test]
fn cases_that_a_shorter_sweep_has_not_are_not_there() {
    let place = Workplace::sampled("random");
    let sweep = |cases: &str| SWEEP.replace("SAMPLING", "random").replace("cases = 12", cases);
    place.write(&sweep("cases = 6"));
    assert_eq!(place.computed("out", &[]).len(), 2);
    place.write(&sweep("cases = 12"));
    let (code, out, err) = place.sweep("out", &["--shard", "1/3", "--report", "-q"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("0 of 12 cases computed: 4 were there before, 6 are not there yet\n"), "{out}");
    assert!(out.contains("Of the report: 6 of the sweep's cases are not here"), "{out}");
    assert_eq!(place.computed("out", &[]), Workplace::sampled("random").computed("whole", &[]));
    let other = place.path("out/cases").join(FILES[1]);
    fs::write(other, "of something else").expect("written");
    let (code, out, err) = place.sweep("out", &["--shard", "1/3", "-q"]);
    assert!(code == 0 && out.contains("4 were there before, 4 are not there yet\n"), "{out}{err}");
}

/// A file of a shard has the cases of its block, by the numbers that they have in the whole sweep.
#[test]
fn cases_of_a_shard_have_the_numbers_of_the_whole_sweep() {
    let place = Workplace::sampled("sobol");
    place.computed("out", &["--shard", "3/3"]);
    let file = fs::File::open(place.path("out/cases").join(FILES[2])).expect("a file");
    let reader = SerializedFileReader::new(file).expect("Parquet");
    let rows = reader.get_row_iter(None).expect("rows").map(|row| row.expect("a row"));
    let cases: Vec<Field> = rows.map(|row| row.get_column_iter().next().expect("a column").1.clone()).collect();
    assert_eq!(cases, [8, 9, 10, 11].map(Field::Long));
}

/// Results of another version of the program may have other bits: they are refused, and both versions are said.
#[test]
fn results_of_another_version_are_refused() {
    let place = Workplace::sampled("random");
    place.computed("out", &["--shard", "1/3"]);
    let path = place.path("out/manifest.json");
    let text = fs::read_to_string(&path).expect("a manifest");
    let own = format!("\"version\": \"{}\"", env!("CARGO_PKG_VERSION"));
    assert!(text.contains(&own), "{text}");
    fs::write(&path, text.replace(&own, "\"version\": \"0.0.1\"")).expect("written");
    let (code, _, err) = place.sweep("out", &[]);
    let change = format!("version: was \"0.0.1\", is \"{}\"", env!("CARGO_PKG_VERSION"));
    assert!(code == 2 && err.contains(&change), "{err}");
    assert_eq!(place.cases("out").len(), 1, "nothing was computed");
}

/// The unit of a column by its name, as in the summary; `None` for what has none.
fn unit_of(name: &str) -> Option<&'static str> {
    let of_end = [
        ("_impulse_n", "N m s"),
        ("_impulse_fx", "N s"),
        ("_impulse_fy", "N s"),
        ("_impulse_magnitude", "N s"),
        ("_mean_force_n", "N m"),
        ("_mean_force_fx", "N"),
        ("_mean_force_fy", "N"),
        ("momentum_jump_l", "N m s"),
        ("momentum_jump_px", "N s"),
        ("momentum_jump_py", "N s"),
        ("kinetic_energy_before", "J"),
        ("kinetic_energy_after", "J"),
        ("_path_error", "rad or m"),
        ("_angle", "rad"),
        ("_yaw", "rad"),
        ("_rate", "rad/s"),
        ("_rate_after", "rad/s"),
        ("_omega", "rad/s"),
        ("_vx", "m/s"),
        ("_vy", "m/s"),
        ("_x", "m"),
        ("_y", "m"),
        ("_miss", "m"),
        ("penetration", "m"),
        ("least_distance", "m"),
        ("_time", "s"),
        ("first_overlap", "s"),
    ];
    of_end.into_iter().find(|(end, _)| name.ends_with(end)).map(|(_, unit)| unit)
}

/// Every column of outputs has the unit of its quantity, in the file and on the page.
#[test]
fn columns_have_the_units_of_their_quantities() {
    let groups = all_groups();
    let place = Workplace::new(&format!(
        "name = 'units'\nscenario = 'scenario.toml'\ncases = 12\nseed = 1\n[[vary]]\nkey = 'target.target1.mass'\n\
         distribution = {{ uniform = {{ min = 8.0, max = 12.0 }} }}\n[collect]\noutputs = {groups:?}\n"
    ));
    let scenario =
        fs::read_to_string(place.path("scenario.toml")).expect("a scenario") + "\n[contact]\nduration = 0.25\n";
    fs::write(place.path("scenario.toml"), scenario).expect("written");
    place.computed("out", &["--report"]);
    let text = fs::read_to_string(place.path("sweep.toml")).expect("a sweep");
    let campaign = Campaign::parse(&text, "sweep.toml", place.0.path(), SHIPPED).expect("a sweep");
    let all = outputs(&campaign.scenario, &OutputGroup::ALL.map(|(_, group)| group));
    let without = ["_drift", "_energy_error", "later_impacts"];
    for output in &all {
        let none = without.iter().any(|end| output.name.ends_with(end));
        assert_eq!(
            (unit_of(&output.name).is_none(), output.unit),
            (none, unit_of(&output.name).unwrap_or_default()),
            "{output:?}"
        );
    }
    let page = fs::read_to_string(place.path("out/report.html")).expect("a report");
    let page = page.replace("<wbr>", "");
    let shown = |name: &str| page.split(&format!("<td>{name} <small>")).nth(1).and_then(|rest| rest.split('<').next());
    for name in
        ["arm1_mean_force_fx", "arm2_mean_force_n", "kinetic_energy_after", "arm1_impulse_n", "target1_after_vx"]
    {
        assert_eq!(shown(name), unit_of(name), "{name}");
    }
}
