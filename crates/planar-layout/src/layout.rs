//! Arm layouts: the bodies and joints of a robot, read from TOML.

use std::f64::consts::PI;
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::diagnostic::{NumberRule, Report, Table, Value, every, read_document, read_text};

const MASS: NumberRule = NumberRule::positive("a mass", "kg");
const INERTIA: NumberRule = NumberRule::positive("a moment of inertia", "kg m²");
const LENGTH: NumberRule = NumberRule::non_negative("a length", "m").not_millimetres(1e4);
const ANGLE: NumberRule = NumberRule::any("an angle", "rad").not_degrees(2.0 * PI);
const POSITION: [NumberRule; 2] =
    [NumberRule::any("x", "m").not_millimetres(1e4), NumberRule::any("y", "m").not_millimetres(1e4)];

/// Rust's keywords, strict and reserved, up to edition 2024.
const KEYWORDS: &str = "abstract as async await become box break const continue crate do dyn else enum extern \
    false final fn for gen if impl in let loop macro match mod move mut override priv pub ref return self static \
    struct super trait true try type typeof unsafe unsized use virtual where while yield";

/// A free-floating robot: a base and the arms mounted on it. All joints are revolute.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Names the generated Rust module: lower-case letters, digits and underscores.
    pub name: String,
    /// The free-floating base.
    pub base: Base,
    /// The arms, at least one; their order is the order of the joints.
    pub arms: Vec<Arm>,
}

/// The base body; its frame has its origin at the centre of mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Base {
    /// Mass in kg, greater than 0.
    pub mass: f64,
    /// Moment of inertia about the centre of mass in kg m², greater than 0.
    pub inertia: f64,
}

/// A chain of links; joint k moves link k.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// The name that scenarios use; unique in the layout.
    pub name: String,
    /// Position of the first joint in the base frame, [x, y] in m.
    pub mount: [f64; 2],
    /// Direction of the first link at joint angle 0, from the base x axis, in rad; default 0.
    pub mount_angle: f64,
    /// The links, at least one, from the base outwards.
    pub links: Vec<Link>,
}

/// A rigid link; its frame has its origin at its joint and x towards the next joint or the end effector.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Distance to the next joint, or to the end effector, in m; 0 for a reaction wheel.
    pub length: f64,
    /// Mass in kg, greater than 0.
    pub mass: f64,
    /// Moment of inertia about the centre of mass in kg m², greater than 0.
    pub inertia: f64,
    /// Centre of mass in the link frame, [x, y] in m; default mid-link.
    pub com: [f64; 2],
}

impl Layout {
    /// Reads a layout file.
    ///
    /// # Errors
    /// All that is wrong with the file or its content.
    pub fn read(path: &Path) -> Result<Self, Report> {
        Self::parse(&read_text(path, "TOML")?, &path.display().to_string())
    }

    /// Reads a layout from TOML text; `file` is the name that problems are reported under.
    ///
    /// # Errors
    /// All that is wrong with the content.
    pub fn parse(text: &str, file: &str) -> Result<Self, Report> {
        read_document(text, file, &["name", "base", "arm"], |root| {
            let name = root.require("name", MODULE_NAME).and_then(|value| module_name(&value));
            let base = root.table("base", &["mass", "inertia"]).and_then(|base| Base::from_table(&base));
            let arms = root.require("arm", "at least one `[[arm]]`").and_then(|value| {
                let arms = value.tables(&["name", "mount", "mount_angle", "link"])?;
                if arms.is_empty() {
                    value.expected("at least one `[[arm]]`", None);
                }
                Table::reject_repeats(&arms, "name", str::eq, "arm names must differ");
                every(arms.iter().map(Arm::from_table))
            });
            Some(Self { name: name?, base: base?, arms: arms? })
        })
    }

    /// Whether a reference to a layout is a path, and not the name of a shipped one: it ends in `.toml` or has a `/`.
    #[must_use]
    pub fn is_path(reference: &str) -> bool {
        reference.contains('/') || Path::new(reference).extension().is_some_and(|extension| extension == "toml")
    }

    /// Whether this can be the name of a layout: of a Rust module and of a file.
    #[must_use]
    pub fn is_name(name: &str) -> bool {
        has_letters_of_a_module(name) && !is_keyword(name)
    }

    /// `joint 2 of arm1`, by the index over all arms.
    #[must_use]
    pub fn joint_name(&self, index: usize) -> String {
        let mut left = index;
        for arm in &self.arms {
            if left < arm.links.len() {
                return format!("joint {} of {}", left + 1, arm.name);
            }
            left -= arm.links.len();
        }
        format!("joint {}", index + 1)
    }

    /// The number of joints of all arms together.
    #[must_use]
    pub fn joints(&self) -> usize {
        self.arms.iter().map(|arm| arm.links.len()).sum()
    }

