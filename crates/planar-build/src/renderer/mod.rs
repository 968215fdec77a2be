//! Renders a graph as Rust text, or as C ([`CModule`]): decides names, types and operands; the templates hold the layout.

mod c;
mod composites;
mod doc_text;
mod fused;
mod halves;
mod loops;
mod needed;
mod pairs;
mod pivot;
mod statements;
mod symmetry;
mod syntax;
mod wrap;

pub use c::{CModule, CText, CoSimulation, CoSimulationVariable, Role};

use crate::format::{Family, Function, Graph, PIVOT, Parameter, ReferenceState, Variable};
use composites::{merged_links, steps};
use halves::in_halves;
use pairs::{Names, paired};
use pivot::Pivot;
use planar_dynamics::standalone::{IMPACT_EQUATIONS, PARTS};
use planar_layout::diagnostic::printable;
use planar_layout::layout::sha256;
use serde_json::{Value, json};
use statements::{Scope, bindings, nested};
use symmetry::Symmetry;
use syntax::Syntax;
use tera::{Context, Tera};

/// The templates, by the names under which they include each other.
const TEMPLATES: [(&str, &str); 12] = [
    ("header", include_str!("../../templates/header.tera")),
    ("module.rs", include_str!("../../templates/module.rs.tera")),
    ("model.rs", include_str!("../../templates/model.rs.tera")),
    ("steps.rs", include_str!("../../templates/steps.rs.tera")),
    ("self_test.rs", include_str!("../../templates/self_test.rs.tera")),
    ("module.h", include_str!("../../templates/module.h.tera")),
    ("module.c", include_str!("../../templates/module.c.tera")),
    ("arithmetic.c", include_str!("../../templates/arithmetic.c.tera")),
    ("steps.c", include_str!("../../templates/steps.c.tera")),
    ("self_test.c", include_str!("../../templates/self_test.c.tera")),
    ("robot.h", include_str!("../../templates/robot.h.tera")),
    ("robot.c", include_str!("../../templates/robot.c.tera")),
];

/// The form of the module that is rendered from a graph.
#[derive(Clone, Copy, Debug)]
pub struct Module<'a> {
    /// Whether it contains what it needs, or uses `planar_capture`, whose traits it then implements.
    pub standalone: bool,
    /// Whether the text is an item `pub mod NAME { … }`, for `include!`, or a file of its own.
    pub item: bool,
    /// How it computes.
    pub arithmetic: Arithmetic,
    /// The source that its header names.
    pub source: &'a str,
    /// The command that its header names, which generates it again.
    pub command: &'a str,
}

/// How a module computes what its graph says.
#[derive(Clone, Copy, Debug, Default)]
pub struct Arithmetic {
    /// Products and sums are fused, as the feature `fused` of `planar-capture` wants it.
    pub is_fused: bool,
    /// Arms of one structure are computed in pairs, where the module uses `planar_capture`: for processors that have
    /// vectors. The results have the same bits.
    pub is_paired: bool,
}

impl Module<'_> {
    /// The module's text, formatted, with its header, and with its own test where the graph has reference vectors. The
    /// same graph and the same choices give the same bytes on every machine.
    ///
    /// # Errors
    /// A template that does not render: which and where.
    pub fn render(&self, graph: &Graph) -> Result<String, String> {
        let tera = templates()?;
        let mut context = Context::from_serialize(&context(graph, self)).map_err(|e| e.to_string())?;
        let mut body = wrap::wrap(&tera.render("module.rs", &context).map_err(|e| format!("{e:?}"))?, Syntax::Rust);
        if self.standalone {
            let of_loops = graph.functions().any(Function::is_in_loops).then_some(IMPACT_EQUATIONS);
            let parts = PARTS.into_iter().chain(of_loops);
            body.extend(parts.map(|(name, text)| format!("\nmod {name} {{\n{}}}\n", indented(&alone(text), 4))));
        }
        if self.item {
            body = format!("pub mod {} {{\n{}}}\n", graph.layout.name, indented(&body, 4));
        }
        headed(&tera, &mut context, &body)
    }
}

/// A text of the core without what it has for users of the core alone: its example, traits of other crates, and pairs.
fn alone(text: &str) -> String {
    let without_example = text.split_once("//!\n//! # Example\n").map(|(before, example)| {
        let after = example.splitn(3, "//! ```").nth(2).unwrap_or_default();
        format!("{before}{}", after.strip_prefix('\n').unwrap_or(after))
    });
    let text = without_example.as_deref().unwrap_or(text);
    let foreign = ["#[cfg_attr(feature = \"serde\"", "super::both::"];
    let is_foreign = |line: &&str| foreign.iter().any(|start| line.trim_start().starts_with(start));
    let kept: Vec<&str> = text.lines().filter(|line| !is_foreign(line)).collect();
    kept.join("\n") + "\n"
}

