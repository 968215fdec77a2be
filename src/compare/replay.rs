//! Samples as files, so that `eval` can compute them again.

use super::Sample;
use crate::layout::Layout;
use crate::states::to_json;
use toml::Value;

/// A layout as TOML that reads back as the same numbers.
#[must_use]
pub fn layout_text(layout: &Layout) -> String {
    let text = |key: &str, text: &str| format!("{key} = {}\n", Value::from(text));
    let number = |key: &str, value: f64| format!("{key} = {}\n", Value::from(value));
    let pair = |key: &str, pair: [f64; 2]| format!("{key} = {}\n", Value::from(pair.to_vec()));
    let mut lines = vec![
        text("name", &layout.name),
        "\n[base]\n".to_owned(),
        number("mass", layout.base.mass),
        number("inertia", layout.base.inertia),
    ];
    for arm in &layout.arms {
        lines.push("\n[[arm]]\n".to_owned());
        lines.extend([text("name", &arm.name), pair("mount", arm.mount)]);
        if arm.mount_angle != 0.0 {
            lines.push(number("mount_angle", arm.mount_angle));
        }
        for link in &arm.links {
            lines.push("[[arm.link]]\n".to_owned());
            lines.extend([number("length", link.length), number("mass", link.mass)]);
            lines.extend([number("inertia", link.inertia), pair("com", link.com)]);
        }
    }
    lines.concat()
}

/// The state as the array that `eval` reads.
#[must_use]
pub fn states_text(sample: &Sample) -> String {
    format!("[{}]\n", to_json(&sample.instant))
}
