//! What a key has beside its value: a default, a condition, an example.

/// What holds where a key is not given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Default {
    /// It must be given.
    Required,
    /// There is no such thing then.
    Nothing,
    /// This number.
    Number(f64),
    /// This choice.
    Choice(&'static str),
    /// Zeros.
    Zeros,
    /// What follows from something else, in words.
    Words(&'static str),
}

/// The condition of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum With {
    /// With one of these choices of another key of its table.
    Choice(&'static str, &'static [&'static str]),
    /// Beside one of these keys.
    Key(&'static [&'static str]),
}

/// The TOML text of a value, in a file to start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Example {
    /// The default, as a comment.
    Default,
    /// As a comment.
    Comment(&'static str),
    /// To start with.
    Start(&'static str),
    /// So many tables of a list.
    Entries(usize),
}
