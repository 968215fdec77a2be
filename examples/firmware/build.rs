//! Where the linker finds the memory, and what the board has to compute: the same code computes it here.

use control::c::C;
use control::library::Library;
use control::standalone::Standalone;
use control::vectors::{Vectors, bits, vectors};
use std::path::PathBuf;
use std::{env, error, fs};

fn main() -> Result<(), Box<dyn error::Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::copy("memory.x", out.join("memory.x"))?;
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rerun-if-changed=memory.x");
    println!("cargo::rerun-if-changed=build.rs");
    if env::var("CARGO_CFG_TARGET_OS")? == "none" {
        println!("cargo::rustc-link-arg-bins=-Tlink.x");
        println!("cargo::rustc-link-arg-bins=--nmagic");
    }
    let routes = [vectors::<Library>()?, vectors::<Standalone>()?, vectors::<C>()?];
    if routes.iter().any(|route| *route != routes[0]) {
        return Err("library, module and C do not have the same bits".into());
    }
    let Vectors { record, checksums, results } = &routes[0];
    let record = record.map(bits);
    let text = format!("Expected {{ record: &{record:?}, checksums: {checksums:?}, results: {results:?} }}");
    Ok(fs::write(out.join("expected.rs"), text)?)
}
