//! A value that a case has in place of the scenario's.

use std::fmt::{self, Display, Formatter};

/// A scalar of TOML.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum VariedValue {
    /// Also for integers.
    Number(f64),
    /// As a name: `"pd"`.
    Text(String),
    /// `true` or `false`.
    Flag(bool),
}

impl VariedValue {
    /// As text of TOML that reads back exactly.
    #[must_use]
    pub fn to_toml(&self) -> toml::Value {
        match self {
            Self::Number(number) => (*number).into(),
            Self::Text(text) => text.as_str().into(),
            Self::Flag(flag) => (*flag).into(),
        }
    }

    /// The number; `None` for others.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Text(_) | Self::Flag(_) => None,
        }
    }
}

impl Display for VariedValue {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.to_toml().fmt(f)
    }
}
