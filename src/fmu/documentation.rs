//! `documentation/`: a page about the FMU, and licences.

use super::Origin;
use crate::build::{CoSimulationVariable, Role};
use quick_xml::escape::escape;

/// The page.
pub(super) fn html(origin: &Origin<'_>, variables: &[CoSimulationVariable]) -> String {
    let Origin { name, layout_sha256, command, source } = *origin;
    let row = |variable: &CoSimulationVariable| {
        let CoSimulationVariable { name, unit, description, role, start } = variable;
        let (kind, start) = match role {
            Role::Time => ("time", String::new()),
            Role::Parameter => ("parameter", format!("{start:?}")),
            Role::Input => ("input", format!("{start:?}")),
            Role::State => ("output, state", format!("{start:?}")),
            Role::Observed => ("output", String::new()),
        };
        let [name, unit, description] = [name, unit, description].map(|text| escape(text.as_str()).into_owned());
        format!("<tr><td>{name}</td><td>{kind}</td><td>{unit}</td><td>{start}</td><td>{description}</td></tr>\n")
    };
    let rows: String = variables.iter().map(row).collect();
    let [source, command] = [source, command].map(escape);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{name}</title></head><body>\n\
         <h1>{name}</h1>\n\
         <p>Planar dynamics of a free-floating robot, generated from {source} (sha256 {layout_sha256}) by \
         <code>{command}</code>. SI units and radians, inertial axes, angular momentum about the inertial origin; the \
         base's pose, twist and wrench are those of its centre of mass (COM).</p>\n\
         <p>A communication step of h seconds is divided into the fewest equal Runge-Kutta steps of fourth order that \
         are not longer than <code>internal_step</code>: n = ceil(h / internal_step), of h / n each, with inputs that are \
         held. A step in which the equations are singular, or a number is not finite, is an error and changes no \
         variable.</p>\n\
         <table>\n<tr><th>variable</th><th>kind</th><th>unit</th><th>start</th><th>what it is</th></tr>\n{rows}</table>\n\
         </body></html>\n"
    )
}

/// Licences of what is not generated.
pub(super) fn licences() -> String {
    format!(
        "sources/fmi3Functions.h, sources/fmi3FunctionTypes.h and sources/fmi3PlatformTypes.h are headers of FMI 3.0.2,\n\
         https://github.com/modelica/fmi-standard, under this licence:\n\n{}",
        include_str!("fmi3/LICENSE.txt")
    )
}
