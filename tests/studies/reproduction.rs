//! The committed report on the paper's reproduction equals the command's output, and its statements are true.
#![cfg(feature = "figures")]

use crate::Silent;
use crate::command;
use planar_capture::reproduction::reproduce;
use planar_proof::{file, said};
use std::fs;
use tempfile::TempDir;

#[test]
fn the_committed_report_is_what_is_computed() {
    let files = reproduce(&mut Silent).expect("a report").files;
    let report = &files[0].1;
    let docs = file("docs");
    for (path, text) in &files {
        let committed = fs::read_to_string(docs.join(path)).unwrap_or_default();
        assert!(
            committed == *text,
            "docs/{path} is not what is computed; to mend: \
             cargo run --release --features figures -- reproduce --out docs"
        );
    }
    // every figure is shown, and nothing is shown or left there that is not computed
    for (path, _) in &files[1..] {
        assert!(report.contains(&format!("]({path})")), "{path} is not shown");
    }
    assert_eq!(report.matches("](reproduction/").count(), files.len() - 1);
    assert_eq!(fs::read_dir(docs.join("reproduction")).expect("figures").count(), files.len() - 1);
    let size: usize = files.iter().map(|(_, text)| text.len()).sum();
    assert!(size < 1_500_000, "{size} bytes");
    for table in 1..=5 {
        assert!(report.contains(&format!("\n## Table {table}: ")), "no table {table}");
    }
    for figure in 3..=10 {
        let heads = report.lines().filter(|line| line.starts_with("## Figure"));
        let found = heads.flat_map(|line| line.split([' ', ':'])).any(|word| word == figure.to_string());
        assert!(found, "no figure {figure}");
    }
}

#[test]
fn the_command_writes_the_report_and_sees_what_is_stale() {
    let folder = TempDir::new().expect("a folder");
    let reproduce = |more: &[&str]| {
        let output = command().args(["reproduce", "--quiet", "--out"]).arg(folder.path()).args(more).output();
        let (code, _, message) = said(output.expect("it runs"));
        (code, message)
    };
    let (code, message) = reproduce(&["--check"]);
    assert_eq!(code, 1, "nothing is there yet");
    assert!(message.contains("reproduction.md") && message.contains("reproduce --out"), "{message}");
    assert!(fs::read_dir(folder.path()).expect("a folder").next().is_none(), "a check writes nothing");
    assert_eq!(reproduce(&[]), (0, String::new()));
    assert_eq!(reproduce(&["--check"]), (0, String::new()));
    let figure = folder.path().join("reproduction/momentum_case1.svg");
    fs::write(&figure, "<svg/>").expect("written");
    let (code, message) = reproduce(&["--check"]);
    assert_eq!(code, 1);
    assert!(message.contains("momentum_case1.svg"), "{message}");
}
