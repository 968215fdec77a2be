//! The build's stage of the pipeline: committed graphs in, Rust files and their index out.

use crate::layout::Layout;
use crate::render;
use std::fs;
use std::path::Path;

/// Renders the graphs of the enabled layouts to `out/NAME.rs`, with `index.rs` and `registry.rs` that list them.
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
    let (enabled, disabled): (Vec<_>, Vec<_>) = names.into_iter().partition(|name| enabled(name));
    for name in &enabled {
        let code = render_one(codegen, name)?;
        write(&out.join(format!("{name}.rs")), &code)?;
    }
    let (enabled, disabled) = (enabled.join(", "), disabled.join(", "));
    write(&out.join("index.rs"), &format!("generated!({enabled});\n"))?;
    write(&out.join("registry.rs"), &format!("registry!(enabled: [{enabled}], disabled: [{disabled}]);\n"))
}

/// Rust text of one layout's graph, after its hash was compared with the layout's.
///
/// # Errors
/// As [`render_all`].
pub fn render_one(codegen: &Path, name: &str) -> Result<String, String> {
    let mend = format!("derive it again: python -m codegen {name}");
    let layout = Layout::read(&codegen.join(format!("layouts/{name}.toml"))).map_err(|report| report.to_string())?;
    let path = codegen.join(format!("graphs/{name}.json"));
    let graph = fs::read_to_string(&path).map_err(|e| format!("{}: {e}; {mend}", path.display()))?;
    let found = render::layout_hash(&graph).map_err(|e| format!("{}: {e}; {mend}", path.display()))?;
    let wanted = layout.sha256();
    if found != wanted {
        return Err(format!(
            "{} is stale: it was derived from a layout with sha256 {found}, codegen/layouts/{name}.toml has {wanted}; {mend}",
            path.display()
        ));
    }
    render::render(&graph).map_err(|e| format!("{}: {e}; {mend}", path.display()))
}

/// Names of the files with an extension, sorted.
fn names(folder: &Path, extension: &str) -> Result<Vec<String>, String> {
    let entries = fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut names: Vec<String> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|e| e == extension))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    Ok(names)
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}
