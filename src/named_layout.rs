//! The layout that an argument names: a path, or the name of a shipped one.
//!
//! # Example
//! ```
//! use planar_capture::layout::Layout;
//! use planar_capture::named_layout::named_layout;
//! use planar_capture::registry::Robots;
//!
//! let (text, name) = named_layout("dual_arm_3r", Robots::SHIPPED)?;
//! assert_eq!(Layout::parse(&text, &name)?.mass(), 560.0); // kg
//! let unknown = named_layout("dual_arm3r", Robots::SHIPPED).unwrap_err();
//! assert!(unknown.to_string().contains("did you mean `dual_arm_3r`?"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::diagnostic::{Report, nearest, read_text};
use crate::layout::Layout;
use crate::registry::Robots;
use std::path::Path;

/// An argument names no layout.
#[derive(Debug, thiserror::Error)]
pub enum NoLayout {
    /// Its file cannot be read.
    #[error(transparent)]
    Unreadable(#[from] Report),
    /// There is none of that name.
    #[error("{0}")]
    Unknown(String),
}

/// The text that an argument names and its name in messages: an argument that ends in `.toml` or contains a `/` is a
/// path, any other the name of a layout that is known.
///
/// # Errors
/// [`NoLayout`].
pub fn named_layout(argument: &str, robots: Robots<'_>) -> Result<(String, String), NoLayout> {
    if Layout::is_path(argument) || argument.contains(std::path::MAIN_SEPARATOR) {
        return Ok((read_text(Path::new(argument), "TOML")?, argument.to_owned()));
    }
    let known = robots.layouts();
    let names = || known.iter().map(|(name, _)| *name);
    if let Some((name, text)) = known.iter().find(|(name, _)| *name == argument) {
        return Ok(((*text).to_owned(), format!("{name}.toml (shipped)")));
    }
    let path = Path::new(argument);
    if path.exists() {
        let what = if path.is_dir() {
            "is a folder, expected a TOML file: name a file in it".to_owned()
        } else {
            format!("is not the name of a shipped layout: to read that file, write `./{argument}`")
        };
        return Err(NoLayout::Unknown(format!("`{argument}` {what}")));
    }
    let meant = nearest(argument, names()).map_or_else(String::new, |name| format!("did you mean `{name}`? "));
    Err(NoLayout::Unknown(format!(
        "there is no shipped layout `{argument}`; {meant}shipped: {}; a path ends in `.toml` or contains a `/`",
        names().collect::<Vec<_>>().join(", ")
    )))
}
