//! The languages that statements are written in: how each writes numbers, calls, assignments and the places of names.

/// A language.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Syntax {
    #[default]
    Rust,
    C,
}

/// Where a name of an earlier stage is found.
#[derive(Clone, Copy, Debug)]
pub enum Place {
    Parameters,
    Constants,
    Configuration,
}

impl Syntax {
    /// The nearest number of the scalar.
    pub fn number(self, number: f64) -> String {
        match (self, number) {
            (Self::Rust, 0.0) => "T::ZERO".to_owned(),
            (Self::Rust, 1.0) => "T::ONE".to_owned(),
            (Self::Rust, _) => format!("T::constant({number:?})"),
            // rounded as in Rust, from the nearest double
            (Self::C, _) => format!("(real){number:?}"),
        }
    }

    /// A value of an earlier stage.
    pub fn field(self, place: Place, name: &str) -> String {
        match (self, place) {
            (Self::Rust, Place::Parameters) => format!("parameters.{name}"),
            (Self::Rust, Place::Constants) => format!("constants.{name}"),
            (Self::C, Place::Parameters) => format!("parameters->{name}"),
            (Self::C, Place::Constants) => format!("constants->{name}"),
            (_, Place::Configuration) => format!("self.{name}"),
        }
    }

    /// Text for a comment: in C nothing in it ends or begins one, is another character, or continues the line.
    pub fn comment(self, text: &str) -> String {
        if self == Self::Rust {
            return text.to_owned();
        }
        let mut escaped = String::with_capacity(text.len());
        for c in text.chars() {
            if matches!((escaped.chars().last(), c), (Some('*'), '/') | (Some('/'), '*' | '/') | (Some('?'), '?')) {
                escaped.push(' ');
            }
            escaped.push(c);
        }
        if escaped.ends_with('\\') { escaped + "." } else { escaped }
    }

    /// A reference to a field of the model, under the field's name.
    pub fn reference(self, field: &str, model: &str) -> String {
        match self {
            Self::Rust => format!("let {field} = &{model}.{field};"),
            Self::C => format!("const model_{field} *const {field} = &{model}->{field};"),
        }
    }

    /// The element of an input: in C, matrices are flat.
    pub fn element(self, input: &str, place: &[usize], shape: &[usize]) -> String {
        match (self, place, shape) {
            (Self::C, [row, column], [_, columns]) => format!("{input}[{}]", row * columns + column),
            _ => place.iter().fold(input.to_owned(), |text, index| format!("{text}[{index}]")),
        }
    }

    pub fn square_root(self, atom: &str, text: &str) -> String {
        match self {
            Self::Rust => format!("{atom}.sqrt()"),
            Self::C => format!("square_root({text})"),
        }
    }

    // not as methods in Rust: a lint of clippy's follows the receiver of a method with an argument through all its
    // assignments, again at every use, which takes hours for long functions
    pub fn minimum(self, a: &str, b: &str) -> String {
        match self {
            Self::Rust => format!("T::minimum({a}, {b})"),
            Self::C => format!("minimum({a}, {b})"),
        }
    }

    pub fn arctangent(self, y: &str, x: &str) -> String {
        match self {
            Self::Rust => format!("T::atan2({y}, {x})"),
            Self::C => format!("arctangent({y}, {x})"),
        }
    }

    /// What follows the last item of a list of several lines, after the text with its opening bracket.
    pub fn after_last(self, before: &str) -> &'static str {
        if self == Self::C && before.ends_with('(') { "" } else { "," }
    }

    /// A value with a name.
    pub fn assignment(self, name: &str, text: &str) -> String {
        match self {
            Self::Rust => format!("let {name} = {text};"),
            Self::C => format!("const real {name} = {text};"),
        }
    }

    /// A result that is an angle: a sum, which may be beyond the largest number.
    pub fn saturated(self, angle: &str) -> String {
        match self {
            Self::Rust => format!("{angle}.saturated()"),
            Self::C => format!("saturated({angle})"),
        }
    }

    /// Sines and cosines: the two names and the angle of each, as an atom and as it is. `_` is no name.
    pub fn sines(self, angles: &[([&str; 2], String, String)], terms: Option<&Terms>) -> String {
        match (self, angles, terms) {
            (Self::Rust, [([sine, cosine], atom, _)], None) => format!("let ({sine}, {cosine}) = {atom}.sin_cos();"),
            (Self::Rust, all, terms) => {
                let targets: Vec<String> = all.iter().map(|([s, c], ..)| format!("({s}, {c})")).collect();
                let angles: Vec<&str> = all.iter().map(|(.., angle)| angle.as_str()).collect();
                let angles = angles.join(", ");
                let call = match terms {
                    None => format!("sin_cos_all([{angles}])"),
                    Some(Terms { some, joints, .. }) => {
                        format!("sin_cos_of_sums([{angles}], [{}], {joints})", some.join(", "))
                    }
                };
                format!("let [{}] = T::{call};", targets.join(", "))
            }
            (Self::C, all, terms) => {
                let first = all.first().map_or("", |([sine, cosine], ..)| if *sine == "_" { cosine } else { sine });
                let check = format!("terms_of_{first}");
                let sum = terms.map(|Terms { some, joints, count }| {
                    let joints = (0..*count).map(|joint| format!("{joints}[{joint}]"));
                    let products = some.iter().cloned().chain(joints).map(|term| format!("({term} * zero)"));
                    format!("const real {check} = {};", products.collect::<Vec<_>>().join(" + "))
                });
                let lines = all.iter().flat_map(|([sine, cosine], _, angle)| {
                    let pair = format!("of_{}", if *sine == "_" { cosine } else { sine });
                    let values = [(sine, "sine"), (cosine, "cosine")].into_iter().filter(|(name, _)| **name != "_");
                    let values = values.map(|(name, field)| format!("const real {name} = {pair}.{field};"));
                    let values: Vec<String> = values.collect();
                    let terms = if terms.is_some() { check.clone() } else { "no_sum".to_owned() };
                    [format!("const sine_cosine {pair} = sin_cos({angle}, {terms});")].into_iter().chain(values)
                });
                sum.into_iter().chain(lines).collect::<Vec<_>>().join("\n")
            }
        }
    }
}

/// What the angles of some sines are sums of: joint angles, and others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Terms {
    pub some: Vec<String>,
    /// The name of all joint angles.
    pub joints: &'static str,
    pub count: usize,
}
