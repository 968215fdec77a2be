//! Folders of results: one run each, refused or replaced whole; what killed runs leave behind; the run's manifest.

use crate::{command, said};
use planar_capture::capture::{Silent, study};
use planar_capture::layout::sha256;
use planar_capture::output::result_folder::ResultFolder;
use planar_capture::output::run_manifest::RunManifest;
use planar_capture::output::summary::summary;
use planar_capture::registry;
use planar_capture::scenario::Scenario;
use planar_proof::file;
use serde_json::Value;
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// The shortest study with a capture, under a name and with these cases.
fn scenario(name: &str, cases: &[&str], folder: &Path) -> String {
    let text = fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
    let (head, _) = text.split_once("[[case]]").expect("cases");
    let cases = cases.iter().map(|case| format!("[[case]]\nname = \"{case}\"\n")).collect::<Vec<_>>().concat();
    let text =
        format!("{head}{cases}[post_impact]\nduration = 1.0\n").replacen("raina_shah_2017\"", &format!("{name}\""), 1);
    let path = folder.join(format!("{name}.toml"));
    fs::write(&path, text).expect("written");
    path.display().to_string()
}

/// The sorted names in a folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<_> =
        entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8")).collect();
    names.sort();
    names
}

/// Runs a scenario into a folder: exit code and messages.
fn run(scenario: &str, results: &Path, more: &[&str]) -> (i32, String) {
    let results = results.display().to_string();
    let (code, _, err) = said(&[&["run", scenario, "--out", &results, "--dynamics", "generated"], more].concat());
    (code, err)
}

#[test]
fn a_run_replaces_an_earlier_one_of_its_scenario_whole() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("new/results");
    let one = scenario("one", &["a", "b"], folder.path());
    assert_eq!(run(&one, &results, &["--report"]), (0, String::new()));
    assert_eq!(names(&results), ["a.csv", "b.csv", "report.html", "summary.json"]);
    assert_eq!(names(&folder.path().join("new")), ["results"], "no temporary files");
    scenario("one", &["b", "c"], folder.path());
    let (code, err) = run(&one, &results, &[]);
    assert_eq!(names(&results), ["b.csv", "c.csv", "summary.json"], "nothing of the earlier run is left");
    let said = format!("removed from {}, as this run has no such files: report.html, a.csv\n", results.display());
    assert_eq!((code, err), (0, said));
    // once
    assert_eq!(run(&one, &results, &[]), (0, String::new()));
}

/// Another file of the same scenario's name is said to replace the one before; one that was edited is the same file.
#[test]
fn results_of_another_file_are_replaced_with_a_word() {
    let folder = TempDir::new().expect("a folder");
    let [results, other] = ["results", "other"].map(|name| folder.path().join(name));
    fs::create_dir(&other).expect("made");
    let [first, second] = [folder.path(), &other].map(|place| scenario("one", &["a"], place));
    assert_eq!(run(&first, &results, &[]), (0, String::new()));
    // equal texts are the same study
    assert_eq!(run(&second, &results, &[]), (0, String::new()));
    scenario("one", &["b"], folder.path());
    let (code, err) = run(&first, &results, &[]);
    assert!(code == 0 && err.lines().count() == 1, "{err}");
    assert!(err.contains("the results of another file were in ") && err.contains(&second), "{err}");
    scenario("one", &["c"], folder.path());
    let (code, err) = run(&first, &results, &[]);
    assert!(code == 0 && err.lines().count() == 1 && err.ends_with("no such files: b.csv\n"), "{err}");
}

/// The folder of several runs holds none itself: `--force`, which would delete them, is no advice.
#[test]
fn a_folder_of_several_runs_is_not_one_for_a_run() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    let [one, two] = ["one", "two"].map(|name| scenario(name, &["a"], folder.path()));
    for (scenario, name) in [(&one, "one"), (&two, "two")] {
        assert_eq!(run(scenario, &results.join(name), &[]), (0, String::new()));
    }
    let (code, err) = run(&one, &results, &[]);
    assert_eq!(code, 2);
    assert!(
        err.contains(
            "has the folders of other runs in it, `one` and 1 other: choose another folder, or a new one in it"
        ),
        "{err}"
    );
    assert!(!err.contains("--force"), "{err}");
    let (code, err) = run(&one, &results, &["--force"]);
    assert!(code == 2 && err.contains("--force would delete"), "{err}");
    assert_eq!(names(&results), ["one", "two"]);
    assert_eq!(run(&one, &results.join("new"), &[]), (0, String::new()));
}

