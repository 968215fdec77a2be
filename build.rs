//! Renders every committed graph to Rust; stops where a graph is not its layout's.

#[path = "src/diagnostic/mod.rs"]
#[allow(dead_code, unused_imports, reason = "the scenario reader's half is not used here")]
mod diagnostic;
#[path = "src/layout.rs"]
#[allow(dead_code, reason = "only the content hash is wanted here")]
mod layout;
#[path = "codegen/render.rs"]
#[allow(dead_code, reason = "modules for other crates are rendered elsewhere")]
mod render;
#[path = "codegen/stage.rs"]
mod stage;
#[path = "src/standalone.rs"]
mod standalone;

fn main() {
    println!("cargo::rerun-if-changed=codegen");
    let out = std::env::var_os("OUT_DIR").unwrap_or_default();
    let enabled = |layout: &str| std::env::var_os(format!("CARGO_FEATURE_{}", layout.to_uppercase())).is_some();
    if let Err(problem) = stage::render_all("codegen".as_ref(), out.as_ref(), &enabled) {
        eprintln!("{problem}");
        std::process::exit(1);
    }
}
