//! `planar-capture new DIR`: writes a crate of one's own.

use super::progress::spinner;
use super::terminal::print;
use super::{CommandError, derive, file_error, layout};
use crate::build::quoted;
use crate::generate::complete;
use crate::graphs::{cache_path, derived, keep, of_shipped};
use crate::layout::Layout;
use crate::output::result_folder::ResultFolder;
use crate::own_crate::{Dependency, OwnCrate, check_name, has_sources, renamed};
use crate::registry::Robots;
use std::fs;
use std::io::Write;
use std::path::{Component, Path, PathBuf, absolute};
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture new my_robot
  planar-capture new my_robot --layout mine.toml";

/// Write a crate with a robot of your own.
///
/// It has the robot's compiled code, this whole command line, a first scenario and a test. It builds without Python and without this program. A graph is copied from a shipped robot of the same arms, links and
/// exact zeros, or is the one that you have derived; for any other structure it is derived now, and kept as by `derive`.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The folder of the crate, absent or empty.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// The robot to begin with: a path, or the name of a shipped one.
    #[arg(long, default_value = "dual_arm_3r")]
    layout: String,
    /// The name of crate and robot [default: the folder's].
    #[arg(long)]
    name: Option<String>,
    #[command(flatten)]
    source: Source,
}

/// Where the crate has `planar-capture` from; without these it gets its sources, in the folder `vendor`.
#[derive(Debug, clap::Args)]
#[group(multiple = false)]
struct Source {
    /// Use planar-capture from this folder.
    #[arg(long, value_name = "PATH")]
    path: Option<PathBuf>,
    /// Use planar-capture from this git repository.
    #[arg(long, value_name = "URL")]
    git: Option<String>,
    /// Use this version of planar-capture from the registry.
    #[arg(long, value_name = "VERSION")]
    version: Option<String>,
}

/// Writes the crate, whole or not at all.
pub fn run(arguments: &Arguments, robots: Robots<'_>) -> Result<ExitCode, CommandError> {
    let usage = |message: String| Err(CommandError::Usage(message));
    let folder = absolute(&arguments.folder)?;
    let of_folder = || folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let name = arguments.name.clone().unwrap_or_else(of_folder);
    check_name(&name).map_err(|error| CommandError::Usage(error.to_string()))?;
    let shown = arguments.folder.display();
    if fs::read_dir(&folder).is_ok_and(|mut entries| entries.next().is_some()) {
        return usage(format!("{shown} is not empty: name a folder that is absent or empty"));
    }
    let claimed = ResultFolder::claim(&folder, false, &[], &|_, _| Some("is not empty".to_owned()))?;
    let dependency = arguments.source.dependency(&folder)?;
    let (text, file) = layout::source(&arguments.layout, robots)?;
    let original = Layout::parse(&text, &file)?;
    let layout_text = renamed(&text, &original, &name);
    let own = Layout { name, ..original };
    let graph = graph(&own, &arguments.layout)?;
    let files = OwnCrate { layout: &own, layout_text: &layout_text, graph: &graph, dependency: &dependency }.files();
    let staged = claimed.stage()?;
    for (path, text) in &files {
        staged.write(path, |to| to.write_all(text.as_bytes()))?;
    }
    claimed.commit(staged, "Cargo.toml")?;
    print(&format!(
        "{shown}: a crate with the robot `{}`, {} degrees of freedom\n\n    cd {}\n    \
         cargo run --release -- run scenarios/first.toml\n\n",
        own.name,
        own.joints() + 3,
        quoted(&shown.to_string())
    ));
    Ok(ExitCode::SUCCESS)
}

/// The graph of a layout, which is in `file`: that of a shipped layout of its structure, else the one in the user's cache folder,
/// else one that is derived and kept there.
fn graph(layout: &Layout, file: &str) -> Result<String, CommandError> {
    let Some((shipped, text)) = of_shipped(layout) else {
        // one that cannot be used is derived again
        if let Ok(Some(found)) = derived(layout) {
            return Ok(found.text.into_owned());
        }
        let path = cache_path(layout).map_err(file_error(file))?;
        let progress = spinner("starting Python");
        let proved = derive::proved(layout, &[], file, Some(&progress))?;
        progress.finish_and_clear();
        keep(&path, &proved.text)?;
        return Ok(proved.text);
    };
    let twin = Layout { name: layout.name.clone(), ..shipped.clone() };
    if twin.sha256() != layout.sha256() {
        // other numbers: a graph holds for all of a structure
        return Ok(complete(text, &shipped).map_err(file_error(file))?.text);
    }
    // what the derivation writes for this name
    let text = text.replacen(&shipped.sha256(), &twin.sha256(), 1);
    let text = text.replacen(&format!("codegen {}\"", shipped.name), &format!("codegen {}\"", twin.name), 1);
    let text =
        text.replacen(&format!("{{\"name\": \"{}\"", shipped.name), &format!("{{\"name\": \"{}\"", twin.name), 1);
    Ok(complete(&text, &twin).map_err(file_error(file))?.text)
}

impl Source {
    fn dependency(&self, folder: &Path) -> Result<Dependency, CommandError> {
        let Self { path, git, version } = self;
        if let Some(path) = path {
            let manifest = path.join("Cargo.toml");
            if !fs::read_to_string(&manifest).is_ok_and(|text| text.contains("name = \"planar-capture\"")) {
                let path = path.display();
                let message = format!("--path {path}: there is no Cargo.toml of planar-capture, expected its folder");
                return Err(CommandError::Usage(message));
            }
            return Ok(Dependency::Path(if path.is_absolute() {
                path.display().to_string()
            } else {
                between(folder, &absolute(path)?)
            }));
        }
        match (git, version) {
            (Some(url), _) => Ok(Dependency::Git(url.clone())),
            (None, Some(version)) => Ok(Dependency::Version(version.clone())),
            (None, None) if has_sources() => Ok(Dependency::Vendored),
            (None, None) => Err(CommandError::Usage(
                "this program was built from a package, without the sources that a crate of your own needs: say where it \
                 has planar-capture from, by --path FOLDER, --git URL or --version VERSION"
                    .to_owned(),
            )),
        }
    }
}

/// The path from one absolute folder to another.
fn between(from: &Path, to: &Path) -> String {
    // as the system follows them; what is not there yet has no links
    let resolved = |path: &Path| {
        let above = path.ancestors().find_map(|above| Some((above, above.canonicalize().ok()?)));
        above.map_or_else(|| path.to_owned(), |(above, found)| found.join(path.strip_prefix(above).unwrap_or(path)))
    };
    let (from, to) = (resolved(from), resolved(to));
    let common = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let up = from.components().skip(common).map(|_| Component::ParentDir);
    let path: PathBuf = up.chain(to.components().skip(common)).collect();
    path.display().to_string().replace(std::path::MAIN_SEPARATOR, "/")
}
