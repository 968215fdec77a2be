//! The numbers that a case leaves: the default ones, and groups of others.
//!
//! # Example
//! ```
//! use planar_capture::campaign::outputs::{OutputGroup, outputs};
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::registry::{SHIPPED, generic};
//! use planar_capture::scenario::Scenario;
//!
//! let text = r#"
//! name = "elbow"
//! layout = "single_arm_2r"
//! initial = { joint_angles = [0.0, 0.0] }
//! approach = { duration = 1.0, trajectory = "cycloidal", final_joint_angles = [0.5, -0.5], tracking = "exact" }
//! "#;
//! let scenario = Scenario::parse(text, "elbow.toml", "".as_ref(), SHIPPED)?;
//! let study = study(&scenario, &|| generic(&scenario.layout), f64::INFINITY, &mut Silent)?;
//! let outputs = outputs(&scenario, &[OutputGroup::ApproachEnd]);
//! let angle = outputs.iter().find(|output| output.name == "approach_arm1_joint2_angle").expect("one of the group");
//! let value = angle.value(&study, &study.cases[0]).expect("every approach has an end");
//! assert!(angle.unit == "rad" && (value + 0.5).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::capture::impact::{ContactResult, ImpactResult, ImpactSolution};
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::scenario::Scenario;
use crate::simulate::Phase;
use crate::simulate::conservation::ConservationErrors;
use std::fmt;

const POSE: [(&str, &str); 3] = [("yaw", "rad"), ("x", "m"), ("y", "m")];
const TWIST: [(&str, &str); 3] = [("omega", "rad/s"), ("vx", "m/s"), ("vy", "m/s")];
const IMPULSE: [(&str, &str); 3] = [("n", "N m s"), ("fx", "N s"), ("fy", "N s")];
const FORCE: [(&str, &str); 3] = [("n", "N m"), ("fx", "N"), ("fy", "N")];
const MOMENTUM: [(&str, &str); 3] = [("l", "N m s"), ("px", "N s"), ("py", "N s")];

/// Outputs that a sweep has if it names them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputGroup {
    /// Impulses over the duration of the contact.
    MeanForces,
    /// The state at the end of the approach.
    ApproachEnd,
    /// The state at the end of the post-impact motion.
    PostImpactEnd,
    /// The designed joint rates at the end of the approach.
    TerminalRates,
    /// Estimated errors of the paths, and drifts of the centre of mass.
    PathErrors,
    /// Impulses by the paper's equations.
    Paper,
}

impl OutputGroup {
    /// All of them with their names in sweeps.
    pub const ALL: [(&'static str, Self); 6] = [
        ("mean_forces", Self::MeanForces),
        ("approach_end", Self::ApproachEnd),
        ("post_impact_end", Self::PostImpactEnd),
        ("terminal_rates", Self::TerminalRates),
        ("path_errors", Self::PathErrors),
        ("paper", Self::Paper),
    ];
}

/// One number of a case.
pub struct Output {
    /// Unique in a sweep.
    pub name: String,
    /// SI; empty for a number without one.
    pub unit: &'static str,
    value: Value,
}

type Value = Box<dyn Fn(&Study, &CaseResult) -> Option<f64> + Send + Sync>;

impl fmt::Debug for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} [{}]", self.name, self.unit)
    }
}

impl Output {
    /// The number; `None` where the case has none.
    #[must_use]
    pub fn value(&self, study: &Study, case: &CaseResult) -> Option<f64> {
        (self.value)(study, case).filter(|value| value.is_finite())
    }
}

