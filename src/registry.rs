//! The model of a layout: generated code of its structure, with the layout's numbers as parameters, or the generic
//! implementation.

#[allow(unused_imports, reason = "a build may be without any layout")]
use crate::generated;
use crate::generic::Generic;
use crate::layout::Layout;
use crate::manifest::Manifest;
use crate::owned::CloneModel;
use crate::structure::{Mismatch, StructuralDifference, in_words, parameters};

/// A generated structure, and its model with given values of the parameters.
struct Candidate {
    manifest: &'static Manifest,
    build: fn(Vec<f64>) -> Box<dyn CloneModel>,
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
                let values = values.try_into().expect("one value per parameter");
                Box::new(generated::$name::Model::new(generated::$name::Parameters::from_array(values)))
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

/// No generated code in this build has the structure of a layout.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no generated code in this build has the structure of layout `{layout}` ({structure}); there is code for: \
     {available}{nearest}.\n{mend}"
)]
pub struct NoModel {
    /// The layout's name.
    pub layout: String,
    /// Its structure in words.
    pub structure: String,
    /// The names of the generated structures.
    pub available: String,
    /// The differences from the nearest of them, as keys and values; empty where arms or links differ.
    pub nearest: String,
    /// How to get generated code.
    pub mend: String,
}

/// The generated model of the layout's structure (arms, links, structural zeros), with the layout's numbers.
///
/// # Errors
/// [`NoModel`] where no generated code has that structure.
pub fn generated(layout: &Layout) -> Result<Box<dyn CloneModel>, NoModel> {
    fitting(layout).map(|(candidate, values)| (candidate.build)(values))
}

/// The manifest of the generated code of the layout's structure.
///
/// # Errors
/// As [`fn@generated`].
pub fn manifest(layout: &Layout) -> Result<&'static Manifest, NoModel> {
    fitting(layout).map(|(candidate, _)| candidate.manifest)
}

/// The generated structure with the fewest parameters that the layout fits, and their values.
fn fitting(layout: &Layout) -> Result<(&'static Candidate, Vec<f64>), NoModel> {
    let mut fitting: Option<(&'static Candidate, Vec<f64>)> = None;
    let mut nearest: Option<(&str, Vec<StructuralDifference>)> = None;
    for candidate in CANDIDATES {
        match parameters(&candidate.manifest.into(), layout) {
            Ok(values) if fitting.as_ref().is_none_or(|(_, best)| values.len() < best.len()) => {
                fitting = Some((candidate, values));
            }
            Err(Mismatch::Zeros(found)) if nearest.as_ref().is_none_or(|(_, best)| found.len() < best.len()) => {
                nearest = Some((candidate.manifest.name, found));
            }
            Ok(_) | Err(_) => {}
        }
    }
    fitting.ok_or_else(|| NoModel {
        layout: layout.name.clone(),
        structure: in_words(layout),
        available: CANDIDATES.iter().map(|c| c.manifest.name).collect::<Vec<_>>().join(", "),
        nearest: nearest.map_or_else(String::new, |(name, found)| {
            let found: Vec<String> = found.iter().map(ToString::to_string).collect();
            format!(". Nearest is `{name}`: {}", found.join("; "))
        }),
        mend: mend(layout),
    })
}

/// The generic model of any layout.
#[must_use]
pub fn generic(layout: &Layout) -> Box<dyn CloneModel> {
    Box::new(Generic::new(layout))
}

/// How to get generated code of a layout.
fn mend(layout: &Layout) -> String {
    let others = "without `--dynamics generated` it is computed by its graph or the generic implementation, and \
                  `planar-capture generate` writes code of it for a program of your own";
    let is_shipped = |(name, text): &&(&str, &str)| {
        DISABLED.contains(name) && Layout::parse(text, name).is_ok_and(|shipped| shipped.sha256() == layout.sha256())
    };
    match SHIPPED.iter().find(is_shipped) {
        Some((name, _)) => {
            format!("It is shipped, but left out of this build: build again with `--features {name}`; {others}")
        }
        None => format!("To be computed now: {others}"),
    }
}
