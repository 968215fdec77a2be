//! Arm layouts: the bodies and joints of a robot, read from TOML.
//!
//! # Example
//! ```
//! use planar_layout::layout::Layout;
//!
//! let text = r#"
//! name = "swing"
//! base = { mass = 100.0, inertia = 20.0 }
//! [[arm]]
//! name = "left"
//! mount = [0.5, 0.0]
//! link = [{ length = 2.0, mass = 5.0, inertia = 1.7 }, { length = 1.0, mass = 3.0, inertia = 0.3 }]
//! "#;
//! let layout = Layout::parse(text, "swing.toml")?;
//! assert_eq!((layout.joints(), layout.mass(), layout.arms[0].reach_from_base()), (2, 108.0, 3.5));
//! // a uniform link without another `com`
//! assert_eq!(layout.arms[0].links[0].com, [1.0, 0.0]);
//! assert_eq!(Layout::parse(&layout.to_toml(), "copy.toml")?.sha256(), layout.sha256());
//! # Ok::<(), planar_layout::diagnostic::Report>(())
//! ```

mod keys;
mod millimetres;
mod resolution;

use std::path::Path;

use planar_dynamics::manifest::ParameterKind;

use crate::diagnostic::{DocumentKind, Report, Table, Value, every, read_text, report_error};
use crate::outline::{Body, Outline, outline};
use crate::proportion::{Disproportion, Inertia, disproportion};
pub use millimetres::Millimetres;
use resolution::{LEAST_SHARE, Weakest};

pub use keys::FORMAT;

/// A link so many times as long as any other is named before masses are.
const LONG: f64 = 20.0;

/// Rust's keywords, strict and reserved, up to edition 2024.
const KEYWORDS: &[&str] = &[
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn", "else",
    "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
    "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super", "trait", "true",
    "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// A free-floating robot: a base and the arms mounted on it. All joints are revolute.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Base {
    /// Mass in kg, greater than 0.
    pub mass: f64,
    /// Moment of inertia about the centre of mass in kg m², greater than 0.
    pub inertia: f64,
    /// In the base frame; not part of the hash. By default a rectangle with sides of [`Layout::default_base_size`].
    pub outline: Option<Outline>,
}

/// A chain of links; joint k moves link k.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Link {
    /// Distance to the next joint, or to the end effector, in m; 0 for a reaction wheel.
    pub length: f64,
    /// Mass in kg, greater than 0.
    pub mass: f64,
    /// Moment of inertia about the centre of mass in kg m², greater than 0.
    pub inertia: f64,
    /// Centre of mass in the link frame, [x, y] in m; default mid-link.
    pub com: [f64; 2],
    /// In the link frame; not part of the hash. By default the segment from the joint to the link's end.
    pub outline: Option<Outline>,
}

impl Layout {
    /// Reads a layout file.
    ///
    /// # Errors
    /// A report of everything wrong with the file or its content.
    pub fn read(path: &Path) -> Result<Self, Report> {
        Self::parse(&read_text(path, "TOML")?, &path.display().to_string())
    }

    /// Reads a layout from TOML text; `file` is its name in reports.
    ///
    /// # Errors
    /// A report of everything wrong with the content.
    pub fn parse(text: &str, file: &str) -> Result<Self, Report> {
        let layout = DocumentKind::Layout.read(text, file, &FORMAT, |root| {
            let name = root.require("name").and_then(|value| module_name(&value));
            let base = root.table("base").and_then(|base| Base::from_table(&base));
            let arms = root.tables("arm").and_then(|arms| {
                Table::reject_repeats(&arms, "name", str::to_owned, "arm names must differ");
                every(arms.iter().map(Arm::from_table))
            });
            Some(Self { name: name?, base: base?, arms: arms? })
        })?;
        let report = |Disproportion { kind, arm, link, value, why }| {
            report_error(text, file, (&parameter_key(kind, arm, link), &value.to_string()), &why, None)
        };
        match layout.disproportions().into_iter().map(report).reduce(Report::and) {
            None => Ok(layout),
            Some(report) => Err(report),
        }
    }

