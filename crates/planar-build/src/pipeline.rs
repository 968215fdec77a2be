//! The build's stage of the pipeline: committed graphs in, Rust files and their index out.
//!
//! # Example
//! ```
//! use planar_build::Arithmetic;
//! use planar_build::pipeline::{names, render_one};
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
//! assert_eq!(names(folder.as_ref(), "txt")?, ["requirements", "requirements-dev"]);
//! let text = render_one(folder.as_ref(), "single_arm_2r", Arithmetic::default())?;
//! assert!(text.contains("\npub mod single_arm_2r {\n"));
//! assert!(text.contains("\n    pub const JOINTS: usize = 2;\n"));
//! # Ok::<(), String>(())
//! ```

use crate::graph::{self, Graph, GraphError};
use crate::renderer::{Arithmetic, Module};
use crate::sources::sources;
use planar_layout::layout::Layout;
use planar_layout::structure::Structure;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The whole build script of the crate that ships the layouts in `codegen`: [`render_all`] into `$OUT_DIR`, for the
/// layouts whose cargo features are on; ends the process with exit code 1 where that fails.
pub fn build(codegen: &str) {
    println!("cargo::rerun-if-changed={codegen}");
    println!("cargo::rustc-env=PLANAR_CAPTURE_FEATURES={}", features().join(","));
    let out = std::env::var_os("OUT_DIR").unwrap_or_default();
    let enabled = |layout: &str| is_on(&layout.to_uppercase());
    let out: &Path = out.as_ref();
    let carried = || if is_on("CLI") { carry_sources(out) } else { Ok(()) };
    if let Err(problem) = render_all(codegen.as_ref(), out, &enabled).and_then(|()| carried()) {
        eprintln!("{problem}");
        std::process::exit(1);
    }
}

/// Writes `sources.rs`, which lists the sources that the program carries.
fn carry_sources(out: &Path) -> Result<(), String> {
    let files = sources(Path::new(""))?;
    // a file that is new has to be carried
    for top in files.iter().filter_map(|file| file.split('/').next()).collect::<BTreeSet<_>>() {
        println!("cargo::rerun-if-changed={top}");
    }
    let list: Vec<String> = files.iter().map(|file| format!("    {file:?},\n")).collect();
    write(&out.join("sources.rs"), &format!("sources!(\n{});\n", list.concat()))
}

/// The cargo features that are on, sorted, in lower case as this repository writes them; `default` only lists others.
fn features() -> Vec<String> {
    let names =
        std::env::vars_os().filter_map(|(name, _)| Some(name.to_str()?.strip_prefix("CARGO_FEATURE_")?.to_lowercase()));
    let mut names: Vec<_> = names.filter(|name| name != "default").collect();
    names.sort();
    names
}

/// Renders the graphs of the enabled layouts to `out/NAME.rs`, with `index.rs` and `registry.rs` that list them,
/// `graphs.rs` that lists all graphs (feature `std`), and `package.rs` that lists the derivation's Python files.
///
/// # Errors
/// A graph that cannot be read or rendered, or is not its layout's: which, and the command that mends it.
pub fn render_all(codegen: &Path, out: &Path, enabled: &dyn Fn(&str) -> bool) -> Result<(), String> {
    let names = names(&codegen.join("layouts"), "toml")?;
    let graphs = self::names(&codegen.join("graphs"), "json")?;
    if let Some(orphan) = graphs.iter().find(|name| !names.contains(name)) {
        return Err(format!(
            "codegen/graphs/{orphan}.json has no layout codegen/layouts/{orphan}.toml: put it back, or delete the graph"
        ));
    }
    // what files and scenarios need: the core evaluates no graphs
    let has_files = is_on("STD");
    let mut carried = Vec::new();
    for name in &names {
        if enabled(name) || has_files {
            let graph = fresh_in(codegen, ["layouts", "graphs"], name)?;
            if enabled(name) {
                write(&out.join(format!("{name}.rs")), &rendered(&graph, codegen, name, arithmetic())?)?;
            }
            carried.push(carried_graph(&graph, codegen, "graphs", name)?);
        }
    }
    if has_files {
        for name in &self::names(&codegen.join("structures"), "toml")? {
            let graph = fresh_in(codegen, ["structures"; 2], name)?;
            carried.push(carried_graph(&graph, codegen, "structures", name)?);
        }
        write(&out.join("graphs.rs"), &format!("graphs! {{\n{}}}\n", carried.concat()))?;
    }
    let (enabled, disabled): (Vec<_>, Vec<_>) = names.into_iter().partition(|name| enabled(name));
    let include = |name: &String| format!("include!(concat!(env!(\"OUT_DIR\"), \"/{name}.rs\"));\n");
    write(&out.join("index.rs"), &enabled.iter().map(include).collect::<String>())?;
    let (enabled, disabled) = (enabled.join(", "), disabled.join(", "));
    write(&out.join("registry.rs"), &format!("registry!(enabled: [{enabled}], disabled: [{disabled}]);\n"))?;
    let package = self::names(codegen, "py")?.join("\", \"");
    write(&out.join("package.rs"), &format!("package!(\"{package}\");\n"))
}

