//! The text of a URDF file as links and joints.

use super::UrdfError;
use super::scan::{Tag, tags};
use crate::diagnostic::printable;
use nalgebra::{IsometryMatrix3, Rotation3, Translation3};
use urdf_rs::{Pose, Robot};

/// Elements within elements: a URDF has six or so, plugins some more. The XML parser recurses, so that a file made to
/// break it would.
const DEEPEST: usize = 64;

/// Elements that a layout is made from, and their attributes that hold numbers.
const NUMBERS: &[(&str, &[&str])] = &[
    ("origin", &["xyz", "rpy"]),
    ("mass", &["value"]),
    ("inertia", &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]),
    ("axis", &["xyz"]),
    ("limit", &["lower", "upper", "effort", "velocity"]),
];

/// Reads the elements of a URDF; the tree they make is still to be checked.
///
/// # Errors
/// [`UrdfError::Unreadable`], and [`UrdfError::Element`] for the link or joint that is to blame.
pub(super) fn read(text: &str) -> Result<Robot, UrdfError> {
    let tags = tags(text);
    let depth = tags.iter().map(|tag| tag.depth + 1).max().unwrap_or_default();
    if depth > DEEPEST {
        let message = format!("its elements stand {depth} deep within each other, {DEEPEST} at most are read");
        return Err(UrdfError::Unreadable(message));
    }
    reject_text_for_numbers(&tags)?;
    urdf_rs::read_from_string(text).map_err(|error| {
        let parts = tags.iter().filter(|tag| tag.depth == 1 && matches!(tag.name(), "link" | "joint"));
        parts.map(broken).find_map(Result::err).unwrap_or_else(|| UrdfError::Unreadable(reason(&error)))
    })
}

/// urdf-rs passes over what is no number among three, and says of others neither where nor what they are.
fn reject_text_for_numbers(tags: &[Tag<'_>]) -> Result<(), UrdfError> {
    let mut part: Option<&Tag<'_>> = None;
    for tag in tags {
        if tag.depth == 1 {
            part = Some(tag).filter(|tag| matches!(tag.name(), "link" | "joint"));
        }
        let Some(part) = part else { continue };
        let names = NUMBERS.iter().find(|(element, _)| *element == tag.name()).map_or(&[][..], |(_, names)| names);
        for (name, value) in tag.attributes().into_iter().filter(|(name, _)| names.contains(name)) {
            if let Some(word) = value.split_whitespace().find(|word| word.parse::<f64>().is_err()) {
                let hint = if word.contains("${") { ": expand the file with xacro first" } else { "" };
                let found = format!("`{name}` of <{}> is \"{value}\", where `{word}` is no number{hint}", tag.name());
                return Err(element(part, tag.line, found));
            }
        }
    }
    Ok(())
}

/// Names of the joints without an `<axis>`: urdf-rs fills in the default.
pub(super) fn joints_without_axis(text: &str) -> Vec<String> {
    let mut found: Vec<&str> = Vec::new();
    let mut joint = None;
    for tag in tags(text) {
        if tag.depth == 1 {
            found.extend(joint);
            joint = tag.attribute("name").filter(|_| tag.name() == "joint");
        } else if tag.depth == 2 && tag.name() == "axis" {
            joint = None;
        }
    }
    found.into_iter().chain(joint).map(str::to_owned).collect()
}

/// Reads one link or joint alone.
fn broken(tag: &Tag<'_>) -> Result<(), UrdfError> {
    let name = tag.name();
    let end = format!("</{name}>");
    let whole = if tag.rest.split('>').next().is_some_and(|first| first.ends_with('/')) {
        tag.rest.split_inclusive('>').next().unwrap_or_default()
    } else {
        tag.rest.find(&end).and_then(|at| tag.rest.get(..at + end.len())).unwrap_or(tag.rest)
    };
    let alone = format!("<robot name=\"alone\">{whole}</robot>");
    urdf_rs::read_from_string(&alone).map(drop).map_err(|error| element(tag, tag.line, reason(&error)))
}

fn element(part: &Tag<'_>, line: usize, found: String) -> UrdfError {
    let name = part.attribute("name").unwrap_or_default();
    UrdfError::Element { line, element: format!("{} `{}`", part.name(), printable(name)), found }
}

/// What an XML library says, without its own names for things.
fn reason(error: &urdf_rs::UrdfError) -> String {
    let text = printable(&error.to_string());
    text.strip_prefix("custom: ").unwrap_or(&text).to_owned()
}

/// The numbers, if they are finite.
pub(super) fn finite<const N: usize>(
    what: &str,
    numbers: [f64; N],
    problem: impl FnOnce(String, &'static str) -> UrdfError,
) -> Result<[f64; N], UrdfError> {
    if numbers.iter().all(|number| number.is_finite()) {
        Ok(numbers)
    } else {
        Err(problem(format!("{what} is {numbers:?}"), "expected finite numbers"))
    }
}

/// A pose as a transformation: `rpy` turns about the fixed axes x, y, z in this order.
pub(super) fn isometry(pose: &Pose) -> IsometryMatrix3<f64> {
    let ([x, y, z], [roll, pitch, yaw]) = (*pose.xyz, *pose.rpy);
    IsometryMatrix3::from_parts(Translation3::new(x, y, z), Rotation3::from_euler_angles(roll, pitch, yaw))
}
