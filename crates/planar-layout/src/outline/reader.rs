//! Reads and writes the `outline` of a base or link.

use super::{FORMAT, Outline};
use crate::diagnostic::{Table, Value, every};
use crate::format::With;

const EXPECTED: &str = "one of `disc` (a radius in m), `box` (two sides in m), `capsule` (a radius in m, 0 for a segment) \
                        and `polygon` (a list of corners [x, y] in m)";

/// The body that an outline is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// A base.
    Base,
    /// A link of this length, m; `None` where that is refused, which is said at its own key.
    Link(Option<f64>),
}

/// The outline of a body.
///
/// `disc` and `box` take a `center` (default: the base's COM, the middle of the link), `box` an `angle`, `capsule` its
/// `ends` (default: the joint and the end of the link).
#[must_use]
pub fn outline(value: &Value<'_>, body: Body) -> Option<Outline> {
    let table = value.table()?;
    let given: Vec<&str> = FORMAT.one_of.iter().copied().filter(|kind| table.get(kind).is_some()).collect();
    // that was said of the misspelling
    if given.is_empty() && FORMAT.one_of.iter().any(|kind| table.is_misspelt(kind)) {
        return None;
    }
    let [kind] = given[..] else {
        value.reject(&format!("found {} of them, expected {EXPECTED}", given.len()));
        return None;
    };
    let is_for_others = |with| matches!(with, Some(With::Key(kinds)) if !kinds.contains(&kind));
    let others = FORMAT.keys.iter().filter(|key| is_for_others(key.with)).map(|key| key.name);
    let others: Vec<_> = others.filter_map(|key| table.get(key)).collect();
    for other in &others {
        other.reject(&format!("`{kind}` takes no such key, expected {EXPECTED}"));
    }
    if !others.is_empty() {
        return None;
    }
    let middle = match body {
        Body::Link(Some(length)) => length / 2.0,
        Body::Link(None) | Body::Base => 0.0,
    };
    let center = table.read_or("center", [middle, 0.0], Value::vector);
    match kind {
        "disc" => Some(Outline::Disc { center: center?, radius: table.number("disc")? }),
        "box" => {
            let size = table.vector("box");
            let angle = table.number("angle");
            // sides far smaller than the rest have no corners of their own in double precision
            let corners = Outline::rectangle(center?, size?, angle?).corners();
            Outline::polygon(corners).map_err(|why| value.reject(&why.to_string())).ok()
        }
        "capsule" => {
            let radius = table.number("capsule");
            let ends = ends(&table, body);
            Some(Outline::Capsule { ends: ends?, radius: radius? })
        }
        _ => {
            let value = table.require("polygon")?;
            let corners = every(value.items("a list of corners [x, y] in m")?.iter().map(Value::vector))?;
            Outline::polygon(corners).map_err(|why| value.reject(&why.to_string())).ok()
        }
    }
}

fn ends(table: &Table<'_>, body: Body) -> Option<[[f64; 2]; 2]> {
    const ENDS: &str = "the two ends of the segment, [[x, y], [x, y]] in m";
    let value = match (table.get("ends"), body) {
        (Some(value), _) => value,
        (None, Body::Link(length)) => return length.map(|length| [[0.0, 0.0], [length, 0.0]]),
        (None, Body::Base) => table.require_as("ends", ENDS)?,
    };
    let items = every(value.items(ENDS)?.iter().map(Value::vector))?;
    let ends = <[[f64; 2]; 2]>::try_from(items);
    ends.map_err(|items| value.reject(&format!("found {} points, expected {ENDS}", items.len()))).ok()
}

impl Outline {
    /// The value of the key `outline` from which it reads the same.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let point = |[x, y]: &[f64; 2]| toml::Value::from(vec![*x, *y]).to_string();
        let points = |points: &[[f64; 2]]| points.iter().map(point).collect::<Vec<_>>().join(", ");
        let number = |number: &f64| toml::Value::from(*number);
        match self {
            Self::Disc { center, radius } => format!("{{ disc = {}, center = {} }}", number(radius), point(center)),
            Self::Capsule { ends, radius } => format!("{{ capsule = {}, ends = [{}] }}", number(radius), points(ends)),
            Self::Polygon { corners } => format!("{{ polygon = [{}] }}", points(corners)),
        }
    }
}
