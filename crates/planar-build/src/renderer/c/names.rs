//! Names of a graph that cannot be names in C.

use crate::format::Graph;
use std::collections::HashSet;

/// Keywords of C and C++ that are none of Rust, and names of the rendered text's own.
const RESERVED: &str = "alignas alignof and and_eq asm auto bitand bitor bool case catch char char8_t char16_t char32_t \
    class co_await co_return co_yield compl concept consteval constexpr constinit const_cast decltype default delete \
    double dynamic_cast explicit export float friend goto inline int long mutable namespace new noexcept not not_eq \
    nullptr operator or or_eq private protected public register reinterpret_cast requires restrict short signed sizeof \
    static_assert static_cast switch template this thread_local throw typedef typeid typename union unsigned using \
    void volatile wchar_t xor xor_eq \
    arctangent check impact_equations is_finite jacobian minimum multiply_high no_sum parameters_check pivot real reduce reduction saturated sin_cos sine_cosine \
    square_root status zero";

/// Names that are keywords, or that two things of a function have.
pub fn check_names(graph: &Graph) -> Result<(), String> {
    let reserved: HashSet<&str> = RESERVED.split_whitespace().collect();
    let functions = || graph.functions();
    let configurations = graph.families.iter().map(|family| family.configuration.statements.as_slice());
    let calls = functions().map(|function| function.statements.as_slice());
    let stages = [graph.constants.statements.as_slice()].into_iter().chain(configurations).chain(calls);
    let values = stages.flatten().flat_map(|statement| statement.targets.names());
    let variables = graph.inputs.iter().chain(functions().flat_map(|function| &function.outputs));
    let parameters = graph.parameters.iter().map(|parameter| &parameter.name);
    let mut names =
        values.chain(variables.map(|variable| variable.name.as_str())).chain(parameters.map(String::as_str));
    if let Some(name) = names.find(|name| reserved.contains(name)) {
        return Err(format!("`{name}` is a name that C, C++ or the module itself has"));
    }
    for family in &graph.families {
        for function in &family.functions {
            let stages = family.configuration.statements.iter().chain(&function.statements);
            let values = stages.flat_map(|statement| statement.targets.names());
            let variables = function.inputs.iter().chain(function.outputs.iter().map(|output| &output.name));
            let mut found = HashSet::new();
            if let Some(name) = values.chain(variables.map(String::as_str)).find(|name| !found.insert(*name)) {
                return Err(format!("`{name}` is two things of `{}`", function.name));
            }
        }
    }
    Ok(())
}