    /// The mass of all bodies, in kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.base.mass + self.arms.iter().map(Arm::mass).sum::<f64>()
    }

    /// Hash of the content, in hexadecimal: comments, spacing, the writing of numbers and written-out
    /// defaults do not change it.
    ///
    /// It is the SHA-256 of this UTF-8 text: lines `key=value`, each ended by a newline, in the order
    /// `name`, `base.mass`, `base.inertia`, then for each arm i from 0 `arm[i].name`,
    /// `arm[i].mount[0]`, `arm[i].mount[1]`, `arm[i].mount_angle`, and for each of its links j from 0
    /// `arm[i].link[j].length`, `.mass`, `.inertia`, `.com[0]`, `.com[1]`. Names stand as they are;
    /// numbers are the 16 lower-case hexadecimal digits of their IEEE-754 binary64 bits, most
    /// significant first, with −0 written as 0.
    #[must_use]
    pub fn sha256(&self) -> String {
        let digest: [u8; 32] = Sha256::digest(self.canonical_text()).into();
        digest.map(|byte| format!("{byte:02x}")).concat()
    }

    /// TOML text that reads back as the same numbers.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let text = |key: &str, text: &str| format!("{key} = {}\n", toml::Value::from(text));
        let number = |key: &str, value: f64| format!("{key} = {}\n", toml::Value::from(value));
        let pair = |key: &str, pair: [f64; 2]| format!("{key} = {}\n", toml::Value::from(pair.to_vec()));
        let mut lines = vec![
            text("name", &self.name),
            "\n[base]\n".to_owned(),
            number("mass", self.base.mass),
            number("inertia", self.base.inertia),
        ];
        for arm in &self.arms {
            lines.push("\n[[arm]]\n".to_owned());
            lines.extend([text("name", &arm.name), pair("mount", arm.mount)]);
            if arm.mount_angle != 0.0 {
                lines.push(number("mount_angle", arm.mount_angle));
            }
            for link in &arm.links {
                lines.push("[[arm.link]]\n".to_owned());
                lines.extend([number("length", link.length), number("mass", link.mass)]);
                lines.extend([number("inertia", link.inertia), pair("com", link.com)]);
            }
        }
        lines.concat()
    }

    fn canonical_text(&self) -> String {
        // Adding +0 turns −0 into +0 and leaves every other number as it is.
        let number = |key: &str, value: f64| format!("{key}={:016x}\n", (value + 0.0).to_bits());
        let mut lines = vec![
            format!("name={}\n", self.name),
            number("base.mass", self.base.mass),
            number("base.inertia", self.base.inertia),
        ];
        for (i, arm) in self.arms.iter().enumerate() {
            lines.push(format!("arm[{i}].name={}\n", arm.name));
            lines.push(number(&format!("arm[{i}].mount[0]"), arm.mount[0]));
            lines.push(number(&format!("arm[{i}].mount[1]"), arm.mount[1]));
            lines.push(number(&format!("arm[{i}].mount_angle"), arm.mount_angle));
            for (j, link) in arm.links.iter().enumerate() {
                let entries = [
                    ("length", link.length),
                    ("mass", link.mass),
                    ("inertia", link.inertia),
                    ("com[0]", link.com[0]),
                    ("com[1]", link.com[1]),
                ];
                lines.extend(entries.map(|(key, value)| number(&format!("arm[{i}].link[{j}].{key}"), value)));
            }
        }
        lines.concat()
    }
}

impl Base {
    /// √(inertia / mass), in m: how far out its mass is.
    #[must_use]
    pub fn radius_of_gyration(&self) -> f64 {
        (self.inertia / self.mass).sqrt()
    }

    fn from_table(table: &Table<'_>) -> Option<Self> {
        let mass = table.number("mass", &MASS);
        let inertia = table.number("inertia", &INERTIA);
        Some(Self { mass: mass?, inertia: inertia? })
    }
}

impl Arm {
    /// The mass of its links, in kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.links.iter().map(|link| link.mass).sum()
    }

    /// The distance of the end effector from the mount when the arm is stretched, in m; 0 for a reaction wheel.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.links.iter().map(|link| link.length).sum()
    }

    /// The largest distance of the end effector from the base COM, in m.
    #[must_use]
    pub fn reach_from_base(&self) -> f64 {
        self.mount[0].hypot(self.mount[1]) + self.reach()
    }

    fn from_table(table: &Table<'_>) -> Option<Self> {
        let name = table.text("name", "a name");
        let mount = table.vector("mount", &POSITION);
        let mount_angle = table.number_or("mount_angle", &ANGLE, 0.0);
        let links = table.require("link", "at least one `[[arm.link]]`").and_then(|value| {
            let links = value.tables(&["length", "mass", "inertia", "com"])?;
            if links.is_empty() {
                value.expected("at least one `[[arm.link]]`", None);
            }
            every(links.iter().map(Link::from_table))
        });
        Some(Self { name: name?.to_owned(), mount: mount?, mount_angle: mount_angle?, links: links? })
    }
}

impl Link {
    fn from_table(table: &Table<'_>) -> Option<Self> {
        let length = table.number("length", &LENGTH);
        let mass = table.number("mass", &MASS);
        let inertia = table.number("inertia", &INERTIA);
        let com = match table.get("com") {
            Some(value) => value.vector(&POSITION),
            None => length.map(|length| [length / 2.0, 0.0]),
        };
        Some(Self { length: length?, mass: mass?, inertia: inertia?, com: com? })
    }
}

const MODULE_NAME: &str = "a name for a Rust module (lower-case letters, digits and `_`, a letter first)";

/// A name that can be a Rust module and a file.
fn module_name(value: &Value<'_>) -> Option<String> {
    let name = value.text(MODULE_NAME)?;
    if !has_letters_of_a_module(name) {
        let plain: String =
            name.to_lowercase().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let help = plain.starts_with(|c: char| c.is_ascii_lowercase()) && plain.len() <= 64;
        value.expected(&format!("{MODULE_NAME}, at most 64 of them"), help.then(|| format!("`{plain}` would do")));
        return None;
    }
    if is_keyword(name) {
        value.expected(MODULE_NAME, Some(format!("`{name}` is a Rust keyword; `{name}_robot` would do")));
        return None;
    }
    Some(name.to_owned())
}

fn has_letters_of_a_module(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
        && name.len() <= 64
}

fn is_keyword(name: &str) -> bool {
    KEYWORDS.split_whitespace().any(|keyword| keyword == name)
}
