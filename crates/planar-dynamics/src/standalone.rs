//! What of the core's text generated modules carry that depend on no library; for the renderer alone.

/// (module, text), in the order in which they use each other.
pub const PARTS: [(&str, &str); 4] = [
    ("number", include_str!("scalar/number.rs")),
    ("sine", include_str!("scalar/sine.rs")),
    ("float", include_str!("scalar/float.rs")),
    ("manifest", include_str!("manifest.rs")),
];
