//! Command lines for messages and headers.

/// The command line that generates a file from a layout, with these options.
#[must_use]
pub fn command<S: AsRef<str>>(layout: &str, out: &str, options: &[S]) -> String {
    let generate = format!("planar-capture generate {} --out {}", quoted(layout), quoted(out));
    std::iter::once(generate.as_str()).chain(options.iter().map(AsRef::as_ref)).collect::<Vec<_>>().join(" ")
}

/// The options of a command line that [`command`] has written.
#[must_use]
pub fn options(command: &str) -> Vec<&str> {
    let words: Vec<&str> = command.split_whitespace().collect();
    let is_option = |place: &usize| {
        let after_list = *place > 0 && ["--directional", "--language"].contains(&words[place - 1]);
        let word = words[*place];
        let is_flag = ["--language", "--standalone", "--derivatives", "--directional"].contains(&word);
        is_flag || word.starts_with("--derivatives=") || after_list
    };
    (0..words.len()).filter(is_option).map(|place| words[place]).collect()
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
