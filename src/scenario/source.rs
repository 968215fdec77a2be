//! What scenarios are read from.

/// What a file was read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// TOML.
    pub text: String,
    /// As shown to the user.
    pub file: String,
}

/// What a scenario was read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScenarioSource {
    /// The scenario's file.
    pub scenario: Source,
    /// The file of the layout that it names.
    pub layout: Source,
}
