//! Renders `layouts/NAME.toml` with its graph `layouts/NAME.json`; fails if their structures differ.

fn main() -> Result<(), planar_capture::build::BuildError> {
    planar_capture::build::render("layouts")
}
