//! The paper's impact in loops, from generalized inertia and Jacobian, where a graph has these as its matrices. The loops
//! are those of the core, and in a module in C the same operations in the same order.

use super::needed::needed;
use super::statements::Scope;
use crate::format::{Function, Operand, Statement, Variable};

/// The names of the elements of some values.
pub fn names(values: &[Variable]) -> Vec<&str> {
    values.iter().flat_map(|value| &value.elements).filter_map(Operand::name).collect()
}

/// A function without the statements that loops stand for.
pub fn without_loops(function: &Function) -> (Vec<(String, usize)>, Vec<Statement>) {
    needed(&[(&function.sections, &function.statements)], &names(function.roots()))
}

/// The lines in Rust that compute the fields of the result from the matrices.
pub fn in_rust(function: &Function, scope: &Scope<'_>, is_fused: bool) -> Vec<String> {
    let matrices: Vec<String> = function.matrices.iter().map(|matrix| scope.array(matrix)).collect();
    let lines = format!(
        "// impact equations
        // both at once: the names of one must not hide those that the other is made of
        let (mut impact_matrix, generalized_jacobian) = ({});
        let mut factors = [[T::ZERO; JOINTS]; JOINTS];
        let (mut impact_momentum, mut joint_rates_after) = ([T::ZERO; JOINTS], [T::ZERO; JOINTS]);
        let equations = ImpactEquations {{
            generalized_jacobian: &generalized_jacobian[..],
            joint_rates,
            target_masses,
            target_inertias,
            contacts,
            target_twists,
        }};
        let smallest_pivot = equations.solve::<{is_fused}>(&mut impact_matrix, &mut factors, &mut impact_momentum, &mut joint_rates_after);",
        matrices.join(", ")
    );
    lines.lines().map(|line| line.strip_prefix("        ").unwrap_or(line).to_owned()).collect()
}

/// The lines in C that compute the outputs from the matrices, and the pivot's name.
pub fn in_c(function: &Function, scope: &Scope<'_>) -> (Vec<String>, String) {
    let jacobian = function.matrices.iter().map(|matrix| matrix.elements.len()).next_back().unwrap_or_default();
    let mut lines = vec!["/* impact equations */".to_owned(), format!("real jacobian[{jacobian}];")];
    for (name, matrix) in ["impact_matrix", "jacobian"].iter().zip(&function.matrices) {
        let elements = matrix.elements.iter().enumerate();
        lines.extend(elements.map(|(index, element)| format!("{name}[{index}] = {};", scope.operand(element))));
    }
    lines.push(
        "const real pivot = impact_equations(jacobian, joint_rates, target_masses, target_inertias, contacts, \
         target_twists, impact_matrix, impact_momentum, joint_rates_after);"
            .to_owned(),
    );
    (lines, "pivot".to_owned())
}
