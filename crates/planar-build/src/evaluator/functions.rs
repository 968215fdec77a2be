//! The functions of a graph that the dynamics of a robot need.

use crate::graph::GraphError;
use planar_dynamics::quantity::Quantity;
use planar_dynamics::with_quantities;
use planar_layout::structure::Structure;

const CONFIGURATION: [&str; 2] = ["base_pose", "joint_angles"];
const STATE: [&str; 4] = ["base_pose", "joint_angles", "base_twist", "joint_rates"];
const TARGETS: [&str; 4] = ["target_masses", "target_inertias", "contacts", "target_twists"];

/// Finds the function of a name with these inputs, and outputs with these numbers of elements.
type Find<'a> = &'a mut dyn FnMut(&str, &[&str], &[(&str, usize)]) -> Result<usize, GraphError>;

macro_rules! functions {
    (
        functions { $($(#[$doc:meta])* trait $trait:ident {
            $($(#[$of_method:meta])* $quantity:ident $method:ident($inputs:ident) $kind:ident $extents:tt $unit:literal, $shown:expr;)*
        })* }
        results $results:tt
    ) => {
        /// The positions of those functions of a graph that the traits need.
        #[derive(Clone, Debug)]
        pub(super) struct Functions {
            $($(pub $method: usize,)*)*
            pub momentum: usize,
            pub reduced_dynamics: usize,
            pub forward_dynamics: [usize; 3],
            pub reduced_impact: usize,
            pub full_impact: usize,
        }

        impl Functions {
            pub fn new(structure: &Structure, find: Find<'_>) -> Result<Self, GraphError> {
                let (arms, joints) = (structure.links.len(), structure.links.iter().sum::<usize>());
                let size = |quantity: Quantity| -> usize {
                    quantity.row().shape.iter().map(|extent| extent.count(arms, joints)).product()
                };
                $($(let $method = {
                    let inputs: &[&str] = functions!(@inputs $inputs);
                    let name = stringify!($method);
                    find(name, inputs, &[(name, size(Quantity::$quantity))])?
                };)*)*
                let pivot = ("smallest_pivot", 1);
                let accelerations = [("base_acceleration", 3), ("joint_accelerations", joints), pivot];
                let after = ("joint_rates_after", joints);
                let (coordinates, of_joints) = (3 + joints, [&STATE[..], &["joint_torques"]].concat());
                Ok(Self {
                    $($($method,)*)*
                    momentum: find(
                        "momentum",
                        &STATE,
                        &[("linear_momentum", 2), ("angular_momentum", 1), ("kinetic_energy", 1)],
                    )?,
                    reduced_dynamics: find("reduced_dynamics", &STATE, &[
                        ("generalized_inertia", joints * joints),
                        ("generalized_bias", joints),
                        ("generalized_jacobian", 3 * arms * joints),
                        pivot,
                    ])?,
                    forward_dynamics: [
                        find("forward_dynamics", &of_joints, &accelerations)?,
                        find(
                            "forward_dynamics_with_base_wrench",
                            &[&of_joints[..], &["base_wrench"]].concat(),
                            &accelerations,
                        )?,
                        find(
                            "forward_dynamics_with_wrenches",
                            &[&of_joints[..], &["base_wrench", "end_effector_wrenches"]].concat(),
                            &accelerations,
                        )?,
                    ],
                    reduced_impact: find(
                        "reduced_impact",
                        &[&["base_pose", "joint_angles", "joint_rates"], &TARGETS[..]].concat(),
                        &[("impact_matrix", joints * joints), ("impact_momentum", joints), after, pivot],
                    )?,
                    full_impact: find("full_impact", &[&STATE[..], &TARGETS].concat(), &[
                        ("impact_matrix", coordinates * coordinates),
                        ("impact_momentum", coordinates),
                        ("base_twist_after", 3),
                        after,
                        pivot,
                    ])?,
                })
            }
        }
    };
    (@inputs configuration) => { &CONFIGURATION };
    (@inputs state) => { &STATE };
}

with_quantities!(functions);
