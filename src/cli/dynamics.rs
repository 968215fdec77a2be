//! The option `--dynamics`: generated or generic models of a layout.

use planar_capture::layout::Layout;
use planar_capture::owned::CloneModel;
use planar_capture::registry::{self, NoModel};

/// Implementations of the dynamics.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub enum Dynamics {
    /// Closed-form code, generated for the layout's structure.
    Generated,
    /// Computed from the equations for any layout, slowly.
    Generic,
}

impl Dynamics {
    /// As in the summary.
    pub fn name(self) -> &'static str {
        match self {
            Self::Generated => "generated",
            Self::Generic => "generic",
        }
    }

    /// The model of a layout.
    pub fn model(self, layout: &Layout) -> Result<Box<dyn CloneModel>, NoModel> {
        match self {
            Self::Generated => registry::generated(layout),
            Self::Generic => Ok(registry::generic(layout)),
        }
    }
}
