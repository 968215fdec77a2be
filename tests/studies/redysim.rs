//! ReDySim's printed states of two approaches, as scenarios of the approach alone.

use crate::{run, scenario};
use planar_capture::registry::SHIPPED;
use planar_capture::scenario::Scenario;
use planar_proof::{assert_close, numbers, tolerance};
use std::path::Path;

/// Time, then base x, y, yaw, then the joint angles: the order of ReDySim's files.
fn check(name: &str, rows: &[&[f64]]) {
    let scenario = scenario(name);
    assert!(scenario.targets.is_empty());
    let study = run(&scenario);
    for row in rows {
        let sample = study.approach.samples.iter().find(|s| (s.time - row[0]).abs() < 1e-9).expect("a sample");
        let [yaw, x, y] = sample.state.base_pose;
        let ours: Vec<f64> = [x, y, yaw].into_iter().chain(sample.state.joint_angles.iter().copied()).collect();
        assert_close(&format!("{name} at {} s", row[0]), &ours, &row[1..], tolerance::REDYSIM);
    }
}

#[test]
fn one_arm() {
    check(
        "redysim_single_arm_3r",
        &[
            &[5.0, -0.002_356_39, 0.004_845_26, 0.093_480_48, 0.237_914_3, -0.684_974_1, 1.033_464],
            &[10.0, 0.016_198_42, 0.033_227_85, 0.632_681_3, -0.590_156_4, -1.076_253, -0.135_969_6],
            &[15.0, 0.065_739_89, 0.039_700_55, 1.010_06, -1.4323, -1.514_63, -1.316_72],
            &[20.0, 0.072_063_64, 0.037_950_83, 1.043_793, -1.577_186, -1.575_492, -1.571_369],
        ],
    );
}

#[test]
fn both_arms() {
    check(
        "redysim_dual_arm_3r",
        &[
            &[
                10.0,
                -0.002_421_51,
                0.028_614_05,
                0.031_384_84,
                0.266_803_5,
                -0.844_479_1,
                1.029_365,
                2.619_288,
                1.719,
                -0.803_983_9,
            ],
            &[
                20.0,
                -0.001_093_3,
                0.102_277_5,
                0.131_610_1,
                -0.141_251_9,
                -1.579_487,
                0.219_816_9,
                3.217_49,
                1.789_624,
                -0.165_674_6,
            ],
            &[
                30.0,
                0.002_486_497,
                0.108_412_2,
                0.142_095_5,
                -0.253_557,
                -1.805_518,
                -0.036_574_29,
                3.395_057,
                1.805_303,
                0.036_504_64,
            ],
        ],
    );
}

/// Approaches of 60 s by the independent model (DOP853 at 1e-13): other angles, and trajectories
/// that end earlier and then hold their final angles. Scenarios are read from text; the tolerance is below the bound, which is
/// that of the comparison.
#[test]
fn a_minute_of_other_approaches() {
    let reference = planar_proof::json("tests/reference/long_approaches.json");
    for series in reference["series"].as_array().expect("series") {
        let list = |value: &serde_json::Value| format!("{:?}", numbers(value));
        let (layout, time) =
            (series["layout"].as_str().expect("a name"), series["trajectory_duration"].as_f64().expect("s"));
        let text = format!(
            "name = \"it\"\nlayout = \"{layout}\"\n[initial]\njoint_angles = {}\n[approach]\nduration = 60.0\n\
             trajectory_duration = {time:?}\ntrajectory = \"cycloidal\"\ntolerance = 1e-12\nfinal_joint_angles = {}\n",
            list(&series["initial"]),
            list(&series["final"])
        );
        let scenario = Scenario::parse(&text, "it.toml", Path::new(""), SHIPPED).unwrap_or_else(|e| panic!("{e}"));
        let study = run(&scenario);
        assert_eq!(study.audit_failures(), Vec::<String>::new());
        for state in series["states"].as_array().expect("states") {
            let at = state["time"].as_f64().expect("s");
            let sample = study.approach.samples.iter().find(|s| (s.time - at).abs() < 1e-9).expect("a sample");
            let motion = &sample.state;
            let name = |what: &str| format!("{what} of {layout}, {time} s, at {at} s");
            let bound = tolerance::LONG_APPROACH;
            assert_close(&name("base"), &motion.base_pose, &numbers(&state["base_pose"]), bound);
            assert_close(&name("base twist"), &motion.base_twist, &numbers(&state["base_twist"]), bound);
            assert_close(&name("angles"), &motion.joint_angles, &numbers(&state["joint_angles"]), bound);
            assert_close(&name("rates"), &motion.joint_rates, &numbers(&state["joint_rates"]), bound);
        }
    }
}
