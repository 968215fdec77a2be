//! Lengths of all links that were probably meant in mm.

use super::{Layout, Link};

/// Robots do not reach that far, m.
const LARGEST_REACH: f64 = 100.0;
/// Nor are all links of one that does so shorter than this, m.
const LEAST_LENGTH: f64 = 5.0;
/// Radius of gyration of a link relative to its length, below that of all but point masses: of a uniform rod it is 0.29,
/// and 3e-4 where the length is in mm.
const LEAST_RADIUS: f64 = 1e-3;

/// That all lengths are probably in mm, by the first link that has one.
#[derive(Clone, Debug, PartialEq)]
pub struct Millimetres {
    /// Index of the arm.
    pub arm: usize,
    /// Index of its link.
    pub link: usize,
    /// What shows it.
    pub why: String,
    /// What to write.
    pub help: String,
}

impl Layout {
    /// Whether all lengths of links are probably in mm: the arms reach farther than those of any robot, or all links are as good
    /// as point masses in their length.
    #[must_use]
    pub fn millimetres(&self) -> Option<Millimetres> {
        let arms = self.arms.iter().enumerate();
        let links = arms.flat_map(|(i, arm)| arm.links.iter().enumerate().map(move |(k, link)| (i, k, link)));
        let long: Vec<_> = links.filter(|(.., link)| link.length > 0.0).collect();
        let &(arm, link, Link { length, .. }) = long.first()?;
        let reach = self.reach_from_base();
        let all = |is: &dyn Fn(&Link) -> bool| long.iter().all(|(.., link)| is(link));
        let why = if all(&|link| libm::sqrt(link.inertia / link.mass) < LEAST_RADIUS * link.length) {
            "all links have radii of gyration √(inertia / mass) below a thousandth of their lengths".to_owned()
        } else if reach > LARGEST_REACH && all(&|link| link.length > LEAST_LENGTH) {
            format!("the arms reach up to {reach:.0} m from the base COM")
        } else {
            return None;
        };
        let help =
            format!("lengths, mounts and COMs are in m, inertias in kg m²: {length} mm are {} m", length / 1000.0);
        Some(Millimetres { arm, link, why, help })
    }

    /// With all lengths of links a thousandth of what they are.
    pub(super) fn in_metres(&self) -> Self {
        let mut shorter = self.clone();
        for link in shorter.arms.iter_mut().flat_map(|arm| &mut arm.links) {
            link.length /= 1000.0;
            link.com = link.com.map(|part| part / 1000.0);
        }
        shorter
    }
}
