//! Renders a graph as C99: a source file and its header, which contain all that they need.

mod co_simulation;
mod names;
mod self_test;
mod sine;

pub use co_simulation::{CoSimulation, CoSimulationVariable, Role};

use super::composites::{merged_links, steps};
use super::loops;
use super::needed::needed;
use super::statements::{Scope, bindings};
use super::syntax::Syntax;
use super::{doc_text, headed, indented, input, templates, wrap};
use crate::format::{Family, Function, Graph, Operand, PIVOT, Variable};
use names::check_names;
use planar_layout::diagnostic::{excerpt, printable};
use self_test::self_test;
use serde_json::{Value, json};
use tera::Context;

/// A module in C.
#[derive(Clone, Copy, Debug)]
pub struct CModule<'a> {
    /// The name under which the source includes its header, `NAME.h`.
    pub header: &'a str,
    /// The source that the files' headers name.
    pub source: &'a str,
    /// The command that they name, which generates them again.
    pub command: &'a str,
}

/// The files of a module in C.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CText {
    /// `NAME.c`.
    pub source: String,
    /// `NAME.h`.
    pub header: String,
}

impl CModule<'_> {
    /// Checks a header's name, which the source includes.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn check_header(name: &str) -> Result<(), String> {
        if name.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c)) {
            return Ok(());
        }
        let found = excerpt(name);
        Err(format!("`{found}` cannot be included: use letters, digits, `_`, `-` and `.` in the name of the file"))
    }

    /// The two files. The same graph and the same choices give the same bytes on every machine.
    ///
    /// # Errors
    /// A name that cannot be one in C, a function that is missing, a template that does not render: which and where.
    pub fn render(&self, graph: &Graph) -> Result<CText, String> {
        Self::check_header(self.header)?;
        check_names(graph)?;
        let tera = templates()?;
        let mut context = Context::from_serialize(&context(graph, self)?).map_err(|e| e.to_string())?;
        let render = |name| tera.render(name, &context).map_err(|e| format!("{e:?}"));
        let (header, source) = (render("module.h")?, wrap::wrap(&render("module.c")?, Syntax::C));
        Ok(CText { source: headed(&tera, &mut context, &source)?, header: headed(&tera, &mut context, &header)? })
    }
}

fn context(graph: &Graph, module: &CModule<'_>) -> Result<Value, String> {
    let joints: usize = graph.layout.arms.iter().map(|arm| arm.links).sum();
    let families = || graph.functions_of_families();
    let find = |name: &str| families().find(|(_, function)| function.name == name);
    for name in ["forward_dynamics", "forward_dynamics_with_base_wrench", "end_effector_twists"] {
        find(name).ok_or_else(|| format!("it has no function `{name}`"))?;
    }
    let merged = merged_links(graph).ok_or("it has not all parameters of the last links")?;
    let constants: Vec<&str> = graph.constants.values.iter().map(|constant| constant.name.as_str()).collect();
    let (sections, statements) = needed(&[(&[], &graph.constants.statements)], &constants);
    let scope = Scope::parameters(graph, Syntax::C);
    let set_up = scope.lines(&sections, &statements, &constants);
    let values = constants.iter().map(|name| json!({"name": name, "value": scope.operand(&named(name))}));
    let parameters: Vec<String> =
        graph.parameters.iter().map(|parameter| format!("parameters->{}", parameter.name)).collect();
    let of_constants: Vec<String> =
        values.clone().map(|v| v["value"].as_str().unwrap_or_default().to_owned()).collect();
    let functions: Vec<Value> = families().map(|(family, f)| function(graph, family, f)).collect();
    let mut texts = functions.iter().filter_map(|function| function["statements"].as_str()).collect::<Vec<_>>();
    texts.extend(set_up.iter().map(String::as_str));
    let in_loops = graph.functions().any(Function::is_in_loops);
    let uses = |call: &str| texts.iter().any(|text| text.contains(call));
    let name = &graph.layout.name;
    Ok(json!({
        "name": name,
        "macro": name.to_uppercase(),
        "header": module.header,
        "source": comment(&printable(module.source)),
        "command": comment(&printable(module.command)),
        "layout": graph.layout,
        "casadi": graph.casadi,
        "arms": graph.layout.arms.len(),
        "joints": joints,
        "size": joints + 3,
        "bodies": joints + 1,
        "coordinates": doc_text::coordinates(graph).iter().map(|c| json!({
            "text": comment(c["text"].as_str().unwrap_or_default()),
            "unit": c["unit"],
        })).collect::<Vec<_>>(),
        "parameters": graph.parameters.iter().map(|parameter| json!({
            "name": parameter.name,
            "unit": comment(&parameter.unit),
            "default": format!("{:?}", parameter.default),
            "description": comment(&parameter.description),
        })).collect::<Vec<_>>(),
        "constants": {
            "statements": body(&set_up),
            "values": values.collect::<Vec<_>>(),
            "names": graph.constants.values.iter().map(|constant| json!({
                "name": constant.name,
                "unit": comment(&constant.unit),
                "description": comment(&constant.description),
            })).collect::<Vec<_>>(),
            "check": sum_of_zeros("check", &of_constants),
            "parameters_check": sum_of_zeros("parameters_check", &parameters),
            "masses": graph.masses().map(|mass| &mass.name).collect::<Vec<_>>(),
        },
        "has_square_root": uses("square_root("),
        "has_arctangent": uses("arctangent("),
        "has_minimum": uses("minimum(") || in_loops,
        "in_loops": in_loops,
        "functions": functions,
        "steps": steps(),
        "merged": merged,
        "yaws": yaws(graph, find("end_effector_poses").ok_or("it has no function `end_effector_poses`")?)?,
        "sine": sine::constants(),
        "self_test": graph.self_test.as_ref().map(|states| self_test(graph, states)),
    }))
}

