//! The derivation of a layout's graph by the Python package `codegen`: unpacked once, run in its own environment.

use planar_layout::layout::{Layout, sha256};
use std::ffi::{OsStr, OsString};
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;
use std::{env, fs};

/// Interpreters to look for, best first.
const PYTHONS: [&str; 6] = ["python3", "python3.14", "python3.13", "python3.12", "python3.11", "python"];

/// The program that tells a new enough Python from an old one by its exit status.
const OLDEST: &str = "import sys; sys.exit(sys.version_info < (3, 11))";

/// Its exit code where what is asked for is not possible, which it says.
const REFUSED: i32 = 2;

/// Tells the package that it runs in its environment; the same name is in its `__main__.py`.
const INSIDE: &str = "PLANAR_CAPTURE_CODEGEN_INSIDE";

/// The names of folders in which the package is being unpacked: this, then letters and digits.
const UNPACKING: &str = ".unpacking-";
/// No process unpacks for so long.
const ABANDONED: Duration = Duration::from_secs(3600);

/// No graph was derived.
#[derive(Debug, thiserror::Error)]
pub enum DerivationError {
    /// There is no Python, or none that is new enough.
    #[error(
        "deriving needs Python 3.11 or newer with venv; tried, and not found to be that: {tried}.\n\
         Install it (Debian, Ubuntu: apt install python3 python3-venv), or name one: PLANAR_CAPTURE_PYTHON=/path/to/python3"
    )]
    NoPython {
        /// The names that were tried.
        tried: String,
    },
    /// There is no place for the package and its environment.
    #[error("no folder for the derivation: {reason}; name one: PLANAR_CAPTURE_HOME=/path/to/folder")]
    NoHome {
        /// What is missing.
        reason: String,
    },
    /// A file could not be written or read.
    #[error("{path}: {source}; PLANAR_CAPTURE_HOME names another folder for the derivation", path = path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// Python could not be run.
    #[error("{python}: {source}")]
    Python {
        /// The interpreter.
        python: String,
        /// Why not.
        source: io::Error,
    },
    /// What is asked for is not possible.
    #[error("{reason}")]
    Refused {
        /// Why not.
        reason: String,
    },
    /// Python ran and gave no graph.
    #[error("the derivation failed ({status}):\n{output}")]
    Failed {
        /// Its exit status.
        status: String,
        /// Its output.
        output: String,
    },
}

/// The graph of a layout as text, as it is to be kept, by the Python package `codegen`, (file, text) by (file, text);
/// `options` are those that ask for derivatives. `say` receives the messages of the derivation, line by line.
///
/// # Errors
/// [`DerivationError`], with what to install where something is missing.
pub fn derive(
    layout: &Layout,
    options: &[String],
    package: &[(&str, &str)],
    say: &mut dyn FnMut(&str),
) -> Result<String, DerivationError> {
    derive_by(None, layout, options, package, say)
}

/// As [`derive()`]; by an interpreter that has CasADi itself, or by one that is found, in an environment that is made.
///
/// # Errors
/// Those of [`derive()`].
pub fn derive_by(
    given: Option<&OsStr>,
    layout: &Layout,
    options: &[String],
    package: &[(&str, &str)],
    say: &mut dyn FnMut(&str),
) -> Result<String, DerivationError> {
    let home = home()?;
    let package = unpack(&home, package)?;
    let python = given.map_or_else(python, |python| Ok(python.to_owned()))?;
    let folder = tempfile::tempdir().map_err(|source| DerivationError::File { path: env::temp_dir(), source })?;
    let [graph, file] = ["graph.json", "layout.toml"].map(|name| folder.path().join(name));
    // the layout as it was read, not the user's file: one reader alone decides what a file means
    fs::write(&file, layout.to_toml()).map_err(|source| DerivationError::File { path: file.clone(), source })?;
    let mut command = Command::new(&python);
    command.args(["-m", "codegen", "--layout"]).arg(file).arg("--graph").arg(&graph).args(options);
    command.current_dir(&package);
    command.env("PYTHONDONTWRITEBYTECODE", "1");
    if given.is_some() {
        command.env(INSIDE, "1");
    }
    if env::var_os("PLANAR_CAPTURE_ENVIRONMENTS").is_none() {
        command.env("PLANAR_CAPTURE_ENVIRONMENTS", home.join("python"));
    }
    run(command, &python, say)?;
    fs::read_to_string(&graph).map_err(|source| DerivationError::File { path: graph, source })
}

/// Where package, environment and graphs are kept: `$PLANAR_CAPTURE_HOME`, else the user's folder for caches.
///
/// # Errors
/// [`DerivationError::NoHome`].
pub fn home() -> Result<PathBuf, DerivationError> {
    if let Some(chosen) = env::var_os("PLANAR_CAPTURE_HOME").filter(|chosen| !chosen.is_empty()) {
        return Ok(PathBuf::from(chosen));
    }
    let strategy = etcetera::choose_base_strategy();
    let strategy = strategy.map_err(|error| DerivationError::NoHome { reason: error.to_string() })?;
    Ok(etcetera::BaseStrategy::cache_dir(&strategy).join("planar-capture"))
}

