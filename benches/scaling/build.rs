//! Passes the index of the generated robots to the benchmark; an empty one without the measuring program.

use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-env-changed=SCALING_ROBOTS");
    let index = if let Ok(index) = env::var("SCALING_ROBOTS") {
        index
    } else {
        let out = env::var("OUT_DIR").map_err(io::Error::other)?;
        let empty = Path::new(&out).join("none.rs");
        fs::write(&empty, "pub const ROBOTS: &[super::Robot] = &[];\n")?;
        empty.display().to_string()
    };
    println!("cargo::rustc-env=SCALING_INDEX={index}");
    Ok(())
}