/// A run inside another's folder would keep that from being replaced.
#[test]
fn the_folder_of_a_run_has_no_other_in_it() {
    let folder = TempDir::new().expect("a folder");
    let outer = folder.path().join("outer");
    let one = scenario("one", &["a"], folder.path());
    assert_eq!(run(&one, &outer, &[]), (0, String::new()));
    let refused = |(code, err): (i32, String)| {
        assert!(code == 2 && err.contains("outer, which holds the results of `one`"), "{err}");
    };
    for (inner, more) in [("inner", [].as_slice()), ("more/inner", &["--force"])] {
        refused(run(&one, &outer.join(inner), more));
    }
    let inner = outer.join("inner").display().to_string();
    let into = |command: &str, file: &str| {
        let (code, _, err) = said(&[command, file, "--out", &inner]);
        refused((code, err));
    };
    into("compare", "dual_arm_3r");
    #[cfg(feature = "sweep")]
    into("sweep", &file("scenarios/sweeps/uncertain_capture.toml").display().to_string());
    assert_eq!(names(&outer), ["a.csv", "summary.json"]);
    assert_eq!(run(&one, &outer.join("../beside"), &[]), (0, String::new()));
    assert_eq!(run(&one, &outer.join("absent/../../beside"), &[]), (0, String::new()));
    assert_eq!(names(&outer), ["a.csv", "summary.json"], "no folder is made on the way");
    assert_eq!(run(&one, &outer, &[]), (0, String::new()));
}

/// Cases by their names: the results are theirs, with the numbers that they have among all cases.
#[test]
fn some_cases_can_be_computed_alone() {
    let folder = TempDir::new().expect("a folder");
    let [all, some] = ["all", "some"].map(|name| folder.path().join(name));
    let path = scenario("it", &["a", "b", "c"], folder.path());
    let text = fs::read_to_string(&path).expect("a scenario");
    let own = "[[case]]\nname = \"own\"\nset = { \"approach.duration\" = 12.0 }\n[post_impact]";
    fs::write(&path, text.replacen("[post_impact]", own, 1)).expect("written");
    assert_eq!(run(&path, &all, &["--report"]), (0, String::new()));
    assert_eq!(run(&path, &some, &["--report", "--case", "own", "--case", "b"]), (0, String::new()));
    assert_eq!(names(&some), ["b.csv", "own.csv", "report.html", "summary.json"]);
    for name in ["b.csv", "own.csv"] {
        assert!(fs::read(all.join(name)).expect("a file") == fs::read(some.join(name)).expect("a file"), "{name}");
    }
    let page = fs::read_to_string(some.join("report.html")).expect("a report");
    assert!(page.contains("<title>it · planar-capture</title>"));
    assert!(page.contains("\"name\":\"b\"") && page.contains("\"name\":\"own\"") && !page.contains("\"name\":\"a\""));
    let (code, err) = run(&path, &some, &["--case", "d"]);
    assert!(code == 2 && err.contains("has no case `d`, expected one of `a`, `b`, `c`, `own`"), "{err}");
    let (code, err) = run(&path, &some, &["--case", "own"]);
    assert!(code == 0 && err.ends_with("no such files: report.html, b.csv\n"), "{err}");
    assert_eq!(names(&some), ["own.csv", "summary.json"], "of cases with values of their own alone");
}

