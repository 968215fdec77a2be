//! What the core lends to generated modules that stand alone; for the renderer alone.

pub use crate::scalar::far_angle::{DIGITS, DIGITS_SINGLE};
pub use crate::scalar::sine::{Coefficients, DOUBLE, SINGLE};

/// Of the modules that compute the paper's impact in loops, besides the others: (module, text).
pub const IMPACT_EQUATIONS: (&str, &str) = ("impact_equations", include_str!("impact_equations.rs"));

/// (module, text), each after those that it uses.
pub const PARTS: [(&str, &str); 10] = [
    ("number", include_str!("scalar/number.rs")),
    ("far_angle", include_str!("scalar/far_angle.rs")),
    ("sine", include_str!("scalar/sine.rs")),
    ("accelerated", include_str!("scalar/portable.rs")),
    ("float", include_str!("scalar/float.rs")),
    ("real", include_str!("scalar/real.rs")),
    ("finite", include_str!("scalar/finite.rs")),
    ("body", include_str!("body.rs")),
    ("target", include_str!("target.rs")),
    ("manifest", include_str!("manifest.rs")),
];
