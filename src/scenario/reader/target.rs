//! `[[target]]`: what the arms touch, and how.

use super::joints::check_length;
use super::{POSITION, TWIST};
use crate::contact::ContactKind;
use crate::diagnostic::{NumberRule, Table, Value, every, listing};
use crate::layout::Layout;
use crate::outline::Outline;
use crate::scenario::target::NONE;
use crate::scenario::{Detection, PlannedContact, Target};
use std::collections::HashSet;
use std::f64::consts::PI;

const MASS: NumberRule = NumberRule::positive("a mass", "kg");
const INERTIA: NumberRule = NumberRule::positive("a moment of inertia", "kg m²");
const RADIUS: NumberRule = NumberRule::positive("a radius", "m");
const YAW: NumberRule = NumberRule::any("a yaw", "rad").not_degrees(4.0 * PI);
const RESTITUTION: NumberRule = NumberRule::any("a restitution, 0 (nothing comes back) to 1 (all of it)", "");
const CONTACTS: &str = "[rx, ry] in m, or a list of those, one per arm";
const CONTACT: [NumberRule; 2] = [NumberRule::any("rx", "m"), NumberRule::any("ry", "m")];

pub(super) const NO_NORMAL: &str = "a bounce at the COM has no outward normal, expected a contact on the rim";

pub(super) const NO_BOUNCE: &str =
    "no contact of the target bounces, and what holds gives nothing back, expected `bounce` as a kind of it";

/// The kinds of contacts, and none: a grasp that fails.
fn kinds() -> Vec<(&'static str, Option<ContactKind>)> {
    let all = ContactKind::ALL.iter().map(|kind| (kind.name(), Some(*kind)));
    all.chain([(NONE, None)]).collect()
}

/// One kind for all touches, or a list of as many.
pub(super) fn contact_kinds(value: &Value<'_>, touches: Option<usize>) -> Option<Vec<Option<ContactKind>>> {
    let kinds = kinds();
    if !value.is_array() {
        let kind = value.choice(&kinds)?;
        return Some(vec![kind; touches.unwrap_or(1)]);
    }
    let names: Vec<_> = kinds.iter().map(|(name, _)| *name).collect();
    let wanted = for_each(touches, &listing(&names, "or"));
    let items = value.items(&wanted)?;
    check_length(value, items.len(), touches, &wanted)?;
    every(items.iter().map(|item| item.choice(&kinds)))
}

impl Target {
    pub(super) const KEYS: [&'static str; 12] = [
        "name",
        "arm",
        "mass",
        "inertia",
        "contact",
        "radius",
        "polygon",
        "kind",
        "restitution",
        "twist",
        "yaw",
        "position",
    ];

    pub(super) fn from_table(table: &Table<'_>, layout: Option<&Layout>, detection: Detection) -> Option<Self> {
        let name = table.text("name", "a name");
        let arms = table
            .require("arm", "the name of an arm of the layout, or a list of such names")
            .and_then(|value| arms(&value, layout?));
        let count = arms.as_ref().map(Vec::len);
        let contacts = contacts(table, count, detection);
        let kinds = match table.get("kind") {
            Some(value) => contact_kinds(&value, count),
            None => count.map(|count| vec![Some(ContactKind::Rigid); count]),
        };
        let mass = table.number("mass", &MASS);
        let inertia = table.number("inertia", &INERTIA);
        let surface = surface(table);
        let restitution = match table.get("restitution") {
            Some(value) => restitution(&value),
            None => Some(0.0),
        };
        let twist = table.vector_or("twist", &TWIST, [0.0; 3]);
        let yaw = table.number_or("yaw", &YAW, 0.0);
        let wanted = "[x, y] of its COM at the start in m, from where it flies to the contact";
        let position = match detection {
            Detection::Event => table.require("position", wanted).and_then(|value| value.vector(&POSITION)).map(Some),
            Detection::Time => table.get("position").map_or(Some(None), |value| value.vector(&POSITION).map(Some)),
        };
        let touches: Vec<_> = arms?
            .into_iter()
            .zip(contacts?)
            .zip(kinds?)
            .map(|((arm, contact), kind)| PlannedContact { arm, contact, kind })
            .collect();
        let surface = surface?;
        let target = Self {
            name: name?.to_owned(),
            touches,
            mass: mass?,
            inertia: inertia?,
            surface,
            restitution: restitution?,
            twist: twist?,
            yaw: yaw?,
            position: position?,
        };
        let kinds: Vec<_> = target.touches.iter().map(|touch| touch.kind).collect();
        if detection == Detection::Time && target.bounces_at_its_com(&kinds) {
            if let Some(value) = table.get("contact") {
                value.reject(NO_NORMAL);
            }
            return None;
        }
        Some(target)
    }
}

