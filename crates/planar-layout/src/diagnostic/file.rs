//! Reading the text of an input file.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use super::{Diagnostic, Report, nearest, printable};

/// Maximum size of an input file in bytes, far above that of any layout or scenario.
const MAXIMUM_SIZE: u64 = 16 << 20;

/// Reads a UTF-8 text file of at most 16 MiB; `kind` is what it should be, "TOML", and in lower case its extension.
///
/// # Errors
/// A report for a path that does not exist (with the most similar name), a directory, and a file that is unreadable, too
/// large or not UTF-8 (with the line and column of the first invalid byte).
pub fn read_text(path: &Path, kind: &str) -> Result<String, Report> {
    let bytes = File::open(path).and_then(read_limited).map_err(|error| unreadable(path, kind, &error))?;
    text_of(bytes, &shown(path), kind)
}

/// Reads such a text from a stream, of this name in messages.
///
/// # Errors
/// A report for a stream that is unreadable, too large or not UTF-8.
pub fn read_text_from(stream: impl Read, name: &str, kind: &str) -> Result<String, Report> {
    let name = printable(name);
    let unreadable = |error: io::Error| Diagnostic::with_file(format!("cannot read `{name}`: {error}"), None);
    text_of(read_limited(stream).map_err(unreadable)?, &name, kind)
}

/// One byte more than is permitted, at most.
fn read_limited(stream: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    stream.take(MAXIMUM_SIZE + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn text_of(bytes: Vec<u8>, name: &str, kind: &str) -> Result<String, Report> {
    if bytes.len() as u64 > MAXIMUM_SIZE {
        let message = format!("`{name}` is larger than 16 MiB");
        return Err(Diagnostic::with_file(message, format!("expected a small {kind} file")).into());
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..valid]);
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
        let byte = error.as_bytes()[valid];
        let message = format!("{name}:{line}:{column}: byte 0x{byte:02x} is not UTF-8 text");
        Diagnostic::with_file(message, "save the file with the encoding UTF-8".to_owned()).into()
    })
}

fn unreadable(path: &Path, kind: &str, error: &io::Error) -> Report {
    let name = shown(path);
    match error.kind() {
        ErrorKind::NotFound => Diagnostic::with_file(format!("there is no file `{name}`"), missing_file_hint(path)),
        ErrorKind::IsADirectory => Diagnostic::with_file(
            format!("`{name}` is a folder, expected a {kind} file"),
            names_in(path)
                .into_iter()
                .find(|entry| has_extension(entry, kind))
                .map(|entry| format!("name a file in it, such as `{}`", shown(&path.join(entry)))),
        ),
        _ => Diagnostic::with_file(format!("cannot read `{name}`: {error}"), None),
    }
    .into()
}

/// A hint for a file that does not exist.
fn missing_file_hint(path: &Path) -> Option<String> {
    let parent = path.parent()?;
    let folder = if parent.as_os_str().is_empty() { Path::new(".") } else { parent };
    if !folder.is_dir() {
        return Some(format!("there is no folder `{}` either", shown(folder)));
    }
    let names = names_in(folder);
    let name = nearest(path.file_name()?.to_str()?, names.iter().map(String::as_str))?;
    Some(format!("did you mean `{}`?", shown(&parent.join(name))))
}

/// The names in a folder, sorted; none where it cannot be read.
fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<_> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort_unstable();
    names
}

fn has_extension(name: &str, kind: &str) -> bool {
    Path::new(name).extension().is_some_and(|extension| extension.eq_ignore_ascii_case(kind))
}

/// A path without control characters.
fn shown(path: &Path) -> String {
    printable(&path.display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_may_have_the_size_that_is_permitted_and_no_byte_more() {
        let read = |size: u64| read_text_from(io::repeat(b' ').take(size), "it.toml", "TOML");
        let text = read(MAXIMUM_SIZE).expect("a text of 16 MiB");
        assert_eq!(text.len() as u64, MAXIMUM_SIZE);
        let report = read(MAXIMUM_SIZE + 1).expect_err("a byte more").to_string();
        assert!(report.contains("`it.toml` is larger than 16 MiB"), "{report}");
    }
}
