//! The command line of planar-capture with control laws of one's own: the joints are controlled by encoders that are late by
//! one sample and noisy, and whose differences are the measured rates. A scenario names them, `tracking = "encoder_control"`
//! for the approach and `control = "encoder_damping"` after the capture.
//!
//! The study is the same as with shipped laws: detected or planned contacts, impacts, audit, results.

mod encoder;
mod law;

use std::process::ExitCode;

fn main() -> ExitCode {
    planar_capture::cli::main_with_laws(&[], &[law::ENCODER_CONTROL, law::ENCODER_DAMPING])
}
