//! The same program built with several sets of compiler flags, which measure in turns.

use crate::Interpreters;
use crate::engines::{self, ENGINES, PACKAGE};
use evaluation::Problem;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Name, flags of the compiler, and whether products and sums are fused.
pub const BUILDS: [(&str, &str, bool); 5] = [
    ("default x86-64", "", false),
    ("x86-64-v3", "-C target-cpu=x86-64-v3", false),
    ("x86-64-v3, fused", "-C target-cpu=x86-64-v3", true),
    ("native", "-C target-cpu=native", false),
    ("native, fused", "-C target-cpu=native", true),
];

/// What one build has measured, round by round: names and nanoseconds.
pub struct Measured {
    /// As in [`BUILDS`] or [`ENGINES`], or [`PACKAGE`].
    pub build: &'static str,
    /// Name of a measurement, and its times of all rounds, ns, sorted.
    pub times: Vec<(String, Vec<f64>)>,
}

impl Measured {
    /// The median time of a measurement, ns.
    pub fn median(&self, name: &str) -> Option<f64> {
        let (_, times) = self.times.iter().find(|(other, _)| other == name)?;
        times.get(times.len() / 2).copied()
    }

    /// The quartiles of a measurement over its median, less 1: the larger of the two.
    pub fn spread(&self, name: &str) -> Option<f64> {
        let (_, times) = self.times.iter().find(|(other, _)| other == name)?;
        let [low, middle, high] = [1, 2, 3].map(|quarter| times[(quarter * times.len() / 4).min(times.len() - 1)]);
        Some((high / middle - 1.0).max(1.0 - low / middle))
    }
}

/// Builds all, with what interpreters have, then lets each measure once per round.
pub fn run(rounds: usize, interpreters: Interpreters<'_>) -> Result<Vec<Measured>, Problem> {
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/engines");
    let input = target.join("input.txt").display().to_string();
    std::fs::create_dir_all(&target)?;
    // before the builds, which take minutes: what is missing here is said at once
    let engines = interpreters.reference.map(|python| engines::compile(python, &target)).transpose()?;
    let mut programs = Vec::new();
    for (name, flags, fused) in BUILDS {
        programs.push((name, build(name, flags, fused)?, vec!["measure".to_owned()]));
    }
    if let Some((_, program, _)) = programs.first() {
        engines::output(Command::new(program).args(["input", &input]))?;
    }
    let engines = ENGINES.into_iter().zip(engines.into_iter().flatten());
    programs.extend(engines.map(|(name, program)| (name, program, vec![input.clone()])));
    if let Some(python) = interpreters.package {
        let script = engines::folder().join("arrays.py").display().to_string();
        programs.push((PACKAGE, python.into(), vec![script, input]));
    }
    let of = |(build, ..): &(&'static str, PathBuf, Vec<String>)| Measured { build, times: Vec::new() };
    let mut measured: Vec<Measured> = programs.iter().map(of).collect();
    for round in 1..=rounds {
        eprintln!("round {round} of {rounds}");
        for ((_, program, arguments), measured) in programs.iter().zip(&mut measured) {
            let found = engines::output(Command::new(program).args(arguments))?;
            let found: serde_json::Map<String, Value> = serde_json::from_str(&found)?;
            for (name, time) in found {
                let time = time.as_f64().ok_or("a time that is no number")?;
                match measured.times.iter_mut().find(|(other, _)| *other == name) {
                    Some((_, times)) => times.push(time),
                    None => measured.times.push((name, vec![time])),
                }
            }
        }
    }
    for (_, times) in measured.iter_mut().flat_map(|measured| &mut measured.times) {
        times.sort_by(f64::total_cmp);
    }
    Ok(measured)
}

fn build(name: &str, flags: &str, fused: bool) -> Result<PathBuf, Problem> {
    eprintln!("building for {name}");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let target = folder.join("target").join(name.replace([' ', ','], "_"));
    let features = if fused { "measure,fused" } else { "measure" };
    let status = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--release", "--locked", "--features", features])
        .args(["--manifest-path".as_ref(), folder.join("Cargo.toml").as_os_str()])
        .args(["--target-dir".as_ref(), target.as_os_str()])
        .env("RUSTFLAGS", flags)
        .status()?;
    if !status.success() {
        return Err(format!("the build for {name} failed").into());
    }
    Ok(target.join("release/evaluation"))
}
