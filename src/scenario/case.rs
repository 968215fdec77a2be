//! `[[case]]`: variants of a capture.

use crate::contact::ContactKind;

/// One variant of the capture. All lists are in the targets' order.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Unique in the scenario; usable as a file name.
    pub name: String,
    /// Twist of each target before the impact; default the target's own.
    pub target_twists: Vec<[f64; 3]>,
    /// What each target's contacts do, in the order of its arms; default the target's own.
    pub kinds: Vec<Vec<Option<ContactKind>>>,
    /// Of bounces off each target; default the target's own.
    pub restitutions: Vec<f64>,
    /// Impulse magnitude at each target's contact as somebody else reports it, N s; shown beside what is computed, and
    /// used for nothing else.
    pub printed_impulses: Vec<Option<f64>>,
}
