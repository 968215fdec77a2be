//! Scenarios: read and described, as `check` does.

use super::{Target, files, path, refused};
use planar_capture::check;
use planar_capture::registry::SHIPPED;

pub fn target() -> Target {
    Target { name: "scenario", share: 12, seeds: files("scenarios", "toml"), read }
}

fn read(bytes: &[u8]) -> Result<bool, String> {
    let text = String::from_utf8_lossy(bytes);
    match check::inspect(&text, "study.toml", &path("scenarios"), SHIPPED) {
        Ok(checked) => {
            let _ = (checked.warnings.to_string(), checked.description);
            checked.refusal.map_or(Ok(true), |report| refused(&report))
        }
        Err(report) => refused(&report),
    }
}