/// The outputs of a scenario's cases, in the order of their columns.
#[must_use]
pub fn outputs(scenario: &Scenario, groups: &[OutputGroup]) -> Vec<Output> {
    let mut list = List::default();
    let arms: Vec<&str> = scenario.layout.arms.iter().map(|arm| arm.name.as_str()).collect();
    let joints: Vec<String> = scenario
        .layout
        .arms
        .iter()
        .flat_map(|arm| (1..=arm.links.len()).map(|k| format!("{}_joint{k}", arm.name)))
        .collect();
    let has = |group| groups.contains(&group);
    list.one("contact_time", "s", |study, case| case.capture.as_ref().map(|_| case.approach(study).duration));
    if has(OutputGroup::ApproachEnd) {
        list.state("approach", &joints, |study, case| Some(case.approach(study)));
    }
    if has(OutputGroup::TerminalRates) {
        let designed = |study: &Study, k: usize| Some(*study.terminal_rates.as_ref()?.joint_rates.get(k)?);
        for (k, joint) in joints.iter().enumerate() {
            list.one(&format!("{joint}_designed_rate"), "rad/s", move |study, _| designed(study, k));
        }
    }
    list.drifts("approach", has(OutputGroup::PathErrors), |study, case| Some(case.approach(study)));
    list.clearance();
    if scenario.targets.is_empty() {
        return list.0;
    }
    for (i, target) in scenario.targets.iter().enumerate() {
        if let Some([x, y]) = target.position.filter(|_| scenario.contact.detection == crate::scenario::Detection::Time)
        {
            list.one(&format!("{}_miss", target.name), "m", move |_, case| {
                let [_, at_x, at_y] = case.targets.get(i)?.pose;
                Some(libm::hypot(at_x - x, at_y - y))
            });
        }
        for contact in &target.contacts {
            let arm = contact.arm;
            list.one(&format!("{}_miss", arms[arm]), "m", move |_, case| miss(case, i, arm));
        }
    }
    list.impact(scenario, &arms, &joints);
    if has(OutputGroup::Paper) {
        for (arm, name) in arms.iter().enumerate() {
            let paper = move |case: &CaseResult| *case.capture.as_ref()?.impact.paper.as_ref()?.impulses.get(arm)?;
            list.vector(&format!("{name}_paper_impulse"), IMPULSE, move |_, case| paper(case));
        }
    }
    if let Some(duration) = scenario.contact.duration.filter(|_| has(OutputGroup::MeanForces)) {
        for (arm, name) in arms.iter().enumerate() {
            let force = move |part: f64| part / duration;
            list.vector(&format!("{name}_mean_force"), FORCE, move |_, case| {
                impulse(case, arm).map(|impulse| impulse.map(force))
            });
        }
    }
    list.drifts("post_impact", has(OutputGroup::PathErrors), |_, case| Some(&captured(case)?.post_impact));
    if has(OutputGroup::PostImpactEnd) {
        list.state("end", &joints, |_, case| Some(&captured(case)?.post_impact));
    }
    list.one("penetration", "m", |_, case| Some(captured(case)?.penetration));
    list.one("later_impacts", "", |_, case| {
        captured(case).map(|capture| f64::from(u32::try_from(capture.later_impacts.len()).unwrap_or(u32::MAX)))
    });
    list.one("residual_rigid_rate", "rad/s", |_, case| Some(captured(case)?.residual_motion.as_ref()?.rigid_rate));
    list.one("residual_base_rate", "rad/s", |_, case| Some(captured(case)?.residual_motion.as_ref()?.base_rate));
    list.one("residual_largest_joint_rate", "rad/s", |_, case| {
        Some(captured(case)?.residual_motion.as_ref()?.largest_joint_rate)
    });
    list.0
}

/// Whether every contact that is to hold was made; `None` where none is to hold.
#[must_use]
pub fn is_captured(scenario: &Scenario, case: &CaseResult) -> Option<bool> {
    let kinds = &scenario.cases.iter().find(|known| known.name == case.name)?.kinds;
    let planned = scenario.targets.iter().zip(kinds).flat_map(|(target, kinds)| target.contacts.iter().zip(kinds));
    let mut to_hold = planned.filter(|(_, kind)| kind.is_some_and(crate::contact::ContactKind::holds)).peekable();
    to_hold.peek()?;
    Some(to_hold.all(|(contact, _)| contacts(case).any(|made| made.contact.arm == contact.arm)))
}

fn captured(case: &CaseResult) -> Option<&CaptureResult> {
    case.capture.as_ref()
}

fn exact(case: &CaseResult) -> Option<&ImpactResult> {
    Some(&captured(case)?.impact.exact)
}

/// Of a case, in their order.
fn impacts(case: &CaseResult) -> impl Iterator<Item = &ImpactSolution> {
    captured(case).into_iter().flat_map(CaptureResult::impacts)
}

/// Of all impacts of a case.
fn contacts(case: &CaseResult) -> impl Iterator<Item = &ContactResult> {
    impacts(case).flat_map(|impact| &impact.contacts)
}

/// On the robot at an end effector, in the first impact in which it makes a contact.
fn impulse(case: &CaseResult, arm: usize) -> Option<[f64; 3]> {
    impacts(case).find_map(|impact| *impact.exact.impulses.get(arm)?)
}

/// How far an end effector was from its contact point, or at least from its target where it made no contact.
fn miss(case: &CaseResult, target: usize, arm: usize) -> Option<f64> {
    let made = contacts(case).find(|made| made.contact.arm == arm && made.contact.target == target);
    let closest = case.closest.iter().find(|pair| pair.arm == arm && pair.target == target);
    made.map(|made| made.contact.miss).or(closest.map(|pair| pair.distance))
}

