//! The source text of the core that standalone generated modules contain; for the renderer alone.

/// (module, text), each after those that it uses.
pub const PARTS: [(&str, &str); 6] = [
    ("number", include_str!("scalar/number.rs")),
    ("far_angle", include_str!("scalar/far_angle.rs")),
    ("sine", include_str!("scalar/sine.rs")),
    ("accelerated", include_str!("scalar/portable.rs")),
    ("float", include_str!("scalar/float.rs")),
    ("manifest", include_str!("manifest.rs")),
];
