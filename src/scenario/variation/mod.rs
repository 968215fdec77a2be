//! The texts of scenario and layout with other values at some keys: written once with places for these, filled for every
//! case, and read by the same readers as files.
//!
//! # Example
//! ```
//! use planar_capture::registry::SHIPPED;
//! use planar_capture::scenario::Scenario;
//! use planar_capture::scenario::variation::{KeyPath, Variation, VariedValue::Number};
//!
//! let file = "scenarios/redysim_single_arm_3r.toml";
//! let (scenario, source) = Scenario::read_with_source(file.as_ref(), SHIPPED)?;
//! let keys = [(KeyPath::parse("layout.base.mass")?, Number(500.0))];
//! let variation = Variation::new(&scenario, &source, &scenario.name, &keys).map_err(|unusable| unusable.why)?;
//! let heavier = variation.scenario(&[Number(620.0)])?;
//! assert_eq!(heavier.layout.mass() - scenario.layout.mass(), 120.0); // kg
//! assert_eq!(heavier.approach, scenario.approach);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod key_path;
mod key_place;
mod refused;
mod replaced;
mod varied_value;

use crate::diagnostic::Report;
use crate::format::Step;
use crate::layout::Layout;
use crate::scenario::{KeyFile, Known, LawFormats, Scenario, ScenarioSource};
use key_place::{Place, place, set};
use replaced::replaced;
use std::ops::Range;
use std::path::Path;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

pub use key_path::KeyPath;
pub use refused::Refused;
pub use varied_value::VariedValue;

/// The name of the file that a case's scenario names as its layout.
pub const LAYOUT_FILE: &str = "layout.toml";

/// A scenario of one case, and which of its values vary.
#[derive(Clone, Debug)]
pub struct Variation {
    scenario: Template,
    layout: Template,
    layout_name: String,
    laws: LawFormats,
}

/// The texts of one case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseTexts {
    /// TOML of the scenario.
    pub scenario: String,
    /// TOML of its layout.
    pub layout: String,
}

/// A key that cannot vary.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unusable {
    /// Its index.
    pub key: usize,
    /// The reason.
    pub why: String,
}

impl Variation {
    /// Of a scenario, the texts that it was read from, and the keys with values that they may have. Only the case of this
    /// name stays.
    ///
    /// # Errors
    /// The first key that names nothing, or what the case replaces.
    ///
    /// # Panics
    /// Where the texts are not those of the scenario.
    pub fn new(
        scenario: &Scenario,
        source: &ScenarioSource,
        case: &str,
        keys: &[(KeyPath, VariedValue)],
    ) -> Result<Self, Unusable> {
        let tree = |text: &str| -> Table {
            text.strip_prefix('\u{feff}').unwrap_or(text).parse().expect("a text that was read before")
        };
        let (mut of_scenario, mut of_layout) = (tree(&source.scenario.text), tree(&source.layout.text));
        of_scenario.insert("layout".to_owned(), scenario.layout.name.as_str().into());
        if let Some(Value::Array(cases)) = of_scenario.get_mut("case") {
            cases.retain(|table| table.get("name").and_then(Value::as_str) == Some(case));
            // the values are in the keys
            cases.iter_mut().filter_map(Value::as_table_mut).for_each(|table| drop(table.remove("set")));
        }
        let mut places: Vec<(KeyFile, Place)> = Vec::new();
        for (key, (path, value)) in keys.iter().enumerate() {
            let refused = |why| Unusable { key, why };
            let tree = match path.file {
                KeyFile::Scenario => &mut of_scenario,
                KeyFile::Layout => &mut of_layout,
            };
            let place = place(tree, path, scenario).map_err(refused)?;
            let overlaps = |(file, other): &(KeyFile, Place)| {
                *file == path.file && (other.starts_with(&place) || place.starts_with(other))
            };
            if let Some(other) = places.iter().position(overlaps) {
                let (whole, is_same) = (&keys[other].0, places[other].1 == place);
                let why = if is_same {
                    "it varies already, there is one `vary` for a key".to_owned()
                } else {
                    format!("it is part of `{whole}`, which varies, too")
                };
                return Err(refused(why));
            }
            set(tree, &place, value.to_toml());
            places.push((path.file, place));
        }
        for (key, (path, _)) in keys.iter().enumerate() {
            if let Some(own) = replaced(path, &of_scenario) {
                let why = format!("it has no effect: the case `{case}` has a value of its own, `{own}`");
                return Err(Unusable { key, why });
            }
        }
        let of = |wanted: KeyFile, tree: &Table| {
            let of_tree = places.iter().enumerate().filter(|(_, (file, _))| *file == wanted);
            Template::new(tree, of_tree.map(|(key, (_, place))| (key, place)))
        };
        // a layout that does not vary keeps its text
        let layout = if places.iter().any(|(file, _)| *file == KeyFile::Layout) {
            of(KeyFile::Layout, &of_layout)
        } else {
            Template { text: source.layout.text.clone(), places: Vec::new() }
        };
        Ok(Self {
            scenario: of(KeyFile::Scenario, &of_scenario),
            layout,
            layout_name: scenario.layout.name.clone(),
            laws: LawFormats::default(),
        })
    }

