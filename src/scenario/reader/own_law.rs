//! `[approach.law]`: the numbers of a law that the program has of its own.

use crate::diagnostic::{Table, every};
use crate::scenario::{LawFormat, LawNumbers, Tracking};

/// The law with its numbers, given or default.
pub(super) fn own_law(approach: &Table<'_>, law: &LawFormat) -> Option<Tracking> {
    let names: Vec<_> = law.numbers.iter().map(|number| number.key).collect();
    let table = match approach.get("law") {
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
                    let message =
                        format!("missing key `approach.law.{key}` of the law `{}`, expected {rule}", law.name);
                    approach.reject(&message, "it belongs into its table `law`");
                }
                return None;
            }
        };
        Some((number.key, number_of))
    }))?;
    Some(Tracking::Own { name: law.name, numbers: LawNumbers(numbers) })
}
