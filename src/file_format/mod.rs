//! The files that people write, layouts, scenarios and sweeps, as their tables of keys describe them: a reference in Markdown, a
//! JSON Schema for editors, and a commented file to start from.
//!
//! It never contains: a key.
//!
//! # Example
//! ```
//! use planar_capture::file_format::FileFormat;
//! use planar_capture::layout::Layout;
//!
//! let layout = Layout::parse(&FileFormat::Layout.template(), "template.toml")?;
//! let schema: serde_json::Value = serde_json::from_str(&FileFormat::Layout.schema())?;
//! assert_eq!(schema["required"], serde_json::json!(["name", "base", "arm"]));
//! // what is not required has a default: a link's centre of mass is in its middle
//! let link = &layout.arms[0].links[0];
//! assert_eq!(link.com, [0.5 * link.length, 0.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod json_schema;
mod reference;
mod template;

#[cfg(feature = "sweep")]
use crate::campaign;
use crate::diagnostic::listing;
use crate::format::{Key, NumberRule, Shape, TableFormat, With, units};
use crate::{layout, scenario};

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// A robot.
    Layout,
    /// A study.
    Scenario,
    /// A study many times.
    #[cfg(feature = "sweep")]
    Sweep,
}

impl FileFormat {
    /// All of them.
    pub const ALL: &[Self] = &[
        Self::Layout,
        Self::Scenario,
        #[cfg(feature = "sweep")]
        Self::Sweep,
    ];

    /// Its name: `layout`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Layout => "layout",
            Self::Scenario => "scenario",
            #[cfg(feature = "sweep")]
            Self::Sweep => "sweep",
        }
    }

    /// Its keys.
    #[must_use]
    pub fn table(self) -> &'static TableFormat {
        match self {
            Self::Layout => &layout::FORMAT,
            Self::Scenario => &scenario::FORMAT,
            #[cfg(feature = "sweep")]
            Self::Sweep => &campaign::FORMAT,
        }
    }

    /// The reference of its keys, in Markdown.
    #[must_use]
    pub fn reference(self) -> String {
        reference::page(self)
    }

    /// Its JSON Schema, draft 7, with the extensions of Taplo.
    #[must_use]
    pub fn schema(self) -> String {
        json_schema::schema(self)
    }

    /// A valid file to start from.
    #[must_use]
    pub fn template(self) -> String {
        template::template(self)
    }
}

/// The condition of a key in words: "with `tracking = "pd"`".
fn condition(key: &Key) -> Option<String> {
    Some(match key.with? {
        With::Choice(selector, [first, rest @ ..]) => {
            let names =
                [format!("{selector} = \"{first}\"")].into_iter().chain(rest.iter().map(|name| format!("\"{name}\"")));
            let names: Vec<_> = names.collect();
            format!("with {}", listing(&names.iter().map(String::as_str).collect::<Vec<_>>(), "or"))
        }
        With::Choice(..) => return None,
        With::Key(keys) => format!("beside {}", listing(keys, "or")),
    })
}

/// The unit of a value, that of each component where they differ; empty where it has none.
fn unit(shape: &Shape) -> String {
    match shape {
        Shape::Number(rule) | Shape::NumberOrNone(rule) => rule.unit().to_owned(),
        Shape::Vector(components) => units(components),
        Shape::OneOf([longest, ..]) => units(longest),
        Shape::List(item, _) | Shape::OneOrList(item, _) | Shape::ByName(item, _) => unit(item),
        _ => String::new(),
    }
}

/// Unit, condition and default of a key in words, as far as there are any.
fn about(key: &Key) -> String {
    let unit = Some(unit(&key.shape)).filter(|unit| !unit.is_empty()).map(|unit| format!("in {unit}"));
    // some keys must be given unless there is another one
    let default =
        default(key).map(|words| if words.starts_with("required") { words } else { format!("default: {words}") });
    [unit, condition(key), default].into_iter().flatten().collect::<Vec<_>>().join("; ")
}

/// The default of a key as in a file, or in words; `None` where there is none.
fn default(key: &Key) -> Option<String> {
    use crate::format::Default;
    Some(match key.default {
        Default::Required | Default::Nothing => return None,
        Default::Number(number) if key.shape.rule().is_some_and(NumberRule::is_whole) => number.to_string(),
        Default::Number(number) => format!("{number:?}"),
        Default::Choice(name) => format!("\"{name}\""),
        Default::Zeros => "zeros".to_owned(),
        Default::Words(words) => words.to_owned(),
    })
}
