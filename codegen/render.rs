//! Graph JSON to Rust text: decides names, types and operands; the templates hold the layout.

use serde_json::{Value, json};
use std::collections::BTreeSet;
use tera::{Context, Tera};

const MODEL: &str = include_str!("templates/model.rs.tera");
const HEADER: &str = include_str!("templates/header.rs.tera");

/// The format of the graphs that this renderer reads.
const FORMAT: u64 = 1;

/// Rust source of one graph, formatted, with its header.
///
/// # Errors
/// A graph that is not of the format, or a template that does not render: what and where.
pub fn render(graph_text: &str) -> Result<String, String> {
    let graph: Value = serde_json::from_str(graph_text).map_err(|e| format!("not JSON: {e}"))?;
    if graph["format"] != json!(FORMAT) {
        return Err(format!(
            "format {} where {FORMAT} is read: derive it again with `python -m codegen`",
            graph["format"]
        ));
    }
    let context = Context::from_serialize(&context(&graph)?).map_err(|e| e.to_string())?;
    let body = template("model.rs", MODEL, &context)?;
    let file = syn::parse_file(&body).map_err(|e| format!("rendered text is not Rust: {e}"))?;
    let header = template("header.rs", HEADER, &context)?;
    Ok(format!("{header}\n{}", prettyplease::unparse(&file)))
}

/// Content hash of the layout that a graph was derived from.
///
/// # Errors
/// A graph without one.
pub fn layout_hash(graph_text: &str) -> Result<String, String> {
    let graph: Value = serde_json::from_str(graph_text).map_err(|e| format!("not JSON: {e}"))?;
    text(&graph["layout"]["sha256"]).map(str::to_owned)
}

fn template(name: &str, source: &str, context: &Context) -> Result<String, String> {
    let mut tera = Tera::default();
    tera.add_raw_template(name, source).map_err(|e| format!("{e:?}"))?;
    tera.render(name, context).map_err(|e| format!("{e:?}"))
}

fn context(graph: &Value) -> Result<Value, String> {
    let links: Vec<u64> =
        list(&graph["layout"]["arms"])?.iter().map(|arm| arm["links"].as_u64().unwrap_or(0)).collect();
    let joints: u64 = links.iter().sum();
    let parameters: BTreeSet<&str> = names(&graph["parameters"])?.collect();
    let constants: BTreeSet<&str> = names(&graph["constants"]["values"])?.collect();
    let known = Known { parameters, constants };
    let families = list(&graph["families"])?
        .iter()
        .map(|family| render_family(graph, family, &known))
        .collect::<Result<Vec<_>, _>>()?;
    let set_up = Scope { known: &known, staged: BTreeSet::new(), parameters: "parameters.", constants: "" };
    Ok(json!({
        "layout": graph["layout"],
        "command": graph["command"],
        "casadi": graph["casadi"],
        "arms": links.len(),
        "joints": joints,
        "size": joints + 3,
        "bodies": joints + 1,
        "parameters": list(&graph["parameters"])?.iter().map(parameter).collect::<Result<Vec<_>, _>>()?,
        "constants": {
            "statements": statements(&graph["constants"]["statements"], &set_up, &constant_uses(graph)?)?,
            "values": graph["constants"]["values"],
            "operations": operations(&graph["constants"]["operations"])?,
        },
        "families": families,
        "table": table(graph)?,
    }))
}

/// Names that are fields of the model.
struct Known<'a> {
    parameters: BTreeSet<&'a str>,
    constants: BTreeSet<&'a str>,
}

/// How a name is reached in one function body.
struct Scope<'a> {
    known: &'a Known<'a>,
    staged: BTreeSet<String>,
    parameters: &'static str,
    constants: &'static str,
}

