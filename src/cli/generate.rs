//! `planar-capture generate LAYOUT.toml --out FILE.rs`.

use super::{Problem, layout};
use indicatif::{ProgressBar, ProgressStyle};
use planar_capture::build::graph::GraphError;
use planar_capture::build::{Module, command};
use planar_capture::generate::{self, Proved};
use planar_capture::layout::Layout;
use planar_capture::output::atomic_file::write_whole;
use planar_capture::python_package::PYTHON_PACKAGE;
use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// Derive the equations of a layout and write them as a Rust module for your own crate or firmware.
///
/// The first run makes a Python environment with CasADi in the user's cache folder (Python 3.11 or newer, network);
/// later ones use it. What is derived is compared with the generic implementation before anything is written.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The layout: a path, or the name of a shipped one.
    layout: String,
    /// What to write: FILE.rs for the module, FILE.json for the expression graph that build scripts render.
    #[arg(long, value_name = "FILE", value_parser = output)]
    out: Output,
    /// A module that depends on nothing, not even on planar-capture's core.
    #[arg(long)]
    standalone: bool,
    /// Write nothing; exit code 1 if FILE is not what the layout gives.
    #[arg(long)]
    check: bool,
}

/// A file to be written, by its extension.
#[derive(Clone, Debug)]
enum Output {
    Code(PathBuf),
    Graph(PathBuf),
}

fn output(text: &str) -> Result<Output, String> {
    let path = PathBuf::from(text);
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("rs") => Ok(Output::Code(path)),
        Some("json") => Ok(Output::Graph(path)),
        _ => Err("a file that ends in `.rs` (the module) or `.json` (the graph) is wanted".to_owned()),
    }
}

/// Derives, proves, writes.
pub fn run(arguments: &Arguments) -> Result<ExitCode, Problem> {
    let layout = layout::read(&arguments.layout)?;
    let (Output::Code(path) | Output::Graph(path)) = &arguments.out;
    if arguments.standalone && matches!(arguments.out, Output::Graph(_)) {
        return Err(Problem::Usage("--standalone is for a module: name FILE.rs, or leave it out for a graph"));
    }
    let own_name = path.file_stem().is_some_and(|stem| stem.to_str() == Some(layout.name.as_str()));
    if matches!(arguments.out, Output::Graph(_)) && !own_name {
        return Err(Problem::GraphName { file: path.display().to_string(), name: layout.name });
    }
    if !arguments.check {
        refuse_to_overwrite(path)?;
    }
    let file = || arguments.layout.clone();
    let progress = spinner();
    let graph_text = generate::derive(&layout, PYTHON_PACKAGE, &mut |line| show(&progress, line))
        .map_err(|source| Problem::Derivation { file: file(), source })?;
    progress.set_message("comparing with the generic implementation");
    let failed = |source| Problem::Generate { file: file(), source };
    let Proved { graph, text, proof } = generate::complete(&graph_text, &layout).map_err(failed)?;
    let text = match &arguments.out {
        Output::Graph(_) => text,
        Output::Code(_) => {
            progress.set_message("rendering");
            let (source, command) = recipe(arguments, &layout, path);
            let module = Module { standalone: arguments.standalone, item: false, source: &source, command: &command };
            module.render(&graph).map_err(|problem| failed(GraphError::Format(problem).into()))?
        }
    };
    progress.finish_and_clear();
    if arguments.check {
        return check(path, &text, arguments);
    }
    write_whole(path, |to| to.write_all(text.as_bytes()))?;
    let mut out = std::io::stdout().lock();
    let (lines, shown) = (text.lines().count(), path.display());
    writeln!(
        out,
        "{shown}: {}, {} degrees of freedom, {lines} lines\n\
         {} results agree with the generic implementation at {} states (worst {:.0e} of what rounding may do)",
        layout.name,
        layout.joints() + 3,
        proof.results,
        proof.states,
        proof.worst
    )?;
    Ok(ExitCode::SUCCESS)
}

/// Names of source and command for the header: without folders, so that the same layout gives the same bytes anywhere.
fn recipe(arguments: &Arguments, layout: &Layout, path: &Path) -> (String, String) {
    let name = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let source = if Layout::is_path(&arguments.layout) {
        name(Path::new(&arguments.layout))
    } else {
        format!("the layout {}", layout.name)
    };
    let from = if Layout::is_path(&arguments.layout) { &source } else { &layout.name };
    let command = command(from, &name(path), arguments.standalone);
    (source, command)
}

/// Whether the file is what it should be.
fn check(path: &Path, text: &str, arguments: &Arguments) -> Result<ExitCode, Problem> {
    let shown = path.display();
    if fs::read(path).is_ok_and(|found| found == text.as_bytes()) {
        writeln!(std::io::stdout().lock(), "{shown}: fresh")?;
        return Ok(ExitCode::SUCCESS);
    }
    let state = if path.exists() { "is not what the layout gives" } else { "is not there" };
    let mend = command(&arguments.layout, &shown.to_string(), arguments.standalone);
    eprintln!("{shown} {state}; to mend: {mend}");
    Ok(ExitCode::from(1))
}

/// Somebody's own file must not be lost to a slip in a name.
fn refuse_to_overwrite(path: &Path) -> Result<(), Problem> {
    let file = || path.display().to_string();
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
        return Err(Problem::NoFolder { file: file(), folder: folder.display().to_string() });
    }
    let Ok(found) = fs::metadata(path) else { return Ok(()) };
    let mut start = Vec::new();
    if found.is_file() {
        // the first bytes tell; a device or a pipe would never end
        let _ = fs::File::open(path).map(|file| file.take(64).read_to_end(&mut start));
    }
    let ours = start.starts_with(b"// @generated from ") || start.starts_with(b"{\n \"format\": ");
    if ours || (found.is_file() && found.len() == 0) { Ok(()) } else { Err(Problem::NotGenerated { file: file() }) }
}

/// What the derivation says; on a terminal the last line with a spinner, else the lines that take their time.
fn show(progress: &ProgressBar, line: &str) {
    if progress.is_hidden() {
        if line.contains("environment") {
            eprintln!("{line}");
        }
    } else {
        progress.set_message(line.to_owned());
    }
}

fn spinner() -> ProgressBar {
    let progress = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} ({elapsed})") {
        progress.set_style(style);
    }
    progress.set_message("starting Python");
    progress.enable_steady_tick(Duration::from_millis(100));
    progress
}
