//! The variables of a robot in co-simulation.

use crate::format::Graph;

/// The longest Runge–Kutta step, s, where nothing else is set.
pub const INTERNAL_STEP: f64 = 0.001;
/// Coordinates of poses, twists and wrenches, with their units.
const POSE: [(&str, &str); 3] = [("yaw", "rad"), ("x", "m"), ("y", "m")];
const TWIST: [(&str, &str); 3] = [("omega", "rad/s"), ("vx", "m/s"), ("vy", "m/s")];
const WRENCH: [(&str, &str); 3] = [("n", "N m"), ("fx", "N"), ("fy", "N")];

/// What a variable is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The time, which all others depend on.
    Time,
    /// A number that is constant during a simulation.
    Parameter,
    /// Held during a communication step.
    Input,
    /// Part of the state; its value at the start can be set.
    State,
    /// Computed from the state.
    Observed,
}

/// A variable; its value reference is its place in the list.
#[derive(Clone, Debug, PartialEq)]
pub struct CoSimulationVariable {
    /// That of the parameter in modules, or of the column in a time series.
    pub name: String,
    /// In SI.
    pub unit: String,
    /// What it is.
    pub description: String,
    /// What it is for.
    pub role: Role,
    /// Its value at the start; of no meaning where it is computed.
    pub start: f64,
}

/// All variables: roles one after the other, the first parameter the longest step.
pub fn variables(graph: &Graph) -> Vec<CoSimulationVariable> {
    let mut list = List { graph, variables: Vec::new() };
    list.one("time", "s", "time", Role::Time);
    list.one(
        "internal_step",
        "s",
        "longest Runge-Kutta step; communication steps are divided equally",
        Role::Parameter,
    );
    list.variables.extend(graph.parameters.iter().map(|parameter| CoSimulationVariable {
        name: parameter.name.clone(),
        unit: parameter.unit.clone(),
        description: parameter.description.clone(),
        role: Role::Parameter,
        start: parameter.default,
    }));
    list.joints("torque", "N m", Role::Input);
    list.vector("base_wrench", WRENCH, "on the base at its COM, inertial axes", Role::Input);
    // in the order of a module's arguments
    list.vector("base", POSE, "of the base's COM, inertial frame", Role::State);
    list.joints("angle", "rad", Role::State);
    list.vector("base", TWIST, "of the base's COM, inertial axes", Role::State);
    list.joints("rate", "rad/s", Role::State);
    for (coordinates, axes) in [(POSE, "frame"), (TWIST, "axes")] {
        for arm in &graph.layout.arms {
            let of = format!("of the end effector of {}, inertial {axes}", arm.name);
            list.vector(&format!("{}_tip", arm.name), coordinates, &of, Role::Observed);
        }
    }
    list.vector("linear_momentum", [("x", "N s"), ("y", "N s")], "of all bodies, inertial axes", Role::Observed);
    list.one("angular_momentum", "N m s", "about the inertial origin", Role::Observed);
    list.one("kinetic_energy", "J", "of all bodies", Role::Observed);
    list.variables
}

/// Variables that are being listed.
struct List<'a> {
    graph: &'a Graph,
    variables: Vec<CoSimulationVariable>,
}

impl List<'_> {
    fn one(&mut self, name: &str, unit: &str, description: &str, role: Role) {
        let start = if name == "internal_step" { INTERNAL_STEP } else { 0.0 };
        let (name, unit, description) = (name.to_owned(), unit.to_owned(), description.to_owned());
        self.variables.push(CoSimulationVariable { name, unit, description, role, start });
    }

    /// The coordinates of a vector.
    fn vector<const N: usize>(&mut self, owner: &str, coordinates: [(&str, &str); N], of: &str, role: Role) {
        for (coordinate, unit) in coordinates {
            self.one(&format!("{owner}_{coordinate}"), unit, &format!("{coordinate} {of}"), role);
        }
    }

    /// A quantity of each joint, arm by arm.
    fn joints(&mut self, quantity: &str, unit: &str, role: Role) {
        for arm in &self.graph.layout.arms {
            for joint in 1..=arm.links {
                let name = format!("{}_joint{joint}_{quantity}", arm.name);
                self.one(&name, unit, &format!("{quantity} of joint {joint} of {}", arm.name), role);
            }
        }
    }
}
