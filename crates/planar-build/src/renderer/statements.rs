//! Statements of a graph as text: how a name is reached from the body of a function, and what is written as one line.

use super::fused::{MultiplyAdd, fuse};
use super::pairs::{Half, Names};
use super::syntax::{Place, Syntax, Terms};
use crate::format::{Graph, Operand, Operation, Statement, Variable, section_at};
use std::collections::{HashMap, HashSet};

/// Most `let` statements of a block. Each opens a scope inside the one before it; a compiler that follows thousands of
/// them exhausts its stack.
const BLOCK: usize = 300;

/// Longest text of an operand that is itself an expression.
const OPERAND: usize = 44;

/// The input of joint angles.
const JOINT_ANGLES: &str = "joint_angles";

/// How names are reached in the body of a function.
#[derive(Default)]
pub struct Scope<'a> {
    syntax: Syntax,
    /// Shapes of the inputs.
    inputs: HashMap<&'a str, &'a [usize]>,
    parameters: HashSet<&'a str>,
    /// Fields of the model; empty where they are computed.
    constants: HashSet<&'a str>,
    /// Fields of the configuration; empty where they are computed.
    configuration: HashSet<&'a str>,
    /// Whether products and sums are fused.
    is_fused: bool,
    /// What is paired; in Rust alone.
    pairs: Option<&'a Names>,
}

/// An expression, and how tightly its outermost operator binds.
struct Expression<'a> {
    text: String,
    precedence: Precedence,
    /// The names in it.
    names: Vec<&'a str>,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Precedence {
    Sum,
    Product,
    Sign,
    Atom,
}

/// A `let` statement.
struct Line<'a> {
    section: &'a str,
    targets: Vec<&'a str>,
    names: Vec<&'a str>,
    text: String,
}

impl<'a> Scope<'a> {
    /// Of the constants.
    pub fn parameters(graph: &'a Graph, syntax: Syntax) -> Self {
        let inputs = graph.inputs.iter().map(|input| (input.name.as_str(), input.shape.as_slice())).collect();
        let parameters = graph.parameters.iter().map(|p| p.name.as_str()).collect();
        Self { syntax, inputs, parameters, ..Self::default() }
    }

    /// Of a family's configuration; in C, of a call with it.
    pub fn constants(graph: &'a Graph, syntax: Syntax, is_fused: bool) -> Self {
        let constants = graph.constants.values.iter().map(|c| c.name.as_str()).collect();
        Self { constants, is_fused, ..Self::parameters(graph, syntax) }
    }

