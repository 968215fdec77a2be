//! `[[target]]`, `[[case]]` and `[post_impact]`: what is captured, in which variants, and what
//! follows.

use super::joints::Joints;
use super::post_impact::PostImpact;
use super::{FILE_NAME, POSITION, TWIST, file_name};
use crate::diagnostic::{Quantity, Table, Value, every};
use crate::layout::Layout;
use std::collections::HashSet;

const MASS: Quantity = Quantity::positive("a mass", "kg");
const INERTIA: Quantity = Quantity::positive("a moment of inertia", "kg m²");
const IMPULSE: Quantity = Quantity::non_negative("an impulse magnitude", "N s");
const RADIUS: Quantity = Quantity::positive("a radius", "m");
const CONTACT: [Quantity; 2] = [Quantity::any("rx", "m"), Quantity::any("ry", "m")];

/// A free body that one arm captures at the end of the approach.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Unique in the scenario.
    pub name: String,
    /// Index of the arm that captures it; no two targets have the same.
    pub arm: usize,
    /// Mass in kg, greater than 0.
    pub mass: f64,
    /// Moment of inertia about the COM in kg m², greater than 0.
    pub inertia: f64,
    /// From the target's COM to the contact point at the impact, [x, y] in m, inertial axes.
    pub contact: [f64; 2],
    /// Radius in m, greater than 0; for drawing only.
    pub radius: f64,
    /// Twist of the COM before the impact [ω, vx, vy] in rad/s, m/s, m/s; default zero.
    pub twist: [f64; 3],
    /// Where the COM was expected, [x, y] in m, inertial frame; for reporting the miss only.
    pub position: Option<[f64; 2]>,
}

/// One variant of the capture.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Unique in the scenario; usable as a file name.
    pub name: String,
    /// Twist of each target before the impact, in the targets' order; default the target's own.
    pub target_twists: Vec<[f64; 3]>,
    /// Impulse magnitude at each target's contact as somebody else reports it, N s, in the targets' order;
    /// shown beside what is computed, and used for nothing else.
    pub printed_impulses: Vec<Option<f64>>,
}

type Capture = (Vec<Target>, Vec<Case>, Option<PostImpact>);

/// Reads the three tables; `name` is the scenario's.
pub(super) fn read(root: &Table<'_>, layout: Option<&Layout>, name: Option<&str>) -> Option<Capture> {
    let target_keys = ["name", "arm", "mass", "inertia", "contact", "radius", "twist", "position"];
    let tables = root.tables("target", &target_keys)?;
    let alone = tables.is_empty();
    Table::reject_repeats(&tables, "name", str::eq, "target names must differ");
    Table::reject_repeats(&tables, "arm", str::eq, "an arm captures at most one target");
    let targets = every(tables.iter().map(|table| Target::from_table(table, layout)));

    // what the cases say of the targets can be looked at only where each of these has a name of its own
    let target_names = every(tables.iter().map(|table| table.get("name")?.as_str()))
        .filter(|names| names.iter().collect::<HashSet<_>>().len() == names.len());
    let default_twists: Vec<_> = targets.iter().flatten().map(|target| target.twist).collect();
    let tables = root.tables("case", &["name", "target_twists", "printed_impulses"]);
    let cases = tables.and_then(|tables| {
        if let (true, Some(table)) = (alone, tables.first()) {
            let message = "`case[0]` is a table, expected no `[[case]]` without a `[[target]]`";
            table.reject(message.to_owned(), "there is nothing to capture");
        }
        let why = "case names must differ by more than upper and lower case: they are the names of files";
        Table::reject_repeats(&tables, "name", str::eq_ignore_ascii_case, why);
        every(tables.iter().map(|table| Case::from_table(table, target_names.as_deref(), &default_twists)))
    });

    let post_impact = if alone {
        if let Some(value) = root.get("post_impact") {
            value.reject("there is nothing to capture, expected a `[[target]]` with it");
        }
        None
    } else {
        let table = root.table("post_impact", &PostImpact::KEYS);
        Some(table.and_then(|table| PostImpact::from_table(&table, &Joints { layout })))
    };

    let mut cases = cases?;
    if cases.is_empty() {
        let printed_impulses = vec![None; default_twists.len()];
        cases.push(Case { name: name?.to_owned(), target_twists: default_twists, printed_impulses });
    }
    let post_impact = match post_impact {
        Some(post_impact) => Some(post_impact?),
        None => None,
    };
    Some((targets?, cases, post_impact))
}

impl Target {
    fn from_table(table: &Table<'_>, layout: Option<&Layout>) -> Option<Self> {
        let name = table.text("name", "a name");
        let arm = table.require("arm", "the name of an arm of the layout").and_then(|value| arm_index(&value, layout?));
        let mass = table.number("mass", &MASS);
        let inertia = table.number("inertia", &INERTIA);
        let contact = table.vector("contact", &CONTACT);
        let radius = table.number("radius", &RADIUS);
        let twist = table.vector_or("twist", &TWIST, [0.0; 3]);
        let position = match table.get("position") {
            Some(value) => value.vector(&POSITION).map(Some),
            None => Some(None),
        };
        Some(Self {
            name: name?.to_owned(),
            arm: arm?,
            mass: mass?,
            inertia: inertia?,
            contact: contact?,
            radius: radius?,
            twist: twist?,
            position: position?,
        })
    }
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

impl Case {
    fn from_table<'a>(table: &Table<'a>, targets: Option<&[&'a str]>, default_twists: &[[f64; 3]]) -> Option<Self> {
        let name = table.require("name", FILE_NAME).and_then(|value| file_name(&value));
        let targets = targets?;
        let target_twists = match table.get("target_twists") {
            Some(value) => value.table(targets).and_then(|twists| {
                let defaults = default_twists.iter().copied().chain(std::iter::repeat([0.0; 3]));
                let twist = |(name, default): (&&str, _)| twists.vector_or(name, &TWIST, default);
                every(targets.iter().zip(defaults).map(twist))
            }),
            None => Some(default_twists.to_vec()),
        };
        let printed_impulses = match table.get("printed_impulses") {
            Some(value) => value.table(targets).and_then(|printed| {
                every(targets.iter().map(|name| match printed.get(name) {
                    Some(value) => value.number(&IMPULSE).map(Some),
                    None => Some(None),
                }))
            }),
            None => Some(vec![None; targets.len()]),
        };
        Some(Self { name: name?, target_twists: target_twists?, printed_impulses: printed_impulses? })
    }
}