/// What a program needs to know of a graph that it carries before it reads it: name, folder, and structure.
fn carried_graph(graph: &Graph, codegen: &Path, folder: &str, name: &str) -> Result<String, String> {
    let Structure { links, parameters, needs_distinct_mounts } =
        graph::structure(graph).map_err(|e| format!("{}: {e}", graph_path(codegen, folder, name).display()))?;
    let parameters: Vec<_> = parameters.iter().map(|(kind, arm, link)| format!("({kind:?}, {arm}, {link})")).collect();
    let parameters = parameters.join(", ");
    Ok(format!("    {name} in {folder}: {links:?}, [{parameters}], {needs_distinct_mounts};\n"))
}

/// The graph of a layout in one of two folders, by the name of both.
fn fresh_in(codegen: &Path, [layouts, graphs]: [&str; 2], name: &str) -> Result<Graph, String> {
    let layout = codegen.join(format!("{layouts}/{name}.toml"));
    fresh(&layout, &graph_path(codegen, graphs, name), graph::read, &derivation(name)).map(|(_, graph)| graph)
}

/// Rust text of one layout's graph, after its hash was compared with the layout's.
///
/// # Errors
/// As [`render_all`].
pub fn render_one(codegen: &Path, name: &str, arithmetic: Arithmetic) -> Result<String, String> {
    rendered(&fresh_in(codegen, ["layouts", "graphs"], name)?, codegen, name, arithmetic)
}

fn rendered(graph: &Graph, codegen: &Path, name: &str, arithmetic: Arithmetic) -> Result<String, String> {
    let (source, command) = (format!("codegen/graphs/{name}.json"), derivation(name));
    let module = Module { standalone: false, item: true, arithmetic, source: &source, command: &command };
    let path = graph_path(codegen, "graphs", name);
    module.render(graph).map_err(|e| format!("{}: {e}; generate it again: {command}", path.display()))
}

fn graph_path(codegen: &Path, folder: &str, name: &str) -> PathBuf {
    codegen.join(format!("{folder}/{name}.json"))
}

/// The command that derives the graph of a layout of this repository.
fn derivation(name: &str) -> String {
    format!("python -m codegen {name}")
}

/// As the crate that is built wants it: fused where it has a feature `fused` that is on, in pairs where the processor that
/// it is built for, outside of a build script this one, has vectors of two `f64`, whatever it has beside them.
#[must_use]
pub fn arithmetic() -> Arithmetic {
    let processor = std::env::var("CARGO_CFG_TARGET_ARCH").unwrap_or_else(|_| std::env::consts::ARCH.to_owned());
    let has_vectors = ["x86_64", "aarch64"].contains(&processor.as_str());
    Arithmetic { is_fused: is_on("FUSED"), is_paired: has_vectors }
}

/// Whether the crate that is built has a feature, and it is on; the name in capitals.
fn is_on(feature: &str) -> bool {
    std::env::var_os(format!("CARGO_FEATURE_{feature}")).is_some()
}

/// A layout and its graph, by a reader that compares them; `command` makes the graph again. With the feature `prove` the
/// graph is proved: interpreted, and compared with the generic implementation.
///
/// # Errors
/// What is wrong with either, or that the graph is not the layout's, with the command.
pub fn fresh(
    layout_path: &Path,
    graph_path: &Path,
    read: impl Fn(&str, &Layout) -> Result<Graph, GraphError>,
    command: &str,
) -> Result<(Layout, Graph), String> {
    let layout = Layout::read(layout_path).map_err(|report| report.to_string())?;
    let mend = |e: &dyn std::fmt::Display| format!("{}: {e}; generate it again: {command}", graph_path.display());
    let text = fs::read_to_string(graph_path).map_err(|e| mend(&e))?;
    let graph = read(&text, &layout).map_err(|e| mend(&e))?;
    #[cfg(feature = "prove")]
    crate::prove::prove(&layout, &graph).map_err(|e| mend(&e))?;
    Ok((layout, graph))
}

/// Names of the files with an extension, sorted.
///
/// # Errors
/// A folder that cannot be read.
pub fn names(folder: &Path, extension: &str) -> Result<Vec<String>, String> {
    let entries = fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut names: Vec<String> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|e| e == extension))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    Ok(names)
}

pub(crate) fn write(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}