impl Scope<'_> {
    fn operand(&self, operand: &Value) -> Result<String, String> {
        if let Some(number) = operand.as_f64() {
            return Ok(match number {
                0.0 => "T::ZERO".to_owned(),
                1.0 => "T::ONE".to_owned(),
                _ => format!("T::constant({number:?})"),
            });
        }
        let name = text(operand)?;
        Ok(if self.known.parameters.contains(name) {
            format!("{}{name}", self.parameters)
        } else if self.known.constants.contains(name) {
            format!("{}{name}", self.constants)
        } else if self.staged.contains(name) {
            format!("self.{name}")
        } else {
            name.to_owned()
        })
    }
}

/// One `let` per statement. A sine or cosine that nobody uses is not bound.
fn statements(lines: &Value, scope: &Scope, used: &BTreeSet<String>) -> Result<Vec<String>, String> {
    list(lines)?
        .iter()
        .map(|line| {
            let line = list(line)?;
            let operation = text(line.get(1).ok_or("a statement without an operation")?)?;
            let arguments = line[2..].iter().map(|a| scope.operand(a)).collect::<Result<Vec<_>, _>>()?;
            let target = match &line[0] {
                Value::Array(pair) => {
                    let bound =
                        |v: &Value| text(v).map(|n| if used.contains(n) { n.to_owned() } else { "_".to_owned() });
                    format!("({}, {})", bound(&pair[0])?, bound(&pair[1])?)
                }
                single => text(single)?.to_owned(),
            };
            Ok(format!("let {target} = {};", expression(operation, &arguments)?))
        })
        .collect()
}

fn expression(operation: &str, arguments: &[String]) -> Result<String, String> {
    Ok(match (operation, arguments) {
        ("add", [a, b]) => format!("{a} + {b}"),
        ("sub", [a, b]) => format!("{a} - {b}"),
        ("mul", [a, b]) => format!("{a} * {b}"),
        ("div", [a, b]) => format!("{a} / {b}"),
        ("neg", [a]) => format!("-{a}"),
        ("copy", [a]) => a.clone(),
        ("min", [a, b]) => format!("{a}.minimum({b})"),
        ("atan2", [y, x]) => format!("{y}.atan2({x})"),
        ("sqrt", [a]) => format!("{a}.sqrt()"),
        ("sin_cos", [a]) => format!("{a}.sin_cos()"),
        _ => return Err(format!("operation `{operation}` with {} arguments is unknown", arguments.len())),
    })
}

fn render_family(graph: &Value, family: &Value, known: &Known) -> Result<Value, String> {
    let name = text(&family["name"])?;
    let configuration = &family["configuration"];
    let functions = list(&family["functions"])?;
    let staged: BTreeSet<String> =
        list(&configuration["values"])?.iter().filter_map(|v| v.as_str().map(str::to_owned)).collect();
    let mut used = staged.clone();
    collect_uses(&configuration["statements"], &mut used)?;
    let scope = Scope { known, staged: BTreeSet::new(), parameters: "parameters.", constants: "constants." };
    let lines = statements(&configuration["statements"], &scope, &used)?;
    let call = Scope { known, staged, parameters: "parameters.", constants: "constants." };
    let rendered = functions.iter().map(|f| render_function(graph, f, &call)).collect::<Result<Vec<_>, _>>()?;
    let needs_model = rendered.iter().any(|f| f["prelude"].as_array().is_some_and(|p| !p.is_empty()));
    Ok(json!({
        "name": name,
        "type": format!("{}Configuration", camel(name)),
        "description": family["description"],
        "operations": operations(&configuration["operations"])?,
        "base_pose": input_text(graph, "base_pose")?,
        "joint_angles": input_text(graph, "joint_angles")?,
        "prelude": prelude(&lines, "self."),
        "statements": lines,
        "values": configuration["values"],
        "needs_model": needs_model,
        "functions": rendered,
    }))
}

/// Binds the model's fields where a body uses them.
fn prelude(lines: &[String], path: &str) -> Vec<String> {
    ["parameters", "constants"]
        .iter()
        .filter(|field| lines.iter().any(|line| line.contains(&format!("{field}."))))
        .map(|field| format!("let {field} = &{path}{field};"))
        .collect()
}