/// A restitution: no more than 1 comes back.
pub(super) fn restitution(value: &Value<'_>) -> Option<f64> {
    let restitution = value.number(&RESTITUTION)?;
    if !(0.0..=1.0).contains(&restitution) {
        value.expected(&RESTITUTION.to_string(), None);
        return None;
    }
    Some(restitution)
}

/// The indices of one arm or several.
fn arms(value: &Value<'_>, layout: &Layout) -> Option<Vec<usize>> {
    if !value.is_array() {
        return arm_index(value, layout).map(|arm| vec![arm]);
    }
    let items = value.items("the name of an arm, or a list of names")?;
    if items.is_empty() {
        value.reject("nobody touches the target, expected the names of one arm or more");
        return None;
    }
    let arms = every(items.iter().map(|item| arm_index(item, layout)))?;
    if arms.iter().collect::<HashSet<_>>().len() < arms.len() {
        value.reject("an arm touches a target once, expected different arms");
        return None;
    }
    Some(arms)
}

/// The index of the arm with that name.
fn arm_index(value: &Value<'_>, layout: &Layout) -> Option<usize> {
    let names: Vec<_> = layout.arms.iter().map(|arm| arm.name.as_str()).collect();
    let index = names.iter().position(|name| value.as_str() == Some(name));
    if index.is_none() {
        let help = format!("these are the arms of the layout `{}`", layout.name);
        value.expected_one_of(&names, Some(&help));
    }
    index
}

/// `contact`: one point, or one for each of several arms.
fn contacts(table: &Table<'_>, arms: Option<usize>, detection: Detection) -> Option<Vec<[f64; 2]>> {
    if detection == Detection::Event {
        if let Some(value) = table.get("contact") {
            value.reject("contacts are found where tip and surface meet (`contact.detection`), expected no such key");
            return None;
        }
        return arms.map(|arms| vec![[0.0; 2]; arms]);
    }
    let value = table.require("contact", CONTACTS)?;
    let items = value.items(CONTACTS)?;
    let wanted = for_each(arms, "a contact point [rx, ry] in m");
    if !items.iter().any(Value::is_array) && (arms == Some(1) || !items.is_empty()) {
        let contact = value.vector(&CONTACT)?;
        check_length(&value, 1, arms, &wanted)?;
        return Some(vec![contact]);
    }
    check_length(&value, items.len(), arms, &wanted)?;
    every(items.iter().map(|item| item.vector(&CONTACT)))
}

/// What is wanted in a list, and how often.
fn for_each(arms: Option<usize>, what: &str) -> String {
    match arms {
        Some(1) => format!("{what} for the one arm that touches it"),
        Some(arms) => format!("{what} for each of the {arms} arms that touch it"),
        None => format!("{what} for each arm that touches it"),
    }
}

/// `radius` or `polygon`.
fn surface(table: &Table<'_>) -> Option<Outline> {
    match (table.get("radius"), table.get("polygon")) {
        (None, None) => {
            // unless one of them is misspelt, which was said
            if !table.is_misspelt("polygon") {
                let _ = table.require("radius", &format!("{RADIUS}, or the corners of a `polygon` in its place"));
            }
            None
        }
        (Some(_), Some(polygon)) => {
            polygon.reject("`radius` is there too, expected one of the two");
            None
        }
        (Some(_), None) => table.number("radius", &RADIUS).map(|radius| Outline::Disc { radius }),
        (None, Some(value)) => {
            let items = value.items("a list of corners [x, y] in m, in the target's frame, COM at the origin")?;
            let corners = every(items.iter().map(|item| item.vector(&POSITION)))?;
            let surrounded = surrounded(&corners);
            let surface = Outline::polygon(corners).map_err(|why| value.reject(&why.to_string())).ok()?;
            if !surrounded {
                value.reject("the COM, from which corners are counted, is outside, expected corners around [0, 0]");
                return None;
            }
            Some(surface)
        }
    }
}

/// Whether the origin is inside the convex hull of some corners, as every COM is: from there the corners are all
/// around.
fn surrounded(corners: &[[f64; 2]]) -> bool {
    let mut directions: Vec<f64> =
        corners.iter().filter(|[x, y]| x.hypot(*y) > 0.0).map(|[x, y]| y.atan2(*x)).collect();
    directions.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (directions.first(), directions.last()) else { return false };
    let between = directions.windows(2).map(|pair| pair[1] - pair[0]);
    between.fold(first + 2.0 * PI - last, f64::max) < PI
}