fn templates() -> Result<Tera, String> {
    let mut tera = Tera::default();
    let templates = TEMPLATES.map(|(name, text)| (name, without_lines_of_tags(text)));
    tera.add_raw_templates(templates).map_err(|e| format!("{e:?}"))?;
    Ok(tera)
}

/// A text below its header, which is of the same form in every language.
fn headed(tera: &Tera, context: &mut Context, body: &str) -> Result<String, String> {
    context.insert("text_sha256", &sha256(body));
    let header = tera.render("header", context).map_err(|e| format!("{e:?}"))?;
    Ok(format!("{}\n\n{body}", header.trim_end()))
}

/// A template in which a line that is a tag alone leaves no line.
fn without_lines_of_tags(template: &str) -> String {
    let is_tag = |line: &str| ["{%", "{#"].iter().any(|tag| line.starts_with(tag) && line.matches(tag).count() == 1);
    let lines = template.lines().map(|line| match line.trim() {
        tag if is_tag(tag) && tag.ends_with('}') => tag.to_owned(),
        _ => format!("{line}\n"),
    });
    lines.collect()
}

fn indented(text: &str, columns: usize) -> String {
    let line = |line: &str| if line.is_empty() { "\n".to_owned() } else { format!("{:columns$}{line}\n", "") };
    text.lines().map(line).collect()
}

/// `joint_rates` as `JointRates`.
pub fn camel_case(name: &str) -> String {
    let mut starts = true;
    let letter = |c: char| {
        let shown = if starts { c.to_ascii_uppercase() } else { c };
        starts = c == '_';
        (c != '_').then_some(shown)
    };
    name.chars().filter_map(letter).collect()
}

/// The values that the templates use.
fn context(graph: &Graph, module: &Module<'_>) -> Value {
    let links: Vec<usize> = graph.layout.arms.iter().map(|arm| arm.links).collect();
    let joints: usize = links.iter().sum();
    let constants: Vec<&str> = graph.constants.values.iter().map(|constant| constant.name.as_str()).collect();
    let mut set_up = Scope::parameters(graph, Syntax::Rust).lines(&[], &graph.constants.statements, &constants);
    set_up.push(pivot::regularity());
    let symmetry =
        if module.arithmetic.is_paired && !module.standalone { Symmetry::of(graph) } else { Symmetry::default() };
    let order = symmetry.side_by_side(&constants);
    let constant = |name: &&str| graph.constants.values.iter().find(|constant| constant.name == *name);
    let mut fields: Vec<Value> = order.iter().filter_map(constant).map(|constant| json!(constant)).collect();
    fields.push(pivot::field());
    let names: Vec<Value> = fields.iter().map(|field| field["name"].clone()).collect();
    let families: Vec<_> =
        graph.families.iter().map(|family| render_family(graph, family, module, &symmetry)).collect();
    json!({
        "source": printable(module.source),
        "command": printable(module.command),
        "standalone": module.standalone,
        "self_test": graph.self_test.as_ref().map(|states| self_test(graph, states)),
        "layout": graph.layout,
        "casadi": graph.casadi,
        "arms": graph.layout.arms.len(),
        "links": links,
        "joints": joints,
        "size": joints + 3,
        "bodies": joints + 1,
        "coordinates": doc_text::coordinates(graph),
        "operations": doc_text::operations(graph),
        "parameter_names": graph.parameters.iter().map(|parameter| &parameter.name).collect::<Vec<_>>(),
        "parameters": graph.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "masses": graph.masses().map(|mass| &mass.name).collect::<Vec<_>>(),
        "constants": {"statements": body(&set_up), "values": fields, "names": names},
        "steps": steps(),
        "merged": merged_links(graph),
        "in_loops": graph.functions().any(Function::is_in_loops),
        "has_pairs": families.iter().any(|family| family["has_pairs"] == true),
        "families": families,
    })
}

/// Lines in the body of a method.
fn body(lines: &[String]) -> String {
    indented(&lines.join("\n"), 8).trim_end().to_owned()
}