fn render_function(graph: &Value, function: &Value, scope: &Scope) -> Result<Value, String> {
    let name = text(&function["name"])?;
    let outputs = list(&function["outputs"])?;
    let mut used = BTreeSet::new();
    collect_uses(&function["statements"], &mut used)?;
    for output in outputs {
        used.extend(list(&output["elements"])?.iter().filter_map(|e| e.as_str().map(str::to_owned)));
    }
    let mut lines = statements(&function["statements"], scope, &used)?;
    let values = outputs.iter().map(|o| array(o, scope)).collect::<Result<Vec<_>, _>>()?;
    let single = outputs.len() == 1;
    let result = if single {
        values[0].clone()
    } else {
        let fields: Vec<String> = outputs
            .iter()
            .zip(&values)
            .map(|(o, v)| Ok(format!("{}: {v}", text(&o["name"])?)))
            .collect::<Result<_, String>>()?;
        format!("{} {{ {} }}", camel(name), fields.join(", "))
    };
    lines.push(result);
    let bindings = prelude(&lines, "self.model.");
    let result = lines.pop().unwrap_or_default();
    let types = outputs.iter().map(|o| array_type(&o["shape"])).collect::<Result<Vec<_>, _>>()?;
    let rendered_outputs = outputs
        .iter()
        .zip(&types)
        .map(|(o, t)| Ok(json!({"name": o["name"], "type": t, "text": documented(o)?})))
        .collect::<Result<Vec<_>, String>>()?;
    let arguments = list(&function["inputs"])?
        .iter()
        .map(text)
        .filter(|name| !matches!(name, Ok("base_pose" | "joint_angles")))
        .map(|name| {
            let name = name?;
            let shape = &input(graph, name)?["shape"];
            Ok(json!({"name": name, "type": array_type(shape)?, "text": input_text(graph, name)?}))
        })
        .collect::<Result<Vec<_>, String>>()?;
    Ok(json!({
        "name": name,
        "docs": docs(function, outputs)?,
        "struct": if single { Value::Null } else { json!(camel(name)) },
        "result_type": if single { types[0].clone() } else { format!("{}<T>", camel(name)) },
        "outputs": rendered_outputs,
        "arguments": arguments,
        "prelude": bindings,
        "statements": lines,
        "result": result,
    }))
}

fn docs(function: &Value, outputs: &[Value]) -> Result<String, String> {
    let mut lines = vec![
        text(&function["description"])?.to_owned(),
        String::new(),
        "```text".to_owned(),
        text(&function["equation"])?.to_owned(),
        "```".to_owned(),
        String::new(),
    ];
    if let [only] = outputs {
        lines.push(format!("Returns {}.", documented(only)?));
    }
    lines.push(format!(
        "Source: {}. Operations: {}.",
        text(&function["source"])?,
        operations(&function["operations"])?
    ));
    lines.push(String::new());
    Ok(lines.iter().map(|l| format!("/// {l}").trim_end().to_owned()).collect::<Vec<_>>().join("\n"))
}

/// Description, shape and unit of an input or output.
fn documented(item: &Value) -> Result<String, String> {
    let shape: Vec<String> = list(&item["shape"])?.iter().map(Value::to_string).collect();
    let shape = if shape.is_empty() { "scalar".to_owned() } else { shape.join(" × ") };
    Ok(format!(
        "{} ({shape}; {})",
        text(&item["description"])?.replace('[', "\\[").replace(']', "\\]"),
        text(&item["unit"])?
    ))
}

fn input<'a>(graph: &'a Value, name: &str) -> Result<&'a Value, String> {
    list(&graph["inputs"])?
        .iter()
        .find(|i| i["name"] == json!(name))
        .ok_or_else(|| format!("input `{name}` is not declared"))
}

fn input_text(graph: &Value, name: &str) -> Result<String, String> {
    documented(input(graph, name)?)
}

