//! Progress where the standard error is no terminal.

use crate::said;
use planar_proof::file;
use std::path::Path;
use tempfile::TempDir;

/// Exit code and messages of a run.
fn run(scenario: &Path, more: &[&str]) -> (i32, String) {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results").display().to_string();
    let scenario = scenario.display().to_string();
    let (code, _, err) = said(&[&["run", &scenario, "--out", &results, "--dynamics", "generated"], more].concat());
    (code, err)
}

/// A robot at rest and a rod that turns by 1e5 rad in the only step: the search for overlaps divides it again and again.
const ONE_LONG_STEP: &str = "
    name = 'long'
    layout = 'single_arm_3r'
    [initial]
    joint_angles = [0.4, -0.6, 1.3]
    [approach]
    duration = 1.0
    step = 1.0
    integrator = 'rk4'
    trajectory = 'cycloidal'
    final_joint_angles = [0.4, -0.6, 1.3]
    tracking = 'exact'
    [[target]]
    name = 'rod'
    arm = 'arm1'
    mass = 10.0
    inertia = 1.0
    contact = [0.4, 0.0]
    polygon = [[-0.4, -0.05], [0.4, -0.05], [0.4, 0.05], [-0.4, 0.05]]
    twist = [1e5, 0.0, 0.0]
    [post_impact]
    duration = 1e-6
    step = 1e-6";

#[test]
fn a_short_run_is_over_before_the_first_line() {
    assert_eq!(run(&file("scenarios/redysim_single_arm_3r.toml"), &[]), (0, String::new()));
}

#[test]
fn a_line_now_and_then_within_a_step_too_unless_it_is_not_wanted() {
    let folder = TempDir::new().expect("a folder");
    let scenario = folder.path().join("long.toml");
    std::fs::write(&scenario, ONE_LONG_STEP).expect("a scenario");
    let lines = |more: &[&str]| {
        let (code, err) = run(&scenario, more);
        assert_eq!(code, 0, "{err}");
        err.lines().filter(|line| line.starts_with("approach: 100 %, ")).count()
    };
    assert!(lines(&["--progress", "0"]) > 1);
    for quiet in ["-q", "--quiet"] {
        assert_eq!(lines(&["--progress", "0", quiet]), 0);
    }
}
