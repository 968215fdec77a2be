//! Which implementation computes a layout: compiled code, a graph that is carried or derived, or the generic one.

use crate::command;
use crate::generate::{environments, without_python};
use planar_proof::{file, said};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A robot with arms of so many links and no exact zero, in a folder, with a short motion of it.
fn robot(folder: &Path, links: &[usize]) -> PathBuf {
    let link = "[[arm.link]]\nlength = 0.5\nmass = 2.0\ninertia = 0.1\ncom = [0.2, 0.01]\n";
    let arm = |(index, links): (usize, &usize)| {
        let (mount, links) = ([0.3, -0.3, 0.0][index], link.repeat(*links));
        format!("[[arm]]\nname = 'a{index}'\nmount = [{mount}, 0.1]\nmount_angle = 0.2\n{links}")
    };
    let arms: Vec<String> = links.iter().enumerate().map(arm).collect();
    let text = format!("name = 'robot'\n[base]\nmass = 50.0\ninertia = 5.0\n{}", arms.concat());
    fs::write(folder.join("robot.toml"), text).expect("written");
    let angles = vec!["0.4"; links.iter().sum()].join(", ");
    let scenario = folder.join("motion.toml");
    let text = format!(
        "name = 'motion'\nlayout = 'robot.toml'\n[initial]\njoint_angles = [{angles}]\nbase_twist = [0.1, 0.0, 0.2]\n\
         [approach]\nduration = 1.0\nstep = 0.002\nintegrator = 'rk4'\ntrajectory = 'cycloidal'\n\
         final_joint_angles = [{}]\ntracking = 'exact'\n",
        angles.replace("0.4", "0.7")
    );
    fs::write(&scenario, text).expect("written");
    scenario
}

/// Exit code, messages, and summary of a run with a cache folder of its own.
fn run(scenario: &Path, cache: &Path, more: &[&str]) -> (i32, String, Value) {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().join("results");
    let mut command = command();
    command.env("PLANAR_CAPTURE_HOME", cache).arg("run").arg(scenario).arg("--out").arg(&out).args(more);
    let (code, _, err) = said(command.output().expect("it runs"));
    let summary = fs::read_to_string(out.join("summary.json")).unwrap_or_else(|_| "null".to_owned());
    (code, err, serde_json::from_str(&summary).expect("JSON"))
}

#[test]
fn a_shipped_robot_runs_by_its_compiled_code() {
    let cache = TempDir::new().expect("a folder");
    let (code, err, summary) = run(&file("scenarios/redysim_single_arm_3r.toml"), cache.path(), &[]);
    assert_eq!((code, &summary["dynamics"]), (0, &Value::from("generated")));
    assert_eq!(err, "dynamics: generated, compiled code of `single_arm_3r`\n");
    assert_eq!(run(&file("scenarios/redysim_single_arm_3r.toml"), cache.path(), &["-q"]).1, "");
    // what is asked for needs no line
    let scenario = file("scenarios/redysim_single_arm_3r.toml");
    assert_eq!(run(&scenario, cache.path(), &["--dynamics", "generated"]).1, "");
}

/// The same motion by graph and by the generic implementation, which the line and the summary name.
#[test]
fn most_robots_run_by_a_graph_that_is_carried() {
    for links in [&[2][..], &[3], &[2, 2], &[3, 3], &[2, 2, 2], &[3, 3, 3]] {
        let folder = TempDir::new().expect("a folder");
        let scenario = robot(folder.path(), links);
        let (code, err, by_graph) = run(&scenario, folder.path(), &[]);
        assert_eq!((code, &by_graph["dynamics"]), (0, &Value::from("graph")), "{err}");
        let (arms, links) = (links.len(), links[0]);
        assert!(
            err.starts_with(&format!("dynamics: graph, the graph `general_{arms}x{links}`; compiled code")),
            "{err}"
        );
        let (code, err, generic) = run(&scenario, folder.path(), &["--dynamics", "generic"]);
        assert_eq!((code, err.as_str(), &generic["dynamics"]), (0, "", &Value::from("generic")));
        let yaw = |summary: &Value| summary["cases"][0]["approach"]["base_pose"][0].as_f64().expect("a number");
        assert!((yaw(&by_graph) - yaw(&generic)).abs() < 1e-10, "{} {}", yaw(&by_graph), yaw(&generic));
    }
}

#[test]
fn a_structure_without_a_graph_runs_by_the_generic_implementation() {
    let folder = TempDir::new().expect("a folder");
    let scenario = robot(folder.path(), &[3, 2]);
    let (code, err, summary) = run(&scenario, folder.path(), &[]);
    assert_eq!((code, &summary["dynamics"]), (0, &Value::from("generic")), "{err}");
    let derive = format!("planar-capture derive {}", folder.path().join("robot.toml").display());
    assert!(err.starts_with("dynamics: generic") && err.contains(&derive), "{err}");
    let (code, err, _) = run(&scenario, folder.path(), &["--dynamics", "graph"]);
    assert_eq!(code, 2);
    assert!(err.contains("no graph has the structure of layout `robot` (2 arms of 3 + 2 links"), "{err}");
    let (code, err, _) = run(&scenario, folder.path(), &["--dynamics", "generated"]);
    assert_eq!(code, 2);
    assert!(err.contains("no generated code in this build has the structure of layout `robot`"), "{err}");
}

