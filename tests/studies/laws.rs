//! Control laws of one's own in studies.

use crate::{run, scenario};
use planar_capture::capture::{Silent, Study, StudyError, study_with};
use planar_capture::control::{EstimatedState, Estimator, ProportionalDerivative, ZeroTorque};
use planar_capture::dynamics::AnyModel;
use planar_capture::error::Error;
use planar_capture::format::NumberRule;
use planar_capture::laws::{Laws, PostCaptureLaw, PostCaptureTask, Run, TrackingLaw, TrackingTask};
use planar_capture::registry;
use planar_capture::scenario::{
    Known, LawFormat, LawFormats, LawNumber, LawNumbers, PostCaptureControl, Scenario, Tracking,
};
use planar_capture::simulate::{Phase, PhaseError};
use planar_capture::state::State;
use std::cell::RefCell;

fn run_with(scenario: &Scenario, laws: Laws<'_>) -> Result<Study, StudyError> {
    let model = registry::generated(&scenario.layout).expect("generated code");
    study_with(scenario, &|| model.clone_box(), laws, 0.5, &mut Silent)
}

/// The scenario's law by another name.
struct Same<'a>(&'a Scenario);

impl TrackingLaw for Same<'_> {
    fn name(&self) -> &'static str {
        "same"
    }

    fn track(&self, task: &TrackingTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        assert_eq!(task.scenario.initial, self.0.initial);
        self.0.approach.tracking.track(task, run)
    }

    fn starts_on_trajectory(&self) -> bool {
        self.0.approach.tracking.starts_on_trajectory()
    }
}

impl PostCaptureLaw for Same<'_> {
    fn name(&self) -> &'static str {
        "same"
    }

    fn control(&self, task: &PostCaptureTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        self.0.post_impact.as_ref().expect("a phase").control.control(task, run)
    }
}

/// A law of one's own that is the scenario's gives the scenario's results, in detected contacts and designs too.
#[test]
fn an_equal_law_gives_equal_results() {
    for name in ["raina_shah_2017", "resolved_motion_rate", "elastic_rebound", "large_target", "stabilised_capture"] {
        let scenario = scenario(name);
        let same = Same(&scenario);
        let mut expected = run_with(&scenario, Laws::default()).expect("a study");
        let found = run_with(&scenario, Laws { tracking: Some(&same), post_capture: Some(&same) }).expect("a study");
        for captured in expected.cases.iter_mut().filter_map(|case| case.capture.as_mut()) {
            if let Some(residual) = &mut captured.residual_motion {
                residual.control = "same";
            }
        }
        for (case, found) in expected.cases.iter().zip(&found.cases) {
            let parts = |capture: &planar_capture::capture::CaptureResult| {
                (capture.post_impact.clone(), capture.later_impacts.clone())
            };
            assert_eq!(case.capture.as_ref().map(parts), found.capture.as_ref().map(parts), "{name}");
        }
        assert_eq!(expected.approach, found.approach, "{name}");
    }
}

/// A sensor that is late by one sample and adds an error which alternates: a law with it has memory.
struct LateSensor<'a> {
    last: Vec<f64>,
    now: Vec<f64>,
    rates: Vec<f64>,
    seen: &'a RefCell<Vec<(f64, [f64; 3])>>,
}

impl Estimator<f64, AnyModel<f64>> for LateSensor<'_> {
    fn estimate(&mut self, time: f64, _: &AnyModel<f64>, state: &State<'_, f64>) -> Result<State<'_, f64>, Error> {
        let error = if self.seen.borrow().len().is_multiple_of(2) { 1e-5 } else { -1e-5 };
        self.seen.borrow_mut().push((time, state.base_pose));
        self.now.clear();
        self.now.extend(state.joint_angles.iter().map(|angle| angle + error));
        std::mem::swap(&mut self.last, &mut self.now);
        let joint_angles = if self.now.is_empty() { &self.last } else { &self.now };
        self.rates.clear();
        self.rates.extend_from_slice(state.joint_rates);
        Ok(State { joint_angles, joint_rates: &self.rates, ..*state })
    }
}

/// PD control by that sensor.
#[derive(Default)]
struct Late {
    seen: RefCell<Vec<(f64, [f64; 3])>>,
}

