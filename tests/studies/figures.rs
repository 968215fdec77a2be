//! Figures: their names and content, and the message of a build without them.

use crate::command;
use planar_proof::file;
use tempfile::TempDir;

#[cfg(not(feature = "figures"))]
#[test]
fn a_build_that_draws_nothing_says_how_to_get_one_that_does() {
    let folder = TempDir::new().expect("a folder");
    let results = folder.path().join("results");
    let scenario = file("scenarios/raina_shah_2017.toml");
    let output = command().arg("run").arg(scenario).arg("--figures").arg("--out").arg(&results).output();
    let (code, _, message) = planar_proof::said(output.expect("it runs"));
    assert_eq!(code, 2);
    assert!(message.contains("cargo run --release --features figures"), "{message}");
    assert!(!results.exists(), "nothing was computed");
    let (code, _, again) =
        planar_proof::said(command().arg("reproduce").arg("--out").arg(&results).output().expect("it runs"));
    assert_eq!((code, again), (2, message));
    assert!(!results.exists(), "nothing was computed");
}

#[cfg(feature = "figures")]
mod drawn {
    use super::*;
    use crate::{run, scenario};
    use planar_capture::capture::CaptureResult;
    use planar_capture::contact::ContactLaw;
    use planar_capture::outline::Outline;
    use planar_capture::output::figure_kinds::{FIGURE_KINDS, begins_with, is_kind};
    use planar_capture::output::figures::{
        Axis, AxisRange, Colour, Dash, Figure, Mark, Panel, Series, Width, draw, figures,
    };
    use planar_capture::output::impacts::time_digits;
    use planar_capture::scenario::{Actuation, FinalRates, PostCaptureControl};
    use planar_capture::simulate::Sample;
    use planar_proof::tolerance::FIGURE_VALUES;
    use std::collections::BTreeSet;
    use std::fs;
    use std::path::Path;

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

    /// All labels of a figure are in its SVG, as text.
    fn assert_labelled(figure: &Figure, svg: &str) {
        let escaped = |text: &str| text.replace('&', "&amp;").replace('<', "&lt;");
        for panel in &figure.panels {
            for axis in [&panel.x, &panel.y] {
                let named = matches!(axis.range, AxisRange::Categories(_));
                assert!(axis.label.ends_with(']') || named, "{}: `{}` has no unit", figure.name, axis.label);
                assert!(svg.contains(&escaped(&axis.label)), "{}: no `{}`", figure.name, axis.label);
            }
            let labels = panel.series.iter().filter_map(|series| series.label.as_ref());
            for text in labels.chain(panel.title.as_ref()) {
                assert!(svg.contains(&escaped(text)), "{}: no `{text}`", figure.name);
            }
        }
    }