#[test]
fn results_of_something_else_are_refused_unless_forced() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    let (one, other) = (scenario("one", &["a"], folder.path()), scenario("other", &["z"], folder.path()));
    assert_eq!(run(&one, &results, &[]).0, 0);
    let summary = fs::read(results.join("summary.json")).expect("a summary");
    let (code, err) = run(&other, &results, &[]);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("the results of `one`, not of `other`") && err.contains("--force"), "{err}");
    assert_eq!(fs::read(results.join("summary.json")).expect("a summary"), summary, "nothing was changed");

    fs::write(results.join("notes.txt"), "mine").expect("written");
    let (code, err) = run(&one, &results, &[]);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("`notes.txt`"), "{err}");
    assert_eq!(names(&results), ["a.csv", "notes.txt", "summary.json"]);

    fs::remove_file(results.join("notes.txt")).expect("removed");
    // an image where a run would have its figures
    fs::create_dir(results.join("figures")).expect("a folder");
    fs::write(results.join("figures/annotated.png"), "mine").expect("written");
    let (code, err) = run(&one, &results, &[]);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("`figures/annotated.png`"), "{err}");
    assert_eq!(names(&results.join("figures")), ["annotated.png"]);

    assert_eq!(run(&other, &results, &["--force"]), (0, String::new()));
    assert_eq!(names(&results), ["summary.json", "z.csv"]);
    // an empty folder is not from a run either, with any name
    for name in ["mine", "figures"] {
        fs::create_dir(results.join(name)).expect("a folder");
        let (code, err) = run(&other, &results, &[]);
        assert!(code == 2 && err.contains(&format!("has `{name}`, which is not from a run of `other`")), "{err}");
        fs::remove_dir(results.join(name)).expect("it is there");
    }
    // a folder of files that no run wrote
    let (code, err) = run(&one, folder.path(), &[]);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("which is not from a run"), "{err}");
}

/// `--force` does not delete the scenario, nor the folder that the user works in.
#[test]
fn what_force_does_not_delete() {
    let folder = TempDir::new().expect("a folder");
    let one = scenario("one", &["a"], folder.path());
    let (code, err) = run(&one, folder.path(), &["--force"]);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("would delete") && err.contains("one.toml"), "{err}");
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).expect("a folder");
    fs::write(inner.join("notes.txt"), "mine").expect("written");
    let output = command().args(["run", &one, "--out", ".", "--force"]).current_dir(&inner).output().expect("it runs");
    let (code, _, err) = planar_proof::said(output);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("--force would delete all in ., the working folder or your home folder"), "{err}");
    assert_eq!(names(&inner), ["notes.txt"]);
}

/// `--force` replaces files: not a folder with folders in it, or with hidden files, nor the user's own folder.
#[test]
fn force_is_for_folders_of_files() {
    let folder = TempDir::new().expect("a folder");
    let one = scenario("one", &["a"], folder.path());
    for (place, kept) in
        [("project/src/main.rs", "src"), ("hidden/.profile", ".profile"), ("deep/figures/old/x", "old")]
    {
        let file = folder.path().join(place);
        fs::create_dir_all(file.parent().expect("a folder")).expect("folders");
        fs::write(&file, "mine").expect("written");
        let top = folder.path().join(place.split('/').next().expect("a folder"));
        let (code, err) = run(&one, &top, &["--force"]);
        assert_eq!(code, 2, "{err}");
        assert!(err.contains("would delete") && err.contains(kept), "{err}");
        assert_eq!(fs::read(&file).expect("the file"), b"mine");
    }
    let home = folder.path().join("home");
    fs::create_dir(&home).expect("a folder");
    fs::write(home.join("notes.txt"), "mine").expect("written");
    let output =
        command().env("HOME", &home).args(["run", &one, "--force", "--out"]).arg(&home).output().expect("it runs");
    let (code, _, err) = planar_proof::said(output);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("would delete"), "{err}");
    assert_eq!(names(&home), ["notes.txt"]);
}

/// The study of this scenario fails: whatever is said instead was found before it was computed.
#[test]
fn what_is_no_folder_is_refused_before_anything_is_computed() {
    let folder = TempDir::new().expect("a folder");
    let bad = scenario("bad", &["a"], folder.path());
    let text = fs::read_to_string(&bad).expect("a scenario").replacen("gain = 49.0", "gain = 4.9e7", 1);
    fs::write(&bad, text).expect("written");
    let occupied = folder.path().join("occupied");
    fs::write(&occupied, "a file").expect("written");
    let mut paths = vec![occupied.clone(), occupied.join("below")];
    if cfg!(unix) {
        paths.extend(["/dev/null", "/dev/full", "/dev/null/below"].map(Into::into));
    }
    for path in paths {
        let (code, err) = run(&bad, &path, &[]);
        assert_eq!(code, 2, "{err}");
        assert!(err.contains("is not a folder"), "{}: {err}", path.display());
        let (code, err) = run(&bad, &path, &["--force"]);
        assert_eq!((code, err.contains("is not a folder")), (2, true), "{err}");
    }
    assert_eq!(fs::read_to_string(occupied).expect("a file"), "a file");
}