/// Once derived it serves other numbers and names, not another structure; a file that is no graph of it is not used.
#[test]
fn a_derived_graph_serves_its_structure() {
    if without_python() {
        return;
    }
    let folder = TempDir::new().expect("a folder");
    let (scenario, layout) = (robot(folder.path(), &[3, 2]), folder.path().join("robot.toml"));
    let derive = || {
        let mut command = command();
        command.env("PLANAR_CAPTURE_HOME", folder.path()).arg("derive").arg(&layout);
        command.env("PLANAR_CAPTURE_ENVIRONMENTS", environments());
        said(command.output().expect("it runs"))
    };
    let (code, out, err) = derive();
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(
        out.contains(": the graph of robot, 8 degrees of freedom\n") && out.contains("agree with the generic"),
        "{out}"
    );
    let text = fs::read_to_string(&layout).expect("a layout");
    for (from, to) in [("mass = 2.0", "mass = 3.0"), ("name = 'a0'", "name = 'left'"), ("mass = 50.0", "mass = 70.0")] {
        fs::write(&layout, text.replace(from, to)).expect("written");
        let (code, err, summary) = run(&scenario, folder.path(), &[]);
        assert_eq!((code, &summary["dynamics"]), (0, &Value::from("graph")), "{err}");
        assert!(err.starts_with("dynamics: graph, the graph derived for its structure"), "{err}");
    }
    fs::write(&layout, text.replace("mount_angle = 0.2\n", "")).expect("written");
    let (_, err, summary) = run(&scenario, folder.path(), &[]);
    assert!(err.starts_with("dynamics: generic") && summary["dynamics"] == "generic", "other zeros: {err}");
    fs::write(&layout, &text).expect("written");
    let graphs = fs::read_dir(folder.path().join("graphs")).expect("a folder");
    let mut graphs: Vec<_> = graphs.map(|entry| entry.expect("a file").path()).collect();
    graphs.sort();
    let [graph, hash] = <[_; 2]>::try_from(graphs).expect("a graph and its hash");
    let listed = || {
        let mut list = command();
        let (code, out, err) =
            said(list.env("PLANAR_CAPTURE_HOME", folder.path()).arg("list").output().expect("it runs"));
        assert_eq!((code, err.as_str()), (0, ""));
        let name = graph.file_name().expect("a name").to_string_lossy();
        out.contains(&format!("{name} 2 arms of 3 + 2\n"))
    };
    assert!(listed(), "a graph in the cache folder");
    let proved = fs::read_to_string(&hash).expect("a hash");
    let whole = fs::read_to_string(&graph).expect("a graph");
    let carried = fs::read_to_string(file("codegen/structures/general_2x3.json")).expect("a graph");
    let damaged = whole.replacen("\"mul\"", "\"add\"", 1);
    assert_ne!(damaged, whole, "no product in the graph");
    let hash_of = |text: &str| planar_capture::layout::sha256(text);
    for (found, of, problem) in [
        (&whole[..1000], hash_of(&whole[..1000]), "not JSON"),
        (&carried, hash_of(&carried), "another structure"),
        (&damaged, proved.clone(), "not as it was derived and proved"),
        (&whole, String::new(), "not as it was derived and proved"),
    ] {
        fs::write(&graph, found).expect("written");
        fs::write(&hash, of).expect("written");
        let (code, err, summary) = run(&scenario, folder.path(), &[]);
        assert_eq!((code, &summary["dynamics"]), (0, &Value::from("generic")), "{err}");
        assert!(
            err.starts_with("warning: ") && err.contains(problem) && err.contains("planar-capture derive"),
            "{err}"
        );
        let (code, err, _) = run(&scenario, folder.path(), &["--dynamics", "graph"]);
        assert!(code == 2 && err.contains(problem) && err.contains(".json"), "{err}");
    }
    assert!(!listed(), "what is not as it was proved");
    assert_eq!(derive().0, 0);
    let [again, its_hash] = [&graph, &hash].map(|file| fs::read_to_string(file).expect("a file"));
    assert_eq!((again, its_hash), (whole, proved), "derived again");
    // a crate of one's own takes it, for other numbers too, without Python
    fs::write(&layout, text.replace("mass = 50.0", "mass = 70.0")).expect("written");
    let crate_folder = folder.path().join("mine");
    let mut new = command();
    new.env("PLANAR_CAPTURE_HOME", folder.path())
        .env("PATH", "")
        .arg("new")
        .arg(&crate_folder)
        .arg("--layout")
        .arg(&layout);
    let (code, _, err) = said(new.output().expect("it runs"));
    assert_eq!((code, err.as_str()), (0, ""));
    planar_capture::build::render_to(crate_folder.join("layouts"), folder.path()).expect("it is rendered");
}
