//! The tables of keys: themselves, paths to keys, and what is written from them: reference, schemas, templates.

use crate::said;
use planar_capture::file_format::FileFormat;
use planar_capture::format::{Default, Key, Shape, ShapeAt, Step, TableFormat, With};
use planar_capture::scenario::{KeyFile, find_key};
use planar_capture::{layout, scenario};
use planar_proof::file;
use std::fs;
use tempfile::TempDir;

/// With this variable the written files are written.
const WRITE: &str = "PLANAR_CAPTURE_WRITE";

/// Every table of a file, each once.
fn tables(root: &'static TableFormat) -> Vec<&'static TableFormat> {
    let inner = root.keys.iter().filter_map(|key| match key.shape {
        Shape::Table(table) | Shape::Tables(table) => Some(table),
        _ => None,
    });
    let mut all = vec![root];
    for table in inner.flat_map(tables) {
        if !all.iter().any(|known| std::ptr::eq(*known, table)) {
            all.push(table);
        }
    }
    all
}

fn choices(key: &Key) -> Vec<&'static str> {
    match &key.shape {
        Shape::Choice(of) | Shape::OneOrList(Shape::Choice(of), _) => of().iter().map(|choice| choice.name).collect(),
        _ => Vec::new(),
    }
}

#[test]
fn tables_of_keys_agree_with_themselves() {
    for table in [&layout::FORMAT, &scenario::FORMAT].into_iter().flat_map(tables) {
        let names = table.names();
        assert!(table.one_of.iter().all(|name| names.contains(name)), "{}", table.doc);
        for (i, name) in names.iter().enumerate() {
            assert!(!names[..i].contains(name), "entries of `{name}` are not beside each other");
        }
        for key in table.keys {
            match key.with {
                Some(With::Choice(selector, with)) => {
                    let known = choices(table.key(selector).expect(selector));
                    assert!(with.iter().all(|choice| known.contains(choice)), "{}: {with:?} of {known:?}", key.name);
                }
                Some(With::Key(others)) => assert!(others.iter().all(|other| names.contains(other)), "{}", key.name),
                None => assert_eq!(table.variants(key.name).count(), 1, "{} without a choice", key.name),
            }
            match key.default {
                Default::Choice(choice) => assert!(choices(key).contains(&choice), "{}", key.name),
                Default::Number(_) => assert!(key.shape.rule().is_some(), "{}", key.name),
                _ => {}
            }
            let doc = key.doc;
            assert!(!doc.is_empty() && !doc.ends_with('.') && !doc.contains('\n'), "{}: {doc}", key.name);
        }
    }
}

