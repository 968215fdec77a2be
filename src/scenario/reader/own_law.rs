//! `[approach.law]` and `[post_impact.law]`: the numbers of a law that the program has of its own.

use crate::diagnostic::{Table, every};
use crate::scenario::{LawFormat, LawNumbers};

/// The numbers of the law of a phase that has this name among `laws`, given in its table `law` of this path, or default.
pub(super) fn law_numbers(phase: &Table<'_>, path: &str, name: &str, laws: &[LawFormat]) -> Option<LawNumbers> {
    let law = laws.iter().find(|known| known.name == name)?;
    let names: Vec<_> = law.numbers.iter().map(|number| number.key).collect();
    let table = match phase.get("law") {
        Some(value) => Some(value.by_name(&names)?),
        None => None,
    };
    let numbers = every(law.numbers.iter().map(|number| {
        let given = table.as_ref().and_then(|table| table.get(number.key));
        let number_of = match (given, number.default) {
            (Some(value), _) => value.number_by(&number.rule)?,
            (None, Some(default)) => default,
            (None, None) => {
                // a misspelling of it is reported as such
                if !table.as_ref().is_some_and(|table| table.is_misspelt(number.key)) {
                    let (key, rule) = (number.key, &number.rule);
                    let message = format!("missing key `{path}.{key}` of the law `{}`, expected {rule}", law.name);
                    phase.reject(&message, "it belongs into its table `law`");
                }
                return None;
            }
        };
        Some((number.key, number_of))
    }))?;
    Some(LawNumbers(numbers))
}
