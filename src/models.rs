//! From a layout to a model: which generated structure fits, with the layout's numbers as its parameters, or the
//! generic implementation.

use crate::dynamics::Model;
#[allow(unused_imports, reason = "a build may be without any layout")]
use crate::generated;
use crate::generic::Generic;
use crate::layout::Layout;
use crate::manifest::{Manifest, Quantity};

/// A generated structure and how to set its numbers.
struct Candidate {
    manifest: &'static Manifest,
    build: fn(Vec<f64>) -> Box<dyn Model<f64>>,
}

macro_rules! registry {
    (enabled: [$($name:ident),*], disabled: [$($other:ident),*]) => {
        /// (name, TOML text) of every layout that is shipped.
        pub const SHIPPED: &[(&str, &str)] = &[$(shipped!($name),)* $(shipped!($other),)*];

        /// Names of the shipped layouts whose generated code this build has.
        pub const GENERATED: &[&str] = &[$(stringify!($name)),*];

        /// Shipped layouts whose generated code this build was made without: cargo features to be switched on.
        const DISABLED: &[&str] = &[$(stringify!($other)),*];

        const CANDIDATES: &[Candidate] = &[$(Candidate {
            manifest: &generated::$name::MANIFEST,
            build: |values| {
                let parameters = generated::$name::Parameters::from_array(values);
                Box::new(generated::$name::Model::new(parameters))
            },
        }),*];
    };
}

macro_rules! shipped {
    ($name:ident) => {
        (
            stringify!($name),
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/codegen/layouts/", stringify!($name), ".toml")),
        )
    };
}

include!(concat!(env!("OUT_DIR"), "/registry.rs"));

/// No generated code has the structure of a layout.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no generated code in this build has the structure of layout `{layout}` ({structure}); there is: {available}. {mend}"
)]
pub struct NoModel {
    /// The layout's name.
    pub layout: String,
    /// Its structure in words.
    pub structure: String,
    /// The structures that there are.
    pub available: String,
    /// How to get it.
    pub mend: String,
}

/// The generated model of the layout's structure (arms, links, structural zeros), with the layout's numbers.
///
/// # Errors
/// [`NoModel`] where no generated code has that structure.
pub fn generated(layout: &Layout) -> Result<Box<dyn Model<f64>>, NoModel> {
    let fitting = CANDIDATES.iter().filter_map(|c| parameters(c.manifest, layout).map(|values| (c, values)));
    match fitting.min_by_key(|(_, values)| values.len()) {
        Some((candidate, values)) => Ok((candidate.build)(values)),
        None => Err(NoModel {
            layout: layout.name.clone(),
            structure: structure(layout),
            available: CANDIDATES.iter().map(|c| c.manifest.name).collect::<Vec<_>>().join(", "),
            mend: mend(&layout.name),
        }),
    }
}

/// The generic model of any layout.
#[must_use]
pub fn generic(layout: &Layout) -> Box<dyn Model<f64>> {
    Box::new(Generic::new(layout))
}

/// The way to generated code of a layout.
fn mend(layout: &str) -> String {
    if DISABLED.contains(&layout) {
        format!(
            "It is shipped, but left out of this build: build again with `--features {layout}`, or compute it with \
             `--dynamics generic`"
        )
    } else {
        format!(
            "To add it, put the layout into codegen/layouts/{layout}.toml, run `python -m codegen {layout}` and build \
             again with `--features {layout}`; `--dynamics generic` computes any layout as it is"
        )
    }
}

/// The layout's numbers in the order of a manifest; `None` unless the structures are the same.
fn parameters(manifest: &Manifest, layout: &Layout) -> Option<Vec<f64>> {
    let links: Vec<usize> = layout.arms.iter().map(|arm| arm.links.len()).collect();
    if links != manifest.links || (manifest.needs_distinct_mounts && first_mounts_coincide(layout)) {
        return None;
    }
    let mut values = vec![0.0; manifest.parameters.len()];
    for (quantity, arm, link, value) in quantities(layout) {
        match manifest.position(quantity, arm, link) {
            Some(place) => *values.get_mut(place)? = value,
            None if value == 0.0 => {}
            None => return None, // a structural zero of the code is not zero here
        }
        // the length of an inner link is divided by
        let inner = links.get(arm).is_some_and(|n| link + 1 < *n);
        if quantity == Quantity::LinkLength && inner && value == 0.0 && manifest.position(quantity, arm, link).is_some()
        {
            return None;
        }
    }
    Some(values)
}

#[allow(clippy::float_cmp, reason = "a structural zero is an exact one")]
fn first_mounts_coincide(layout: &Layout) -> bool {
    matches!(layout.arms.as_slice(), [first, second, ..] if first.mount == second.mount)
}

/// Every number of a layout and what it is.
fn quantities(layout: &Layout) -> Vec<(Quantity, usize, usize, f64)> {
    let mut all =
        vec![(Quantity::BaseMass, 0, 0, layout.base.mass), (Quantity::BaseInertia, 0, 0, layout.base.inertia)];
    for (i, arm) in layout.arms.iter().enumerate() {
        all.push((Quantity::MountX, i, 0, arm.mount[0]));
        all.push((Quantity::MountY, i, 0, arm.mount[1]));
        all.push((Quantity::MountAngle, i, 0, arm.mount_angle));
        for (k, link) in arm.links.iter().enumerate() {
            all.push((Quantity::LinkLength, i, k, link.length));
            all.push((Quantity::LinkMass, i, k, link.mass));
            all.push((Quantity::LinkInertia, i, k, link.inertia));
            all.push((Quantity::LinkComX, i, k, link.com[0]));
            all.push((Quantity::LinkComY, i, k, link.com[1]));
        }
    }
    all
}

/// Arms, links and what is structurally not zero, in words.
fn structure(layout: &Layout) -> String {
    let links: Vec<String> = layout.arms.iter().map(|arm| arm.links.len().to_string()).collect();
    let mut words = vec![format!("{} arm(s) of {} links", layout.arms.len(), links.join(" + "))];
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
