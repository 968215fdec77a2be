//! The Python package `codegen`, carried in the binary.
//!
//! # Example
//! ```
//! use planar_capture::python_package::PYTHON_PACKAGE;
//!
//! let text = |wanted: &str| PYTHON_PACKAGE.iter().find(|(file, _)| *file == wanted).map_or("", |(_, text)| text);
//! // the derivation is symbolic, by one version of CasADi
//! assert!(text("requirements.txt").lines().any(|line| line.starts_with("casadi==")));
//! assert!(text("inputs.py").contains("import casadi"));
//! ```

macro_rules! package {
    ($($name:literal),*) => {
        /// (file, text), in the order of their names; the pinned requirements last.
        pub const PYTHON_PACKAGE: &[(&str, &str)] = &[
            $((concat!($name, ".py"), include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/codegen/", $name, ".py"))),)*
            ("requirements.txt", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/codegen/requirements.txt"))),
        ];
    };
}

include!(concat!(env!("OUT_DIR"), "/package.rs"));
