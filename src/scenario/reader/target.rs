//! `[[target]]`: the bodies that arms touch.

use super::joints::check_length;
use super::magnitude::{check_contact, check_distance, check_mass, check_size};
use crate::contact::ContactKind;
use crate::diagnostic::{Table, Value, every, listing};
use crate::layout::Layout;
use crate::outline::Outline;
use crate::scenario::{Detection, PlannedContact, Target, contact_name};
use std::collections::HashSet;
use std::f64::consts::PI;

const POINTS: &str = "[rx, ry] in m, or a list of those, one per arm";

pub(super) const NO_NORMAL: &str = "a bounce at the COM has no outward normal, expected a contact on the rim";

pub(super) const NO_BOUNCE: &str = "no contact of the target bounces, and rigid contacts and pins have no restitution, expected `bounce` as a kind of it";

pub(super) fn target(table: &Table<'_>, layout: Option<&Layout>, detection: Detection) -> Option<Target> {
    let name = table.text("name");
    let arms = table
        .require_as("arm", "the name of an arm of the layout, or a list of such names")
        .and_then(|value| arms(&value, layout?));
    let count = arms.as_ref().map(Vec::len);
    let points = contact_points(table, count, layout, detection);
    let kinds = match table.get("kind") {
        Some(value) => contact_kinds(&value, count),
        None => count.map(|count| vec![Some(ContactKind::Rigid); count]),
    };
    let mass = table.number("mass").filter(|mass| check_mass(table, "mass", *mass, layout));
    let inertia = table.number("inertia").filter(|inertia| check_mass(table, "inertia", *inertia, layout));
    let outline = outline(table).filter(|outline| check_size(table, outline, layout));
    let restitution = table.number("restitution");
    let twist = table.vector("twist");
    let yaw = table.number("yaw");
    let position = match detection {
        Detection::Event => {
            let expected = "[x, y] of its COM at the start in m, from which it moves freely";
            table.require_as("position", expected).and_then(|value| value.vector()).map(Some)
        }
        Detection::Time => table.read_or("position", None, |value| value.vector().map(Some)),
    };
    if let (Some(value), Some(Some(position))) = (table.get("position"), position) {
        check_distance(&value, position, layout);
    }
    let contacts = arms?.into_iter().zip(points?).zip(kinds?);
    let target = Target {
        name: name?.to_owned(),
        contacts: contacts.map(|((arm, point), kind)| PlannedContact { arm, point, kind }).collect(),
        mass: mass?,
        inertia: inertia?,
        outline: outline?,
        restitution: restitution?,
        twist: twist?,
        yaw: yaw?,
        position: position?,
    };
    let kinds: Vec<_> = target.contacts.iter().map(|contact| contact.kind).collect();
    if detection == Detection::Time && bounces_at_com(&target, &kinds) {
        if let Some(value) = table.get("contact") {
            value.reject(NO_NORMAL);
        }
        return None;
    }
    Some(target)
}

/// Whether one of the contacts, of these kinds, would bounce at the COM of a disc, where there is no outward normal.
pub(super) fn bounces_at_com(target: &Target, kinds: &[Option<ContactKind>]) -> bool {
    let mut contacts = target.contacts.iter().zip(kinds);
    let at_com = contacts
        .any(|(contact, kind)| kind.is_some_and(ContactKind::is_unilateral) && contact.point.iter().all(|x| *x == 0.0));
    at_com && matches!(target.outline, Outline::Disc { .. })
}

/// One kind for all contacts, or a list with one per contact.
pub(super) fn contact_kinds(value: &Value<'_>, count: Option<usize>) -> Option<Vec<Option<ContactKind>>> {
    let kinds = ContactKind::ALL.iter().copied().map(Some).chain([None]);
    let kinds: Vec<_> = kinds.map(|kind| (contact_name(kind), kind)).collect();
    if !value.is_array() {
        let kind = value.choice(&kinds)?;
        return Some(vec![kind; count.unwrap_or(1)]);
    }
    let names: Vec<_> = kinds.iter().map(|(name, _)| *name).collect();
    let expected = for_each(count, &listing(&names, "or"));
    let items = value.items(&expected)?;
    check_length(value, items.len(), count, &expected)?;
    every(items.iter().map(|item| item.choice(&kinds)))
}

