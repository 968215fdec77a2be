//! Figures: which there are, what stands in them, and what a build without them says.

mod support;

use assert_cmd::Command;
use support::file;
use tempfile::TempDir;

fn command() -> Command {
    Command::new(env!("CARGO_BIN_EXE_planar-capture"))
}

#[cfg(not(feature = "figures"))]
#[test]
fn a_build_that_draws_nothing_says_how_to_get_one_that_does() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    let mut command = command();
    command.arg("run").arg(file("scenarios/raina_shah_2017.toml")).arg("--figures").arg("--out").arg(&results);
    let output = command.output().expect("it runs");
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).expect("UTF-8");
    assert!(message.contains("cargo run --release --features figures"), "{message}");
    assert!(!results.exists(), "nothing was computed");
    let mut command = self::command();
    let output = command.arg("reproduce").arg("--out").arg(&results).output().expect("it runs");
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(String::from_utf8(output.stderr).expect("UTF-8"), message);
    assert!(!results.exists(), "nothing was computed");
}

#[cfg(feature = "figures")]
mod drawn {
    use super::*;
    use planar_capture::figures::{Axis, Colour, Dash, Figure, Mark, Panel, Series, Span, draw, figures};
    use std::collections::BTreeSet;
    use std::fs;
    use std::path::Path;
    use support::{run, scenario};

    /// Every element is closed where it was opened, every `&` starts an entity, and nothing is not a number.
    fn assert_well_formed(name: &str, svg: &str) {
        let mut open: Vec<&str> = Vec::new();
        for part in svg.split('<').skip(1) {
            let (tag, text) = part.split_once('>').unwrap_or_else(|| panic!("{name}: a tag without end: {part}"));
            assert!(tag.starts_with("!--") || tag.matches('"').count() % 2 == 0, "{name}: quotes in <{tag}>");
            if tag.starts_with("!--") || tag.starts_with('?') {
                continue;
            }
            let word = tag.trim_start_matches('/').split([' ', '/']).next().unwrap_or_default();
            if tag.starts_with('/') {
                assert_eq!(open.pop(), Some(word), "{name}");
            } else if !tag.ends_with('/') {
                open.push(word);
            }
            for entity in text.split('&').skip(1) {
                assert!(entity.contains(';'), "{name}: a bare & in {text}");
            }
        }
        assert!(open.is_empty() && svg.starts_with("<svg"), "{name}: {open:?} are open");
        assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{name}: a coordinate is no number");
    }

    /// All that is to be read in a figure is in its SVG, as text.
    fn assert_labelled(figure: &Figure, svg: &str) {
        let escaped = |text: &str| text.replace('&', "&amp;").replace('<', "&lt;");
        for panel in &figure.panels {
            for axis in [&panel.x, &panel.y] {
                let named = matches!(axis.span, Span::Names(_));
                assert!(axis.label.ends_with(']') || named, "{}: `{}` has no unit", figure.name, axis.label);
                assert!(svg.contains(&escaped(&axis.label)), "{}: no `{}`", figure.name, axis.label);
            }
            let labels = panel.series.iter().filter_map(|series| series.label.as_ref());
            for text in labels.chain(panel.title.as_ref()) {
                assert!(svg.contains(&escaped(text)), "{}: no `{text}`", figure.name);
            }
        }
    }

    /// A label stands once in each legend: of each panel, or of all.
    fn assert_one_legend_entry_each(figure: &Figure, svg: &str) {
        let has = |panel: &Panel, label: &str| panel.series.iter().any(|s| s.label.as_deref() == Some(label));
        for label in figure.panels.iter().flat_map(|panel| &panel.series).filter_map(|s| s.label.as_ref()) {
            let panels = figure.panels.iter().filter(|panel| has(panel, label)).count();
            let legends = if figure.columns > 1 { 1 } else { panels };
            let found = svg.matches(&format!("\u{2002}{label}<")).count();
            assert_eq!(found, legends, "{}: `{label}` in the legends", figure.name);
        }
    }

    /// Width and height of a PNG.
    fn png_size(png: &[u8]) -> (u32, u32) {
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
        let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes"));
        (number(16), number(20))
    }

    fn names(figures: &[Figure]) -> BTreeSet<String> {
        figures.iter().map(|figure| figure.name.clone()).collect()
    }

