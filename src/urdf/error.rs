//! Why a URDF file gives no layout.

use crate::diagnostic::Report;

/// What keeps a URDF from being a layout: where, the value there and what would be right.
#[derive(Clone, Debug, thiserror::Error)]
pub enum UrdfError {
    /// Not XML, or not the elements and attributes of a URDF.
    #[error("this is not a URDF file: {0}")]
    Unreadable(String),
    /// One element that cannot be read.
    #[error("line {line}, {element}: {found}")]
    Element {
        /// Of the file, from 1.
        line: usize,
        /// The link or joint.
        element: String,
        /// What is wrong.
        found: String,
    },
    /// The tree as a whole.
    #[error("robot `{robot}`: {found}; {wanted}")]
    Robot {
        /// Its name.
        robot: String,
        /// What is there.
        found: String,
        /// What would be right.
        wanted: String,
    },
    /// One link.
    #[error("link `{link}`: {found}; {wanted}")]
    Link {
        /// Its name.
        link: String,
        /// What is there.
        found: String,
        /// What would be right.
        wanted: String,
    },
    /// One joint.
    #[error("joint `{joint}`: {found}; {wanted}")]
    Joint {
        /// Its name.
        joint: String,
        /// What is there.
        found: String,
        /// What would be right.
        wanted: String,
    },
    /// A tip that was asked for.
    #[error("tip `{tip}`: {found}; {wanted}")]
    Tip {
        /// The link asked for.
        tip: String,
        /// What is there.
        found: String,
        /// What would be right.
        wanted: String,
    },
    /// The name of the layout.
    #[error("`{name}` {found}; {wanted}")]
    Name {
        /// The name.
        name: String,
        /// What is wrong with it.
        found: String,
        /// What would be right.
        wanted: String,
    },
    /// The numbers are none that a layout may have.
    #[error("the layout that it gives cannot be used:\n{0}")]
    Layout(#[from] Report),
}

impl UrdfError {
    /// A problem of a link.
    pub(super) fn link(link: &str, found: impl Into<String>, wanted: impl Into<String>) -> Self {
        Self::Link { link: link.to_owned(), found: found.into(), wanted: wanted.into() }
    }

    /// A problem of a joint.
    pub(super) fn joint(joint: &str, found: impl Into<String>, wanted: impl Into<String>) -> Self {
        Self::Joint { joint: joint.to_owned(), found: found.into(), wanted: wanted.into() }
    }
}
