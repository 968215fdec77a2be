//! Kinds of files as arguments.

use crate::file_format::FileFormat;
use clap::ValueEnum;
use clap::builder::PossibleValue;

impl ValueEnum for FileFormat {
    fn value_variants<'a>() -> &'a [Self] {
        Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let help = match self {
            Self::Layout => "a robot",
            Self::Scenario => "a study",
            #[cfg(feature = "sweep")]
            Self::Sweep => "a study many times",
        };
        Some(PossibleValue::new(self.name()).help(help))
    }
}
