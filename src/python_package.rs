//! The Python package `codegen`, carried in the binary.

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
