//! Reads the links and joints of a URDF file.

use super::UrdfError;
use super::tags::{Tag, tags};
use crate::diagnostic::printable;
use nalgebra::{IsometryMatrix3, Rotation3, Translation3};
use urdf_rs::{Pose, Robot};

/// Largest depth of nested elements; a URDF has about six. The XML parser recurses, and would overflow the stack.
const MAX_DEPTH: usize = 64;

/// The numeric attributes of the elements that are imported.
const NUMERIC_ATTRIBUTES: &[(&str, &[&str])] = &[
    ("origin", &["xyz", "rpy"]),
    ("mass", &["value"]),
    ("inertia", &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]),
    ("axis", &["xyz"]),
    ("limit", &["lower", "upper", "effort", "velocity"]),
];

/// Reads the elements of a URDF; does not check that they form a tree.
pub(super) fn read(text: &str) -> Result<Robot, UrdfError> {
    let tags = tags(text);
    let depth = tags.iter().map(|tag| tag.depth + 1).max().unwrap_or_default();
    if depth > MAX_DEPTH {
        let message = format!("its elements are nested {depth} deep, expected {MAX_DEPTH} at most");
        return Err(UrdfError::Unreadable(message));
    }
    reject_text_for_numbers(&tags)?;
    urdf_rs::read_from_string(text).map_err(|error| {
        let parts = tags.iter().filter(|tag| tag.depth == 1 && matches!(tag.name(), "link" | "joint"));
        parts.map(parse_alone).find_map(Result::err).unwrap_or_else(|| UrdfError::Unreadable(reason(&error)))
    })
}

/// urdf-rs skips words in lists of numbers, and its errors have neither place nor text.
fn reject_text_for_numbers(tags: &[Tag<'_>]) -> Result<(), UrdfError> {
    let mut part: Option<&Tag<'_>> = None;
    for tag in tags {
        if tag.depth == 1 {
            part = Some(tag).filter(|tag| matches!(tag.name(), "link" | "joint"));
        }
        let Some(part) = part else { continue };
        let names =
            NUMERIC_ATTRIBUTES.iter().find(|(element, _)| *element == tag.name()).map_or(&[][..], |(_, names)| names);
        for (name, value) in tag.attributes().into_iter().filter(|(name, _)| names.contains(name)) {
            if let Some(word) = value.split_whitespace().find(|word| word.parse::<f64>().is_err()) {
                let hint = if word.contains("${") { ": expand the file with xacro first" } else { "" };
                let found =
                    format!("`{name}` of <{}> is \"{value}\", where `{word}` is not a number{hint}", tag.name());
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

/// The error of a link or joint when parsed alone.
fn parse_alone(tag: &Tag<'_>) -> Result<(), UrdfError> {
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

/// The message of the XML library, without its prefix.
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

/// A pose as a transformation: `rpy` are rotations about the fixed axes x, y, z in this order.
pub(super) fn isometry(pose: &Pose) -> IsometryMatrix3<f64> {
    let ([x, y, z], [roll, pitch, yaw]) = (*pose.xyz, *pose.rpy);
    IsometryMatrix3::from_parts(Translation3::new(x, y, z), Rotation3::from_euler_angles(roll, pitch, yaw))
}
