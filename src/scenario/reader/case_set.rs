//! `set` of a `[[case]]`: other values at keys of scenario and layout.

use crate::diagnostic::{Table, Value, every};
use crate::format::Step;
use crate::scenario::variation::{KeyPath, Refused, Unusable, Variation, VariedValue};
use crate::scenario::{KeyFile, LawFormats, Scenario, ScenarioSource, Variant};

/// What a case sets, and where.
pub(super) struct CaseSet<'a> {
    /// Of its `[[case]]` in the file.
    pub(super) index: usize,
    value: Value<'a>,
    entries: Vec<Entry<'a>>,
}

struct Entry<'a> {
    value: Value<'a>,
    path: KeyPath,
    varied: VariedValue,
}

/// The `set` of a case; `Some(None)` where it has none.
#[allow(clippy::option_option, reason = "None where it is invalid, Some(None) where it is not given")]
pub(super) fn case_set<'a>(table: &Table<'a>, index: usize) -> Option<Option<CaseSet<'a>>> {
    let Some(value) = table.get("set") else { return Some(None) };
    let entries = every(value.entries()?.into_iter().map(|(key, value)| entry(&key, value)))?;
    if entries.is_empty() {
        value.reject("it sets nothing, expected at least one key, or no `set`");
        return None;
    }
    Some(Some(CaseSet { index, value, entries }))
}

fn entry<'a>(key: &str, value: Value<'a>) -> Option<Entry<'a>> {
    let path = match KeyPath::parse(key) {
        Ok(path) => path,
        Err(why) => {
            let nested =
                if value.is_table() { "; a path is one key, in quotes: `\"approach.duration\" = 12.0`" } else { "" };
            value.reject(&format!("{why}{nested}"));
            return None;
        }
    };
    if path.file == KeyFile::Scenario && path.steps.first() == Some(&Step::Key("case".to_owned())) {
        value.reject("a case sets keys of the scenario and its layout; what is a case's own stands beside `set`");
        return None;
    }
    let varied = match (value.as_str(), value.as_bool()) {
        (Some(text), _) => VariedValue::Text(text.to_owned()),
        (_, Some(flag)) => VariedValue::Flag(flag),
        _ => VariedValue::Number(value.number()?),
    };
    Some(Entry { value, path, varied })
}

impl CaseSet<'_> {
    /// The scenario of the case; `None` where its values are not valid.
    pub(super) fn variant(&self, scenario: &Scenario, source: &ScenarioSource, laws: &LawFormats) -> Option<Variant> {
        let case = &scenario.cases[self.index].name;
        let keys: Vec<_> = self.entries.iter().map(|entry| (entry.path.clone(), entry.varied.clone())).collect();
        let (mut scenario, texts) = match Variation::apply(scenario, source, case, laws, &keys) {
            Ok(applied) => applied,
            Err(refused) => {
                match refused {
                    Refused::Keys(keys) => {
                        for Unusable { key, why } in keys {
                            self.entries[key].value.reject(&why);
                        }
                    }
                    Refused::Together(why) => self.value.reject(&format!("together, {why}")),
                    // that is said where it stands
                    Refused::Without(_) => {}
                }
                return None;
            }
        };
        scenario.cases[0].index = self.index;
        let set = keys.into_iter().map(|(path, value)| (path.to_string(), value)).collect();
        Some(Variant { set, scenario, texts: [texts.scenario, texts.layout] })
    }
}