#[derive(Default)]
struct List(Vec<Output>);

impl List {
    fn one(
        &mut self,
        name: &str,
        unit: &'static str,
        value: impl Fn(&Study, &CaseResult) -> Option<f64> + Send + Sync + 'static,
    ) {
        self.0.push(Output { name: name.to_owned(), unit, value: Box::new(value) });
    }

    /// Outputs `owner_part`.
    fn vector(
        &mut self,
        owner: &str,
        parts: [(&str, &'static str); 3],
        value: impl Fn(&Study, &CaseResult) -> Option<[f64; 3]> + Copy + Send + Sync + 'static,
    ) {
        for (i, (part, unit)) in parts.into_iter().enumerate() {
            self.one(&format!("{owner}_{part}"), unit, move |study, case| value(study, case).map(|vector| vector[i]));
        }
    }

    /// The last state of a phase.
    fn state(
        &mut self,
        when: &str,
        joints: &[String],
        phase: impl for<'a> Fn(&'a Study, &'a CaseResult) -> Option<&'a Phase> + Copy + Send + Sync + 'static,
    ) {
        self.vector(&format!("{when}_base"), POSE, move |study, case| Some(phase(study, case)?.end().state.base_pose));
        self.vector(&format!("{when}_base"), TWIST, move |study, case| {
            Some(phase(study, case)?.end().state.base_twist)
        });
        for (k, joint) in joints.iter().enumerate() {
            self.one(&format!("{when}_{joint}_angle"), "rad", move |study, case| {
                phase(study, case)?.end().state.joint_angles.get(k).copied()
            });
            self.one(&format!("{when}_{joint}_rate"), "rad/s", move |study, case| {
                phase(study, case)?.end().state.joint_rates.get(k).copied()
            });
        }
    }

    /// The audit of a phase.
    fn drifts(
        &mut self,
        when: &str,
        all: bool,
        phase: impl for<'a> Fn(&'a Study, &'a CaseResult) -> Option<&'a Phase> + Copy + Send + Sync + 'static,
    ) {
        let mut drift = |name: &str, value: fn(&ConservationErrors) -> f64| {
            self.one(&format!("{when}_{name}"), "", move |study, case| Some(value(&phase(study, case)?.drift)));
        };
        drift("momentum_drift", |drift| drift.momentum_drift);
        drift("energy_error", |drift| drift.energy_error);
        if all {
            drift("center_of_mass_drift", |drift| drift.center_of_mass_drift);
            self.one(&format!("{when}_path_error"), "rad or m", move |study, case| {
                Some(phase(study, case)?.path_error)
            });
        }
    }

    fn clearance(&mut self) {
        self.one("least_distance", "m", |_, case| Some(case.clearance.least_shown()?.distance));
        self.one("least_distance_time", "s", |_, case| Some(case.clearance.least_shown()?.time));
        self.one("first_overlap", "s", |_, case| Some(case.clearance.overlaps.first()?.span[0]));
    }

    /// The exact solution of the first impact, and each arm's impulse.
    fn impact(&mut self, scenario: &Scenario, arms: &[&str], joints: &[String]) {
        for (k, joint) in joints.iter().enumerate() {
            self.one(&format!("{joint}_rate_after"), "rad/s", move |_, case| {
                exact(case)?.joint_rates_after.get(k).copied()
            });
        }
        self.vector("base_after", TWIST, |_, case| Some(exact(case)?.base_twist_after));
        for (i, target) in scenario.targets.iter().enumerate() {
            self.vector(&format!("{}_after", target.name), TWIST, move |_, case| {
                captured(case)?.impact.target_twists.get(i).copied()
            });
        }
        for (arm, name) in arms.iter().enumerate() {
            self.vector(&format!("{name}_impulse"), IMPULSE, move |_, case| impulse(case, arm));
            self.one(&format!("{name}_impulse_magnitude"), "N s", move |_, case| {
                let [_, fx, fy] = impulse(case, arm)?;
                Some(libm::hypot(fx, fy))
            });
        }
        self.vector("momentum_jump", MOMENTUM, |_, case| Some(exact(case)?.momentum_jump));
        self.one("kinetic_energy_before", "J", |_, case| Some(exact(case)?.kinetic_energy_before));
        self.one("kinetic_energy_after", "J", |_, case| Some(exact(case)?.kinetic_energy_after));
    }
}

#[cfg(test)]
mod tests {
    use super::{OutputGroup, is_captured, outputs};
    use crate::capture::{LaterImpact, Silent, study};
    use crate::registry;
    use crate::scenario::Scenario;
    use crate::scenario::fixture::two_discs;
    use planar_proof::{file, layout};

    #[test]
    fn one_of_two_targets_is_no_capture() {
        let scenario = two_discs("duration = 0.5\n");
        let model = registry::generic(&layout("dual_arm_3r"));
        let mut study = study(&scenario, &|| model.clone_box(), 1.0, &mut Silent).expect("a study");
        let case = &mut study.cases[0];
        assert_eq!(is_captured(&scenario, case), Some(true));
        let contacts = &mut case.capture.as_mut().expect("a capture").impact.contacts;
        assert_eq!(contacts.len(), 2);
        let missed = contacts.pop();
        assert_eq!(is_captured(&scenario, case), Some(false));
        let contacts = &mut case.capture.as_mut().expect("a capture").impact.contacts;
        *contacts = missed.into_iter().collect();
        assert_eq!(is_captured(&scenario, case), Some(false));
    }

    /// The end of an approach that meets nothing is no time of a contact.
    #[test]
    fn a_case_that_meets_nothing_has_no_contact_time() {
        let scenario = two_discs("duration = 0.5\n");
        let model = registry::generic(&layout("dual_arm_3r"));
        let mut study = study(&scenario, &|| model.clone_box(), 1.0, &mut Silent).expect("a study");
        let outputs = outputs(&scenario, &[]);
        let time = outputs.iter().find(|output| output.name == "contact_time").expect("a column");
        assert_eq!(time.value(&study, &study.cases[0]), Some(study.approach.duration));
        study.cases[0].capture = None;
        assert_eq!(time.value(&study, &study.cases[0]), None);
    }

    /// The columns of designed rates are those of their joints.
    #[test]
    fn designed_rates_are_those_of_the_joints() {
        let path = file("scenarios/sweeps/capture.toml");
        let scenario = Scenario::read(&path, registry::SHIPPED).unwrap_or_else(|report| panic!("{report}"));
        let model = registry::generic(&scenario.layout);
        let study = study(&scenario, &|| model.clone_box(), 1e3, &mut Silent).expect("a study");
        let designed = study.terminal_rates.as_ref().expect("designed rates").joint_rates.clone();
        let outputs = outputs(&scenario, &[OutputGroup::TerminalRates]);
        for (k, rate) in designed.iter().enumerate() {
            let name = format!("arm{}_joint{}_designed_rate", 1 + k / 3, 1 + k % 3);
            let output = outputs.iter().find(|output| output.name == name).expect("a column");
            assert_eq!((output.unit, output.value(&study, &study.cases[0])), ("rad/s", Some(*rate)), "{name}");
            assert!(designed.iter().filter(|other| (**other - rate).abs() < 1e-9).count() == 1, "{designed:?}");
        }
    }

    /// Two targets that are met one after the other are both captured, each with the miss of its own contact.
    #[test]
    fn contacts_of_later_impacts_count() {
        let scenario = two_discs("duration = 0.5\n");
        let model = registry::generic(&layout("dual_arm_3r"));
        let mut study = study(&scenario, &|| model.clone_box(), 1.0, &mut Silent).expect("a study");
        let capture = study.cases[0].capture.as_mut().expect("a capture");
        let mut impact = capture.impact.clone();
        impact.contacts.remove(0);
        impact.contacts[0].contact.miss = 0.25;
        impact.exact.impulses = vec![None, Some([0.1, 0.3, -0.4])];
        capture.impact.exact.impulses[1] = None;
        capture.impact.contacts.truncate(1);
        capture.later_impacts.push(LaterImpact { time: 0.3, impact });
        let case = &study.cases[0];
        assert_eq!(is_captured(&scenario, case), Some(true));
        let outputs = outputs(&scenario, &[]);
        let miss = |name: &str| outputs.iter().find(|output| output.name == name).map(|it| it.value(&study, case));
        assert_eq!(miss("arm2_miss"), Some(Some(0.25)));
        assert_eq!(
            ["arm2_impulse_n", "arm2_impulse_fy", "arm2_impulse_magnitude"].map(miss),
            [0.1, -0.4, 0.5].map(|x| Some(Some(x)))
        );
        assert_eq!(
            miss("arm1_miss"),
            Some(Some(study.cases[0].capture.as_ref().expect("a capture").impact.contacts[0].contact.miss))
        );
    }
}
