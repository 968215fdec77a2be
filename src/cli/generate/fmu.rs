//! `planar-capture generate LAYOUT --fmu --out NAME.fmu`.

use super::super::terminal::note;
use super::super::{CommandError, file_error};
use super::{Arguments, Language, origin};
use planar_capture::build::graph::{Graph, GraphError};
use planar_capture::fmu::{Fmu, Origin, archive, binary};
use planar_capture::generate::GenerateError;
use planar_capture::layout::Layout;
use planar_capture::output::atomic_file::write_together;
use std::fs::File;

/// Options that do not go together.
pub(super) fn check(arguments: &Arguments) -> Result<(), CommandError> {
    let path = arguments.out.display();
    let problem = match (arguments.fmu, arguments.out.extension().is_some_and(|extension| extension == "fmu")) {
        (false, true) => format!("{path}: write `--fmu` too for an FMU"),
        (true, false) => format!("{path}: `--fmu` wants a file that ends in `.fmu`"),
        (true, true) if arguments.language != Language::Rust => {
            "--language is for modules: leave it out, an FMU has its sources in C".to_owned()
        }
        (true, true) if arguments.standalone => "--standalone is for modules: leave it out for an FMU".to_owned(),
        (true, true) if !arguments.derivatives().is_empty() => {
            "--derivatives and --directional are for modules: leave them out, an FMU has no derivatives".to_owned()
        }
        (false, false) | (true, true) => return Ok(()),
    };
    Err(CommandError::Usage(problem))
}

/// The FMU of a graph, without a binary.
pub(super) fn render(graph: &Graph, layout: &Layout, arguments: &Arguments) -> Result<Fmu, CommandError> {
    let (source, command) = origin(arguments, layout);
    let origin = Origin { name: &layout.name, layout_sha256: &layout.sha256(), source: &source, command: &command };
    Fmu::new(graph, &origin)
        .map_err(|problem| file_error(&arguments.layout)(GenerateError::from(GraphError::Format(problem))))
}

/// Writes the archive, with a binary where there is a compiler; what it has is said in the result.
pub(super) fn write(mut fmu: Fmu, arguments: &Arguments) -> Result<String, CommandError> {
    let content = match binary::compile(&fmu) {
        Ok(entry) => {
            let content = format!("sources and {}", entry.path);
            fmu.entries.push(entry);
            content
        }
        Err(error) => {
            note(format_args!("{}: no binary, the FMU holds sources only: {error}", arguments.out.display()));
            "sources only".to_owned()
        }
    };
    let bytes = archive::bytes(&fmu).map_err(file_error(&arguments.layout))?;
    write_together([(arguments.out.as_path(), &bytes[..])])?;
    Ok(content)
}

/// Whether the file has everything that the FMU has; its binaries are not compared.
pub(super) fn is_fresh(fmu: &Fmu, arguments: &Arguments) -> bool {
    File::open(&arguments.out).is_ok_and(|file| archive::is_same(file, fmu))
}
