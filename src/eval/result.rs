//! The values of the shown rows of the table of quantities as JSON.

use crate::evaluation::Values;
use crate::quantity::Quantity;
use crate::target::Target;
use serde_json::{Map, Value, json};

/// Quantities by name, `impact.G` as `G` in a block `impact`; matrices are nested rows, and an arm without target is
/// `null`. A block without values is absent.
#[must_use]
pub fn result_to_json(values: &Values, targets: &[Option<Target<f64>>]) -> Value {
    let mut result = Map::new();
    let mut shown: Vec<_> = Quantity::ALL.iter().filter(|quantity| quantity.row().shown.is_some()).collect();
    shown.sort_by_key(|quantity| quantity.row().shown);
    for quantity in shown {
        let Some(entries) = values.get(*quantity) else { continue };
        let mut value = nested(entries, &values.shape(*quantity));
        if let (Quantity::CaptureTargetTwists | Quantity::CaptureImpulses, Value::Array(arms)) = (quantity, &mut value)
        {
            let free = arms.iter_mut().zip(targets).filter(|(_, target)| target.is_none());
            free.for_each(|(arm, _)| *arm = Value::Null);
        }
        let name = quantity.row().name;
        match name.split_once('.') {
            Some((block, name)) => {
                let block = result.entry(block).or_insert_with(|| json!({}));
                block[name] = value;
            }
            None => {
                result.insert(name.to_owned(), value);
            }
        }
    }
    Value::Object(result)
}

/// Nested lists of this shape; a number for the empty shape.
fn nested(entries: &[f64], shape: &[usize]) -> Value {
    match shape {
        [] => json!(entries.first()),
        [_] => json!(entries),
        [_, inner @ ..] => {
            let part = inner.iter().product::<usize>().max(1);
            entries.chunks_exact(part).map(|row| nested(row, inner)).collect()
        }
    }
}