fn render_family(graph: &Graph, family: &Family, module: &Module<'_>, symmetry: &Symmetry) -> Value {
    let Family { name, description, configuration, functions } = family;
    let is_fused = module.arithmetic.is_fused;
    let mut symmetry = symmetry.clone();
    let stage = paired(&mut symmetry, &configuration.sections, &configuration.statements, &[], &Names::default());
    let values: Vec<&str> = configuration.values.iter().map(String::as_str).collect();
    let scope = Scope::constants(graph, Syntax::Rust, is_fused).with_pairs(&stage.names);
    let lines = scope.lines(&stage.sections, &stage.statements, &values);
    let (fields, names) = stage.names.fields(&values);
    let field = |name: &&str| {
        let is_pair = stage.names.is_pair(name);
        let text = scope.value(name);
        json!({
            "name": name,
            "type": if is_pair { "Pair<T>" } else { "T" },
            "text": if text == **name { text } else { format!("{name}: {text}") },
        })
    };
    let shown: Vec<Value> = fields.iter().map(field).collect();
    let functions: Vec<Value> = (functions.iter())
        .map(|function| {
            let mut rendered = render_function(graph, family, function, &fields, &names, is_fused, &symmetry);
            rendered["in_one_piece"] =
                module.standalone.then(|| in_one_piece(graph, family, function, is_fused)).into();
            rendered
        })
        .collect();
    let has = |key: &str| functions.iter().any(|function| function[key] == true);
    json!({
        "name": name,
        "type": format!("{}Configuration", camel_case(name)),
        "description": description,
        "statements": body(&[bindings(&lines, "self", Syntax::Rust), lines].concat()),
        "values": shown,
        "needs_model": has("needs_model"),
        "has_pairs": stage.names.has_pairs() || has("has_pairs"),
        "functions": functions,
    })
}

fn render_function(
    graph: &Graph,
    family: &Family,
    function: &Function,
    fields: &[&str],
    names: &Names,
    is_fused: bool,
    symmetry: &Symmetry,
) -> Value {
    let Function { name, outputs, .. } = function;
    let (sections, statements) = loops::without_loops(function);
    let (roots, in_loops) = (function.roots(), function.is_in_loops());
    let pairs: Vec<_> = roots.iter().flat_map(|root| counterparts(symmetry, root)).collect();
    let stage = paired(&mut symmetry.clone(), &sections, &statements, &pairs, names);
    let scope = Scope::call(graph, fields, is_fused).with_pairs(&stage.names);
    let mut lines = scope.lines(&stage.sections, &stage.statements, &loops::names(roots));
    if in_loops {
        lines.extend(loops::in_rust(function, &scope, is_fused));
    }
    lines.extend(result(graph, family, function, &scope));
    let single = outputs.len() == 1;
    let bindings = bindings(&lines, "self.model", Syntax::Rust);
    let inputs: Vec<Value> = function.inputs.iter().map(|name| variable(input(graph, name))).collect();
    let call_inputs: Vec<Value> = graph.inputs_of_call(function).map(variable).collect();
    let call_names: Vec<&Value> = call_inputs.iter().map(|input| &input["name"]).collect();
    json!({
        "name": name,
        "docs": doc_text::function(function),
        "has_pivot": function.has_pivot(),
        "struct": (!single).then(|| camel_case(name)),
        "result_type": if single { array_type(&outputs[0].shape, "T") } else { format!("{}<T>", camel_case(name)) },
        "outputs": outputs.iter().map(variable).collect::<Vec<_>>(),
        "inputs": inputs,
        "names": function.inputs,
        "call_inputs": call_inputs,
        "call_names": call_names,
        "needs_model": !bindings.is_empty(),
        "has_pairs": stage.names.has_pairs(),
        "statements": body(&[bindings, lines].concat()),
    })
}

/// The body of a function that does not go by way of a configuration, where it has halves.
fn in_one_piece(graph: &Graph, family: &Family, function: &Function, is_fused: bool) -> Option<String> {
    let scope = Scope::constants(graph, Syntax::Rust, is_fused);
    in_halves(family, function, &scope, || result(graph, family, function, &scope)).map(|lines| body(&lines))
}

