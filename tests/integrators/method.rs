//! The compared integrators with their names and styles.

use planar_capture::output::figures::{Colour, Dash, Symbol};
use planar_capture::simulate::stepper::{Formulation, Integration, Integrator};

/// A integrator in full or reduced coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Method {
    pub integration: Integration,
}

/// Step or tolerance of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fineness {
    /// s.
    Step(f64),
    Tolerance(f64),
}

impl Method {
    /// All methods of scenarios.
    pub fn all() -> Vec<Self> {
        let method = |integrator, coordinates| Self { integration: Integration { integrator, coordinates } };
        let adaptive = Integrator::Adaptive { tolerance: 0.0 };
        let mut all = vec![method(Integrator::GaussLegendre, Formulation::Full)];
        for integrator in [Integrator::RungeKutta4, adaptive, Integrator::SemiImplicitEuler] {
            all.extend([Formulation::Full, Formulation::Reduced].map(|coordinates| method(integrator, coordinates)));
        }
        all
    }

    /// As in a scenario.
    pub fn name(self) -> &'static str {
        self.integration.integrator.properties().name
    }

    /// As in a scenario.
    pub fn coordinates(self) -> &'static str {
        match self.integration.coordinates {
            Formulation::Full => "full",
            Formulation::Reduced => "reduced",
        }
    }

    /// In a legend.
    pub fn label(self) -> String {
        format!("{}, {}", self.name(), self.coordinates())
    }

    /// The colour shows the integrator, dash and symbol show the coordinates.
    pub fn style(self) -> (Colour, Dash, Symbol) {
        let colour = match self.integration.integrator {
            Integrator::GaussLegendre => Colour::of(0),
            Integrator::RungeKutta4 => Colour::of(1),
            Integrator::Adaptive { .. } => Colour::of(2),
            Integrator::SemiImplicitEuler => Colour::of(3),
        };
        match self.integration.coordinates {
            Formulation::Full => (colour, Dash::Solid, Symbol::Circle),
            Formulation::Reduced => (colour, Dash::Dashed, Symbol::Cross),
        }
    }

    /// The integrator with its tolerance, and the step.
    pub fn with(self, fineness: Fineness, duration: f64) -> (Integration, f64) {
        match fineness {
            Fineness::Step(step) => (self.integration, step),
            Fineness::Tolerance(tolerance) => {
                (Integration { integrator: Integrator::Adaptive { tolerance }, ..self.integration }, duration)
            }
        }
    }
}

impl std::fmt::Display for Fineness {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Step(step) => write!(f, "{step} s"),
            Self::Tolerance(tolerance) => write!(f, "tolerance {tolerance:e}"),
        }
    }
}
