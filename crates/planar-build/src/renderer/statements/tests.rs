//! Lines of Rust for statements of a few lines.

use super::*;
use crate::renderer::tests::statements;

/// The lines for statements without a section, of which `x` is the result.
fn lines(lines: &[&str]) -> Vec<String> {
    let statements = statements(lines);
    Scope::default().lines(&[], &statements, &["x"])
}

/// The last line, without `let x = `.
fn value(of: &[&str]) -> String {
    let lines = lines(of);
    let [line] = lines.as_slice() else { panic!("{lines:?}") };
    line.strip_prefix("let x = ").and_then(|rest| rest.strip_suffix(';')).expect("a line of x").to_owned()
}

/// Parentheses are where the order of the operations needs them, and nowhere else.
#[test]
fn the_order_of_operations_is_kept() {
    for (inner, outer, expected) in [
        ("add a b", "add i1 c", "a + b + c"),
        ("add a b", "add c i1", "c + (a + b)"),
        ("sub a b", "sub c i1", "c - (a - b)"),
        ("sub a b", "sub i1 c", "a - b - c"),
        ("mul a b", "sub c i1", "c - a * b"),
        ("mul a b", "add i1 c", "a * b + c"),
        ("add a b", "mul i1 c", "(a + b) * c"),
        ("add a b", "mul c i1", "c * (a + b)"),
        ("mul a b", "mul i1 c", "a * b * c"),
        ("mul a b", "mul c i1", "c * (a * b)"),
        ("div a b", "div c i1", "c / (a / b)"),
        ("neg a", "mul b i1", "b * -a"),
        ("neg a", "sub b i1", "b - -a"),
        ("add a b", "neg i1", "-(a + b)"),
        ("mul a b", "neg i1", "-(a * b)"),
        ("neg a", "neg i1", "--a"),
        ("neg a", "sqrt i1", "(-a).sqrt()"),
        ("copy a", "sqrt i1", "a.sqrt()"),
        ("sqrt a", "neg i1", "-a.sqrt()"),
        ("add a b", "min i1 c", "T::minimum(a + b, c)"),
        ("sub a b", "atan2 c i1", "T::atan2(c, a - b)"),
        ("min a b", "mul i1 c", "T::minimum(a, b) * c"),
    ] {
        assert_eq!(value(&[&format!("i1 = {inner}"), &format!("x = {outer}")]), expected);
    }
}

/// Numbered values that are used once, in their section, are written there while they are short.
#[test]
fn values_that_are_used_once_are_written_there() {
    assert_eq!(lines(&["i = mul a b", "x = add i c"]), ["let i = a * b;", "let x = i + c;"], "a name of its own");
    assert_eq!(lines(&["i2x = mul a b", "x = add i2x c"]), ["let i2x = a * b;", "let x = i2x + c;"]);
    assert_eq!(lines(&["i1 = mul a b", "x = add i1 i1"]), ["let i1 = a * b;", "let x = i1 + i1;"], "used twice");
    let long = ["a".repeat(OPERAND - 4), "a".repeat(OPERAND - 3)];
    assert_eq!(lines(&[&format!("i1 = mul {} b", long[0]), "x = neg i1"]), [format!("let x = -({} * b);", long[0])]);
    assert_eq!(lines(&[&format!("i1 = mul {} b", long[1]), "x = neg i1"]).len(), 2, "too long");
    let results = statements(&["i1 = mul a b", "x = add i1 c"]);
    assert_eq!(Scope::default().lines(&[], &results, &["x", "i1"]), ["let i1 = a * b;", "let x = i1 + c;"], "a result");
}

/// A section begins with its name, once; a value of an earlier one has a line there.
#[test]
fn sections_are_named_where_they_begin() {
    let all = statements(&["i1 = mul a b", "i2 = add i1 c", "i3 = sub i2 c", "x = add i3 i2"]);
    let sections = [("before".to_owned(), 1), ("after".to_owned(), 3)];
    let expected =
        ["let i1 = a * b;", "// before", "let i2 = i1 + c;", "let i3 = i2 - c;", "// after", "let x = i3 + i2;"];
    assert_eq!(Scope::default().lines(&sections, &all, &["x"]), expected);
}

/// Angles one after the other have one line; a sine or cosine that nothing uses has no name.
#[test]
fn sines_and_cosines_of_angles() {
    let all = [
        "s1,c1 = sin_cos a",
        "i1 = add a b",
        "s2,c2 = sin_cos i1",
        "s3,c3 = sin_cos b",
        "i2 = mul s1 s2",
        "x = mul i2 c3",
    ];
    let expected =
        ["let (s1, _) = a.sin_cos();", "let [(s2, _), (_, c3)] = T::sin_cos_all([a + b, b]);", "let x = s1 * s2 * c3;"];
    assert_eq!(lines(&all), expected);
    assert_eq!(lines(&["i1 = add a b", "x,c1 = sin_cos i1"]), ["let (x, _) = (a + b).sin_cos();"]);
}