impl TrackingLaw for Late {
    fn name(&self) -> &'static str {
        "late"
    }

    fn track(&self, task: &TrackingTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        self.seen.borrow_mut().clear();
        let joints = task.model.joints();
        let estimator = LateSensor { last: Vec::new(), now: Vec::new(), rates: Vec::new(), seen: &self.seen };
        let law = ProportionalDerivative {
            trajectory: task.trajectory,
            proportional_gain: &vec![49.0; joints],
            derivative_gain: &vec![14.0; joints],
        };
        run(&mut EstimatedState { estimator, law })
    }
}

/// Called once per sample, in the inertial frame, whatever else is computed beside; the audit passes, and the results
/// are the same again.
#[test]
fn a_law_with_memory_is_called_once_per_sample() {
    let mut scenario = scenario("raina_shah_2017");
    scenario.cases.truncate(1);
    scenario.initial.base_pose = [0.3, 40.0, -7.0];
    scenario.approach.actuation.steps_per_sample = Some(2);
    let late = Late::default();
    let laws = Laws { tracking: Some(&late), post_capture: None };
    let study = run_with(&scenario, laws).expect("a study");
    assert_eq!(study.audit_failures(), Vec::<String>::new());
    let seen = late.seen.borrow().clone();
    assert_eq!(seen[0], (0.0, scenario.initial.base_pose));
    // 20 s, every second step of 0.005 s
    assert_eq!(seen.len(), 2000);
    assert!(seen.windows(2).all(|pair| pair[0].0 < pair[1].0), "times increase");
    assert_eq!(run_with(&scenario, laws).expect("a study"), study);
    // what is late and wrong is tracked worse than what is not, and not much
    let plain = run_with(&scenario, Laws::default()).expect("a study");
    let [off, without] = [&study, &plain].map(|study| {
        let ends = study.approach.end().state.joint_angles.iter().zip(&scenario.approach.final_joint_angles);
        ends.map(|(angle, wanted)| (angle - wanted).abs()).fold(0.0, f64::max)
    });
    assert!(off < 0.2 && (off - without).abs() > 1e-9, "{off} rad, {without} rad without");
}

/// It would be called at stages of steps that no sensor has.
#[test]
fn a_law_with_memory_needs_a_sample_time() {
    let scenario = scenario("raina_shah_2017");
    let late = Late::default();
    let error = run_with(&scenario, Laws { tracking: Some(&late), post_capture: None }).expect_err("no study");
    assert!(error.to_string().contains("needs a sample time"), "{error}");
    assert_eq!(error.key(&scenario).path, "approach.sample_time");
    assert!(matches!(&error, StudyError::Approach(stopped) if stopped.is_misuse()), "{error}");
}

/// No torques for some time after the impact, then the shipped brake.
struct DelayedBrake {
    wait: f64,
    brake: PostCaptureControl,
}

impl PostCaptureLaw for DelayedBrake {
    fn name(&self) -> &'static str {
        "delayed_brake"
    }

    fn control(&self, task: &PostCaptureTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        if task.since_impact < self.wait { run(&mut ZeroTorque) } else { self.brake.control(task, run) }
    }
}

/// A scenario that names laws of another program's has no result, whichever phase they are of.
#[test]
fn a_study_without_a_law_that_its_scenario_names_is_refused() {
    let given = || scenario("raina_shah_2017");
    let [mut before, mut after] = [given(), given()];
    before.approach.tracking = Tracking::Own { name: "absent", numbers: LawNumbers::default() };
    after.post_impact.as_mut().expect("a phase").control =
        PostCaptureControl::Own { name: "absent", numbers: LawNumbers::default() };
    for (refused, key) in [(&before, "approach.tracking"), (&after, "post_impact.control")] {
        let error = run_with(refused, Laws::default()).expect_err("no study");
        assert_eq!(error, StudyError::NoLaw { name: "absent", key });
        assert_eq!(error.key(refused).path, key);
    }
    // the other phase's law is none of it
    let given = given();
    let same = Same(&given);
    assert!(run_with(&after, Laws { tracking: Some(&same), post_capture: None }).is_err());
    assert!(run_with(&before, Laws { tracking: None, post_capture: Some(&same) }).is_err());
}

