//! Reads the links and joints of a URDF file. Visuals, collisions and all else that a layout does not have are ignored.

use super::description::{Inertial, Joint, JointKind, Limit, Link, Pose, Robot};
use super::error::{UrdfError, part_name};
use super::xml::{Element, root};
use crate::diagnostic::{excerpt, listing, printable};
use nalgebra::{Quaternion, UnitQuaternion};
use std::collections::HashMap;

/// The version from which `<origin>` may have `quat_xyzw`.
const WITH_QUATERNIONS: (u32, u32) = (1, 1);
/// The version from which a limit that is not given is none; before it is 0.
const WITHOUT_ZERO_LIMITS: (u32, u32) = (1, 2);

/// As of the numbers of layouts: squares and products of three have a place in 64 bits. Infinity means no limit.
const LARGEST: f64 = 1e100;

/// The lines of the parts of a robot by kind and name, as in messages.
#[derive(Debug, Default)]
pub(super) struct PartLines(HashMap<String, usize>);

impl PartLines {
    /// An error with the line of the part that it is about.
    pub(super) fn locate(&self, error: UrdfError) -> UrdfError {
        match error {
            UrdfError::Part { part, found, wanted } => match self.0.get(&part) {
                Some(line) => UrdfError::Element { line: *line, element: part, found: format!("{found}; {wanted}") },
                None => UrdfError::Part { part, found, wanted },
            },
            other => other,
        }
    }
}

/// Reads the elements of a URDF; does not check that they form a tree.
pub(super) fn read(text: &str) -> Result<(Robot, PartLines), UrdfError> {
    let top = root(text).map_err(|message| UrdfError::Unreadable(printable(&message)))?;
    let unreadable = |found: String| UrdfError::Unreadable(printable(&format!("line {}: {found}", top.line)));
    if top.name() != "robot" {
        return Err(unreadable(format!("<{}> has no links and joints, expected `<robot>`", top.name())));
    }
    let mut attributes = top.attributes().map_err(unreadable)?;
    let version = attributes.get("version").map_or((1, 0), |version| version_numbers(version));
    let mut robot = Robot { name: attributes.remove("name").unwrap_or_default(), ..Robot::default() };
    let mut lines = PartLines::default();
    lines.0.insert(part_name("robot", &robot.name), top.line);
    for element in top.children.iter().filter(|element| ["link", "joint"].contains(&element.name())) {
        let part = Part::new(element, version)?;
        // of two with the same name the second one
        lines.0.insert(part_name(element.name(), &part.name), element.line);
        match element.name() {
            "link" => robot.links.push(part.link()?),
            _ => robot.joints.push(part.joint()?),
        }
    }
    Ok((robot, lines))
}

/// Major and minor number of the version of the format; 1.0 for anything else.
fn version_numbers(version: &str) -> (u32, u32) {
    let numbers = version.trim().split_once('.');
    numbers.and_then(|(major, minor)| Some((major.parse().ok()?, minor.parse().ok()?))).unwrap_or((1, 0))
}

/// A link or a joint.
struct Part<'a> {
    element: &'a Element<'a>,
    name: String,
    version: (u32, u32),
}

/// An element of a part, with its attributes.
struct Entry<'a> {
    element: &'a Element<'a>,
    attributes: HashMap<&'a str, String>,
}

impl<'a> Part<'a> {
    fn new(element: &'a Element<'a>, version: (u32, u32)) -> Result<Self, UrdfError> {
        let unnamed = Self { element, name: String::new(), version };
        let name = unnamed.entry(element)?.attributes.remove("name");
        let name = name.ok_or_else(|| unnamed.problem(element, "it has no `name`"))?;
        if name.trim().is_empty() {
            return Err(unnamed.problem(element, &format!("its `name` is \"{name}\", expected a name")));
        }
        Ok(Self { name, ..unnamed })
    }

    fn link(&self) -> Result<Link, UrdfError> {
        let inertial = match self.child(self.element, "inertial")? {
            Some(entry) => self.inertial(entry.element)?,
            None => Inertial::default(),
        };
        Ok(Link { name: self.name.clone(), inertial })
    }