    /// Whether a reference to a layout is a path, not the name of a shipped one: it ends in `.toml` or contains a `/`.
    #[must_use]
    pub fn is_path(reference: &str) -> bool {
        reference.contains('/') || Path::new(reference).extension().is_some_and(|extension| extension == "toml")
    }

    /// Whether this is a valid name of a layout, and so of a Rust module and of a file.
    #[must_use]
    pub fn is_name(name: &str) -> bool {
        has_module_letters(name) && !is_keyword(name)
    }

    /// `joint 2 of arm1`, from the index over all arms.
    ///
    /// # Panics
    /// For an index that is not less than the number of joints.
    #[must_use]
    pub fn joint_name(&self, index: usize) -> String {
        let mut joints = self.arms.iter().flat_map(|arm| (1..=arm.links.len()).map(|number| (&arm.name, number)));
        let (arm, number) = joints.nth(index).expect("an index of a joint");
        format!("joint {number} of {arm}")
    }

    /// The number of joints of all arms together.
    #[must_use]
    pub fn joints(&self) -> usize {
        self.arms.iter().map(|arm| arm.links.len()).sum()
    }

    /// Sides of the base's default outline along x and y about its COM, m: those of a uniform square of its mass and
    /// inertia, or larger to contain the mounts.
    #[must_use]
    pub fn default_base_size(&self) -> [f64; 2] {
        let half = self.base.radius_of_gyration() * 1.5_f64.sqrt();
        [0, 1].map(|i| 2.0 * self.arms.iter().map(|arm| arm.mount[i].abs()).fold(half, f64::max))
    }

