//! Layouts: what is read is written, hashed, checked and read again as the same.

use super::{Target, files, promised, refused};
use planar_capture::check;
use planar_capture::layout::Layout;
use std::path::Path;

pub fn target() -> Target {
    Target { name: "layout", share: 20, seeds: files("codegen/layouts", "toml"), read }
}

fn read(bytes: &[u8]) -> Result<bool, String> {
    let text = String::from_utf8_lossy(bytes);
    let checked = check::inspect(&text, "robot.toml", Path::new(""), planar_capture::scenario::Known::default());
    let layout = match Layout::parse(&text, "robot.toml") {
        Ok(layout) => layout,
        Err(report) => return refused(&report),
    };
    if let Ok(checked) = checked {
        let _ = checked.warnings.to_string();
    }
    let back = Layout::parse(&layout.to_toml(), "robot.toml").map_err(|report| format!("as written: {report}"))?;
    promised(back == layout && back.sha256() == layout.sha256(), "a layout that is written is the same")?;
    Ok(true)
}
