//! The graphs that the program carries, and those that were derived into the user's cache folder.
//!
//! # Example
//! ```
//! use planar_capture::graphs;
//! use planar_capture::layout::Layout;
//!
//! let mut layout = Layout::read("codegen/layouts/single_arm_3r.toml".as_ref())?;
//! layout.base.mass = 250.0; // a graph is that of a structure, whatever its numbers are
//! let (shipped, graph) = graphs::of_shipped(&layout).expect("a layout of the same structure");
//! assert_eq!(shipped.name, "single_arm_3r");
//! assert!(graphs::carried().any(|carried| carried == ("graphs/single_arm_3r.json", graph)));
//! # Ok::<(), planar_capture::diagnostic::Report>(())
//! ```

use crate::generate::{DerivationError, home, package_hash};
use crate::layout::{Layout, sha256};
use crate::manifest::ParameterKind::{
    self, BaseInertia, BaseMass, LinkComX, LinkComY, LinkInertia, LinkLength, LinkMass, MountAngle, MountX, MountY,
};
use crate::output::atomic_file::{create_folder, write_together};
use crate::output::output_error::OutputError;
use crate::python_package::PYTHON_PACKAGE;
use crate::registry::SHIPPED;
use crate::structure::{Structure, fingerprint, in_words, parameters};
use planar_build::evaluator::Evaluator;
use planar_build::graph;
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{fs, io};

/// Of graphs, in the user's cache folder.
const FOLDER: &str = "graphs";

/// A graph that the program carries.
struct Carried {
    name: &'static str,
    links: &'static [usize],
    parameters: &'static [(ParameterKind, usize, usize)],
    needs_distinct_mounts: bool,
    /// Below the folder of the derivation.
    path: &'static str,
    text: &'static str,
}

macro_rules! graphs {
    ($($name:ident in $folder:ident: $links:tt, $parameters:tt, $distinct:literal;)*) => {
        const CARRIED: &[Carried] = &[$(Carried {
            name: stringify!($name),
            links: &$links,
            parameters: &$parameters,
            needs_distinct_mounts: $distinct,
            path: concat!(stringify!($folder), "/", stringify!($name), ".json"),
            text: include_str!(concat!(
                env!("CARGO_MANIFEST_DIR"), "/codegen/", stringify!($folder), "/", stringify!($name), ".json"
            )),
        }),*];
    };
}

include!(concat!(env!("OUT_DIR"), "/graphs.rs"));

/// No graph can be evaluated for a layout.
#[derive(Debug, thiserror::Error)]
pub enum NoGraph {
    /// None has its structure.
    #[error(
        "no graph has the structure of layout `{layout}` ({structure}): `planar-capture derive` with its file derives one"
    )]
    Missing {
        /// The layout's name.
        layout: String,
        /// Its structure in words.
        structure: String,
    },
    /// The one in the cache folder cannot be used.
    #[error("{path}: {problem}; `planar-capture derive` with the layout's file derives it again", path = path.display())]
    Unusable {
        /// Its file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
}

/// The programs of a graph, and which graph that is.
#[derive(Clone, Debug)]
pub struct FoundGraph {
    /// For all layouts of the structure.
    pub evaluator: Arc<Evaluator>,
    /// In words.
    pub origin: String,
    /// Its text, JSON.
    pub text: Cow<'static, str>,
}

/// The graph of a layout's structure: the one in the user's cache folder, else of those that the program carries the one
/// with the fewest parameters.
///
/// # Errors
/// [`NoGraph`].
pub fn find(layout: &Layout) -> Result<FoundGraph, NoGraph> {
    if let Some(found) = derived(layout)? {
        return Ok(found);
    }
    let fits = |carried: &&Carried| parameters(&carried.structure(), layout).is_ok();
    let best = CARRIED.iter().filter(fits).min_by_key(|carried| carried.parameters.len());
    let missing = || NoGraph::Missing { layout: layout.name.clone(), structure: in_words(layout) };
    let Carried { name, text, .. } = best.ok_or_else(missing)?;
    let unusable = |problem| NoGraph::Unusable { path: PathBuf::from(name), problem };
    let evaluator = evaluator(text, layout).map_err(unusable)?;
    Ok(FoundGraph { evaluator, origin: format!("the graph `{name}`"), text: Cow::Borrowed(text) })
}