    /// Upper bound of the distance of a point of its outlines from the base's COM, in m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        let [x, y] = self.default_base_size();
        let base = self.base.outline.as_ref().map_or(0.5 * libm::hypot(x, y), Outline::reach);
        let outline = |link: &Link| link.outline.as_ref().map_or(link.length, Outline::reach);
        let arm = |arm: &Arm| arm.reach_from_base() + arm.links.iter().map(outline).fold(0.0, f64::max);
        self.arms.iter().map(arm).fold(base, f64::max)
    }

    /// The mass of all bodies, in kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.base.mass + self.arms.iter().map(Arm::mass).sum::<f64>()
    }

    /// Hash of the content, in hexadecimal; comments, spacing, number formats, explicit defaults and outlines do not
    /// change it.
    ///
    /// It is the SHA-256 of this UTF-8 text: lines `key=value`, each ended by a newline, in the order `name`,
    /// `base.mass`, `base.inertia`, then for each arm i from 0 `arm[i].name`, `arm[i].mount[0]`, `arm[i].mount[1]`,
    /// `arm[i].mount_angle`, and for each of its links j from 0 `arm[i].link[j].length`, `.mass`, `.inertia`, `.com[0]`,
    /// `.com[1]`. Names are unchanged; numbers are the 16 lower-case hexadecimal digits of their IEEE-754 binary64 bits,
    /// most significant first, with −0 written as 0.
    #[must_use]
    pub fn sha256(&self) -> String {
        sha256(&self.canonical_text())
    }

    /// TOML text from which [`Self::parse`] reads the same numbers.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let text = |key: &str, text: &str| format!("{key} = {}\n", toml::Value::from(text));
        let number = |key: &str, value: f64| format!("{key} = {}\n", toml::Value::from(value));
        let outline = |outline: &Outline| format!("outline = {}\n", outline.to_toml());
        let pair = |key: &str, pair: [f64; 2]| format!("{key} = {}\n", toml::Value::from(pair.to_vec()));
        let mut lines = vec![
            text("name", &self.name),
            "\n[base]\n".to_owned(),
            number("mass", self.base.mass),
            number("inertia", self.base.inertia),
        ];
        lines.extend(self.base.outline.as_ref().map(outline));
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
                lines.extend(link.outline.as_ref().map(outline));
            }
        }
        lines.concat()
    }

    /// The layout's numbers in the order of the canonical text, with their arms and links; 0 where there is none.
    #[must_use]
    pub fn parameters(&self) -> Vec<(ParameterKind, usize, usize, f64)> {
        let mut layout = self.clone();
        layout.parameters_mut().into_iter().map(|(kind, arm, link, number)| (kind, arm, link, *number)).collect()
    }

    /// As [`parameters`](Self::parameters), to change.
    pub fn parameters_mut(&mut self) -> Vec<(ParameterKind, usize, usize, &mut f64)> {
        use ParameterKind as Kind;
        let base = &mut self.base;
        let mut all = vec![(Kind::BaseMass, 0, 0, &mut base.mass), (Kind::BaseInertia, 0, 0, &mut base.inertia)];
        for (i, arm) in self.arms.iter_mut().enumerate() {
            let [x, y] = &mut arm.mount;
            all.extend([
                (Kind::MountX, i, 0, x),
                (Kind::MountY, i, 0, y),
                (Kind::MountAngle, i, 0, &mut arm.mount_angle),
            ]);
            for (k, link) in arm.links.iter_mut().enumerate() {
                let [x, y] = &mut link.com;
                all.extend([
                    (Kind::LinkLength, i, k, &mut link.length),
                    (Kind::LinkMass, i, k, &mut link.mass),
                    (Kind::LinkInertia, i, k, &mut link.inertia),
                    (Kind::LinkComX, i, k, x),
                    (Kind::LinkComY, i, k, y),
                ]);
            }
        }
        all
    }

    /// The links on the long side of the largest gap between the lengths of all, indices of arm and link, and the longest of
    /// the others, m; `None` where these are not most of those with a length.
    #[must_use]
    pub fn longest_links(&self) -> Option<(Vec<[usize; 2]>, f64)> {
        let of_arm = |(i, arm): (usize, &Arm)| {
            arm.links.iter().enumerate().map(move |(k, link)| (link.length, [i, k])).collect::<Vec<_>>()
        };
        let mut lengths: Vec<_> =
            self.arms.iter().enumerate().flat_map(of_arm).filter(|(length, _)| *length > 0.0).collect();
        lengths.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let most = lengths.len() / 2;
        let gap = |count: &usize| lengths[count - 1].0 / lengths[*count].0;
        // of equal ones the first
        let count = (1..=most).rev().max_by(|a, b| gap(a).total_cmp(&gap(b)))?;
        Some((lengths[..count].iter().map(|(_, place)| *place).collect(), lengths[count].0))
    }

    /// Largest [reach](Arm::reach_from_base) of an arm, m.
    #[must_use]
    pub fn reach_from_base(&self) -> f64 {
        self.arms.iter().map(Arm::reach_from_base).fold(0.0, f64::max)
    }

    /// A body beside which others are lost in rounding, or that is lost beside them; or the lengths that are why.
    fn disproportions(&self) -> Vec<Disproportion> {
        let base = Inertia { mass: self.base.mass, inertia: self.base.inertia };
        let of_link = |link: &Link| Inertia { mass: link.mass, inertia: link.inertia };
        let arms: Vec<Vec<_>> = self.arms.iter().map(|arm| arm.links.iter().map(of_link).collect()).collect();
        let body = disproportion(base, &arms, self.reach_from_base());
        body.map_or_else(|| self.unresolved_motion(), |body| vec![body])
    }

    /// A joint, or the base, whose motion with the joints beyond it free is lost beside that with them locked.
    fn unresolved_motion(&self) -> Vec<Disproportion> {
        let Weakest { link, share } = Weakest::of(self);
        if share >= LEAST_SHARE {
            return Vec::new();
        }
        if let Some(long) = self.long_links() {
            return long;
        }
        let are_why = || Weakest::of(&self.in_metres()).share >= LEAST_SHARE;
        if let Some(Millimetres { arm, link, why, help }) = self.millimetres().filter(|_| are_why()) {
            let value = self.arms[arm].links[link].length;
            let why = format!("{why}: 16 digits do not resolve how such a robot moves; {help}");
            return vec![Disproportion { kind: ParameterKind::LinkLength, arm, link, value, why }];
        }
        let ((kind, value), what, beyond) = match link {
            Some((i, k)) => {
                let arm = &self.arms[i];
                let what = format!("joint {} of {}", k + 1, arm.name);
                ((ParameterKind::LinkMass, arm.links[k].mass), what, "the joints beyond it")
            }
            None => ((ParameterKind::BaseMass, self.base.mass), "the base".to_owned(), "all joints"),
        };
        let why = format!(
            "16 digits do not resolve how {what} moves with {beyond} free: its inertia is then {share:.1e} of that with \
             them locked, expected at least {LEAST_SHARE:e}; light bodies between heavy ones fold like this, and \
             short links without inertia, but not longer links and bodies whose masses and inertias differ less"
        );
        let (arm, link) = link.unwrap_or_default();
        vec![Disproportion { kind, arm, link, value, why }]
    }

    /// The links whose lengths alone are why: of lengths near those of the others the motion would be resolved.
    fn long_links(&self) -> Option<Vec<Disproportion>> {
        let (long, next) = self.longest_links()?;
        let mut shorter = self.clone();
        for &[arm, link] in &long {
            let link = &mut shorter.arms[arm].links[link];
            link.com = link.com.map(|part| part * next / link.length);
            link.length = next;
        }
        let length = |[arm, link]: [usize; 2]| self.arms[arm].links[link].length;
        let is_why = long.iter().all(|link| length(*link) > LONG * next) && Weakest::of(&shorter).share >= LEAST_SHARE;
        let blame = |[arm, link]: [usize; 2]| {
            let value = length([arm, link]);
            let others = if long.len() > 1 { "longest link with another length" } else { "next longest link" };
            let why = format!(
                "{:.0} times as long as the {others}, {next} m: 16 digits do not resolve how the joints of such a robot \
                 move; lengths are in m",
                value / next
            );
            Disproportion { kind: ParameterKind::LinkLength, arm, link, value, why }
        };
        is_why.then(|| long.iter().copied().map(blame).collect())
    }

    fn canonical_text(&self) -> String {
        let mut lines = vec![format!("name={}\n", self.name)];
        for (kind, arm, link, value) in self.parameters() {
            if kind == ParameterKind::MountX {
                lines.push(format!("arm[{arm}].name={}\n", self.arms[arm].name));
            }
            // adding +0 turns −0 into +0
            lines.push(format!("{}={:016x}\n", parameter_key(kind, arm, link), (value + 0.0).to_bits()));
        }
        lines.concat()
    }
}

