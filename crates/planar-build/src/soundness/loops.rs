//! What a function that is computed in loops has to have: its inputs, outputs and matrices, with their shapes.

use super::assignments::Known;
use super::{Declared, described, size};
use crate::format::{Function, Variable};

const INPUTS: [&str; 7] =
    ["base_pose", "joint_angles", "joint_rates", "target_masses", "target_inertias", "contacts", "target_twists"];

/// Checks the matrices of a function, of which it has none or those of the impact equations.
pub fn check(declared: &Declared<'_>, function: &Function, known: &Known<'_>) -> Result<(), String> {
    let Function { name, inputs, outputs, matrices, .. } = function;
    if !function.is_in_loops() {
        return Ok(());
    }
    let first_extent = |input: &str| declared.get(input).and_then(|input| input.shape.first()).copied().unwrap_or(0);
    let (joints, arms) = (first_extent("joint_rates"), first_extent("target_masses"));
    let of_arms = [("target_inertias", vec![arms]), ("contacts", vec![arms, 2]), ("target_twists", vec![arms, 3])];
    let has_shape =
        |(input, shape): &(&str, Vec<usize>)| declared.get(input).is_some_and(|input| input.shape == *shape);
    let wanted = [("generalized_inertia", vec![joints, joints]), ("generalized_jacobian", vec![3 * arms, joints])];
    let results = [
        ("impact_matrix", vec![joints, joints]),
        ("impact_momentum", vec![joints]),
        ("joint_rates_after", vec![joints]),
        ("smallest_pivot", vec![]),
    ];
    let is = |found: &[Variable], wanted: &[(&str, Vec<usize>)]| {
        found.iter().map(|variable| (variable.name.as_str(), &variable.shape)).eq(wanted.iter().map(|(n, s)| (*n, s)))
    };
    if *inputs != INPUTS || !of_arms.iter().all(has_shape) || !is(matrices, &wanted) || !is(outputs, &results) {
        return Err(format!("`{name}` has matrices, and not the inputs and outputs of the paper's impact"));
    }
    for matrix in matrices {
        described(matrix)?;
        if size(matrix)? != matrix.elements.len() {
            return Err(format!("`{}` of `{name}` has another number of elements than its shape", matrix.name));
        }
        matrix.elements.iter().try_for_each(|element| known.operand(element))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::format::{Graph, Operand};
    use crate::soundness;

    /// What is said of the graph of three arms when the matrices of its impact are changed.
    fn refused(change: impl Fn(&mut crate::format::Function)) -> String {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen/graphs/triple_arm_3r.json");
        let text = std::fs::read_to_string(path).expect("a graph");
        let mut graph: Graph = serde_json::from_str(&text).expect("of its form");
        assert_eq!(soundness::check(&graph), Ok(()));
        let mut functions = graph.families.iter_mut().flat_map(|family| &mut family.functions);
        change(functions.find(|function| function.is_in_loops()).expect("its impact"));
        soundness::check(&graph).expect_err("refused")
    }

    #[test]
    fn matrices_are_those_of_the_impact_with_their_shapes_and_values() {
        let all = "not the inputs and outputs of the paper's impact";
        assert!(refused(|function| drop(function.matrices.pop())).contains(all));
        assert!(refused(|function| function.matrices.swap(0, 1)).contains(all));
        assert!(refused(|function| function.matrices[1].shape = vec![9, 8]).contains(all));
        assert!(refused(|function| function.inputs.swap(2, 3)).contains(all));
        assert!(refused(|function| function.outputs.swap(1, 2)).contains(all));
        let text = refused(|function| drop(function.matrices[0].elements.pop()));
        assert!(text.contains("`generalized_inertia` of `reduced_impact` has another number"), "{text}");
        let unknown = Operand::Name("c999999".to_owned());
        let text = refused(|function| function.matrices[1].elements[4] = unknown.clone());
        assert!(text.contains("`c999999` is used, and has no value"), "{text}");
        let text = refused(|function| function.matrices[1].description = " code".to_owned());
        assert!(text.contains("description"), "{text}");
    }
}
