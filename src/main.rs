//! The command line of planar-capture.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