fn named(name: &str) -> Operand {
    Operand::Name(name.to_owned())
}

fn comment(text: &str) -> String {
    Syntax::C.comment(text)
}

/// Lines in the body of a function.
fn body(lines: &[String]) -> String {
    indented(&lines.join("\n"), 4).trim_end().to_owned()
}

/// Lines that assign 0, or NaN where one of the values is not finite.
fn sum_of_zeros(name: &str, values: &[String]) -> String {
    let mut lines = Vec::new();
    for (index, some) in values.chunks(4).enumerate() {
        let products: Vec<String> = some.iter().map(|value| format!("({value} * zero)")).collect();
        let (declared, sum) = (if index == 0 { "real " } else { "" }, if index == 0 { "=" } else { "+=" });
        lines.push(format!("{declared}{name} {sum} {};", products.join(" + ")));
    }
    if lines.is_empty() {
        lines.push(format!("const real {name} = zero;"));
    }
    body(&lines)
}

fn function(graph: &Graph, family: &Family, function: &Function) -> Value {
    let Function { name, outputs, sections, statements, .. } = function;
    let scope = Scope::constants(graph, Syntax::C, false);
    let results = loops::names(function.roots());
    let configuration = &family.configuration;
    let stages = [(&configuration.sections[..], &configuration.statements[..]), (sections, statements)];
    let (sections, statements) = needed(&stages, &results);
    let mut lines = scope.lines(&sections, &statements, &results);
    let is_pivot = |output: &&Variable| output.name == PIVOT;
    let stored: Vec<&Variable> = outputs.iter().filter(|output| !is_pivot(output)).collect();
    let (pivot, check) = if function.is_in_loops() {
        let (in_loops, pivot) = loops::in_c(function, &scope);
        lines.extend(in_loops);
        let finite = stored.iter().map(|output| format!("is_finite({}, {}U)", output.name, output.elements.len()));
        let finite = finite.collect::<Vec<_>>().join(" && ");
        (Some(pivot), format!("    const real check = ({finite}) ? zero : (real)-1.0;"))
    } else {
        let mut checked: Vec<String> = Vec::new();
        for output in &stored {
            for (index, element) in output.elements.iter().enumerate() {
                let (value, place) = (scope.operand(element), format!("{}[{index}]", output.name));
                lines.push(format!("{place} = {};", scope.element_of(output, index, element)));
                let value = if output.is_angle(index) { place } else { value };
                if element.name().is_some() && !checked.contains(&value) {
                    checked.push(value);
                }
            }
        }
        let pivot = outputs.iter().find(is_pivot).and_then(|output| output.elements.first());
        (pivot.map(|element| scope.operand(element)), sum_of_zeros("check", &checked))
    };
    let text = format!("{}\n{check}\n{}", lines.join("\n"), pivot.as_deref().unwrap_or_default());
    let inputs: Vec<&Variable> = function.inputs.iter().map(|name| input(graph, name)).collect();
    let is_unused = |name: &&str| pivot.is_none() && !text.contains(&format!("{name}["));
    let mut unused: Vec<&str> = inputs.iter().map(|input| input.name.as_str()).filter(is_unused).collect();
    let bindings = bindings(&lines, "model", Syntax::C);
    if bindings.is_empty() {
        unused.push("model");
    }
    json!({
        "name": name,
        "docs": doc_text::function_lines(function).iter().map(|line| comment(line)).collect::<Vec<_>>(),
        "inputs": inputs.iter().map(|input| variable(input)).collect::<Vec<_>>(),
        "outputs": stored.iter().map(|output| variable(output)).collect::<Vec<_>>(),
        "unused": unused,
        "statements": body(&[bindings, lines].concat()),
        "check": check,
        "pivot": pivot,
    })
}

/// An input or an output.
fn variable(variable: &Variable) -> Value {
    json!({
        "name": variable.name,
        "length": variable.shape.iter().product::<usize>(),
        "text": comment(&doc_text::plain_variable(variable)),
    })
}

/// The yaws of the end effectors, arm by arm, by the statements of their poses.
fn yaws(graph: &Graph, (family, poses): (&Family, &Function)) -> Result<Value, String> {
    let scope = Scope::constants(graph, Syntax::C, false);
    let elements = poses.outputs.first().map_or(&[][..], |output| &output.elements);
    let yaws: Vec<&Operand> = elements.iter().step_by(3).collect();
    if yaws.len() != graph.layout.arms.len() {
        return Err("`end_effector_poses` has not three elements for each arm".to_owned());
    }
    let results: Vec<&str> = yaws.iter().filter_map(|yaw| yaw.name()).collect();
    let configuration = &family.configuration;
    let stages = [(&configuration.sections[..], &configuration.statements[..]), (&poses.sections, &poses.statements)];
    let (sections, statements) = needed(&stages, &results);
    let lines = scope.lines(&sections, &statements, &results);
    let values: Vec<String> = yaws.iter().map(|yaw| Syntax::C.saturated(&scope.operand(yaw))).collect();
    Ok(json!({"statements": body(&[bindings(&lines, "model", Syntax::C), lines].concat()), "values": values}))
}
