//! Renders every committed graph to Rust; stops where a graph is not its layout's.

fn main() {
    planar_build::pipeline::build("codegen");
}
