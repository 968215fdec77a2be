//! Graph JSON to Rust text: decides names, types and operands; the templates hold the layout.

mod doc_text;
pub mod json;
mod operands;
mod wrap;

use json::{list, names, size, text};
pub use operands::camel;
use operands::{Known, Scope, array_type, collect_uses, prelude};
use planar_dynamics::standalone::PARTS;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use tera::{Context, Tera};

/// The templates, by the names under which they include each other.
const TEMPLATES: [(&str, &str); 5] = [
    ("header.rs", include_str!("../../templates/header.rs.tera")),
    ("module.rs", include_str!("../../templates/module.rs.tera")),
    ("model.rs", include_str!("../../templates/model.rs.tera")),
    ("self_test.rs", include_str!("../../templates/self_test.rs.tera")),
    ("runtime.rs", include_str!("../../templates/runtime.rs.tera")),
];

/// The key of a graph's reference vectors.
pub const VECTORS: &str = "self_test";

/// What is to be made of a graph: a module of another crate.
#[derive(Clone, Copy, Debug)]
pub struct Module<'a> {
    /// Whether it carries what it needs, or takes it from `planar_capture`, whose traits it implements.
    pub standalone: bool,
    /// Whether the text is an item `pub mod NAME { … }`, for `include!`, or a file of its own.
    pub item: bool,
    /// What it is made from, for its header.
    pub source: &'a str,
    /// The command that makes it again, for its header.
    pub command: &'a str,
}

impl Module<'_> {
    /// The module's text, formatted, with its header, and with its own test where the graph has reference vectors. The
    /// same graph and the same choices give the same bytes on every machine.
    ///
    /// # Errors
    /// A graph that is not of the format, or a template that does not render: what and where.
    pub fn render(&self, graph: &Value) -> Result<String, String> {
        let mut context = Context::from_serialize(&context(graph, self)?).map_err(|e| e.to_string())?;
        let mut tera = Tera::default();
        tera.add_raw_templates(TEMPLATES.to_vec()).map_err(|e| format!("{e:?}"))?;
        let body = tera.render("module.rs", &context).map_err(|e| format!("{e:?}"))?;
        let file = syn::parse_file(&body).map_err(|e| format!("rendered text is not Rust: {e}"))?;
        let formatted = wrap::names(&prettyplease::unparse(&file));
        let text = match graph.get(VECTORS) {
            Some(vectors) => wrap::fill(&formatted, vectors),
            None => formatted,
        };
        context.insert("text_sha256", &sha256(&text));
        let header = tera.render("header.rs", &context).map_err(|e| format!("{e:?}"))?;
        Ok(format!("{}\n\n{text}", header.trim_end()))
    }
}

/// In hexadecimal.
pub fn sha256(text: &str) -> String {
    let digest: [u8; 32] = Sha256::digest(text.as_bytes()).into();
    digest.iter().fold(String::new(), |hash, byte| hash + &format!("{byte:02x}"))
}

fn context(graph: &Value, module: &Module<'_>) -> Result<Value, String> {
    let arms = list(&graph["layout"]["arms"])?;
    let joints = arms.iter().map(|arm| size(&arm["links"])).sum::<Result<usize, _>>()?;
    let known = Known::of(graph)?;
    let families = list(&graph["families"])?
        .iter()
        .map(|family| render_family(graph, family, &known))
        .collect::<Result<Vec<_>, _>>()?;
    let set_up = Scope { known: &known, staged: BTreeSet::new(), constants: false };
    let parts: Vec<Value> = PARTS.iter().map(|(name, text)| json!({"name": name, "text": text})).collect();
    Ok(json!({
        "source": module.source,
        "command": module.command,
        "item": module.item,
        "standalone": module.standalone,
        "parts": parts,
        "self_test": graph.get(VECTORS).map(|vectors| self_test(graph, vectors)).transpose()?,
        "layout": graph["layout"],
        "casadi": graph["casadi"],
        "arms": arms.len(),
        "joints": joints,
        "size": joints + 3,
        "bodies": joints + 1,
        "coordinates": doc_text::coordinates(graph)?,
        "costs": doc_text::costs(graph)?,
        "parameters": list(&graph["parameters"])?.iter().map(parameter).collect::<Result<Vec<_>, _>>()?,
        "constants": {
            "statements": constants(graph, &set_up)?,
            "values": graph["constants"]["values"],
            "operations": doc_text::operations(&graph["constants"]["operations"])?,
        },
        "families": families,
        "table": doc_text::table(graph)?,
    }))
}

