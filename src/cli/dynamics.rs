//! The option `--dynamics`: which implementation computes a layout.

use super::terminal::note;
use super::{CommandError, file_error};
use crate::build::quoted;
use crate::engine::{Choice, Engine};
use crate::layout::Layout;
use crate::registry::Robots;

/// Implementations of the dynamics.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Dynamics {
    /// The fastest that there is for the layout's structure, of those below.
    Auto,
    /// Closed-form code, compiled into this program.
    Generated,
    /// The expression graph of such code, evaluated.
    Graph,
    /// Computed from the equations for any layout, slowly.
    Generic,
}

impl Dynamics {
    /// The implementation of an engine's name; the fastest one for another.
    #[cfg(feature = "sweep")]
    pub fn of_name(name: &str) -> Self {
        match name {
            "generated" => Self::Generated,
            "graph" => Self::Graph,
            "generic" => Self::Generic,
            _ => Self::Auto,
        }
    }

    /// What computes a layout, which is in `file`.
    pub fn choose(self, layout: &Layout, file: &str, robots: Robots<'_>) -> Result<Choice, CommandError> {
        match self {
            Self::Auto => {
                let (choice, unusable) = Choice::fastest(layout, robots);
                if let Some(why) = unusable {
                    note(format_args!("warning: {why}"));
                }
                Ok(choice)
            }
            Self::Generated => Choice::generated(layout, robots).map_err(file_error(file)),
            Self::Graph => Choice::graph(layout).map_err(file_error(file)),
            Self::Generic => Ok(Choice::generic()),
        }
    }

    /// A line about what was chosen for the layout of this file, where the option does not say it; it begins with `of`.
    pub fn announce(self, choice: &Choice, layout: &str, of: &str) {
        if self == Self::Auto {
            let (engine, origin, faster) = (choice.engine.name(), &choice.origin, faster(choice.engine, layout));
            note(format_args!("{of}dynamics: {engine}, {origin}{faster}"));
        }
    }
}

/// How to get a faster implementation of the layout of this file.
fn faster(engine: Engine, layout: &str) -> String {
    // a shipped one is known by its name
    let layout = quoted(layout.strip_suffix(".toml (shipped)").unwrap_or(layout));
    match engine {
        Engine::Generated => String::new(),
        Engine::Graph => format!(
            "; compiled code of it in a program of your own is faster: planar-capture new DIR --layout {layout}"
        ),
        Engine::Generic => format!("; a graph is several times as fast: planar-capture derive {layout}"),
    }
}
