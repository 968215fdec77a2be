//! The structure of a layout, its arms, links and exact zeros, compared with that of code or a graph.
//!
//! # Example
//! ```
//! use planar_layout::layout::Layout;
//! use planar_layout::structure::{fingerprint, in_words};
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen/layouts");
//! let layout = Layout::read(format!("{folder}/dual_arm_3r.toml").as_ref())?;
//! assert_eq!(in_words(&layout), "2 arms of 3 + 3 links");
//! // code for this layout is code for one of other masses …
//! let mut other = layout.clone();
//! other.base.mass = 50.0;
//! assert_eq!(fingerprint(&other), fingerprint(&layout));
//! // … but not for one with another number in place of a zero
//! other.arms[0].mount = [0.5, 0.1];
//! assert_ne!(fingerprint(&other), fingerprint(&layout));
//! assert_eq!(in_words(&other), "2 arms of 3 + 3 links, a mount off the base x axis");
//! # Ok::<(), planar_layout::diagnostic::Report>(())
//! ```

use crate::layout::{Arm, Layout, Link, parameter_key};
use planar_dynamics::manifest::{Manifest, ParameterKind};
use std::fmt;

/// A number of a layout that does not fit the structure of some generated code.
#[derive(Clone, Debug, PartialEq)]
pub struct StructuralDifference {
    /// Path of the key in the layout file.
    pub key: String,
    /// Its value there.
    pub value: f64,
    /// What the generated code has instead.
    pub instead: &'static str,
}

impl fmt::Display for StructuralDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is {:?}, that code has {}", self.key, self.value, self.instead)
    }
}

/// How the structure of a layout differs from that of some generated code.
#[derive(Clone, Debug, PartialEq)]
pub enum Mismatch {
    /// Other arms or links.
    Links,
    /// The same arms and links, but other zeros.
    Zeros(Vec<StructuralDifference>),
}

/// The structure that some code or graph was derived for.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Structure {
    /// Number of links of each arm.
    pub links: Vec<usize>,
    /// What each parameter is, with arm and link, in order; all other numbers of a layout are exact zeros.
    pub parameters: Vec<(ParameterKind, usize, usize)>,
    /// Whether it divides by the distance between the first two mounts.
    pub needs_distinct_mounts: bool,
}

impl From<&Manifest> for Structure {
    fn from(manifest: &Manifest) -> Self {
        let parameters = manifest.parameters.iter().map(|p| (p.kind, p.arm, p.link)).collect();
        Self { links: manifest.links.to_vec(), parameters, needs_distinct_mounts: manifest.needs_distinct_mounts }
    }
}

/// What two layouts of one structure share, as a text: links, exact zeros, and whether the first mounts coincide.
#[must_use]
pub fn fingerprint(layout: &Layout) -> String {
    let numbers = layout.parameters();
    let zeros = numbers.iter().map(|(kind, arm, link, value)| format!("{kind:?} {arm} {link} {}\n", *value == 0.0));
    zeros.chain([format!("one mount {}\n", first_mounts_coincide(layout))]).collect()
}

/// The layout's numbers in the order of a structure's parameters.
///
/// # Errors
/// [`Mismatch`] unless the structures are the same.
pub fn parameters(structure: &Structure, layout: &Layout) -> Result<Vec<f64>, Mismatch> {
    let links: Vec<usize> = layout.arms.iter().map(|arm| arm.links.len()).collect();
    if links != structure.links {
        return Err(Mismatch::Links);
    }
    let mut values = vec![0.0; structure.parameters.len()];
    let mut differences = Vec::new();
    let mut differ = |key, value, instead| differences.push(StructuralDifference { key, value, instead });
    for (kind, arm, link, value) in layout.parameters() {
        let key = || parameter_key(kind, arm, link);
        match structure.parameters.iter().position(|parameter| *parameter == (kind, arm, link)) {
            None if value == 0.0 => {}
            None => differ(key(), value, "an exact zero, which costs no operations"),
            // the model divides by the length of an inner link
            Some(_) if kind == ParameterKind::LinkLength && link + 1 < links[arm] && value == 0.0 => {
                differ(key(), value, "a length other than zero");
            }
            Some(position) => values[position] = value,
        }
    }
    if structure.needs_distinct_mounts && first_mounts_coincide(layout) {
        differ("arm[1].mount".to_owned(), layout.arms[1].mount[0], "two arms on mounts apart");
    }
    if differences.is_empty() { Ok(values) } else { Err(Mismatch::Zeros(differences)) }
}

/// Mounts closer than this times their distances from the base COM count as one: code that divides by their distance
/// loses as many digits. As in the derivation.
const SMALLEST_DISTANCE: f64 = 1e-6;

fn first_mounts_coincide(layout: &Layout) -> bool {
    let [first, second, ..] = layout.arms.as_slice() else { return false };
    let [[x, y], [other_x, other_y]] = [first.mount, second.mount];
    libm::hypot(x - other_x, y - other_y) <= SMALLEST_DISTANCE * (libm::hypot(x, y) + libm::hypot(other_x, other_y))
}

/// The arms, links and structural properties other than zero, in words.
#[must_use]
pub fn in_words(layout: &Layout) -> String {
    let links: Vec<String> = layout.arms.iter().map(|arm| arm.links.len().to_string()).collect();
    let arms = if links.len() == 1 { "arm" } else { "arms" };
    let noun = if links == ["1"] { "link" } else { "links" };
    let counts = format!("{} {arms} of {} {noun}", links.len(), links.join(" + "));
    let any_arm = |property: fn(&Arm) -> bool| layout.arms.iter().any(property);
    let any_inner_link = |property: fn(&Link) -> bool| {
        layout.arms.iter().filter_map(|arm| arm.links.split_last()).any(|(_, inner)| inner.iter().any(property))
    };
    let properties = [
        (any_arm(|arm| arm.mount[1] != 0.0), "a mount off the base x axis"),
        (any_arm(|arm| arm.mount_angle != 0.0), "a mount angle"),
        (any_inner_link(|link| link.com[1] != 0.0), "an off-axis COM"),
        (any_inner_link(|link| link.length == 0.0), "an inner link of length zero"),
        (first_mounts_coincide(layout), "two arms on one mount"),
    ];
    let present = properties.into_iter().filter(|(present, _)| *present).map(|(_, words)| words);
    std::iter::once(counts.as_str()).chain(present).collect::<Vec<_>>().join(", ")
}
