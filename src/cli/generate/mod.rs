//! `planar-capture generate LAYOUT.toml --out FILE.rs`: derives a layout and writes its module, in Rust or C, or its FMU.

mod fmu;

use super::out_file::check_folder;
use super::progress::spinner;
use super::terminal::{note, print};
use super::{CommandError, derive, file_error, layout};
use planar_capture::build::graph::{Graph, GraphError};
use planar_capture::build::{Arithmetic, CModule, CText, Module, command};
use planar_capture::fmu::{Fmu, archive};
use planar_capture::generate::{GenerateError, Proved};
use planar_capture::layout::Layout;
use planar_capture::output::atomic_file::write_together;
use planar_capture::registry::Robots;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture generate mine.toml --out mine.rs
  planar-capture generate mine.toml --pairs --derivatives --out mine.rs
  planar-capture generate dual_arm_3r --language c --out dual_arm_3r.c
  planar-capture generate dual_arm_3r --fmu --out dual_arm_3r.fmu";

/// Write the equations of a layout as a module in Rust or C, or as an FMU.
///
/// Modules are for your own program or firmware, FMUs for other simulators; docs/c.md describes the modules in C,
/// docs/fmu.md the FMU.
///
/// The first run makes a Python environment with CasADi in the user's cache folder (Python 3.11 or newer, network);
/// later ones use it. The derived functions are compared with the generic implementation before a file is written.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
#[allow(clippy::struct_excessive_bools, reason = "each is an option of its own")]
pub struct Arguments {
    /// The layout: a path, or the name of a shipped one.
    layout: String,
    /// What to write: FILE.rs for the module, FILE.c (with FILE.h beside it) for that in C, FILE.fmu for the FMU, FILE.json
    /// for the expression graph that build scripts render.
    #[arg(long, value_name = "FILE", value_parser = output)]
    out: PathBuf,
    /// The language of the module.
    #[arg(long, value_enum, default_value_t = Language::Rust)]
    language: Language,
    /// An FMU for co-simulation by FMI 3.0, with its sources in C, and a binary for this machine where there is a C compiler
    /// (`cc`, or what the variable `CC` names).
    #[arg(long)]
    fmu: bool,
    /// A module without dependencies, not even on planar-capture's core.
    #[arg(long)]
    standalone: bool,
    /// Compute arms of as many links in pairs: for processors with vectors (x86-64, aarch64), the same bits in less time.
    /// Build scripts that render the graph choose this by their target.
    #[arg(long)]
    pairs: bool,
    /// Matrices of derivatives, too: of forward dynamics by position, velocity and forces, and of impacts by position,
    /// velocity, contacts and target twists; or of one of them, `=forward_dynamics` or `=impact`.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "forward_dynamics,impact", value_parser = MATRICES)]
    derivatives: Vec<String>,
    /// Directional derivatives of these functions, too; of `FUNCTION:parameters` also along the parameters.
    #[arg(long, value_name = "FUNCTION,...", value_delimiter = ',', value_parser = directional)]
    directional: Vec<String>,
    /// Write nothing; exit code 1 if FILE is not up to date.
    #[arg(long)]
    check: bool,
}

/// A language of modules.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Language {
    Rust,
    /// C99, without dependencies.
    C,
}

/// What there are matrices of derivatives of.
const MATRICES: [&str; 2] = ["forward_dynamics", "impact"];

fn output(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if ["rs", "c", "fmu", "json"].iter().any(|extension| has_extension(&path, extension)) {
        Ok(path)
    } else {
        Err("expected a file that ends in `.rs` or `.c` (the module), `.fmu` (the FMU) or `.json` (the graph)"
            .to_owned())
    }
}

/// A name that can be one of a function; the derivation knows which there are.
fn directional(text: &str) -> Result<String, String> {
    let name = text.strip_suffix(":parameters").unwrap_or(text);
    if Layout::is_name(name) {
        Ok(text.to_owned())
    } else {
        Err("expected names of functions, such as `momentum` or `full_impact:parameters`".to_owned())
    }
}

