//! Build time and stack use of a crate with one standalone module, whose program is the module's self-test.

use crate::{Problem, REPEATS};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;
use std::{env, fs};

/// One profile of cargo.
#[derive(Debug)]
pub struct Compilation {
    /// `cargo build`, s; the fastest of several.
    pub seconds: f64,
    /// Smallest stack on which the module's self-test passes, KiB, to 1/16.
    pub stack: u32,
}

/// Smallest stack of a thread on common systems, KiB.
pub const MINIMUM_STACK: u32 = 16;

/// The program; its argument is the size of the stack.
const PROGRAM: &str = r#"#![forbid(unsafe_code)]
mod robot;
fn main() {
    let stack: usize = std::env::args().nth(1).and_then(|size| size.parse().ok()).expect("KiB of stack");
    let thread = std::thread::Builder::new().stack_size(stack << 10).spawn(robot::self_test::run::<f64>);
    thread.expect("a thread").join().expect("no panic").expect("the reference vectors");
}
"#;

const MANIFEST: &str = "[package]\nname = \"robot\"\nversion = \"0.1.0\"\nedition = \"2024\"\n[workspace]\n";

/// The cargo that runs this program.
pub fn cargo() -> Command {
    Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Builds a module in the debug or release profile.
pub fn compile(module: &str, folder: &Path, release: bool) -> Result<Compilation, Problem> {
    fs::create_dir_all(folder.join("src"))?;
    fs::write(folder.join("Cargo.toml"), MANIFEST)?;
    fs::write(folder.join("src/main.rs"), PROGRAM)?;
    fs::write(folder.join("src/robot.rs"), module)?;
    let (target, profile) = (folder.join("target"), if release { "release" } else { "debug" });
    let mut seconds = f64::INFINITY;
    for _ in 0..REPEATS {
        if target.exists() {
            fs::remove_dir_all(&target)?;
        }
        let mut command = cargo();
        command.args(["build", "--quiet", "--target-dir"]).arg(&target).current_dir(folder);
        if release {
            command.arg("--release");
        }
        let start = Instant::now();
        if !command.status()?.success() {
            return Err(format!("{}: cargo build failed", folder.display()).into());
        }
        seconds = seconds.min(start.elapsed().as_secs_f64());
    }
    let stack = smallest_stack(&target.join(profile).join(format!("robot{}", env::consts::EXE_SUFFIX)))?;
    Ok(Compilation { seconds, stack })
}

/// Doubles the stack until the program passes, then bisects.
fn smallest_stack(program: &PathBuf) -> Result<u32, Problem> {
    let passes = |stack: u32| {
        let status = Command::new(program).arg(stack.to_string()).stderr(Stdio::null()).status();
        status.map(|status| status.success())
    };
    let (mut below, mut enough) = (MINIMUM_STACK, MINIMUM_STACK);
    while !passes(enough)? {
        (below, enough) = (enough, enough * 2);
        if enough > 1 << 20 {
            return Err(format!("{} fails its test on any stack", program.display()).into());
        }
    }
    while enough - below > enough.div_ceil(16) {
        let middle = below.midpoint(enough);
        if passes(middle)? {
            enough = middle;
        } else {
            below = middle;
        }
    }
    Ok(enough)
}