/// A limit of the system on the size of files is a full disk: a message, and nothing is left.
#[cfg(unix)]
#[test]
fn a_file_that_is_longer_than_allowed_is_an_error() {
    let folder = TempDir::new().expect("a folder");
    let one = scenario("one", &["a", "b", "c"], folder.path());
    let mut limited = Command::new("sh");
    limited.args(["-c", "ulimit -f 4; exec \"$0\" run \"$1\" -q --out results"]).arg(command().get_program()).arg(one);
    let (code, _, err) = planar_proof::said(limited.current_dir(folder.path()).output().expect("a shell"));
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("cannot write") && err.contains("too large"), "{err}");
    assert_eq!(names(folder.path()), ["one.toml"]);
}

/// The same for a file that is shorter than what is written at once; an older one stays as it is.
#[cfg(unix)]
#[test]
fn the_last_bytes_of_a_file_are_not_lost() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("l.toml");
    for content in [None, Some("older")] {
        if let Some(text) = content {
            fs::write(&path, text).expect("written");
        }
        let mut limited = Command::new("sh");
        limited
            .args(["-c", "ulimit -f 1; exec \"$0\" template layout --out l.toml --force"])
            .arg(command().get_program());
        let (code, _, err) = planar_proof::said(limited.current_dir(folder.path()).output().expect("a shell"));
        assert_eq!(code, 2, "{err}");
        assert!(err.contains("cannot write") && err.contains("too large"), "{err}");
        assert_eq!(fs::read_to_string(&path).ok().as_deref(), content);
        assert_eq!(names(folder.path()).len(), usize::from(content.is_some()));
    }
}

/// What a command writes is a file: `--force` puts none in the place of a pipe, and a link goes on to lead to its file.
#[cfg(unix)]
#[test]
fn files_are_not_put_in_the_place_of_other_things() {
    let folder = TempDir::new().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let run = |name: &str| {
        let mut command = command();
        command.args(["template", "layout", "--force", "--out"]).arg(path(name));
        let (code, _, err) = planar_proof::said(crate::within_a_minute(command));
        (code, err)
    };
    crate::make_pipe(&path("pipe"));
    fs::create_dir(path("inner")).expect("a folder");
    std::os::unix::fs::symlink(path("pipe"), path("to_pipe")).expect("a link");
    for name in ["pipe", "inner", "to_pipe"] {
        let (code, err) = run(name);
        assert!(code == 2 && err.contains("is a folder, a device or a pipe: choose another file"), "{name}: {err}");
        assert!(!path(name).metadata().expect("still there").is_file(), "{name}");
    }
    let (code, err) = run("new.toml/");
    assert!(code == 2 && err.contains("it ends as the path of a folder does"), "{err}");
    fs::write(path("old.toml"), "older").expect("written");
    std::os::unix::fs::symlink(path("old.toml"), path("link.toml")).expect("a link");
    assert_eq!(run("link.toml").0, 0);
    assert!(path("link.toml").is_symlink() && fs::read_to_string(path("old.toml")).expect("a file").contains("[base]"));
}

/// Nobody writes into this pipe: whoever opens it waits for good.
#[cfg(unix)]
#[test]
fn a_pipe_in_place_of_the_summary_is_refused_as_foreign() {
    let folder = TempDir::new().expect("a folder");
    let one = scenario("one", &["a"], folder.path());
    let results = folder.path().join("results");
    fs::create_dir(&results).expect("a folder");
    crate::make_pipe(&results.join("summary.json"));
    let mut command = command();
    command.args(["run", &one, "--out"]).arg(&results);
    let (code, _, err) = planar_proof::said(crate::within_a_minute(command));
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("has `summary.json`, which is not from a run"), "{err}");
    assert_eq!(names(&results), ["summary.json"]);
}