#[test]
fn paths_lead_to_keys() {
    for (path, file, name, unit) in [
        ("approach.duration", KeyFile::Scenario, "duration", "s"),
        ("approach.proportional_gain", KeyFile::Scenario, "proportional_gain", "N m/rad"),
        ("approach.proportional_gain[2]", KeyFile::Scenario, "proportional_gain", "N m/rad"),
        ("initial.base_twist[0]", KeyFile::Scenario, "base_twist", "rad/s"),
        ("initial.joint_angles[5]", KeyFile::Scenario, "joint_angles", "rad"),
        ("target.target1.inertia", KeyFile::Scenario, "inertia", "kg m²"),
        ("target.\"my.t\".mass", KeyFile::Scenario, "mass", "kg"),
        ("target.'my t'.contact[1]", KeyFile::Scenario, "contact", "m"),
        ("target.t.contact[1][0]", KeyFile::Scenario, "contact", "m"),
        ("target.t.polygon[3][1]", KeyFile::Scenario, "polygon", "m"),
        ("case.case1.target_twists.target1[0]", KeyFile::Scenario, "target_twists", "rad/s"),
        ("case.case1.restitutions.\"a.b\"", KeyFile::Scenario, "restitutions", ""),
        ("limits.joint_angles[0][1]", KeyFile::Scenario, "joint_angles", "rad"),
        ("limits.joint_angles[1]", KeyFile::Scenario, "joint_angles", "rad"),
        ("layout.base.mass", KeyFile::Layout, "mass", "kg"),
        ("layout.arm.arm1.link[0].com[1]", KeyFile::Layout, "com", "m"),
        ("layout.arm.arm1.link[2].outline.capsule", KeyFile::Layout, "capsule", "m"),
        ("layout.base.outline.box[1]", KeyFile::Layout, "box", "m"),
    ] {
        let (found, place) = find_key(path).unwrap_or_else(|error| panic!("{error}"));
        let rule = place.number().unwrap_or_else(|| panic!("{path} is no number: {place:?}"));
        assert_eq!((found, place.keys[0].name, rule.unit()), (file, name, unit), "{path}");
    }
    let (_, place) = find_key("target.\"my.\\\"t\\\"\".contact[1]").expect("a quoted name");
    let key = |name: &str| Step::Key(name.to_owned());
    let steps = [key("target"), Step::Named("my.\"t\"".to_owned()), key("contact"), Step::Index(1)];
    assert_eq!(place.steps, steps);
    // entries for each law, and what is no single number
    assert_eq!(find_key("approach.proportional_gain").map(|(_, place)| place.keys.len()), Ok(2));
    let (file, place) = find_key("layout").expect("the key of the scenario");
    assert!(file == KeyFile::Scenario && place.number().is_none());
    assert!(matches!(place.shape, ShapeAt::Whole(Shape::Text(_))));
    assert!(find_key("initial.base_pose").is_ok_and(|(_, place)| place.number().is_none()));
    assert!(find_key("target.t").is_ok_and(|(_, place)| matches!(place.shape, ShapeAt::Whole(Shape::Tables(_)))));
}

#[test]
fn wrong_paths_name_the_nearest() {
    for (path, nearest, part) in [
        ("aproach.duration", Some("approach.duration"), "the top level has no key `aproach`"),
        ("approach.proportional_gian[2]", Some("approach.proportional_gain[2]"), "did you mean `approach.prop"),
        ("target.\"my.t\".mas", Some("target.\"my.t\".mass"), "`target.\"my.t\"` has no key `mas`"),
        ("layout.arm.arm1.link[0].mas", Some("layout.arm.arm1.link[0].mass"), "`layout.arm.arm1.link[0]` has no"),
        ("layout.bsae.mass", Some("layout.base.mass"), "`layout` has no key `bsae`"),
        ("approach.xyz", None, "expected `duration`, `step`"),
        ("layout.arm.arm1.link.mass", None, "at `layout.arm.arm1.link`: these tables have no names"),
        ("target[0].mass", None, "at `target`: these tables have names"),
        (
            "approach.duration[0]",
            None,
            "at `approach.duration`: it is a duration in s greater than 0, which has no elements",
        ),
        ("approach.duration.x", None, "which has no keys"),
        ("initial.base_pose[3]", None, "[yaw, x, y] in rad, m, m, expected an index less than 3"),
        ("initial.base_pose[0][0]", None, "it is a number, expected the end of the path"),
        ("layout.base.outline.ends[2][0]", None, "2 elements"),
        ("approach[0]", None, "at `approach`: expected a key of it: `duration`"),
        ("approach.final_joint_angles[x]", None, "`[x]` is no index"),
        ("approach.final_joint_angles[-1]", None, "`[-1]` is no index"),
        ("approach.final_joint_angles[99999999999999999999999]", None, "is no index"),
        ("approach..duration", None, "expected a key at `.duration`"),
        ("approach duration", None, "expected `.` or `[` before ` duration`"),
        ("target.\"my.t.mass", None, "expected a key at `\"my.t.mass`"),
        ("", None, "expected a key at ``"),
    ] {
        let error = find_key(path).expect_err(path);
        assert_eq!(error.nearest.as_deref(), nearest, "{error}");
        assert!(error.to_string().contains(part), "{error}");
        assert!(error.to_string().starts_with(&format!("`{path}`: ")), "{error}");
    }
}

