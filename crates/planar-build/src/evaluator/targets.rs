//! Targets as the inputs of functions.

use planar_dynamics::target::Target;

/// The elements of the targets' inputs: masses, inertias, contacts and twists, those of a massless target for an arm
/// without one.
pub(crate) fn by_arm(targets: &[Option<Target<f64>>]) -> [Vec<f64>; 4] {
    let all = || targets.iter().map(|target| target.unwrap_or(Target::massless()));
    [
        all().map(|target| target.mass).collect(),
        all().map(|target| target.inertia).collect(),
        all().flat_map(|target| target.contact).collect(),
        all().flat_map(|target| target.twist).collect(),
    ]
}