/// A name that temporary files have.
fn temporary(letter: char) -> String {
    format!(".planar-capture-{}", letter.to_string().repeat(24))
}

/// Names that begin in the same way are the user's, in the folder and above it.
#[test]
fn files_of_the_user_are_not_swept() {
    let folder = TempDir::new().expect("a folder");
    let one = scenario("one", &["a"], folder.path());
    let names = ["backup", "backup-2026", "2026-11-22-12-00-00-0000", "aaaaaaaaaaaaaaaaaaaaaaaaa"];
    let kept: Vec<_> = names.iter().map(|name| folder.path().join(format!(".planar-capture-{name}"))).collect();
    for path in &kept {
        fs::create_dir(path).expect("a folder");
        fs::write(path.join("mine"), "mine").expect("written");
    }
    let above = folder.path().join(temporary('a'));
    fs::create_dir(&above).expect("a folder");
    let results = folder.path().join("results");
    fs::create_dir(&results).expect("a folder");
    assert_eq!(run(&one, &results, &[]).0, 0);
    assert!(above.exists(), "a run works in its own folder");
    assert_eq!(run(&one, &folder.path().join("other"), &[]).0, 0);
    assert!(!above.exists(), "the second one made its folder here");
    for path in kept {
        assert_eq!(fs::read_to_string(path.join("mine")).expect("kept"), "mine");
    }
}

#[test]
fn temporary_files_of_killed_runs_are_swept() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    let one = scenario("one", &["a"], folder.path());
    assert_eq!(run(&one, &results, &[]).0, 0);
    fs::write(results.join(temporary('a')), "half").expect("written");
    fs::create_dir(results.join(temporary('b'))).expect("a folder");
    fs::write(results.join(temporary('b')).join("a.csv"), "half").expect("written");
    let alive = results.join(temporary('c'));
    let lock = File::create(&alive).expect("a file");
    lock.lock().expect("a lock");
    assert_eq!(run(&one, &results, &[]), (0, String::new()));
    assert_eq!(names(&results), [&temporary('c'), "a.csv", "summary.json"], "that of a living process stays");
    assert_eq!(names(folder.path()), ["one.toml", "results"]);
    drop(lock);
    assert_eq!(run(&one, &results, &[]), (0, String::new()));
    assert_eq!(names(&results), ["a.csv", "summary.json"]);
    // so are those of files
    let module = folder.path().join("robot.urdf");
    fs::write(folder.path().join(temporary('e')), "half").expect("written");
    assert_eq!(said(&["export", "dual_arm_3r", "--out", &module.display().to_string()]).0, 0);
    assert_eq!(names(folder.path()), ["one.toml", "results", "robot.urdf"]);
}

/// Whichever ends first has the folder; the other is refused, at its start or when its files would take their places.
#[test]
fn of_two_scenarios_at_once_one_has_the_folder() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    let shown = results.display().to_string();
    let scenarios = [scenario("one", &["a"], folder.path()), scenario("other", &["z"], folder.path())];
    for existing in [false, true] {
        if existing {
            fs::remove_dir_all(&results).expect("removed");
            fs::create_dir(&results).expect("a folder");
        }
        let start = |scenario| {
            let mut child = command();
            child.args(["run", scenario, "--out", &shown]).stdout(Stdio::null()).stderr(Stdio::piped());
            child.spawn().expect("it runs")
        };
        let children = scenarios.each_ref().map(|scenario| start(scenario));
        let ends = children.map(|child| planar_proof::said(child.wait_with_output().expect("it ends")));
        let first = ends.iter().position(|(code, ..)| *code == 0).expect("one succeeds");
        let (code, _, err) = &ends[1 - first];
        assert_eq!(*code, 2, "{err}");
        assert!(err.contains(["the results of `one`", "the results of `other`"][first]), "{err}");
        assert_eq!(names(&results), [["a.csv", "summary.json"], ["summary.json", "z.csv"]][first]);
        assert_eq!(names(folder.path()), ["one.toml", "other.toml", "results"]);
    }
}