#[test]
fn reference_and_schemas_are_fresh() {
    for format in FileFormat::ALL {
        let name = format.name();
        let files = [
            (format!("docs/reference/{name}.md"), format.reference()),
            (format!("schemas/{name}.json"), format.schema()),
        ];
        for (path, text) in files {
            if std::env::var_os(WRITE).is_some() {
                fs::write(file(&path), &text).expect("written");
            }
            let found = fs::read_to_string(file(&path)).unwrap_or_default();
            let update = format!("{WRITE}=1 cargo test --test commands formats");
            assert!(found == text, "{path} is not what the tables of keys give: run `{update}`");
        }
    }
}

#[test]
fn templates_are_valid_and_run() {
    let folder = TempDir::new().expect("a folder");
    for format in FileFormat::ALL {
        let name = format.name();
        let path = folder.path().join(format!("{name}.toml"));
        let path = path.to_str().expect("a path");
        assert_eq!(said(&["template", name, "--out", path]), (0, String::new(), String::new()));
        let text = fs::read_to_string(path).expect("a template");
        assert_eq!(said(&["template", name]), (0, text.clone(), String::new()));
        assert_eq!(text, format.template());
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
        let (code, out, err) = said(&["check", path]);
        assert!(code == 0 && err.is_empty() && out.ends_with("no warnings\n"), "{out}{err}");
        // it is not overwritten
        let (code, _, err) = said(&["template", name, "--out", path]);
        assert!(code == 2 && err.contains("already exists"), "{err}");
    }
    let path = folder.path().join("scenario.toml");
    let results = folder.path().join("results");
    let [path, results] = [&path, &results].map(|path| path.to_str().expect("a path"));
    let (code, out, err) = said(&["run", path, "--out", results]);
    assert!(code == 0 && out.contains("case1"), "{out}{err}");
}

/// Every key stands in the template, with a value that the reader takes where its condition holds.
#[test]
fn every_line_of_a_template_can_be_switched_on() {
    for format in FileFormat::ALL {
        let text = format.template();
        let is_entry =
            |line: &str| line.strip_prefix("# ").filter(|rest| is_header(rest) || is_assignment(rest)).is_some();
        for table in
            tables(format.table()).into_iter().filter(|table| table.one_of != planar_capture::outline::FORMAT.one_of)
        {
            for name in table.names() {
                let written = [format!("\n{name} = "), format!("\n# {name} = "), format!("{name}]")];
                assert!(written.iter().any(|written| text.contains(written)), "no {name} in\n{text}");
            }
        }
        for (at, line) in text.lines().enumerate().filter(|(_, line)| is_entry(line)) {
            // an empty table around a key that is switched on alone
            let mut lines: Vec<_> = text.lines().map(str::to_owned).collect();
            lines[at] = line[2..].to_owned();
            let header = lines[..at].iter().rposition(|line| is_header(line.trim_start_matches("# "))).unwrap_or(0);
            if let Some(rest) = lines[header].strip_prefix("# ").filter(|rest| is_header(rest)) {
                lines[header] = rest.to_owned();
            }
            let report = match format {
                FileFormat::Layout => layout::Layout::parse(&lines.join("\n"), "t.toml").err(),
                FileFormat::Scenario => {
                    let shipped = planar_capture::registry::SHIPPED;
                    scenario::Scenario::parse(&lines.join("\n"), "t.toml", std::path::Path::new(""), shipped).err()
                }
            };
            // what remains is a condition of the key, or one that excludes another: no wrong type, no unknown key
            let shown = report.map(|report| report.to_string()).unwrap_or_default();
            assert!(!shown.contains("unknown key") && !shown.contains("not valid TOML"), "{line}: {shown}");
            let refused =
                ["is there too", "only `tracking", "expected `control`", "expected `control =", "acts on the base"];
            let refused =
                refused.into_iter().chain(["bounces", "without control", "longer than the phase", "to move on"]);
            assert!(shown.is_empty() || refused.into_iter().any(|part| shown.contains(part)), "{line}: {shown}");
        }
    }
}

