//! Command lines for messages and headers.

/// The command line that generates a file from a layout.
#[must_use]
pub fn command(layout: &str, out: &str, standalone: bool) -> String {
    let option = if standalone { " --standalone" } else { "" };
    format!("planar-capture generate {} --out {}{option}", quoted(layout), quoted(out))
}

/// A path as one word of a command line.
#[must_use]
pub fn quoted(path: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./\\:".contains(c) || !c.is_ascii();
    if !path.is_empty() && path.chars().all(plain) {
        path.to_owned()
    } else {
        format!("'{}'", path.replace('\'', "'\\''"))
    }
}
