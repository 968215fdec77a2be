//! Structures of layouts: arms, links, and which numbers are exactly zero.

use crate::layout::Layout;
use planar_dynamics::manifest::{Manifest, ParameterKind};
use std::fmt;

/// A number that keeps a layout from the structure of some generated code.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Path of the key in the layout file.
    pub key: String,
    /// Its value there.
    pub value: f64,
    /// What the generated code has in its place.
    pub instead: &'static str,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is {:?}, that code has {}", self.key, self.value, self.instead)
    }
}

/// A layout does not have the structure of some generated code.
#[derive(Clone, Debug, PartialEq)]
pub enum Mismatch {
    /// Other arms or links.
    Links,
    /// The same arms and links, but zeros elsewhere.
    Zeros(Vec<Difference>),
}

/// The layout's numbers in the order of a manifest.
///
/// # Errors
/// [`Mismatch`] unless the structures are the same.
pub fn parameters(manifest: &Manifest, layout: &Layout) -> Result<Vec<f64>, Mismatch> {
    let links: Vec<usize> = layout.arms.iter().map(|arm| arm.links.len()).collect();
    if links != manifest.links {
        return Err(Mismatch::Links);
    }
    let mut values = vec![0.0; manifest.parameters.len()];
    let mut differences = Vec::new();
    for (kind, arm, link, value) in layout_parameters(layout) {
        let mut differ = |instead| differences.push(Difference { key: key(kind, arm, link), value, instead });
        let place = manifest.position(kind, arm, link).and_then(|i| values.get_mut(i));
        let inner = links.get(arm).is_some_and(|n| link + 1 < *n);
        match place {
            None if value == 0.0 => {}
            None => differ("an exact zero, which costs no operations"),
            // the length of an inner link is divided by
            Some(_) if kind == ParameterKind::LinkLength && inner && value == 0.0 => differ("a length other than zero"),
            Some(place) => *place = value,
        }
    }
    if manifest.needs_distinct_mounts && first_mounts_coincide(layout) {
        let value = layout.arms.get(1).map_or(0.0, |arm| arm.mount[0]);
        differences.push(Difference { key: "arm[1].mount".to_owned(), value, instead: "two arms on mounts apart" });
    }
    if differences.is_empty() { Ok(values) } else { Err(Mismatch::Zeros(differences)) }
}

/// Key of a parameter in a layout file.
fn key(kind: ParameterKind, arm: usize, link: usize) -> String {
    match kind {
        ParameterKind::BaseMass => "base.mass".to_owned(),
        ParameterKind::BaseInertia => "base.inertia".to_owned(),
        ParameterKind::MountX => format!("arm[{arm}].mount[0]"),
        ParameterKind::MountY => format!("arm[{arm}].mount[1]"),
        ParameterKind::MountAngle => format!("arm[{arm}].mount_angle"),
        ParameterKind::LinkLength => format!("arm[{arm}].link[{link}].length"),
        ParameterKind::LinkMass => format!("arm[{arm}].link[{link}].mass"),
        ParameterKind::LinkInertia => format!("arm[{arm}].link[{link}].inertia"),
        ParameterKind::LinkComX => format!("arm[{arm}].link[{link}].com[0]"),
        ParameterKind::LinkComY => format!("arm[{arm}].link[{link}].com[1]"),
    }
}

#[allow(clippy::float_cmp, reason = "a structural zero is an exact one")]
fn first_mounts_coincide(layout: &Layout) -> bool {
    matches!(layout.arms.as_slice(), [first, second, ..] if first.mount == second.mount)
}

/// Every number of a layout: what it is, of which arm and link (0 where there is none), and its value.
#[must_use]
pub fn layout_parameters(layout: &Layout) -> Vec<(ParameterKind, usize, usize, f64)> {
    let mut all = vec![
        (ParameterKind::BaseMass, 0, 0, layout.base.mass),
        (ParameterKind::BaseInertia, 0, 0, layout.base.inertia),
    ];
    for (i, arm) in layout.arms.iter().enumerate() {
        all.push((ParameterKind::MountX, i, 0, arm.mount[0]));
        all.push((ParameterKind::MountY, i, 0, arm.mount[1]));
        all.push((ParameterKind::MountAngle, i, 0, arm.mount_angle));
        for (k, link) in arm.links.iter().enumerate() {
            all.push((ParameterKind::LinkLength, i, k, link.length));
            all.push((ParameterKind::LinkMass, i, k, link.mass));
            all.push((ParameterKind::LinkInertia, i, k, link.inertia));
            all.push((ParameterKind::LinkComX, i, k, link.com[0]));
            all.push((ParameterKind::LinkComY, i, k, link.com[1]));
        }
    }
    all
}

/// Arms, links and what is structurally not zero, in words.
#[must_use]
pub fn in_words(layout: &Layout) -> String {
    let links: Vec<String> = layout.arms.iter().map(|arm| arm.links.len().to_string()).collect();
    let arms = if links.len() == 1 { "arm" } else { "arms" };
    let mut words = vec![format!("{} {arms} of {} links", links.len(), links.join(" + "))];
    if layout.arms.iter().any(|arm| arm.mount[1] != 0.0) {
        words.push("a mount off the base x axis".to_owned());
    }
    if layout.arms.iter().any(|arm| arm.mount_angle != 0.0) {
        words.push("a mount angle".to_owned());
    }
    let inner = || layout.arms.iter().flat_map(|arm| arm.links.split_last().map_or(&[][..], |(_, inner)| inner));
    if inner().any(|link| link.com[1] != 0.0) {
        words.push("an off-axis COM".to_owned());
    }
    if inner().any(|link| link.length == 0.0) {
        words.push("an inner link of length zero".to_owned());
    }
    if first_mounts_coincide(layout) {
        words.push("two arms on one mount".to_owned());
    }
    words.join(", ")
}