    /// A label is once in each legend, of a panel or of all panels.
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
        for expected in [
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
            assert!(names.contains(expected), "no {expected} in {names:?}");
        }
        for figure in &all {
            let svg = draw::svg(figure, Width::Page);
            assert_well_formed(&figure.name, &svg);
            assert_labelled(figure, &svg);
            assert_one_legend_entry_each(figure, &svg);
            assert_eq!(svg, draw::svg(figure, Width::Page), "{}: the same figure, the same bytes", figure.name);
        }
    }

    /// Figures show the computed values.
    #[test]
    fn curves_are_the_samples() {
        let scenario = scenario("raina_shah_2017");
        let study = run(&scenario);
        let all = figures(&scenario, &study);
        let of = |name: &str| all.iter().find(|figure| figure.name == name).expect("the figure");
        let angles = &of("approach_joint_angles").panels[0].series;
        assert_eq!(angles.len(), 6);
        for (joint, series) in angles.iter().enumerate() {
            let last = study.approach.end();
            assert_eq!(series.points.last(), Some(&(20.0, last.state.joint_angles[joint])));
        }
        // the colour says which arm, the dash which joint: no two curves look the same
        let looks: Vec<(Colour, Mark)> = angles.iter().map(|series| (series.colour, series.mark)).collect();
        assert!((1..6).all(|i| !looks[..i].contains(&looks[i])));
        // robot and targets together: equal before and after, but not by the literal equations
        let momentum = &of("momentum_case1").panels[1].series;
        assert!(momentum[0].points.iter().all(|(_, l)| (l - 0.4).abs() < 1e-9), "two targets of 1 kg m² at 0.2 rad/s");
        let jump =
            study.cases[0].capture.as_ref().expect("a capture").impact.paper.as_ref().expect("literal").momentum_jump
                [0];
        assert!((momentum[1].points[0].1 - (0.4 + jump)).abs() < 1e-9);
        // last joints and end effectors of the pictures, from the last link's pose
        let end = study.approach.end();
        let robot = &of("impact_configuration").panels[0].series;
        for (arm, end_effector) in scenario.layout.arms.iter().zip(&end.end_effector_poses) {
            let line = robot.iter().find(|series| series.label.as_ref() == Some(&arm.name)).expect("the arm");
            let (x, y) = line.points[3];
            assert!((x - end_effector[1]).abs() + (y - end_effector[2]).abs() < 1e-12, "{}", arm.name);
        }
    }

    /// Every curve over time is that of the quantity that its panel and its label name, at every sample.
    #[test]
    fn curves_are_what_they_are_called() {
        let scenario = scenario("stabilised_capture");
        let study = run(&scenario);
        let all = figures(&scenario, &study);
        let arms = &scenario.layout.arms;
        let joints: Vec<String> =
            arms.iter().flat_map(|arm| (1..=arm.links.len()).map(|k| format!("{} joint {k}", arm.name))).collect();
        let value = |quantity: &str, label: &str, sample: &Sample| {
            let joint = || joints.iter().position(|joint| joint == label).expect("a joint");
            let twist = |component: usize| match label.strip_prefix('v') {
                Some(_) => sample.state.base_twist[component],
                None => {
                    sample.end_effector_twists[arms.iter().position(|arm| arm.name == label).expect("an arm")]
                        [component]
                }
            };
            match (quantity, label) {
                ("Joint angle [rad]", _) => sample.state.joint_angles[joint()],
                ("Joint rate [rad/s]", _) => sample.state.joint_rates[joint()],
                ("Joint torque [N m]", _) => sample.joint_torques[joint()],
                ("Base yaw [rad]", "yaw") => sample.state.base_pose[0],
                ("Base position [m]", "x") => sample.state.base_pose[1],
                ("Base position [m]", "y") => sample.state.base_pose[2],
                ("Base rate [rad/s]", "ω") => sample.state.base_twist[0],
                ("Base velocity [m/s]", "vx") | ("Velocity x [m/s]", _) => twist(1),
                ("Base velocity [m/s]", "vy") | ("Velocity y [m/s]", _) => twist(2),
                ("Angular velocity [rad/s]", _) => twist(0),
                other => panic!("{other:?}"),
            }
        };
        let name = &study.cases[0].name;
        let after = &study.cases[0].capture.as_ref().expect("a capture").post_impact;
        let mut curves = 0;
        for (figure, phase) in [
            ("approach_joint_angles".to_owned(), &study.approach),
            ("approach_joint_rates".to_owned(), &study.approach),
            ("approach_base".to_owned(), &study.approach),
            ("approach_end_effector_velocities".to_owned(), &study.approach),
            (format!("post_impact_joints_{name}"), after),
            (format!("post_impact_base_{name}"), after),
            (format!("post_impact_end_effector_velocities_{name}"), after),
        ] {
            let found = all.iter().find(|found| found.name == figure).expect("the figure");
            for panel in &found.panels {
                for series in &panel.series {
                    let label = series.label.as_deref().expect("a label");
                    if label.ends_with("wanted") {
                        continue;
                    }
                    let of_sample = |sample: &Sample| (sample.time, value(&panel.y.label, label, sample));
                    let expected: Vec<_> = phase.samples.iter().map(of_sample).collect();
                    assert_eq!(series.points, expected, "{figure}, {}: {label}", panel.y.label);
                    curves += 1;
                }
            }
        }
        // angles, rates and torques of all joints, six of the base and three of each end effector, before and after
        assert_eq!(curves, 2 * (3 * joints.len() + 6 + 3 * arms.len()));
    }

    /// Bodies that overlap are outlined while they do, and the pair that begins first has the highest row.
    #[test]
    fn overlaps_are_pictured_while_they_last() {
        let scenario = scenario("raina_shah_2017");
        let mut study = run(&scenario);
        // a contact ends an overlap: from then on the two are held
        let contact = study.approach.duration;
        for case in &mut study.cases {
            let overlaps = &mut case.clearance.overlaps;
            let mut until = overlaps[0].clone();
            until.bodies = ["base", "targets/target1"].map(str::to_owned);
            until.span = [contact - 1e-3, contact];
            overlaps.push(until);
        }
        let all = figures(&scenario, &study);
        let of = |name: String| all.iter().find(|figure| figure.name == name).expect("the figure");
        let (mut with, mut without) = (0, 0);
        for case in &study.cases {
            let overlaps = &case.clearance.overlaps;
            let panel = &of(format!("clearance_{}", case.name)).panels[0];
            let AxisRange::Categories(names) = &panel.y.range else { panic!("names") };
            let pair = |bodies: &[String; 2]| format!("{}, {}", bodies[0], bodies[1]);
            let first = overlaps.first().map_or(&case.clearance.least_shown().expect("pairs").bodies, |it| &it.bodies);
            assert_eq!(names.last(), Some(&pair(first)));
            let bars: Vec<_> =
                panel.series.iter().filter(|series| series.label.as_deref() == Some("overlap")).collect();
            assert_eq!(bars.len(), overlaps.len());
            for (bar, overlap) in bars.iter().zip(overlaps) {
                let row = names.iter().position(|name| *name == pair(&overlap.bodies)).expect("a row");
                #[allow(clippy::cast_precision_loss, reason = "a few rows")]
                let y = row as f64 + 1.0;
                assert_eq!(bar.points, overlap.span.map(|time| (time, y)));
            }
            let samples = &case.capture.as_ref().expect("a capture").post_impact.samples;
            for (k, panel) in of(format!("post_impact_motion_{}", case.name)).panels.iter().enumerate() {
                let time = study.approach.duration + samples[(samples.len() - 1) * k / 5].time;
                let end = study.approach.duration + samples[samples.len() - 1].time;
                let lasts = |[from, to]: [f64; 2]| from <= time && (time < to || to > end - 1e-9);
                let now = overlaps.iter().filter(|overlap| lasts(overlap.span));
                let bodies: BTreeSet<&String> = now.flat_map(|overlap| &overlap.bodies).collect();
                let outlines = panel.series.iter().filter(|series| series.label.as_deref() == Some("overlap"));
                assert_eq!(outlines.count(), bodies.len(), "{} at {time} s", case.name);
                *(if bodies.is_empty() { &mut without } else { &mut with }) += 1;
            }
        }
        assert!(with > 0 && without > 0, "{with} {without}");
    }

    /// Pins have their symbol, and bounces and rigid contacts have none; contacts are named by case, target and kind, those after
    /// the first impact with their times.
    #[test]
    fn contacts_are_named_and_marked_by_their_kinds() {
        let mut pins = 0;
        for name in ["elastic_rebound", "large_target"] {
            let scenario = scenario(name);
            let study = run(&scenario);
            let all = figures(&scenario, &study);
            let mut expected = Vec::new();
            let impacts =
                || study.cases.iter().filter_map(|case| case.capture.as_ref()).flat_map(CaptureResult::impacts);
            if !impacts().any(|impact| impact.contacts.iter().any(|made| made.contact.law == ContactLaw::Pin)) {
                let series = all.iter().flat_map(|figure| &figure.panels).flat_map(|panel| &panel.series);
                assert!(series.map(|series| series.label.as_deref()).all(|label| label != Some("pin")), "{name}");
            }
            for case in &study.cases {
                let capture = case.capture.as_ref().expect("a capture");
                let figure = all.iter().find(|it| it.name == format!("post_impact_motion_{}", case.name));
                let panel = figure.expect("the figure").panels.last().expect("pictures");
                let contacts = || capture.impacts().flat_map(|impact| &impact.contacts).map(|made| made.contact);
                let held = contacts().filter(|contact| contact.law == ContactLaw::Pin).count();
                let marks = panel.series.iter().filter(|series| series.label.as_deref() == Some("pin")).count();
                assert_eq!(marks, held, "{name} {}", case.name);
                pins += held;
                let first = case.approach(&study).duration;
                let times = std::iter::once(None).chain(capture.later_impacts.iter().map(|it| Some(first + it.time)));
                let digits = time_digits(&times.clone().map(|time| time.unwrap_or(first)).collect::<Vec<_>>());
                for (time, impact) in times.zip(capture.impacts()) {
                    for contact in impact.contacts.iter().map(|made| made.contact) {
                        let target = &scenario.targets[contact.target];
                        let arm = format!(" at {}", scenario.layout.arms[contact.arm].name);
                        let arm = if target.contacts.len() > 1 { arm } else { String::new() };
                        let time = time.map_or(String::new(), |time| format!(", {time:.digits$} s"));
                        let kind = match contact.law {
                            ContactLaw::Rigid => "",
                            ContactLaw::Pin => " (pin)",
                            ContactLaw::Bounce { .. } => " (bounce)",
                        };
                        expected.push(format!("{}, {}{arm}{time}{kind}", case.name, target.name));
                    }
                }
            }
            let velocities = all.iter().find(|figure| figure.name == "impact_velocities").expect("the figure");
            let AxisRange::Categories(names) = &velocities.panels[0].y.range else { panic!("names") };
            expected.reverse();
            assert_eq!(*names, expected);
        }
        assert!(pins > 0);
    }

    /// Joints have circles and end effectors none; a disc has the spoke that shows its yaw.
    #[test]
    fn pictures_show_joints_and_yaws() {
        let mut scenario = scenario("elastic_rebound");
        let study = run(&scenario);
        let disc = |target: &planar_capture::scenario::Target| matches!(target.outline, Outline::Disc { .. });
        let ball = scenario.targets.iter().position(disc).expect("a disc");
        scenario.targets[ball].yaw = 0.7;
        let all = figures(&scenario, &study);
        let panel = &all.iter().find(|figure| figure.name == "initial_configuration").expect("the figure").panels[0];
        let circles = panel.series.iter().filter(|series| matches!(series.mark, Mark::Points(_)));
        let links: Vec<usize> = scenario.layout.arms.iter().map(|arm| arm.links.len()).collect();
        assert_eq!(circles.map(|series| series.points.len()).collect::<Vec<_>>(), links);
        let target = &scenario.targets[ball];
        let ([x, y], radius) = (target.position.expect("a place"), target.outline.reach());
        let spoke = points(panel, &target.name);
        let (from, to) = (spoke[spoke.len() - 2], spoke[spoke.len() - 1]);
        assert_eq!(from, (x, y));
        assert!((to.0 - x - radius * f64::cos(0.7)).abs() + (to.1 - y - radius * f64::sin(0.7)).abs() < 1e-12);
    }

    /// The velocities that are wanted of each end effector are in the panel of their component.
    #[test]
    fn wanted_velocities_are_in_the_panels_of_their_components() {
        let mut scenario = scenario("raina_shah_2017");
        let study = run(&scenario);
        let twists = [[0.01, 0.02, 0.03], [0.04, 0.05, 0.06]];
        scenario.approach.end = FinalRates::EndEffectorTwists(twists.map(|twist| twist.map(Some)).to_vec());
        let all = figures(&scenario, &study);
        let figure = all.iter().find(|figure| figure.name == "approach_end_effector_velocities").expect("the figure");
        let component =
            |label: &str| ["rad/s", "x", "y"].iter().position(|part| label.contains(part)).expect("a component");
        for panel in &figure.panels {
            for (arm, twist) in twists.iter().enumerate() {
                let wanted = points(panel, &format!("arm{}, wanted", arm + 1));
                let value = twist[component(&panel.y.label)];
                assert_eq!(wanted, [(0.0, value), (20.0, value)], "{}", panel.y.label);
            }
        }
        assert_eq!(figure.panels.len(), 3);
    }

    /// After the impact the work of the approach still counts: what is left of the energy is the same up to the impact, and after it.
    #[test]
    fn energy_less_the_work_steps_at_the_impact_alone() {
        let scenario = scenario("raina_shah_2017");
        let study = run(&scenario);
        let all = figures(&scenario, &study);
        for case in &study.cases {
            let name = format!("energy_{}", case.name);
            let figure = all.iter().find(|figure| figure.name == name).expect("the figure");
            let less = points(&figure.panels[0], "less the work done");
            let exact = &case.capture.as_ref().expect("a capture").impact.exact;
            let work = study.approach.end().work.total();
            assert!(work.abs() > 1e-3, "{work} J");
            let (before, after) = less.split_at(study.approach.samples.len());
            let start = before[0].1;
            let end = start + exact.kinetic_energy_after - exact.kinetic_energy_before;
            assert!(before.iter().all(|(_, energy)| (energy - start).abs() < FIGURE_VALUES), "{name}");
            assert!(after.iter().all(|(_, energy)| (energy - end).abs() < FIGURE_VALUES), "{name}");
        }
    }

    /// All that is drawn in a picture of the plane is inside its frame, with far targets too.
    fn assert_inside(figure: &Figure) {
        for panel in figure.panels.iter().filter(|panel| panel.equal_scale) {
            let (AxisRange::Fixed(left, right), AxisRange::Fixed(low, high)) = (&panel.x.range, &panel.y.range) else {
                panic!("{}: a picture without a frame", figure.name)
            };
            for (x, y) in panel.series.iter().flat_map(|series| &series.points) {
                assert!((left..=right).contains(&x) && (low..=high).contains(&y), "{}: ({x}, {y})", figure.name);
            }
        }
    }

    #[test]
    fn every_kind_of_contact_has_its_figures() {
        let mut scenarios = vec!["spinning_target", "large_target", "missed_grasp", "elastic_rebound"];
        if cfg!(feature = "triple_arm_3r") {
            scenarios.push("three_arms");
        }
        for name in scenarios {
            let scenario = scenario(name);
            let all = figures(&scenario, &run(&scenario));
            assert_eq!(names(&all).len(), all.len(), "{name}: no two figures have the same name");
            for figure in &all {
                let svg = draw::svg(figure, Width::Page);
                assert_well_formed(&figure.name, &svg);
                assert_labelled(figure, &svg);
                assert_one_legend_entry_each(figure, &svg);
                assert_inside(figure);
            }
        }
    }

    /// What is at the ends of an axis of time, a step of a curve or a symbol, is neither on its frame nor cut by it.
    #[test]
    fn axes_of_time_have_a_margin() {
        // points: of a symbol the half width, of the narrowest frame the side
        let (symbol, frame) = (4.5, 130.0);
        let scenario = scenario("elastic_rebound");
        let mut panels = 0;
        for figure in figures(&scenario, &run(&scenario)) {
            for panel in figure.panels.iter().filter(|panel| panel.x.label.starts_with("Time")) {
                let AxisRange::Fixed(low, high) = panel.x.range else { panic!("{}: no frame", figure.name) };
                for (time, _) in panel.series.iter().flat_map(|series| &series.points) {
                    let room = (time - low).min(high - time) / (high - low) * frame;
                    assert!(room > symbol, "{}: {time} s is {room} points from the frame", figure.name);
                }
                panels += 1;
            }
        }
        assert!(panels > 30, "{panels}");
    }

    /// The points of a panel's series of this label, one after the other.
    fn points(panel: &Panel, label: &str) -> Vec<(f64, f64)> {
        let of = panel.series.iter().filter(|series| series.label.as_deref() == Some(label));
        of.flat_map(|series| series.points.clone()).collect()
    }

    /// Each detected impact has its picture: robot, targets and impulse at that time.
    #[test]
    fn impacts_are_pictured_where_they_were_found() {
        let scenario = scenario("elastic_rebound");
        let study = run(&scenario);
        let all = figures(&scenario, &study);
        let mut shown = 0;
        for case in &study.cases {
            let name = format!("impact_configuration_{}", case.name);
            let figure = all.iter().find(|figure| figure.name == name).expect("its figure");
            let captured = case.capture.as_ref().expect("a contact");
            let (first, post) = (case.approach(&study), &captured.post_impact);
            let at = |time: f64| post.samples.iter().find(|sample| sample.time >= time).expect("a sample");
            let later = captured.later_impacts.iter().map(|one| (first.duration + one.time, at(one.time), &one.impact));
            let impacts = std::iter::once((first.duration, first.end(), &captured.impact)).chain(later);
            assert_eq!(figure.panels.len(), 1 + captured.later_impacts.len());
            for (panel, (time, now, impact)) in figure.panels.iter().zip(impacts) {
                let title = panel.title.as_deref().unwrap_or_default();
                assert!(title.starts_with(&format!("Impact at {time:.3} s, ")) && title.ends_with(" N s"), "{title}");
                let result = &impact.contacts[0];
                let [_, x, y] = now.end_effector_poses[result.contact.arm];
                let several = !captured.later_impacts.is_empty();
                let arrow =
                    points(panel, if several { "impulse on the robot (own scale)" } else { "impulse on the robot" });
                assert_eq!(arrow[0], (x, y), "{name}: the arrow starts at the end effector");
                let (along, [_, fx, fy]) = ((arrow[1].0 - x, arrow[1].1 - y), result.impulse);
                assert!((along.0 * fy - along.1 * fx).abs() < 1e-12 && along.0 * fx + along.1 * fy > 0.0, "{name}");
                // a line from the target's COM to the end effector in contact
                let target = points(panel, &scenario.targets[result.contact.target].name);
                let [rx, ry] = result.contact.offset;
                let (from, to) = (target[target.len() - 2], target[target.len() - 1]);
                assert_eq!(to, (x, y));
                assert!((x - from.0 - rx).abs() + (y - from.1 - ry).abs() < 1e-12, "{name}");
                shown += 1;
            }
        }
        assert_eq!(shown, 5, "impacts of three cases");
    }

    /// Of many impacts the first, the last, and the largest between are pictured, in their order and of one scale, and the figure
    /// says how many are not.
    #[test]
    fn the_impacts_of_a_case_that_tell_most_are_shown() {
        let scenario = scenario("elastic_rebound");
        let mut study = run(&scenario);
        let captured = study.cases[0].capture.as_mut().expect("a contact");
        let again = captured.later_impacts[0].clone();
        captured.later_impacts = vec![again; 29];
        // of 30 in all: the second and the last are the smallest, the rest alike but for three
        let scaled = |impact: &mut planar_capture::capture::impact::ImpactSolution, factor: f64| {
            impact.contacts.iter_mut().for_each(|result| result.impulse = result.impulse.map(|part| part * factor));
        };
        for (place, factor) in [(2, 0.5), (30, 0.5), (21, 5.0), (9, 3.0), (12, 4.0)] {
            scaled(&mut captured.later_impacts[place - 2].impact, factor);
        }
        let all = figures(&scenario, &study);
        let of = |name: &str| all.iter().find(|figure| figure.name == name).unwrap_or_else(|| panic!("no {name}"));
        let many = of("impact_configuration_elastic");
        assert_eq!(many.title.as_deref(), Some("6 of 30 impacts: first, last, largest; 24 left out"));
        assert_eq!((many.panels.len(), many.columns), (6, 2));
        let panels = &many.panels;
        for (number, panel) in [1, 3, 9, 12, 21, 30].iter().zip(panels) {
            let title = panel.title.as_deref().unwrap_or_default();
            assert!(title.starts_with(&format!("Impact {number}: ")), "{title}");
            let side = |panel: &Panel| match panel.x.range {
                AxisRange::Fixed(low, high) => high - low,
                _ => panic!("a frame"),
            };
            assert!((side(panel) - side(&panels[0])).abs() < 1e-9 && side(panel) < 4.0, "a close-up of one scale");
        }
        let twice = of("impact_configuration_half");
        assert_eq!((twice.columns, &twice.title), (2, &None), "all of them");
        for width in [Width::Page, Width::Double, Width::Single] {
            let svg = draw::svg(many, width);
            assert_labelled(many, &svg);
            assert!(svg.contains("24 left out"), "{width:?}");
        }
    }

    /// A close-up shows all of an impulse, that of one which points away from the arm and beyond a small target, too.
    #[test]
    fn impulses_are_whole_in_close_ups() {
        let mut scenario = scenario("elastic_rebound");
        let mut study = run(&scenario);
        scenario.targets.iter_mut().for_each(|target| target.outline = Outline::disc(0.05));
        let captured = study.cases[0].capture.as_mut().expect("a contact");
        let impacts = captured.later_impacts.iter_mut().map(|later| &mut later.impact).chain([&mut captured.impact]);
        for result in impacts.flat_map(|impact| &mut impact.contacts) {
            result.impulse = result.impulse.map(|part| -part);
        }
        let all = figures(&scenario, &study);
        let figure = all.iter().find(|figure| figure.name == "impact_configuration_elastic").expect("the figure");
        for panel in &figure.panels {
            let arrow = points(panel, "impulse on the robot (own scale)");
            let apart = |a: &(f64, f64)| arrow.iter().map(|b| (a.0 - b.0).hypot(a.1 - b.1)).fold(0.0, f64::max);
            let length = arrow.iter().map(apart).fold(0.0, f64::max);
            // six tenths of the last link
            assert!((length - 0.6).abs() < 1e-9, "{length} m");
        }
        assert!(figure.panels.len() > 1);
    }

    /// Outlines that the layout gives are drawn, each in its arm's colour; a target is in no red, whatever the number of arms.
    #[test]
    fn links_have_their_outlines_and_targets_are_not_red() {
        let of = |name: &str| {
            let scenario = scenario(name);
            let all = figures(&scenario, &run(&scenario));
            let figure = all.into_iter().find(|figure| figure.name == "impact_configuration").expect("a figure");
            (scenario.layout, figure.panels.into_iter().next().expect("a panel").series)
        };
        let (layout, series) = of("raina_shah_2017");
        let links = layout.arms.iter().enumerate().flat_map(|(i, arm)| arm.links.iter().map(move |link| (i, link)));
        let given: Vec<_> = links.filter(|(_, link)| link.outline.is_some()).map(|(arm, _)| Colour::of(arm)).collect();
        let is_outline = |series: &&Series| series.label.is_none() && matches!(series.mark, Mark::Line(..));
        let outlines: Vec<_> = series.iter().filter(is_outline).collect();
        assert_eq!(outlines.iter().map(|series| series.colour).collect::<Vec<_>>(), given);
        assert!(given.len() == 6 && outlines.iter().all(|series| series.points.len() > 3));
        let (layout, series) = of("spinning_target");
        assert_eq!(layout.arms.len(), 1);
        let target = series.iter().find(|series| series.label.as_deref() == Some("disc")).expect("the target");
        assert!(target.colour != Colour::of(1) && target.colour != Colour::RED, "{:?}", target.colour);
    }

    /// Velocities after a bounce follow Poisson's law along the normal; a pin leaves the relative rotation free.
    #[test]
    fn velocities_at_contacts_say_what_kind_they_are() {
        let (rebound, loops) = (scenario("elastic_rebound"), scenario("large_target"));
        let (of_rebound, of_loops) = (run(&rebound), run(&loops));
        let panels = |scenario, study| -> Vec<Panel> {
            let found = figures(scenario, study).into_iter().find(|figure| figure.name == "impact_velocities");
            found.expect("the figure").panels
        };
        let shown = panels(&rebound, &of_rebound);
        let value = |panel: &Panel, label: &str, i: usize| points(panel, label)[i].0;
        let relative = |panels: &[Panel], when: &str, i: usize| {
            [0, 1, 2].map(|k| {
                value(&panels[k], &format!("end effector, {when}"), i)
                    - value(&panels[k], &format!("target, {when}"), i)
            })
        };
        let mut contacts: Vec<_> = Vec::new();
        for case in &of_rebound.cases {
            let captured = case.capture.as_ref().expect("a contact");
            contacts.extend(captured.impacts().flat_map(|impact| &impact.contacts));
        }
        contacts.reverse(); // the first is on top
        for (i, result) in contacts.iter().enumerate() {
            let ContactLaw::Bounce { normal: [nx, ny], restitution } = result.contact.law else { panic!("a bounce") };
            let [[bx, by, _], [ax, ay, _]] = ["before", "after"].map(|when| relative(&shown, when, i));
            let (closing, parting) = (-(bx * nx + by * ny), ax * nx + ay * ny);
            assert!(
                closing > 0.05 && (parting - restitution * closing).abs() < FIGURE_VALUES,
                "{i}: {closing}, {parting}"
            );
            assert!(((ax - bx) * ny - (ay - by) * nx).abs() > 1e-3, "{i}: without friction it slides");
        }
        let shown = panels(&loops, &of_loops);
        let AxisRange::Categories(names) = &shown[0].y.range else { panic!("names") };
        assert_eq!(names.len(), 6);
        for (i, name) in names.iter().enumerate() {
            let [x, y, turn] = relative(&shown, "after", i);
            assert!(x.abs() < FIGURE_VALUES && y.abs() < FIGURE_VALUES, "{name}: the points stay together");
            assert_eq!(turn.abs() > 1e-3, name.ends_with("(pin)"), "{name}: {turn} rad/s");
        }
    }

    /// A contact is in the pictures from the very sample of its impact on.
    #[test]
    fn contacts_are_pictured_from_their_impact_on() {
        let scenario = scenario("large_target");
        let study = run(&scenario);
        let all = figures(&scenario, &study);
        let mut pins = 0;
        for case in &study.cases {
            let contacts = &case.capture.as_ref().expect("a capture").impact.contacts;
            let name = format!("post_impact_motion_{}", case.name);
            let panel = &all.iter().find(|figure| figure.name == name).expect("the figure").panels[0];
            assert_eq!(panel.title.as_deref(), Some("0 s after the impact"));
            let made = contacts.iter().filter(|made| made.contact.law == ContactLaw::Pin).count();
            assert_eq!(points(panel, "pin").len(), made, "{name}");
            pins += made;
        }
        assert!(pins > 0);
    }

    /// Beside a rigid contact, one of another kind: end effector and target have velocities of their own after the impact.
    #[test]
    fn contacts_of_mixed_kinds_show_both_bodies_after_the_impact() {
        let scenario = scenario("spinning_target");
        let mut study = run(&scenario);
        let labels = |study: &planar_capture::capture::Study| -> BTreeSet<String> {
            let all = figures(&scenario, study);
            let figure = all.iter().find(|figure| figure.name == "impact_velocities").expect("the figure");
            figure.panels.iter().flat_map(|panel| &panel.series).filter_map(|series| series.label.clone()).collect()
        };
        let apart = labels(&study);
        assert!(apart.contains("target, after") && apart.contains("end effector, after"), "{apart:?}");
        assert!(!apart.contains("both, after"), "{apart:?}");
        study.cases.retain(|case| case.name == "rigid");
        let together = labels(&study);
        assert!(together.contains("both, after") && !together.contains("target, after"), "{together:?}");
    }

    /// Torques that begin at zero have their panel all the same.
    #[test]
    fn torques_that_begin_at_zero_are_shown() {
        let mut scenario = scenario("stabilised_capture");
        let joints = scenario.layout.joints();
        let panels = |scenario: &planar_capture::scenario::Scenario| -> Vec<String> {
            let study = run(scenario);
            let name = format!("post_impact_joints_{}", study.cases[0].name);
            let all = figures(scenario, &study);
            let figure = all.iter().find(|figure| figure.name == name).expect("the figure");
            figure.panels.iter().map(|panel| panel.y.label.clone()).collect()
        };
        let after = scenario.post_impact.as_mut().expect("a phase");
        // no spring is stretched yet
        after.control =
            PostCaptureControl::Hold { proportional_gain: vec![5.0; joints], derivative_gain: vec![0.0; joints] };
        after.actuation = Actuation::default();
        let shown = panels(&scenario);
        assert_eq!(shown.last().map(String::as_str), Some("Joint torque [N m]"));
        scenario.post_impact.as_mut().expect("a phase").control = PostCaptureControl::None;
        assert_eq!(panels(&scenario), shown[..2]);
    }

    /// A distant target is an arrow at the edge, and does not scale down the robot.
    #[test]
    fn a_target_far_away_is_an_arrow_at_the_edge() {
        let scenario = scenario("elastic_rebound");
        let study = run(&scenario);
        let all = figures(&scenario, &study);
        let figure = all.iter().find(|figure| figure.name == "post_impact_motion_too_late").expect("the figure");
        let panel = figure.panels.last().expect("pictures");
        let AxisRange::Fixed(left, right) = panel.x.range else { panic!("a frame") };
        let end = study.cases[2].capture.as_ref().and_then(|captured| captured.targets.last()).expect("targets");
        let [_, x, y] = end[1].pose;
        assert!(x < left && right - left < 12.0, "the box at {x} m is outside of {left} to {right} m");
        let arrow = points(panel, "box");
        let (from, to) = (arrow[0], arrow[1]);
        assert_eq!(arrow.len(), 5, "an arrow, no outline");
        assert!(to.0 < from.0 && to.0 < left + 0.05 * (right - left), "at the left edge, outwards");
        assert!(((to.1 - from.1) / (to.0 - from.0)).abs() < 0.2 && y.abs() < 2.0);
    }

    /// Momentum is continuous at every impact; energy steps there by its loss.
    #[test]
    fn momentum_and_energy_over_all_impacts() {
        let scenario = scenario("elastic_rebound");
        let study = run(&scenario);
        let all = figures(&scenario, &study);
        let of = |name: &str| all.iter().find(|figure| figure.name == name).expect("the figure");
        let captured = study.cases[1].capture.as_ref().expect("a contact");
        for panel in &of("momentum_half").panels {
            let curves = panel.series.iter().filter(|series| matches!(series.mark, Mark::Line(..)));
            for curve in curves {
                let first = curve.points[0].1;
                assert!(curve.points.iter().all(|(_, p)| (p - first).abs() < FIGURE_VALUES), "{:?}", curve.label);
            }
            let marks = points(panel, "impacts");
            assert_eq!(marks.len(), 2 * (panel.series.len() - 1), "two on each curve");
        }
        let less = points(&of("energy_half").panels[0], "less the work done");
        let steps: Vec<f64> = less
            .windows(2)
            .filter(|pair| pair[0].0.to_bits() == pair[1].0.to_bits())
            .map(|pair| pair[1].1 - pair[0].1)
            .collect();
        let impacts = captured.impacts();
        let costs: Vec<f64> =
            impacts.map(|impact| impact.exact.kinetic_energy_after - impact.exact.kinetic_energy_before).collect();
        assert_eq!(steps.len(), costs.len());
        assert!(
            steps.iter().zip(&costs).all(|(step, cost)| *cost < -0.01 && (step - cost).abs() < FIGURE_VALUES),
            "{steps:?}"
        );
        assert!(less.windows(2).all(|pair| {
            pair[0].0.to_bits() == pair[1].0.to_bits() || (pair[1].1 - pair[0].1).abs() < FIGURE_VALUES
        }));
    }

    /// The numbers of an attribute of the root of an SVG.
    fn root(svg: &str, name: &str) -> Vec<f64> {
        let (root, _) = svg.split_once('>').expect("a root");
        let value = root.split(&format!(" {name}=\"")).nth(1).and_then(|rest| rest.split('"').next());
        let value = value.unwrap_or_else(|| panic!("no {name} in {root}")).trim_end_matches("pt");
        value.split(' ').map(|number| number.parse().expect("a number")).collect()
    }

    /// As wide as the columns of a journal, with text of the same size in all of them; PDF with its fonts.
    #[test]
    fn figures_fit_the_columns_of_journals() {
        let scenario = scenario("raina_shah_2017");
        let all = figures(&scenario, &run(&scenario));
        for (width, points, text) in [(Width::Single, 252.0, 7.0), (Width::Double, 516.0, 8.0)] {
            for figure in &all {
                let svg = draw::svg(figure, width);
                assert_well_formed(&figure.name, &svg);
                assert_labelled(figure, &svg);
                let (shown, own) = (root(&svg, "width")[0], root(&svg, "viewBox")[2]);
                assert_eq!(root(&svg, "width"), [points], "{}", figure.name);
                let size = 12.0 * shown / own;
                assert!((0.8 * text..1.01 * text).contains(&size), "{}: text of {size} points", figure.name);
            }
        }
        let of = |name: &str| all.iter().find(|figure| figure.name == name).expect("a figure");
        for (width, page) in [(Width::Page, None), (Width::Single, Some("252"))] {
            let pdf = draw::pdf(of("momentum_case1"), width).expect("drawn");
            assert_eq!(pdf, draw::pdf(of("momentum_case1"), width).expect("drawn"), "the same bytes");
            let text = String::from_utf8_lossy(&pdf);
            let media = text.find("/MediaBox").map_or("", |at| text[at..].lines().next().unwrap_or_default());
            assert!(text.starts_with("%PDF-") && text.contains("/FontFile") && text.contains("+DejaVuSans"));
            assert!(page.is_none_or(|page| media.contains(&format!(" 0 {page} "))), "{width:?}: {media}");
        }
        let single = png_size(&draw::png(of("momentum_case1"), Width::Single).expect("drawn")).0;
        assert!((1300..1500).contains(&single), "400 pixels an inch, not {single}");
    }

    /// Colours are of arms and targets; what is of the base or the whole has none.
    #[test]
    fn an_arm_has_one_colour() {
        let scenario = scenario("raina_shah_2017");
        let all = figures(&scenario, &run(&scenario));
        for figure in &all {
            for series in figure.panels.iter().flat_map(|panel| &panel.series) {
                let label = series.label.as_deref().unwrap_or_default();
                let arm = ["arm1", "arm2"].iter().position(|arm| label.starts_with(arm));
                let target = ["target1", "target2"].iter().position(|target| label.starts_with(target));
                match (arm, target) {
                    (Some(arm), _) => assert_eq!(series.colour, Colour::of(arm), "{}: {label}", figure.name),
                    (None, Some(target)) => {
                        assert_eq!(series.colour, Colour::of(2 + target), "{}: {label}", figure.name);
                    }
                    (None, None) => {
                        // the joints of an arm have no label
                        assert!(
                            label.is_empty() || (0..4).all(|i| series.colour != Colour::of(i)),
                            "{}: `{label}`",
                            figure.name
                        );
                    }
                }
            }
        }
    }

    /// Panels of momenta that no actuator changes say that their curves are level.
    #[test]
    fn level_momenta_are_said_to_be_so() {
        let titles = |name: &str| {
            let scenario = scenario(name);
            let all = figures(&scenario, &run(&scenario));
            let momentum = all.into_iter().find(|figure| figure.name.starts_with("momentum")).expect("a figure");
            momentum.panels.into_iter().map(|panel| panel.title.unwrap_or_default()).collect::<Vec<_>>()
        };
        assert_eq!(titles("raina_shah_2017"), ["exact equations: constant to rounding"; 2]);
        assert_eq!(titles("elastic_rebound"), ["constant to rounding"; 2]);
        // a base torque changes the angular momentum
        assert_eq!(titles("stabilised_capture"), ["exact equations: constant to rounding", ""]);
    }

    /// Every figure is of a kind, and every kind is drawn.
    #[test]
    fn figures_have_the_kinds_that_can_be_asked_for() {
        let mut unused: BTreeSet<&str> = FIGURE_KINDS.into_iter().collect();
        for name in ["raina_shah_2017", "redysim_single_arm_3r"] {
            let scenario = scenario(name);
            for figure in figures(&scenario, &run(&scenario)) {
                let kinds: Vec<_> = FIGURE_KINDS.into_iter().filter(|kind| begins_with(&figure.name, kind)).collect();
                assert!(!kinds.is_empty(), "{}", figure.name);
                for kind in kinds {
                    unused.remove(kind);
                }
            }
        }
        assert!(unused.is_empty(), "{unused:?}");
        assert!(is_kind("approach") && is_kind("momentum") && !is_kind("moment") && !is_kind(""));
    }

    #[test]
    fn some_figures_can_be_asked_for() {
        let folder = TempDir::new().expect("a folder");
        let results = folder.path().join("results");
        let run = |list: &str| {
            let mut command = command();
            command.arg("run").arg(file("scenarios/redysim_single_arm_3r.toml")).arg("-q");
            planar_proof::said(command.arg(list).arg("--out").arg(&results).output().expect("it runs"))
        };
        assert_eq!(run("--figures=approach_base,momentum").0, 0);
        let mut names: Vec<_> = fs::read_dir(results.join("figures")).expect("figures").collect();
        let name = |entry: Result<fs::DirEntry, std::io::Error>| entry.expect("an entry").file_name();
        let names: BTreeSet<_> = names.drain(..).map(name).map(|name| name.to_string_lossy().into_owned()).collect();
        let wanted = ["approach_base", "momentum_redysim_single_arm_3r"];
        let wanted = wanted.iter().flat_map(|name| ["svg", "pdf", "png"].map(|kind| format!("{name}.{kind}")));
        assert_eq!(names, wanted.collect());
        let (code, _, err) = run("--figures=momentun");
        assert_eq!(code, 2);
        assert!(err.contains("did you mean `momentum`?") && err.contains("post_impact_motion"), "{err}");
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
            let svg = draw::svg(&Figure::column("many", vec![panel]), Width::Page);
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