impl Arguments {
    /// The options that ask for derivatives.
    fn derivatives(&self) -> Vec<String> {
        let mut options = Vec::new();
        let named: Vec<&str> =
            MATRICES.into_iter().filter(|name| self.derivatives.iter().any(|asked| asked == name)).collect();
        match named.len() {
            0 => {}
            2 => options.push("--derivatives".to_owned()),
            _ => options.push(format!("--derivatives={}", named.join(","))),
        }
        if !self.directional.is_empty() {
            options.extend(["--directional".to_owned(), self.directional.join(",")]);
        }
        options
    }

    /// The files: a module in C has a header.
    fn paths(&self) -> Vec<PathBuf> {
        let header = (self.language == Language::C).then(|| self.out.with_extension("h"));
        [self.out.clone()].into_iter().chain(header).collect()
    }

    /// All that says what is generated.
    fn options(&self) -> Vec<String> {
        let language = (self.language == Language::C).then_some(["--language", "c"].map(str::to_owned));
        let flags = [(self.standalone, "--standalone"), (self.pairs, "--pairs"), (self.fmu, "--fmu")];
        let flags = flags.into_iter().filter(|(is_set, _)| *is_set).map(|(_, flag)| flag.to_owned());
        language.into_iter().flatten().chain(flags).chain(self.derivatives()).collect()
    }

    /// Options that do not go together.
    fn check(&self, layout: &Layout) -> Result<(), CommandError> {
        fmu::check(self)?;
        let usage = |message: String| Err(CommandError::Usage(message));
        let path = self.out.display();
        if self.pairs && (self.standalone || self.language != Language::Rust || !has_extension(&self.out, "rs")) {
            let module = "a module in Rust that uses planar-capture (FILE.rs, without --standalone)";
            return usage(format!("--pairs is for {module}: leave it out"));
        }
        match (self.language, self.out.extension().and_then(|extension| extension.to_str())) {
            (Language::C, Some("c")) if self.standalone => {
                usage("--standalone is for a module in Rust: leave it out, one in C has no dependencies".to_owned())
            }
            (Language::C, Some("c")) => {
                let header = self.out.with_extension("h");
                CModule::check_header(&file_name(&header)).map_err(CommandError::Usage)
            }
            (Language::Rust, Some("c")) => usage(format!("{path}: write `--language c` too for a module in C")),
            (Language::C, Some("rs" | "json")) => {
                usage(format!("{path}: `--language c` wants a file that ends in `.c`; its header is written beside it"))
            }
            (_, Some("json")) if self.standalone => {
                usage("--standalone is for a module: name FILE.rs, or leave it out for a graph".to_owned())
            }
            (_, Some("json")) if self.out.file_stem().is_none_or(|stem| stem != layout.name.as_str()) => {
                let name = &layout.name;
                usage(format!(
                    "{path}: build scripts look for the graph of layout `{name}` in {name}.json: use that name"
                ))
            }
            _ => Ok(()),
        }
    }
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|found| found == extension)
}

/// Derives the graph, proves it, and writes it or its module.
pub fn run(arguments: &Arguments, robots: Robots<'_>) -> Result<ExitCode, CommandError> {
    let layout = layout::read(&arguments.layout, robots)?;
    arguments.check(&layout)?;
    let paths = arguments.paths();
    if !arguments.check {
        paths.iter().try_for_each(|path| check_overwrite(path))?;
    }
    let progress = spinner("starting Python");
    let Proved { graph, text, proof, double_alone } =
        derive::proved(&layout, &arguments.derivatives(), &arguments.layout, Some(&progress))?;
    progress.set_message("rendering");
    let product = if arguments.fmu {
        Product::Fmu(fmu::render(&graph, &layout, arguments)?)
    } else if has_extension(&arguments.out, "json") {
        Product::Texts(vec![text])
    } else {
        Product::Texts(modules(&graph, &layout, arguments)?)
    };
    progress.finish_and_clear();
    // the sources of an FMU are in double precision
    if let Some(why) = double_alone.filter(|_| !arguments.fmu) {
        note(format_args!(
            "warning: single precision does not hold this robot: {why}; modules are right in double precision, and their own \
             test in single precision fails"
        ));
    }
    if arguments.pairs && !graph.has_equal_arms() {
        note("note: no two arms have as many links and the same exact zeros: nothing is computed in pairs");
    }
    if arguments.check {
        return Ok(check(&paths, &product, arguments));
    }
    let content = match product {
        Product::Texts(texts) => {
            write_together(paths.iter().map(PathBuf::as_path).zip(texts.iter().map(String::as_bytes)))?;
            format!("{} lines", texts.iter().map(|text| text.lines().count()).sum::<usize>())
        }
        Product::Fmu(written) => fmu::write(written, arguments)?,
    };
    let shown = names(&paths);
    print(&format!("{shown}: {}, {} degrees of freedom, {content}\n{proof}\n", layout.name, layout.joints() + 3));
    Ok(ExitCode::SUCCESS)
}

