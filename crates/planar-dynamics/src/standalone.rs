//! The source text of the core that standalone generated modules contain; for the renderer alone.

/// (module, text), each after those that it uses.
pub const PARTS: [(&str, &str); 4] = [
    ("number", include_str!("scalar/number.rs")),
    ("sine", include_str!("scalar/sine.rs")),
    ("float", include_str!("scalar/float.rs")),
    ("manifest", include_str!("manifest.rs")),
];
