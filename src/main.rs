//! The command line of planar-capture.

fn main() -> std::process::ExitCode {
    planar_capture::cli::main()
}
