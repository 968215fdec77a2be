//! Keys that are suggested and shown, and names of files.

use crate::diagnostic::read_document;
use crate::format::{Default, Key, NumberRule, Shape, TableFormat};

const GAIN: Shape = Shape::Number(NumberRule::any("a gain", ""));

static FORMAT: TableFormat = TableFormat {
    doc: "Of a test.",
    keys: &[
        Key::required("name", Shape::FILE_NAME, "a name"),
        Key::optional("gain_x", GAIN, Default::Number(0.0), "a gain"),
        Key::optional("gain_y", GAIN, Default::Number(0.0), "a gain"),
    ],
    one_of: &[],
};

fn read(text: &str) -> Result<String, String> {
    let name = read_document(text, "it.toml", &FORMAT, |root| root.file_name("name").map(str::to_owned));
    name.map_err(|report| report.to_string())
}

#[test]
fn names_of_files_have_a_hundred_letters_at_most() {
    for (letters, is_fine) in [(1, true), (100, true), (101, false)] {
        assert_eq!(read(&format!("name = \"{}\"", "x".repeat(letters))).is_ok(), is_fine, "{letters}");
    }
}

/// Of two keys that are as near, the one that is not given yet; and a key that is no bare one is shown in its quotes.
#[test]
fn unknown_keys_are_shown_as_they_are_written() {
    for (given, missing) in [("gain_x", "gain_y"), ("gain_y", "gain_x")] {
        let said = read(&format!("name = \"it\"\n{given} = 1.0\ngain_z = 2.0\n")).expect_err("an unknown key");
        assert!(said.contains(&format!("did you mean `{missing}`?")), "{said}");
    }
    let said = read("name = \"it\"\n\"my.gain\" = 1.0\n").expect_err("an unknown key");
    assert!(said.contains("unknown key `\"my.gain\"` (1.0)"), "{said}");
}
