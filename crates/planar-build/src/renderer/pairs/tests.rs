//! What is paired, and that the numbers stay, for statements of a few lines and for the shipped graphs.

use super::{Half, MOST, Names, Symmetry, paired};
use crate::format::{Graph, Operand, Operation, Statement, Targets};
use crate::renderer::tests::{graph, statements};
use std::collections::HashMap;

/// A number, or a pair's two.
type Value = [f64; 2];

/// The values of statements, with the sines of [`f64`].
struct Interpreter<'a> {
    values: HashMap<String, Value>,
    names: &'a Names,
}

impl Interpreter<'_> {
    fn operand(&self, operand: &Operand) -> Value {
        let name = match operand {
            Operand::Number(number) => return [*number; 2],
            Operand::Name(name) => name,
        };
        if let Some([a, b]) = self.names.joined.get(name) {
            return [self.operand(a)[0], self.operand(b)[0]];
        }
        match self.names.halves.get(name) {
            Some((pair, half)) => [self.known(pair)[usize::from(*half == Half::Second)]; 2],
            None => self.known(name),
        }
    }

    fn known(&self, name: &str) -> Value {
        *self.values.get(name).unwrap_or_else(|| panic!("{name} is used before it is assigned"))
    }

    fn run(&mut self, statements: &[Statement]) {
        for Statement { targets, operation, a, b } in statements {
            let a = self.operand(a);
            let b = if operation.is_unary() { a } else { self.operand(b) };
            match targets {
                Targets::SinCos(sine, cosine) => {
                    self.values.insert(sine.clone(), a.map(f64::sin));
                    self.values.insert(cosine.clone(), a.map(f64::cos));
                }
                Targets::Value(name) => {
                    let value = [0, 1].map(|half| number(*operation, a[half], b[half]));
                    self.values.insert(name.clone(), value);
                }
            }
        }
    }
}

fn number(operation: Operation, a: f64, b: f64) -> f64 {
    match operation {
        Operation::Copy => a,
        Operation::Neg => -a,
        Operation::Sqrt => a.sqrt(),
        Operation::Add => a + b,
        Operation::Sub => a - b,
        Operation::Mul => a * b,
        Operation::Div => a / b,
        Operation::Min => a.min(b),
        Operation::Atan2 => a.atan2(b),
        Operation::SinCos => unreachable!("it has two targets"),
    }
}

/// The shipped graphs.
fn graphs() -> Vec<Graph> {
    ["dual_arm_3r", "single_arm_2r", "triple_arm_3r"].map(graph).into()
}

/// All functions of a graph by its statements and by pairs; how many statements the pairs have saved.
fn compare(graph: &Graph) -> usize {
    let mut saved = 0;
    let numbers = (0_u32..).map(|i| f64::from(i * 37 % 101) / 50.0 - 0.9);
    let inputs = graph.inputs.iter().flat_map(|input| {
        let count: usize = input.shape.iter().product();
        (0..count).map(|index| input.element(index))
    });
    let inputs = inputs.zip(numbers).map(|(name, number)| (name, [number; 2]));
    let parameters = graph.parameters.iter().map(|parameter| (parameter.name.clone(), [parameter.default; 2]));
    let none = Names::default();
    let mut start = Interpreter { values: inputs.chain(parameters).collect(), names: &none };
    start.run(&graph.constants.statements);
    for family in &graph.families {
        let mut symmetry = Symmetry::of(graph);
        let configuration = &family.configuration;
        let stage = paired(&mut symmetry, &configuration.sections, &configuration.statements, &[], &none);
        let values: Vec<&str> = configuration.values.iter().map(String::as_str).collect();
        let (fields, names) = stage.names.fields(&values);
        let mut plain = Interpreter { values: start.values.clone(), names: &none };
        plain.run(&configuration.statements);
        let mut in_pairs = Interpreter { values: start.values.clone(), names: &stage.names };
        in_pairs.run(&stage.statements);
        // a call has the fields alone
        let mut kept = start.values.clone();
        for field in fields {
            let is_pair = stage.names.is_pair(field);
            let value =
                if is_pair { in_pairs.known(field) } else { in_pairs.operand(&Operand::Name(field.to_owned())) };
            kept.insert(field.to_owned(), value);
        }
        for function in &family.functions {
            let results = function.outputs.iter().flat_map(|output| super::super::counterparts(&symmetry, output));
            let results: Vec<_> = results.collect();
            let call = paired(&mut symmetry.clone(), &function.sections, &function.statements, &results, &names);
            let mut by_statements = Interpreter { values: plain.values.clone(), names: &none };
            by_statements.run(&function.statements);
            let mut by_pairs = Interpreter { values: kept.clone(), names: &call.names };
            by_pairs.run(&call.statements);
            for element in function.outputs.iter().flat_map(|output| &output.elements) {
                let [expected, found] = [by_statements.operand(element)[0], by_pairs.operand(element)[0]];
                assert_eq!(expected.to_bits(), found.to_bits(), "{}: {element:?}", function.name);
            }
            let count = |statements: &[Statement]| statements.iter().filter(|s| s.operation != Operation::Copy).count();
            saved += count(&function.statements) - count(&call.statements);
        }
    }
    saved
}

