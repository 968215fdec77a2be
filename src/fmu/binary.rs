//! The binary of an FMU for this machine, by the C compiler that is found.
//!
//! # Example
//! ```
//! use planar_capture::build::graph;
//! use planar_capture::fmu::binary::{BinaryError, compile};
//! use planar_capture::fmu::{Fmu, Origin};
//! use planar_capture::layout::Layout;
//!
//! let layout = Layout::read("codegen/layouts/single_arm_3r.toml".as_ref())?;
//! let graph = graph::read(&std::fs::read_to_string("codegen/graphs/single_arm_3r.json")?, &layout)?;
//! let sha256 = layout.sha256();
//! let origin = Origin { name: "arm", layout_sha256: &sha256, source: "single_arm_3r.toml", command: "build" };
//! match compile(&Fmu::new(&graph, &origin)?) {
//!     Ok(binary) if cfg!(all(target_os = "linux", target_arch = "x86_64")) => {
//!         assert_eq!(binary.path, "binaries/x86_64-linux/arm.so");
//!         assert!(binary.content.starts_with(b"\x7fELF"));
//!     }
//!     // an FMU without a binary has its sources
//!     Ok(_) | Err(BinaryError::Platform | BinaryError::NoCompiler(_)) => {}
//!     Err(error) => return Err(error.into()),
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::sources::compiled;
use super::{Entry, Fmu};
use std::io;
use std::process::{Command, Stdio};
use std::{env, fs};

/// The options of the compiler: the bits of the module (no fused operations), and no names but those of FMI.
const OPTIONS: [&str; 6] = ["-std=c99", "-O2", "-ffp-contract=off", "-fPIC", "-shared", "-fvisibility=hidden"];

/// Why there is no binary.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BinaryError {
    /// FMI has no name for this platform.
    #[error("FMI has no name for {architecture}-{system}", architecture = env::consts::ARCH, system = env::consts::OS)]
    Platform,
    /// There is no compiler of this name.
    #[error("there is no C compiler `{0}` (`CC` names another one)")]
    NoCompiler(String),
    /// The compiler has not compiled the sources.
    #[error("`{compiler}` failed: {reason}")]
    Failed {
        /// The compiler.
        compiler: String,
        /// Its first error.
        reason: String,
    },
    /// No temporary folder, or one that cannot be written.
    #[error("cannot compile: {0}")]
    Files(#[from] io::Error),
}

/// The name of this platform in FMI, and the extension of its libraries.
fn platform() -> Option<(String, &'static str)> {
    let architecture = match env::consts::ARCH {
        same @ ("x86" | "x86_64" | "aarch64" | "riscv32" | "riscv64") => same,
        "arm" => "aarch32",
        "powerpc" => "ppc32",
        "powerpc64" => "ppc64",
        _ => return None,
    };
    let (system, extension) = match env::consts::OS {
        "linux" => ("linux", "so"),
        "macos" => ("darwin", "dylib"),
        "windows" => ("windows", "dll"),
        _ => return None,
    };
    Some((format!("{architecture}-{system}"), extension))
}

/// Compiles the sources with the compiler that the variable `CC` names, else `cc`.
///
/// # Errors
/// [`BinaryError`].
pub fn compile(fmu: &Fmu) -> Result<Entry, BinaryError> {
    let (platform, extension) = platform().ok_or(BinaryError::Platform)?;
    let compiler = env::var("CC").ok().filter(|name| !name.trim().is_empty()).unwrap_or_else(|| "cc".to_owned());
    let folder = tempfile::tempdir()?;
    for Entry { path, content } in &fmu.entries {
        if let Some(file) = path.strip_prefix("sources/") {
            fs::write(folder.path().join(file), content)?;
        }
    }
    let library = format!("{}.{extension}", fmu.name);
    // names without folders: the binary has none of this machine
    let mut command = Command::new(&compiler);
    command.args(OPTIONS).args(["-o", &library]).args(compiled(&fmu.name)).current_dir(folder.path());
    let output = match command.stdin(Stdio::null()).output() {
        Ok(output) => output,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Err(BinaryError::NoCompiler(compiler)),
        Err(error) => return Err(error.into()),
    };
    if !output.status.success() {
        let messages = String::from_utf8_lossy(&output.stderr).into_owned();
        let mut errors = messages.lines().filter(|line| line.contains("error"));
        let reason = errors.next().or(messages.lines().next()).unwrap_or("no message").to_owned();
        return Err(BinaryError::Failed { compiler, reason });
    }
    let content = fs::read(folder.path().join(&library))?;
    Ok(Entry { path: format!("binaries/{platform}/{library}"), content })
}