fn is_header(line: &str) -> bool {
    line.starts_with('[') && line.ends_with(']')
}

fn is_assignment(line: &str) -> bool {
    line.split_once(" = ").is_some_and(|(key, _)| key.chars().all(|c| c.is_ascii_lowercase() || c == '_'))
}

/// No value under any key makes a reader panic: each is read or reported.
#[test]
fn any_value_of_any_key_is_read_or_reported() {
    let values = [
        "true",
        "1",
        "-1.5",
        "nan",
        "\"x\"",
        "[]",
        "[[]]",
        "[1]",
        "[1, 2]",
        "[1, 2, 3]",
        "[[1, 2], [3, 4]]",
        "{}",
        "{ a = 1 }",
    ];
    let values = values.into_iter().chain([
        "[\"x\", 1]",
        "[[\"x\", \"y\"]]",
        "{ target1 = [1, 2, 3] }",
        "{ target1 = [[], 1] }",
    ]);
    let values: Vec<_> = values.collect();
    for format in FileFormat::ALL {
        let lines: Vec<_> = format.template().lines().map(str::to_owned).collect();
        let text = |lines: &[String]| lines.join("\n");
        for (at, line) in lines.iter().enumerate() {
            let entry = line.trim_start_matches("# ");
            let Some((key, _)) = entry.split_once(" = ").filter(|_| is_assignment(entry)) else { continue };
            for law in ["pd", "exact", "computed_torque", "resolved_motion_rate"] {
                for value in &values {
                    let mut lines = lines.clone();
                    lines[at] = format!("{key} = {value}");
                    let header = lines[..at].iter().rposition(|line| is_header(line.trim_start_matches("# ")));
                    if let Some(header) = header {
                        lines[header] = lines[header].trim_start_matches("# ").to_owned();
                    }
                    let text =
                        text(&lines).replace("\ntracking = \"computed_torque\"", &format!("\ntracking = \"{law}\""));
                    let report = match format {
                        FileFormat::Layout => layout::Layout::parse(&text, "t.toml").err(),
                        FileFormat::Scenario => {
                            let shipped = planar_capture::registry::SHIPPED;
                            scenario::Scenario::parse(&text, "t.toml", std::path::Path::new(""), shipped).err()
                        }
                    };
                    assert!(report.is_none_or(|report| report.count() > 0));
                }
                if format == FileFormat::Layout {
                    break;
                }
            }
        }
    }
}

#[test]
fn robots_and_names_are_listed() {
    let (code, out, err) = said(&["list"]);
    assert_eq!((code, err.as_str()), (0, ""));
    for part in
        ["dual_arm_3r", "2 arms of 3 + 3, generated", "approach.tracking\n  pd  ", "resolved_motion_rate", "stabilise"]
    {
        assert!(out.contains(part), "no `{part}` in\n{out}");
    }
    assert!(out.contains("approach.integrator, post_impact.integrator\n"), "{out}");
    assert!(out.lines().all(|line| line.chars().count() <= 100), "{out}");
}

#[test]
fn completions_and_manual_name_every_command() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let (code, out, err) = said(&["completions", shell]);
        assert!(
            code == 0 && err.is_empty() && out.contains("planar-capture") && out.contains("reproduce"),
            "{shell}: {err}"
        );
    }
    let (code, out, err) = said(&["man"]);
    assert!(
        code == 0 && err.is_empty() && out.contains(".TH planar-capture 1") && out.contains("planar\\-capture\\-run"),
        "{out}{err}"
    );
    let (code, out, _) = said(&["man", "run"]);
    assert!(code == 0 && out.contains("planar\\-capture\\-run \\-"), "{out}");
    let (code, _, err) = said(&["man", "rum"]);
    assert!(code == 2 && err.contains("no command `rum`") && err.contains("run"), "{err}");
}