/// Pairs give the bits of the statements that they replace, and replace them where arms are equal.
#[test]
fn pairs_have_the_bits_of_their_statements() {
    let saved: Vec<usize> = graphs().iter().map(compare).collect();
    let [dual, single, three] = saved.as_slice() else { panic!("{saved:?}") };
    assert_eq!(*single, 0, "one arm has no other");
    assert!(*dual > 700 && *three > 1000, "{saved:?}");
}

/// Two arms with an input, `x`, and a parameter, `p`, each.
fn symmetry() -> Symmetry {
    let mut symmetry = Symmetry::default();
    for [a, b] in [["x[0]", "x[1]"], ["p1", "p2"]] {
        symmetry.join(&statements(&[&format!("{a} = copy z"), &format!("{b} = copy z")]), [0, 1]);
    }
    symmetry
}

/// The statements of a stage of which `r1` and `r2` are used later, as text.
fn text(lines: &[&str]) -> Vec<String> {
    let stage = paired(&mut symmetry(), &[], &statements(lines), &[("r1", "r2")], &Names::default());
    let of = |operand: &Operand| match operand {
        Operand::Number(number) => format!("{number:?}"),
        Operand::Name(name) => name.clone(),
    };
    let line = |Statement { targets, operation, a, b }: &Statement| {
        let operands = if operation.is_unary() { of(a) } else { format!("{}, {}", of(a), of(b)) };
        format!("{} = {operation:?} {operands}", targets.names().join(","))
    };
    stage.statements.iter().map(line).collect()
}

#[test]
fn what_two_arms_do_becomes_one_statement() {
    // operands of a product in either order; what is joined twice has a name
    let lines = ["a1 = mul p1 s", "a2 = mul s p2", "r1 = sub a1 s", "r2 = sub a2 s"];
    let expected = ["s_both = Copy s & s", "a1_a2 = Mul p1 & p2, s_both", "r1_r2 = Sub a1_a2, s_both"];
    assert_eq!(text(&lines), expected);
    // halves are used where one number alone is needed
    let lines = ["a1 = div p1 s", "a2 = div p2 s", "t = add a1 a2", "r1 = mul t a1", "r2 = mul t a2"];
    let expected = ["a1_a2 = Div p1 & p2, s & s", "t = Add a1, a2", "r1_r2 = Mul t & t, a1_a2"];
    assert_eq!(text(&lines), expected);
    // from the results: nothing but the results says that b1 and b2 go together
    let lines = ["b1 = sub s u", "b2 = sub v u", "r1 = mul b1 w", "r2 = mul b2 w"];
    assert_eq!(text(&lines), ["b1_b2 = Sub s & v, u & u", "r1_r2 = Mul b1_b2, w & w"]);
    // the sines of two arms beside each other, the earlier arm's first, as they are
    let lines = ["s2,c2 = sin_cos x[1]", "s,c = sin_cos z", "s1,c1 = sin_cos x[0]", "r1 = div s1 s", "r2 = div s2 s"];
    let expected = ["s1,c1 = SinCos x[0]", "s2,c2 = SinCos x[1]", "s,c = SinCos z", "r1_r2 = Div s1 & s2, s & s"];
    assert_eq!(text(&lines), expected);
}