/// A shipped layout of the same structure, and the text of its graph.
#[must_use]
pub fn of_shipped(layout: &Layout) -> Option<(Layout, &'static str)> {
    let print = fingerprint(layout);
    let shipped = SHIPPED.iter().filter_map(|(name, text)| Layout::parse(text, name).ok());
    let found = shipped.into_iter().find(|shipped| fingerprint(shipped) == print)?;
    let Carried { text, .. } = CARRIED.iter().find(|carried| carried.name == found.name)?;
    Some((found, text))
}

/// (path below `codegen`, text) of every graph that the program carries.
pub fn carried() -> impl Iterator<Item = (&'static str, &'static str)> {
    CARRIED.iter().map(|carried| (carried.path, carried.text))
}

impl Carried {
    fn structure(&self) -> Structure {
        let Self { links, parameters, needs_distinct_mounts, .. } = *self;
        Structure { links: links.to_vec(), parameters: parameters.to_vec(), needs_distinct_mounts }
    }
}

/// The graph of a layout's structure that was derived into the user's cache folder; `None` where there is none.
///
/// # Errors
/// [`NoGraph::Unusable`] for a file that is not as it was derived and proved.
pub fn derived(layout: &Layout) -> Result<Option<FoundGraph>, NoGraph> {
    // without a cache folder there is nothing in it
    let Ok(path) = cache_path(layout) else { return Ok(None) };
    let unusable = |problem| NoGraph::Unusable { path: path.clone(), problem };
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(unusable(error.to_string())),
    };
    if !is_proved(&path, &text) {
        return Err(unusable("it is not as it was derived and proved".to_owned()));
    }
    let origin = "the graph derived for its structure".to_owned();
    Ok(Some(FoundGraph { evaluator: evaluator(&text, layout).map_err(unusable)?, origin, text: Cow::Owned(text) }))
}

/// The graphs in the user's cache folder that are as they were derived and proved: their files, in order, and the numbers of
/// links of the arms of their structures.
#[must_use]
pub fn kept() -> Vec<(PathBuf, Vec<usize>)> {
    let files = home().ok().and_then(|home| fs::read_dir(home.join(FOLDER)).ok()).into_iter().flatten().flatten();
    let mut graphs: Vec<_> =
        files.map(|file| file.path()).filter_map(|path| Some((proved_links(&path)?, path))).collect();
    graphs.sort_by(|(_, a), (_, b)| a.cmp(b));
    graphs.into_iter().map(|(links, path)| (path, links)).collect()
}

fn proved_links(path: &Path) -> Option<Vec<usize>> {
    let text = path.extension().filter(|extension| *extension == "json").and_then(|_| fs::read_to_string(path).ok())?;
    let evaluator = is_proved(path, &text).then(|| graph::read_any(&text).and_then(|graph| Evaluator::new(&graph)))?;
    Some(evaluator.ok()?.structure().links.clone())
}

/// Whether the text of a graph in the cache folder is as it was derived and proved.
fn is_proved(path: &Path, text: &str) -> bool {
    fs::read_to_string(hash_path(path)).is_ok_and(|hash| hash == sha256(text))
}

/// The evaluator of a graph that is to have the layout's structure.
fn evaluator(text: &str, layout: &Layout) -> Result<Arc<Evaluator>, String> {
    let evaluator =
        graph::read_any(text).and_then(|graph| Evaluator::new(&graph)).map_err(|error| error.to_string())?;
    match parameters(evaluator.structure(), layout) {
        Ok(_) => Ok(Arc::new(evaluator)),
        Err(_) => Err("it is of another structure".to_owned()),
    }
}

/// Keeps the proved graph of a layout's structure in the user's cache folder; `path` is its [`cache_path`].
///
/// # Errors
/// [`OutputError`].
pub fn keep(path: &Path, text: &str) -> Result<(), OutputError> {
    create_folder(path.parent().unwrap_or(Path::new(".")))?;
    // by its hash a file that was changed or damaged since is told from what was proved
    write_together([(&*hash_path(path), sha256(text).as_bytes()), (path, text.as_bytes())])
}

/// Where the hash of a graph in the cache folder is kept, which was proved as it was then.
#[must_use]
pub fn hash_path(graph: &Path) -> PathBuf {
    graph.with_extension("sha256")
}

/// Where the graph of a layout's structure is kept, of this version of the derivation and of the format of graphs.
///
/// # Errors
/// [`DerivationError::NoHome`].
pub fn cache_path(layout: &Layout) -> Result<PathBuf, DerivationError> {
    let key = format!("{}\n{}\n{}", graph::FORMAT, package_hash(PYTHON_PACKAGE), fingerprint(layout));
    Ok(home()?.join(FOLDER).join(format!("{:.32}.json", sha256(&key))))
}