/// The SHA-256 of a text, in hexadecimal.
#[must_use]
pub fn sha256(text: &str) -> String {
    let digest = hmac_sha256::Hash::hash(text.as_bytes());
    digest.map(|byte| format!("{byte:02x}")).concat()
}

/// The key of a parameter in a layout file: `arm[1].link[0].mass`.
pub(crate) fn parameter_key(kind: ParameterKind, arm: usize, link: usize) -> String {
    match kind {
        ParameterKind::BaseMass => "base.mass".to_owned(),
        ParameterKind::BaseInertia => "base.inertia".to_owned(),
        ParameterKind::MountX => format!("arm[{arm}].mount[0]"),
        ParameterKind::MountY => format!("arm[{arm}].mount[1]"),
        ParameterKind::MountAngle => format!("arm[{arm}].mount_angle"),
        ParameterKind::LinkLength => format!("arm[{arm}].link[{link}].length"),
        ParameterKind::LinkMass => format!("arm[{arm}].link[{link}].mass"),
        ParameterKind::LinkInertia => format!("arm[{arm}].link[{link}].inertia"),
        ParameterKind::LinkComX => format!("arm[{arm}].link[{link}].com[0]"),
        ParameterKind::LinkComY => format!("arm[{arm}].link[{link}].com[1]"),
    }
}

impl Base {
    /// √(inertia / mass), in m.
    #[must_use]
    pub fn radius_of_gyration(&self) -> f64 {
        (self.inertia / self.mass).sqrt()
    }