/// Elements as a nested array literal of the output's shape.
fn array(output: &Value, scope: &Scope) -> Result<String, String> {
    let elements = list(&output["elements"])?.iter().map(|e| scope.operand(e)).collect::<Result<Vec<_>, _>>()?;
    let shape = list(&output["shape"])?;
    Ok(match shape.len() {
        0 => elements[0].clone(),
        1 => format!("[{}]", elements.join(", ")),
        _ => {
            let columns = shape[1].as_u64().and_then(|c| usize::try_from(c).ok()).ok_or("a shape is not a number")?;
            let rows: Vec<String> =
                elements.chunks(columns.max(1)).map(|row| format!("[{}]", row.join(", "))).collect();
            format!("[{}]", rows.join(", "))
        }
    })
}

fn array_type(shape: &Value) -> Result<String, String> {
    Ok(list(shape)?.iter().rev().fold("T".to_owned(), |inner, n| format!("[{inner}; {n}]")))
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
        "description": text(&p["description"])?.replace('[', "\\[").replace(']', "\\]"),
    }))
}

/// Names that any stage uses of the constants' stage.
fn constant_uses(graph: &Value) -> Result<BTreeSet<String>, String> {
    let mut used: BTreeSet<String> = names(&graph["constants"]["values"])?.map(str::to_owned).collect();
    collect_uses(&graph["constants"]["statements"], &mut used)?;
    Ok(used)
}

fn collect_uses(lines: &Value, used: &mut BTreeSet<String>) -> Result<(), String> {
    for line in list(lines)? {
        used.extend(list(line)?.iter().skip(2).filter_map(|a| a.as_str().map(str::to_owned)));
    }
    Ok(())
}

/// Operation counts as a phrase: `329 flops (168 mul, 66 add, 87 sub, 8 div), 7 sin/cos pairs`.
fn operations(counts: &Value) -> Result<String, String> {
    let counts = counts.as_object().ok_or("operation counts are missing")?;
    let of = |op: &str| counts.get(op).and_then(Value::as_u64).unwrap_or(0);
    let parts: Vec<String> =
        ["mul", "add", "sub", "div"].iter().filter(|op| of(op) > 0).map(|op| format!("{} {op}", of(op))).collect();
    let mut phrase = format!("{} flops", of("flops"));
    if !parts.is_empty() {
        phrase = format!("{phrase} ({})", parts.join(", "));
    }
    for (op, words) in [
        ("sin_cos", "sin/cos pairs"),
        ("neg", "sign changes"),
        ("min", "minima"),
        ("sqrt", "square roots"),
        ("atan2", "arctangents"),
    ] {
        if of(op) > 0 {
            phrase = format!("{phrase}, {} {words}", of(op));
        }
    }
    Ok(phrase)
}

/// One line per function for the header.
fn table(graph: &Value) -> Result<Vec<String>, String> {
    let mut lines =
        vec![format!("    {:42} {}", "parameters, once per model", operations(&graph["constants"]["operations"])?)];
    for family in list(&graph["families"])? {
        let stage = format!("{} (configuration stage)", text(&family["name"])?);
        lines.push(format!("    {stage:42} {}", operations(&family["configuration"]["operations"])?));
        for function in list(&family["functions"])? {
            lines.push(format!("    {:42} {}", text(&function["name"])?, operations(&function["operations"])?));
        }
    }
    Ok(lines)
}

fn camel(name: &str) -> String {
    name.split('_')
        .map(|word| {
            let mut letters = word.chars();
            letters.next().map_or_else(String::new, |first| first.to_ascii_uppercase().to_string() + letters.as_str())
        })
        .collect()
}

fn names(items: &Value) -> Result<impl Iterator<Item = &str>, String> {
    Ok(list(items)?.iter().filter_map(|item| item.get("name").and_then(Value::as_str)))
}

fn list(value: &Value) -> Result<&Vec<Value>, String> {
    value.as_array().ok_or_else(|| format!("a list was expected, not {value}"))
}

fn text(value: &Value) -> Result<&str, String> {
    value.as_str().ok_or_else(|| format!("a string was expected, not {value}"))
}
