//! `modelDescription.xml`: the variables of an FMU and what it can do.

use super::Origin;
use super::xml::Element;
use crate::build::{CoSimulationVariable, Role};

/// Units by their exponents of kg, m, s and rad.
const UNITS: [(&str, [i8; 4]); 11] = [
    ("s", [0, 0, 1, 0]),
    ("kg", [1, 0, 0, 0]),
    ("kg m^2", [1, 2, 0, 0]),
    ("m", [0, 1, 0, 0]),
    ("rad", [0, 0, 0, 1]),
    ("rad/s", [0, 0, -1, 1]),
    ("m/s", [0, 1, -1, 0]),
    ("N", [1, 1, -2, 0]),
    ("N m", [1, 2, -2, 0]),
    ("N s", [1, 1, -1, 0]),
    ("N m s", [1, 2, -1, 0]),
];

/// What the description says.
#[derive(Clone, Copy, Debug)]
pub(super) struct ModelDescription<'a> {
    pub(super) origin: &'a Origin<'a>,
    /// The same as in the sources.
    pub(super) token: &'a str,
    pub(super) variables: &'a [CoSimulationVariable],
}

impl ModelDescription<'_> {
    /// The document.
    pub(super) fn xml(&self) -> String {
        let Origin { name, layout_sha256, .. } = *self.origin;
        let tool = concat!("planar-capture ", env!("CARGO_PKG_VERSION"));
        let description = format!("Free-floating planar robot {name}; sha256 of its layout: {layout_sha256}");
        Element::new("fmiModelDescription")
            .with("fmiVersion", &"3.0")
            .with("modelName", &name)
            .with("instantiationToken", &self.token)
            .with("description", &description)
            .with("generationTool", &tool)
            .with("variableNamingConvention", &"flat")
            .containing([
                co_simulation(name),
                Element::new("UnitDefinitions").containing(UNITS.map(|(name, exponents)| unit(name, exponents))),
                Element::new("LogCategories").containing([Element::new("Category")
                    .with("name", &"logStatusError")
                    .with("description", &"why a function has no result")]),
                Element::new("DefaultExperiment").with("startTime", &0).with("stopTime", &10).with("stepSize", &0.01),
                Element::new("ModelVariables")
                    .containing(self.indexed().map(|(index, variable)| float(index, variable))),
                Element::new("ModelStructure").containing(self.unknowns()),
            ])
            .document()
    }

    /// The variables with their value references.
    fn indexed(&self) -> impl Iterator<Item = (usize, &CoSimulationVariable)> {
        self.variables.iter().enumerate()
    }

    /// Outputs, which depend on states and parameters and not on inputs, and those of them that follow from others at
    /// the start.
    fn unknowns(&self) -> Vec<Element> {
        let places = |roles: &'static [Role]| {
            self.indexed().filter(|(_, variable)| roles.contains(&variable.role)).map(|(index, _)| index)
        };
        let outputs = places(&[Role::State, Role::Observed]);
        let outputs =
            outputs.map(|index| Element::new("Output").with("valueReference", &index).with("dependencies", &""));
        let initial =
            places(&[Role::Observed]).map(|index| Element::new("InitialUnknown").with("valueReference", &index));
        outputs.chain(initial).collect()
    }
}

fn co_simulation(name: &str) -> Element {
    Element::new("CoSimulation")
        .with("modelIdentifier", &name)
        .with("canGetAndSetFMUState", &true)
        .with("canSerializeFMUState", &true)
        .with("canHandleVariableCommunicationStepSize", &true)
}

fn unit(name: &str, exponents: [i8; 4]) -> Element {
    let mut base = Element::new("BaseUnit");
    for (symbol, exponent) in ["kg", "m", "s", "rad"].into_iter().zip(exponents) {
        if exponent != 0 {
            base = base.with(symbol, &exponent);
        }
    }
    Element::new("Unit").with("name", &name).containing([base])
}

fn float(index: usize, variable: &CoSimulationVariable) -> Element {
    let CoSimulationVariable { name, unit, description, role, start } = variable;
    // energy and torque have the same dimensions
    let unit = if unit == "J" { "N m" } else { unit };
    let (causality, variability, initial) = match role {
        Role::Time => ("independent", "continuous", None),
        Role::Parameter => ("parameter", "fixed", Some("exact")),
        // inputs are exact by definition
        Role::Input => ("input", "continuous", None),
        Role::State => ("output", "continuous", Some("exact")),
        Role::Observed => ("output", "continuous", Some("calculated")),
    };
    let mut element = Element::new("Float64")
        .with("name", &name)
        .with("valueReference", &index)
        .with("description", &description)
        .with("causality", &causality)
        .with("variability", &variability);
    if let Some(initial) = initial {
        element = element.with("initial", &initial);
    }
    element = element.with("unit", &unit);
    if matches!(role, Role::Parameter | Role::Input | Role::State) {
        element = element.with("start", &format!("{start:?}"));
    }
    element
}