    /// With control laws that the scenario may name beside the shipped ones.
    #[must_use]
    pub fn with_laws(self, laws: &LawFormats) -> Self {
        Self { laws: laws.clone(), ..self }
    }

    /// The scenario of a case with these values, one per key.
    ///
    /// # Errors
    /// What the readers of scenarios and layouts refuse.
    pub fn scenario(&self, values: &[VariedValue]) -> Result<Scenario, Report> {
        let [scenario, layout] = [&self.scenario, &self.layout].map(|template| template.fill(values));
        let known = Known { layouts: vec![(&self.layout_name, &layout)], laws: self.laws.clone() };
        Scenario::parse(&scenario, "scenario.toml", Path::new(""), known)
    }

    /// Texts for files of a case, the scenario naming its layout by [`LAYOUT_FILE`].
    ///
    /// # Panics
    /// Never: a scenario's text has a tree.
    #[must_use]
    pub fn texts(&self, values: &[VariedValue]) -> CaseTexts {
        let scenario = self.scenario.fill(values);
        let mut tree: Table = scenario.parse().expect("a text of this program");
        tree.insert("layout".to_owned(), format!("./{LAYOUT_FILE}").into());
        CaseTexts { scenario: text_of(&tree), layout: self.layout.fill(values) }
    }

    /// Whether values of the layout vary.
    #[must_use]
    pub fn varies_layout(&self) -> bool {
        !self.layout.places.is_empty()
    }

    /// The layout with these values.
    ///
    /// # Errors
    /// What the reader of layouts refuses.
    pub fn layout(&self, values: &[VariedValue]) -> Result<Layout, Report> {
        Layout::parse(&self.layout.fill(values), LAYOUT_FILE)
    }
}

/// A text with places for values.
#[derive(Clone, Debug)]
struct Template {
    text: String,
    /// In order, with the indices of their keys.
    places: Vec<(Range<usize>, usize)>,
}

impl Template {
    fn new<'p>(tree: &Table, places: impl Iterator<Item = (usize, &'p Place)>) -> Self {
        let text = text_of(tree);
        let (parsed, _) = DeTable::parse_recoverable(&text);
        let mut places: Vec<_> = places.map(|(key, place)| (span(parsed.get_ref(), place), key)).collect();
        places.sort_by_key(|(span, _)| span.start);
        drop(parsed);
        Self { text, places }
    }

    fn fill(&self, values: &[VariedValue]) -> String {
        let mut filled = String::with_capacity(self.text.len() + 16 * self.places.len());
        let mut from = 0;
        for (span, key) in &self.places {
            filled.push_str(&self.text[from..span.start]);
            filled.push_str(&values[*key].to_string());
            from = span.end;
        }
        filled.push_str(&self.text[from..]);
        filled
    }
}

fn text_of(tree: &Table) -> String {
    toml::to_string(tree).expect("a tree of TOML has a text")
}

/// Where the value at a place is in the text.
fn span(root: &DeTable<'_>, place: &Place) -> Range<usize> {
    let mut found: Option<&Spanned<DeValue<'_>>> = None;
    for step in place {
        found = match (found.map(Spanned::get_ref), step) {
            (None, Step::Key(name)) => root.get(name.as_str()),
            (Some(DeValue::Table(table)), Step::Key(name)) => table.get(name.as_str()),
            (Some(DeValue::Array(items)), Step::Index(index)) => items.get(*index),
            _ => None,
        };
    }
    found.expect("a place in the tree that the text was written from").span()
}
