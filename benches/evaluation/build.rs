//! Compiles CasADi's C code as well as a compiler can: for this processor. Renders the module with derivatives:
//!
//! ```text
//! planar-capture generate dual_arm_3r --out layouts/dual_arm_3r.json --derivatives=forward_dynamics
//! ```

fn main() {
    #[cfg(feature = "measure")]
    planar_build::render("layouts").unwrap_or_else(|problem| panic!("{problem}"));
    println!("cargo::rerun-if-changed=casadi/dual_arm_3r.c");
    if std::env::var_os("CARGO_FEATURE_MEASURE").is_none() {
        return;
    }
    let mut build = cc::Build::new();
    build.file("casadi/dual_arm_3r.c").opt_level(3).flag("-march=native").warnings(false);
    let compiler = build.get_compiler();
    println!("cargo::rustc-env=C_COMPILER={}", compiler.path().display());
    build.compile("casadi");
    println!("cargo::rustc-link-lib=m");
}
