//! Outlines of layouts, the table `[clearance]`, and the exit code of overlaps.

use crate::said;
use planar_capture::layout::Layout;
use planar_capture::outline::Outline;
use planar_capture::registry::SHIPPED;
use planar_capture::scenario::Scenario;
use planar_proof::file;
use std::fs;
use tempfile::TempDir;

const LAYOUT: &str = "name = \"robot\"\n[base]\nmass = 500.0\ninertia = 80.0\n[[arm]]\nname = \"left\"\nmount = [0.5, 0.0]\n\
                      [[arm.link]]\nlength = 2.0\nmass = 10.0\ninertia = 3.0\n";

/// The layout with an outline of its base and one of its link.
fn with(base: &str, link: &str) -> String {
    LAYOUT.replacen("inertia = 80.0", &format!("inertia = 80.0\noutline = {base}"), 1) + &format!("outline = {link}\n")
}

#[test]
fn outlines_in_all_their_forms() {
    let cases = [
        ("{ disc = 0.7 }", Outline::disc(0.7), "{ disc = 0.1 }", Outline::Disc { center: [1.0, 0.0], radius: 0.1 }),
        (
            "{ box = [2, 1] }",
            Outline::rectangle([0.0; 2], [2.0, 1.0], 0.0),
            "{ box = [2, 0.2], center = [0.9, 0.1], angle = 0.5 }",
            Outline::rectangle([0.9, 0.1], [2.0, 0.2], 0.5),
        ),
        (
            "{ capsule = 0.2, ends = [[0, 0], [1, 1]] }",
            Outline::Capsule { ends: [[0.0; 2], [1.0, 1.0]], radius: 0.2 },
            "{ capsule = 0 }",
            Outline::Capsule { ends: [[0.0; 2], [2.0, 0.0]], radius: 0.0 },
        ),
        (
            "{ polygon = [[0, 0], [1, 0], [0, 1]] }",
            Outline::Polygon { corners: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] },
            "{ polygon = [[0, 0], [0, 1], [1, 0]] }",
            Outline::Polygon { corners: vec![[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]] },
        ),
    ];
    let plain = Layout::parse(LAYOUT, "robot.toml").unwrap_or_else(|report| panic!("{report}"));
    for (base, of_base, link, of_link) in cases {
        let layout = Layout::parse(&with(base, link), "robot.toml").unwrap_or_else(|report| panic!("{report}"));
        assert_eq!(layout.base.outline, Some(of_base), "{base}");
        assert_eq!(layout.arms[0].links[0].outline, Some(of_link), "{link}");
        assert_eq!(layout.sha256(), plain.sha256(), "outlines are no part of the hash");
        let back = Layout::parse(&layout.to_toml(), "robot.toml").unwrap_or_else(|report| panic!("{report}"));
        assert_eq!(back, layout, "written and read");
    }
}

/// A link of no valid length is refused for that alone, not for what its outline is by default.
#[test]
fn defaults_of_an_invalid_length_are_not_asked_for() {
    for outline in ["{ capsule = 0.1 }", "{ capsule = 0 }", "{ box = [1, 0.1] }", "{ disc = 0.1 }"] {
        let text = with("{ disc = 1 }", outline).replacen("length = 2.0", "length = -0.5", 1);
        let Err(report) = Layout::parse(&text, "robot.toml") else { panic!("it was accepted") };
        let shown = report.to_string();
        assert!(report.count() == 1 && shown.contains("length` is -0.5"), "`{outline}`: {shown}");
    }
}

#[test]
fn broken_outlines() {
    let cases = [
        ("{}", &["`base.outline`", "found 0 of them", "`disc`", "`polygon`"][..]),
        ("{ disc = 1, box = [1, 1] }", &["found 2 of them"]),
        ("{ disc = -1 }", &["`base.outline.disc` is -1", "greater than 0"]),
        ("{ disc = 1, angle = 0.1 }", &["`base.outline.angle`", "`disc` takes no such key"]),
        ("{ box = [1, 0] }", &["`base.outline.box[1]` is 0"]),
        ("{ capsule = 0.1 }", &["missing key `base.outline.ends`", "two ends"]),
        ("{ capsule = 0.1, ends = [[0, 0]] }", &["found 1 points"]),
        ("{ polygon = [[0, 0], [1, 1], [1, 0], [0, 1]] }", &["edges 1 and 3 of the polygon meet"]),
        ("{ disk = 1 }", &["did you mean `disc`?"]),
        ("3", &["`base.outline` is 3"]),
    ];
    for (outline, wanted) in cases {
        let Err(report) = Layout::parse(&with(outline, "{ capsule = 0 }"), "robot.toml") else {
            panic!("`{outline}` was accepted");
        };
        let shown = report.to_string();
        for wanted in wanted.iter().chain(&["robot.toml:5:"]) {
            assert!(shown.contains(wanted), "`{outline}`: no `{wanted}` in\n{shown}");
        }
    }
}

#[test]
fn broken_rules_of_overlaps() {
    let paper = fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
    let cases = [
        ("on_overlap = \"warn\"", &["`clearance.on_overlap` is \"warn\"", "`report`", "`fail`", "`stop`"][..]),
        ("ignore = [[\"base\", \"arms/arm1/link9\"]]", &["`clearance.ignore[0][1]`", "did you mean `arms/arm1/link"]),
        ("ignore = [[\"base\"]]", &["found 1 bodies"]),
        ("ignore = [[\"base\", \"base\"]]", &["`clearance.ignore[0]` is", "not compared with itself"]),
        ("ignores = []", &["did you mean `ignore`?"]),
    ];
    for (rule, wanted) in cases {
        let text = format!("{paper}\n[clearance]\n{rule}\n");
        let line = format!("paper.toml:{}:", text.lines().count());
        let Err(report) = Scenario::parse(&text, "paper.toml", &file("scenarios"), SHIPPED) else {
            panic!("`{rule}` was accepted");
        };
        let shown = report.to_string();
        for wanted in wanted.iter().copied().chain([line.as_str()]) {
            assert!(shown.contains(wanted), "`{rule}`: no `{wanted}` in\n{shown}");
        }
    }
}

/// The paper's study passes with its overlaps in the table; with `fail` they are objections.
#[test]
fn overlaps_are_printed_and_can_fail_a_run() {
    let folder = TempDir::new().expect("a folder");
    let paper = fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
    for (rule, expected) in [("report", 0), ("fail", 1), ("stop", 1)] {
        let path = folder.path().join(format!("{rule}.toml"));
        fs::write(&path, format!("{paper}\n[clearance]\non_overlap = \"{rule}\"\n")).expect("written");
        let results = folder.path().join(rule);
        let (code, out, err) =
            said(&["run", &path.display().to_string(), "--out", &results.display().to_string(), "--quiet"]);
        assert_eq!(code, expected, "{rule}: {err}");
        assert_eq!(err.contains("audit: case3: `"), expected == 1, "{err}");
        let overlap = if rule == "stop" { "begin to overlap at 19.650 s" } else { "overlap from" };
        assert!(out.contains("Least distance of bodies") && out.contains(overlap), "{out}");
        let summary = fs::read(results.join("summary.json")).expect("a summary");
        let summary: serde_json::Value = serde_json::from_slice(&summary).expect("JSON");
        let case = &summary["cases"][2];
        assert_eq!(case["stopped"].is_number(), rule == "stop");
        assert!(case["clearance"]["first_overlap"].as_f64().is_some_and(|time| time > 19.0), "{case}");
        assert_eq!(case["post_impact"].is_null(), rule == "stop", "the first overlap is in the approach");
    }
}
