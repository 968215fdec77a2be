//! The command line of planar-capture.

#![warn(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "`println!` and `eprintln!` panic where they cannot write: `cli::terminal` prints"
)]

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