/// What a folder holds is decided again when the results take their place.
#[test]
fn a_folder_that_another_run_has_filled_is_not_replaced() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    let objection = |_: &Path, names: &[String]| Some(format!("has {}", names[0]));
    let claimed =
        [false, false, true].map(|force| ResultFolder::claim(&results, force, &[], &objection).expect("ours"));
    let commit = |folder: &ResultFolder<'_>, name: &str| {
        let staged = folder.stage().expect("a place");
        staged.write(name, |_| Ok(())).expect("written");
        folder.commit(staged, name).map_err(|error| error.to_string())
    };
    let [first, second, forced] = &claimed;
    assert_eq!(commit(first, "x"), Ok(()));
    let error = commit(second, "y").expect_err("it is not ours");
    assert!(error.contains("has x: another run was there first") && error.contains("not written"), "{error}");
    assert_eq!(names(&results), ["x"]);
    assert_eq!(commit(forced, "y"), Ok(()));
    assert_eq!(names(&results), ["y"]);
}

/// The folder of a run that was killed while its files took their places: what is in it and in its temporary folder
/// after the old results began to go, and after the new ones began to come.
#[test]
fn results_of_a_killed_replacement_are_those_of_a_run() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    let (one, other) = (scenario("one", &["a", "b"], folder.path()), scenario("other", &["z"], folder.path()));
    for (away, waiting) in [("old", ["a.csv", "summary.json"]), ("new", ["b.csv", "summary.json"])] {
        assert_eq!(run(&one, &results, &[]).0, 0);
        let whole = fs::read(results.join("summary.json")).expect("a summary");
        let left = results.join(temporary('a'));
        fs::create_dir_all(left.join(away)).expect("folders");
        if away == "new" {
            fs::create_dir(left.join("replaced")).expect("a folder");
            fs::write(left.join("replaced/c.csv"), "old").expect("written");
        } else {
            fs::create_dir(left.join("new")).expect("a folder");
            fs::write(left.join("new/c.csv"), "new").expect("written");
        }
        for name in waiting {
            fs::rename(results.join(name), left.join(away).join(name)).expect("moved");
        }
        let (code, err) = run(&other, &results, &[]);
        assert_eq!(code, 2, "{err}");
        assert!(err.contains("the results of `one`, not of `other`"), "{err}");
        assert_eq!(names(&results), ["a.csv", "b.csv", "summary.json"], "{away}");
        assert_eq!(fs::read(results.join("summary.json")).expect("a summary"), whole);
    }
}

/// A mask that takes new folders from their owner is said, and nothing of the run stays.
#[cfg(unix)]
#[test]
fn a_mask_that_takes_the_owners_rights_is_refused() {
    let folder = TempDir::new().expect("a folder");
    let one = scenario("one", &["a"], folder.path());
    let results = folder.path().join("results").display().to_string();
    let script = "umask 777; exec \"$0\" run \"$1\" --out \"$2\" --dynamics generated";
    let run = Command::new("sh").args(["-c", script, env!("CARGO_BIN_EXE_planar-capture"), &one, &results]).output();
    let run = run.expect("a shell");
    let said = String::from_utf8(run.stderr).expect("UTF-8");
    assert_eq!(run.status.code(), Some(2), "{said}");
    assert!(said.contains("the process's mask takes the rights of new folders from their owner"), "{said}");
    assert_eq!(names(folder.path()), ["one.toml"]);
}

/// A run that is killed at any time leaves the results that were there or its own, never a mixture.
#[cfg(unix)]
#[test]
fn a_killed_run_leaves_whole_results() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    let one = scenario("one", &["a", "b", "c"], folder.path());
    let shown = results.display().to_string();
    assert_eq!(run(&one, &results, &["--report"]).0, 0);
    for wait in (0..40).map(|i| 10 * i) {
        let mut child = command();
        child.args(["run", &one, "--out", &shown, "--report"]).stdout(Stdio::null());
        let mut child = child.spawn().expect("it runs");
        std::thread::sleep(std::time::Duration::from_millis(wait));
        child.kill().expect("killed");
        child.wait().expect("it ends");
        let complete = results.join("summary.json").exists();
        let mut found = names(&results);
        found.retain(|name| !name.starts_with(".planar-capture-"));
        if complete {
            assert_eq!(found, ["a.csv", "b.csv", "c.csv", "report.html", "summary.json"], "killed after {wait} ms");
        }
    }
    assert_eq!(run(&one, &results, &["--report"]), (0, String::new()));
    assert_eq!(names(&results), ["a.csv", "b.csv", "c.csv", "report.html", "summary.json"]);
    assert_eq!(names(folder.path()), ["one.toml", "results"]);
}

