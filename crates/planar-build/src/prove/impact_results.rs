//! Velocities and impulses after an impact by the generic implementation, as functions of a graph with derivatives have
//! them: exact, and by the paper's equations.

use crate::format::FunctionResult;
use crate::prove::evaluation::EvaluationInput;
use crate::prove::generic::Generic;
use crate::prove::generic_results::{Expected, results};
use planar_dynamics::error::Error;
use planar_dynamics::impact::{PaperImpactWorkspace, RigidImpactOutput, paper};
use planar_dynamics::quantity::Quantity;
use planar_dynamics::target::Target;
use planar_layout::layout::Layout;

/// The function with the exact results.
pub const EXACT: &str = "exact_impact";
/// That with the paper's.
const PAPER: &str = "paper_impact";

const OUTPUTS: [(&str, Quantity); 4] = [
    ("base_twist_after", Quantity::CaptureBaseTwist),
    ("joint_rates_after", Quantity::CaptureJointRates),
    ("target_twists_after", Quantity::CaptureTargetTwists),
    ("impulses", Quantity::CaptureImpulses),
];

/// The results of both functions, and how many rounding units each may be off in natural sizes. An arm without a target
/// has one without mass, which moves with its end effector.
pub fn impact_results(layout: &Layout, instant: &EvaluationInput) -> Result<Vec<(FunctionResult, f64)>, Error> {
    let targets = instant.targets.iter().map(|target| Some(target.unwrap_or_else(Target::massless))).collect();
    let instant = EvaluationInput { targets, ..instant.clone() };
    let all = results(layout, &instant)?;
    let by_paper = by_paper(layout, &instant)?;
    let condition = all.get(&Quantity::ImpactJointRates).map_or(1.0, |rates| rates.roundings);
    let mut found = Vec::new();
    for ((output, quantity), paper) in OUTPUTS.into_iter().zip(by_paper) {
        let Some(Expected { values, sizes, roundings }) = all.get(&quantity).cloned() else { continue };
        // the paper's differ from the exact ones, and are of the same sizes
        let paper_sizes = sizes.iter().map(|size| size * condition / roundings).collect();
        let result = |function: &str, values, sizes| {
            let (function, output) = (function.to_owned(), output.to_owned());
            FunctionResult { function, output, values, sizes }
        };
        found.push((result(EXACT, values, sizes), roundings));
        found.push((result(PAPER, paper, paper_sizes), condition));
    }
    Ok(found)
}

/// The results by the paper's equations, in the order of [`OUTPUTS`].
fn by_paper(layout: &Layout, instant: &EvaluationInput) -> Result<[Vec<f64>; 4], Error> {
    let (arms, joints) = (layout.arms.len(), layout.joints());
    let (mut joint_rates, mut target_twists, mut impulses) =
        (vec![0.0; joints], vec![[0.0; 3]; arms], vec![[0.0; 3]; arms]);
    let mut workspace = PaperImpactWorkspace {
        impact_matrix: &mut vec![0.0; joints * joints],
        impact_momentum: &mut vec![0.0; joints],
        jacobian: &mut vec![0.0; 3 * arms * joints],
        mass_matrix: &mut vec![0.0; (3 + joints) * (3 + joints)],
    };
    let mut after =
        RigidImpactOutput { joint_rates: &mut joint_rates, target_twists: &mut target_twists, impulses: &mut impulses };
    let (model, mut state) = (Generic::new(layout), instant.state.clone());
    // nothing depends on the position, but eq. (17) has momenta about the origin, which lose digits far from it
    state.base_pose = [state.base_pose[0], 0.0, 0.0];
    let base_twist = paper(&model, &state.view(), &instant.targets, &mut workspace, &mut after)?;
    Ok([base_twist.to_vec(), joint_rates, target_twists.into_flattened(), impulses.into_flattened()])
}
