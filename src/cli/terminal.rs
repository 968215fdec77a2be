//! Messages on the standard output and the standard error. They report what is already settled: a closed pipe or a full
//! disk behind either of them changes no exit code.

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};

/// Prints a message of a command whose product is not the standard output; one that cannot be printed is noted on the
/// standard error, unless the reader closed the pipe.
pub fn print(text: &str) {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            note(format_args!("warning: cannot write to standard output: {error}"));
        }
        _ => {}
    }
}

/// Prints a line on the standard error. `eprintln!` panics where that fails; there is no other place to report it to.
pub fn note(line: impl Display) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}
