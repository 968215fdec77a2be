//! What the documentation of generated code says.

use super::*;

/// A function with so many scalar outputs.
fn with_outputs(count: usize) -> Function {
    let output = json!({"name": "x", "unit": "m", "description": "how far"});
    let value = json!({
        "name": "f", "description": "It says it.", "equation": "x = 1\ny = 2", "source": "eq. (1)", "inputs": [],
        "sections": [], "statements": [], "outputs": vec![output; count], "operations": {},
    });
    serde_json::from_value(value).expect("a function")
}

/// Description, equation as text and source; what a function returns that has one output.
#[test]
fn documentation_of_a_function() {
    let begin = ["/// It says it.", "///", "/// ```text", "/// x = 1", "/// y = 2", "/// ```", "///"];
    assert_eq!(
        function(&with_outputs(1)),
        [&begin[..], &["/// eq. (1). Returns how far (scalar; m).", "///"]].concat()
    );
    assert_eq!(function(&with_outputs(2)), [&begin[..], &["/// eq. (1).", "///"]].concat());
}

#[test]
fn variables_with_their_shapes_and_units() {
    let said = |shape: &[usize]| {
        let of_shape = json!({"name": "x", "shape": shape, "unit": "m/s", "description": "[v] of *it*"});
        variable(&serde_json::from_value(of_shape).expect("a variable"))
    };
    assert_eq!(said(&[]), r"\[v\] of \*it\* (scalar; m/s)");
    assert_eq!(said(&[3]), r"\[v\] of \*it\* (3; m/s)");
    assert_eq!(said(&[2, 3]), r"\[v\] of \*it\* (2 × 3; m/s)");
}

/// The constants, then each family with its functions; kinds of operations that there are none of are 0.
#[test]
fn operations_and_coordinates_of_a_graph() {
    let function = serde_json::to_value(json!({
        "name": "f", "description": "", "equation": "", "source": "", "inputs": [], "sections": [], "statements": [],
        "outputs": [], "operations": {"mul": 1, "add": 20, "sub": 300, "div": 4, "sin_cos": 5, "neg": 1, "min": 20,
        "sqrt": 300, "atan2": 4000, "flops": 9},
    }));
    let value = json!({
        "casadi": "", "inputs": [], "parameters": [], "self_test": null,
        "layout": {"name": "it", "sha256": "", "needs_distinct_mounts": false,
                   "arms": [{"name": "a|`b`", "links": 2}, {"name": "c", "links": 1}]},
        "constants": {"statements": [], "values": [], "operations": {"div": 7}},
        "families": [{"name": "all", "description": "", "functions": [function.expect("JSON")],
                      "configuration": {"sections": [], "statements": [], "values": [], "operations": {}}}],
    });
    let graph: Graph = serde_json::from_value(value).expect("a graph");
    let kinds = ["multiplications", "additions", "divisions", "sin_cos", "other"];
    let rows = operations(&graph);
    let counts = rows.iter().map(|row| kinds.map(|kind| row[kind].as_u64().expect("a number")));
    assert_eq!(counts.collect::<Vec<_>>(), [[0, 0, 7, 0, 0], [0; 5], [1, 320, 4, 5, 4321]]);
    assert_eq!(rows.iter().map(|row| row["function"].as_str()).collect::<Vec<_>>(), [None, None, Some("f")]);
    let titles = ["the constants of a [`Model`], once", "[`Model::all_configuration`]", "[`Model::f`]"];
    assert_eq!(rows.iter().map(|row| row["title"].as_str().expect("text")).collect::<Vec<_>>(), titles);

    let texts = ["base yaw", "base x", "base y", r"`a\|'b' joint 1`", r"`a\|'b' joint 2`", "`c joint 1`"];
    let names = ["base yaw", "base x", "base y", "a|`b` joint 1", "a|`b` joint 2", "c joint 1"];
    let rows = coordinates(&graph);
    assert_eq!(rows.iter().map(|row| row["text"].as_str().expect("text")).collect::<Vec<_>>(), texts);
    assert_eq!(rows.iter().map(|row| row["unit"].as_str().expect("text")).collect::<String>(), "radmmradradrad");
    for (row, name) in rows.iter().zip(names) {
        assert_eq!(row["name"], format!("{name:?}"));
    }
}