    #[test]
    fn the_papers_study_has_a_figure_for_each_of_the_papers() {
        let scenario = scenario("raina_shah_2017");
        let study = run(&scenario);
        let all = figures(&scenario, &study);
        let names = names(&all);
        assert_eq!(names.len(), all.len(), "no two figures have the same name");
        for wanted in [
            "initial_configuration",
            "impact_configuration",
            "approach_joint_angles",
            "approach_end_effector_velocities",
            "impact_velocities",
            "momentum_case1",
            "post_impact_motion_case1",
            "post_impact_motion_case2",
            "post_impact_motion_case3",
        ] {
            assert!(names.contains(wanted), "no {wanted} in {names:?}");
        }
        for figure in &all {
            let svg = draw::svg(figure);
            assert_well_formed(&figure.name, &svg);
            assert_labelled(figure, &svg);
            assert_one_legend_entry_each(figure, &svg);
            assert_eq!(svg, draw::svg(figure), "{}: the same figure, the same bytes", figure.name);
        }
    }

    /// What a figure shows is what was computed.
    #[test]
    fn curves_are_the_samples() {
        let scenario = scenario("raina_shah_2017");
        let study = run(&scenario);
        let all = figures(&scenario, &study);
        let of = |name: &str| all.iter().find(|figure| figure.name == name).expect("the figure");
        let angles = &of("approach_joint_angles").panels[0].series;
        assert_eq!(angles.len(), 6);
        for (joint, series) in angles.iter().enumerate() {
            let last = study.approach.end().expect("an end");
            assert_eq!(series.points.last(), Some(&(20.0, last.motion.joint_angles[joint])));
        }
        // the colour says which joint, the dash which arm: no two curves look the same
        let looks: Vec<(Colour, Mark)> = angles.iter().map(|series| (series.colour, series.mark)).collect();
        assert!((1..6).all(|i| !looks[..i].contains(&looks[i])));
        // robot and targets together: the same before and after, and what the literal equations make of it
        let momentum = &of("momentum_case1").panels[1].series;
        assert!(momentum[0].points.iter().all(|(_, l)| (l - 0.4).abs() < 1e-9), "two targets of 1 kg m² at 0.2 rad/s");
        let jump =
            study.cases[0].capture.as_ref().expect("a capture").impact.paper.as_ref().expect("literal").momentum_jump
                [0];
        assert!((momentum[1].points[0].1 - (0.4 + jump)).abs() < 1e-9);
        // the pictures' last joints and tips, by another way
        let end = study.approach.end().expect("an end");
        let robot = &of("impact_configuration").panels[0].series;
        for (arm, tip) in scenario.layout.arms.iter().zip(&end.end_effector_poses) {
            let line = robot.iter().find(|series| series.label.as_ref() == Some(&arm.name)).expect("the arm");
            let (x, y) = line.points[3];
            assert!((x - tip[1]).abs() + (y - tip[2]).abs() < 1e-12, "{}", arm.name);
        }
    }

    /// A robot with more joints than a panel has lines gets a higher panel: no legend reaches into the next one.
    #[test]
    fn a_long_legend_has_room() {
        let series = |i: usize| Series {
            label: Some(format!("joint {i}")),
            colour: Colour::of(i),
            mark: Mark::Line(Dash::of(i), 1.0),
            points: vec![(0.0, 0.0), (1.0, 1.0)],
        };
        let height = |joints: usize| -> f64 {
            let panel =
                Panel::new(Axis::time("t [s]", 1.0), Axis::new("θ [rad]", 0.1), (0..joints).map(series).collect());
            let svg = draw::svg(&Figure::column("many", "", vec![panel]));
            let (_, rest) = svg.split_once(" height=\"").expect("a height");
            rest[..rest.find('"').expect("its end")].parse().expect("a number")
        };
        assert!(height(6) < height(40) && height(40) > 40.0 * 18.0);
    }

    #[test]
    fn an_approach_of_one_arm_without_targets_has_figures() {
        let folder = TempDir::new().expect("a folder");
        let mut command = command();
        command.arg("run").arg(file("scenarios/redysim_single_arm_3r.toml")).arg("--figures");
        let output = command.arg("--out").arg(folder.path()).output().expect("it runs");
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let figures = folder.path().join("figures");
        let bytes = |name: &str| fs::read(figures.join(name)).unwrap_or_else(|_| panic!("no {name}"));
        let found: BTreeSet<String> = fs::read_dir(&figures)
            .expect("figures")
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        assert!(!found.iter().any(|name| name.contains("impact")), "{found:?}");
        for name in ["final_configuration", "approach_joint_angles", "momentum_redysim_single_arm_3r"] {
            let svg = String::from_utf8(bytes(&format!("{name}.svg"))).expect("UTF-8");
            assert_well_formed(name, &svg);
            let (width, height) = png_size(&bytes(&format!("{name}.png")));
            assert!((1000..5000).contains(&width) && (500..8000).contains(&height), "{name}: {width} × {height}");
        }
        for name in &found {
            let extension = Path::new(name).extension().and_then(|e| e.to_str());
            let twin =
                if extension == Some("svg") { name.replace(".svg", ".png") } else { name.replace(".png", ".svg") };
            assert!(found.contains(&twin), "{name} without {twin}");
        }
    }
}
