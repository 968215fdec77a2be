//! The implementation of the dynamics that a layout is computed with.
//!
//! # Example
//! ```
//! use planar_capture::engine::{Choice, Engine};
//! use planar_capture::layout::Layout;
//! use planar_capture::registry::Robots;
//!
//! let layout = Layout::read("codegen/layouts/dual_arm_3r.toml".as_ref())?;
//! let (fastest, _) = Choice::fastest(&layout, Robots::SHIPPED);
//! assert_eq!(fastest.engine, Engine::Generated);
//! for choice in [fastest, Choice::graph(&layout)?, Choice::generic()] {
//!     let mut mass_matrix = [0.0; 9 * 9];
//!     choice.model(&layout).mass_matrix(&[0.0; 3], &[0.5; 6], &mut mass_matrix)?;
//!     // the entry of vx twice is the mass of all bodies
//!     assert!((mass_matrix[9 + 1] - 560.0).abs() < 1e-9);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::evaluator::Evaluator;
use crate::graphs::{self, FoundGraph, NoGraph};
use crate::layout::Layout;
use crate::owned::CloneModel;
use crate::registry::{self, CompiledCode, NoModel, Robots};
use std::sync::Arc;

/// Implementations of the dynamics, the fastest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Code that was generated for the layout's structure and compiled.
    Generated,
    /// The graph that such code would be rendered from, evaluated.
    Graph,
    /// From the equations, for any layout, slowly.
    Generic,
}

impl Engine {
    /// As in the summary.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Generated => "generated",
            Self::Graph => "graph",
            Self::Generic => "generic",
        }
    }
}

/// What computes a structure of layouts.
#[derive(Clone, Debug)]
pub struct Choice {
    /// How it computes.
    pub engine: Engine,
    /// Which code or graph that is, in words.
    pub origin: String,
    /// With [`Engine::Generated`].
    code: Option<CompiledCode>,
    /// With [`Engine::Graph`].
    evaluator: Option<Arc<Evaluator>>,
}

impl Choice {
    /// Compiled code of the layout's structure among `robots`, else a graph of it, else the generic implementation; and why a graph that
    /// is there cannot be used.
    #[must_use]
    pub fn fastest(layout: &Layout, robots: Robots<'_>) -> (Self, Option<NoGraph>) {
        if let Ok(choice) = Self::generated(layout, robots) {
            return (choice, None);
        }
        match Self::graph(layout) {
            Ok(choice) => (choice, None),
            Err(NoGraph::Missing { .. }) => (Self::generic(), None),
            Err(why) => (Self::generic(), Some(why)),
        }
    }

    /// Compiled code of the layout's structure among `robots`.
    ///
    /// # Errors
    /// [`NoModel`].
    pub fn generated(layout: &Layout, robots: Robots<'_>) -> Result<Self, NoModel> {
        let code = robots.code(layout)?;
        let origin = format!("compiled code of `{}`", code.manifest.name);
        Ok(Self { engine: Engine::Generated, origin, code: Some(code), evaluator: None })
    }

    /// A graph of the layout's structure.
    ///
    /// # Errors
    /// [`NoGraph`].
    pub fn graph(layout: &Layout) -> Result<Self, NoGraph> {
        let FoundGraph { evaluator, origin, .. } = graphs::find(layout)?;
        Ok(Self { engine: Engine::Graph, origin, code: None, evaluator: Some(evaluator) })
    }

    /// The generic implementation.
    #[must_use]
    pub fn generic() -> Self {
        Self { engine: Engine::Generic, origin: "for any layout".to_owned(), code: None, evaluator: None }
    }

    /// The model of a layout of the structure; the generic one of another layout.
    #[must_use]
    pub fn model(&self, layout: &Layout) -> Box<dyn CloneModel> {
        let model = match (self.code, &self.evaluator) {
            (Some(code), _) => code.of(layout),
            (None, Some(evaluator)) => evaluator.model(layout).ok().map(|model| Box::new(model) as Box<_>),
            (None, None) => None,
        };
        model.unwrap_or_else(|| registry::generic(layout))
    }
}
