//! What is fused, and what it is then, for statements of a few lines.

use super::{MultiplyAdd, Operand, fuse};
use crate::renderer::tests::statements;
use std::collections::HashMap;

/// The indices of the fused sums and of the products in them.
fn fused(lines: &[&str], results: &[&str]) -> [Vec<usize>; 2] {
    let (statements, mut found) = (statements(lines), [Vec::new(), Vec::new()]);
    for (index, sum) in fuse(&statements, results, &|name| vec![name]) {
        found[usize::from(sum.is_none())].push(index);
    }
    found.map(|mut indices| {
        indices.sort_unstable();
        indices
    })
}

#[test]
fn what_is_fused_has_the_value_of_its_statements() {
    let values = HashMap::from([("a", 2.0), ("b", 3.0), ("c", 5.0)]);
    for (sum, expected) in [("add p c", 11.0), ("add c p", 11.0), ("sub p c", 1.0), ("sub c p", -1.0)] {
        let statements = statements(&["p = mul a b", &format!("s = {sum}")]);
        let found = fuse(&statements, &["s"], &|name| vec![name]);
        let [Some(None), Some(Some(MultiplyAdd { a, b, addend, is_product_negative, is_addend_negative }))] =
            [0, 1].map(|index| found.get(&index))
        else {
            panic!("{sum}: {found:?}")
        };
        let value = |operand: &Operand| values[operand.name().expect("a name")];
        let signed = |value: f64, is_negative: bool| if is_negative { -value } else { value };
        let (product, addend) = (value(a) * value(b), value(addend));
        let value = signed(product, *is_product_negative) + signed(addend, *is_addend_negative);
        assert!((value - expected).abs() < 1e-12, "{sum}: {value}, not {expected}");
    }
}

/// A product is part of a sum where nothing else uses it; other operations are part of none, and have none.
#[test]
fn products_that_are_used_once_are_fused() {
    let none: [Vec<usize>; 2] = [vec![], vec![]];
    assert_eq!(fused(&["p = mul a b", "s = add p c"], &["s"]), [vec![1], vec![0]]);
    assert_eq!(fused(&["p = mul a b", "s = add p c"], &["s", "p"]), none, "a result");
    assert_eq!(fused(&["p = mul a b", "s = add p c", "t = sub p s"], &["t"]), none, "used twice");
    assert_eq!(fused(&["p = mul a b", "s = add p p"], &["s"]), none, "used twice");
    assert_eq!(fused(&["p = div a b", "s = add p c"], &["s"]), none, "a quotient");
    assert_eq!(fused(&["p = mul a b", "s = mul p c"], &["s"]), none, "in a product");
    // each sum in its own right
    let twice = ["p = mul a b", "s = add p c", "q = mul a c", "t = sub q b", "u = mul s t"];
    assert_eq!(fused(&twice, &["u"]), [vec![1, 3], vec![0, 2]]);
}

/// Of two products in a sum the one is fused whose factors are known later, on whichever side it is. In cycles: 4 for a
/// product, a sum or both at once, 14 for a quotient, 18 for a root, 60 for a sine.
#[test]
fn of_two_products_the_one_that_is_known_later_is_fused() {
    let later: [(&[&str], &[&str]); 9] = [
        (&["x = div a b"], &["y = mul a b"]),
        (&["x = sqrt a"], &["y = div a b"]),
        (&["x,z = sin_cos a"], &["y = sqrt a"]),
        (&["u = sqrt a", "x = min u b"], &["y = sqrt a"]),
        (&["u = min a b", "x = min b u"], &["y = min a b"]),
        // 16 and 14, 14 and 12
        (&["t = mul a a", "u = mul t t", "v = mul u u", "x = mul v v"], &["y = div a b"]),
        (&["x = div a b"], &["t = mul a a", "u = mul t t", "y = mul u u"]),
        // 22 and 18, 18 and 16: a fused sum after a quotient
        (&["t = sqrt a", "x = min t t"], &["u = div a b", "v = mul u b", "y = add v c"]),
        (&["u = div a b", "v = mul b c", "x = sub v u"], &["t = mul a a", "r = mul t t", "w = mul r r", "y = mul w w"]),
    ];
    for (before, other) in later {
        for sum in ["add p q", "add q p", "sub p q", "sub q p"] {
            for [first, second] in [[before, other], [other, before]] {
                let sum = format!("s = {sum}");
                let last = ["p = mul x c", "q = mul y c", &sum];
                let lines = [first, second, &last].concat();
                let [sums, products] = fused(&lines, &["s"]);
                let p = lines.len() - 3;
                assert!(sums.contains(&(p + 2)), "{lines:?}");
                assert!(products.contains(&p) && !products.contains(&(p + 1)), "{lines:?}: {products:?}");
            }
        }
    }
}