/// Of arms that need each other's results one after the other nothing is paired; neither is what saves nothing, another
/// operation, or a stage of very many statements.
#[test]
fn what_needs_the_other_arm_or_saves_nothing_is_not_paired() {
    let lines = ["r1 = mul s u", "b = add r1 v", "r2 = mul b u"];
    assert_eq!(text(&lines), ["r1 = Mul s, u", "b = Add r1, v", "r2 = Mul b, u"]);
    // two to be joined, and one to be parted
    let lines = ["r1 = mul p1 x[0]", "r2 = mul p2 x[1]", "t = sub r1 r2"];
    assert_eq!(text(&lines), ["r1 = Mul p1, x[0]", "r2 = Mul p2, x[1]", "t = Sub r1, r2"]);
    assert_eq!(text(&["r1 = mul s u", "r2 = div s u"]), ["r1 = Mul s, u", "r2 = Div s, u"]);
    assert_eq!(text(&["r1 = sqrt p1", "r2 = sqrt p2"]), ["r1 = Sqrt p1", "r2 = Sqrt p2"]);
    assert_eq!(text(&["r1 = min p1 s", "r2 = min p2 s"]), ["r1 = Min p1, s", "r2 = Min p2, s"]);
    let lines = |others: usize| -> usize {
        let others = (0..others).map(|i| format!("o{i} = neg s"));
        let all: Vec<String> = others.chain(["r1 = div p1 s".to_owned(), "r2 = div p2 s".to_owned()]).collect();
        text(&all.iter().map(String::as_str).collect::<Vec<_>>()).len()
    };
    assert_eq!([lines(MOST - 2), lines(MOST - 1)], [MOST - 1, MOST + 1]);
}

/// A pair's name is that of nothing else.
#[test]
fn names_of_pairs_are_new() {
    let lines = ["a1_a2 = neg s", "a1 = div p1 s", "a2 = div p2 a1_a2", "r1 = neg a1", "r2 = neg a2"];
    let expected = ["a1_a2 = Neg s", "a1_a2_pair = Div p1 & p2, s & a1_a2", "r1_r2 = Neg a1_a2_pair"];
    assert_eq!(text(&lines), expected);
}

/// A pair is kept for the next stage where both of its halves are, else the half.
#[test]
fn fields_are_pairs_of_two_values() {
    let lines = ["a1 = mul p1 s", "a2 = mul p2 s", "r1 = neg a1", "r2 = neg a2", "t = neg s"];
    let stage = paired(&mut symmetry(), &[], &statements(&lines), &[], &Names::default());
    let (fields, names) = stage.names.fields(&["r1", "t", "r2", "a2"]);
    assert_eq!(fields, ["r1_r2", "t", "a2"]);
    assert_eq!(names.halves.get("r2"), Some(&("r1_r2".to_owned(), Half::Second)));
    assert!(!names.halves.contains_key("a2") && !names.is_pair("a1_a2"));
}

/// Sections of two arms are named after both.
#[test]
fn sections_name_both_arms() {
    let lines = statements(&["a = neg s", "r1 = mul p1 s", "r2 = mul p2 s", "b = neg a"]);
    let sections = [("base", 0), ("arm 1, inertia", 1), ("arm 2, inertia", 2), ("base again", 3)];
    let sections = sections.map(|(name, start)| (name.to_owned(), start));
    let stage = paired(&mut symmetry(), &sections, &lines, &[], &Names::default());
    let expected = [("base", 0), ("arms 1 and 2, inertia", 1), ("base again", 2)];
    assert_eq!(stage.sections, expected.map(|(name, start)| (name.to_owned(), start)));
}