/// What changes with the text of the package.
#[must_use]
pub fn package_hash(files: &[(&str, &str)]) -> String {
    let all: Vec<String> = files.iter().map(|(name, text)| format!("{name} {}\n{text}", text.len())).collect();
    sha256(&all.concat())
}

/// The folder that holds the package `codegen`; its name changes with the text of the package.
fn unpack(home: &Path, files: &[(&str, &str)]) -> Result<PathBuf, DerivationError> {
    let place = home.join(format!("codegen-{:.16}", package_hash(files)));
    if place.join("codegen").is_dir() {
        return Ok(place);
    }
    let failed = |source| DerivationError::File { path: place.clone(), source };
    fs::create_dir_all(home).map_err(failed)?;
    remove_abandoned(home);
    let building = tempfile::Builder::new().prefix(UNPACKING).tempdir_in(home).map_err(failed)?;
    let folder = building.path().join("codegen");
    fs::create_dir(&folder).map_err(failed)?;
    for (name, text) in files {
        fs::write(folder.join(name), text).map_err(failed)?;
    }
    match fs::rename(building.path(), &place) {
        // otherwise another process was faster, with the same content
        Err(error) if !place.join("codegen").is_dir() => Err(failed(error)),
        _ => Ok(place),
    }
}

/// Removes the folders that processes which were killed while they unpacked have left; unpacking takes milliseconds.
fn remove_abandoned(home: &Path) {
    let is_old = |entry: &fs::DirEntry| {
        let age = entry.metadata().and_then(|data| data.modified()).ok().and_then(|time| time.elapsed().ok());
        age.is_some_and(|age| age > ABANDONED)
    };
    let entries = fs::read_dir(home).into_iter().flatten().flatten();
    let unpacking = entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(UNPACKING));
    for entry in unpacking.filter(is_old) {
        // the next process tries again
        let _ = fs::remove_dir_all(entry.path());
    }
}

/// The first interpreter that is new enough.
fn python() -> Result<OsString, DerivationError> {
    if let Some(chosen) = env::var_os("PLANAR_CAPTURE_PYTHON").filter(|chosen| !chosen.is_empty()) {
        let tried = chosen.to_string_lossy().into_owned();
        return if works(&chosen) { Ok(chosen) } else { Err(DerivationError::NoPython { tried }) };
    }
    let found = PYTHONS.into_iter().map(OsString::from).find(works);
    found.ok_or_else(|| DerivationError::NoPython { tried: PYTHONS.join(", ") })
}

/// Whether an interpreter runs and is new enough.
fn works(python: &OsString) -> bool {
    let outcome = Command::new(python).args(["-c", OLDEST]).stdin(Stdio::null()).output();
    outcome.is_ok_and(|output| output.status.success())
}

/// Runs the derivation; its messages go to `say`, its other output into the error if it fails.
fn run(mut command: Command, python: &OsString, say: &mut dyn FnMut(&str)) -> Result<(), DerivationError> {
    let failed = |source| DerivationError::Python { python: python.to_string_lossy().into_owned(), source };
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(failed)?;
    let mut output = Vec::new();
    if let Some(stream) = child.stderr.take() {
        for line in BufReader::new(stream).split(b'\n') {
            let line = String::from_utf8_lossy(&line.map_err(failed)?).trim_end().to_owned();
            match line.strip_prefix("codegen: ") {
                Some(message) if !message.starts_with("error: ") => say(message),
                Some(message) => output.push(message.to_owned()),
                None => output.push(line),
            }
        }
    }
    let status = child.wait().map_err(failed)?;
    if status.success() {
        return Ok(());
    }
    let output = output.join("\n");
    Err(match output.strip_prefix("error: ") {
        Some(reason) if status.code() == Some(REFUSED) => DerivationError::Refused { reason: reason.to_owned() },
        _ => DerivationError::Failed { status: status.to_string(), output },
    })
}

#[cfg(test)]
mod tests {
    use super::{ABANDONED, UNPACKING, unpack};
    use std::fs::{self, File};
    use std::time::SystemTime;

    #[test]
    fn what_killed_processes_left_is_removed_and_nothing_else() {
        let home = tempfile::tempdir().expect("a folder");
        let folder = |name: &str| {
            let folder = home.path().join(name);
            fs::create_dir_all(folder.join("codegen")).expect("made");
            folder
        };
        let [old, new, other] =
            [format!("{UNPACKING}old"), format!("{UNPACKING}new"), "old".to_owned()].map(|n| folder(&n));
        for path in [&old, &other] {
            let long_ago = SystemTime::now() - 2 * ABANDONED;
            File::open(path).expect("a folder").set_modified(long_ago).expect("set");
        }
        let package = unpack(home.path(), &[("__main__.py", "pass")]).expect("unpacked");
        assert!(package.join("codegen/__main__.py").is_file());
        assert!(!old.exists() && new.exists() && other.exists());
    }
}
