//! The texts that can be chosen, and how many elements a list has.

/// A text that can be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// As it is written.
    pub name: &'static str,
    /// What it means, in Markdown.
    pub doc: &'static str,
}

/// How many elements a list has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Any number.
    Any,
    /// Any number but none.
    AtLeastOne,
    /// One per joint.
    Joints,
    /// One per arm.
    Arms,
    /// One per arm that touches a target.
    Contacts,
    /// A fixed number.
    Exactly(usize),
}

impl Count {
    /// In words; nothing for any number.
    #[must_use]
    pub fn words(self) -> String {
        match self {
            Self::Any => "any number of them".to_owned(),
            Self::AtLeastOne => "at least one".to_owned(),
            Self::Joints => "one per joint".to_owned(),
            Self::Arms => "one per arm".to_owned(),
            Self::Contacts => "one per arm that touches it".to_owned(),
            Self::Exactly(count) => format!("{count} of them"),
        }
    }
}
