//! Runs the criterion benchmark over all robots and reads its results.

use crate::compilation::cargo;
use crate::derivation::Derivation;
use crate::{Problem, REPEATS, shape::Shape};
use serde_json::Value;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// Median times of one call, ns; those of the fastest of several runs.
#[derive(Clone, Copy, Debug)]
pub struct Evaluation {
    /// Of forward dynamics by the generated code.
    pub generated: f64,
    /// By the generic implementation.
    pub generic: f64,
    /// Of the paper's impact, by both.
    pub impacts: [f64; 2],
}

impl Evaluation {
    /// Time of the generic implementation over that of the generated code.
    pub fn ratio(self) -> f64 {
        self.generic / self.generated
    }
}

/// Measures all robots in each run; results in the order of the robots.
pub fn evaluate(robots: &[(Shape, Derivation)], work: &Path) -> Result<Vec<Evaluation>, Problem> {
    let (modules, found) = (work.join("modules"), work.join("criterion"));
    fs::create_dir_all(&modules)?;
    let mut index = String::new();
    for (shape, derivation) in robots {
        let name = shape.name();
        fs::write(modules.join(format!("{name}.rs")), &derivation.item)?;
        fs::write(modules.join(format!("{name}.toml")), shape.layout().to_toml())?;
        writeln!(index, "include!(\"{name}.rs\");")?;
    }
    index.push_str("pub const ROBOTS: &[super::Robot] = &[\n");
    for name in robots.iter().map(|(shape, _)| shape.name()) {
        let model = format!("|| Box::new({name}::Model::<f64>::default())");
        writeln!(index, "super::Robot {{ name: \"{name}\", layout: include_str!(\"{name}.toml\"), model: {model} }},")?;
    }
    index.push_str("];\n");
    let file = modules.join("robots.rs");
    fs::write(&file, index)?;
    let median = |name: &str, implementation: &str| -> Result<f64, Problem> {
        let file = found.join(name).join(implementation).join("new/estimates.json");
        let estimates: Value = serde_json::from_str(&fs::read_to_string(&file)?)?;
        estimates["median"]["point_estimate"].as_f64().ok_or_else(|| format!("{}: no median", file.display()).into())
    };
    let never = Evaluation { generated: f64::INFINITY, generic: f64::INFINITY, impacts: [f64::INFINITY; 2] };
    let mut fastest = vec![never; robots.len()];
    for _ in 0..REPEATS {
        let mut command = cargo();
        command.args(["bench", "--bench", "evaluation", "--no-default-features"]);
        command.env("SCALING_ROBOTS", &file).env("CRITERION_HOME", &found).current_dir(env!("CARGO_MANIFEST_DIR"));
        if !command.status()?.success() {
            return Err("cargo bench failed".into());
        }
        for ((shape, _), Evaluation { generated, generic, impacts: [impact, dense] }) in robots.iter().zip(&mut fastest)
        {
            let name = shape.name();
            for (place, measured) in [
                (generated, "generated"),
                (generic, "generic"),
                (impact, "generated impact"),
                (dense, "generic impact"),
            ] {
                *place = place.min(median(&name, measured)?);
            }
        }
    }
    Ok(fastest)
}