    fn inertial(&self, element: &'a Element<'a>) -> Result<Inertial, UrdfError> {
        let mass = self.required(element, "mass")?;
        let inertia = self.required(element, "inertia")?;
        let mut moments = [0.0; 6];
        for (moment, name) in moments.iter_mut().zip(["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]) {
            *moment = self.number(&inertia, name, None)?;
        }
        Ok(Inertial { origin: self.origin(element)?, mass: self.number(&mass, "value", None)?, inertia: moments })
    }

    fn joint(&self) -> Result<Joint, UrdfError> {
        let own = self.entry(self.element)?;
        let kind = self.attribute(&own, "type")?;
        let kind = JointKind::ALL.iter().find(|(name, _)| *name == kind).map(|(_, kind)| *kind).ok_or_else(|| {
            let wanted = listing(&JointKind::ALL.map(|(name, _)| name), "or");
            self.problem(self.element, &format!("its type is `{}`, expected {wanted}", excerpt(kind)))
        })?;
        let axis = self.child(self.element, "axis")?;
        let axis = axis.map(|axis| self.numbers(&axis, "xyz", None)).transpose()?;
        let dynamics = self.child(self.element, "dynamics")?;
        let loss = |name: &str| dynamics.as_ref().map_or(Ok(0.0), |dynamics| self.number(dynamics, name, Some([0.0])));
        let mimic = self.child(self.element, "mimic")?;
        let mimic = mimic.map(|mimic| self.attribute(&mimic, "joint").map(str::to_owned)).transpose()?;
        Ok(Joint {
            name: self.name.clone(),
            kind,
            origin: self.origin(self.element)?,
            parent: self.end("parent")?,
            child: self.end("child")?,
            axis,
            limit: self.limit()?,
            damping: loss("damping")?,
            friction: loss("friction")?,
            mimic,
            motion: None,
        })
    }

    /// The link that a joint names as its parent or child.
    fn end(&self, name: &str) -> Result<String, UrdfError> {
        let entry = self.required(self.element, name)?;
        self.attribute(&entry, "link").map(str::to_owned)
    }

    fn limit(&self) -> Result<Limit, UrdfError> {
        const NONE: f64 = f64::INFINITY;
        let Some(limit) = self.child(self.element, "limit")? else {
            return Ok(Limit { lower: -NONE, upper: NONE, effort: NONE, velocity: NONE });
        };
        let default = if self.version < WITHOUT_ZERO_LIMITS { 0.0 } else { NONE };
        let number = |name: &str, default: f64| self.number(&limit, name, Some([default]));
        Ok(Limit {
            lower: number("lower", -default)?,
            upper: number("upper", default)?,
            effort: number("effort", default)?,
            velocity: number("velocity", default)?,
        })
    }

    fn origin(&self, element: &'a Element<'a>) -> Result<Pose, UrdfError> {
        let Some(origin) = self.child(element, "origin")? else { return Ok(Pose::default()) };
        let xyz = self.numbers(&origin, "xyz", Some([0.0; 3]))?;
        if self.version < WITH_QUATERNIONS || !origin.attributes.contains_key("quat_xyzw") {
            return Ok(Pose { xyz, rpy: self.numbers(&origin, "rpy", Some([0.0; 3]))? });
        }
        let [x, y, z, w] = self.numbers(&origin, "quat_xyzw", None)?;
        let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 0.0);
        let problem = |found: &str| self.problem(origin.element, &format!("<origin> has {found}"));
        match (turn, origin.attributes.get("rpy")) {
            (_, Some(_)) => Err(problem("both `rpy` and `quat_xyzw`, expected one of them")),
            (None, None) => Err(problem("a `quat_xyzw` of length 0, expected a unit quaternion")),
            (Some(turn), None) => {
                let (roll, pitch, yaw) = turn.euler_angles();
                Ok(Pose { xyz, rpy: [roll, pitch, yaw] })
            }
        }
    }

    /// The element of this name in another, of which there may be one.
    fn child(&self, element: &'a Element<'a>, name: &str) -> Result<Option<Entry<'a>>, UrdfError> {
        let mut found = element.children.iter().filter(|child| child.name() == name);
        let Some(first) = found.next() else { return Ok(None) };
        match found.next() {
            None => self.entry(first).map(Some),
            Some(second) => Err(self.problem(second, &format!("there is a second <{name}>, expected one"))),
        }
    }

    fn required(&self, element: &'a Element<'a>, name: &str) -> Result<Entry<'a>, UrdfError> {
        let missing = || self.problem(element, &format!("<{}> has no <{name}>", element.name()));
        self.child(element, name)?.ok_or_else(missing)
    }

    fn entry(&self, element: &'a Element<'a>) -> Result<Entry<'a>, UrdfError> {
        let attributes = element.attributes().map_err(|message| self.problem(element, &message))?;
        Ok(Entry { element, attributes })
    }

    fn attribute<'e>(&self, entry: &'e Entry<'_>, name: &str) -> Result<&'e str, UrdfError> {
        let missing = || self.problem(entry.element, &format!("<{}> has no `{name}`", entry.element.name()));
        entry.attributes.get(name).map(String::as_str).ok_or_else(missing)
    }

    fn number(&self, entry: &Entry<'_>, name: &str, default: Option<[f64; 1]>) -> Result<f64, UrdfError> {
        self.numbers(entry, name, default).map(|[number]| number)
    }

    /// The numbers of an attribute; the default, if there is one, where it is not given.
    fn numbers<const N: usize>(
        &self,
        entry: &Entry<'_>,
        name: &str,
        default: Option<[f64; N]>,
    ) -> Result<[f64; N], UrdfError> {
        if let (Some(default), false) = (default, entry.attributes.contains_key(name)) {
            return Ok(default);
        }
        let text = self.attribute(entry, name)?;
        let problem = |found: String| {
            let (tag, text) = (entry.element.name(), excerpt(text));
            self.problem(entry.element, &format!("`{name}` of <{tag}> is \"{text}\", {found}"))
        };
        let words = text.split_whitespace().map(|word| {
            word.parse().map_err(|_| {
                let hint = if word.contains("${") { ": expand the file with xacro first" } else { "" };
                problem(format!("where `{}` is not a number{hint}", excerpt(word)))
            })
        });
        let numbers: Vec<f64> = words.collect::<Result<_, _>>()?;
        if let Some(number) = numbers.iter().find(|number| number.is_finite() && number.abs() > LARGEST) {
            return Err(problem(format!(
                "where {number:?} is too large, expected numbers of magnitude {LARGEST:e} or less"
            )));
        }
        let (count, noun) = (numbers.len(), if N == 1 { "number" } else { "numbers" });
        numbers.try_into().map_err(|_| problem(format!("which has {count} numbers, expected {N} {noun}")))
    }

    fn problem(&self, element: &Element<'_>, found: &str) -> UrdfError {
        let element_name = part_name(self.element.name(), &self.name);
        UrdfError::Element { line: element.line, element: element_name, found: printable(found) }
    }
}
