//! Halves of the functions of shipped graphs.

use super::*;
use crate::renderer::tests::graph;

/// Reduced dynamics of the paper's robot: what crosses from one half to the other of what depends on velocities is the bias
/// of six joints about the base COM, the force, and the moment.
#[test]
fn what_velocities_contribute_crosses_as_few_numbers() {
    let graph = graph("dual_arm_3r");
    let of = |name: &str| {
        let (family, function) = graph.functions_of_families().find(|(_, f)| f.name == name).expect("a function");
        in_halves(family, function, &Scope::constants(&graph, Syntax::Rust, false), Vec::new)
    };
    let lines = of("reduced_dynamics").expect("halves");
    let crossing: Vec<&String> = lines.iter().filter(|line| line.contains("read_again([")).collect();
    let [crossing] = crossing.as_slice() else { panic!("{crossing:?}") };
    assert_eq!(crossing.matches(", ").count(), 2 * 8, "{crossing}");
    let at = |part: &str| lines.iter().position(|line| line.contains(part)).unwrap_or_else(|| panic!("{part}"));
    assert!(at("arm 2, composite inertia") < at("arm 1, outward pass"));
    assert!(at("arm 2, inward pass") < at("read_again"));
    assert!(at("constants = read_again") < at("robot about the base COM"));
    for name in ["generalized_jacobian", "mass_matrix", "forward_dynamics", "momentum", "end_effector_twists"] {
        assert!(of(name).is_none(), "{name}");
    }
}

/// Each statement is in one half, after those whose results it reads.
#[test]
fn halves_keep_the_order_that_results_need() {
    for name in ["dual_arm_3r", "triple_arm_3r", "boom_7r", "single_arm_2r"] {
        let graph = graph(name);
        for (family, function) in graph.functions_of_families() {
            let Some(halves) = halves(family, function) else { continue };
            let statements: Vec<&Statement> = halves.iter().flatten().map(|(_, statement)| *statement).collect();
            assert_eq!(statements.len(), family.configuration.statements.len() + function.statements.len());
            let all: HashSet<&str> = statements.iter().flat_map(|statement| statement.targets.names()).collect();
            let mut known = HashSet::new();
            for statement in statements {
                assert!(
                    statement.reads().all(|name| known.contains(name) || !all.contains(name)),
                    "{name}: {statement:?}"
                );
                known.extend(statement.targets.names());
            }
        }
    }
}