fn render_family(graph: &Value, family: &Value, known: &Known) -> Result<Value, String> {
    let name = text(&family["name"])?;
    let configuration = &family["configuration"];
    let functions = list(&family["functions"])?;
    let staged: BTreeSet<String> =
        list(&configuration["values"])?.iter().filter_map(|v| v.as_str().map(str::to_owned)).collect();
    let mut used = staged.clone();
    collect_uses(list(&configuration["statements"])?, &mut used)?;
    let scope = Scope { known, staged: BTreeSet::new(), constants: true };
    let lines = scope.blocks(&configuration["statements"], &used, &staged)?;
    let call = Scope { known, staged, constants: true };
    let rendered = functions.iter().map(|f| render_function(graph, f, &call)).collect::<Result<Vec<_>, _>>()?;
    let needs_model = rendered.iter().any(|f| f["prelude"].as_array().is_some_and(|p| !p.is_empty()));
    Ok(json!({
        "name": name,
        "type": format!("{}Configuration", camel(name)),
        "description": family["description"],
        "operations": doc_text::operations(&configuration["operations"])?,
        "base_pose": doc_text::item(input(graph, "base_pose")?)?,
        "joint_angles": doc_text::item(input(graph, "joint_angles")?)?,
        "prelude": prelude(&lines, "self."),
        "statements": lines,
        "values": configuration["values"],
        "needs_model": needs_model,
        "functions": rendered,
    }))
}

fn render_function(graph: &Value, function: &Value, scope: &Scope) -> Result<Value, String> {
    let name = text(&function["name"])?;
    let outputs = list(&function["outputs"])?;
    let mut results = BTreeSet::new();
    for output in outputs {
        results.extend(list(&output["elements"])?.iter().filter_map(|e| e.as_str().map(str::to_owned)));
    }
    let mut used = results.clone();
    collect_uses(list(&function["statements"])?, &mut used)?;
    let mut lines = scope.blocks(&function["statements"], &used, &results)?;
    let values = outputs.iter().map(|o| scope.array(o)).collect::<Result<Vec<_>, _>>()?;
    let single = outputs.len() == 1;
    let result = if single {
        values.concat()
    } else {
        let fields = outputs.iter().zip(&values).map(|(o, v)| Ok(format!("{}: {v}", text(&o["name"])?)));
        format!("{} {{ {} }}", camel(name), fields.collect::<Result<Vec<_>, String>>()?.join(", "))
    };
    lines.push(result);
    let bindings = prelude(&lines, "self.model.");
    let result = lines.pop().unwrap_or_default();
    let types = outputs.iter().map(|o| array_type(&o["shape"], "T")).collect::<Result<Vec<_>, _>>()?;
    let rendered_outputs = outputs
        .iter()
        .zip(&types)
        .map(|(o, t)| Ok(json!({"name": o["name"], "type": t, "text": doc_text::item(o)?})))
        .collect::<Result<Vec<_>, String>>()?;
    let arguments = list(&function["inputs"])?
        .iter()
        .map(text)
        .filter(|name| !matches!(name, Ok("base_pose" | "joint_angles")))
        .map(|name| {
            let input = input(graph, name?)?;
            let array = array_type(&input["shape"], "T")?;
            Ok(json!({"name": input["name"], "type": array, "text": doc_text::item(input)?}))
        })
        .collect::<Result<Vec<_>, String>>()?;
    Ok(json!({
        "name": name,
        "docs": doc_text::function(function)?,
        "struct": if single { Value::Null } else { json!(camel(name)) },
        "result_type": if single { types.concat() } else { format!("{}<T>", camel(name)) },
        "outputs": rendered_outputs,
        "arguments": arguments,
        "prelude": bindings,
        "statements": lines,
        "result": result,
    }))
}