/// What is written.
enum Product {
    /// One for each file.
    Texts(Vec<String>),
    Fmu(Fmu),
}

/// The texts of a module.
fn modules(graph: &Graph, layout: &Layout, arguments: &Arguments) -> Result<Vec<String>, CommandError> {
    let (source, command) = origin(arguments, layout);
    let texts = match arguments.language {
        Language::Rust => {
            let standalone = arguments.standalone;
            let module = Module {
                standalone,
                item: false,
                arithmetic: Arithmetic { is_paired: arguments.pairs, ..Arithmetic::default() },
                source: &source,
                command: &command,
            };
            module.render(graph).map(|text| vec![text])
        }
        Language::C => {
            let header = file_name(&arguments.out.with_extension("h"));
            let module = CModule { header: &header, source: &source, command: &command };
            module.render(graph).map(|CText { source, header }| vec![source, header])
        }
    };
    texts.map_err(|problem| file_error(&arguments.layout)(GenerateError::from(GraphError::Format(problem))))
}

/// Source and command for the header of the module: without folders, so that the same layout gives the same bytes
/// everywhere.
fn origin(arguments: &Arguments, layout: &Layout) -> (String, String) {
    let (source, argument) = if Layout::is_path(&arguments.layout) {
        let file = file_name(Path::new(&arguments.layout));
        (file.clone(), file)
    } else {
        (format!("the layout {}", layout.name), layout.name.clone())
    };
    (source, command(&argument, &file_name(&arguments.out), &arguments.options()))
}

fn file_name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

fn names(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", ")
}

/// Compares the files with what the layout gives.
fn check(paths: &[PathBuf], product: &Product, arguments: &Arguments) -> ExitCode {
    let different = match product {
        Product::Texts(texts) => {
            let mut files = paths.iter().zip(texts);
            files.find(|(path, text)| !fs::read(path).is_ok_and(|found| found == text.as_bytes())).map(|(path, _)| path)
        }
        Product::Fmu(wanted) => (!fmu::is_fresh(wanted, arguments)).then_some(&arguments.out),
    };
    let Some(path) = different else {
        print(&format!("{}: fresh\n", names(paths)));
        return ExitCode::SUCCESS;
    };
    let (shown, out) = (path.display(), arguments.out.display().to_string());
    let state = if path.exists() { "is not what the layout gives" } else { "does not exist" };
    let mend = command(&arguments.layout, &out, &arguments.options());
    note(format_args!("{shown} {state}; to mend: {mend}"));
    ExitCode::from(1)
}

/// Refuses to overwrite a file that was not generated.
fn check_overwrite(path: &Path) -> Result<(), CommandError> {
    check_folder(path)?;
    let Ok(found) = fs::metadata(path) else { return Ok(()) };
    let mut start = Vec::new();
    if found.is_file() {
        // only the first bytes: a device or a pipe has no end
        let _ = fs::File::open(path).map(|file| file.take(64).read_to_end(&mut start));
    }
    let generated = start.starts_with(b"// @generated from ")
        || start.starts_with(b"{\n \"format\": ")
        || (start.starts_with(b"PK") && fs::File::open(path).is_ok_and(archive::is_generated));
    if generated || (found.is_file() && found.len() == 0) {
        return Ok(());
    }
    let file = path.display();
    let message = format!("{file} already exists and was not generated: choose another file, or move it first");
    Err(CommandError::Usage(message))
}
