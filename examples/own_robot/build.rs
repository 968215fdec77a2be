//! Renders `layouts/NAME.toml` with its graph `layouts/NAME.json`; fails if they disagree.

fn main() -> Result<(), planar_capture::build::BuildError> {
    planar_capture::build::render("layouts")
}
