//! The paper's impact as rendered code computes it in loops, in any scalar.

use crate::format::Function;
use planar_dynamics::impact_equations::ImpactEquations;
use planar_dynamics::scalar::Scalar;

/// The outputs of a function, one after the other, from its matrices and what the call adds to the configuration, one after
/// the other.
pub(crate) fn impact_equations<T: Scalar>(function: &Function, given: &[T]) -> Vec<T> {
    let [joints, end_effector_rows] =
        [0, 1].map(|index| function.matrices.get(index).and_then(|matrix| matrix.shape.first()).copied().unwrap_or(0));
    let arms = end_effector_rows / 3;
    let mut rest = given;
    let mut part = |length: usize| {
        let (part, after) = rest.split_at(length.min(rest.len()));
        rest = after;
        part
    };
    let rows = |entries: &[T]| entries.chunks_exact(joints.max(1)).map(<[T]>::to_vec).collect::<Vec<_>>();
    let (mut matrix, generalized_jacobian) = (rows(part(joints * joints)), rows(part(end_effector_rows * joints)));
    let equations = ImpactEquations {
        generalized_jacobian: &generalized_jacobian,
        joint_rates: part(joints),
        target_masses: part(arms),
        target_inertias: part(arms),
        contacts: part(2 * arms).as_chunks().0,
        target_twists: part(3 * arms).as_chunks().0,
    };
    let mut factors = matrix.clone();
    let [mut momentum, mut after] = [(); 2].map(|()| vec![T::ZERO; joints]);
    let pivot = equations.solve::<false>(&mut matrix, &mut factors, &mut momentum, &mut after);
    [matrix.concat(), momentum, after, vec![pivot]].concat()
}
