//! URDF files: the layout that one gives can be written and exported, and comes back.

use super::{Target, file, files, promised, refused};
use planar_capture::layout::Layout;
use planar_capture::urdf::{ImportOptions, export, import};

pub fn target() -> Target {
    let layouts = files("codegen/layouts", "toml");
    let layouts = layouts.iter().map(|text| Layout::parse(text, "layout").expect("a layout"));
    let exported = layouts.map(|layout| export(&layout));
    Target {
        name: "urdf",
        share: 26,
        seeds: [file("tests/urdf/clutter.urdf")].into_iter().chain(exported).collect(),
        read,
    }
}

fn read(bytes: &[u8]) -> Result<bool, String> {
    let text = String::from_utf8_lossy(bytes);
    let imported = match import(&text, &ImportOptions::default()) {
        Ok(imported) => imported,
        Err(error) => return refused(&error),
    };
    let toml = imported.to_toml("robot.urdf");
    refused(&toml)?;
    let written = Layout::parse(&toml, "robot.toml").map_err(|report| format!("as written: {report}"))?;
    promised(written == imported.layout, "the layout that is written is the one that is imported")?;
    let again =
        import(&export(&written), &ImportOptions::default()).map_err(|error| format!("as exported: {error}"))?;
    promised(again.layout.joints() == written.joints(), "an exported layout has the same joints")?;
    Ok(true)
}