#[test]
fn a_comparison_has_a_folder_of_its_own() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results").display().to_string();
    let compare = |layout: &str, more: &[&str]| {
        let (code, _, err) = said(&[&["compare", layout, "--samples", "1", "--out", &results], more].concat());
        (code, err)
    };
    assert_eq!(compare("single_arm_2r", &[]).0, 0);
    assert_eq!(compare("single_arm_2r", &[]).0, 0);
    let (code, err) = compare("dual_arm_2r", &[]);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("the comparison of `single_arm_2r`, not of `dual_arm_2r`"), "{err}");
    let one = scenario("one", &["a"], folder.path());
    assert_eq!(run(&one, Path::new(&results), &[]).0, 2);
    assert_eq!(run(&one, Path::new(&results), &["--force"]).0, 0);
    assert_eq!(compare("dual_arm_2r", &[]).0, 2);
}

#[test]
fn the_summary_says_what_the_run_was_made_of() {
    let folder = TempDir::new().expect("a folder");
    let one = scenario("one", &["a"], folder.path());
    let output =
        command().args(["run", "one.toml", "--out", "my results", "--report"]).current_dir(folder.path()).output();
    assert!(output.expect("it runs").status.success());
    let results = folder.path().join("my results");
    let summary: Value =
        serde_json::from_slice(&fs::read(results.join("summary.json")).expect("a summary")).expect("JSON");
    let run = &summary["run"];
    let text = fs::read_to_string(&one).expect("the scenario");
    assert_eq!(run["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(run["command"], "planar-capture run one.toml --out 'my results' --report");
    assert_eq!(run["scenario_sha256"], sha256(&text));
    assert_eq!(run["scenario_toml"], text);
    assert_eq!(run["layout_sha256"], summary["layout"]["sha256"]);
    let layout = fs::read_to_string(file("codegen/layouts/dual_arm_3r.toml")).expect("the layout");
    assert_eq!(run["layout_toml"], layout);
    assert_eq!(run["integrator"]["approach"], "rk4");
    assert_eq!((&run["steps"]["approach"], &run["steps"]["post_impact"]), (&4000.into(), &200.into()));
    let features = run["features"].as_array().expect("a list");
    assert!(features.contains(&"dual_arm_3r".into()) && features.contains(&"cli".into()), "{features:?}");
    let page = fs::read_to_string(results.join("report.html")).expect("a page");
    let (_, data) = page.split_once("id=\"data\">").expect("data");
    let (data, _) = data.split_once("</script>").expect("an end");
    let data: Value = serde_json::from_str(data).expect("JSON");
    assert_eq!(&data["run"], run, "the report has the same");
}

/// JSON has no infinity: a `null` would pass for "there is none".
#[test]
fn a_result_that_is_no_number_is_an_error() {
    let folder = TempDir::new().expect("a folder");
    let path = scenario("one", &["a"], folder.path());
    let (mut one, source) = Scenario::read_with_source(Path::new(&path), registry::SHIPPED).expect("a scenario");
    // none that can be read from a file
    one.contact.duration = Some(1e-320);
    let model = registry::generated(&one.layout).expect("generated code");
    let result = study(&one, &|| model.clone_box(), 1.0, &mut Silent).expect("a study");
    let manifest = RunManifest::new(&one, source, "planar-capture run".to_owned());
    let found = summary(&one, "generated", &result, &manifest).expect_err("an infinite force").to_string();
    assert!(found.contains("`cases[0].impact.contacts[0].mean_force[0]`"), "{found}");
}