#[test]
fn residual_motion_is_reported_under_the_name_of_the_law() {
    let mut scenario = scenario("raina_shah_2017");
    scenario.cases.truncate(1);
    let gains = vec![200.0; 6];
    let law = |wait| DelayedBrake { wait, brake: PostCaptureControl::Damping { derivative_gain: gains.clone() } };
    let rate = |law: &DelayedBrake| {
        let study = run_with(&scenario, Laws { tracking: None, post_capture: Some(law) }).expect("a study");
        let capture = study.cases[0].capture.clone().expect("a capture");
        let residual = capture.residual_motion.expect("a residual motion");
        assert_eq!(residual.control, "delayed_brake");
        residual.largest_joint_rate
    };
    let [free, braked] = [rate(&law(1.0)), rate(&law(0.0))];
    assert!(braked < 0.01 * free, "{braked} rad/s braked, {free} rad/s free");
    // the scenario's law has no torques, and no residual motion
    let own = run(&scenario);
    assert_eq!(own.cases[0].capture.as_ref().expect("a capture").residual_motion, None);
}

/// A number that the scenario leaves out has the default of the law's format, in either phase; one that it gives is its own.
#[test]
fn numbers_of_a_law_that_are_left_out_have_its_defaults() {
    const BRAKE: LawFormat = LawFormat {
        name: "brake",
        doc: "of a test",
        numbers: &[
            LawNumber { key: "gain", rule: NumberRule::positive("a gain", "N m s/rad"), default: Some(14.0) },
            LawNumber { key: "delay", rule: NumberRule::non_negative("a delay", "s"), default: Some(0.5) },
        ],
    };
    let text = std::fs::read_to_string(planar_proof::file("scenarios/spinning_target.toml")).expect("a scenario");
    let own = text
        .replace("tracking = \"computed_torque\"", "tracking = \"brake\"")
        .replace("control = \"damping\"\nderivative_gain = 7.0", "control = \"brake\"")
        .replace("[contact]", "[approach.law]\ndelay = 0.25\n[contact]")
        + "[post_impact.law]\ngain = 3.0\n";
    let laws = LawFormats { tracking: vec![BRAKE], post_capture: vec![BRAKE] };
    let known = Known { laws, ..Known::from(registry::SHIPPED) };
    let scenario = Scenario::parse(&own, "it.toml", "".as_ref(), known).unwrap_or_else(|report| panic!("{report}"));
    let [before, after] = scenario.own_laws().map(|law| law.expect("a law of its own"));
    assert_eq!((before.1["gain"], before.1["delay"]), (14.0, 0.25));
    assert_eq!((after.1["gain"], after.1["delay"]), (3.0, 0.5));
}

/// A law of no torques that keeps when its parts of the motion begin, and with which joint angles to hold.
#[derive(Default)]
struct Told(RefCell<Vec<(f64, Vec<f64>)>>);

impl PostCaptureLaw for Told {
    fn name(&self) -> &'static str {
        "told"
    }

    fn control(&self, task: &PostCaptureTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        self.0.borrow_mut().push((task.since_impact, task.angles.to_vec()));
        run(&mut ZeroTorque)
    }
}

/// A law is told the time since the first impact at the start of each part of the motion, and the joint angles of that impact.
#[test]
fn a_law_is_told_the_time_since_the_first_impact() {
    let mut scenario = scenario("elastic_rebound");
    scenario.cases.retain(|case| case.name == "elastic");
    let told = Told::default();
    let study = run_with(&scenario, Laws { tracking: None, post_capture: Some(&told) }).expect("a study");
    let capture = study.cases[0].capture.as_ref().expect("a capture");
    let first = study.cases[0].approach.as_ref().expect("an approach").end().state.joint_angles.clone();
    let times = std::iter::once(0.0).chain(capture.later_impacts.iter().map(|later| later.time));
    let expected: Vec<_> = times.map(|time| (time, first.clone())).collect();
    assert!(expected.len() > 1, "impacts follow the first");
    assert_eq!(*told.0.borrow(), expected);
}
