//! Rust modules from committed graphs, for build scripts: needs no Python.

use crate::command::{command, options};
use crate::graph;
use crate::pipeline::{arithmetic, fresh, names, write};
use crate::renderer::Module;
use planar_layout::layout::{Layout, sha256};
use std::fmt;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// Why a build stops. `Debug`, which `main` prints, is the message too.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct BuildError(String);

impl fmt::Debug for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl From<String> for BuildError {
    fn from(message: String) -> Self {
        Self(message)
    }
}

/// Renders every `folder/NAME.toml` with its graph `folder/NAME.json` to `$OUT_DIR/NAME.rs`, as a module `NAME` that
/// implements the traits of [`dynamics`](planar_dynamics::dynamics). `include_layout!("NAME");` includes it. Beside it is the
/// layout's text, `$OUT_DIR/NAME.layout`, for `robot!(NAME)`.
///
/// A graph holds for every layout of its structure (arms, links, exact zeros): another mass, length or name needs no other
/// graph.
///
/// `planar-capture generate layouts/NAME.toml --out layouts/NAME.json` derives a graph. The crate uses the core of
/// `planar-capture` in the generated code, and this function in its build script:
///
/// ```toml
/// [dependencies]
/// planar-capture = { path = "…", default-features = false }
///
/// [build-dependencies]
/// planar-capture = { path = "…", default-features = false, features = ["build"] }
/// ```
///
/// # Errors
/// As [`render_to`], and where `$OUT_DIR` is not set.
pub fn render(folder: impl AsRef<Path>) -> Result<(), BuildError> {
    let out = env::var_os("OUT_DIR").ok_or_else(|| "OUT_DIR is not set: call this from a build script".to_owned())?;
    render_to(folder, PathBuf::from(out))
}

/// As [`render`], into an existing folder `out` instead of `$OUT_DIR`.
///
/// # Errors
/// [`BuildError`]: a layout that is wrong, a graph that is missing, of another layout, or without a layout; each
/// with the command that mends it.
pub fn render_to(folder: impl AsRef<Path>, out: impl AsRef<Path>) -> Result<(), BuildError> {
    let (folder, out) = (folder.as_ref(), out.as_ref());
    let shown = folder.display();
    println!("cargo::rerun-if-changed={shown}");
    let layouts = names(folder, "toml").map_err(|e| format!("{e}: the folder of the layouts NAME.toml is wanted"))?;
    if layouts.is_empty() {
        return Err(BuildError(format!("there is no layout NAME.toml in {shown}")));
    }
    if let Some(orphan) = names(folder, "json")?.iter().find(|name| !layouts.contains(name)) {
        let graph = folder.join(format!("{orphan}.json"));
        let graph = graph.display();
        return Err(BuildError(format!(
            "{graph} has no layout beside it: put {orphan}.toml back, or delete the graph"
        )));
    }
    layouts.iter().try_for_each(|name| render_one(folder, name, out))
}

fn render_one(folder: &Path, name: &str, out: &Path) -> Result<(), BuildError> {
    let [layout_path, graph_path] = ["toml", "json"].map(|extension| folder.join(format!("{name}.{extension}")));
    let (from, shown) = (layout_path.display(), graph_path.display().to_string());
    // a graph that cannot be read does not say which derivatives it has; its text does
    let written = fs::read_to_string(&graph_path).unwrap_or_default();
    let with = written.lines().find(|line| line.starts_with(" \"command\": ")).map(|line| line.trim_end_matches("\","));
    let command = command(&from.to_string(), &shown, &options(with.unwrap_or_default()));
    let mend = format!("{command}{}", here());
    let (layout, graph) = fresh(&layout_path, &graph_path, graph::read_for, &mend)?;
    if layout.name != name {
        let found = &layout.name;
        return Err(BuildError(format!("{from}: name = \"{found}\" has to be the file's own name, \"{name}\"")));
    }
    if graph.self_test.is_none() {
        return Err(BuildError(format!("{shown} has no reference vectors; to mend: {mend}")));
    }
    let module = Module { standalone: false, item: true, arithmetic: arithmetic(), source: &shown, command: &command };
    let text = module.render(&graph).map_err(|e| format!("{shown}: {e}; to mend: {mend}"))?;
    let layout_text = fs::read_to_string(&layout_path).map_err(|e| format!("{from}: {e}"))?;
    write(&out.join(format!("{name}.layout")), &layout_text)?;
    Ok(write(&out.join(format!("{name}.rs")), &text)?)
}

/// Compares a module that `planar-capture generate` wrote, and that is kept with the sources, with its layout: it has
/// to be of this layout, and as it was written.
///
/// # Errors
/// [`BuildError`], with the command that mends it.
pub fn verify(module: impl AsRef<Path>, layout: impl AsRef<Path>) -> Result<(), BuildError> {
    let (module, layout) = (module.as_ref(), layout.as_ref());
    for path in [module, layout] {
        println!("cargo::rerun-if-changed={}", path.display());
    }
    let (shown, from) = (module.display(), layout.display());
    let mend = |options: &[&str]| command(&from.to_string(), &shown.to_string(), options) + &here();
    let text = fs::read_to_string(module).map_err(|e| format!("{shown}: {e}; to make it: {}", mend(&[])))?;
    let text = text.replace("\r\n", "\n"); // as some checkouts have it
    let (header, body) = text.split_once("\n\n").unwrap_or_default();
    let said = |key: &str| Some(header.split_once(key)?.1.split([',', '\n']).next().unwrap_or_default().trim());
    let wanted = Layout::read(layout).map_err(|report| report.to_string())?.sha256();
    let problem = match (said("// layout sha256 "), said("// sha256 of the text below this header ")) {
        (Some(found), _) if found != wanted => format!("was generated from another layout than {from} is now"),
        (Some(_), Some(hash)) if hash == sha256(body) => return Ok(()),
        (Some(_), Some(_)) => "was changed after it was generated".to_owned(),
        _ => {
            let make = mend(&[]);
            return Err(BuildError(format!("{shown} is not a generated module: move it away, then {make}")));
        }
    };
    Err(BuildError(format!("{shown} {problem}; to mend: {}", mend(&options(header)))))
}

/// The folder in which a command of a message has to be run.
fn here() -> String {
    let folder = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    folder.map_or_else(String::new, |folder| format!(" (in {})", folder.display()))
}