/// Inputs and outputs of the module's own test, as the templates want them; `vectors` holds the numbers.
fn self_test(graph: &Value, vectors: &Value) -> Result<Value, String> {
    let inputs = list(&graph["inputs"])?.iter().map(|input| {
        let map = match list(&input["shape"])?.len() {
            1 => "map(T::constant)",
            _ => "map(|row| row.map(T::constant))",
        };
        Ok(json!({"name": input["name"], "type": array_type(&input["shape"], "f64")?, "map": map}))
    });
    let mut functions = Vec::new();
    for family in list(&graph["families"])? {
        for function in list(&family["functions"])? {
            let outputs = list(&function["outputs"])?;
            let found = |output: &Value| {
                let field = if outputs.len() == 1 { String::new() } else { format!(".{}", text(&output["name"])?) };
                Ok::<_, String>(match list(&output["shape"])?.len() {
                    0 => format!("core::slice::from_ref(&result{field})"),
                    1 => format!("&result{field}"),
                    _ => format!("result{field}.as_flattened()"),
                })
            };
            let compared: Vec<Value> = outputs
                .iter()
                .map(|output| Ok(json!({"name": output["name"], "found": found(output)?})))
                .collect::<Result<_, String>>()?;
            functions.push(json!({"name": function["name"], "inputs": function["inputs"], "outputs": compared}));
        }
    }
    let instants = list(vectors)?.iter().map(|instant| {
        let inputs = list(&instant["inputs"])?.iter().map(|given| {
            let name = text(&given["name"])?;
            let value = literal(list(&input(graph, name)?["shape"])?, list(&given["values"])?)?;
            Ok::<_, String>(json!({"name": name, "value": value}))
        });
        Ok(json!({"inputs": inputs.collect::<Result<Vec<_>, String>>()?, "expected": instant["expected"]}))
    });
    let instants = instants.collect::<Result<Vec<_>, String>>()?;
    Ok(json!({"inputs": inputs.collect::<Result<Vec<_>, String>>()?, "functions": functions, "instants": instants}))
}

/// Numbers as a nested array literal of a shape.
fn literal(shape: &[Value], values: &[Value]) -> Result<String, String> {
    let Some((_, inner)) = shape.split_first() else {
        return values.first().ok_or("no number".to_owned()).and_then(wrap::number);
    };
    let part: usize = inner.iter().map(size).product::<Result<_, _>>()?;
    let parts = values.chunks(part.max(1)).map(|values| literal(inner, values));
    Ok(format!("[{}]", parts.collect::<Result<Vec<_>, _>>()?.join(", ")))
}

fn input<'a>(graph: &'a Value, name: &str) -> Result<&'a Value, String> {
    list(&graph["inputs"])?
        .iter()
        .find(|i| i["name"] == json!(name))
        .ok_or_else(|| format!("input `{name}` is not declared"))
}

fn parameter(p: &Value) -> Result<Value, String> {
    let default = p["default"].as_f64().ok_or("a parameter without a default")?;
    Ok(json!({
        "name": p["name"],
        "quantity": camel(text(&p["quantity"])?),
        "arm": p["arm"].as_u64().unwrap_or(0),
        "link": p["link"].as_u64().unwrap_or(0),
        "unit": p["unit"],
        "default": format!("{default:?}"),
        "description": doc_text::escaped(text(&p["description"])?),
    }))
}

/// The statements of the constants' stage.
fn constants(graph: &Value, scope: &Scope) -> Result<Vec<String>, String> {
    let values: BTreeSet<String> = names(&graph["constants"]["values"])?.map(str::to_owned).collect();
    let mut used = values.clone();
    collect_uses(list(&graph["constants"]["statements"])?, &mut used)?;
    scope.blocks(&graph["constants"]["statements"], &used, &values)
}
