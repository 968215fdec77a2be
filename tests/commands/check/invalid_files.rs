//! `check`: invalid layouts, and the messages for them.

use super::{LAYOUT, SCENARIO, check};
use planar_capture::check::inspect;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// (what is wrong, the change to the layout, the places and texts of the message, the number of problems)
type Broken = (&'static str, &'static str, &'static str, &'static [&'static str], usize);

const BROKEN: &[Broken] = &[
    ("missing key", "mass = 500.0\n", "", &[":2:1", "missing key `base.mass`", "a mass in kg greater than 0"], 1),
    (
        "misspelt key",
        "inertia = 80",
        "intertia = 80",
        &[":4:1", "`base.intertia` (80.0)", "did you mean `inertia`?"],
        1,
    ),
    (
        "a length in mm",
        "length = 1.0\nmass = 10.0\ninertia = 1.0\ncom",
        "length = 2000.0\nmass = 10.0\ninertia = 1.0\ncom",
        &[
            ":13:10",
            "`arm[0].link[1].length` is 2000.0",
            "1000 times as long as the next longest link, 2 m",
            "lengths are in m",
        ],
        1,
    ),
    ("a key with its unit", "mass = 5", "mass_kg = 5", &[":3:1", "`base.mass_kg`", "did you mean `mass`?"], 1),
    ("negative mass", "mass = 500.0", "mass = -5", &[":3:8", "`base.mass` is -5", "in kg greater than 0"], 1),
    (
        "zero inertia",
        "inertia = 1.0",
        "inertia = 0",
        &[":11:11", "`arm[0].link[0].inertia` is 0", "kg m² greater than 0"],
        1,
    ),
    ("NaN", "mass = 10.0", "mass = nan", &[":10:8", "`arm[0].link[0].mass` is nan", "finite"], 1),
    ("infinity", "inertia = 1.0", "inertia = inf", &[":11:11", "`arm[0].link[0].inertia` is inf", "finite"], 1),
    ("a number in quotes", "mass = 500.0", "mass = \"500\"", &[":3:8", "`base.mass` is \"500\"", "without quotes"], 1),
    ("a unit", "mass = 500.0", "mass = 500 kg", &[":3:8", "`mass = 500 kg`", "without units"], 1),
    ("a decimal comma", "mass = 500.0", "mass = 500,0", &[":3:11", "`mass = 500,0`", "decimal point"], 1),
    (
        "a formula",
        "mount = [-0.5, 0.0]",
        "mount = [-0.5, 0.0]\nmount_angle = pi/2",
        &[":24:15", "`mount_angle = pi/2`", "formulas"],
        1,
    ),
    (
        "degrees",
        "mount = [-0.5, 0.0]",
        "mount = [-0.5, 0.0]\nmount_angle = 90",
        &[":24:15", "`arm[1].mount_angle` is 90", "degrees = 1.57"],
        1,
    ),
    (
        "millimetres",
        "length = 2.0",
        "length = 20000",
        &[":25:10", "`arm[1].link[0].length` is 20000", "millimetres = 20.0 m"],
        1,
    ),
    (
        "a vector of three",
        "[0.5, 0.1]",
        "[0.5, 0.1, 0.0]",
        &[":16:7", "`arm[0].link[1].com` is [0.5, 0.1, 0.0]", "[x, y] in m"],
        1,
    ),
    ("a scalar mount", "[0.5, 0.0]", "0.5", &[":7:9", "`arm[0].mount` is 0.5", "[x, y] in m"], 1),
    ("a Rust keyword", "\"robot\"", "\"loop\"", &[":1:8", "`name` is \"loop\"", "Rust keyword", "`loop_robot`"], 1),
    (
        "capitals",
        "\"robot\"",
        "\"My-Robot\"",
        &[":1:8", "`name` is \"My-Robot\"", "lower-case", "`my_robot` would do"],
        1,
    ),
    (
        "one name twice",
        "\"right\"",
        "\"left\"",
        &[":22:8", "`arm[1].name` is \"left\"", "`arm[0].name`", "must differ"],
        1,
    ),
    ("no quotes", "\"left\"", "left", &[":6:8", "`name = left`", "text stands in quotes"], 1),
    ("quotes of a text processor", "\"left\"", "“left”", &[":6:8", "`name = “left”`", "straight quotes"], 1),
    ("an open string", "\"left\"", "\"left", &[":6:13", "`name = \"left`", "ends with the quote"], 1),
    ("another letter", "mass = 500.0", "mäss = 500.0", &[":3:2", "stands in quotes"], 1),
    ("a colon", "mass = 500.0", "mass: 500.0", &[":3:5", "`mass: 500.0`", "write `key = value`"], 1),
    ("a table twice", "[[arm]]", "[base]\nmass = 1\n[[arm]]", &[":5:2", "`[base]`", "each key is given once"], 2),
    (
        "no base",
        "[base]\nmass = 500.0\ninertia = 80.0\n",
        "",
        &[":1:1", "missing key `base`", "`[base]` with `mass`"],
        1,
    ),
    ("a list of bases", "[base]", "[[base]]", &[":2:1", "`base` is a list of tables", "write `[base]`"], 1),
    (
        "a link out of place",
        "[[arm.link]]\nlength = 2",
        "[[link]]\nlength = 2",
        &[":24:3", "`link`", "belongs into `arm[0]`: write `[[arm.link]]`", ":21:1", "missing key `arm[1].link`"],
        2,
    ),
];

/// Whole files, as above.
fn broken_files() -> Vec<(&'static str, Vec<u8>, &'static [&'static str], usize)> {
    let head = LAYOUT.find("[[arm]]").map_or("", |end| &LAYOUT[..end]);
    let bare = LAYOUT.find("[[arm.link]]").map_or("", |end| &LAYOUT[..end]);
    let windows = format!("\u{feff}{}", LAYOUT.replace("mass = 500.0", "mass = -1").replace('\n', "\r\n"));
    vec![
        ("empty", Vec::new(), &[":1:1", "neither a layout", "`[[arm]]`", "`layout`", "nor a sweep"], 1),
        ("a name alone", b"name = \"robot\"".to_vec(), &[":1:1", "neither a layout", "nor a scenario"], 1),
        ("something else", b"[package]\nname = \"x\"".to_vec(), &[":1:2", "`package`", "neither a layout"], 2),
        ("JSON", b"{\"name\": \"robot\"}".to_vec(), &[":1:1", "not valid TOML", "write lines `key = value`"], 1),
        ("no arms", head.into(), &[":1:1", "missing key `arm`", "at least one `[[arm]]`"], 1),
        ("an empty list", format!("arm = []\n{head}").into(), &[":1:7", "`arm` is []", "at least one `[[arm]]`"], 1),
        ("an arm without links", bare.into(), &[":5:1", "missing key `arm[0].link`", "at least one `[[arm.link]]`"], 1),
        (
            "one arm, no list",
            bare.replace("[[arm]]", "[arm]").into(),
            &[":5:1", "`arm` is a single table", "`[[arm]]`"],
            1,
        ),
        (
            "a misspelt list",
            LAYOUT.replace("[[arm]]", "[[arms]]").replace("arm.link", "arms.link").into(),
            &[":5:3", "`arms` (a list of tables)", "did you mean `arm`?"],
            1,
        ),
        (
            "an array left open",
            LAYOUT.replacen("0.0]", "0.0", 1).into(),
            &[":8:1", "commas; or its `]` is missing on a line above"],
            1,
        ),
        ("Latin-1", b"name = \"robot\"\n# 5 \xb0\n".to_vec(), &[":2:5", "byte 0xb0 is not UTF-8", "encoding UTF-8"], 1),
        ("Windows", windows.into(), &[":3:8", "`base.mass` is -1", "greater than 0"], 1),
    ]
}

#[test]
fn broken_layouts_are_reported_with_a_correction() {
    let folder = TempDir::new().expect("a folder");
    let edited = BROKEN.iter().map(|(what, from, to, expected, count)| {
        assert!(LAYOUT.contains(from), "{what}");
        (*what, LAYOUT.replacen(from, to, 1).into_bytes(), *expected, *count)
    });
    let all: Vec<_> = edited.chain(broken_files()).collect();
    assert!(all.len() >= 20);
    for (what, content, expected, count) in all {
        fs::write(folder.path().join("broken.toml"), content).expect("written");
        let (code, out, err) = check(&["broken.toml"], folder.path());
        assert_eq!((code, out.as_str()), (2, ""), "{what}: {err}");
        assert_eq!(err.matches("error: ").count(), count, "{what}:\n{err}");
        for expected in expected {
            let expected =
                if expected.starts_with(':') { format!("broken.toml{expected}") } else { (*expected).to_owned() };
            assert!(err.contains(&expected), "{what}: no `{expected}` in\n{err}");
        }
    }
}

/// The kind of a file is that of most of its keys, misspelt ones included; its reader reports the errors.
#[test]
fn the_kind_is_seen_in_broken_files_too() {
    let wrong = |text: &str| match inspect(text, "it.toml", Path::new(""), &[("robot", LAYOUT)]) {
        Ok(inspection) => panic!("{}", inspection.description),
        Err(report) => report.to_string(),
    };
    let shown = wrong(&SCENARIO.replace("[approach]", "[aproach]"));
    assert!(shown.contains("did you mean `approach`?"), "{shown}");
    let shown = wrong(&SCENARIO.replace("[approach]", "[approach"));
    assert!(shown.contains("not valid TOML"), "{shown}");
    let shown = wrong("[bsae]\nmass = 1\ninertia = 1\n");
    assert!(shown.contains("did you mean `base`?") && shown.contains("missing key `arm`"), "{shown}");
    let shown = wrong(&format!("{SCENARIO}[base]\nmass = 1\n"));
    assert!(shown.contains("unknown key `base`"), "{shown}");
    // of two kinds that have as many keys in it the first, which is a layout
    let shown = wrong("[base]\nmass = 1\ninertia = 1\n[approach]\n");
    assert!(shown.contains("a layout has the tables `[base]` and `[[arm]]`"), "{shown}");
}

/// Numbers at the ends of what 64 bits hold, and any cut: described or refused, never a panic.
#[test]
fn any_number_and_any_cut_is_described_or_refused() {
    let shipped = [("robot", LAYOUT)];
    let inspect_text = |text: &str| match inspect(text, "it.toml", Path::new(""), &shipped) {
        Ok(inspection) => assert!(inspection.description.len() > 100),
        Err(report) => assert!(report.count() > 0),
    };
    for text in [LAYOUT, SCENARIO] {
        for (at, _) in text.match_indices(|c: char| c.is_ascii_digit()) {
            for number in ["1e308", "5e-324", "-1e308", "0"] {
                inspect_text(&format!("{}{number} #{}", &text[..at], &text[at..]));
                inspect_text(&format!(
                    "{}{number}{}",
                    &text[..at],
                    text[at..].trim_start_matches(|c: char| c.is_ascii_digit() || c == '.')
                ));
            }
        }
        (0..text.len()).for_each(|at| inspect_text(&text[..at]));
    }
}

/// A sample time is at most the duration of its phase; that of one sample is valid.
#[test]
fn a_sample_time_is_at_most_the_duration() {
    let read = |sample_time: &str| {
        let text = SCENARIO.replace("[approach]", &format!("[approach]\nsample_time = {sample_time}"));
        inspect(&text, "it.toml", Path::new(""), &[("robot", LAYOUT)]).map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(read("20.0"), Ok(()));
    let refusal = read("20.005").expect_err("longer than 20 s");
    assert!(refusal.contains("`approach.sample_time`") && refusal.contains("it.toml:6:"), "{refusal}");
}

/// Two lengths in mm are both named, and no mass.
#[test]
fn all_lengths_in_mm_are_named() {
    let text = std::fs::read_to_string(planar_proof::file("codegen/layouts/dual_arm_3r.toml")).expect("a layout");
    let mut lengths = text.split("length = 1.0").enumerate();
    let first = lengths.next().expect("a text").1.to_owned();
    let wrong =
        |(i, rest): (usize, &str)| format!("length = {}{rest}", if i == 2 || i == 4 { "1000.0" } else { "1.0" });
    let text = first + &lengths.map(wrong).collect::<String>();
    let report = inspect(&text, "robot.toml", Path::new(""), planar_capture::registry::SHIPPED).expect_err("refused");
    let shown = report.to_string();
    assert_eq!(report.count(), 2, "{shown}");
    for key in ["`arm[0].link[1].length` is 1000.0", "`arm[1].link[0].length` is 1000.0", "lengths are in m"] {
        assert!(shown.contains(key), "{key}: {shown}");
    }
}

/// An outline of a misspelt kind is that problem alone.
#[test]
fn a_misspelt_outline_is_one_problem() {
    let text = LAYOUT.replace("inertia = 80.0", "inertia = 80.0\noutline = { Box = [1.0, 1.0] }");
    let report = inspect(&text, "robot.toml", Path::new(""), planar_capture::registry::SHIPPED).expect_err("refused");
    assert!(report.count() == 1 && report.to_string().contains("did you mean `box`?"), "{report}");
}