/// The indices of one arm or several.
fn arms(value: &Value<'_>, layout: &Layout) -> Option<Vec<usize>> {
    if !value.is_array() {
        return arm_index(value, layout).map(|arm| vec![arm]);
    }
    let items = value.items("the name of an arm, or a list of names")?;
    if items.is_empty() {
        value.reject("no arm touches the target, expected the names of one arm or more");
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

/// `contact`: one point, or one for each of several arms; zeros where contacts are found by detection.
fn contact_points(
    table: &Table<'_>,
    arms: Option<usize>,
    layout: Option<&Layout>,
    detection: Detection,
) -> Option<Vec<[f64; 2]>> {
    if detection == Detection::Event {
        if let Some(value) = table.get("contact") {
            value.reject(
                "contacts are found where end effector and surface meet (`contact.detection`), expected no such key",
            );
            return None;
        }
        return arms.map(|arms| vec![[0.0; 2]; arms]);
    }
    let value = table.require_as("contact", POINTS)?;
    let items = value.items(POINTS)?;
    let expected = for_each(arms, "a contact point [rx, ry] in m");
    if !items.iter().any(Value::is_array) && (arms == Some(1) || !items.is_empty()) {
        let point = check_contact(&value, value.vector()?, layout)?;
        check_length(&value, 1, arms, &expected)?;
        return Some(vec![point]);
    }
    check_length(&value, items.len(), arms, &expected)?;
    every(items.iter().map(|item| check_contact(item, item.vector()?, layout)))
}

/// What a list holds, and for how many arms.
fn for_each(arms: Option<usize>, what: &str) -> String {
    match arms {
        Some(1) => format!("{what} for the one arm that touches it"),
        Some(arms) => format!("{what} for each of the {arms} arms that touch it"),
        None => format!("{what} for each arm that touches it"),
    }
}

/// `radius` or `polygon`.
fn outline(table: &Table<'_>) -> Option<Outline> {
    match (table.get("radius"), table.get("polygon")) {
        // a misspelt `polygon` is noted already
        (None, None) if table.is_misspelt("polygon") => None,
        (None, None) => {
            let expected = format!("{}, or the corners of a `polygon` in its place", table.wanted("radius"));
            table.require_as("radius", &expected).and(None)
        }
        (Some(_), Some(polygon)) => {
            polygon.reject("`radius` is there too, expected one of the two");
            None
        }
        (Some(value), None) => value.number().map(Outline::disc),
        (None, Some(value)) => {
            let items = value.items("a list of corners [x, y] in m, in the target's frame, COM at the origin")?;
            let corners = every(items.iter().map(Value::vector))?;
            let surround = surround_origin(&corners);
            let outline = Outline::polygon(corners).map_err(|why| value.reject(&why.to_string())).ok()?;
            if !surround {
                value.reject("the COM, from which corners are counted, is outside, expected corners around [0, 0]");
            }
            surround.then_some(outline)
        }
    }
}

/// Whether the origin is inside the convex hull of the corners, as every COM is: no half plane through it is empty.
fn surround_origin(corners: &[[f64; 2]]) -> bool {
    let mut directions: Vec<f64> =
        corners.iter().filter(|[x, y]| libm::hypot(*x, *y) > 0.0).map(|[x, y]| libm::atan2(*y, *x)).collect();
    directions.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (directions.first(), directions.last()) else { return false };
    let between = directions.windows(2).map(|pair| pair[1] - pair[0]);
    between.fold(first + 2.0 * PI - last, f64::max) < PI
}
