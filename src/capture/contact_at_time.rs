//! End effectors and targets at the instant of an impact: where they touch, and how.

use crate::capture::assembly::turned;
use crate::contact::{ContactKind, ContactLaw};
use crate::scenario::{Case, Scenario};
use crate::simulate::system::Body;

/// One contact of an end effector with a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactContact {
    /// Index of the target.
    pub target: usize,
    /// Index of the arm.
    pub arm: usize,
    /// What the contact does.
    pub law: ContactLaw<f64>,
    /// From the COM of the target to the end effector, inertial axes, m.
    pub offset: [f64; 2],
    /// Distance of the end effector from where the contact was wanted on the target, m: between several end effectors
    /// on one target.
    pub miss: f64,
}

/// The targets at the end of an approach that ends by time: each is where the end effectors put it, and contacts are
/// where the end effectors are. With one arm that is the end effector less the wanted contact; with several the mean of
/// that.
///
/// Yaws are the scenario's. A target that no arm takes hold of is where its arms would have, had they closed.
#[must_use]
pub fn contact_at_time(
    scenario: &Scenario,
    case: &Case,
    end_effectors: &[[f64; 3]],
) -> (Vec<Body>, Vec<ImpactContact>) {
    let (mut bodies, mut touching) = (Vec::new(), Vec::new());
    for (i, target) in scenario.targets.iter().enumerate() {
        let kinds = case.kinds.get(i).map_or(&[][..], Vec::as_slice);
        let each = || target.contacts.iter().zip(kinds);
        let closing = each().any(|(_, kind)| kind.is_some());
        let placed: Vec<[f64; 2]> = each()
            .filter(|(_, kind)| !closing || kind.is_some())
            .filter_map(|(touch, _)| {
                let [_, x, y] = end_effectors.get(touch.arm)?;
                Some([x - touch.point[0], y - touch.point[1]])
            })
            .collect();
        #[allow(clippy::cast_precision_loss, reason = "a few arms")]
        let mean = |axis: usize| placed.iter().map(|place| place[axis]).sum::<f64>() / placed.len().max(1) as f64;
        let (x, y) = (mean(0), mean(1));
        let twist = case.target_twists.get(i).copied().unwrap_or(target.twist);
        bodies.push(Body { mass: target.mass, inertia: target.inertia, pose: [target.yaw, x, y], twist });
        for (touch, kind) in each() {
            let Some([_, end_effector_x, end_effector_y]) = end_effectors.get(touch.arm) else { continue };
            let offset = [end_effector_x - x, end_effector_y - y];
            let outline =
                || turned(target.outline.signed_distance(turned(touch.point, -target.yaw)).normal, target.yaw);
            if let Some(law) = contact_law(*kind, outline, case.restitutions.get(i).copied()) {
                let miss = (offset[0] - touch.point[0]).hypot(offset[1] - touch.point[1]);
                touching.push(ImpactContact { target: i, arm: touch.arm, law, offset, miss });
            }
        }
    }
    (bodies, touching)
}

/// The law of a contact; `None` where the end effector does nothing.
pub(crate) fn contact_law(
    kind: Option<ContactKind>,
    normal: impl FnOnce() -> [f64; 2],
    restitution: Option<f64>,
) -> Option<ContactLaw<f64>> {
    kind.map(|kind| ContactLaw::new(kind, normal, restitution.unwrap_or_default()))
}
