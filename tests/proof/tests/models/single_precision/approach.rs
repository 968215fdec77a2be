//! What single precision changes in an approach of 20 s, and its section in docs/embedded.md.

use super::MODELS;
use planar_capture::registry::generated;
use planar_proof::approach::{Differences, compare};
use planar_proof::tolerance::single_precision_approach;
use planar_proof::{file, layout};
use std::fmt::Write;

const DOCUMENT: &str = "docs/embedded.md";
/// With this variable the section is written.
const WRITE: &str = "PLANAR_CAPTURE_WRITE";
const HEAD: &str = "## Single precision

What `f32` changes in an approach of 20 s: PD control and Runge–Kutta steps at 1 kHz, by the library, in `f32` and in `f64`; the
bits are those of the boards. The largest difference in the 20,000 steps, and the largest momentum of the robot, which has none
at the start, over the sum of those of its bodies. Each step rounds each number by half a unit in its last place; the bound
is that of so many independent roundings: 4 √20,000 ε of the largest angle, and of the bodies' momenta. Written by
`PLANAR_CAPTURE_WRITE=1 cargo test -p planar-proof --features fixtures --test models single_precision`.

| layout | joint angles, rad | base yaw, rad | base position, m | bound | momentum | bound |
|---|---|---|---|---|---|---|
";

#[test]
fn an_approach_in_single_precision_is_that_of_the_document() {
    let mut section = HEAD.to_owned();
    for (name, model) in MODELS {
        let layout = layout(name);
        let found = compare(&*model(&layout), &*generated(&layout).expect("generated code")).expect("an approach");
        let Differences { joint_angles, base_yaw, base_position, momentum_drift, position } = found;
        let bound = single_precision_approach();
        let position = bound * position;
        for (what, difference, bound) in [
            ("joint angles", joint_angles, position),
            ("yaw", base_yaw, position),
            ("base position", base_position, position),
            ("momentum", momentum_drift, bound),
        ] {
            assert!(difference <= bound, "{name}: {what} off by {difference:e} after 20 s, bound {bound:e}");
        }
        writeln!(
            section,
            "| `{name}` | {joint_angles:.1e} | {base_yaw:.1e} | {base_position:.1e} | {position:.1e} | \
             {momentum_drift:.1e} | {bound:.1e} |"
        )
        .expect("text");
    }
    // other bits with the feature `fused`
    if cfg!(not(feature = "fused")) {
        is_in_the_document(&section);
    }
}

/// The document has this section, or is given it; `.ci/firmware` writes the others.
fn is_in_the_document(section: &str) {
    let text = std::fs::read_to_string(file(DOCUMENT)).expect("a committed file").replace("\r\n", "\n");
    let head = section.lines().next().expect("a head");
    let start = text.find(head).unwrap_or(text.len());
    let end = text[start..].find("\n\n## ").map_or(text.len(), |end| start + end + 1);
    if text[start..end] != *section {
        assert!(std::env::var_os(WRITE).is_some(), "{DOCUMENT}: `{head}` is another; {WRITE}=1 writes it:\n{section}");
        let (before, after) = (text[..start].trim_end(), &text[end..]);
        std::fs::write(file(DOCUMENT), format!("{before}\n\n{section}{after}")).expect("written");
    }
}
