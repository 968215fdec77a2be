//! Errors of the import of a URDF file.

use crate::diagnostic::{Report, printable};

/// Why a URDF file gives no layout.
#[derive(Clone, Debug, thiserror::Error)]
pub enum UrdfError {
    /// Not XML, or not the elements and attributes of a URDF.
    #[error("this is not a URDF file: {0}")]
    Unreadable(String),
    /// An element that cannot be read.
    #[error("line {line}, {element}: {found}")]
    Element {
        /// Of the file, from 1.
        line: usize,
        /// The link or joint.
        element: String,
        /// The invalid text.
        found: String,
    },
    /// A part of the robot that a layout cannot represent, or an unsuitable option.
    #[error("{part}: {found}; {wanted}")]
    Part {
        /// Kind and name, such as `` link `base` ``.
        part: String,
        /// The fact.
        found: String,
        /// What is expected.
        wanted: String,
    },
    /// The resulting layout is invalid.
    #[error("the layout that it gives cannot be used:\n{0}")]
    Layout(#[from] Report),
}

impl UrdfError {
    pub(super) fn part(kind: &str, name: &str, found: impl Into<String>, wanted: impl Into<String>) -> Self {
        let (found, wanted) = (printable(&found.into()), printable(&wanted.into()));
        Self::Part { part: part_name(kind, name), found, wanted }
    }

    pub(super) fn link(link: &str, found: impl Into<String>, wanted: impl Into<String>) -> Self {
        Self::part("link", link, found, wanted)
    }

    pub(super) fn joint(joint: &str, found: impl Into<String>, wanted: impl Into<String>) -> Self {
        Self::part("joint", joint, found, wanted)
    }
}

/// Kind and name of a part.
pub(super) fn part_name(kind: &str, name: &str) -> String {
    printable(&format!("{kind} `{name}`"))
}
