//! Cases: variants of a capture that differ in the kinds of their contacts and the motion of their targets.

use crate::contact::ContactKind;
use crate::scenario::Target;

/// One variant of the capture. All lists are in the targets' order.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Case {
    /// Unique in the scenario; usable as a file name.
    pub name: String,
    /// Of its `[[case]]` in the file, from 0.
    pub index: usize,
    /// Twist of each target before the impact; default the target's own.
    pub target_twists: Vec<[f64; 3]>,
    /// Kinds of each target's contacts, in the order of its arms; default the target's own.
    pub kinds: Vec<Vec<Option<ContactKind>>>,
    /// Coefficient of restitution of each target's bounces; default the target's own.
    pub restitutions: Vec<f64>,
    /// Published impulse magnitude at each target's contact, N s; shown beside the computed one and used for nothing
    /// else.
    pub printed_impulses: Vec<Option<f64>>,
}

impl Case {
    /// The case with the targets' own twists, kinds of contact and restitutions.
    #[must_use]
    pub fn of_targets(name: &str, targets: &[Target]) -> Self {
        Self {
            name: name.to_owned(),
            index: 0,
            target_twists: targets.iter().map(|target| target.twist).collect(),
            kinds: targets.iter().map(|target| target.contacts.iter().map(|contact| contact.kind).collect()).collect(),
            restitutions: targets.iter().map(|target| target.restitution).collect(),
            printed_impulses: vec![None; targets.len()],
        }
    }
}