/// The expression of a function's result, after the lines that its pivot needs.
fn result(graph: &Graph, family: &Family, function: &Function, scope: &Scope<'_>) -> Vec<String> {
    let Function { name, outputs, .. } = function;
    if let [output] = outputs.as_slice() {
        return vec![scope.array(output)];
    }
    let in_loops = function.is_in_loops();
    let element = |output: &Variable, index: usize| match output.elements.get(index) {
        Some(element) if !in_loops => scope.element_of(output, index, element),
        _ if output.shape.is_empty() => output.name.clone(),
        _ => output.element(index),
    };
    let pivot = Pivot::of(graph, family, function, &element);
    let field = |output: &Variable| match &pivot {
        Some(pivot) if output.name == PIVOT => format!("    {PIVOT}: {},", pivot.value),
        _ if in_loops => format!("    {},", output.name),
        _ => format!("    {}: {},", output.name, scope.array(output)),
    };
    let fields: Vec<String> = outputs.iter().map(field).collect();
    let mut lines = pivot.map_or_else(Vec::new, |pivot| pivot.lines);
    lines.push(format!("{} {{", camel_case(name)));
    lines.extend(fields);
    lines.push("}".to_owned());
    lines
}

/// The elements of an output that are computed, with those of the other arms, each once.
fn counterparts<'a>(symmetry: &Symmetry, output: &'a Variable) -> Vec<(&'a str, &'a str)> {
    let others = symmetry.elements(&output.shape).into_iter().enumerate().filter(|(index, other)| index < other);
    let names = others.map(|(index, other)| [index, other].map(|index| output.elements.get(index)));
    names.filter_map(|[a, b]| Some((a?.name()?, b?.name()?))).collect()
}

/// Inputs, functions and states of the module's own test.
fn self_test(graph: &Graph, states: &[ReferenceState]) -> Value {
    let inputs = graph.inputs.iter().map(|input| {
        let map = if input.shape.len() == 1 { "map(T::constant)" } else { "map(|row| row.map(T::constant))" };
        json!({"name": input.name, "type": array_type(&input.shape, "f64"), "map": map})
    });
    let functions = graph.functions().map(|function| {
        let slices = function.outputs.iter().map(|output| {
            let field = if function.outputs.len() == 1 { String::new() } else { format!(".{}", output.name) };
            match output.shape.len() {
                0 => format!("core::slice::from_ref(&result{field})"),
                1 => format!("&result{field}"),
                _ => format!("result{field}.as_flattened()"),
            }
        });
        json!({"name": function.name, "inputs": function.inputs, "slices": slices.collect::<Vec<_>>()})
    });
    let double_alone = states.iter().find_map(|state| state.double_alone.as_deref()).map(printable);
    let texts = |numbers: &[f64]| numbers.iter().map(|number| format!("{number:?}")).collect::<Vec<_>>();
    let states = states.iter().map(|ReferenceState { parameters, inputs, expected, .. }| {
        let inputs = inputs.iter().map(|given| {
            json!({"name": given.name, "value": nested(&input(graph, &given.name).shape, &texts(&given.values))})
        });
        let expected = expected.iter().map(|expected| {
            let values = texts(&expected.values);
            let sizes: Vec<String> = expected.sizes.iter().map(|size| format!("{size:.1e}")).collect();
            json!({"function": expected.function, "output": expected.output, "values": values, "sizes": sizes})
        });
        json!({
            "parameters": texts(parameters),
            "inputs": inputs.collect::<Vec<_>>(),
            "expected": expected.collect::<Vec<_>>(),
        })
    });
    json!({
        "inputs": inputs.collect::<Vec<_>>(),
        "functions": functions.collect::<Vec<_>>(),
        "states": states.collect::<Vec<_>>(),
        "double_alone": double_alone,
    })
}

/// An input or an output.
fn variable(variable: &Variable) -> Value {
    json!({
        "name": variable.name,
        "type": array_type(&variable.shape, "T"),
        "text": doc_text::variable(variable),
    })
}

/// The declaration of an input.
fn input<'a>(graph: &'a Graph, name: &str) -> &'a Variable {
    graph.inputs.iter().find(|input| input.name == name).expect("a graph declares the inputs of its functions")
}

fn parameter(parameter: &Parameter) -> Value {
    json!({
        "name": parameter.name,
        "quantity": camel_case(&parameter.quantity),
        "arm": parameter.arm.unwrap_or(0),
        "link": parameter.link.unwrap_or(0),
        "unit": parameter.unit,
        "default": format!("{:?}", parameter.default),
        "description": doc_text::escaped(&parameter.description),
    })
}

fn array_type(shape: &[usize], scalar: &str) -> String {
    shape.iter().rev().fold(scalar.to_owned(), |inner, n| format!("[{inner}; {n}]"))
}

#[cfg(test)]
mod tests;