/// Sums of angles come first, with what they are sums of; an angle of the parameters is none.
#[test]
fn sines_and_cosines_of_sums() {
    let all = statements(&[
        "i1 = add base_pose[0] mount",
        "i2 = add joint_angles[1] i1",
        "s1,c1 = sin_cos base_pose[0]",
        "s2,c2 = sin_cos i2",
        "i3 = mul s1 s2",
        "x = mul i3 c2",
    ]);
    let shapes = [("base_pose", &[3][..]), ("joint_angles", &[2])];
    let parameters = HashSet::from(["mount"]);
    let of = |syntax| Scope { syntax, inputs: shapes.into(), parameters: parameters.clone(), ..Scope::default() };
    let rust = [
        "let i2 = joint_angles[1] + (base_pose[0] + parameters.mount);",
        "let [(s2, c2), (s1, _)] = T::sin_cos_of_sums([i2, base_pose[0]], [base_pose[0], parameters.mount], joint_angles);",
        "let x = s1 * s2 * c2;",
    ];
    assert_eq!(of(Syntax::Rust).lines(&[], &all, &["x"]), rust);
    let c = of(Syntax::C).lines(&[], &all, &["x"]).concat();
    let terms = "const real terms_of_s2 = (base_pose[0] * zero) + (parameters->mount * zero) + (joint_angles[0] * zero) \
                 + (joint_angles[1] * zero);";
    assert!(c.contains(terms) && c.contains("of_s1 = sin_cos(base_pose[0], terms_of_s2);"), "{c}");
    let alone = statements(&["s,x = sin_cos joint_angles[0]"]);
    assert_eq!(of(Syntax::Rust).lines(&[], &alone, &["x"]), ["let (_, x) = joint_angles[0].sin_cos();"]);
}

#[test]
fn fused_products_have_their_signs() {
    let fused = Scope { is_fused: true, ..Scope::default() };
    for (sum, expected) in [
        ("add i1 c", "T::mul_add(a, b, c)"),
        ("add c i1", "T::mul_add(a, b, c)"),
        ("sub i1 c", "T::mul_add(a, b, -c)"),
        ("sub c i1", "T::mul_add(-a, b, c)"),
    ] {
        let sum = statements(&["i1 = mul a b", &format!("x = {sum}")]);
        assert_eq!(fused.lines(&[], &sum, &["x"]), [format!("let x = {expected};")]);
    }
    let nested = statements(&["i1 = add a c", "i2 = mul i1 b", "x = sub c i2"]);
    assert_eq!(fused.lines(&[], &nested, &["x"]), ["let x = T::mul_add(-(a + c), b, c);"]);
}

/// More lines than a block has are in blocks, each with the values that are used after it; as many are in none.
#[test]
fn long_stages_are_in_blocks() {
    let chain = |count: usize| {
        let next = |i: usize| format!("v_{} = add v_{i} v_{i}", i + 1);
        let all: Vec<String> = (0..count).map(next).chain([format!("x = add v_{count} v_1")]).collect();
        lines(&all.iter().map(String::as_str).collect::<Vec<_>>())
    };
    let short = chain(BLOCK - 1);
    assert_eq!((short.len(), short[0].as_str()), (BLOCK, "let v_1 = v_0 + v_0;"));
    let long = chain(BLOCK);
    assert_eq!(long.first().map(String::as_str), Some(&*format!("let [v_1, v_{BLOCK}] = {{")));
    assert_eq!(long[1], "    let v_1 = v_0 + v_0;");
    let end = [format!("    [v_1, v_{BLOCK}]"), "};".to_owned(), "let [x] = {".to_owned()];
    assert_eq!(long[BLOCK + 1..BLOCK + 4], end);
    assert_eq!(long[BLOCK + 4..], [&*format!("    let x = v_{BLOCK} + v_1;"), "    [x]", "};"]);
}

/// Blocks hand on numbers and pairs in an array each; an array of nothing would have no type.
#[test]
fn blocks_end_with_numbers_and_pairs() {
    let first = |last: &str| {
        let next = |i: usize| format!("v_{} = add v_{i} v_{i}", i + 1);
        let all: Vec<String> =
            (0..BLOCK - 1).map(next).chain(["p = neg v_1".to_owned(), format!("x = {last}")]).collect();
        let statements = statements(&all.iter().map(String::as_str).collect::<Vec<_>>());
        let names = Names { pairs: ["p".to_owned()].into(), ..Names::default() };
        Scope::default().with_pairs(&names).lines(&[], &statements, &["x"]).swap_remove(0)
    };
    assert_eq!(first("add v_1 p"), "let ([v_1], [p]) = {");
    assert_eq!(first("neg p"), "let [p] = {");
}

#[test]
fn arrays_have_their_shapes() {
    let elements = ["a", "b", "c", "d"].map(str::to_owned);
    assert_eq!(nested(&[], &elements[..1]), "a");
    assert_eq!(nested(&[4], &elements), "[a, b, c, d]");
    assert_eq!(nested(&[2, 2], &elements), "[[a, b], [c, d]]");
    assert_eq!(nested(&[0, 0], &[]), "[]");
}

#[test]
fn fields_that_are_used_are_bound() {
    let lines = |text: &str| bindings(&[text.to_owned()], "self", Syntax::Rust);
    assert!(lines("let x = a + b;").is_empty());
    assert_eq!(lines("let x = constants.a;"), ["let constants = &self.constants;"]);
    let both = ["let parameters = &self.parameters;", "let constants = &self.constants;"];
    assert_eq!(lines("let x = constants.a + parameters.b;"), both);
}
