//! A capture under a control law of one's own: the joints are controlled at 50 Hz by encoders that are late by one sample
//! and noisy, and whose differences are the measured rates.
//!
//! The study is the same as with a shipped law: detected or planned contacts, impacts, audit. Exit code 1 if the audit
//! fails.

mod encoder;
mod law;

use encoder::Encoders;
use law::EncoderControl;
use planar_capture::capture::{Silent, Study, study_with};
use planar_capture::laws::Laws;
use planar_capture::registry::{SHIPPED, generated};
use planar_capture::scenario::Scenario;
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

/// Between the samples of the results, s.
const SAMPLE: f64 = 0.1;

fn main() -> ExitCode {
    match run() {
        Ok(study) => {
            let failures = study.audit_failures();
            for failure in &failures {
                eprintln!("audit: {failure}");
            }
            if failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// The study under the law; prints how far the joints are off at the contact, and what they bring about there.
fn run() -> Result<Study, Box<dyn Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenario.toml");
    let scenario = Scenario::read(&file, SHIPPED)?;
    let model = generated(&scenario.layout)?;
    let law = EncoderControl {
        encoders: Encoders { resolution: 1e-4, delay: 1, seed: 2017 },
        proportional_gain: 49.0,
        derivative_gain: 14.0,
        filter_time: 0.05,
    };
    let laws = Laws { tracking: Some(&law), ..Laws::default() };
    let study = study_with(&scenario, &|| model.clone_box(), laws, SAMPLE, &mut Silent)?;

    let end = study.approach.end();
    println!("joints at the contact: angle and its error, rad");
    for (i, (angle, wanted)) in end.state.joint_angles.iter().zip(&scenario.approach.final_joint_angles).enumerate() {
        println!("  {:<12} {angle:>8.4} {:>+9.4}", scenario.layout.joint_name(i), angle - wanted);
    }
    for case in &study.cases {
        let Some(capture) = &case.capture else { continue };
        let exact = &capture.impact.exact;
        let impulses = exact.impulse_magnitudes().into_iter().flatten().map(|size| format!("{size:.4}"));
        println!("{}: impulses {} N s", case.name, impulses.collect::<Vec<_>>().join(", "));
    }
    Ok(study)
}