    fn from_table(table: &Table<'_>) -> Option<Self> {
        let mass = table.number("mass");
        let inertia = table.number("inertia");
        let outline = table.read_or("outline", None, |value| outline(value, Body::Base).map(Some));
        Some(Self { mass: mass?, inertia: inertia?, outline: outline? })
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
        libm::hypot(self.mount[0], self.mount[1]) + self.reach()
    }

    fn from_table(table: &Table<'_>) -> Option<Self> {
        let name = table.text("name");
        let mount = table.vector("mount");
        let mount_angle = table.number("mount_angle");
        let links = table.tables("link").and_then(|links| every(links.iter().map(Link::from_table)));
        Some(Self { name: name?.to_owned(), mount: mount?, mount_angle: mount_angle?, links: links? })
    }
}

impl Link {
    fn from_table(table: &Table<'_>) -> Option<Self> {
        let length = table.number("length");
        let mass = table.number("mass");
        let inertia = table.number("inertia");
        let com = table.get("com").map_or(length.map(|length| [length / 2.0, 0.0]), |value| value.vector());
        let outline = table.read_or("outline", None, |value| outline(value, Body::Link(length)).map(Some));
        Some(Self { length: length?, mass: mass?, inertia: inertia?, com: com?, outline: outline? })
    }
}

/// A valid name of a Rust module and a file.
fn module_name(value: &Value<'_>) -> Option<String> {
    let name = value.text()?;
    if !has_module_letters(name) {
        let suggestion: String =
            name.to_lowercase().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let help = has_module_letters(&suggestion).then(|| format!("`{suggestion}` would do"));
        value.expected(&format!("{}, at most 64 of them", value.wanted()), help);
        return None;
    }
    if is_keyword(name) {
        value.expected(&value.wanted(), Some(format!("`{name}` is a Rust keyword; `{name}_robot` would do")));
        return None;
    }
    Some(name.to_owned())
}

fn has_module_letters(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
        && name.len() <= 64
}

fn is_keyword(name: &str) -> bool {
    KEYWORDS.contains(&name)
}

#[cfg(test)]
mod tests {
    use super::Layout;

    /// A uniform square of 6 kg and 4 kg m² has sides of 2 m: m a² / 6.
    #[test]
    fn the_default_base_contains_its_mounts() {
        let size = |mounts: [[f64; 2]; 2]| {
            let arms = [0, 1].map(|i| {
                format!(
                    "[[arm]]\nname = \"arm{i}\"\nmount = {:?}\nlink = [{{ length = 1.0, mass = 1.0, inertia = 0.1 }}]\n",
                    mounts[i]
                )
            });
            let text = format!("name = \"it\"\nbase = {{ mass = 6.0, inertia = 4.0 }}\n{}", arms.concat());
            Layout::parse(&text, "it.toml").expect("a layout").default_base_size()
        };
        let close = |found: [f64; 2], wanted: [f64; 2]| found.iter().zip(wanted).all(|(f, w)| (f - w).abs() < 1e-12);
        let inside = size([[0.5, 0.25], [-0.5, 0.0]]);
        assert!(close(inside, [2.0, 2.0]), "{inside:?}");
        let outside = size([[0.5, 1.75], [-1.5, 0.0]]);
        assert!(close(outside, [3.0, 3.5]), "{outside:?}");
    }

    #[test]
    fn the_name_of_a_module_has_64_letters_at_most() {
        let parse = |letters: usize| {
            let arm =
                "[[arm]]\nname = \"a\"\nmount = [0.5, 0.0]\nlink = [{ length = 1.0, mass = 1.0, inertia = 0.1 }]\n";
            let name = "n".repeat(letters);
            Layout::parse(&format!("name = \"{name}\"\nbase = {{ mass = 6.0, inertia = 4.0 }}\n{arm}"), "it.toml")
        };
        assert_eq!(parse(64).expect("a name").name.len(), 64);
        let report = parse(65).expect_err("a name that is too long").to_string();
        assert!(report.contains("at most 64 of them"), "{report}");
    }
}
