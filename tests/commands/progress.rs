//! Progress where the standard error is no terminal.

use crate::said;
use planar_proof::file;
use tempfile::TempDir;

/// Exit code and messages of a run.
fn run(more: &[&str]) -> (i32, String) {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results").display().to_string();
    let scenario = file("scenarios/redysim_single_arm_3r.toml").display().to_string();
    let (code, _, err) = said(&[&["run", &scenario, "--out", &results], more].concat());
    (code, err)
}

#[test]
fn progress_is_shown_off_a_terminal_unless_it_is_not_wanted() {
    let (code, err) = run(&["--progress", "0"]);
    assert_eq!(code, 0, "{err}");
    assert!(err.lines().any(|line| line.starts_with("approach: 51 %, ")), "{err}");
    assert_eq!(run(&[]), (0, String::new()), "a short run is over before the first line");
    for quiet in ["-q", "--quiet"] {
        assert_eq!(run(&["--progress", "0", quiet]), (0, String::new()));
    }
}
