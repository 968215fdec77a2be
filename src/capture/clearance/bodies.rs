//! The bodies of a scenario with their outlines, and the pairs of them that must not meet.

use crate::capture::contact_pair::ContactPair;
use crate::capture::proximity::convex::ConvexPart;
use crate::frames::{Frame, FrameMotion};
use crate::layout::Layout;
use crate::outline::Outline;
use crate::scenario::Scenario;

/// A base, link or target.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ClearanceBody {
    /// Index of its frame.
    pub(super) frame: usize,
    /// As in MCAP: `base`, `arms/ARM/link1`, `targets/TARGET`.
    pub(super) name: String,
    /// Whose union is the outline.
    pub(super) parts: Vec<ConvexPart>,
    /// Whether the layout gives no outline.
    pub(super) is_default: bool,
}

impl ClearanceBody {
    /// The largest distance of its points from the origin of its frame, m.
    pub(super) fn reach(&self) -> f64 {
        self.parts.iter().map(|part| part.reach + part.radius).fold(0.0, f64::max)
    }
}

/// Two bodies that are not joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct BodyPair {
    /// Indices of the bodies, the smaller first.
    pub(super) bodies: [usize; 2],
    /// Arm and target, where it is the last link of an arm and a target that the arm captures.
    pub(super) contact: Option<(usize, usize)>,
    /// The least distance is that of a group of pairs.
    pub(super) group: usize,
}

/// All bodies of a scenario, in the order of their frames.
pub(super) fn bodies(scenario: &Scenario, frames: &[Frame]) -> Vec<ClearanceBody> {
    let links: Vec<_> = scenario.layout.arms.iter().flat_map(|arm| &arm.links).collect();
    let body = |(i, frame): (usize, &Frame)| {
        let (given, default) = match frame.motion {
            FrameMotion::Base => (scenario.layout.base.outline.clone(), default_base(&scenario.layout)),
            FrameMotion::Joint(joint) => {
                let ends = [[0.0; 2], [links[joint].length, 0.0]];
                (links[joint].outline.clone(), Outline::Capsule { ends, radius: 0.0 })
            }
            FrameMotion::Target(target) => {
                let outline = &scenario.targets[target].outline;
                (Some(outline.clone()), outline.clone())
            }
            FrameMotion::Fixed => return None,
        };
        Some(ClearanceBody {
            frame: i,
            name: frame.name.clone(),
            is_default: given.is_none(),
            parts: ConvexPart::of(&given.unwrap_or(default)),
        })
    };
    frames.iter().enumerate().filter_map(body).collect()
}

fn default_base(layout: &Layout) -> Outline {
    Outline::rectangle([0.0; 2], layout.default_base_size(), 0.0)
}

/// All pairs of bodies that no joint joins and that the scenario does not ignore.
pub(super) fn pairs(scenario: &Scenario, frames: &[Frame], bodies: &[ClearanceBody]) -> Vec<BodyPair> {
    let ignored = |a: &str, b: &str| {
        let pairs = &scenario.clearance.ignore;
        pairs.iter().any(|[c, d]| (c == a && d == b) || (c == b && d == a))
    };
    let mut pairs = Vec::new();
    for (i, a) in bodies.iter().enumerate() {
        for (j, b) in bodies.iter().enumerate().skip(i + 1) {
            let is_left_out = scenario.clearance.only_given && (a.is_default || b.is_default);
            if !is_left_out && !are_joined(scenario, frames, [a.frame, b.frame]) && !ignored(&a.name, &b.name) {
                let contact = contact(scenario, frames, [a.frame, b.frame]);
                pairs.push(BodyPair { bodies: [i, j], contact, group: usize::from(contact.is_some()) });
            }
        }
    }
    pairs
}

/// Indices of the pairs in `ignore` that change nothing, and why.
pub(crate) fn ineffective_ignores(scenario: &Scenario) -> Vec<(usize, &'static str)> {
    let frames = scenario.frames();
    let frame = |name: &str| frames.iter().position(|frame| frame.name == name);
    let pairs = &scenario.clearance.ignore;
    let is_same = |[a, b]: &[String; 2], [c, d]: &[String; 2]| (a, b) == (c, d) || (a, b) == (d, c);
    let reason = |(i, pair @ [a, b]): (usize, &[String; 2])| {
        let (first, second) = (frame(a)?, frame(b)?);
        if a == b {
            Some((i, "a body is not compared with itself"))
        } else if are_joined(scenario, &frames, [first.min(second), first.max(second)]) {
            Some((i, "the two have a common joint, and are not compared"))
        } else {
            pairs[..i].iter().any(|earlier| is_same(earlier, pair)).then_some((i, "the pair is there before"))
        }
    };
    pairs.iter().enumerate().filter_map(reason).collect()
}

/// The end effectors as points, the targets, and the pairs of the planned contacts, each a group.
pub(super) fn end_effector_pairs(
    scenario: &Scenario,
    frames: &[Frame],
    contacts: &[ContactPair],
) -> (Vec<ClearanceBody>, Vec<BodyPair>) {
    let body = |(i, frame): (usize, &Frame)| {
        let parts = match frame.motion {
            FrameMotion::Fixed => vec![ConvexPart::point()],
            FrameMotion::Target(target) => ConvexPart::of(&scenario.targets[target].outline),
            FrameMotion::Base | FrameMotion::Joint(_) => return None,
        };
        Some(ClearanceBody { frame: i, name: frame.name.clone(), parts, is_default: false })
    };
    let bodies: Vec<_> = frames.iter().enumerate().filter_map(body).collect();
    // the end effectors come first, in the order of the arms
    let arms = scenario.layout.arms.len();
    let pair = |(group, &ContactPair { target, arm, .. }): (usize, &ContactPair)| BodyPair {
        bodies: [arm, arms + target],
        contact: Some((arm, target)),
        group,
    };
    (bodies, contacts.iter().enumerate().map(pair).collect())
}

/// Whether two bodies have a common joint: base or link with the next link, with nothing but wheels between them, and
/// links that begin at the same point of a body.
fn are_joined(scenario: &Scenario, frames: &[Frame], [a, b]: [usize; 2]) -> bool {
    let is_wheel = |frame: usize| match frames[frame].motion {
        FrameMotion::Joint(joint) => {
            scenario.layout.arms.iter().flat_map(|arm| &arm.links).nth(joint).is_some_and(|link| link.length == 0.0)
        }
        _ => false,
    };
    let mut parent = frames[b].parent;
    while let Some(frame) = parent {
        if frame == a {
            return true;
        }
        if !is_wheel(frame) {
            break;
        }
        parent = frames[frame].parent;
    }
    let same_place = frames[a].pose[1..] == frames[b].pose[1..];
    frames[a].parent.is_some() && frames[a].parent == frames[b].parent && same_place
}

/// Arm and target of a last link and a target that it captures.
fn contact(scenario: &Scenario, frames: &[Frame], [link, body]: [usize; 2]) -> Option<(usize, usize)> {
    let (FrameMotion::Joint(joint), FrameMotion::Target(target)) = (frames[link].motion, frames[body].motion) else {
        return None;
    };
    let arm = frames[link].arm?;
    let last: usize = scenario.layout.arms.iter().take(arm + 1).map(|arm| arm.links.len()).sum();
    let captures = scenario.targets[target].contacts.iter().any(|contact| contact.arm == arm);
    (joint + 1 == last && captures).then_some((arm, target))
}