    /// Of a call, with the values that it reads of the configuration.
    pub fn call(graph: &'a Graph, configuration: &[&'a str], is_fused: bool) -> Self {
        let configuration = configuration.iter().copied().collect();
        Self { configuration, ..Self::constants(graph, Syntax::Rust, is_fused) }
    }

    /// With names of pairs.
    pub fn with_pairs(self, names: &'a Names) -> Self {
        Self { pairs: Some(names), ..self }
    }

    /// A stage's lines, with the name of each section before it, in blocks of [`BLOCK`] statements where there are
    /// more. `results` are the names that are used after it.
    ///
    /// A value without a name of its own that is used once, in the same section, is written where it is used.
    pub fn lines(
        &self,
        sections: &'a [(String, usize)],
        statements: &'a [Statement],
        results: &[&'a str],
    ) -> Vec<String> {
        let results: Vec<&str> = results.iter().flat_map(|name| self.sources(name)).collect();
        let lines = self.statements(sections, statements, &results);
        if self.syntax != Syntax::Rust || lines.len() <= BLOCK {
            return texts(self.syntax, &lines);
        }
        let mut later: HashSet<&str> = results.into_iter().collect();
        let mut blocks = Vec::new();
        // from the last, so that what is used later is known
        for block in lines.chunks(BLOCK).rev() {
            let leaving: Vec<&str> =
                block.iter().flat_map(|l| &l.targets).copied().filter(|n| later.contains(n)).collect();
            let (pairs, numbers): (Vec<&str>, Vec<&str>) = leaving.into_iter().partition(|name| self.is_pair(name));
            // an array of nothing would have no type
            let arrays = [numbers, pairs].into_iter().filter(|names| !names.is_empty());
            let arrays: Vec<String> = arrays.map(|names| format!("[{}]", names.join(", "))).collect();
            let leaving = if arrays.len() == 1 { arrays.concat() } else { format!("({})", arrays.join(", ")) };
            let inside = texts(self.syntax, block).into_iter().map(|line| format!("    {line}"));
            let first = format!("let {leaving} = {{");
            let last = [format!("    {leaving}"), "};".to_owned()];
            blocks.push([first].into_iter().chain(inside).chain(last).collect::<Vec<_>>());
            later.extend(block.iter().flat_map(|line| &line.names));
        }
        blocks.into_iter().rev().flatten().collect()
    }

    fn statements(
        &self,
        sections: &'a [(String, usize)],
        statements: &'a [Statement],
        results: &[&'a str],
    ) -> Vec<Line<'a>> {
        let section = |index: usize| section_at(sections, index);
        let mut uses: HashMap<&str, Vec<&str>> = HashMap::new(); // the sections, "results" aside, that use a name
        for (index, statement) in statements.iter().enumerate() {
            for name in statement.reads() {
                uses.entry(name).or_default().push(section(index));
            }
        }
        // where a half of a pair is used, or a pair of two numbers, the expression has to have a name
        let operands = statements.iter().flat_map(Statement::reads);
        let parts = operands.flat_map(|name| self.sources(name).into_iter().filter(move |source| *source != name));
        let results: Vec<&str> = results.iter().copied().chain(parts).collect();
        let sources = |name: &'a str| self.sources(name);
        let fused = if self.is_fused { fuse(statements, &results, &sources) } else { HashMap::new() };
        let results: HashSet<&str> = results.into_iter().collect();
        let is_used = |name: &str| uses.contains_key(name) || results.contains(name);
        let bound = |targets: Vec<&'a str>| -> Vec<&'a str> {
            targets.into_iter().map(|name| if is_used(name) { name } else { "_" }).collect()
        };
        let mut inlined = HashMap::new();
        let mut lines = Vec::new();
        let mut angles = Vec::new();
        let assigned: HashMap<&str, &Statement> =
            statements.iter().flat_map(|s| s.targets.names().into_iter().map(move |name| (name, s))).collect();
        for (index, statement) in statements.iter().enumerate() {
            let expression = match fused.get(&index) {
                None => self.expression(statement, &mut inlined),
                Some(Some(sum)) => self.multiply_add(sum, statement, &mut inlined),
                Some(None) => continue,
            };
            let (section, targets) = (section(index), statement.targets.names());
            if let [sine, cosine] = *bound(targets.clone()) {
                angles.push(([sine, cosine], expression, &statement.a));
                let is_last = statements.get(index + 1).is_none_or(|next| next.operation != Operation::SinCos);
                if is_last {
                    lines.push(self.sines(section, std::mem::take(&mut angles), &assigned));
                }
                continue;
            }
            if let [name] = targets.as_slice()
                && is_numbered(name)
                && expression.text.len() <= OPERAND
                && uses.get(name).is_some_and(|uses| *uses == [section])
                && !results.contains(name)
            {
                inlined.insert(*name, expression);
                continue;
            }
            let targets = bound(targets);
            let text = self.syntax.assignment(&targets.concat(), &expression.text);
            lines.push(Line { section, targets, names: expression.names, text });
        }
        lines
    }

    /// The expression of an operand: what is written in its place, or its name.
    fn inline(&self, operand: &'a Operand, inlined: &mut HashMap<&'a str, Expression<'a>>) -> Expression<'a> {
        operand.name().and_then(|name| inlined.remove(name)).unwrap_or_else(|| Expression {
            text: self.operand(operand),
            precedence: Precedence::Atom,
            names: operand.name().map_or(Vec::new(), |name| self.sources(name)),
        })
    }

    /// The names that statements assign of which a name is made: its own, that of its pair, or those of its two parts.
    fn sources(&self, name: &'a str) -> Vec<&'a str> {
        let Some(names) = self.pairs else { return vec![name] };
        let source = |name: &'a str| names.halves.get(name).map_or(name, |(pair, _)| pair);
        match names.joined.get(name) {
            Some(parts) => parts.iter().filter_map(Operand::name).map(source).collect(),
            None => vec![source(name)],
        }
    }

    fn is_pair(&self, name: &str) -> bool {
        self.pairs.is_some_and(|names| names.is_pair(name))
    }

    fn multiply_add(
        &self,
        sum: &MultiplyAdd<'a>,
        statement: &Statement,
        inlined: &mut HashMap<&'a str, Expression<'a>>,
    ) -> Expression<'a> {
        let [a, b, addend] = [sum.a, sum.b, sum.addend].map(|operand| self.inline(operand, inlined));
        let signed = |expression: &Expression<'_>, is_negative: bool| {
            if is_negative { format!("-{}", expression.within(Precedence::Sign)) } else { expression.text.clone() }
        };
        let (first, last) = (signed(&a, sum.is_product_negative), signed(&addend, sum.is_addend_negative));
        let is_pair = statement.targets.names().into_iter().any(|name| self.is_pair(name));
        let scalar = if is_pair { "Pair" } else { "T" };
        let text = format!("{scalar}::mul_add({first}, {}, {last})", b.text);
        Expression { text, precedence: Precedence::Atom, names: [a.names, b.names, addend.names].concat() }
    }

    fn expression(&self, statement: &'a Statement, inlined: &mut HashMap<&'a str, Expression<'a>>) -> Expression<'a> {
        let (a, b) = (self.inline(&statement.a, inlined), self.inline(&statement.b, inlined));
        let syntax = self.syntax;
        let atom = |text: String| (text, Precedence::Atom);
        let (text, precedence) = match statement.operation {
            Operation::Neg => (format!("-{}", a.within(Precedence::Sign)), Precedence::Sign),
            Operation::Sqrt => atom(syntax.square_root(&a.within(Precedence::Atom), &a.text)),
            // the function is written by those who have its targets
            Operation::SinCos | Operation::Copy => (a.text, a.precedence),
            Operation::Add => infix(syntax, &a, '+', &b, Precedence::Sum),
            Operation::Sub => infix(syntax, &a, '-', &b, Precedence::Sum),
            Operation::Mul => infix(syntax, &a, '*', &b, Precedence::Product),
            Operation::Div => infix(syntax, &a, '/', &b, Precedence::Product),
            Operation::Min => atom(syntax.minimum(&a.text, &b.text)),
            Operation::Atan2 => atom(syntax.arctangent(&a.text, &b.text)),
        };
        Expression { text, precedence, names: [a.names, b.names].concat() }
    }

    pub fn operand(&self, operand: &Operand) -> String {
        let joined = self.pairs.zip(operand.name()).and_then(|(names, name)| names.joined.get(name));
        match joined.map(|parts| parts.each_ref().map(|part| self.part(part))) {
            Some([a, b]) if a == b => format!("Pair::both({a})"),
            Some([a, b]) => format!("Pair::new({a}, {b})"),
            None => self.part(operand),
        }
    }

    /// An operand that is one number, or a pair that has a name.
    fn part(&self, operand: &Operand) -> String {
        match operand {
            Operand::Number(number) => self.syntax.number(*number),
            Operand::Name(name) => self.value(name),
        }
    }

    /// A value that has a name, or that is half of a pair that has one.
    pub fn value(&self, name: &str) -> String {
        if let Some((pair, half)) = self.pairs.and_then(|names| names.halves.get(name)) {
            let half = if *half == Half::First { "first" } else { "second" };
            return format!("{}.{half}", self.named(pair));
        }
        self.named(name)
    }

    fn named(&self, name: &str) -> String {
        let fields = [
            (&self.parameters, Place::Parameters),
            (&self.constants, Place::Constants),
            (&self.configuration, Place::Configuration),
        ];
        match fields.iter().find(|(names, _)| names.contains(name)) {
            Some((_, place)) => self.syntax.field(*place, name),
            None => self.element(name).unwrap_or_else(|| name.to_owned()),
        }
    }

    /// An element of an input, `contacts[1][0]`.
    fn element(&self, name: &str) -> Option<String> {
        let (input, places) = name.strip_suffix(']')?.split_once('[')?;
        let places: Vec<usize> = places.split("][").filter_map(|place| place.parse().ok()).collect();
        Some(self.syntax.element(input, &places, self.inputs.get(input)?))
    }

    /// The sines and cosines of some angles, none of which depends on another's, in one line.
    fn sines(
        &self,
        section: &'a str,
        mut angles: Vec<([&'a str; 2], Expression<'a>, &'a Operand)>,
        assigned: &HashMap<&'a str, &'a Statement>,
    ) -> Line<'a> {
        // sums first: an angle that is a term of them is kept for them
        angles.sort_by_key(|(.., angle)| angle.name().is_some_and(|name| !assigned.contains_key(name)));
        let texts: Vec<_> = angles
            .iter()
            .map(|(targets, angle, _)| (*targets, angle.within(Precedence::Atom), angle.text.clone()))
            .collect();
        let terms = self.terms(angles.iter().filter_map(|(.., angle)| angle.name()).collect(), assigned);
        let text = self.syntax.sines(&texts, terms.as_ref());
        let mut names: Vec<&str> = Vec::new();
        let mut targets = Vec::new();
        for (of_angle, expression, _) in angles {
            targets.extend(of_angle);
            names.extend(expression.names);
        }
        Line { section, targets, names, text }
    }

    /// What angles are sums of; nothing where none is a sum.
    fn terms(&self, mut angles: Vec<&'a str>, assigned: &HashMap<&'a str, &'a Statement>) -> Option<Terms> {
        let (mut is_sum, mut some, mut seen) = (false, Vec::new(), HashSet::new());
        while let Some(name) = angles.pop() {
            for source in self.sources(name) {
                match assigned.get(source) {
                    _ if !seen.insert(source) => {}
                    Some(statement) => {
                        is_sum |= statement.operation == Operation::Add;
                        angles.extend(statement.reads());
                    }
                    None if source.starts_with(JOINT_ANGLES) => {}
                    None => some.push(self.named(source)),
                }
            }
        }
        some.sort();
        let count = self.inputs.get(JOINT_ANGLES)?.iter().product();
        is_sum.then_some(Terms { some, joints: JOINT_ANGLES, count })
    }

    /// An element of an output.
    pub fn element_of(&self, output: &Variable, index: usize, element: &Operand) -> String {
        let text = self.operand(element);
        if output.is_angle(index) { self.syntax.saturated(&text) } else { text }
    }

    /// The elements of an output as an array of its shape, a matrix row by row.
    pub fn array(&self, output: &Variable) -> String {
        let elements = output.elements.iter().enumerate();
        let elements: Vec<String> = elements.map(|(index, element)| self.element_of(output, index, element)).collect();
        nested(&output.shape, &elements)
    }
}

impl Expression<'_> {
    /// As an operand that has to bind at least so tightly.
    fn within(&self, precedence: Precedence) -> String {
        if self.precedence < precedence { format!("({})", self.text) } else { self.text.clone() }
    }
}

/// A binary operation. The operators of a precedence are evaluated from the left: on the right they are in parentheses;
/// in C also a product in a sum, as its guidelines want it.
fn infix(
    syntax: Syntax,
    a: &Expression<'_>,
    operator: char,
    b: &Expression<'_>,
    precedence: Precedence,
) -> (String, Precedence) {
    let tighter =
        if precedence == Precedence::Sum && syntax == Syntax::Rust { Precedence::Product } else { Precedence::Sign };
    let left = if a.precedence == precedence { precedence } else { tighter };
    (format!("{} {operator} {}", a.within(left), b.within(tighter)), precedence)
}

/// The lines of statements, with the name of each section before its first.
fn texts(syntax: Syntax, lines: &[Line<'_>]) -> Vec<String> {
    let mut section = "";
    let mut texts = Vec::new();
    for line in lines {
        if line.section != section {
            section = line.section;
            texts.push(format!("// {}", syntax.comment(section)));
        }
        texts.push(line.text.clone());
    }
    texts
}

/// Whether a name is a letter and a number, that of an intermediate value, or a pair's of two of these.
fn is_numbered(name: &str) -> bool {
    name.split('_').all(|part| part.len() > 1 && part.chars().skip(1).all(|c| c.is_ascii_digit()))
}

/// Elements as a nested array literal of a shape; a scalar is itself.
pub fn nested(shape: &[usize], elements: &[String]) -> String {
    match shape {
        [] => elements.concat(),
        [_] => format!("[{}]", elements.join(", ")),
        [_, columns, ..] => {
            let rows = elements.chunks((*columns).max(1)).map(|row| format!("[{}]", row.join(", ")));
            format!("[{}]", rows.collect::<Vec<_>>().join(", "))
        }
    }
}

/// References to the model's fields that lines use.
pub fn bindings(lines: &[String], model: &str, syntax: Syntax) -> Vec<String> {
    fields(lines, syntax).map(|field| syntax.reference(field, model)).collect()
}

/// The model's fields that lines use.
pub fn fields(lines: &[String], syntax: Syntax) -> impl Iterator<Item = &'static str> {
    let fields = [("parameters", Place::Parameters), ("constants", Place::Constants)];
    let used = move |(_, place): &(&str, Place)| lines.iter().any(|line| line.contains(&syntax.field(*place, "")));
    fields.into_iter().filter(used).map(|(field, _)| field)
}

#[cfg(test)]
mod tests;
