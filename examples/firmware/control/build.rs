//! Compiles the modules in C for the host or the board.

use std::path::Path;
use std::{env, process};

fn main() {
    for generated in ["src/dual_arm_3r.rs", "c/dual_arm_3r.c", "c/dual_arm_3r.h"] {
        println!("cargo::rerun-if-changed={generated}");
        if !Path::new(generated).exists() {
            println!("cargo::error=control/{generated} is generated: run examples/firmware/generate first");
            process::exit(1);
        }
    }
    println!("cargo::rerun-if-changed=c");
    let set = |feature: &str| env::var_os(format!("CARGO_FEATURE_{feature}")).is_some();
    let mut c = cc::Build::new();
    c.files(["c/dual_arm_3r.c", "c/capture.c", "c/functions.c"]);
    c.flags(["-std=c99", "-ffp-contract=off", "-ffunction-sections", "-fdata-sections", "-Wall", "-Wextra", "-Werror"]);
    if !set("DOUBLE") {
        c.define("DUAL_ARM_3R_FLOAT", None);
    }
    if env::var("TARGET").is_ok_and(|target| target == "thumbv7em-none-eabihf") {
        // "cortex-m7" in the flags of rustc: with double precision
        let flags = env::var("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default();
        let (cpu, fpu) =
            if flags.contains("cortex-m7") { ("cortex-m7", "fpv5-d16") } else { ("cortex-m4", "fpv4-sp-d16") };
        let is_fast = env::var("OPT_LEVEL").is_ok_and(|level| level == "3");
        c.no_default_flags(true).compiler("arm-none-eabi-gcc").flag(if is_fast { "-O2" } else { "-Os" });
        c.flags(["-mthumb", "-mfloat-abi=hard", "-ffreestanding"])
            .flag(format!("-mcpu={cpu}"))
            .flag(format!("-mfpu={fpu}"));
    }
    c.compile("control_c");
}
