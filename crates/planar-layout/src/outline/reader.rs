//! Reads and writes the `outline` of a base or link.

use super::Outline;
use crate::diagnostic::{NumberRule, Table, Value, every};

const RADIUS: NumberRule = NumberRule::positive("a radius", "m").not_millimetres(1e4);
const CAPSULE_RADIUS: NumberRule = NumberRule::non_negative("a radius", "m").not_millimetres(1e4);
const SIDE: NumberRule = NumberRule::positive("a side", "m").not_millimetres(1e4);
const ANGLE: NumberRule = NumberRule::any("an angle", "rad").not_degrees(std::f64::consts::TAU);
const POINT: [NumberRule; 2] =
    [NumberRule::any("x", "m").not_millimetres(1e4), NumberRule::any("y", "m").not_millimetres(1e4)];

const EXPECTED: &str = "one of `disc` (a radius in m), `box` (two sides in m), `capsule` (a radius in m, 0 for a segment) \
                        and `polygon` (a list of corners [x, y] in m)";

/// The outline of a base, or of a link of this length (m).
///
/// `disc` and `box` take a `center` (default: the base's COM, the middle of the link), `box` an `angle`, `capsule` its
/// `ends` (default: the joint and the end of the link).
#[must_use]
pub fn outline(value: &Value<'_>, length: Option<f64>) -> Option<Outline> {
    let table = value.table(&["disc", "box", "capsule", "polygon", "center", "angle", "ends"])?;
    let kinds = ["disc", "box", "capsule", "polygon"];
    let given: Vec<&str> = kinds.into_iter().filter(|kind| table.get(kind).is_some()).collect();
    let [kind] = given[..] else {
        value.reject(&format!("found {} of them, expected {EXPECTED}", given.len()));
        return None;
    };
    let with: &[&str] = match kind {
        "disc" => &["center"],
        "box" => &["center", "angle"],
        "capsule" => &["ends"],
        _ => &[],
    };
    let others = ["center", "angle", "ends"].into_iter().filter(|key| !with.contains(key));
    let others: Vec<_> = others.filter_map(|key| table.get(key)).collect();
    for other in &others {
        other.reject(&format!("`{kind}` takes no such key, expected {EXPECTED}"));
    }
    if !others.is_empty() {
        return None;
    }
    let center = table.vector_or("center", &POINT, [length.unwrap_or(0.0) / 2.0, 0.0]);
    match kind {
        "disc" => Some(Outline::Disc { center: center?, radius: table.number("disc", &RADIUS)? }),
        "box" => {
            let size = table.vector("box", &[SIDE; 2]);
            let angle = table.number_or("angle", &ANGLE, 0.0);
            // sides far smaller than the rest have no corners of their own in double precision
            let corners = Outline::rectangle(center?, size?, angle?).corners();
            Outline::polygon(corners).map_err(|why| value.reject(&why.to_string())).ok()
        }
        "capsule" => {
            let radius = table.number("capsule", &CAPSULE_RADIUS);
            let ends = ends(&table, length);
            Some(Outline::Capsule { ends: ends?, radius: radius? })
        }
        _ => {
            let value = table.require("polygon", "a list of corners [x, y] in m")?;
            let corners = every(value.items("a list of corners [x, y] in m")?.iter().map(|item| item.vector(&POINT)))?;
            Outline::polygon(corners).map_err(|why| value.reject(&why.to_string())).ok()
        }
    }
}

fn ends(table: &Table<'_>, length: Option<f64>) -> Option<[[f64; 2]; 2]> {
    const ENDS: &str = "the two ends of the segment, [[x, y], [x, y]] in m";
    let value = match (table.get("ends"), length) {
        (Some(value), _) => value,
        (None, Some(length)) => return Some([[0.0, 0.0], [length, 0.0]]),
        (None, None) => table.require("ends", ENDS)?,
    };
    let items = every(value.items(ENDS)?.iter().map(|item| item.vector(&POINT)))?;
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
