//! Remarks on properties of joints that a layout does not have: losses and limits.

use super::description::{Joint, JointKind};
use super::remark::Remark;

/// Remarks on the imported joints.
pub(super) fn omissions<'a>(joints: impl Iterator<Item = &'a Joint> + Clone) -> Vec<Remark> {
    let lossy = joints.clone().filter(|joint| joint.damping != 0.0 || joint.friction != 0.0);
    let lossy = lossy.map(|joint| {
        format!("`{}` damping {:?} N m s/rad, friction {:?} N m", joint.name, joint.damping, joint.friction)
    });
    let limits = joints.clone().filter_map(limits);
    let default_axis = joints.filter(|joint| joint.axis.is_none()).map(|joint| format!("`{}`", joint.name));
    let remarks = [
        Remark::of_items(Remark::warning, "losses of joints are omitted", "; ", lossy),
        Remark::of_items(Remark::note, "limits of joints are omitted", "; ", limits),
        Remark::of_items(Remark::note, "no <axis>; URDF's default is x", ", ", default_axis),
    ];
    remarks.into_iter().flatten().collect()
}

/// The limits of a joint, if it has any.
fn limits(joint: &Joint) -> Option<String> {
    let limit = &joint.limit;
    let mut parts = Vec::new();
    // a continuous joint has no limits of its angle
    if joint.kind == JointKind::Revolute && (limit.lower.is_finite() || limit.upper.is_finite()) {
        parts.push(format!("angle [{:?}, {:?}] rad", limit.lower, limit.upper));
    }
    for (what, value, unit) in [("rate", limit.velocity, "rad/s"), ("torque", limit.effort, "N m")] {
        if value.is_finite() && value != 0.0 {
            parts.push(format!("{what} {value:?} {unit}"));
        }
    }
    (!parts.is_empty()).then(|| format!("`{}` {}", joint.name, parts.join(", ")))
}
