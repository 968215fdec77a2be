//! The model of a layout: generated code of its structure, with the layout's numbers as parameters, or the generic
//! implementation.
//!
//! # Example
//! ```
//! use planar_capture::layout::Layout;
//! use planar_capture::registry::{GENERATED, generated};
//! use planar_capture::state::State;
//!
//! let mut layout = Layout::read("codegen/layouts/dual_arm_3r.toml".as_ref())?;
//! layout.base.mass = 600.0; // kg; the code is that of the structure
//! assert!(GENERATED.contains(&"dual_arm_3r"));
//! let still = [0.0; 6];
//! let state = State { base_pose: [0.0; 3], joint_angles: &still, base_twist: [0.0, 0.1, 0.0], joint_rates: &still };
//! let momentum = generated(&layout)?.momentum(&state)?;
//! assert!((momentum.linear_momentum[0] - 66.0).abs() < 1e-12); // 660 kg at 0.1 m/s
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[allow(unused_imports, reason = "a build may be without any layout")]
use crate::generated;
use crate::generic::Generic;
use crate::layout::Layout;
use crate::manifest::Manifest;
use crate::owned::CloneModel;
use crate::structure::{Mismatch, StructuralDifference, in_words, parameters};

/// Generated code of a structure that is compiled into the program.
#[derive(Clone, Copy, Debug)]
pub struct CompiledCode {
    /// Its description.
    pub manifest: &'static Manifest,
    /// Its model with given values of the parameters, one for each of the manifest.
    pub model: fn(Vec<f64>) -> Box<dyn CloneModel>,
}

/// A robot that a program has beside the shipped ones; [`robot!`](crate::robot) makes one of a rendered module.
#[derive(Clone, Copy, Debug)]
pub struct CompiledRobot {
    /// The name of its layout, by which arguments and scenarios find it.
    pub name: &'static str,
    /// The TOML text of its layout.
    pub layout: &'static str,
    /// The code of its structure.
    pub code: CompiledCode,
}

/// The [`CompiledRobot`](crate::registry::CompiledRobot) of a module that
/// [`include_layout!`](crate::include_layout) has included.
///
/// ```ignore
/// planar_capture::include_layout!("my_robot");
///
/// fn main() -> std::process::ExitCode {
///     planar_capture::cli::main_with(&[planar_capture::robot!(my_robot)])
/// }
/// ```
#[macro_export]
macro_rules! robot {
    ($name:ident) => {
        $crate::registry::CompiledRobot {
            name: ::core::stringify!($name),
            layout: ::core::include_str!(::core::concat!(
                ::core::env!("OUT_DIR"),
                "/",
                ::core::stringify!($name),
                ".layout"
            )),
            code: $crate::compiled_code!($name),
        }
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! compiled_code {
    ($($module:ident)::+) => {
        $crate::registry::CompiledCode {
            manifest: &$($module)::+::MANIFEST,
            model: |values| {
                let values = values.try_into().expect("one value per parameter");
                ::std::boxed::Box::new($($module)::+::Model::new($($module)::+::Parameters::from_array(values)))
            },
        }
    };
}

macro_rules! registry {
    (enabled: [$($name:ident),*], disabled: [$($other:ident),*]) => {
        /// (name, TOML text) of every layout that is shipped.
        pub const SHIPPED: &[(&str, &str)] = &[$(shipped!($name),)* $(shipped!($other),)*];

        /// Names of the shipped layouts whose generated code this build has.
        pub const GENERATED: &[&str] = &[$(stringify!($name)),*];

        /// Shipped layouts whose generated code this build was made without: cargo features to be switched on.
        const DISABLED: &[&str] = &[$(stringify!($other)),*];

        const COMPILED: &[CompiledCode] = &[$(crate::compiled_code!(generated::$name)),*];
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

/// The robots that a program knows by name and has code for: its own, and the shipped ones.
#[derive(Clone, Copy, Debug, Default)]
pub struct Robots<'a> {
    own: &'a [CompiledRobot],
}

impl<'a> Robots<'a> {
    /// The shipped ones alone.
    pub const SHIPPED: Self = Self { own: &[] };

    /// The program's own come before shipped ones of the same name or structure.
    #[must_use]
    pub fn with(own: &'a [CompiledRobot]) -> Self {
        Self { own }
    }

    /// (name, TOML text) of every layout that is known by name.
    #[must_use]
    pub fn layouts(self) -> Vec<(&'static str, &'static str)> {
        self.own.iter().map(|robot| (robot.name, robot.layout)).chain(SHIPPED.iter().copied()).collect()
    }

    /// The compiled code of the layout's structure (arms, links, structural zeros), of several that with the fewest
    /// parameters.
    ///
    /// # Errors
    /// [`NoModel`] where no compiled code has that structure.
    pub fn code(self, layout: &Layout) -> Result<CompiledCode, NoModel> {
        let mut fitting: Option<CompiledCode> = None;
        let mut nearest: Option<(&str, Vec<StructuralDifference>)> = None;
        let compiled = || self.own.iter().map(|robot| robot.code).chain(COMPILED.iter().copied());
        for code in compiled() {
            let count = code.manifest.parameters.len();
            match parameters(&code.manifest.into(), layout) {
                Ok(_) if fitting.is_none_or(|best| count < best.manifest.parameters.len()) => fitting = Some(code),
                Err(Mismatch::Zeros(found)) if nearest.as_ref().is_none_or(|(_, best)| found.len() < best.len()) => {
                    nearest = Some((code.manifest.name, found));
                }
                Ok(_) | Err(_) => {}
            }
        }
        fitting.ok_or_else(|| NoModel {
            layout: layout.name.clone(),
            structure: in_words(layout),
            available: compiled().map(|code| code.manifest.name).collect::<Vec<_>>().join(", "),
            nearest: nearest.map_or_else(String::new, |(name, found)| {
                let found: Vec<String> = found.iter().map(ToString::to_string).collect();
                format!(". Nearest is `{name}`: {}", found.join("; "))
            }),
            mend: mend(layout),
        })
    }
}

impl CompiledCode {
    /// The model with the layout's numbers; `None` for a layout of another structure.
    #[must_use]
    pub fn of(self, layout: &Layout) -> Option<Box<dyn CloneModel>> {
        parameters(&self.manifest.into(), layout).ok().map(self.model)
    }
}

/// The generated model of the layout's structure (arms, links, structural zeros), with the layout's numbers, by the code
/// of the shipped robots.
///
/// # Errors
/// [`NoModel`] where no generated code has that structure.
///
/// # Panics
/// Never: the code has the structure.
pub fn generated(layout: &Layout) -> Result<Box<dyn CloneModel>, NoModel> {
    let code = Robots::SHIPPED.code(layout)?;
    Ok(code.of(layout).expect("code of the layout's structure"))
}

/// The generic model of any layout.
#[must_use]
pub fn generic(layout: &Layout) -> Box<dyn CloneModel> {
    Box::new(Generic::new(layout))
}

/// How to get generated code of a layout.
fn mend(layout: &Layout) -> String {
    let others = "without `--dynamics generated` it is computed by its graph, where there is none by the generic implementation, and \
                  `planar-capture new DIR --layout LAYOUT` writes a program of your own with code of it";
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
