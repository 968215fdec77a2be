//! The tables of keys: themselves, paths to keys, and what is written from them: reference, schemas, templates.

use crate::said;
use planar_capture::campaign::Campaign;
use planar_capture::diagnostic::Report;
use planar_capture::file_format::FileFormat;
use planar_capture::format::{Default, Example, Key, Shape, ShapeAt, Step, TableFormat, With};
use planar_capture::registry::SHIPPED;
use planar_capture::scenario::{KeyFile, find_key};
use planar_capture::{layout, scenario};
use planar_proof::file;
use serde_json::Value;
use std::fs;
use std::path::Path;
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

/// Those that have a header in a template, each once.
fn tables_with_headers(root: &'static TableFormat) -> Vec<&'static TableFormat> {
    let inner = root.keys.iter().filter_map(|key| match (key.shape, key.example) {
        (_, Example::Start(_) | Example::Comment(_)) => None,
        (Shape::Table(table) | Shape::Tables(table), _) => Some(table),
        _ => None,
    });
    [root].into_iter().chain(inner.flat_map(tables_with_headers)).collect()
}

/// What the reader of a kind of file has against a text.
fn report(format: FileFormat, text: &str, folder: &Path) -> Option<Report> {
    match format {
        FileFormat::Layout => layout::Layout::parse(text, "t.toml").err(),
        FileFormat::Scenario => scenario::Scenario::parse(text, "t.toml", folder, SHIPPED).err(),
        FileFormat::Sweep => Campaign::parse(text, "t.toml", folder, SHIPPED).err(),
    }
}

/// A folder with the files that templates name.
fn folder() -> TempDir {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("scenario.toml"), FileFormat::Scenario.template()).expect("written");
    folder
}

fn choices(key: &Key) -> Vec<&'static str> {
    key.shape.choices().unwrap_or_default().iter().map(|choice| choice.name).collect()
}

