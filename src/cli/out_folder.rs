//! The folder of `--out`.

use clap::builder::{PathBufValueParser, TypedValueParser};
use std::path::{Component, Path, PathBuf};

/// A path without `..` behind a folder that is not there: it would be made on the way to another one, and stay.
pub fn out_folder() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().map(|path| without_absent(&path))
}

fn without_absent(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        if part == Component::ParentDir && plain.file_name().is_some() && plain.symlink_metadata().is_err() {
            plain.pop();
        } else {
            plain.push(part);
        }
    }
    if plain.as_os_str().is_empty() { PathBuf::from(".") } else { plain }
}

#[cfg(test)]
mod tests {
    use super::without_absent;
    use std::path::Path;

    #[test]
    fn folders_that_are_not_there_are_left_out_of_a_path() {
        for (path, expected) in [
            ("absent/../results", "results"),
            ("absent/..", "."),
            ("absent/inner/../../../results", "../results"),
            // `src` may be a link to elsewhere
            ("src/../absent/../results", "src/../results"),
            ("src/../results/absent", "src/../results/absent"),
            ("/absent/../results", "/results"),
        ] {
            assert_eq!(without_absent(Path::new(path)), Path::new(expected), "{path}");
        }
    }
}
