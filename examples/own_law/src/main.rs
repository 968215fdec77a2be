//! The command line of planar-capture with a control law of one's own: the joints are controlled by encoders that are late by
//! one sample and noisy, and whose differences are the measured rates. A scenario names it, `tracking = "encoder_control"`.
//!
//! The study is the same as with a shipped law: detected or planned contacts, impacts, audit, results.

mod encoder;
mod law;

use std::process::ExitCode;

fn main() -> ExitCode {
    planar_capture::cli::main_with_laws(&[], &[law::ENCODER_CONTROL])
}