#[test]
fn tables_of_keys_agree_with_themselves() {
    for table in FileFormat::ALL.iter().flat_map(|format| tables(format.table())) {
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
    for format in FileFormat::ALL.iter().copied() {
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
    for format in FileFormat::ALL.iter().copied() {
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

/// What a value breaks of a schema, for the words that the schemas here have.
fn broken(schema: &Value, value: &Value, path: &str, problems: &mut Vec<String>) {
    let mut problem = |what: &str| problems.push(format!("{path}: {what}"));
    let known =
        ["$schema", "title", "type", "description", "default", "x-taplo", "properties", "required", "oneOf", "anyOf"];
    let known = known.into_iter().chain(["additionalProperties", "enum", "items", "minItems", "maxItems"]);
    let known: Vec<_> = known.chain(["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"]).collect();
    let Value::Object(words) = schema else { return problem("this schema is no object") };
    for word in words.keys().filter(|word| !known.contains(&word.as_str())) {
        problem(&format!("the schema says `{word}`"));
    }
    let is_of_type = match schema["type"].as_str() {
        Some("object") => value.is_object(),
        Some("array") => value.is_array(),
        Some("string") => value.is_string(),
        Some("number") => value.is_number(),
        Some("integer") => value.is_u64(),
        Some("boolean") => value.is_boolean(),
        _ => schema["anyOf"].is_array(),
    };
    if !is_of_type {
        problem(&format!("the type of {value}"));
    }
    let number = value.as_f64().unwrap_or_default();
    let beyond =
        |word: &str, is_beyond: fn(f64, f64) -> bool| schema[word].as_f64().is_some_and(|end| is_beyond(number, end));
    if beyond("minimum", |x, end| x < end) || beyond("maximum", |x, end| x > end) {
        problem(&format!("the range of {value}"));
    }
    if beyond("exclusiveMinimum", |x, end| x <= end) || beyond("exclusiveMaximum", |x, end| x >= end) {
        problem(&format!("the range of {value}"));
    }
    if schema["enum"].as_array().is_some_and(|names| !names.contains(value)) {
        problem(&format!("{value} is no choice"));
    }
    let count = |word: &str| {
        let holds = |schema: &&Value| {
            let mut inner = Vec::new();
            let needed: Vec<_> =
                schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
            if schema["type"].is_null() && schema["anyOf"].is_null() {
                return needed.iter().all(|key| value.get(*key).is_some());
            }
            broken(schema, value, path, &mut inner);
            inner.is_empty()
        };
        schema[word].as_array().map(|schemas| schemas.iter().filter(holds).count())
    };
    if count("anyOf") == Some(0) || count("oneOf").is_some_and(|count| count != 1) {
        problem(&format!("the alternatives of {value}"));
    }
    for key in schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        if value.get(key).is_none() {
            problem(&format!("no {key}"));
        }
    }
    let items = value.as_array().map_or(&[][..], Vec::as_slice);
    let length = |word: &str| schema[word].as_u64().map(|length| usize::try_from(length).expect("a length"));
    if length("minItems").is_some_and(|least| items.len() < least)
        || length("maxItems").is_some_and(|most| items.len() > most)
    {
        problem(&format!("the length of {value}"));
    }
    for (i, item) in items.iter().enumerate() {
        let of_item = if schema["items"].is_array() { &schema["items"][i] } else { &schema["items"] };
        if !of_item.is_null() {
            broken(of_item, item, &format!("{path}[{i}]"), problems);
        }
    }
    for (key, value) in value.as_object().into_iter().flatten() {
        let path = format!("{path}.{key}");
        match (&schema["properties"][key], &schema["additionalProperties"]) {
            (Value::Null, Value::Bool(false)) => problems.push(format!("{path} is unknown")),
            (Value::Null, other) => broken(other, value, &path, problems),
            (property, _) => broken(property, value, &path, problems),
        }
    }
}

#[test]
fn every_tracked_file_fits_its_schema() {
    let is_sweep = |text: &str| text.contains("\n[[vary]]\n");
    let folders = |format| match format {
        FileFormat::Layout => &["codegen/layouts", "codegen/structures"][..],
        FileFormat::Scenario => &["scenarios", "scenarios/sweeps"],
        FileFormat::Sweep => &["scenarios/sweeps"],
    };
    for format in FileFormat::ALL.iter().copied() {
        let schema: Value = serde_json::from_str(&format.schema()).expect("JSON");
        let problems = |text: &str| {
            let value = toml::from_str::<Value>(text).expect("TOML");
            let mut problems = Vec::new();
            broken(&schema, &value, "", &mut problems);
            problems
        };
        let paths = folders(format).iter().flat_map(|folder| fs::read_dir(file(folder)).expect("a folder"));
        let paths = paths
            .map(|entry| entry.expect("an entry").path())
            .filter(|path| path.extension().is_some_and(|e| e == "toml"));
        let texts = paths.map(|path| fs::read_to_string(path).expect("a file")).chain([format.template()]);
        let texts: Vec<_> = texts.filter(|text| is_sweep(text) == (format == FileFormat::Sweep)).collect();
        assert!(texts.len() > if format == FileFormat::Sweep { 1 } else { 7 });
        for text in &texts {
            assert_eq!(problems(text), Vec::<String>::new(), "{text}");
        }
        let wrong = match format {
            FileFormat::Layout => [
                ("\nmass = ", "\nmas = ", ".base.mas is unknown"),
                ("500.0", "-5", ".base.mass: the range of -5"),
                ("[0.5, 0.0]", "[0.5]", ".arm[0].mount: the length"),
                ("inertia = 83.61\n", "", ".base: no inertia"),
                (
                    "inertia = 83.61",
                    "inertia = 1\noutline = { disc = 1, box = [1, 1] }",
                    ".base.outline: the alternatives",
                ),
            ],
            FileFormat::Scenario => [
                (
                    "\ntrajectory = \"quintic\"",
                    "\ntrajectory = \"quartik\"",
                    ".approach.trajectory: \"quartik\" is no choice",
                ),
                ("radius = 0.5", "", ".target[0]: the alternatives"),
                ("target1 = [0.2, ", "target1 = [", ".case[0].target_twists.target1: the length"),
                ("name = \"my_study\"", "name = 5", ".name: the type of 5"),
                ("# restitution = 0.0", "restitution = 2", ".target[0].restitution: the range of 2"),
            ],
            FileFormat::Sweep => [
                ("cases = 1000", "cases = 1.5", ".cases: the type of 1.5"),
                ("seed = 1\n", "", ": no seed"),
                ("{ normal = { mean = 10.0, std = 1.0 }, min", "{ min", ".vary[0].distribution: the alternatives"),
                ("std = 1.0", "std = 0", ".vary[0].distribution.normal.std: the range of 0"),
                ("# sampling = \"random\"", "sampling = \"sobel\"", ".sampling: \"sobel\" is no choice"),
            ],
        };
        for (from, to, problem) in wrong {
            let text = format.template();
            assert!(text.contains(from), "{from}");
            let found = problems(&text.replacen(from, to, 1));
            assert!(found.iter().any(|found| found.contains(problem)), "{from} -> {to}: {found:?}");
        }
    }
}

/// Every key stands in the template, with a value that the reader takes where its condition holds.
#[test]
fn every_line_of_a_template_can_be_switched_on() {
    let folder = folder();
    for format in FileFormat::ALL.iter().copied() {
        let text = format.template();
        let is_entry = |line: &str| line.strip_prefix("# ").is_some_and(|rest| is_header(rest) || is_assignment(rest));
        for table in tables_with_headers(format.table()) {
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
            let report = report(format, &lines.join("\n"), folder.path());
            // what remains is a condition of the key, or one that excludes another: no wrong type, no unknown key
            let shown = report.map(|report| report.to_string()).unwrap_or_default();
            assert!(!shown.contains("unknown key") && !shown.contains("not valid TOML"), "{line}: {shown}");
            let refused = [
                "is there too",
                "only `tracking",
                "only `control",
                "expected `control`",
                "expected `control =",
                "acts on the base",
            ];
            let refused = refused.into_iter().chain([
                "bounces",
                "without control",
                "longer than the phase",
                "may move at its end",
                "keys that vary",
                "missing key `correlation",
            ]);
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
    let folder = folder();
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
    for format in FileFormat::ALL.iter().copied() {
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
                    let report = report(format, &text, folder.path());
                    assert!(report.is_none_or(|report| report.count() > 0));
                }
                if format != FileFormat::Scenario {
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
    let (_, script, _) = said(&["completions", "bash"]);
    // what it looks for after a command is what it has cases of
    let looked_for: Vec<_> = script.lines().filter_map(|line| line.trim().strip_prefix("cmd=\"")).collect();
    assert!(looked_for.len() > 15, "{script}");
    for case in looked_for.iter().map(|name| name.replace('"', ")")).filter(|case| *case != ")") {
        assert!(script.lines().any(|line| line.trim() == case), "{case}");
    }
    let (code, out, err) = said(&["man"]);
    assert!(
        code == 0 && err.is_empty() && out.contains(".TH planar-capture 1") && out.contains("planar\\-capture\\-run"),
        "{out}{err}"
    );
    let (code, out, _) = said(&["man", "run"]);
    assert!(code == 0 && out.contains("planar\\-capture\\-run \\-"), "{out}");
    let synopsis =
        |out: &str| out.lines().find(|line| line.ends_with("> ") || line.contains(">...")).map(str::to_owned);
    let run = synopsis(&out).expect("a synopsis");
    assert!(run.contains("<\\fISCENARIO\\fR>..."), "several: {run}");
    let check = synopsis(&said(&["man", "check"]).1).expect("a synopsis");
    assert!(check.contains("<\\fIFILE\\fR>") && !check.contains("..."), "one: {check}");
    let (code, _, err) = said(&["man", "rum"]);
    assert!(code == 2 && err.contains("no command `rum`") && err.contains("run"), "{err}");
}
